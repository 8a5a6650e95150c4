#pragma once
// An environment: a map with positions, labels and marks. Cells are unions of simplices that are never stored: a
// simplex is itself, any other cell the star of its centre over the simplices of its facets.

#include <cmath>
#include <cstdint>

#include "base/compiler.h"
#include "base/parallel.h"
#include "base/pool.h"
#include "base/processor.h"
#include "environment/cell_index.h"
#include "environment/checked_cells.h"
#include "environment/edge_marks.h"
#include "environment/exits.h"
#include "environment/obstacle_index.h"
#include "map/map.h"

namespace dsw {

template <int D>
struct Environment {
  static constexpr int kDimension = D;

  const Memory* memory;
  Map<D> map{memory};
  Array<double> owned_points{memory};  // D doubles a vertex; empty when borrowed
  const double* points = nullptr;      // owned_points or the host's
  double* lent = nullptr;              // the host's, if it has room for `point_room` vertices; null: not to be written
  size_t point_room = 0;
  Array<int32_t> regions{memory};        // by cell index; empty: none were given
  Array<uint32_t> tags{memory};          // by cell index; empty: none were given
  Array<uint32_t> parents{memory};       // by cell index: the cell that it is a part of, or kNoCell; empty: itself
  EdgeMarks edge_marks{memory};          // marked edges, by their two vertices
  Array<uint64_t> vertex_marks{memory};  // bits; empty: none
  Exits exits{memory};                   // facets of the boundary through which things leave
  uint64_t marked_cells = 0, marked_facets = 0, marked_edges = 0, marked_vertices = 0;
  // Another one when something becomes impassable, or points move; not when something becomes passable. So what is kept
  // under it may only say that something is free.
  uint64_t obstacle_version = 0;
  uint64_t change_version = 0;  // another one with every change of marks, cells or points
  uint64_t last_version = 0;    // that was given
  uint64_t points_version = 0;  // another one when points move
  uint32_t part_count = 0;
  double lower[D] = {}, upper[D] = {};  // box of the vertices that cells use
  CellIndex<D> index{memory};           // which cells may contain a point
  ObstacleIndex<D> obstacles{memory};   // at which cells there may be one, for who asks what is nearest
  CheckedCells checked{memory};         // of moving points: cells may be invalid
  Array<float> local_points{memory};    // of polyhedra that stay as they are, see local_points.h; empty: not kept
  Pool scratch{memory};                 // drafts of a change, while it is made
  const Kernels* kernels = &kernels_of(most_instructions());

  explicit Environment(const Memory* source) : memory(source) {}
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

  /** What was known of obstacles is not any more. Who takes back what was done gives back the version from before. */
  void renew_version() noexcept {
    obstacle_version = ++last_version;
    ++change_version;
  }
  void give_back_version(uint64_t version) noexcept {
    obstacle_version = version;
    ++change_version;
  }
  /** Points are elsewhere than they were. */
  void note_move() noexcept {
    ++points_version;
    renew_version();
    set_moved(checked.active());
  }
  /** Whether points that may move have moved. Until then all cells are valid. After it `checked` says which
   * cells are valid, and records say of simplices alone that they are convex. */
  bool has_moved() const noexcept { return map.convex_bit == 0; }
  /** Code that takes a move back must restore the value from before it. */
  void set_moved(bool moved) noexcept { map.convex_bit = moved ? 0 : kConvexBit; }
  /** Where vertices are written that come and go; null: they stay as they are. */
  double* writable_points() { return owned_points.empty() ? lent : owned_points.data(); }
  const double* point(uint32_t vertex) const { return points + size_t{vertex} * D; }
  const double* point(Cell c, uint32_t local) const { return point(map.vertex(c, local)); }
  int32_t region(Cell c) const { return regions.empty() ? 0 : regions[map.index(c)]; }
  /** The index of the cell that was given of which this is all or a part; kNoCell: it was added later. */
  uint32_t parent(Cell c) const { return parents.empty() ? map.index(c) : parents[map.index(c)]; }
  uint32_t tag(Cell c) const { return tags.empty() ? 0 : tags[map.index(c)]; }
  uint64_t memory_bytes() const {
    const uint64_t borrowed = owned_points.empty() ? uint64_t{map.vertex_count} * D * sizeof(double) : 0;
    return sizeof(*this) + map.memory_bytes() + array_bytes(owned_points) + borrowed + array_bytes(regions) +
           array_bytes(tags) + array_bytes(parents) + edge_marks.memory_bytes() + array_bytes(vertex_marks) +
           index.memory_bytes() + obstacles.memory_bytes() + checked.memory_bytes() + array_bytes(local_points) +
           exits.memory_bytes();
  }
};

/** The mean of `count` points, summed in the order of point(0), point(1), ... Finite for every finite input. */
template <int D, class PointAt>
void mean_point(uint32_t count, PointAt point, double* out) {
  const double divisor = count;
  double sum[D] = {};
  for (uint32_t i = 0; i < count; ++i) {
    const double* const p = point(i);
    for (int k = 0; k < D; ++k) sum[k] += p[k];
  }
  for (int k = 0; k < D; ++k) {
    if (DSW_UNLIKELY(!std::isfinite(sum[k]))) {  // scaled down before it is added up
      sum[k] = 0;
      for (uint32_t i = 0; i < count; ++i) sum[k] += point(i)[k] / divisor;
      out[k] = sum[k];
    } else {
      out[k] = sum[k] / divisor;
    }
  }
}

/** The mean of a cell's vertices, summed in their order: the apex of its star, and where walks from a hint start. The
 * same bits everywhere, because every use goes through here. */
template <int D>
void centre(const Environment<D>& env, Cell c, double* out);

/** Whether a cell is a cuboid with its facets in planes of the axes. It is then valid, convex, and exactly flat. */
bool is_cuboid(const Environment<3>& env, Cell c) noexcept;
inline bool is_cuboid(const Environment<2>&, Cell) noexcept { return false; }

/** Looks whether a cell of moving points is valid, and notes it. */
template <int D>
CheckedCells::Known find_out_validity(const Environment<D>& env, Cell c) noexcept;

/** What is known of a cell of moving points. Looks at the cell if nobody has. */
template <int D>
inline CheckedCells::Known known_of(const Environment<D>& env, Cell c) noexcept {
  const CheckedCells::Known known = env.checked.known(env.map.index(c));
  return known == CheckedCells::Known::kNothing ? find_out_validity(env, c) : known;
}

/** Whether a cell can be entered: it is valid, which is known unless points have moved. Invalid cells count as
 * impassable. */
template <int D>
inline bool admits(const Environment<D>& env, Cell c) noexcept {
  return !env.has_moved() || CheckedCells::is_valid(known_of(env, c));
}

/** Impassable by its own mark, or invalid. */
template <int D>
inline bool is_closed(const Environment<D>& env, Cell c) noexcept {
  return env.map.marked(c) || !admits(env, c);
}

/** Tells whether a half-facet is impassable in the map, or has an invalid cell on either side. */
template <int D>
inline bool is_impassable(const Environment<D>& env, HalfFacet h) noexcept {
  if (is_impassable(env.map, h)) return true;
  return env.has_moved() && !(admits(env, env.map.cell_of(h)) && admits(env, env.map.cell_of(env.map.opposite(h))));
}

/** The patch of the exit that a half-facet is; 0: it is none. */
template <int D>
inline uint32_t exit_patch(const Environment<D>& env, HalfFacet h) noexcept {
  if (env.exits.empty() || env.map.opposite(h).valid()) return 0;
  const Cell c = env.map.cell_of(h);
  return env.exits.patch(env.map.index(c), env.map.local_of(h, c));
}

/** Points of simplex `simplex` of a cell. */
template <int D>
void simplex_points(const Environment<D>& env, Cell c, const Shape& shape, uint32_t simplex, const double* out[D]) {
  const uint16_t* local = shape.simplices() + simplex * static_cast<uint32_t>(D);
  for (int i = 0; i < D; ++i) out[i] = env.point(c, local[i]);
}

}  // namespace dsw
