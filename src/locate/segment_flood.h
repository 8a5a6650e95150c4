#pragma once
// What a segment's flood finds (nearest.h), with bounds in place of most distances.
//
// The key of a passable facet is its rounded distance. The level of a cell is the least number L for which facets with
// keys up to L lead to it from a cell that the segment enters. Let `end` be the least number for which a cell of a level
// up to `end` sees an obstacle at a distance up to `end`. The answer is the nearest obstacle that cells of levels up to
// `end` see, ties by name. The flood finds it: it enters these cells, and no others.
//
// Here cells are entered by lower bounds of keys, the lowest first, within `limit`, which is an upper bound of the
// nearest obstacle's distance, reached or not. So all cells of levels up to `limit` are entered, and some more. All
// obstacles are measured that they see within `limit`. Then obstacles are asked in the order of their distances d
// whether facets with keys up to d lead to them or to a nearer one. The first d for which that is so is `end`, or it is
// between the d before and this one; then exactly one nearer obstacle is reached, or nobody knows.
//
// A facet's upper bound mostly tells that its key is small enough. Where it does not, the key is computed.

#include "locate/facet_bounds.h"
#include "locate/nearest_search.h"
#include "locate/segment_distances.h"

namespace dsw {

class SegmentNotes : public FloodNotes {
 public:
  static constexpr uint32_t kNone = 0xffffffffu;
  /** A facet of an entered cell within the limit: a way into the next cell, or an obstacle. */
  struct Step {
    double lower, upper;  // of its distance
    HalfFacet facet;      // seen from the cell of step `from`
    uint32_t from;        // kNone: the segment enters `cell`
    Cell cell;            // to enter; invalid behind an obstacle
    uint32_t search = 0;  // the last one that came to the cell
  };
  struct Sight {
    double distance;
    SegmentWay at;
    FeatureRef feature;
    uint32_t view;  // the last one
  };
  /** A cell that sees an obstacle. */
  struct View {
    uint32_t step;    // by which the cell was entered
    uint32_t before;  // of the same obstacle, or kNone
  };

  explicit SegmentNotes(const Memory* memory)
      : FloodNotes(memory), starts(memory), queue(memory), steps(memory), sights(memory), views(memory), back(memory) {}

  Array<Cell> starts;     // which the segment enters
  Array<uint64_t> queue;  // a heap: the upper half of a lower bound, and a step
  Array<Step> steps;
  Array<Sight> sights;
  Array<View> views;
  Array<uint32_t> back;  // steps from whose cells a search goes on
};

template <int D>
class SegmentFlood {
 public:
  SegmentFlood(const Distances<D, FromSegment<D>>& distances, double radius, SegmentNotes& notes,
               SegmentNearest& result);

  /** From `notes.starts`. Unknown: only the flood knows. May throw std::bad_alloc. */
  SearchEnd run();

 private:
  using Notes = SegmentNotes;
  using Step = Notes::Step;
  using Sight = Notes::Sight;

  void visit(uint32_t step);
  void visit_tetrahedron(uint32_t step);
  void visit_any(uint32_t step);
  Cell beyond(HalfFacet h) const;
  void take(uint32_t step, HalfFacet h, Cell beyond, double lower, double upper);
  void push(const Step& next);
  static uint64_t key(double lower) noexcept;
  void measure(const Step& step);
  void note_sight(double distance, const SegmentWay& at, const FeatureRef& feature, uint32_t step);
  SearchEnd decide();
  bool is_reached(const Sight& sight, double limit);
  bool is_reached(uint32_t step, double limit);
  bool is_reached_otherwise(uint32_t step, double limit);
  bool is_within(HalfFacet h, double limit) const;

  const Distances<D, FromSegment<D>>& distances_;
  const Environment<D>& env_;
  const Map<D>& map_;
  const BoundsKernel<D>& kernel_;
  Notes& notes_;
  SegmentNearest& result_;
  SegmentFrame frame_;
  double radius_, limit_, largest_ = 0;
  uint32_t search_ = 0;
};

}  // namespace dsw
