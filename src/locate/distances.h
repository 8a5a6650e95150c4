#pragma once
// How far the facets, marked edges and marked vertices of cells are from a point, or from a segment. A facet's distance
// is rounded as its vertices are numbered in the cell that looks at it, so the two cells of a facet may differ in the
// last bits. An obstacle's distance is computed in the cell that names it, so it has the same bits from all cells.

#include <cmath>
#include <initializer_list>

#include "base/vec.h"
#include "environment/obstacles.h"
#include "locate/nearest.h"
#include "map/dart.h"

namespace dsw {

/** Nearest point of segment ab, or triangle abc, to the origin. */
Vec nearest_on(const Vec& a, const Vec& b);
Vec nearest_on(const Vec& a, const Vec& b, const Vec& c);
/** `v` without its part along `d`, whose squared length is given. Done twice, because the first time leaves a rounding
 * error of the size of v. */
Vec without(const Vec& v, const Vec& d, double square);

/** The foot of the origin on the plane of triangle abc, if it lies in the triangle, up to rounding. */
bool foot_inside(const Vec& a, const Vec& b, const Vec& c, Vec& foot);

/** The power of two that brings the environment and these points to where squares neither over- nor underflow. */
template <int D>
double fitting_scale(const Environment<D>& env, std::initializer_list<const double*> points);

/** A position times `scale`, as seen from a point. */
template <int D>
Vec relative(const double* position, const double* point, double scale) {
  Vec at{position[0] * scale - point[0] * scale, position[1] * scale - point[1] * scale, 0};
  if constexpr (D == 3) at.z() = position[2] * scale - point[2] * scale;
  return at;
}

/** The length of a way: by its square, unless that underflows. */
inline double length_of_way(const Vec& way) {
  const double square = dot(way, way);
  return square > 0x1p-900 ? std::sqrt(square) : length(way);
}

/** Fills in what lies at the end of a way from `point`, whose scaled length is `result.distance`. */
template <int D>
void report_obstacle(const Vec& way, const double* point, double scale, NearestResult& result) {
  for (int k = 0; k < D; ++k) {
    result.point[k] = point[k] + way[k] / scale;
    result.normal[k] = result.distance > 0 ? -way[k] / result.distance : 0;
  }
  result.distance /= scale;
}

/** What Distances measures from: here a point. */
template <int D>
struct FromPoint {
  using Corner = Vec;
  using Way = Vec;  // from the point to the nearest one
  using Result = NearestResult;

  const double* point;
  double scale;

  Corner corner(const double* position) const { return relative<D>(position, point, scale); }
  Way way(const Corner& a) const { return a; }
  Way way(const Corner& a, const Corner& b) const { return nearest_on(a, b); }
  Way way(const Corner& a, const Corner& b, const Corner& c, double /*limit*/) const { return nearest_on(a, b, c); }
  static double squared(const Way& way) { return dot(way, way); }
  void report(const Way& way, Result& result) const { report_obstacle<D>(way, point, scale, result); }
};

template <int D, class From = FromPoint<D>>
class Distances {
 public:
  using Way = typename From::Way;

  /** @param points that of FromPoint, or both ends of FromSegment. */
  template <class... Points>
  explicit Distances(const Environment<D>& env, const Points*... points)
      : env_(env), from_{points..., fitting_scale(env, {points...})} {}

  const Environment<D>& environment() const { return env_; }
  const From& from() const { return from_; }
  /** Distances are multiplied by this power of two, which brings squares of coordinates to where they neither over-
   * nor underflow. Nearly always 1. */
  double scale() const { return from_.scale; }

  /** To the nearest point of a facet. Beyond `limit` any way that is longer will do. */
  Way to_facet(Cell c, const Shape& shape, uint32_t f, double limit = HUGE_VAL) const {
    Way best{};
    for (uint32_t s = shape.simplex_first(f); s < shape.simplex_first(f + 1); ++s) {
      const Way at = to_simplex(c, shape, s, limit);
      if (s == shape.simplex_first(f) || From::squared(at) < From::squared(best)) best = at;
    }
    return best;
  }
  /** To a simplex of a cell's boundary. */
  Way to_simplex(Cell c, const Shape& shape, uint32_t s, double limit = HUGE_VAL) const {
    return to_simplex(c, shape.simplices() + static_cast<uint32_t>(D) * s, limit);
  }
  /** To an impassable facet, computed by its name: both sides get the same bits. */
  Way to_obstacle(const FeatureRef& name, double limit = HUGE_VAL) const {
    return to_facet(name.cell, env_.map.shape(name.cell), name.local, limit);
  }
  static double length(const Way& at) { return std::sqrt(From::squared(at)); }

  /** The name of an impassable facet. */
  FeatureRef name(HalfFacet h) const {
    const HalfFacet first = canonical(env_.map, h);
    const Cell owner = env_.map.cell_of(first);
    return {D - 1, owner, env_.map.local_of(first, owner)};
  }
  /** Calls offer(distance, from the point to it, feature) for marked edges and then for marked vertices of a cell. */
  template <class Offer>
  void for_each_thin(Cell c, const Shape& shape, Offer offer) const {
    if constexpr (D == 3) {
      for_each_marked_edge(env_, c, shape, [&](uint32_t d) {
        uint32_t a = shape.dart_vertex(d), b = shape.dart_vertex(shape.beta1(d));
        if (env_.map.vertex(c, b) < env_.map.vertex(c, a)) std::swap(a, b);
        const Way at = from_.way(corner(c, a), corner(c, b));
        Dart lowest{c, d};
        for_each_volume_round_edge(env_.map, {c, d}, [&](Dart e) {
          if (env_.map.index(e.cell) < env_.map.index(lowest.cell)) lowest = e;
          return true;
        });
        offer(length(at), at, FeatureRef{1, lowest.cell, env_.map.shape(lowest.cell).dart_edge(lowest.local)});
      });
    }
    for (uint32_t i = 0; env_.marked_vertices != 0 && i < shape.vertex_count(); ++i) {
      if (!vertex_marked(env_, env_.map.vertex(c, i))) continue;
      const Way at = from_.way(corner(c, i));
      offer(length(at), at, FeatureRef{0, c, i});
    }
  }
  /** What decides between features at the same distance: the lower dimension, then the lower canonical cell. */
  bool precedes(const FeatureRef& a, const FeatureRef& b) const {
    const Map<D>& map = env_.map;
    if (a.dimension != b.dimension) return a.dimension < b.dimension;
    if (a.dimension == 0) return map.vertex(a.cell, a.local) < map.vertex(b.cell, b.local);
    if (a.cell != b.cell) return map.index(a.cell) < map.index(b.cell);
    return a.local < b.local;
  }
  /** Fills in all but the feature and the count of cells. */
  void report(double distance, const Way& at, typename From::Result& result) const {
    result.distance = distance;
    from_.report(at, result);
  }

 private:
  auto corner(Cell c, uint32_t local) const { return from_.corner(env_.point(c, local)); }
  Way to_simplex(Cell c, const uint16_t* local, [[maybe_unused]] double limit) const {
    if constexpr (D == 2) {
      return from_.way(corner(c, local[0]), corner(c, local[1]));
    } else {
      return from_.way(corner(c, local[0]), corner(c, local[1]), corner(c, local[2]), limit);
    }
  }

  const Environment<D>& env_;
  From from_;
};

}  // namespace dsw
