#include "environment/grid.h"

#include <algorithm>
#include <cmath>

#include "base/dimensions.h"
#include "environment/environment.h"

namespace dsw {
namespace {

template <int D>
struct Box {
  double lower[D], upper[D];
};

template <int D>
Box<D> box_of(const Environment<D>& env, Cell c) {
  Box<D> box;
  const uint32_t n = env.map.vertices_of(c);
  for (uint32_t i = 0; i < n; ++i) {
    const double* p = env.point(c, i);
    for (int k = 0; k < D; ++k) {
      box.lower[k] = i == 0 ? p[k] : std::min(box.lower[k], p[k]);
      box.upper[k] = i == 0 ? p[k] : std::max(box.upper[k], p[k]);
    }
  }
  return box;
}

/** Rounding is monotone, so a point between two others falls between their buckets. */
template <int D>
uint32_t along(const Grid<D>& grid, int k, double x) noexcept {
  const double at = (x - grid.lower[k]) * grid.buckets_per_unit[k];
  return at >= grid.size[k] ? grid.size[k] - 1 : static_cast<uint32_t>(at);
}

/** Calls visit(bucket) for the buckets that a box meets. */
template <int D, class Visit>
void for_each_bucket(const Grid<D>& grid, const Box<D>& box, Visit visit) {
  uint32_t low[3] = {0, 0, 0}, high[3] = {0, 0, 0};
  for (int k = 0; k < D; ++k) {
    low[k] = along(grid, k, box.lower[k]);
    high[k] = along(grid, k, box.upper[k]);
  }
  const size_t row = grid.size[0], slice = row * grid.size[1];
  for (uint32_t z = low[2]; z <= high[2]; ++z) {
    for (uint32_t y = low[1]; y <= high[1]; ++y) {
      for (uint32_t x = low[0]; x <= high[0]; ++x) visit(z * slice + y * row + x);
    }
  }
}

template <int D>
size_t bucket_count(const Grid<D>& grid) {
  size_t count = 1;
  for (int k = 0; k < D; ++k) count *= grid.size[k];
  return count;
}

/** An axis whose extent can't be divided in doubles gets one bucket. */
template <int D>
void set_scale(Grid<D>& grid, const double* upper) {
  for (int k = 0; k < D; ++k) {
    const double scale = grid.size[k] / (upper[k] - grid.lower[k]);
    const bool usable = std::isfinite(scale) && std::isfinite(upper[k] - grid.lower[k]) && scale > 0;
    if (!usable) grid.size[k] = 1;
    grid.buckets_per_unit[k] = usable ? scale : 0;
  }
}

/** Halves the longest buckets until there are about as many as cells. */
template <int D>
void choose_sizes(Grid<D>& grid, const double* upper, uint32_t wanted) {
  double length[D];
  size_t count = 1;
  for (int k = 0; k < D; ++k) {
    grid.size[k] = 1;
    length[k] = upper[k] - grid.lower[k];
    if (!std::isfinite(length[k])) length[k] = 0;
  }
  while (count < wanted) {
    const int k = static_cast<int>(std::max_element(length, length + D) - length);
    if (!(length[k] > 0)) break;
    grid.size[k] *= 2;
    length[k] /= 2;
    count *= 2;
  }
  set_scale(grid, upper);
}

}  // namespace

template <int D>
void build_grid(Environment<D>& env) {
  Grid<D>& grid = env.grid;
  std::copy(env.lower, env.lower + D, grid.lower);
  // Cells much larger than the others are listed often: then fewer buckets, so that the lists stay in proportion.
  const size_t most = size_t{8} * env.map.cell_count + 64;
  Array<uint32_t> counts{env.memory};
  size_t entries = 0;
  for (uint32_t wanted = env.map.cell_count;; wanted /= 2) {
    choose_sizes(grid, env.upper, wanted);
    counts.assign(bucket_count(grid) + 1, 0);
    entries = 0;
    for_each_cell(env.map, [&](Cell c) {
      if (entries > most && wanted > 1) return;
      for_each_bucket(grid, box_of(env, c), [&](size_t bucket) {
        ++counts[bucket + 1];
        ++entries;
      });
    });
    if (entries <= most || wanted <= 1) break;
  }
  for (size_t i = 1; i < counts.size(); ++i) counts[i] += counts[i - 1];
  grid.cells.resize(entries);
  Array<uint32_t> next(counts.begin(), counts.end() - 1, counts.get_allocator());
  for_each_cell(env.map, [&](Cell c) {
    for_each_bucket(grid, box_of(env, c), [&](size_t bucket) { grid.cells[next[bucket]++] = env.map.index(c); });
  });
  grid.first = std::move(counts);
}

template <int D>
bool find_bucket(const Grid<D>& grid, const double* upper, const double* point, size_t* bucket) noexcept {
  size_t at = 0;
  for (int k = D - 1; k >= 0; --k) {
    if (point[k] < grid.lower[k] || point[k] > upper[k]) return false;
    at = at * grid.size[k] + along(grid, k, point[k]);
  }
  *bucket = at;
  return true;
}

DSW_INSTANTIATE(build_grid);
DSW_INSTANTIATE(find_bucket);

}  // namespace dsw
