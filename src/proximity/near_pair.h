#pragma once
// Pairs of a part of a body and an obstacle that are nearest to each other there. Signs decide which pairs there are;
// doubles say where.

#include "base/vec.h"
#include "body/box.h"
#include "body/simplices.h"
#include "proximity/near_list.h"

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

template <int D>
struct NearPair {
  Simplex part;
  uint32_t vertices[3] = {kNone, kNone, kNone};           // of the part
  uint32_t obstacle_vertices[3] = {kNone, kNone, kNone};  // of the obstacle, ascending
  NearFeature feature{};                                  // the obstacle in its list
  double weights[3] = {}, obstacle_weights[3] = {};
  double point[3] = {};  // of the part
  double obstacle_point[3] = {};
  double normal[3] = {};  // unit, from the obstacle to the part
  double distance = 0;
  HalfFacet wall;             // an impassable facet at the obstacle, see find_wall; else invalid
  bool is_wall_seen = false;  // the point is on the passable side of its triangle
  Cell cell;                  // of a marked edge or vertex: a cell at it
};

/** Of each vertex of a list: beyond which sides of a box it is. One box is that of a part, enlarged by the reach, the
 * other that of the way between two points. */
struct PairScratch {
  Array<uint8_t> of_part, of_way;

  explicit PairScratch(const Memory* memory) : of_part(memory), of_way(memory) {}
};

/** Finds the pairs of parts with obstacles of one list. What is found does not depend on the order of the list. */
template <int D>
class PairSearch {
 public:
  /** @param is_shifted the list is of the environment. @param reach largest distance. Throws std::bad_alloc. */
  PairSearch(const Environment<D>& env, const NearList<D>& list, bool is_shifted, double reach, PairScratch& scratch);

  /** Calls visit(pair) for the pairs with features for which accept(feature) is true. */
  template <class Accept, class Visit>
  void find(const Part<D>& part, Accept accept, Visit visit) const {
    note_part(part);
    const uint32_t most = D + 1 - part.corners.count;
    for (const NearFeature& f : list_.features()) {
      if (f.count > most || is_beyond(f) || is_far(part, f) || !accept(f)) continue;
      if (!are_inside(part, f) || !is_local_minimum(part, f)) continue;
      NearPair<D> pair;
      if (measure(part, f, pair)) visit(pair);
    }
  }
  /** Whether doubles tell that no triangle of the list lies between the points of a pair. */
  bool is_clear(const NearPair<D>& pair) const noexcept;

 private:
  void note_part(const Part<D>& part) const noexcept;
  void note_beyond(const Box<D>& box, Array<uint8_t>& beyond) const noexcept;
  bool is_beyond(const NearFeature& f) const noexcept {
    uint32_t all = scratch_.of_part[f.corners[0]];
    for (uint32_t i = 1; i < f.count; ++i) all &= scratch_.of_part[f.corners[i]];
    return all != 0;
  }
  /** Whether doubles tell that a pair is beyond reach, or that its nearest points lie outside. */
  bool is_far(const Part<D>& part, const NearFeature& f) const noexcept;
  /** Whether the nearest points of a part and a feature are unique and lie inside of both. Exactly. */
  bool are_inside(const Part<D>& part, const NearFeature& f) const noexcept;
  /** Then, whether no obstacle that has the feature comes closer to the point of the part. Exactly. */
  bool is_local_minimum(const Part<D>& part, const NearFeature& f) const noexcept;
  /** Where the two are nearest; whether that is within reach. */
  bool measure(const Part<D>& part, const NearFeature& f, NearPair<D>& pair) const noexcept;
  /** The facet with a feature that makes the least angle with the way to the point. Of several, the lowest one from
   * whose passable side the point is seen, else the lowest one. What else is in the list does not matter. Returns the
   * number of the obstacle. */
  uint32_t find_wall(const NearFeature& f, NearPair<D>& pair) const noexcept;
  /** Of an obstacle with a facet, into the passable cell. */
  Vec normal_of(uint32_t obstacle) const noexcept;
  void corners_of(const NearFeature& f, const double** out) const noexcept {
    for (uint32_t i = 0; i < f.count; ++i) out[i] = list_.point(f.corners[i]);
  }

  const Environment<D>& env_;
  const NearList<D>& list_;
  bool is_shifted_;
  double reach_, far_;  // far_: a little more
  PairScratch& scratch_;
};

}  // namespace dsw
