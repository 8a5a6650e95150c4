#pragma once
// What bodies that move at once touch of each other, of bodies that stand still, and of themselves. The shift is the
// same for all bodies and does not enter: every touch counts.

#include "proximity/near_edges.h"
#include "together/box_sweep.h"
#include "together/trajectory.h"

namespace dsw {

/** Keeps its memory from call to call; one for each thread. Throws std::bad_alloc and WorkOver. */
template <int D>
class BodyWays {
 public:
  explicit BodyWays(const Memory* memory)
      : segments_(memory), vertices_(memory), faces_(memory), pairs_(memory), hinges_(memory), near_(memory) {}

  /** Finds the pairs whose whole ways in the call come near each other.
   * @param drift null, or a way that is left out of all, since all vertices will make the same part of theirs: then fewer ways
   * come near each other. */
  void start(const Array<Trajectory<D>>& trajectories, bool bodies_meet, const double* drift = nullptr);
  /** Finds them for ways that have become others. */
  void start_again(const Array<Trajectory<D>>& trajectories) { start(trajectories, bodies_meet_); }
  /** Whether none of them touch on their ways. */
  bool is_free(const Array<Trajectory<D>>& trajectories) const;
  /** What is touched first. */
  void find_first(const Array<Trajectory<D>>& trajectories, Array<WayTouch<D>>& first) const;
  /** Appends what each pair touches first. */
  void find_all(const Array<Trajectory<D>>& trajectories, Array<WayTouch<D>>& all) const;

  PairWork* work = nullptr;

 private:
  /** A part of a trajectory, or of a body that stands still. */
  struct Side {
    uint32_t trajectory;  // kNone: it stands still
    const Partner<D>* name;
    Simplex part;
  };
  struct Pair {
    PairKind kind;
    Side sides[2];  // in the order of the points
  };
  /** Two edges of a trajectory with a common vertex, which comes first of the three. */
  struct Hinge {
    uint32_t trajectory, vertices[3], edges[2];
  };
  /** Boxes of the ways of parts of all trajectories, by number. */
  struct Ways {
    BoxGrid<D> grid;
    BoxSweep<D> sweep;
    bool sweeps = false;  // instead of the grid, which is empty then
    Array<Side> sides;
    Array<Box<D>> boxes;

    explicit Ways(const Memory* memory) : grid(memory), sweep(memory), sides(memory), boxes(memory) {}
    void clear();
    void add(const Trajectory<D>& of, uint32_t number, const Simplex& part, const double* drift);
    /** Gets ready for visits with `others`. */
    void fill(const Array<Box<D>>& others);
    /** Calls visit(number) for the boxes that overlap this one. */
    template <class Visit>
    void visit(const Box<D>& box, Visit visit) const {
      if (sweeps) return sweep.visit(box, visit);
      grid.visit(box, [&](uint32_t i) {
        visit(i);
        return true;
      });
    }
  };

  void add_ways(const Array<Trajectory<D>>& trajectories, bool with_segments, const double* drift);
  bool find_own_edges(const Array<Trajectory<D>>& trajectories);
  void find_segments(const Array<Trajectory<D>>& trajectories);
  void find_solids(const Array<Trajectory<D>>& trajectories);
  void find_hinges(const Array<Trajectory<D>>& trajectories);
  void find_still(const Array<Trajectory<D>>& trajectories);
  void meet_segments(const Side& segment, const Partner<D>& other, const Box<D>& box);
  void meet_solids(const Side& side, const Partner<D>& other, const Box<D>& box);
  void add_segments(const Side& a, const Side& b);
  void add_pair(PairKind kind, const Side& a, const Side& b) { pairs_.push_back({kind, {a, b}}); }
  template <class Visit>
  bool visit_pair(const Array<Trajectory<D>>& trajectories, const Pair& pair, Visit visit) const;
  template <class Visit>
  bool visit_touches(const Array<Trajectory<D>>& trajectories, Visit visit) const;

  Ways segments_, vertices_, faces_;  // segments: edges and vertices without edges
  Array<Pair> pairs_;
  Array<Hinge> hinges_;
  NearEdges near_;
  bool bodies_meet_ = false;
};

}  // namespace dsw
