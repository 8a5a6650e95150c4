#pragma once
// A uniform grid over an environment for locating points without a hint. Optional: an environment without it holds two
// empty arrays.

#include <cstdint>

#include "base/memory.h"
#include "map/map.h"

namespace dsw {

template <int D>
struct Environment;

/** Every bucket lists the cells whose box meets it, ascending by cell index. */
template <int D>
struct Grid {
  Array<uint32_t> first;  // bucket -> start in cells; one more at the end; empty: no grid
  Array<uint32_t> cells;  // cell indices
  uint32_t size[D] = {};  // buckets along each axis
  double lower[D] = {}, buckets_per_unit[D] = {};

  explicit Grid(const Memory* memory) : first(memory), cells(memory) {}
  bool empty() const { return first.empty(); }
  uint64_t memory_bytes() const { return array_bytes(first) + array_bytes(cells); }
};

/** Fills env.grid with about one bucket a cell, fewer where large cells would be listed too often. */
template <int D>
void build_grid(Environment<D>& env);

/** Bucket of a point; false when the point lies outside of the box from grid.lower to `upper`, that of the environment.
 * Monotone in every coordinate, so a cell is listed in every bucket that a point of it can fall into. */
template <int D>
bool find_bucket(const Grid<D>& grid, const double* upper, const double* point, size_t* bucket) noexcept;

}  // namespace dsw
