#pragma once
// Distances that thick bodies keep while all vertices move at once.

#include "predicates/hull_gap.h"
#include "proximity/joined.h"
#include "proximity/obstacles_near.h"
#include "together/trajectory.h"

namespace dsw {

/** The points of a pair at both ends of its way. */
template <int D>
struct HullWays {
  const double* start[2][4];
  const double* end[2][4];
  uint32_t count[2];
  uint32_t first = 0;  // which of the two is the pair's first
};

/** Up to which time, at most `most`, two hulls keep a distance while their points go straight and steadily: certified, so at
 * most the true time. 0: it is not certain from the start on. */
template <int D>
double time_kept(const HullWays<D>& ways, double accepted, double most) noexcept;

/** Something that comes too near to a part that moves. */
template <int D>
struct TooNearOnWay {
  double time = 1;  // up to which the distance is kept
  uint32_t trajectory = 0;
  Simplex part{};
  uint32_t other_trajectory = kNone;  // of a body that moves
  const Partner<D>* other = nullptr;  // null: the environment
  Simplex other_part{};
  WallFeature wall{};  // of the environment
  Vec normal;          // unit, from the other to the part, at that time
  Vec points[2];       // nearest to each other, of the part and of the other
};

/** Keeps its memory from call to call; one for each thread. Throws std::bad_alloc. */
template <int D>
class ThickWays {
  const Environment<D>& env_;  // the initializers below use it

 public:
  explicit ThickWays(const Environment<D>& env)
      : env_(env), flood_(env), list_(env.memory), grid_(env.memory), joined_(env.memory) {}

  /** Finds what can come too near on the whole ways.
   * @param next where the environment's points go; null: they stand still. */
  void start(const Array<Trajectory<D>>& trajectories, bool bodies_meet, const double* next);
  /** Whether any body has distances to keep. */
  bool is_needed() const noexcept { return !pairs_.empty(); }
  /** Tells where the ways of the environment's points end. */
  template <class Walls>
  void set_wall_ends(const Walls& walls) {
    wall_ends_.resize(3 * D * walls_.size());
    for (size_t w = 0; w < walls_.size(); ++w) {
      for (uint32_t i = 0; i < walls_[w].count; ++i) walls.place(walls_[w].vertices[i], &wall_ends_[D * (3 * w + i)]);
    }
  }
  /** Up to which time, at most `most`, all distances are kept on the ways to the ends; `first` is what comes too near then. */
  double find_first(const Array<Trajectory<D>>& trajectories, double most);
  Array<TooNearOnWay<D>> first{env_.memory};

 private:
  /** A part that moves, and what may come too near. */
  struct Pair {
    uint32_t trajectory;
    Simplex part;
    uint32_t other_trajectory;
    const Partner<D>* other;
    Simplex other_part;
    uint32_t wall;  // in walls_
    double wanted;
  };
  struct Outer {
    uint32_t trajectory;
    Simplex part;
    Box<D> box;
  };
  bool set_ways(const Array<Trajectory<D>>& trajectories, const Pair& pair, HullWays<D>& ways) const;
  void describe(const Pair& pair, const HullWays<D>& ways, double time);
  void add_outers(const Array<Trajectory<D>>& trajectories);
  void find_walls(const Array<Trajectory<D>>& trajectories, const Outer& outer);
  void find_others(const Array<Trajectory<D>>& trajectories, uint32_t number);
  void find_still(const Array<Trajectory<D>>& trajectories, const Outer& outer);

  ObstacleFlood<D> flood_;
  NearList<D> list_;
  BoxGrid<D> grid_;
  Joined<D> joined_;
  Array<Outer> outers_{env_.memory};
  Array<Pair> pairs_{env_.memory};
  Array<WallFeature> walls_{env_.memory};
  Array<double> wall_ends_{env_.memory};  // three points for each wall
};

/** Calls visit(trajectory, vertex) for the vertices of the call's bodies that come too near. */
template <int D, class Visit>
void for_each_near(const Array<Trajectory<D>>& trajectories, const TooNearOnWay<D>& near, Visit visit) {
  const Trajectory<D>& of = trajectories[near.trajectory];
  for (const uint32_t v : SimplexCorners<D>(*of.motion.body, near.part)) visit(of, v);
  if (near.other_trajectory == kNone) return;
  const Trajectory<D>& other = trajectories[near.other_trajectory];
  for (const uint32_t v : SimplexCorners<D>(*other.motion.body, near.other_part)) visit(other, v);
}

}  // namespace dsw
