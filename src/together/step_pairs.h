#pragma once
// Which parts of bodies may touch each other while all vertices make the same part of straight steps.

#include "together/box_sweep.h"
#include "together/shadows.h"
#include "together/trajectory.h"

namespace dsw {

/** Keeps its memory from call to call. Throws std::bad_alloc. */
template <int D>
class StepPairs {
 public:
  struct Part {
    uint32_t trajectory;
    Simplex simplex;
  };
  struct Pair {
    PairKind kind;
    Part parts[2];  // in the order of the points
  };
  /** Two edges with a common vertex: the far end of each may touch the other one. */
  struct Hinge {
    uint32_t trajectory, vertex, edges[2];
  };

  explicit StepPairs(const Memory* memory)
      : first_(memory),
        boxes_(memory),
        steps_(memory),
        shadows_(memory),
        segments_(memory),
        vertices_(memory),
        faces_(memory),
        sweep_(memory),
        near_(memory),
        spokes_(memory),
        pairs_(memory),
        hinges_(memory) {}

  /** Finds them for ways up to where the trajectories go in the call.
   * @param drift what is left out of all ways: then fewer of them come near each other. */
  void find(const Array<Trajectory<D>>& trajectories, const double* drift);
  const Array<Pair>& pairs() const noexcept { return pairs_; }
  const Array<Hinge>& hinges() const noexcept { return hinges_; }

 private:
  using Steps = typename BoxSweep<D>::Steps;
  /** A part, and its corners among the vertices of all trajectories. */
  struct Way {
    Part part;
    uint32_t corners[3];
  };
  struct Ways {
    Array<Way> all;
    Array<Steps> steps;  // of their boxes
    explicit Ways(const Memory* memory) : all(memory), steps(memory) {}
    void start(size_t most) {
      all.clear();
      steps.clear();
      all.reserve(most);
      steps.reserve(most);
    }
    void add(const Way& way, const Steps& box) {
      all.push_back(way);
      steps.push_back(box);
    }
  };
  struct Spoke {
    uint32_t edge;
    typename Shadows<D>::Sides sides;
  };

  void place_vertices(const Array<Trajectory<D>>& trajectories, const double* drift);
  void add_ways(const Array<Trajectory<D>>& trajectories);
  void note_segments(const Array<Trajectory<D>>& trajectories, const Way& way, const uint32_t* others, uint32_t count);
  void note_solid(const Array<Trajectory<D>>& trajectories, const Way& vertex, const Way& solid);
  void find_segments(const Array<Trajectory<D>>& trajectories);
  void find_solids(const Array<Trajectory<D>>& trajectories);
  void find_hinges(const Array<Trajectory<D>>& trajectories);

  Array<uint32_t> first_;  // vertices of each trajectory among all
  Array<Box<D>> boxes_;    // of the ways of all vertices
  Array<Steps> steps_;     // of these boxes
  Shadows<D> shadows_;
  Ways segments_, vertices_, faces_;  // segments: edges and vertices without edges
  BoxSweep<D> sweep_;
  Array<uint32_t> near_;  // segments near one that have no vertex of it
  Array<Spoke> spokes_;   // of one vertex
  bool all_meet_ = false;
  Array<Pair> pairs_;
  Array<Hinge> hinges_;
};

}  // namespace dsw
