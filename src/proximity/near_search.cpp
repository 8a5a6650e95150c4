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

// What is closer to an obstacle than this share of the coordinates does not hide it.
constexpr double kSightRoom = 0x1p-42;

}  // namespace

template <int D>
NearSearch<D>::NearSearch(const Environment<D>& env, const Body<D>& body, NearNotes<D>& notes)
    : env_(env), body_(body), notes_(notes), lists_(env), others_(env.memory), scratch_(env.memory) {}

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
    const NearList<D>& list = lists_.near(body_, Part<D>(body_, simplex), reach, notes_);
    if (list.empty()) return;
    const PairSearch<D> search(env_, list, true, reach, scratch_);
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
  box = widened(box, reach);
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

template class NearSearch<2>;
template class NearSearch<3>;

}  // namespace dsw
