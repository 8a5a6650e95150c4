#include "proximity/near_search.h"

#include <algorithm>

#include "base/search.h"
#include "predicates/near_signs.h"
#include "proximity/sight.h"

namespace dsw {
namespace {

/** Positions of a body's vertices. */
template <int D>
PointArray points_of(const Body<D>& body) noexcept {
  static_assert(sizeof(BodyVertex<D>) % sizeof(double) == 0);
  if (body.vertices.empty()) return {};
  return {body.vertices[0].position, sizeof(BodyVertex<D>) / sizeof(double)};
}

/** The parts that are asked for with a simplex: the simplex itself, edges whose first face it is, and vertices at the
 * head of whose list such an edge is. */
template <int D>
class CoveredParts {
 public:
  CoveredParts(const Body<D>& body, const Part<D>& cover) noexcept {
    const uint32_t* const corners = cover.corners.vertices;
    const auto add_edge = [&](uint32_t e, uint32_t place) {
      add({Simplex::kEdge, e}, place);
      for (uint32_t i = 0; i < cover.corners.count; ++i) {
        if (body.vertices[corners[i]].first_edge == e) add({Simplex::kVertex, corners[i]}, i);
      }
    };
    if (cover.simplex.kind == Simplex::kEdge) {
      add_edge(cover.simplex.index, kFirstSide);
      return;
    }
    add(cover.simplex, cover.simplex.kind == Simplex::kVertex ? kFirstCorner : kWholeFace);
    for (uint32_t i = 0; i < 3 && cover.simplex.kind == Simplex::kFace; ++i) {
      const uint32_t e = find_edge(body, corners[i], corners[(i + 1) % 3]);
      if (body.edges[e].faces[0] == cover.simplex.index) add_edge(e, kFirstSide + i);
    }
  }

  /** A bit for each place in the simplex. */
  uint32_t places() const noexcept { return places_; }
  /** Calls visit(part, its place). */
  template <class Visit>
  void for_each(Visit visit) const {
    for (uint32_t i = 0; i < count_; ++i) visit(parts_[i], place_of_[i]);
  }

 private:
  void add(const Simplex& part, uint32_t place) noexcept {
    parts_[count_] = part;
    place_of_[count_++] = place;
    places_ |= 1u << place;
  }

  Simplex parts_[kPlacesInSimplex];
  uint32_t place_of_[kPlacesInSimplex];
  uint32_t count_ = 0, places_ = 0;
};

}  // namespace

template <int D>
NearSearch<D>::NearSearch(const Environment<D>& env, const Body<D>& body, NearNotes<D>& notes)
    : env_(env),
      body_(body),
      notes_(notes),
      lists_(env),
      others_(env.memory),
      near_others_(env.memory),
      cells_(env.memory),
      edge_(env) {}

/** The way from the part's first vertex to its nearest point lies in the part, which is free. From there another one
 * leads to the obstacle. */
template <int D>
Cell NearSearch<D>::look(const Part<D>& part, const NearList<D>& list, const NearPair<D>& pair) {
  const bool is_of_body = &list == &others_;
  SimplexPoints obstacle{{}, pair.feature.count}, of_part{{}, part.corners.count};
  for (uint32_t i = 0; i < obstacle.count; ++i) obstacle.at[i] = list.point(pair.feature.corners[i]);
  std::copy_n(part.points, of_part.count, of_part.at);
  const uint32_t known = is_of_body ? 0 : obstacle.count;
  SightResult at{false, body_.vertices[part.corners.vertices[0]].cell};
  if (of_part.count == 2 && walked_edge_ != part.simplex.index) {
    walked_edge_ = part.simplex.index;
    edge_.begin(part.points, at.cell, body_.vertices[part.corners.vertices[1]].cell);
  }
  const bool stays = of_part.count == 1 || (of_part.count == 2 && !edge_.leaves());
  if (stays && !is_of_body && is_simplex_at(env_.map, at.cell, pair.obstacle_vertices, known)) return at.cell;
  const SightEnd<D> point(of_part, obstacle, EndShift::kWhole);
  if (!stays) {
    Sightline<D> in_part(SightEnd<D>({{part.points[0]}, 1}, obstacle, EndShift::kWhole), point);
    at = of_part.count == 2 ? edge_.to(in_part) : walk_along(env_, in_part, at.cell, nullptr, 0);
    if (at.is_hit) return {};
    if (!is_of_body && is_simplex_at(env_.map, at.cell, pair.obstacle_vertices, known)) return at.cell;
  }
  const EndShift shift = is_of_body ? EndShift::kWhole : of_part.count == 1 ? EndShift::kFoot : EndShift::kStill;
  Sightline<D> line(point, SightEnd<D>(obstacle, of_part, shift));
  at = walk_along(env_, line, at.cell, pair.obstacle_vertices, known);
  if (at.is_hit) return {};
  return is_of_body ? at.cell : find_cell_at_end(env_, line, at.cell, pair.obstacle_vertices, known, cells_);
}

template <int D>
void NearSearch<D>::find_walls(double reach, Array<FoundPair<D>>& found) {
  for_each_outer(body_, [&](const Simplex& simplex) {
    const Part<D> cover(body_, simplex);
    if (lists_.is_alone(body_, cover, reach, notes_)) return true;
    const CoveredParts<D> parts(body_, cover);
    const NearView<D> view = lists_.near(body_, cover, parts.places(), reach, notes_);
    if (view.near.empty()) return true;
    const PairSearch<D> search(env_, view.list, view.near, true, reach);
    parts.for_each([&](const Simplex& s, uint32_t place) {
      const Part<D> part(body_, s);
      search.find(
          part, place, [](const NearFeature&) { return true; },
          [&](NearPair<D>& pair) {
            const Cell end = look(part, view.list, pair);
            if (!end.valid()) return;
            PassableFan<D> fan(env_, end, pair.obstacle_vertices, pair.feature.count, cells_);
            if (!pair.is_least && !search.is_least_in_fan(part, fan, pair)) return;
            if (search.find_wall(fan, pair)) found.push_back({pair, kNone});
          });
    });
    return true;
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
    WallFeature o{{}, corners.count, {}, {}};
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

/** Tells whether a pair counts. If a body meets itself, each pair counts once, and neighbours do not count. `corners`
 * are vertices of the other body. */
template <int D>
bool NearSearch<D>::is_accepted(const Body<D>& other, const Part<D>& part, const uint32_t* corners,
                                uint32_t count) const noexcept {
  if (&other != &body_) return true;
  const uint32_t m = part.corners.count;
  for (const uint32_t v : part.corners) {
    if (dsw::find(corners, corners + count, v) != corners + count) return false;
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
  for_each_outer(body_, [&](const Simplex& simplex) {
    const Part<D> cover(body_, simplex);
    const CoveredParts<D> parts(body_, cover);
    collect(other, cover, reach);
    near_others_.select_features(others_, cover, parts.places(), {reach, 0}, reach);
    if (near_others_.empty()) return true;
    const PairSearch<D> search(env_, others_, near_others_, false, reach);
    parts.for_each([&](const Simplex& s, uint32_t place) {
      const Part<D> part(body_, s);
      search.find(
          part, place,
          [&](const NearFeature& f) {
            uint32_t names[3];
            for (uint32_t i = 0; i < f.count; ++i) names[i] = others_.name(f.corners[i]);
            return is_accepted(other, part, names, f.count);
          },
          [&](const NearPair<D>& pair) {
            if (look(part, others_, pair).valid()) found.push_back({pair, number});
          });
    });
    return true;
  });
}

template class NearSearch<2>;
template class NearSearch<3>;

}  // namespace dsw
