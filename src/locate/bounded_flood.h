#pragma once
// What the floods of nearest.h find, with bounds in place of most distances.
//
// The key of a passable facet is its rounded distance, computed in the cell that is left. The level of a cell
// is the least number L for which facets with keys up to L lead to it from a cell where the flood starts. Let `end` be
// the least number for which a cell of a level up to `end` sees an obstacle at a distance up to `end`. The answer
// is the nearest obstacle that cells of levels up to `end` see, ties by name. The flood finds it, because it
// enters these cells and no others.
//
// Here a cell is entered if the lower bound of a facet's distance is within `limit`. The limit goes down to upper
// bounds of the distances of obstacles that are seen, reached or not. At the end it is still at least as large as each
// distance d for which it is used below. So all cells of levels up to d have been entered, and some more, in whatever
// order, and all obstacles have been measured that these cells see within d.
//
// Obstacles are taken in the order of their distances d, and for each d it is asked which of them, up to d, cells of
// levels up to d see. Let d be the first for which there are any.
// - If they are at distance d, then `end` is d: no smaller number will do. The lowest name among them is the answer.
// - If exactly one is nearer, then `end` is the level of the cell that sees it, at most d. That one is the answer.
// - If several are nearer, their levels decide, which are not known here: the flood is asked.
//
// A facet's upper bound mostly tells that its key is small enough. Where it does not, the key is computed. Both are
// distances of the same facet, so this relies on rounding errors of distances being below 2^-17 of the facet's
// coordinates as seen from what is asked; they are some 2^-49.

#include <type_traits>

#include "locate/facet_bounds.h"
#include "locate/nearest_search.h"
#include "locate/segment_distances.h"

namespace dsw {

/** What a bounded flood writes down, for points or segments. */
class BoundedNotes : public FloodNotes {
 public:
  static constexpr uint32_t kNone = 0xffffffffu;
  /** A facet of an entered cell within the limit: a way into the next cell, or an obstacle. */
  struct Entry {
    float lower, upper;  // bounds of its distance
    uint32_t facet;      // a half-facet of the next cell; of an obstacle that of the entered cell, with kMarkBit
    uint32_t from;       // the step to the entered cell
  };
  /** A cell that was entered. */
  struct Step {
    Cell cell;
    HalfFacet facet;  // of this cell, by which it was entered
    float upper;      // as above, of this facet
    uint32_t from;    // the step to the cell on the other side; kNone: the flood starts in this one
    uint32_t search;  // the last one that came here
  };
  /** An obstacle that was measured. */
  template <class Way>
  struct Sight {
    double distance;
    Way at;
    FeatureRef feature;
    uint32_t view;  // the last one
  };
  /** A cell that sees an obstacle. */
  struct View {
    uint32_t step;    // to the cell
    uint32_t before;  // of the same obstacle, or kNone
  };

  explicit BoundedNotes(const Memory* memory)
      : FloodNotes(memory),
        starts(memory),
        now(memory),
        later(memory),
        steps(memory),
        views(memory),
        back(memory),
        point_sights_(memory),
        segment_sights_(memory) {}

  Array<Cell> starts;
  Array<Entry> now, later;
  Array<Step> steps;
  Array<View> views;
  Array<uint32_t> back;  // steps from whose cells a search goes on

  template <class Way>
  Array<Sight<Way>>& sights() {
    if constexpr (std::is_same_v<Way, Vec>) {
      return point_sights_;
    } else {
      return segment_sights_;
    }
  }

 private:
  Array<Sight<Vec>> point_sights_;
  Array<Sight<SegmentWay>> segment_sights_;
};

template <int D, class From>
class BoundedFlood {
 public:
  BoundedFlood(const Distances<D, From>& distances, double radius, BoundedNotes& notes, typename From::Result& result);

  /** From `notes.starts`. Unknown: only the flood knows, or more than `most` cells were entered. May throw
   * std::bad_alloc. */
  SearchEnd run(uint32_t most = kNoCell);
  /** Whether `most` ended it. */
  bool is_cut_off() const { return is_cut_off_; }

 private:
  using Way = typename From::Way;
  using Notes = BoundedNotes;
  using Entry = Notes::Entry;
  using Step = Notes::Step;
  using Sight = Notes::Sight<Way>;
  static constexpr uint32_t kMostTogether = 8;  // tetrahedra whose bounds are found together

  void set_limit(double limit);
  bool go_on();
  void look_ahead();
  void enter(const Step& step);
  void visit_tetrahedra();
  void visit_any(uint32_t step);
  void take(uint32_t step, HalfFacet h, float lower, float upper);
  void measure(HalfFacet h, uint32_t step);
  void note_sight(double distance, const Way& at, const FeatureRef& feature, uint32_t step);
  SearchEnd decide();
  bool is_reached(const Sight& sight, double limit);
  bool is_reached(uint32_t step, double limit);
  bool is_reached_otherwise(uint32_t step, double limit);
  bool is_within(HalfFacet h, double limit) const;

  const Distances<D, From>& distances_;
  const Environment<D>& env_;
  const Map<D>& map_;
  const BoundsKernel<D>& kernel_;
  Notes& notes_;
  Array<Sight>& sights_;
  typename From::Result& result_;
  const bool has_thin_;  // marked edges or vertices
  double radius_, largest_, limit_;
  SegmentFrame<D> frame_;
  float bound_ = 0;  // the limit, scaled and rounded up
  uint32_t search_ = 0;
  bool is_cut_off_ = false;
  // Tetrahedra that were entered and not yet visited.
  uint32_t waiting_ = 0, waiting_steps_[kMostTogether];
  const double* waiting_vertices_[4 * kMostTogether];
};

}  // namespace dsw
