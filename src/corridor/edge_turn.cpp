#include "corridor/edge_turn.h"

#include "base/search.h"
#include "corridor/convex_cells.h"
#include "corridor/facet_pass.h"

namespace dsw {
namespace {

/** The vertices of a facet, in its order; a triangle repeats the last. */
struct Ring {
  uint32_t vertices[4];

  /** Reads the corners of a facet of a cell with standard facets. */
  Ring(const Map<3>& map, Cell c, uint32_t facet) noexcept { standard_corners(map.record(c), facet, vertices); }
};

/** Finds what the line misses of a facet: the first ridge that it passes on the wrong side, as far as rounded tests
 * tell. False: it certainly misses none. */
bool find_missed(const Environment<3>& env, const Ring& ring, const double* from, const double* to,
                 RidgeName& pivot) noexcept {
  const double* corners[4];
  for (int i = 0; i < 4; ++i) corners[i] = env.point(ring.vertices[i]);
  if (kPassesFacet(corners, from, to)) return false;
  const filter::Vec<3> way = filter::difference<3>(to, from);
  for (int k = 0; k < 4; ++k) {
    const int next = k == 3 ? 0 : k + 1;
    if (corners[k] == corners[next]) continue;
    pivot = {{ring.vertices[k], ring.vertices[next]}};
    const filter::Vec<3> a = filter::difference<3>(corners[k], from), b = filter::difference<3>(corners[next], from);
    if (!(filter::dot(filter::cross(a, b), way) > 0)) break;
  }
  return true;
}

/** The cells of the few forms that turn_at can turn among. */
struct StandardCells : ConvexCells<3> {
  explicit StandardCells(const Map<3>& map_of_cells) : ConvexCells<3>{map_of_cells} {}

  bool suits(Cell c) const noexcept { return has_standard_facets(map.form(c)) && map.convex(c); }
  Ring ring(uint32_t facet) const noexcept {
    const Cell c = map.cell_of({facet});
    return {map, c, map.local_of({facet}, c)};
  }
};

}  // namespace

bool turn_round_edge(const Environment<3>& env, Corridor<3>& corridor, const double* from, const double* to,
                     RidgeName& pivot) {
  const Map<3>& map = env.map;
  const Array<uint32_t>& facets = corridor.facets;
  const StandardCells cells{map};
  if (!dsw::all_of(facets.begin(), facets.end(), [&](uint32_t f) { return cells.suits(map.cell_of({f})); })) {
    return false;
  }
  const auto is_missed = [&](uint32_t f) { return find_missed(env, cells.ring(f), from, to, pivot); };
  const auto missed = dsw::find_if(facets.begin(), facets.end(), is_missed);
  return missed != facets.end() && turn_at(env, corridor, static_cast<size_t>(missed - facets.begin()), pivot, cells);
}

}  // namespace dsw
