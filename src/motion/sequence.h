#pragma once
// The sequence of facets that an edge passes through on its way: kept from move to move, it is the edge's own forecast.

#include "environment/environment.h"
#include "motion/cast.h"

namespace dsw {

/** Whether a segment from a point in `first` to a point in `last` leaves its cells through just these half-facets, all passable, each seen
 * from the cell that is left. Cells are exactly convex with flat facets. False also where a filter cannot tell: then the segment
 * must be cast. Much cheaper than a cast: nothing waits for a decision. O(count). */
bool follows(const Environment<3>& env, const double* from, const double* to, Cell first, Cell last,
             const uint32_t* facets, size_t count) noexcept;

/** A sequence as it was noted, or passed the other way round. */
struct SequenceView {
  const uint32_t* facets = nullptr;
  size_t count = 0;
  bool turned = false;
};

/** Whether the three sides of a triangle, a to b, b to c and c to a, lie in the same strip of cells: one of them passes what the two
 * others pass, one after the other. Each has been found by `follows`, so it passes every facet where all lines of that look the same
 * way; there the facet is convex, and the cells are, so the triangle lies in the strip and no edge of a cell pierces it. */
bool share_strip(const Map<3>& map, SequenceView ab, SequenceView bc, SequenceView ca) noexcept;

/** Notes the half-facets that casts pass. A cast allocates nothing: what finds no room makes the sequence unknown, and room for the
 * next time is made by `finish`. */
class SequenceWriter {
 public:
  explicit SequenceWriter(const Memory* memory) : facets_(Allocator<uint32_t>(memory)) { facets_.reserve(kFirstRoom); }

  /** Both must outlive the cast. */
  void attach(const Environment<3>& env, CastRequest& request) noexcept {
    env_ = &env;
    facets_.clear();
    passed_ = 0;
    request.crossing = write;
    request.crossing_user = this;
  }
  /** Copies the sequence of a cast that reached its target; an unknown one is a single kNoFacet. Throws std::bad_alloc. */
  void finish(Array<uint32_t>& sequence);

 private:
  static constexpr size_t kFirstRoom = 16;
  static void write(void* user, Cell from, uint32_t simplex, Cell to) noexcept;

  const Environment<3>* env_ = nullptr;
  Array<uint32_t> facets_;
  size_t passed_ = 0;
};

}  // namespace dsw
