#include "contact/vertex_normal.h"

#include "base/dimensions.h"
#include "base/vec.h"
#include "contact/names.h"
#include "contact/walls_at.h"
#include "predicates/plane_hit.h"
#include "walk/standard_facets.h"

namespace dsw {
namespace {

// Normals that cancel but for their rounding have no mean.
constexpr double kLeast = 1e-12;

template <int D>
uint32_t nearest_vertex(const Environment<D>& env, Cell front, uint32_t facet, const double* point) {
  uint32_t nearest = 0;
  double least = -1;
  for_each_facet_vertex<D>(env.map.shape(front), facet, [&](uint32_t local) {
    const uint32_t v = env.map.vertex(front, local);
    const double distance = length(difference<D>(env.point(v), point));
    if (least < 0 || distance < least) nearest = v, least = distance;
  });
  return nearest;
}

/** Into the cell in front; of a warped facet the mean of its triangles at the vertex. */
template <int D>
Vec normal_at(const Environment<D>& env, Cell front, uint32_t facet, uint32_t vertex) {
  const Shape shape = env.map.shape(front);
  const uint16_t* local = shape.simplices();
  Vec sum;
  for (uint32_t s = shape.simplex_first(facet); s < shape.simplex_first(facet + 1); ++s) {
    bool has = false;
    for (uint32_t i = 0; i < D; ++i) has = has || env.map.vertex(front, local[s * D + i]) == vertex;
    if (!has) continue;
    const double* simplex[D];
    boundary_points(env, front, s, simplex);
    double outward[D];
    unit_normal<D>(simplex, outward);
    sum -= to_vec<D>(outward);
  }
  return unit(sum);
}

}  // namespace

template <int D>
void turn_to_vertex(const Environment<D>& env, const double* point, dsw_contact& contact) {
  const Map<D>& map = env.map;
  if (contact.wall.generation == 0) return;
  const Cell front = map.cell(contact.front.index);
  const HalfFacet wall = seen_from(map, front, map.half_facet(map.cell(contact.wall.volume), contact.wall.local));
  if (map.cell_of(wall) != front) return;  // a corner of a wall that lies across another cell
  const uint32_t vertex = nearest_vertex(env, front, map.local_of(wall, front), point);
  Vec sum;
  double count = 0;
  for_each_wall_at(env, front, {vertex, vertex}, [&](Cell cell, uint32_t facet, HalfFacet) {
    sum += normal_at(env, cell, facet, vertex);
    ++count;
  });
  if (largest(sum) > kLeast * count) store<D>(unit(sum), contact.normal);
}

DSW_INSTANTIATE(turn_to_vertex);

}  // namespace dsw
