#include "proximity/near_search.h"

#include <algorithm>
#include <cmath>

#include "predicates/near_signs.h"
#include "walk/cast.h"

namespace dsw {
namespace {

/** Positions of a body's vertices. */
template <int D>
PointArray points_of(const Body<D>& body) noexcept {
  static_assert(sizeof(BodyVertex<D>) % sizeof(double) == 0);
  if (body.vertices.empty()) return {};
  return {body.vertices[0].position, sizeof(BodyVertex<D>) / sizeof(double)};
}

/** Not less than how far a point has moved. */
template <int D>
double way_between(const double* a, const double* b) noexcept {
  double largest = 0;
  for (int k = 0; k < D; ++k) largest = std::max(largest, std::fabs(a[k] - b[k]));
  return 1.8 * largest;  // more than the square root of 3
}

// How far obstacles are noted, times the reach. Between 2 and 4 it makes no difference to a wire that is pushed: longer
// lists are made less often.
constexpr double kRoom = 2;

// What is closer to an obstacle than this share of the coordinates does not hide it.
constexpr double kSightRoom = 0x1p-42;

}  // namespace

template <int D>
uint64_t NearNotes<D>::memory_bytes() const {
  uint64_t bytes = array_bytes(of_vertices) + array_bytes(of_edges) + array_bytes(of_faces);
  for (const auto* notes : {&of_vertices, &of_edges, &of_faces}) {
    for (const NearNote<D>& each : *notes) bytes += each.list.memory_bytes();
  }
  return bytes;
}

template <int D>
NearSearch<D>::NearSearch(const Environment<D>& env, const Body<D>& body, NearNotes<D>& notes)
    : env_(env), body_(body), notes_(notes), flood_(env), others_(env.memory), scratch_(env.memory) {}

template <int D>
template <class Visit>
void NearSearch<D>::for_each_cover(Visit visit) const {
  for_each_simplex(body_, [&](const Simplex& s) {
    const bool has_edge =
        s.kind == Simplex::kVertex && covers_edges(body_.level) && body_.vertices[s.index].first_edge != kNone;
    const bool has_face =
        s.kind == Simplex::kEdge && covers_faces(body_.level) && body_.edges[s.index].faces[0] != kNone;
    if (!has_edge && !has_face) visit(s);
    return true;
  });
}

/** A vertex is covered by the first edge of its list, an edge by its first face. */
template <int D>
template <class Visit>
void NearSearch<D>::for_each_covered(const Simplex& cover, Visit visit) const {
  const auto visit_edge = [&](uint32_t e) {
    visit(Simplex{Simplex::kEdge, e});
    for (const uint32_t v : body_.edges[e].ends) {
      if (body_.vertices[v].first_edge == e) visit(Simplex{Simplex::kVertex, v});
    }
  };
  if (cover.kind == Simplex::kEdge) {
    visit_edge(cover.index);
    return;
  }
  visit(cover);
  if (cover.kind == Simplex::kVertex) return;
  const BodyFace& face = body_.faces[cover.index];
  for (const uint32_t v : face.corners) {
    const uint32_t e = find_edge(body_, v, face.after(v));
    if (body_.edges[e].faces[0] == cover.index) visit_edge(e);
  }
}

template <int D>
NearNote<D>& NearSearch<D>::note_of(const Simplex& cover) {
  Array<NearNote<D>>& notes = cover.kind == Simplex::kVertex ? notes_.of_vertices
                              : cover.kind == Simplex::kEdge ? notes_.of_edges
                                                             : notes_.of_faces;
  while (notes.size() <= cover.index) notes.emplace_back(env_.memory);
  return notes[cover.index];
}

// All that a new flood would enter lies within the room of the anchors. The flood that made the list has entered it,
// too, if that flood has come to the cell where the new one would start. It has if both start in the same cell. It also
// has if a straight way leads there from the anchor through passable cells, since that way lies within the room.
template <int D>
bool NearSearch<D>::holds(const Part<D>& cover, double reach, double way, NearNote<D>& note) const noexcept {
  if (!((reach + way) * (1 + 0x1p-40) <= note.room)) return false;
  const Cell now = body_.vertices[cover.corners.vertices[0]].cell;
  if (now == note.connected || now == note.start) return true;
  const CastResult there = cast(env_, note.anchors[0], cover.points[0], note.start);
  if (there.end == CastEnd::kHit || there.cell != now) return false;
  note.connected = now;
  return true;
}

template <int D>
void NearSearch<D>::refresh(const Part<D>& cover, double reach, NearNote<D>& note) {
  double way = 0;
  for (uint32_t i = 0; i < cover.corners.count; ++i) {
    way = std::max(way, way_between<D>(cover.points[i], note.anchors[i]));
  }
  const bool is_known = note.room >= 0 && note.version == env_.change_version;
  if (is_known && holds(cover, reach, way, note)) return;
  note.room = -1;  // until the list is whole
  note.list.clear();
  const double room = kRoom * reach;
  note.start = note.connected = body_.vertices[cover.corners.vertices[0]].cell;
  flood_.find(note.start, NearRegion<D>(cover.points, cover.corners.count, room), note.list);
  note.list.finish({env_.points, D});
  for (uint32_t i = 0; i < cover.corners.count; ++i) std::copy_n(cover.points[i], D, note.anchors[i]);
  note.version = env_.change_version;
  note.room = room;
}

/** A cast goes a little less than all the way, so that it does not end on the obstacle itself. Where a rounded point of
 * a part meets something at once, the pair counts as seen. */
template <int D>
bool NearSearch<D>::is_in_sight(const Part<D>& part, const NearPair<D>& pair) const noexcept {
  double size = 0, end[3];
  for (int k = 0; k < D; ++k) size = std::max({size, std::fabs(pair.point[k]), std::fabs(pair.obstacle_point[k])});
  const double left = kSightRoom * size / pair.distance;
  if (!(left < 1)) return true;
  for (int k = 0; k < D; ++k) end[k] = pair.obstacle_point[k] + left * (pair.point[k] - pair.obstacle_point[k]);
  Cell start = body_.vertices[part.corners.vertices[0]].cell;
  if (part.corners.count > 1) {
    const CastResult in_part = cast(env_, part.points[0], pair.point, start);
    if (in_part.end == CastEnd::kHit) return true;
    start = in_part.cell;
  }
  const CastResult there = cast(env_, pair.point, end, start);
  if (there.end != CastEnd::kHit) return true;
  // Among denormal numbers the cast may go all the way, to the obstacle itself.
  const Shape shape = env_.map.shape(there.cell);
  uint32_t shared = 0;
  for (uint32_t i = 0; pair.wall.valid() && i < D; ++i) {
    const uint32_t v = env_.map.vertex(there.cell, shape.simplices()[size_t{there.simplex} * D + i]);
    shared += std::find(pair.obstacle_vertices, pair.obstacle_vertices + 3, v) != pair.obstacle_vertices + 3;
  }
  return shared == pair.feature.count;
}

template <int D>
void NearSearch<D>::find_walls(double reach, Array<FoundPair<D>>& found) {
  for_each_cover([&](const Simplex& simplex) {
    NearNote<D>& note = note_of(simplex);
    refresh(Part<D>(body_, simplex), reach, note);
    if (note.list.empty()) return;
    const PairSearch<D> search(env_, note.list, true, reach, scratch_);
    for_each_covered(simplex, [&](const Simplex& s) {
      const Part<D> part(body_, s);
      search.find(
          part, [](const NearFeature&) { return true; },
          [&](const NearPair<D>& pair) {
            if (search.is_clear(pair) || is_in_sight(part, pair)) found.push_back({pair, kNone});
          });
    });
  });
}

/** The parts of a partner that its level covers and that may be within reach. */
template <int D>
void NearSearch<D>::collect(const Body<D>& other, const Part<D>& cover, double reach) {
  Box<D> box;
  for (uint32_t i = 0; i < cover.corners.count; ++i) box.add(cover.points[i]);
  for (int k = 0; k < D; ++k) {
    box.lower[k] -= reach + 0x1p-50 * std::fabs(box.lower[k]);
    box.upper[k] += reach + 0x1p-50 * std::fabs(box.upper[k]);
  }
  others_.clear();
  const auto add = [&](const Simplex& s) {
    const SimplexCorners<D> corners(other, s);
    NearObstacle<D> o{{}, corners.count, {}, {}};
    std::copy_n(corners.vertices, std::min<uint32_t>(corners.count, D), o.vertices);
    others_.add(o);
    return true;
  };
  single_vertices(other, other.level).visit(box, [&](uint32_t v) { return add({Simplex::kVertex, v}); });
  if (covers_edges(other.level)) {
    fresh_boxes(other).edges.visit(box, [&](uint32_t e) { return add({Simplex::kEdge, e}); });
  }
  if (covers_faces(other.level)) {
    fresh_boxes(other).faces.visit(box, [&](uint32_t f) { return add({Simplex::kFace, f}); });
  }
  if (!others_.empty()) others_.finish(points_of(other));
}

/** Of a body with itself each pair counts once, and neighbours do not. `corners` are vertices of the other body. */
template <int D>
bool NearSearch<D>::is_accepted(const Body<D>& other, const Part<D>& part, const uint32_t* corners,
                                uint32_t count) const noexcept {
  if (&other != &body_) return true;
  const uint32_t m = part.corners.count;
  for (const uint32_t v : part.corners) {
    if (std::find(corners, corners + count, v) != corners + count) return false;
  }
  if (m != count) return m < count;
  if (m == 2) return std::min(part.corners.vertices[0], part.corners.vertices[1]) < corners[0];
  const uint32_t a = part.corners.vertices[0], b = corners[0];
  if (a < b) return true;
  // The vertex b has a row with a, unless an edge of a comes closer to b.
  bool is_minimum = true;
  for_each_edge(body_, a, [&](uint32_t e) {
    const double* const z = body_.position(body_.edges[e].other(a));
    return is_minimum = !covers_edges(body_.level) ||
                        dot_sign<D>({body_.position(a), z}, {body_.position(a), body_.position(b)}) <= 0;
  });
  return !is_minimum;
}

template <int D>
void NearSearch<D>::find_partner(const Partners<D>& partners, uint32_t number, double reach,
                                 Array<FoundPair<D>>& found) {
  const Body<D>& other = *partners.all[number].body;
  for_each_cover([&](const Simplex& simplex) {
    collect(other, Part<D>(body_, simplex), reach);
    if (others_.empty()) return;
    const PairSearch<D> search(env_, others_, false, reach, scratch_);
    for_each_covered(simplex, [&](const Simplex& s) {
      const Part<D> part(body_, s);
      search.find(
          part,
          [&](const NearFeature& f) {
            uint32_t names[3];
            for (uint32_t i = 0; i < f.count; ++i) names[i] = others_.name(f.corners[i]);
            return is_accepted(other, part, names, f.count);
          },
          [&](const NearPair<D>& pair) {
            if (is_in_sight(part, pair)) found.push_back({pair, number});
          });
    });
  });
}

template struct NearNotes<2>;
template struct NearNotes<3>;
template class NearSearch<2>;
template class NearSearch<3>;

}  // namespace dsw
