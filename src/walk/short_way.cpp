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

/** For two ways to one end outside of the facets f and g of a cell, a bit each: whether it leaves the cell by f. Or kNoRidge. */
uint32_t leaves_by_first(const Environment<3>& env, Cell cell, uint32_t f, uint32_t g, const double* const (&from)[2],
                         const double* to, uint32_t asked) noexcept {
  const double* ridge[2];
  if (!shared_ridge(env, env.map.record(cell), f, g, ridge)) return kNoRidge;
  // What line_side asks, with the end as the origin: the ridge's plane with the end serves both ways.
  const filter::Vec<3> a = filter::difference<3>(ridge[0], to), b = filter::difference<3>(ridge[1], to),
                       normal = filter::cross(a, b);
  uint32_t by_f = 0;
  for (uint32_t i = 0; i < 2; ++i) {
    if ((asked >> i & 1) == 0) continue;
    const filter::Vec<3> way = filter::difference<3>(to, from[i]);
    const double det = filter::dot(normal, way);
    const bool certain = filter::certain(det, filter::extent(way, a, b));
    const int side = certain ? filter::sign_of(det) : line_side<3>(from[i], to, ridge, NoTally{}).sign;
    by_f |= uint32_t{side > 0} << i;
  }
  return by_f;
}

}  // namespace

uint32_t follow_ways(const Environment<3>& env, Cell cell, uint32_t facets, const double* const (&from)[2],
                     const double* to, Cell last, uint32_t asked) noexcept {
  uint32_t leads = 0;
  for (uint32_t looks = 0; facets != 0; ++looks) {
    const uint32_t f = lowest_bit(facets), g = highest_bit(facets);
    if ((facets & ~(1u << f | 1u << g)) != 0) break;
    const uint32_t by_f = f == g ? asked : leaves_by_first(env, cell, f, g, from, to, asked);
    if (by_f == kNoRidge) break;
    const Cell left = cell;
    const uint32_t by_facet[2] = {by_f, asked & ~by_f};
    asked = 0;
    for (uint32_t k = 0; k < 2; ++k) {
      if (by_facet[k] == 0) continue;
      const Cell next = open_neighbour(env, left, k == 0 ? f : g);
      if (next == last) {
        leads |= by_facet[k];
      } else if (next.valid()) {
        asked = by_facet[k];
        cell = next;
      }
    }
    if (asked == 0 || looks == kMostFurtherLooks) break;
    uint8_t outside = 0;
    find_outside(env, &cell, &to, 1, &outside);
    facets = outside;
  }
  return leads;
}

DSW_INSTANTIATE(find_outside);

}  // namespace dsw
