#include "corridor/first_ridge.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/compiler.h"
#include "base/search.h"
#include "environment/marking.h"
#include "predicates/filtered.h"
#include "predicates/tally.h"
#include "walk/shear.h"
#include "walk/standard_facets.h"

namespace dsw {
namespace {

/** Finds the earliest of the ridges that an edge meets. */
class RidgeSearch {
 public:
  RidgeSearch(const Environment<3>& env, const EdgeMotion& m, bool p_first, FirstRidge& first) noexcept
      : env_(env), m_(m), p_first_(p_first), from_(p_first ? m.to : m.q), to_(p_first ? m.q : m.to), first_(first) {}

  /** False: two ridges are met at one time. The last `added` facets at the end of p are those that its path adds. */
  bool look_at(const Corridor<3>& corridor, size_t added) noexcept {
    const size_t count = corridor.facets.size(), low = p_first_ ? added : 0, high = low + (count - added);
    HalfFacet last[2];
    int last_count = 0;
    for (size_t begin = 0; begin < count; begin += kMostMissed) {
      const size_t some = std::min(kMostMissed, count - begin);
      Shear line(from_, to_);
      uint64_t ask = kMissedTriangles(line, corridor.rows.span(begin, some));
      if (!line.passed_all()) ask = ~uint64_t{0} >> (kMostMissed - some);  // a filter cannot tell: all are asked
      for (; ask != 0; ask &= ask - 1) {
        const size_t i = begin + lowest_bit(ask);
        const HalfFacet facet{corridor.facets[i]};
        if (i < low || i >= high) {
          last[last_count++] = facet;
        } else if (!look_at(line, facet)) {
          return false;
        }
      }
    }
    if (p_first_) std::reverse(last, last + last_count);
    for (int i = 0; i < last_count; ++i) {
      if (!look_at_added(last[i])) return false;
    }
    return true;
  }

 private:
  /** One that the path of p adds: the edge passes it from then on, if it has met nothing before. */
  bool look_at_added(HalfFacet facet) noexcept {
    if (first_.facet.valid()) {
      const Cell c = tetrahedron_of(facet);
      const uint8_t(&local)[3] = kTetrahedronFacets[local_in_tetrahedron(facet)];
      const SweepEvent passed{{env_.point(c, local[0]), env_.point(c, local[1]), env_.point(c, local[2])}};
      const int order = compare_events<3>(m_.p, m_.to, first_.event, passed).sign;
      if (order <= 0) return order < 0;
    }
    Shear line(from_, to_);
    return look_at(line, facet);
  }

  bool look_at(Shear& line, HalfFacet facet) noexcept {
    const uint32_t* const w = env_.map.record(tetrahedron_of(facet));
    const uint8_t(&local)[3] = kTetrahedronFacets[local_in_tetrahedron(facet)];
    uint32_t vertices[3];
    const double* at[3];
    Shear::Point points[3];
    for (int i = 0; i < 3; ++i) {
      vertices[i] = w[local[i]] & kVertexMask;
      at[i] = env_.point(vertices[i]);
      points[i] = line(at[i]);
    }
    const double bound = line.is_in_range(line.largest()) ? Shear::bound(line.largest()) : INFINITY;
    for (int i = 0; i < 3; ++i) {
      const int next = i == 2 ? 0 : i + 1;
      const double side = Shear::side(points[i], points[next]);
      if (side > bound) continue;
      const uint32_t low = std::min(vertices[i], vertices[next]), high = std::max(vertices[i], vertices[next]);
      if (is(first_, low, high) || is(later_, low, high)) continue;
      const double* const ends[2] = {at[i], at[next]};
      if (!(side < -bound) && line_side<3>(from_, to_, ends, NoTally{}).sign > 0) continue;
      if (!consider({facet, {{low, high}}, {{m_.q, env_.point(low), env_.point(high)}, EventKind::kEdge}}))
        return false;
    }
    return true;
  }

  static bool is(const FirstRidge& ridge, uint32_t low, uint32_t high) noexcept {
    return ridge.ridge == RidgeName{{low, high}};
  }
  bool consider(FirstRidge ridge) noexcept {
    if (first_.facet.valid()) {
      const int order = compare_events<3>(m_.p, m_.to, ridge.event, first_.event).sign;
      if (order == 0) return false;
      if (order < 0) std::swap(first_, ridge);
      later_ = ridge;
      return true;
    }
    first_ = ridge;
    return true;
  }

  const Environment<3>& env_;
  const EdgeMotion& m_;
  const bool p_first_;
  const double *const from_, *const to_;
  FirstRidge& first_;
  FirstRidge later_;  // one that is met later: the next facet may have it, too
};

}  // namespace

bool turn_round(const Environment<3>& env, Corridor<3>& corridor, const FirstRidge& ridge) {
  const RidgeName& pivot = ridge.ridge;
  if (env.marked_edges != 0 && edge_marked(env, pivot.vertices[0], pivot.vertices[1])) return false;
  const Array<uint32_t>& facets = corridor.facets;
  const auto at = dsw::find(facets.begin(), facets.end(), ridge.facet.word);
  if (at == facets.end()) return false;
  return turn_in_rows(env, corridor, static_cast<size_t>(at - facets.begin()), pivot);
}

bool find_first_ridge(const Environment<3>& env, const Corridor<3>& corridor, const EdgeMotion& m, bool p_first,
                      size_t added, FirstRidge* first) noexcept {
  *first = {};
  return RidgeSearch(env, m, p_first, *first).look_at(corridor, added);
}

}  // namespace dsw
