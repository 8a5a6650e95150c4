#pragma once
// The nearest impassable thing round a point or a segment, found by a flood through passable cells, or by a tree of
// obstacles: what haptics ask for.

#include "base/memory.h"
#include "locate/classify.h"

namespace dsw {

struct NearestResult {
  double distance = 0;
  double point[3] = {};          // of the obstacle; in the plane the third is 0, as below
  double normal[3] = {};         // unit, towards the asked point; zero at distance 0
  FeatureRef feature;            // canonical: facet, marked edge (in space) or marked vertex
  uint32_t volumes_visited = 0;  // how many cells were looked at; the tree looks at other ones than the flood
};

/** What is nearest to a segment. */
struct SegmentNearest : NearestResult {
  double parameter = 0;          // of the nearest point of the segment: 0 .. 1
  double segment_point[3] = {};  // this point
  HalfFacet crossed;             // the impassable facet that the segment passes, from its first side; else invalid
  Cell last;                     // contains the segment's last point, unless it passes something impassable
};

/** A cell to visit, and how near it may hold something. The nearest is first in a heap. */
struct Waiting {
  double distance;
  uint32_t index;  // of the cell: the order of ties must not depend on where records lie
  bool operator<(const Waiting& o) const { return distance != o.distance ? distance > o.distance : index > o.index; }
};

/** What a flood writes down. It is kept from one question to the next, so that most need no memory. */
class FloodNotes {
 public:
  explicit FloodNotes(const Memory* memory) : waiting(memory), slots_(kFirstSlots, Slot{}, memory) {}

  Array<Waiting> waiting;  // a heap

  void clear() noexcept;
  /** Notes that a cell was seen, and a number; whether it is new. Open addressing, at most half full. Throws
   * std::bad_alloc. */
  bool see(Cell c, uint32_t number = 0) {
    if (2 * (seen_count_ + 1) > slots_.size()) grow();
    Slot& slot = slots_[slot_of(entry(c.unit))];
    if (slot.entry == entry(c.unit)) return false;
    slot = {entry(c.unit), number};
    ++seen_count_;
    return true;
  }
  bool is_seen(Cell c) const noexcept { return slots_[slot_of(entry(c.unit))].entry == entry(c.unit); }
  /** The number of a cell that was seen. */
  uint32_t number_of(Cell c) const noexcept { return slots_[slot_of(entry(c.unit))].number; }

 private:
  static constexpr size_t kFirstSlots = 256;
  struct Slot {
    uint64_t entry = 0;  // the round in which a cell was seen, and its unit; other rounds are empty slots
    uint32_t number = 0;
  };

  void grow();
  uint64_t entry(uint32_t unit) const noexcept { return uint64_t{round_} << 32 | unit; }
  size_t slot_of(uint64_t entry) const noexcept {
    const size_t mask = slots_.size() - 1;
    size_t slot = (static_cast<uint32_t>(entry) * 0x9e3779b1u) & mask;
    while (slots_[slot].entry >> 32 == round_ && slots_[slot].entry != entry) slot = (slot + 1) & mask;
    return slot;
  }

  Array<Slot> slots_;
  size_t seen_count_ = 0;
  uint32_t round_ = 1;
};

/** Whether something impassable that can be seen from `point`, in `start`, lies within `radius`. Cells are visited in
 * the order of their distance, so the work is that of the cells nearer than the answer. Equal distances: the lower
 * dimension, then the lower canonical cell. May throw std::bad_alloc. */
template <int D>
bool find_nearest(const Environment<D>& env, const double* point, Cell start, double radius, NearestResult& result);
template <int D>
bool find_nearest_by_flood(const Environment<D>& env, const double* point, Cell start, double radius, FloodNotes& notes,
                           NearestResult& result);

class BoundedNotes;

/** Gives the answer of find_nearest, mostly sooner. Bounds are tried first (bounded_flood.h). After a few cells the
 * environment's tree of obstacles is asked, if there is one (nearest_search.h). */
template <int D>
bool find_nearest_far(const Environment<D>& env, const double* point, Cell start, double radius, BoundedNotes& notes,
                      NearestResult& result);

/** Finds the impassable thing that is nearest to a segment whose first point is in `start`. If the segment passes
 * impassable facets, the first of them is the answer, at distance 0. Else the answer is what the flood finds that
 * begins in all cells which the segment enters under the shift; bounded_flood.h finds it faster in most cases. A
 * segment without a length is asked as a point.
 * @param by_flood asks the flood alone. */
template <int D>
bool find_nearest_to_segment(const Environment<D>& env, const double* from, const double* to, Cell start, double radius,
                             BoundedNotes& notes, SegmentNearest& result, bool by_flood = false);

}  // namespace dsw
