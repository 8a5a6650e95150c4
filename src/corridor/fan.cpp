#include "corridor/fan.h"

#include "corridor/corridor.h"
#include "map/ridge_walk.h"
#include "walk/standard_facets.h"

namespace dsw {
namespace {

constexpr size_t kMostFanCells = 64;
constexpr int kMostWallFacets = 32;

/** Whether a wall that begins where its edge pierces a triangle can be followed until it leaves the triangle. `side` is
 * that of begin[0]. */
bool leaves(const Environment<3>& env, const SweptTriangle& triangle, HalfFacet wall, const uint32_t (&begin)[2],
            int side) noexcept {
  const Map<3>& map = env.map;
  uint32_t edge[2] = {begin[0], begin[1]};
  for (int facets = 0; facets < kMostWallFacets; ++facets) {
    const uint32_t* const w = map.record(tetrahedron_of(wall));
    uint32_t tip = 0u - edge[0] - edge[1];  // modulo 2^32: of three vertices that which is not on the edge remains
    for (const uint8_t local : kTetrahedronFacets[local_in_tetrahedron(wall)]) tip += w[local] & kVertexMask;
    // It leaves this facet through the edge from the tip to the vertex on the other side of the triangle's plane.
    const int side_of_tip = triangle.side(env.point(tip));
    const uint32_t other = side == side_of_tip ? edge[1] : edge[0];
    if (triangle.leaves(env.point(other), env.point(tip), side_of_tip)) return true;
    edge[0] = other;
    edge[1] = tip;
    side = -side_of_tip;
    // Round its rim a sheet leads back to where it begins.
    if ((other == begin[0] || other == begin[1]) && (tip == begin[0] || tip == begin[1])) return false;
    wall = find_wall(env, wall, edge);
    if (!wall.valid()) return false;
  }
  return false;
}

/** The cell of the lowest index round the edge of a dart, if all are tetrahedra: links and corners are words of their
 * records. Invalid: they are not. */
Cell lowest_tetrahedron_round(const Map<3>& map, Dart d, const RidgeName& edge) noexcept {
  Cell lowest = d.cell;
  if (map.form(lowest) != Form::kSimplex) return {};
  const HalfFacet start = half_facet(map, d);
  bool all = true;
  // From a half-facet of the cell that has been seen, round the edge until all are seen or the boundary comes.
  const auto go_round = [&](HalfFacet left) {
    const auto leave = [&](Cell c, HalfFacet entered) {
      all = all && map.form(c) == Form::kSimplex;
      if (c == d.cell || !all) return HalfFacet{};
      if (map.index(c) < map.index(lowest)) lowest = c;
      return other_at(map, c, entered, edge);
    };
    return walk_round(map, map.opposite(left), SIZE_MAX, leave) != RidgeWalk::kOutside;
  };
  if (!go_round(other_at(map, d.cell, start, edge))) go_round(start);
  return all ? lowest : Cell{};
}

}  // namespace

HalfFacet find_wall(const Environment<3>& env, HalfFacet start, const uint32_t (&edge)[2]) noexcept {
  const Map<3>& map = env.map;
  const RidgeName pivot{{edge[0], edge[1]}};
  HalfFacet wall;
  walk_round(map, start, kMostFanCells, [&](Cell c, HalfFacet entered) {
    if (map.form(c) != Form::kSimplex) return HalfFacet{};
    const HalfFacet next = other_at(map, c, entered, pivot);
    if (!is_impassable(env, next)) return next;
    wall = next;
    return HalfFacet{};
  });
  return wall;
}

bool is_alone(const Environment<3>& env, const HalfFacet (&walls)[2], const uint32_t (&edge)[2]) noexcept {
  const Map<3>& map = env.map;
  const RidgeName pivot{{edge[0], edge[1]}};
  size_t cells = 0;
  for (int side = 0; side < 2; ++side) {
    bool arrives = false;
    const auto leave = [&](Cell c, HalfFacet entered) {
      arrives = entered == walls[1 - side];
      if (arrives || cells == kMostFanCells || map.form(c) != Form::kSimplex || !is_closed(env, c)) return HalfFacet{};
      ++cells;
      return other_at(map, c, entered, pivot);
    };
    const RidgeWalk walk = walk_round(map, map.opposite(walls[side]), kMostFanCells + 1, leave);
    if (walk != RidgeWalk::kOutside) return arrives;
  }
  return true;
}

bool sees_only_fan(const Environment<3>& env, const SweptTriangle& triangle, const HalfFacet (&walls)[2],
                   const uint32_t (&edge)[2]) noexcept {
  const int side = triangle.side(env.point(edge[0]));
  return leaves(env, triangle, walls[0], edge, side) && leaves(env, triangle, walls[1], edge, side);
}

Dart lowest_dart_round(const Map<3>& map, Dart d) noexcept {
  const RidgeName edge{{dart_vertex(map, d), dart_target(map, d)}};
  const Cell c = lowest_tetrahedron_round(map, d, edge);
  if (!c.valid()) return {};
  const auto is_of_edge = [&](uint32_t local) {
    const uint32_t vertex = map.vertex(c, local);
    return vertex == edge.vertices[0] || vertex == edge.vertices[1];
  };
  Dart lowest{c, 0};
  for (uint32_t f = 0; f < 4; ++f) {
    for (uint32_t k = 0; k < 3; ++k) {
      if (is_of_edge(kTetrahedronFacets[f][k]) && is_of_edge(kTetrahedronFacets[f][(k + 1) % 3]))
        lowest.local = 3 * f + k;
    }
  }
  return lowest;
}

}  // namespace dsw
