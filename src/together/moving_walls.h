#pragma once
// What of an environment whose points move bodies touch, when all of their vertices and all of these points move at once.

#include "dartsweep/deform.h"
#include "proximity/obstacles_near.h"
#include "together/held_points.h"
#include "together/thick_ways.h"

namespace dsw {

/** Stands for WallWays in WholeWays. Throws std::bad_alloc and WorkOver. */
template <int D>
class MovingWalls {
  const Environment<D>& env_;

 public:
  explicit MovingWalls(const Environment<D>& env) : env_(env), flood_(env), arrival_flood_(env), list_(env.memory) {}

  /** The environment's points go straight from where they are to those in way.nexts(). Cells that are met and do not stay valid on the
   * way are appended to `invalid`. */
  void begin(PointsWay<D>& way, Array<dsw_volume_id>& invalid) noexcept;
  /** Finds what comes near the whole ways of all parts in the call, and in the rooms of those that are led. Throws NON_FINITE
   * also. */
  void start(Array<Trajectory<D>>& trajectories);
  /** From now on the points go straight on to these, beyond the ends of the ways that were collected. */
  void set_next(const double* points) noexcept { next_ = points; }
  /** Whether all cells that are met stay valid. */
  bool stay_valid() const noexcept { return stay_valid_; }
  /** From now on the ways end at a fraction of the whole ways. */
  void set_end(double time);
  /** In place of begin() for a search of a fraction: the points' steps, and where these lead. */
  void begin_steps(const double* steps, const double* next, Array<dsw_volume_id>& invalid);
  /** From now on the ways end where that part of the steps leads. */
  void set_step_end(double fraction);
  /** Whether all cells that are met stay valid on the ways to there. */
  bool stays_valid_to_ends() const;
  /** Whether what touches at its start is free on the way to its end, under the shift. */
  bool is_kept_free(const WayTouch<D>& touch) const;
  static bool notes_paths(const Body<D>&) noexcept { return false; }
  const double* nexts() const noexcept { return next_; }
  /** Where the way of a vertex of the environment ends. */
  void place(uint32_t v, double* at) const;
  bool is_free(const Array<Trajectory<D>>& trajectories);
  void find_first(const Array<Trajectory<D>>& trajectories, Array<WayTouch<D>>& first);
  /** Appends what each pair of a part and a feature touches first, of those with something new. */
  void find_all(const Array<Trajectory<D>>& trajectories, Array<WayTouch<D>>& all);

  OuterWalls near_outers{env_.memory};  // what comes near thick ones

  // Points whose ways are shortened, each for itself.
  HeldPoints<D> held{env_};
  /** Finds what comes near the parts whose vertices have new rooms, and the cells that are met there. */
  void collect_again(Array<Trajectory<D>>& trajectories);
  /** Leaves what is beyond the ways out of the rooms: from now on cells are met that have to stay valid with points that are
   * held, and no more of these than need be. */
  void tighten(Array<Trajectory<D>>& trajectories);
  /** Where the points of a touch of the environment go. They live on. */
  template <class Touch>
  void find_goals(const Touch& touch, const double** goals) const {
    for (uint32_t i = 0; i < touch.wall.count; ++i) goals[i] = next_ + size_t{D} * touch.wall.vertices[i];
  }
  /** See HeldPoints. */
  void start_round() noexcept { held.start_round(); }
  /** The points of a round have been shortened. */
  void finish_round() {
    held.keep_valid(checked_);
    if (held.any_held() || time_ != 1) set_end(1);
  }
  /** When the environment has its points of the end, which are rounded: whether all cells that are met stay valid on
   * the straight way there from `start`. Those that do not are appended to `invalid` of begin(). */
  bool stayed_valid(const double* start);
  /** When the environment has its points of the end: finds the cells that contain the ends of all vertices; whether
   * there are such.
   * @param start where its points were. */
  bool find_arrivals(Array<Trajectory<D>>& trajectories, const double* start);

  /** Nothing is known before walls have been looked for. */
  static bool are_alone(const Array<Trajectory<D>>&) noexcept { return false; }
  /** Nothing is known of paths before the end. */
  void cast_paths(Array<Trajectory<D>>&) noexcept {}
  void set_counters(CastCounters*) noexcept {}
  /** Keeps how a host reads what is touched of the environment, after what was kept. Particles are of the body without a name. */
  void describe(const Array<Trajectory<D>>& trajectories, const Array<WayTouch<D>>& touches);
  void describe(const Array<Trajectory<D>>& trajectories, const Array<TooNearOnWay<D>>& first);
  Array<dsw_wall_contact> contacts{env_.memory};  // that were kept since start()
  SweepCounts counts;                             // of edges and faces
  PairWork* work = nullptr;

 private:
  /** A part that moves, or that something may come near. */
  struct Near {
    uint32_t trajectory;
    Simplex part;
    uint32_t first_feature = 0, feature_end = 0;
    uint32_t first_cell = 0, cell_end = 0;  // of a vertex: where it may arrive; none: nobody has looked
    uint32_t outer = kNone;                 // its number in near_outers; kNone: another part covers it
    // The numbers of those ends that an edge stands for: one flood finds what comes near all three.
    uint32_t ends[2] = {kNone, kNone};
    bool has_edge = false;  // an edge stands for it

    Near(uint32_t of, const Simplex& each) : trajectory(of), part(each) {}
  };
  struct Feature {
    WallFeature name;
    size_t first_end;  // of its points, in ends_
    size_t first_wall, wall_end;
  };
  struct Wall {
    uint32_t vertices[D];
  };
  void collect_all(const Array<Trajectory<D>>& trajectories);
  void collect(const Trajectory<D>& of, Near& near);
  void stand_for_ends(const Array<Trajectory<D>>& trajectories);
  void check_cells();
  uint32_t add_obstacles(uint32_t outer, bool is_thick);
  bool are_valid_from(size_t first);
  void check_from(size_t first, Array<Trajectory<D>>& trajectories);
  void add_features(const Trajectory<D>& of, const Simplex& part);
  template <class Visit>
  bool visit_touches(const Array<Trajectory<D>>& trajectories, Visit visit);
  bool set_pair(const Trajectory<D>& of, const Near& near, const Feature& feature, WayTouch<D>& touch) const;
  bool stays_free(const WayTouch<D>& touch, const Feature& feature) const;
  bool is_beside(const WayTouch<D>& touch, const Wall& wall) const;

  const double* next_ = nullptr;
  Array<dsw_volume_id>* invalid_ = nullptr;
  ObstacleFlood<D> flood_, arrival_flood_;
  NearList<D> list_;
  bool stay_valid_ = true;
  Array<Near> nears_{env_.memory};
  Array<Feature> features_{env_.memory};
  Array<Wall> walls_{env_.memory};   // that have features of edges and faces
  Array<double> ends_{env_.memory};  // where the points of features go
  Array<Cell> cells_{env_.memory};   // where vertices may arrive
  CellQueue checked_{env_.memory};   // all that were met
  const double* steps_ = nullptr;
  double time_ = 1;                    // of the ends
  Array<double> places_{env_.memory};  // where the points of these cells go, by vertex, if there are steps
  Array<uint32_t> met_{env_.memory};   // these vertices
};

}  // namespace dsw
