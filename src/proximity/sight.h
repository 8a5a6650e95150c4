#pragma once
// Whether the nearest point of an obstacle is seen from that of a part: a walk through cells along the exact segment.

#include "environment/environment.h"
#include "map/cell_queue.h"
#include "predicates/sightline.h"

namespace dsw {

/** Where a walk along a sightline ended. */
struct SightResult {
  bool is_hit = false;  // a facet there is impassable
  Cell cell;            // the last cell entered
};

/** Whether a cell is a simplex that has vertices. A line that ends inside of what they span does not leave it then. */
template <int D>
bool is_simplex_at(const Map<D>& map, Cell c, const uint32_t* vertices, uint32_t count) noexcept;

/** Walks from a cell that contains the start of a line, under the shift, to the end or to an impassable facet. Every step
 * crosses a facet later than the one before.
 * @param target vertices: the line ends inside of the simplex that they span. Throws std::bad_alloc. */
template <int D>
SightResult walk_along(const Environment<D>& env, Sightline<D>& line, Cell start, const uint32_t* target,
                       uint32_t target_count);

/** Walks along an edge of a body. What the whole edge passes is found once for all points on it. In convex cells the walk
 * to a point passes those facets of it that the point lies beyond. */
template <int D>
class EdgeWalk {
 public:
  explicit EdgeWalk(const Environment<D>& env) : env_(env) {}

  /** Begins with an edge, by the cells that contain its ends. */
  void begin(const double* const* ends, Cell start, Cell last) noexcept;
  /** Whether the edge leaves its first cell. */
  bool leaves() const noexcept { return !is_known_ || count_ != 0; }
  /** Walks to the end of a line from the first end of the edge to a point on it. Throws std::bad_alloc. */
  SightResult to(Sightline<D>& line);

 private:
  static constexpr uint32_t kMostSteps = 64;

  void add(Cell from, uint32_t simplex, const SightResult& beyond) noexcept;

  const Environment<D>& env_;
  Cell start_;
  bool is_known_ = false;  // all steps, through convex cells
  uint32_t count_ = 0;
  struct {
    const double* simplex[D];  // that is passed
    SightResult beyond;
  } steps_[kMostSteps];
};

/** A cell with an obstacle at which a line ends that ends in the cell `end`; invalid if it ends at none. The other lip of
 * a closed slit has vertices of its own. It can lie before this lip up to rounding, but this line does not end at it, nor
 * at a sheet that overlaps.
 * @param vertices of the obstacle. @param cells is overwritten. Throws std::bad_alloc. */
template <int D>
Cell find_cell_at_end(const Environment<D>& env, Sightline<D>& line, Cell end, const uint32_t* vertices, uint32_t count,
                      CellQueue& cells);

/** The cells at a vertex, an edge or a triangle that can be reached from one of them through passable facets there. Walls
 * can part the cells at an edge into several such fans. */
template <int D>
class PassableFan {
 public:
  /** @param first has the vertices. @param cells is overwritten, and used as long as the fan. */
  PassableFan(const Environment<D>& env, Cell first, const uint32_t* vertices, uint32_t count, CellQueue& cells)
      : env_(env), vertices_(vertices), count_(count), cells_(cells) {
    cells_.clear();
    cells_.insert(first);
  }
  Cell first() const { return cells_[0]; }
  /** Whether a cell is in the fan. Looks no farther than it has to. Throws std::bad_alloc. */
  bool reaches(Cell c);

 private:
  enum class Reach { kNo, kYes, kUnknown };

  Reach go_round(Cell c) const noexcept;
  void follow(HalfFacet h);
  void follow_tetrahedron(Cell c);

  const Environment<D>& env_;
  const uint32_t* vertices_;
  uint32_t count_;
  CellQueue& cells_;
  size_t next_ = 0;  // the first cell whose neighbours are not in `cells_` yet
};

}  // namespace dsw
