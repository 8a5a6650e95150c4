#pragma once
// What of the environment bodies touch when all of their vertices move at once.

#include "corridor/box_probe.h"
#include "corridor/moving_corridors.h"
#include "together/far_edges.h"
#include "together/held_points.h"
#include "together/near_walls.h"
#include "together/start_corridors.h"
#include "together/thick_ways.h"
#include "walk/packet.h"

namespace dsw {

/** Keeps its memory from call to call; one for each thread. Throws std::bad_alloc and WorkOver. */
template <int D>
class WallWays {
 public:
  explicit WallWays(const Environment<D>& env)
      : env_(env), near_(env), far_(env), probe_(env), corridors_(env), starts_(env) {}

  /** Forgets what was found for another call. */
  void start(const Array<Trajectory<D>>& trajectories);
  /** Whether it is known that nothing of the environment is in the boxes of the whole ways of the trajectories, wherever they end in these. */
  bool are_alone(const Array<Trajectory<D>>& trajectories);
  /** Casts the paths of all vertices to their ends, and so finds the cells where they arrive. */
  void cast_paths(Array<Trajectory<D>>& trajectories);
  /** Whether no path is blocked, and nothing else touches the environment on its way. */
  bool is_free(const Array<Trajectory<D>>& trajectories);
  /** What is touched first. */
  void find_first(const Array<Trajectory<D>>& trajectories, Array<WayTouch<D>>& first);
  /** Appends what each vertex, and each pair of a part and a feature, touches first. */
  void find_all(const Array<Trajectory<D>>& trajectories, Array<WayTouch<D>>& all);

  /** Whether an edge or a face that touches a feature at its start is free of it on the way to its end, under the shift. */
  static bool is_kept_free(const WayTouch<D>& touch) noexcept;

  /** Whether parts at a vertex that is blocked are looked at up to just before that alone. What comes later is of no
   * use where such a vertex gets a new goal. */
  bool limits_parts = false;
  PairWork* work = nullptr;

  // The environment stands still.
  NoPoints held;
  void collect_again(const Array<Trajectory<D>>& trajectories) { near_.start(trajectories); }
  void find_goals(const WayTouch<D>& touch, const double** goals) const {
    for (uint32_t i = 0, first = touch.comes_first ? D + 1 - touch.wall.count : 0; i < touch.wall.count; ++i)
      goals[i] = touch.pair.end[first + i];
  }
  void find_goals(const TooNearOnWay<D>& near, const double** goals) const {
    for (uint32_t i = 0; i < near.wall.count; ++i) goals[i] = env_.point(near.wall.vertices[i]);
  }
  void start_round() const noexcept {}
  void tighten(const Array<Trajectory<D>>&) const noexcept {}
  void finish_round() const noexcept {}
  void set_end(double) noexcept {}
  void set_step_end(double) noexcept {}
  /** Corridors of edges need the facets that their ends pass. */
  static bool notes_paths(const Body<D>& body) noexcept { return covers_edges(body.level); }
  static const double* nexts() noexcept { return nullptr; }
  void place(uint32_t v, double* at) const { std::copy_n(env_.point(v), D, at); }
  static bool stays_valid_to_ends() noexcept { return true; }
  template <class Touch>
  void describe(const Array<Trajectory<D>>&, const Array<Touch>&) noexcept {}
  void set_counters(CastCounters* counters) { counters_ = corridors_.counters = starts_.counters = counters; }
  /** What edges and faces did. Whether there is a tree of obstacles changes none of these counts. */
  SweepCounts counts;

 private:
  void note_blocked(Trajectory<D>& of, uint32_t number, uint32_t v, const CastResult& path);
  template <class Visit>
  bool visit_parts(const Array<Trajectory<D>>& trajectories, Visit visit);
  template <class Visit>
  bool visit_plain_edges(const Trajectory<D>& of, uint32_t number, Visit visit);
  template <class Visit>
  bool visit_part(const Trajectory<D>& of, uint32_t number, const Simplex& part, Visit visit);
  struct PartWay;
  void note_vertex(const Trajectory<D>& of, uint32_t v);
  void note_vertices(const Trajectory<D>& of);
  bool note_new_parts(const Trajectory<D>& of);
  bool passes_over(const Trajectory<D>& of, uint32_t edge);
  static double limit_of(const Trajectory<D>& of, const SimplexCorners<D>& corners);
  static PointWay way_of(const Trajectory<D>& of, uint32_t v);
  bool stays_in_cell(const Trajectory<D>& of, const SimplexCorners<D>& corners) const noexcept;
  bool is_alone(const PartWay& way);
  template <class Visit>
  bool visit_edge(const PartWay& way, Visit visit);
  template <class Visit>
  bool visit_features(const PartWay& way, const CandidateView<D>& near, Visit visit);
  bool is_beside(const WallPlane<D>& plane, const double* const* points, uint32_t count) const;
  WayTouch<D> touch_of(const Trajectory<D>& of, uint32_t number, uint32_t v, const CastResult& path) const;

  const Environment<D>& env_;
  NearWalls<D> near_;
  FarEdges<D> far_;
  BoxProbe<D> probe_;
  MovingCorridors<D> corridors_;
  StartCorridors<D> starts_;
  Packet<D> packet_;
  CastCounters* counters_ = nullptr;
  Array<WayTouch<D>> blocked_{env_.memory};  // what paths of vertices touch
  static constexpr uint32_t kNew = 1, kMoves = 2, kLeaves = 4, kStands = 8;
  Array<uint8_t> vertices_{env_.memory};   // of one trajectory: these bits
  Array<Simplex> parts_{env_.memory};      // of one trajectory: those at new vertices
  Array<uint32_t> plain_{env_.memory};     // edges of one trajectory that keep no corridors
  Array<uint32_t> open_{env_.memory};      // those whose corridors have to be found
  Array<uint8_t> is_beside_{env_.memory};  // by plane of the part: all of its way is on one side of it
};

}  // namespace dsw
