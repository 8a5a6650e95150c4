#pragma once
// The part of an environment that matters while its points move: cells that hold occupants, their vertices ("near"),
// and the cells round those. Only these cells can be entered meanwhile; the rest of the environment is at its new place
// already.

#include "corridor/sweep.h"
#include "map/cell_queue.h"
#include "walls/moving_points.h"
#include "walls/occupants.h"

namespace dsw {

template <int D>
class Neighbourhood {
 public:
  Neighbourhood(Environment<D>& env, Occupants<D>& all);

  /** Finds out which cells hold what. Throws std::bad_alloc. */
  void find_occupants();
  /** The cells that hold anything, each once, before points move. */
  const Array<Cell>& occupied() const noexcept { return occupied_; }
  /** Starts to move points; see MovingPoints::begin. */
  void begin(double* next);
  MovingPoints<D>& points() noexcept { return points_; }
  size_t near_count() const noexcept { return near_count_; }

  /** A step takes near vertices, one at a time, from one fraction of their way to the next. */
  void begin_step(double fraction);
  /** The near vertices that have not had their turn in this step, by index; whether there are any. They get near also
   * by what others do in their turns. */
  bool find_turns(Array<uint32_t>& turns);
  /** Takes the vertices round the near ones along. Nothing lies in their cells. */
  void end_step(double fraction) noexcept;

  /** The cells at a near vertex that can be entered; no other can hold anything. Valid until the next call. */
  const Array<Cell>& find_star(uint32_t v);
  /** Whether all cells of the star that was found last, and their facets at its vertex, are known to be passable. */
  bool is_star_passable() const noexcept { return is_star_passable_; }
  /** What lies in the star that was found last, and perhaps more. */
  void find_features(Array<Feature>& features);
  /** What was known of the cells at a vertex holds no more. */
  void forget_cells_at(uint32_t v) noexcept;

  /** Finds the cells that an edge or face meets; whether it is free. */
  bool trace(const Feature& feature);
  /** Notes that a feature lies in the cells that were traced last, or in that of a point. */
  void note_traced(const Feature& feature);
  void note_point(const Feature& point) { note(cell_of(all_, point), point); }
  /** Traces and notes a body's edges and faces at a vertex, and itself. Whether all are free. */
  bool note_vertex(uint32_t owner, uint32_t v);
  /** Traces and notes a whole body, each edge and face once. Whether all are free. */
  bool note_body(uint32_t owner);
  /** Lets the cells be entered that can be reached from those of a feature through passable
   * facets without leaving a box; whether there are any that could not. */
  bool open_reach(const Feature& feature, const Box<D>& box);
  /** Opens the reach, as open_reach does, of each part of a thick body at a vertex, also round the vertex's target. */
  void open_ways(uint32_t owner, uint32_t v, const double* target);

  uint64_t memory_bytes() const noexcept;

 private:
  /** A touched vertex. */
  struct Near {
    uint32_t first_cell = kNone;  // of the open ones that have it, in cells_
    uint32_t open_count = 0;      // of these
    uint32_t step = 0;            // the last that it had its turn in
    bool is_near = false;
    bool is_explored = false;  // all of its open cells can be reached from one of them, and no others
    bool has_walls = false;    // among the explored cells that have it, or their facets at it
  };
  struct CellNode {
    Cell cell;
    uint32_t next;
    bool explored;  // the cells that can be reached from it round the vertex are open
  };
  static void enter(void* user, Cell from, uint32_t simplex, Cell to) noexcept;

  bool follow(const Feature& feature);
  bool is_thick(const Feature& feature) const noexcept {
    return feature.kind != Feature::kParticle && all_.bodies[feature.owner].body->radius > 0;
  }
  void note_reach(const Feature& feature);
  void start_reach(const Feature& feature);
  Box<D> box_round(const Feature& feature) const noexcept;
  void note(Cell c, const Feature& feature);
  void add_cell(Cell c);
  bool open(Cell c);
  void explore(uint32_t v, Cell c);

  Environment<D>& env_;
  Occupants<D>& all_;
  MovingPoints<D> points_;
  CellFeatures features_;
  SweepFlood<D> flood_;
  bool begun_ = false;
  double fraction_ = 0;  // where vertices are that have not had their turn
  uint32_t step_ = 0;
  size_t near_count_ = 0;
  Array<Near> near_{env_.memory};  // by place among the touched
  Array<CellNode> cells_{env_.memory};
  Array<Cell> occupied_{env_.memory};  // cells with features, before points move
  Array<Cell> open_{env_.memory};      // cells that can be entered
  CellQueue around_{env_.memory}, reach_;
  Array<Cell> star_{env_.memory};
  bool is_star_passable_ = false;
  Array<Cell> traced_{env_.memory};
  size_t traced_count_ = 0;  // may be more than there was room for
};

}  // namespace dsw
