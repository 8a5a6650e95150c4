#pragma once
// Distances that thick bodies keep while all vertices move at once.

#include "base/position.h"
#include "proximity/joined.h"
#include "proximity/obstacles_near.h"
#include "together/hull_ways.h"
#include "together/trajectory.h"

namespace dsw {

/** Something that comes too near to a part that moves. */
template <int D>
struct TooNearOnWay {
  double time = 1;  // up to which the distance is kept
  uint32_t trajectory = 0;
  Simplex part{};
  uint32_t other_trajectory = kNone;  // of a body that moves
  const Partner<D>* other = nullptr;  // null: the environment
  Simplex other_part{};
  WallFeature wall{};   // of the environment
  Vec normal;           // unit, from the other to the part, at that time
  Vec points[2];        // nearest to each other, of the part and of the other
  HullWays<D> ways{};   // of the pair, as long as nobody gets another end
  double wanted = 0;    // what is to be kept
  double distance = 0;  // at that time
};

/** See step_back of a touch. */
template <int D>
double step_back(const TooNearOnWay<D>& near) noexcept {
  double step = 1;
  for (uint32_t side = 0; side < 2; ++side) {
    for (uint32_t i = 0; i < near.ways.count[side]; ++i) {
      const double *const from = near.ways.start[side][i], *const to = near.ways.end[side][i];
      if (!is_same_place<D>(from, to)) step = std::min(step, first_step<D>(from, to, near.time));
    }
  }
  return step;
}

/** What of the environment comes near parts that no others cover: found together with what these touch. */
struct OuterWalls {
  struct Range {
    size_t first, end;
  };
  explicit OuterWalls(const Memory* memory) : walls(memory), ranges(memory) {}
  void clear() {
    walls.clear();
    ranges.clear();
  }
  Array<WallFeature> walls;
  Array<Range> ranges;  // of the parts, as for_each_outer visits them, trajectory after trajectory
};

/** Keeps its memory from call to call; one for each thread. Throws std::bad_alloc. */
template <int D>
class ThickWays {
  const Environment<D>& env_;  // the initializers below use it

 public:
  explicit ThickWays(const Environment<D>& env)
      : env_(env), flood_(env), list_(env.memory), grid_(env.memory), joined_(env.memory) {}

  /** Finds what can come too near on the whole ways.
   * @param found what of the environment can; null: it stands still, and is not known. Lives on. */
  void start(const Array<Trajectory<D>>& trajectories, bool bodies_meet, const OuterWalls* found);
  /** Finds it for parts whose vertices have new rooms, and for ways that have become others. */
  void start_again(const Array<Trajectory<D>>& trajectories);
  /** Whether any body has distances to keep. */
  bool is_needed() const noexcept { return !pairs_.empty() || !others_.empty(); }
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
  /** Appends each pair that comes too near on the ways to the ends, if one of these ways is new.
   * @param held the environment's points that go. */
  template <class Held>
  void find_all(const Array<Trajectory<D>>& trajectories, const Held& held, Array<TooNearOnWay<D>>& all) const {
    for_each_pair([&](const Pair& pair) {
      HullWays<D> ways{};
      if (!is_new_pair(trajectories, held, pair) || !set_ways(trajectories, pair, ways)) return;
      const double time = pair_time_kept(pair, ways, 1);
      if (time < 1) describe(pair, ways, time, all);
    });
  }
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
    mutable Vec known = Vec::Zero();  // the direction that was found last, from the other to the part
  };
  struct Outer {
    uint32_t trajectory;
    Simplex part;
    Box<D> box;
    size_t first_pair = 0, pair_end = 0, first_other = 0, other_end = 0;
  };
  template <class Visit>
  void for_each_pair(Visit visit) const {
    for (const Outer& outer : outers_) {
      for (size_t i = outer.first_pair; i < outer.pair_end; ++i) visit(pairs_[i]);
      for (size_t i = outer.first_other; i < outer.other_end; ++i) visit(others_[i]);
    }
  }
  template <class Held>
  bool is_new_pair(const Array<Trajectory<D>>& trajectories, const Held& held, const Pair& pair) const {
    const auto is_new_part = [&](uint32_t trajectory, const Simplex& part) {
      const Trajectory<D>& of = trajectories[trajectory];
      return is_new(of, SimplexCorners<D>(*of.motion.body, part));
    };
    return is_new_part(pair.trajectory, pair.part) ||
           (pair.other_trajectory != kNone && is_new_part(pair.other_trajectory, pair.other_part)) ||
           (pair.other == nullptr && held.has_new(walls_[pair.wall].vertices, walls_[pair.wall].count));
  }
  bool set_ways(const Array<Trajectory<D>>& trajectories, const Pair& pair, HullWays<D>& ways) const;
  double pair_time_kept(const Pair& pair, const HullWays<D>& ways, double most) const;
  void describe(const Pair& pair, const HullWays<D>& ways, double time, Array<TooNearOnWay<D>>& all) const;
  void find_walls(const Array<Trajectory<D>>& trajectories, uint32_t number);
  void add_wall(Outer& outer, const WallFeature& wall, double radius);
  void find_bodies(const Array<Trajectory<D>>& trajectories);
  void find_others(const Array<Trajectory<D>>& trajectories, uint32_t number);
  void find_still(const Array<Trajectory<D>>& trajectories, const Outer& outer);

  ObstacleFlood<D> flood_;
  NearList<D> list_;
  BoxGrid<D> grid_;
  Joined<D> joined_;
  Array<Outer> outers_{env_.memory};
  Array<Pair> pairs_{env_.memory}, others_{env_.memory};  // of parts and the environment, and of parts and bodies
  Array<WallFeature> walls_{env_.memory};
  Array<double> wall_ends_{env_.memory};  // three points for each wall
  const OuterWalls* found_ = nullptr;
  uint32_t boxed_ = 0;  // as many have been put in the grid
  bool bodies_meet_ = false;
};

}  // namespace dsw
