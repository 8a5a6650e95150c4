#pragma once
// Pairs of a part of a body and an obstacle that are nearest to each other there. Signs decide which pairs there are;
// doubles say where.

#include "base/points.h"
#include "body/simplices.h"
#include "proximity/obstacles_near.h"

namespace dsw {

/** A vertex, an edge or a face of a body. */
template <int D>
struct Part {
  Simplex simplex;
  SimplexCorners<D> corners;
  const double* points[3];

  Part(const Body<D>& body, const Simplex& which) noexcept : simplex(which), corners(body, which), points{} {
    for (uint32_t i = 0; i < corners.count; ++i) points[i] = body.position(corners.vertices[i]);
  }
};

/** Up to three points, by number. */
struct NearFeature {
  uint32_t vertices[3] = {kNone, kNone, kNone};
  uint32_t count = 0;
};

template <int D>
struct NearPair {
  Simplex part;
  NearFeature body, obstacle;  // vertices of the part, of the obstacle in ascending order
  double weights[3] = {};      // of the part's vertices
  double obstacle_weights[3] = {};
  double point[3] = {};  // on the part
  double obstacle_point[3] = {};
  double normal[3] = {};  // unit, from the obstacle to the part
  double distance = 0;
  HalfFacet wall;  // an impassable facet at the obstacle, see find_wall; else invalid
  Cell cell;       // of a marked edge or vertex: a cell at it
};

/** Finds the pairs of parts with obstacles of one list. What is found does not depend on the order of the list. */
template <int D>
class PairSearch {
 public:
  /** @param points of the obstacles' vertices. @param reach largest distance. */
  PairSearch(const Environment<D>& env, PointArray points, const Array<NearObstacle<D>>& obstacles,
             double reach) noexcept
      : env_(env), points_(points), obstacles_(obstacles), reach_(reach) {}

  /** Calls accept(feature) for features of obstacles that may be near the part, and visit(pair) for the pairs with
   * those that are accepted. */
  template <class Accept, class Visit>
  void find(const Part<D>& part, Accept accept, Visit visit) const {
    double lower[D], upper[D];
    bound(part, lower, upper);
    for (size_t i = 0; i < obstacles_.size(); ++i) {
      const NearObstacle<D>& o = obstacles_[i];
      if (is_apart(o, lower, upper)) continue;
      const uint32_t all = 1u << o.count;
      for (uint32_t chosen = 1; chosen < all; ++chosen) {
        const NearFeature f = choose(o, chosen);
        if (!are_inside(part, f) || !is_first_with(f, i) || !accept(f) || !is_local_minimum(part, f)) continue;
        NearPair<D> pair;
        if (measure(part, f, i, pair)) visit(pair);
      }
    }
  }

  /** Whether the nearest points of a part and a feature are unique and lie inside of both. */
  bool are_inside(const Part<D>& part, const NearFeature& feature) const noexcept;
  /** Then, whether no obstacle that holds the feature comes closer to the point of the part. */
  bool is_local_minimum(const Part<D>& part, const NearFeature& feature) const noexcept;

 private:
  void bound(const Part<D>& part, double* lower, double* upper) const noexcept;
  bool is_apart(const NearObstacle<D>& o, const double* lower, const double* upper) const noexcept;
  /** Some of the vertices of an obstacle. */
  static NearFeature choose(const NearObstacle<D>& o, uint32_t bits) noexcept;
  bool is_first_with(const NearFeature& f, size_t number) const noexcept;
  /** Where the two are nearest; whether that is within reach. `number`: the first obstacle with the feature. */
  bool measure(const Part<D>& part, const NearFeature& feature, size_t number, NearPair<D>& pair) const noexcept;
  /** Of the facets with a feature the lowest one from whose passable side a point is seen, else the lowest one. */
  HalfFacet find_wall(const NearFeature& feature, const double* point, size_t& number) const noexcept;
  /** Of an obstacle with a facet, into the passable cell. */
  Vec normal_of(size_t number) const noexcept;

  const Environment<D>& env_;
  PointArray points_;
  const Array<NearObstacle<D>>& obstacles_;
  double reach_;
};

}  // namespace dsw
