#pragma once
// How far the facets, marked edges and marked vertices of cells are from a point. A facet's distance is rounded as its
// vertices are numbered in the cell that looks at it, so the two cells of a facet may differ in the last bits.

#include <cmath>

#include "base/vec.h"
#include "environment/obstacles.h"
#include "locate/nearest.h"
#include "map/dart.h"

namespace dsw {

/** Nearest point of segment ab, or triangle abc, to the origin. */
Vec nearest_on(const Vec& a, const Vec& b);
Vec nearest_on(const Vec& a, const Vec& b, const Vec& c);

template <int D>
class Distances {
 public:
  Distances(const Environment<D>& env, const double* point);

  const Environment<D>& environment() const { return env_; }
  /** Distances are multiplied by this power of two, which brings squares of coordinates to where they neither over-
   * nor underflow. Nearly always 1. */
  double scale() const { return scale_; }

  /** From the point to the nearest one of a facet. */
  Vec to_facet(Cell c, const Shape& shape, uint32_t f) const {
    Vec best{};
    for (uint32_t s = shape.simplex_first(f); s < shape.simplex_first(f + 1); ++s) {
      const Vec at = to_simplex(c, shape.simplices() + static_cast<uint32_t>(D) * s);
      if (s == shape.simplex_first(f) || dot(at, at) < dot(best, best)) best = at;
    }
    return best;
  }
  static double length(const Vec& at) { return std::sqrt(dot(at, at)); }

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
        const Vec at = nearest_on(relative(c, shape.dart_vertex(d)), relative(c, shape.dart_vertex(shape.beta1(d))));
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
      const Vec at = relative(c, i);
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
  void report(double distance, const Vec& at, NearestResult& result) const;

 private:
  Vec relative(Cell c, uint32_t local) const {
    const double* v = env_.point(c, local);
    Vec at{v[0] * scale_ - point_[0] * scale_, v[1] * scale_ - point_[1] * scale_, 0};
    if constexpr (D == 3) at.z() = v[2] * scale_ - point_[2] * scale_;
    return at;
  }
  Vec to_simplex(Cell c, const uint16_t* local) const {
    if constexpr (D == 2) {
      return nearest_on(relative(c, local[0]), relative(c, local[1]));
    } else {
      return nearest_on(relative(c, local[0]), relative(c, local[1]), relative(c, local[2]));
    }
  }

  const Environment<D>& env_;
  const double* point_;
  double scale_ = 1;
};

/** A cell to visit, and how near it may hold something. The nearest is first in a heap. */
struct Waiting {
  double distance;
  uint32_t index;  // of the cell: the order of ties must not depend on where records lie
  bool operator<(const Waiting& o) const { return distance != o.distance ? distance > o.distance : index > o.index; }
};

}  // namespace dsw
