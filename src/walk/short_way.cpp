#include "walk/short_way.h"

#include <algorithm>

#include "base/dimensions.h"
#include "predicates/filtered.h"
#include "predicates/tally.h"
#include "walk/walk.h"
#include "walk/walks.h"

namespace dsw {

template <int D>
void find_outside(const Environment<D>& env, const Cell* cells, const double* const* points, uint32_t count,
                  uint8_t* facets) noexcept {
  DSW_ASSERT(count <= kPacket);
  if (count == 0) return;
  if constexpr (D == 3) {
    walk_for(env, cells[0]).find_outside(env, cells, points, count, facets);
  } else {
    std::fill_n(facets, count, uint8_t{0});
  }
}

namespace {

constexpr uint32_t kNoRidge = 4;  // two facets share none

/** Tells which of the asked ways of a pair leave the cell by facet f, a bit each; the others leave by g. kNoRidge: f and g share none. */
uint32_t leaves_by_first(const Environment<3>& env, const TwoWays& pair, uint32_t f, uint32_t g) noexcept {
  const double* ridge[2];
  if (!shared_ridge(env, env.map.record(pair.cell), f, g, ridge)) return kNoRidge;
  // What line_side asks, with the end as the origin: the ridge's plane with the end serves both ways.
  const filter::Vec<3> a = filter::difference<3>(ridge[0], pair.to), b = filter::difference<3>(ridge[1], pair.to),
                       normal = filter::cross(a, b), reach = filter::extent(a, b);
  uint32_t by_f = 0;
  for (uint32_t i = 0; i < 2; ++i) {
    if ((pair.asked >> i & 1) == 0) continue;
    const filter::Vec<3> way = filter::difference<3>(pair.to, pair.from[i]);
    const double det = filter::dot(normal, way);
    const bool certain = filter::certain(det, filter::extent(way, reach));
    const int side = certain ? filter::sign_of(det) : line_side<3>(pair.from[i], pair.to, ridge, NoTally{}).sign;
    by_f |= uint32_t{side > 0} << i;
  }
  return by_f;
}

/** Goes from the cell of a pair into the next one. Returns whether a way leads on from there. */
bool go_on(const Environment<3>& env, TwoWays& pair) noexcept {
  if (pair.facets == 0) return false;
  const uint32_t f = lowest_bit(pair.facets), g = highest_bit(pair.facets);
  if ((pair.facets & ~(1u << f | 1u << g)) != 0) return false;
  const uint32_t by_f = f == g ? pair.asked : leaves_by_first(env, pair, f, g);
  if (by_f == kNoRidge) return false;
  const Cell left = pair.cell;
  const uint32_t by_facet[2] = {by_f, pair.asked & ~by_f};
  pair.asked = 0;
  for (uint32_t k = 0; k < 2; ++k) {
    if (by_facet[k] == 0) continue;
    const Cell next = open_neighbour(env, left, k == 0 ? f : g);
    if (next == pair.last) {
      pair.leads |= by_facet[k];
    } else if (next.valid()) {
      pair.asked = by_facet[k];
      pair.cell = next;
    }
  }
  return pair.asked != 0;
}

}  // namespace

void follow_ways(const Environment<3>& env, TwoWays* pairs, uint32_t count) noexcept {
  TwoWays* open[kPacket];
  Cell cells[kPacket];
  const double* points[kPacket];
  uint8_t facets[kPacket];
  for (uint32_t i = 0; i < count; ++i) open[i] = pairs + i;
  for (uint32_t looks = 0; count != 0; ++looks) {
    uint32_t kept = 0;
    for (uint32_t i = 0; i < count; ++i) {
      if (!go_on(env, *open[i])) continue;
      cells[kept] = open[i]->cell;
      points[kept] = open[i]->to;
      open[kept++] = open[i];
    }
    if (looks == kMostFurtherLooks) return;
    count = kept;
    find_outside(env, cells, points, count, facets);
    for (uint32_t i = 0; i < count; ++i) open[i]->facets = facets[i];
  }
}

DSW_INSTANTIATE(find_outside);

}  // namespace dsw
