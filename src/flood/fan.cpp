#include "flood/fan.h"

#include "flood/sequence.h"
#include "walk/standard_facets.h"

namespace dsw {
namespace {

constexpr int kMostFanCells = 64, kMostWallFacets = 32;

/** Whether a wall that begins where its edge pierces a triangle can be followed until it leaves the triangle. */
bool leaves(const Environment<3>& env, const SweptTriangle& triangle, HalfFacet wall,
            const uint32_t (&begin)[2]) noexcept {
  const Map<3>& map = env.map;
  uint32_t edge[2] = {begin[0], begin[1]};
  for (int facets = 0; facets < kMostWallFacets; ++facets) {
    const Cell c = map.cell_of(wall);
    uint32_t tip = 0;
    for (const uint8_t local : kTetrahedronFacets[map.local_of(wall, c)]) {
      const uint32_t vertex = map.vertex(c, local);
      if (vertex != edge[0] && vertex != edge[1]) tip = vertex;
    }
    // It leaves this facet through the edge from the tip to the vertex on the other side of the triangle's plane.
    const int side = triangle.side(env.point(tip));
    const uint32_t other = triangle.side(env.point(edge[0])) == side ? edge[1] : edge[0];
    if ((triangle.outside(env.point(other), env.point(tip), side) & SweptTriangle::kSides) != 0) return true;
    edge[0] = other;
    edge[1] = tip;
    // Round its rim a sheet leads back to where it begins.
    if ((other == begin[0] || other == begin[1]) && (tip == begin[0] || tip == begin[1])) return false;
    wall = find_wall(env, wall, edge);
    if (!wall.valid()) return false;
  }
  return false;
}

}  // namespace

HalfFacet find_wall(const Environment<3>& env, HalfFacet entered, const uint32_t (&edge)[2]) noexcept {
  const Map<3>& map = env.map;
  const Pivot<3> pivot{{edge[0], edge[1]}};
  for (int cells = 0; cells < kMostFanCells; ++cells) {
    const Cell c = map.cell_of(entered);
    if (map.form(c) != Form::kSimplex) return {};
    const HalfFacet next = other_at(map, c, entered, pivot);
    if (is_impassable(env, next)) return next;
    entered = map.opposite(next);
  }
  return {};
}

bool sees_only_fan(const Environment<3>& env, const SweptTriangle& triangle, const HalfFacet (&walls)[2],
                   const uint32_t (&edge)[2]) noexcept {
  return leaves(env, triangle, walls[0], edge) && leaves(env, triangle, walls[1], edge);
}

}  // namespace dsw
