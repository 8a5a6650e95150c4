#pragma once
// Pairs of a part of a body and an obstacle that are nearest to each other there. Signs decide which pairs there are;
// doubles say where.

#include "base/vec.h"
#include "proximity/near_selection.h"
#include "proximity/sight.h"

namespace dsw {

template <int D>
struct NearPair {
  Simplex part;
  uint32_t vertices[3] = {kNone, kNone, kNone};           // of the part
  uint32_t obstacle_vertices[3] = {kNone, kNone, kNone};  // of the obstacle, ascending
  NearFeature feature{};                                  // the obstacle in its list
  uint32_t feature_number = 0;                            // in the list
  double weights[3] = {}, obstacle_weights[3] = {};
  double point[3] = {};  // of the part
  double obstacle_point[3] = {};
  double normal[3] = {};   // unit, from the obstacle to the part
  bool has_normal = true;  // else the points are too close to tell it, and find_wall may have a better one
  double distance = 0;
  bool is_least = true;       // nothing comes closer that is listed, of whichever fan
  HalfFacet wall;             // an impassable facet at the obstacle, see find_wall; else invalid
  bool is_wall_seen = false;  // the point is on the passable side of its triangle
  Cell cell;                  // a cell with the obstacle from which the part is seen
};

/** Finds the pairs of parts with obstacles of one list. What is found does not depend on the order of the list. */
template <int D>
class PairSearch {
 public:
  /** @param near of the list: all within reach of the parts. @param is_shifted the list is of the environment.
   * @param reach largest distance. */
  PairSearch(const Environment<D>& env, const NearList<D>& list, const NearSelection<D>& near, bool is_shifted,
             double reach) noexcept
      : env_(env), list_(list), near_(near), is_shifted_(is_shifted), reach_(reach), far_(reach * (1 + 0x1p-20)) {}

  /** Calls visit(pair), without a wall, for the pairs with features for which accept(feature) is true, and for those that
   * is_least_in_fan has to tell. `place` of the part in the simplex that was selected for. */
  template <class Accept, class Visit>
  void find(const Part<D>& part, uint32_t place, Accept accept, Visit visit) const {
    for (const uint32_t* i = near_.features(place); i != near_.features_end(place); ++i) {
      const NearFeature& f = list_.features()[*i];
      if (is_far(part, f) || !accept(f)) continue;
      if (!are_inside(part, f)) continue;
      NearPair<D> pair;
      pair.feature_number = *i;
      pair.is_least = is_local_minimum(part, f, list_.around(f), list_.around_end(f));
      if ((pair.is_least || has_fans(*i)) && measure(part, f, pair)) visit(pair);
    }
  }
  /** Finds for a pair with the environment what it is told by: the facet with its feature that makes the least angle with
   * the way to the point. Of several, the lowest one from whose passable side the point is seen, else the lowest one. Only
   * what is in the fan of cells at the end of the way counts, so what else is in the list does not matter. The facet's
   * normal serves where the points are too close. False: the fan has no obstacle there. Throws std::bad_alloc. */
  bool find_wall(PassableFan<D>& fan, NearPair<D>& pair) const;
  /** Whether no obstacle in the fan of cells at the end of the way comes closer. Where volumes overlap, one of another fan may.
   * Throws std::bad_alloc. */
  bool is_least_in_fan(const Part<D>& part, PassableFan<D>& fan, const NearPair<D>& pair) const;

 private:
  /** The note of the list on a feature, with the obstacles there. Throws std::bad_alloc. */
  ObstaclesAtFeature& obstacles_at(uint32_t feature) const;
  /** Whether the obstacles at a feature are in several fans of cells. If they are in one, nothing that loses against one of them
   * is a row: it ends in that fan, or in one without obstacles. The list remembers it. Throws std::bad_alloc. */
  bool has_fans(uint32_t feature) const;
  /** Whether none of some vertices of obstacles that have a feature comes closer to a part. The nearest points have to be
   * unique and inside of both. Exact. */
  bool is_local_minimum(const Part<D>& part, const NearFeature& f, const uint32_t* around,
                        const uint32_t* around_end) const noexcept;
  Cell cell_at(const WallFeature& o) const noexcept { return o.facet.valid() ? env_.map.cell_of(o.facet) : o.cell; }
  /** Whether doubles tell that a pair is beyond reach, or that its nearest points lie outside. */
  bool is_far(const Part<D>& part, const NearFeature& f) const noexcept;
  /** Whether the nearest points of a part and a feature are unique and lie inside of both. Exactly. */
  bool are_inside(const Part<D>& part, const NearFeature& f) const noexcept;
  /** Where the two are nearest; whether that is within reach. */
  bool measure(const Part<D>& part, const NearFeature& f, NearPair<D>& pair) const noexcept;
  /** The normal of an obstacle that has a facet, into the passable cell. */
  Vec normal_of(uint32_t obstacle) const noexcept;
  static void corners_of(const NearList<D>& list, const NearFeature& f, const double** out) noexcept {
    for (uint32_t i = 0; i < f.count; ++i) out[i] = list.point(f.corners[i]);
  }

  const Environment<D>& env_;
  const NearList<D>& list_;
  const NearSelection<D>& near_;
  bool is_shifted_;
  double reach_, far_;  // far_: a little more
};

}  // namespace dsw
