// Boxes are sorted into hashed cells, which are 1.5 times as long as an average box. They are compared as whole steps of
// a lattice. Rounding down keeps the order of coordinates, so boxes that overlap do so there as well.

#include "proximity/near_edges.h"

#include <algorithm>

#include "base/search.h"

namespace dsw {
namespace {

constexpr double kCellSize = 1.5;               // as a share of the average box
constexpr int64_t kMostCells = 64;              // of a box
constexpr int kStepBits = 20, kFieldBits = 21;  // of a step's number; three of these, with a guard bit each, in a word
constexpr double kMostCellsAlong = 1 << 19;     // of the lattice, along one axis: steps are as large or smaller
constexpr int kFinestSteps = 10;                // steps to a cell, as a power of two
// Limits for an edge, on average: boxes in the same cells, and near edges of 8 bytes each. A random chain in a ball moves
// with the list in a fifth of the time that it takes with the grids if an edge has 670 such boxes, in a third if it has
// 1,400.
constexpr size_t kMostTests = 2048, kMostNear = 512;
constexpr uint64_t kGuards = (uint64_t{1} | uint64_t{1} << kFieldBits | uint64_t{1} << 2 * kFieldBits) << kStepBits;

uint32_t step_along(uint64_t steps, int axis) noexcept {
  return static_cast<uint32_t>(steps >> axis * kFieldBits) & ((1u << kStepBits) - 1);
}

uint32_t hash_of(uint32_t x, uint32_t y, uint32_t z) noexcept {
  return x * 0x9e3779b1u + y * 0x85ebca77u + z * 0xc2b2ae3du;
}

}  // namespace

void NearEdges::make_stray(uint32_t e) noexcept {
  if (!active_) return;
  if (e < ways_.size()) ways_[e] = Box<3>();
  if (dsw::find(strays_, strays_ + stray_count_, e) != strays_ + stray_count_) return;
  if (stray_count_ == kMostStrays) {
    stop();
  } else {
    strays_[stray_count_++] = e;
  }
}

/** False: some box is too large, or they cannot be sorted. */
bool NearEdges::find_steps() {
  double size = 0, extent = 0, count = 0;
  all_ = Box<3>();
  for (const Box<3>& way : ways_) {
    if (way.empty()) continue;
    all_.add(way);
    size += std::max({way.upper[0] - way.lower[0], way.upper[1] - way.lower[1], way.upper[2] - way.lower[2]});
    ++count;
  }
  bound_ = filter::bound_in_box(all_.lower, all_.upper);
  for (int k = 0; k < 3; ++k) extent = std::max(extent, all_.upper[k] - all_.lower[k]);
  double scale = 1 / std::max(kCellSize * size / count, extent / kMostCellsAlong);
  if (!(extent < 0x1p1000) || !(scale < 0x1p1000)) return false;
  for (halvings_ = 0; halvings_ < kFinestSteps && 2 * scale * extent < kMostCellsAlong; ++halvings_) scale *= 2;
  steps_.resize(ways_.size());
  for (size_t e = 0; e < ways_.size(); ++e) {
    Steps& steps = steps_[e];
    steps = {0, kGuards, 0};
    const Box<3>& way = ways_[e];
    if (way.empty()) continue;
    int64_t cells = 1;
    for (int k = 0; k < 3; ++k) {
      const auto low = static_cast<int64_t>((way.lower[k] - all_.lower[k]) * scale);
      const auto high = static_cast<int64_t>((way.upper[k] - all_.lower[k]) * scale);
      steps.low |= static_cast<uint64_t>(low) << k * kFieldBits;
      steps.high |= static_cast<uint64_t>(high) << k * kFieldBits;
      cells *= (high >> halvings_) - (low >> halvings_) + 1;
    }
    if (cells > kMostCells) return false;
    steps.cells = static_cast<uint32_t>(cells);
  }
  return true;
}

/** Calls visit(hash, at_low) for each cell that a box meets; at_low has a bit for each axis where it is lowest. */
template <class Visit>
void NearEdges::for_each_cell(const Steps& steps, Visit visit) const {
  uint32_t low[3], high[3];
  for (int k = 0; k < 3; ++k) {
    low[k] = step_along(steps.low, k) >> halvings_;
    high[k] = step_along(steps.high, k) >> halvings_;
  }
  for (uint32_t x = low[0]; x <= high[0]; ++x) {
    for (uint32_t y = low[1]; y <= high[1]; ++y) {
      const uint32_t at_low = (x == low[0] ? 1u : 0u) | (y == low[1] ? 2u : 0u);
      visit(hash_of(x, y, low[2]), at_low | 4u);
      for (uint32_t z = low[2] + 1; z <= high[2]; ++z) visit(hash_of(x, y, z), at_low);
    }
  }
}

/** False: too many are in one place. */
bool NearEdges::sort_into_cells() {
  uint32_t bits = 4;
  while ((size_t{1} << bits) < 2 * ways_.size() && bits < 29) ++bits;
  starts_.assign((size_t{1} << bits) + 1, 0);
  size_t count = 0;
  for (const Steps& each : steps_) count += each.cells;
  places_.resize(count);
  uint32_t* next = places_.data();
  for (const Steps& each : steps_) {
    if (each.cells == 0) continue;
    for_each_cell(each, [&](uint32_t hash, uint32_t at_low) {
      const uint32_t place = hash >> (32 - bits);
      ++starts_[place];
      *next++ = place << 3 | at_low;
    });
  }
  uint64_t tests = 0;
  uint32_t sum = 0;
  for (uint32_t& start : starts_) {
    tests += uint64_t{start} * start;
    start = sum += start;
  }
  if (tests > kMostTests * ways_.size()) return false;
  entries_.resize(sum);
  next = places_.data();
  for (uint32_t e = 0; e < steps_.size(); ++e) {
    const Steps& each = steps_[e];
    for (uint32_t i = 0; i < each.cells; ++i, ++next) {
      entries_[--starts_[*next >> 3]] = {each.low, each.high, e, *next & 7};
    }
  }
  return true;
}

void NearEdges::note_pair(const Body<3>& body, uint32_t a, uint32_t b) {
  const uint32_t(&one)[2] = body.edges[a].ends, (&other)[2] = body.edges[b].ends;
  if (one[0] == other[0] || one[0] == other[1] || one[1] == other[0] || one[1] == other[1]) return;
  pairs_.push_back(a);
  pairs_.push_back(b);
  ++first_[a];
  ++first_[b];
}

/** False: there are too many. */
bool NearEdges::find_pairs(const Body<3>& body) {
  if (!find_steps() || !sort_into_cells()) return false;
  pairs_.clear();
  first_.assign(ways_.size() + 1, 0);
  const Entry* begin = entries_.data();
  for (size_t place = 1; place < starts_.size(); ++place) {
    const Entry* const end = entries_.data() + starts_[place];
    for (const Entry* a = begin; a != end; ++a) {
      for (const Entry* b = a + 1; b != end; ++b) {
        // A guard bit stays where the difference below it is not negative.
        if (((a->high - b->low) & (b->high - a->low) & kGuards) != kGuards) continue;
        // A pair is noted in the lowest cell that both boxes meet. Where cells share a place, it may be noted again,
        // which does no harm.
        if ((a->at_low | b->at_low) == 7 && a->edge != b->edge) note_pair(body, a->edge, b->edge);
      }
    }
    begin = end;
    if (pairs_.size() > kMostNear * ways_.size()) return false;
  }
  uint32_t sum = 0;
  for (uint32_t& first : first_) first = sum += first;
  near_.resize(sum);
  for (size_t i = 0; i < pairs_.size(); i += 2) {
    near_[--first_[pairs_[i]]] = pairs_[i + 1];
    near_[--first_[pairs_[i + 1]]] = pairs_[i];
  }
  return true;
}

}  // namespace dsw
