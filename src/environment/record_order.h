#pragma once
// In which order the records of a mesh are laid out. A cast goes from a record to that of a neighbour, and where cells come
// in an order that jumps about in space, each step misses the cache. Such records are put along a Morton curve; cells
// that come in a coherent order (lattices, extruded meshes) keep it, and need no table then. Only a choice of places: no
// cast depends on it.

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "environment/environment.h"

namespace dsw {

/** Fewer records than this fit into the nearer caches in any order. */
constexpr uint32_t kMinOrderedCells = 4096;
/** Cells that follow each other lie at most this many sizes of a cell apart, on average, or their order is incoherent. A
 * lexicographic lattice of any proportions has about 2 at most: the steps of a row, and its return. */
constexpr double kCoherentSizes = 2.5;
/** How many neighbouring pairs in the order are looked at, evenly spread; enough for a mean. */
constexpr uint32_t kCoherenceSamples = 1u << 15;

/** Three vertices of a cell, which tell where it lies and about how large it is. Any of them may be out of range: such
 * cells lie nowhere, and are refused later. */
struct CellSample {
  int64_t first = -1, second = -1, last = -1;
};

/** Positions relative to the box of all points, in units of its longest side. An axis whose extent is not a double has
 * only the position 0. */
template <int D>
class UnitBox {
 public:
  explicit UnitBox(const Environment<D>& env) {
    double upper[D] = {};
    for (uint32_t v = 0; v < env.map.vertex_count; ++v) {
      const double* p = env.point(v);
      for (int k = 0; k < D; ++k) {
        lower_[k] = v == 0 || p[k] < lower_[k] ? p[k] : lower_[k];
        upper[k] = v == 0 || p[k] > upper[k] ? p[k] : upper[k];
      }
    }
    for (int k = 0; k < D; ++k) {
      const double extent = upper[k] - lower_[k];
      used_[k] = std::isfinite(extent);
      if (used_[k]) longest_ = std::max(longest_, extent);
    }
  }
  /** In 0 .. 1: rounding is monotone, and the division is needed where 1 / longest_ would overflow. */
  double at(const double* p, int k) const { return used_[k] && longest_ > 0 ? (p[k] - lower_[k]) / longest_ : 0; }

 private:
  double lower_[D] = {}, longest_ = 0;
  bool used_[D] = {};
};

/** The lowest 21 bits of x, each D places from the next. */
template <int D>
uint64_t spread_bits(uint64_t x) {
  if constexpr (D == 3) {
    x = (x | x << 32) & 0x001f00000000ffffull;
    x = (x | x << 16) & 0x001f0000ff0000ffull;
    x = (x | x << 8) & 0x100f00f00f00f00full;
    x = (x | x << 4) & 0x10c30c30c30c30c3ull;
    x = (x | x << 2) & 0x1249249249249249ull;
  } else {
    x = (x | x << 16) & 0x0000ffff0000ffffull;
    x = (x | x << 8) & 0x00ff00ff00ff00ffull;
    x = (x | x << 4) & 0x0f0f0f0f0f0f0f0full;
    x = (x | x << 2) & 0x3333333333333333ull;
    x = (x | x << 1) & 0x5555555555555555ull;
  }
  return x;
}

/** Whether the records of cells 0 .. cell_count - 1 should stand in another order than that of cells, and which: record k
 * is that of cell order[k]. sample(i) gives a CellSample. Points have been read; vertices have not been checked. */
template <int D, class Sample>
bool choose_record_order(const Environment<D>& env, uint32_t cell_count, const Sample& sample, Array<uint32_t>& order) {
  if (cell_count < kMinOrderedCells) return false;
  const UnitBox<D> box(env);
  const auto point = [&](int64_t v) {
    return v >= 0 && v < static_cast<int64_t>(env.map.vertex_count) ? env.point(static_cast<uint32_t>(v)) : nullptr;
  };
  /** Between the first and last vertex, in 0 .. 1; false if the cell lies nowhere. */
  const auto place = [&](const CellSample& cell, double* out) {
    const double *a = point(cell.first), *b = point(cell.last);
    if (a == nullptr || b == nullptr) return false;
    for (int k = 0; k < D; ++k) out[k] = (box.at(a, k) + box.at(b, k)) / 2;
    return true;
  };
  const auto distance = [&](const double* a, const double* b) {
    double sum = 0;
    for (int k = 0; k < D; ++k) sum += std::abs(box.at(a, k) - box.at(b, k));
    return sum;
  };

  double steps = 0, sizes = 0;
  const uint32_t stride = 1 + (cell_count - 2) / kCoherenceSamples;
  for (uint64_t i = 0; i + 1 < cell_count; i += stride) {
    const CellSample cell = sample(static_cast<uint32_t>(i));
    double here[D], next[D];
    const double* second = point(cell.second);
    if (second == nullptr || !place(cell, here) || !place(sample(static_cast<uint32_t>(i + 1)), next)) continue;
    for (int k = 0; k < D; ++k) steps += std::abs(next[k] - here[k]);
    sizes += std::max(distance(point(cell.first), second), distance(point(cell.first), point(cell.last)));
  }
  if (steps <= kCoherentSizes * sizes) return false;

  struct Keyed {
    uint64_t key;
    uint32_t cell;
  };
  Array<Keyed> cells{Allocator<Keyed>(env.memory)};
  cells.reserve(cell_count);
  for (uint32_t i = 0; i < cell_count; ++i) {
    double p[D];
    uint64_t key = 0;
    if (place(sample(i), p)) {
      for (int k = 0; k < D; ++k) key |= spread_bits<D>(static_cast<uint64_t>(p[k] * 0x1fffff)) << k;
    }
    cells.push_back({key, i});
  }
  const auto before = [](const Keyed& a, const Keyed& b) { return a.key != b.key ? a.key < b.key : a.cell < b.cell; };
  if (std::is_sorted(cells.begin(), cells.end(), before)) return false;
  std::sort(cells.begin(), cells.end(), before);  // no two are equal, so there is one result
  order.resize(cell_count);
  for (uint32_t k = 0; k < cell_count; ++k) order[k] = cells[k].cell;
  return true;
}

}  // namespace dsw
