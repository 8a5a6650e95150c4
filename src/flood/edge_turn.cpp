#include "flood/edge_turn.h"

#include <algorithm>

#include "flood/facet_pass.h"
#include "walk/standard_facets.h"

namespace dsw {
namespace {

/** Finds what the line misses of a facet: the first ridge that it passes on the wrong side, as far as rounded tests
 * tell. False: it certainly misses none. */
bool find_missed(const Environment<3>& env, const uint32_t (&vertices)[4], const double* from, const double* to,
                 Pivot<3>& pivot) noexcept {
  const double* corners[4];
  for (int i = 0; i < 4; ++i) corners[i] = env.point(vertices[i]);
  if (kPassesFacet(corners, from, to)) return false;
  const filter::Vec<3> way = filter::difference<3>(to, from);
  for (int k = 0; k < 4; ++k) {
    const int next = k == 3 ? 0 : k + 1;
    if (corners[k] == corners[next]) continue;
    pivot = {{vertices[k], vertices[next]}};
    const filter::Vec<3> a = filter::difference<3>(corners[k], from), b = filter::difference<3>(corners[next], from);
    if (!(filter::dot(filter::cross(a, b), way) > 0)) break;
  }
  return true;
}

}  // namespace

template <int D>
bool ConvexCells<D>::suits(Cell c) const noexcept {
  return (D == 2 || has_standard_facets(map.form(c))) && map.convex(c);
}

template <int D>
uint32_t ConvexCells<D>::corners(HalfFacet facet, uint32_t (&vertices)[4]) const noexcept {
  const Cell c = map.cell_of(facet);
  const uint32_t local = map.local_of(facet, c);
  if constexpr (D == 3) {
    standard_corners(map.record(c), local, vertices);
    return vertices[3] == vertices[2] ? 3 : 4;
  } else {
    vertices[0] = map.vertex(c, local);
    vertices[1] = map.vertex(c, local + 1 == map.vertices_of(c) ? 0 : local + 1);
    return 2;
  }
}

template <int D>
bool ConvexCells<D>::has(uint32_t facet, const Pivot<D>& pivot) const noexcept {
  uint32_t vertices[4];
  const uint32_t count = corners({facet}, vertices);
  return std::all_of(pivot.vertices, pivot.vertices + (D - 1),
                     [&](uint32_t v) { return std::find(vertices, vertices + count, v) != vertices + count; });
}

template <int D>
HalfFacet ConvexCells<D>::other(Cell c, HalfFacet entered, const Pivot<D>& pivot) const noexcept {
  if (D == 2 || map.form(c) == Form::kSimplex) return other_at(map, c, entered, pivot);
  for (uint32_t f = 0, count = map.facets_of(c); f < count; ++f) {
    const HalfFacet h = map.half_facet(c, f);
    if (h != entered && has(h.word, pivot)) return h;
  }
  return {};
}

bool turn_round_edge(const Environment<3>& env, EdgeSequence<3>& sequence, const double* from, const double* to,
                     Pivot<3>& pivot) {
  const Map<3>& map = env.map;
  const Array<uint32_t>& facets = sequence.facets;
  const ConvexCells<3> cells{map};
  if (!std::all_of(facets.begin(), facets.end(), [&](uint32_t f) { return cells.suits(map.cell_of({f})); })) {
    return false;
  }
  const auto is_missed = [&](uint32_t f) {
    uint32_t vertices[4];
    cells.corners({f}, vertices);
    return find_missed(env, vertices, from, to, pivot);
  };
  const auto missed = std::find_if(facets.begin(), facets.end(), is_missed);
  return missed != facets.end() && turn_at(env, sequence, static_cast<size_t>(missed - facets.begin()), pivot, cells);
}

template struct ConvexCells<2>;
template struct ConvexCells<3>;

}  // namespace dsw
