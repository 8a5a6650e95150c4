#include "proximity/near_search.h"

#include <algorithm>
#include <cmath>

#include "predicates/near_signs.h"

namespace dsw {
namespace {

/** Positions of a body's vertices. */
template <int D>
PointArray points_of(const Body<D>& body) noexcept {
  static_assert(sizeof(BodyVertex<D>) % sizeof(double) == 0);
  if (body.vertices.empty()) return {};
  return {body.vertices[0].position, sizeof(BodyVertex<D>) / sizeof(double)};
}

/** Whether the obstacle of a pair has a vertex. */
template <int D>
bool is_corner(const NearPair<D>& pair, uint32_t vertex) noexcept {
  return std::find(pair.obstacle_vertices, pair.obstacle_vertices + 3, vertex) != pair.obstacle_vertices + 3;
}

/** What is closer to an obstacle than this does not hide it. */
template <int D>
double sight_room(const NearPair<D>& pair) noexcept {
  double size = 0;
  for (int k = 0; k < D; ++k) size = std::max({size, std::fabs(pair.point[k]), std::fabs(pair.obstacle_point[k])});
  return 0x1p-42 * size;
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
      around_(env.memory),
      cells_(env.memory) {}

/** The first cast goes a little beyond the obstacle. If something else is met, another one goes a little less than all the
 * way. */
template <int D>
bool NearSearch<D>::is_in_sight(const Part<D>& part, const NearPair<D>& pair) {
  const double room = sight_room(pair) / pair.distance;
  Cell start = body_.vertices[part.corners.vertices[0]].cell;
  if (part.corners.count > 1) {
    const CastResult in_part = cast(env_, part.points[0], pair.point, start);
    if (in_part.end == CastEnd::kHit) return true;  // the rounded point lies behind what the part touches
    start = in_part.cell;
  }
  const bool is_of_body = !pair.wall.valid() && !pair.cell.valid();
  if (!(room < 1)) return is_of_body || is_reached(start, part, pair);
  const auto cast_to = [&](double from_obstacle) {
    double end[3];
    for (int k = 0; k < D; ++k) {
      end[k] = pair.obstacle_point[k] + from_obstacle * (pair.point[k] - pair.obstacle_point[k]);
    }
    return cast(env_, pair.point, end, start);
  };
  if (is_of_body) return cast_to(room).end != CastEnd::kHit;
  const CastResult beyond = cast_to(-room);
  if (beyond.end != CastEnd::kHit || is_at(beyond, pair)) return true;
  const CastResult before = cast_to(room);
  return before.end != CastEnd::kHit ? is_reached(before.cell, part, pair) : is_at(before, pair);
}

/** Whether a hit is on a wall at the obstacle of a pair. */
template <int D>
bool NearSearch<D>::is_at(const CastResult& hit, const NearPair<D>& pair) const noexcept {
  const Shape shape = env_.map.shape(hit.cell);
  uint32_t shared = 0;
  for (uint32_t i = 0; pair.wall.valid() && i < D; ++i) {
    const uint32_t v = env_.map.vertex(hit.cell, shape.simplices()[size_t{hit.simplex} * D + i]);
    shared += is_corner(pair, v);
  }
  return shared == pair.feature.count;
}

/** Rounded points cannot decide here. The obstacle counts as seen if a small flood from `start` reaches it and nothing at
 * it comes closer, reached or not. */
template <int D>
bool NearSearch<D>::is_reached(Cell start, const Part<D>& part, const NearPair<D>& pair) {
  const double* const at = pair.obstacle_point;
  const NearList<D>& list = lists_.in(start, NearRegion<D>(&at, 1, 2 * sight_room(pair)));
  const auto has_feature = [&](const NearObstacle<D>& o) {
    uint32_t shared = 0;
    for (uint32_t i = 0; i < o.count; ++i) shared += is_corner(pair, list.name(o.vertices[i]));
    return shared == pair.feature.count;
  };
  return std::any_of(list.obstacles().begin(), list.obstacles().end(), has_feature) && is_least_of_all(part, pair);
}

/** Whether the obstacle of a pair is a local minimum among all obstacles there, reached or not. If the way between both
 * points is free, it is. */
template <int D>
bool NearSearch<D>::is_least_of_all(const Part<D>& part, const NearPair<D>& pair) {
  if (pair.feature.count == D) return true;  // nothing is beside a whole wall
  collect_around(pair);
  return std::all_of(around_.features().begin(), around_.features().end(), [&](const NearFeature& f) {
    bool is_same = f.count == pair.feature.count;
    for (uint32_t i = 0; is_same && i < f.count; ++i) is_same = around_.name(f.corners[i]) == pair.obstacle_vertices[i];
    return !is_same || PairSearch<D>::is_local_minimum(around_, true, part, f);
  });
}

/** Lists the obstacles that have all corners of a pair's obstacle, also between two impassable cells. At a pinched
 * boundary there can be others. */
template <int D>
void NearSearch<D>::collect_around(const NearPair<D>& pair) {
  const Map<D>& map = env_.map;
  around_.clear();
  cells_.clear();
  cells_.insert(pair.wall.valid() ? map.cell_of(pair.wall) : pair.cell);
  for_each_cell_at_vertex(map, pair.obstacle_vertices[0], cells_, [&](Cell c) {
    const Shape shape = map.shape(c);
    const auto add = [&](NearObstacle<D> o) {
      uint32_t shared = 0;
      for (uint32_t i = 0; i < o.count; ++i) shared += is_corner(pair, o.vertices[i]);
      if (shared == pair.feature.count) around_.add(o);
    };
    for (uint32_t f = 0; f < shape.facet_count(); ++f) {
      const HalfFacet h = map.half_facet(c, f);
      if (!is_impassable(env_, h)) continue;
      for (uint32_t s = shape.simplex_first(f); s < shape.simplex_first(f + 1); ++s) {
        NearObstacle<D> triangle{{}, D, h, {}};
        for (uint32_t k = 0; k < uint32_t{D}; ++k) {
          triangle.vertices[k] = map.vertex(c, shape.simplices()[size_t{s} * D + k]);
        }
        add(triangle);
      }
    }
    if constexpr (D == 3) {
      for_each_marked_edge(env_, c, shape, [&](uint32_t d) {
        add({{map.vertex(c, shape.dart_vertex(d)), map.vertex(c, shape.dart_vertex(shape.beta1(d)))}, 2, {}, c});
      });
    }
  });
  around_.finish({env_.points, D});
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
          [&](const NearPair<D>& pair) {
            if (is_in_sight(part, pair)) found.push_back({pair, kNone});
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
            if (is_in_sight(part, pair)) found.push_back({pair, number});
          });
    });
    return true;
  });
}

template class NearSearch<2>;
template class NearSearch<3>;

}  // namespace dsw
