#pragma once
// What one simplex of a body sweeps when one of its vertices moves [JCD10] 4.1: an edge a triangle, a face a
// tetrahedron. A sweep is decided without a look at the swept solid, or the solid is flooded. Those who ask want to know
// whether anything is met, what is met first, or all that is met.

#include "body/body.h"
#include "corridor/ask.h"
#include "corridor/box_probe.h"
#include "corridor/sweep.h"
#include "sweep/counts.h"
#include "sweep/touched_line.h"

namespace dsw {

/** Sweeps simplices; one for each thread. Throws std::bad_alloc. */
template <int D>
class SimplexSweep {
 public:
  explicit SimplexSweep(const Environment<D>& env) : env_(env), probe_(env), flood_(env) {}

  /** The path of a vertex, with which its sweeps begin. */
  CastResult cast_path(const Body<D>& body, uint32_t v, const double* to);
  /** Whether a cast or a flood has met the work limit since the last path. */
  bool is_limited() const noexcept { return limited_; }

  /** What is known of a sweep without a look at what is swept; counts edges.
   * @param ask_balls whether the balls of its ends have not been asked.
   * @param ridge null, or what is met first if it is not decided; see dsw::ask. */
  Verdict ask(const Body<D>& body, const MovingPart& sweep, bool ask_balls = true, FirstRidge* ridge = nullptr) {
    return sweep.part.kind == Simplex::kEdge ? ask_edge(body, sweep, ask_balls, ridge) : ask_face(sweep);
  }
  /** Decides an edge that is known to lie, with what it sweeps, in a free box. */
  Verdict count_boxed(const Body<D>& body) {
    ++counts.swept;
    counts.skipped += body.skipping.by_clearance || body.skipping.corridors ? 1 : 0;
    return Verdict::kBoxed;
  }

  /** Whether a sweep meets nothing. */
  bool passes(const Body<D>& body, const MovingPart& sweep) {
    return ask(body, sweep) != Verdict::kUnknown || is_free(body, sweep);
  }
  /** Tells whether a sweep that is not decided meets nothing. At EDGES only the edge's new place counts: the path of v
   * is free. */
  bool is_free(const Body<D>& body, const MovingPart& sweep);

  /** What a sweep meets first, whether it is decided or not. What comes after the event `before`, which may be null,
   * need not be found; nor anything at the work limit. The event borrows the points of the sweep. */
  bool find_first(const Body<D>& body, const MovingPart& sweep, const SweepEvent* before, SweepContact* found);

  /** What a sweep meets first that is not free. */
  SweepContact first_of(const MovingPart& sweep) { return flood(sweep).contact; }
  /** All that the sweep of an edge meets, in any order. Valid until the next call. */
  const Array<SweepContact>& find_all(const MovingPart& sweep) {
    flood(sweep.edge(), sweep.way.from, true);
    return flood_.all();
  }

  /** Whether a box is seen to be free from all of these cells: then nothing that is swept inside of it from one of them
   * meets anything. Not asked with a work limit, which is that of the cells that a sweep itself meets. */
  template <class... Cells>
  bool is_boxed(const Bounds<D>& box, Cell start, Cells... others) noexcept {
    return max_volumes == 0 && probe_.is_free(box, start) && (probe_.has_entered(others) && ...);
  }
  /** Whether what stopped an edge before stands in its way: then its sweep is most likely not free. */
  bool meets_touched_line(const Body<D>& body, const MovingPart& sweep) const noexcept {
    return max_volumes == 0 && pierces_touched_line(env_, body, sweep);
  }
  bool is_triangle_free(const EdgeMotion& m, Cell start) {
    return is_boxed(bounds<D>(m.p, m.to, m.q), start) || flood_until(m, start, 1).end == SweepEnd::kFree;
  }
  bool is_tetrahedron_free(const FaceMotion& m, Cell start) {
    if constexpr (D == 3) {
      return is_boxed(bounds<D>(m.p, m.to, m.q, m.r), start) || flood(m, start).end == SweepEnd::kFree;
    }
    return true;  // no body of the plane has faces
  }

  SweepCounts counts;
  CastCounters* counters = nullptr;  // of casts, and cells of floods; may stay null
  uint32_t max_volumes = 0;          // work limit of each cast and flood; 0: none

 private:
  template <class Motion, class... Collect>
  SweepResult flood(const Motion& m, Cell start, Collect... collect) {
    return count(flood_.sweep(m, start, max_volumes, collect...));
  }
  SweepResult flood(const MovingPart& sweep);
  SweepResult flood_until(const EdgeMotion& m, Cell start, double end);
  SweepResult count(const SweepResult& swept) {
    if (counters != nullptr) counters->volumes_visited += swept.volumes_visited;
    limited_ = limited_ || swept.end == SweepEnd::kWorkLimit;
    return swept;
  }
  Verdict ask_edge(const Body<D>& body, const MovingPart& edge, bool ask_balls, FirstRidge* ridge);
  Verdict ask_face(const MovingPart& face) const;
  bool find_first_of_face(const MovingPart& face, SweepContact* found);
  Question question(const Body<D>& body) const noexcept {
    Question what{sweeps_edges(body.level)};
    what.is_limited = max_volumes != 0;
    return what;
  }
  KeptOfEdge<D> kept_of(const Body<D>& body, const MovingPart& edge) noexcept {
    scratch_.counters = counters;
    KeptOfEdge<D> kept;
    if (body.keeps_corridors()) {
      kept.of_edges = &body.corridors;
      kept.edge = edge.part.index;
      kept.corridor = &body.corridors[kept.edge];
    }
    kept.call = body.call;
    return kept;
  }

  const Environment<D>& env_;
  bool limited_ = false;  // the work limit was met
  BoxProbe<D> probe_;
  SweepFlood<D> flood_;
  EdgeScratch<D> scratch_{env_.memory};
};

}  // namespace dsw
