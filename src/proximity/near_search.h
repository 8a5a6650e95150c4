#pragma once
// All near pairs of a body: which obstacles are near each of its parts is remembered from call to call.

#include "map/cell_queue.h"
#include "proximity/near_lists.h"
#include "proximity/near_pair.h"
#include "proximity/partners.h"
#include "proximity/sight.h"

namespace dsw {

/** A pair with an obstacle of the environment, or of another body. */
template <int D>
struct FoundPair : NearPair<D> {
  uint32_t partner = kNone;  // its number among the partners
};

template <int D>
class NearSearch {
 public:
  NearSearch(const Environment<D>& env, const Body<D>& body, NearNotes<D>& notes);

  /** Appends the pairs with obstacles of the environment within a distance. Throws std::bad_alloc. */
  void find_walls(double reach, Array<FoundPair<D>>& found);
  /** Appends the pairs with parts of a partner, which may be the body itself, within a distance. */
  void find_partner(const Partners<D>& partners, uint32_t number, double reach, Array<FoundPair<D>>& found);

 private:
  /** The cell at the end of the segment between the nearest points of a pair, which has the obstacle of the environment.
   * Invalid: the segment passes something impassable. Exact. */
  Cell look(const Part<D>& part, const NearList<D>& list, const NearPair<D>& pair);
  bool is_accepted(const Body<D>& other, const Part<D>& part, const uint32_t* corners, uint32_t count) const noexcept;
  void collect(const Body<D>& other, const Part<D>& cover, double reach);

  const Environment<D>& env_;
  const Body<D>& body_;
  NearNotes<D>& notes_;
  NearLists<D> lists_;
  NearList<D> others_;  // of a partner
  NearSelection<D> near_others_;
  CellQueue cells_;  // at the end of a sightline
  EdgeWalk<D> edge_;
  uint32_t walked_edge_ = kNone;  // which one that is
};

}  // namespace dsw
