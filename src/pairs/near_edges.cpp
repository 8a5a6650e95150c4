// Boxes are sorted into hashed cells somewhat larger than they are on average. What is near what depends on the boxes
// alone, so cells may be anything that keeps the order of coordinates.

#include "pairs/near_edges.h"

#include <algorithm>

namespace dsw {
namespace {

constexpr double kCellSize = 1.5;            // as a share of the average box
constexpr int64_t kMostCells = 64;           // of a box
constexpr double kMostCellsAlong = 1 << 20;  // of the lattice, along one axis
constexpr size_t kMostEach = 512;            // on average: boxes in the same cells, and near edges

uint32_t hash_of(int32_t x, int32_t y, int32_t z) noexcept {
  return static_cast<uint32_t>(x) * 0x9e3779b1u + static_cast<uint32_t>(y) * 0x85ebca77u +
         static_cast<uint32_t>(z) * 0xc2b2ae3du;
}

template <class Visit>
void for_each_cell(const int32_t* low, const int32_t* high, Visit visit) {
  for (int32_t x = low[0]; x <= high[0]; ++x) {
    for (int32_t y = low[1]; y <= high[1]; ++y) {
      for (int32_t z = low[2]; z <= high[2]; ++z) visit(hash_of(x, y, z));
    }
  }
}

}  // namespace

void NearEdges::let_go(uint32_t e) noexcept {
  if (!active_) return;
  if (e < ways_.size()) ways_[e] = Box<3>();
  if (std::find(strays_, strays_ + stray_count_, e) != strays_ + stray_count_) return;
  if (stray_count_ == kMostStrays) {
    stop();
  } else {
    strays_[stray_count_++] = e;
  }
}

/** False: some box is too large, or they cannot be sorted. */
bool NearEdges::find_cells() {
  Box<3> all;
  double size = 0, extent = 0, count = 0;
  for (const Box<3>& way : ways_) {
    if (way.empty()) continue;
    all.add(way);
    double longest = 0;
    for (int k = 0; k < 3; ++k) longest = std::max(longest, way.upper[k] - way.lower[k]);
    size += longest;
    ++count;
  }
  for (int k = 0; k < 3; ++k) extent = std::max(extent, all.upper[k] - all.lower[k]);
  const double cell = std::max(kCellSize * size / count, extent / kMostCellsAlong), inverse = 1 / cell;
  if (!(extent < 0x1p1000) || !(inverse < 0x1p1000)) return false;
  cells_.resize(ways_.size());
  for (size_t e = 0; e < ways_.size(); ++e) {
    cells_[e].count = 0;
    if (ways_[e].empty()) continue;
    int64_t cells = 1;
    for (int k = 0; k < 3; ++k) {
      const auto place = [&](double x) { return static_cast<int32_t>((x - all.lower[k]) * inverse); };
      cells_[e].low[k] = place(ways_[e].lower[k]);
      cells_[e].high[k] = place(ways_[e].upper[k]);
      cells *= int64_t{cells_[e].high[k]} - cells_[e].low[k] + 1;
      if (cells > kMostCells) return false;
    }
    cells_[e].count = static_cast<uint32_t>(cells);
  }
  return true;
}

/** False: too many are in one place. */
bool NearEdges::sort_into_cells() {
  uint32_t bits = 4;
  while ((size_t{1} << bits) < 2 * ways_.size() && bits < 30) ++bits;
  shift_ = 32 - bits;
  starts_.assign((size_t{1} << bits) + 1, 0);
  size_t count = 0;
  for (const Cells& each : cells_) count += each.count;
  places_.resize(count);
  uint32_t* next = places_.data();
  for (const Cells& each : cells_) {
    if (each.count == 0) continue;
    for_each_cell(each.low, each.high, [&](uint32_t hash) {
      *next = hash >> shift_;
      ++starts_[*next++];
    });
  }
  uint64_t tests = 0;
  uint32_t sum = 0;
  for (uint32_t& start : starts_) {
    tests += uint64_t{start} * start;
    start = sum += start;
  }
  if (tests > kMostEach * ways_.size()) return false;
  entries_.resize(sum);
  next = places_.data();
  for (uint32_t e = 0; e < cells_.size(); ++e) {
    for (uint32_t i = 0; i < cells_[e].count; ++i) entries_[--starts_[*next++]] = e;
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

bool NearEdges::find_pairs(const Body<3>& body) {
  if (!find_cells() || !sort_into_cells()) return false;
  pairs_.clear();
  first_.assign(ways_.size() + 1, 0);
  for (uint32_t place = 0; place + 1 < starts_.size(); ++place) {
    const uint32_t *const begin = &entries_[0] + starts_[place], *const end = &entries_[0] + starts_[place + 1];
    for (const uint32_t* a = begin; a != end; ++a) {
      const Box<3>& way = ways_[*a];
      for (const uint32_t* b = a + 1; b != end; ++b) {
        if (!way.overlaps(ways_[*b])) continue;
        // Once: where the lower corner of what they share is.
        const int32_t(&low)[3] = cells_[*a].low, (&other)[3] = cells_[*b].low;
        const uint32_t hash =
            hash_of(std::max(low[0], other[0]), std::max(low[1], other[1]), std::max(low[2], other[2]));
        if (hash >> shift_ == place && *a != *b) note_pair(body, *a, *b);
      }
    }
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
