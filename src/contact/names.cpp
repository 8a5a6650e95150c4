#include "contact/names.h"

#include "flood/sequence.h"
#include "walk/standard_facets.h"

namespace dsw {
namespace {

/** The cell of the lowest index round the edge of a dart, if all are tetrahedra: links and corners are words of their
 * records. Invalid: they are not. */
Cell lowest_tetrahedron_round(const Map<3>& map, Dart d, const Pivot<3>& edge) noexcept {
  Cell lowest = d.cell;
  if (map.form(lowest) != Form::kSimplex) return {};
  const HalfFacet start = half_facet(map, d);
  bool all = true;
  // From a half-facet of the cell that has been seen, round the edge until all are seen or the boundary comes.
  const auto go_round = [&](HalfFacet left) {
    for (HalfFacet entered = map.opposite(left); entered.valid();) {
      const Cell c = map.cell_of(entered);
      if (c == d.cell) return true;
      all = all && map.form(c) == Form::kSimplex;
      if (!all) return true;
      if (map.index(c) < map.index(lowest)) lowest = c;
      entered = map.opposite(other_at(map, c, entered, edge));
    }
    return false;
  };
  if (!go_round(other_at(map, d.cell, start, edge))) go_round(start);
  return all ? lowest : Cell{};
}

dsw_edge_id edge_id_among_tetrahedra(const Map<3>& map, Dart d) noexcept {
  const Pivot<3> edge{{dart_vertex(map, d), dart_target(map, d)}};
  const Cell c = lowest_tetrahedron_round(map, d, edge);
  if (!c.valid()) return {0, 0, 0};
  const auto is_of_edge = [&](uint32_t local) {
    const uint32_t vertex = map.vertex(c, local);
    return vertex == edge.vertices[0] || vertex == edge.vertices[1];
  };
  uint32_t local = 0;
  for (uint32_t f = 0; f < 4; ++f) {
    for (uint32_t k = 0; k < 3; ++k) {
      if (is_of_edge(kTetrahedronFacets[f][k]) && is_of_edge(kTetrahedronFacets[f][(k + 1) % 3])) local = 3 * f + k;
    }
  }
  return {map.index(c), map.generation(c), map.shape(c).dart_edge(local)};
}

}  // namespace

template <int D>
dsw_edge_id edge_id(const Map<D>& map, Dart d) noexcept {
  if constexpr (D == 3) {
    const dsw_edge_id id = edge_id_among_tetrahedra(map, d);
    if (id.generation != 0) return id;
  }
  Dart lowest = d;
  for_each_volume_round_edge(map, d, [&](Dart e) {
    if (map.index(e.cell) < map.index(lowest.cell)) lowest = e;
    return true;
  });
  return {map.index(lowest.cell), map.generation(lowest.cell), map.shape(lowest.cell).dart_edge(lowest.local)};
}

template dsw_edge_id edge_id(const Map<2>& map, Dart d) noexcept;
template dsw_edge_id edge_id(const Map<3>& map, Dart d) noexcept;

}  // namespace dsw
