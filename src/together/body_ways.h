#pragma once
// What bodies that move at once touch of each other, of bodies that stand still, and of themselves. The shift is the
// same for all bodies and does not enter: every touch counts.

#include "predicates/moving_hinge.h"
#include "proximity/near_edges.h"
#include "together/box_sweep.h"
#include "together/step_pairs.h"
#include "together/trajectory.h"

namespace dsw {

/** Keeps its memory from call to call; one for each thread. Throws std::bad_alloc and WorkOver. */
template <int D>
class BodyWays {
 public:
  explicit BodyWays(const Memory* memory)
      : vertex_boxes_(memory),
        sides_(memory),
        segments_(memory),
        vertices_(memory),
        faces_(memory),
        sweep_(memory),
        pairs_(memory),
        near_(memory),
        step_pairs_(memory),
        spokes_(memory) {}

  /** Finds the pairs whose whole ways in the call come near each other.
   * @param drift null, or a way that is left out of all, since all vertices will make the same part of theirs: then fewer ways
   * come near each other. */
  void start(const Array<Trajectory<D>>& trajectories, bool bodies_meet, const double* drift = nullptr);
  /** Finds them for ways that have become others. */
  void start_again(const Array<Trajectory<D>>& trajectories) { start(trajectories, bodies_meet_); }
  /** Whether there are no pairs that come near each other. */
  bool are_alone() const noexcept {
    return pairs_.empty() && (!has_hinges_ || (lists_hinges_ && step_pairs_.hinges().empty()));
  }
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
    Simplex part;
    SimplexCorners<D> corners;
    const Partner<D>* name;

    Side(uint32_t of, const Partner<D>& body_name, const Simplex& each)
        : trajectory(of), part(each), corners(*body_name.body, each), name(&body_name) {}
    bool has_corner(uint32_t v) const {
      bool has = corners.vertices[0] == v;
      for (uint32_t i = 1; i < corners.count; ++i) has |= corners.vertices[i] == v;
      return has;
    }
  };
  struct Pair {
    PairKind kind;
    uint32_t sides[2];  // in the order of the points
  };
  /** An edge at a vertex, in space. */
  struct Spoke {
    uint32_t edge, far;
    HingeArm arm;

    Spoke(const Trajectory<D>& of, uint32_t v, uint32_t e)
        : edge(e),
          far(of.motion.body->edges[e].other(v)),
          arm({of.start(v), of.end(v)}, {of.start(far), of.end(far)}) {}
  };
  /** Boxes of the ways of parts of all trajectories, and their numbers in sides_. */
  struct Ways {
    Array<uint32_t> sides;
    Array<Box<D>> boxes;

    explicit Ways(const Memory* memory) : sides(memory), boxes(memory) {}
    void clear() {
      sides.clear();
      boxes.clear();
    }
  };

  void box_vertices(const Trajectory<D>& of);
  void add_ways(const Array<Trajectory<D>>& trajectories, bool with_segments);
  void find_step_pairs(const Array<Trajectory<D>>& trajectories, const double* drift);
  bool find_own_edges(const Array<Trajectory<D>>& trajectories);
  void find_segments(const Array<Trajectory<D>>& trajectories);
  void find_solids(const Array<Trajectory<D>>& trajectories);
  void find_lone_edges(const Array<Trajectory<D>>& trajectories);
  void find_still(const Array<Trajectory<D>>& trajectories);
  void meet_segments(uint32_t side, const Partner<D>& other, const Box<D>& box);
  void meet_solids(uint32_t side, const Partner<D>& other, const Box<D>& box);
  void add_segments(uint32_t a, uint32_t b);
  uint32_t add_side(uint32_t trajectory, const Partner<D>& name, const Simplex& part);
  void add_pair(PairKind kind, uint32_t a, uint32_t b) { pairs_.push_back({kind, {a, b}}); }
  template <class Visit>
  bool visit_pair(const Array<Trajectory<D>>& trajectories, PairKind kind, const Side& a, const Side& b,
                  Visit visit) const;
  template <class Visit>
  bool visit_hinge(const Array<Trajectory<D>>& trajectories, uint32_t number, const Spoke& a, const Spoke& b,
                   Visit visit) const;
  template <class Visit>
  bool visit_listed_hinges(const Array<Trajectory<D>>& trajectories, Visit visit) const;
  template <class Visit>
  bool visit_hinges(const Array<Trajectory<D>>& trajectories, uint32_t number, Visit visit) const;
  template <class Visit>
  bool visit_touches(const Array<Trajectory<D>>& trajectories, Visit visit) const;

  Array<Box<D>> vertex_boxes_;  // of the ways of one trajectory
  Array<Side> sides_;
  Ways segments_, vertices_, faces_;  // segments: edges and vertices without edges
  BoxSweep<D> sweep_;
  Array<Pair> pairs_;
  NearEdges near_;
  StepPairs<D> step_pairs_;      // if all vertices make the same part of their ways
  mutable Array<Spoke> spokes_;  // of one vertex
  bool has_hinges_ = false;
  bool lists_hinges_ = false;  // those of step_pairs_ are all that there are
  bool bodies_meet_ = false;
};

}  // namespace dsw
