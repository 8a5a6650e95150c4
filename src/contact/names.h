#pragma once
// Ids of the environment's cells as a host reads them, and what stands behind a facet.

#include "dartsweep/contact.h"
#include "environment/environment.h"
#include "map/dart.h"

namespace dsw {

template <int D>
DSW_NOINLINE dsw_volume_id volume_id(const Map<D>& map, Cell c) noexcept {
  return c.valid() ? dsw_volume_id{map.index(c), map.generation(c)} : dsw_volume_id{0, 0};
}

/** Names the half-facet as it is given; reports pass the canonical one. */
template <int D>
dsw_face_id face_id(const Map<D>& map, HalfFacet h) noexcept {
  const Cell c = map.cell_of(h);
  return {map.index(c), map.generation(c), map.local_of(h, c)};
}

/** Canonical: that of the volume with the lowest index round the edge. */
template <int D>
dsw_edge_id edge_id(const Map<D>& map, Dart d) noexcept;

/** Names an edge canonically; `lowest` is its dart in the volume with the lowest index. */
template <int D>
dsw_edge_id id_of_lowest(const Map<D>& map, Dart lowest) noexcept {
  const Cell c = lowest.cell;
  return {map.index(c), map.generation(c), map.shape(c).dart_edge(lowest.local)};
}

/** The edge of a cell between two vertices; invalid if there is none. */
template <int D>
Dart dart_between(const Map<D>& map, Cell c, const uint32_t* ends) noexcept;

inline bool is_null(dsw_volume_id id) noexcept { return (id.index | id.generation) == 0; }

template <int D>
bool is_alive(const Map<D>& map, dsw_volume_id id) noexcept {
  return map.is_alive(id.index, id.generation);
}

/** A facet as it is seen from one of its cells; from another place as it is given. */
template <int D>
HalfFacet seen_from(const Map<D>& map, Cell front, HalfFacet facet) noexcept {
  const HalfFacet other = map.opposite(facet);
  return other.valid() && map.cell_of(other) == front ? other : facet;
}

/** Host tag of what stands behind an impassable facet; at the outer boundary that of `in_front`. */
template <int D>
uint32_t obstacle_tag(const Environment<D>& env, HalfFacet facet, Cell in_front) noexcept {
  const HalfFacet other = env.map.opposite(facet);
  return env.tag(other.valid() ? env.map.cell_of(other) : in_front);
}

/** What makes a facet impassable: its own mark or the outer boundary, or else the volume behind it. */
template <int D>
dsw_cell_kind obstacle_kind(const Environment<D>& env, HalfFacet facet) noexcept {
  return !env.map.opposite(facet).valid() || env.map.facet_marked(facet) ? DSW_CELL_FACE : DSW_CELL_VOLUME;
}

// What was touched, in a contact: first the wall, as it is seen from in front, then the part of it.

template <int D>
void name_wall(const Environment<D>& env, HalfFacet wall, dsw_contact& contact) noexcept {
  const Map<D>& map = env.map;
  const HalfFacet other = map.opposite(wall);
  contact.kind = DSW_CONTACT_PLANE;
  contact.wall = face_id(map, canonical(map, wall));
  contact.obstacle = {DSW_CELL_FACE, contact.wall.volume, contact.wall.generation, contact.wall.local};
  contact.front = volume_id(map, map.cell_of(wall));
  contact.behind = volume_id(map, other.valid() ? map.cell_of(other) : Cell{});
  contact.marked_kind = obstacle_kind(env, wall);
  contact.tag = obstacle_tag(env, wall, map.cell_of(wall));
}

inline void name_edge(const dsw_edge_id& edge, dsw_contact& contact) noexcept {
  contact.kind = DSW_CONTACT_EDGE;
  contact.obstacle = {DSW_CELL_EDGE, edge.volume, edge.generation, edge.local};
}

/** Names, of all walls at a touched edge or vertex that are reached from `front` round it, the one with the lowest canonical id: the
 * contact of a body that moves as a whole does not depend on which of its vertices goes first. Throws std::bad_alloc. */
template <int D>
void name_lowest_wall(const Environment<D>& env, dsw_contact& contact);

template <int D>
void name_vertex(const Map<D>& map, uint32_t vertex, dsw_contact& contact) noexcept {
  contact.kind = DSW_CONTACT_VERTEX;
  contact.obstacle = {DSW_CELL_VERTEX, vertex, map.vertex_generation(vertex), 0};
}

}  // namespace dsw
