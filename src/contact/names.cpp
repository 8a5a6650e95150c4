#include "contact/names.h"

#include <tuple>

#include "contact/walls_at.h"
#include "corridor/fan.h"

namespace dsw {
namespace {

template <int D>
Dart lowest_dart(const Map<D>& map, Dart d) noexcept {
  if constexpr (D == 3) {
    const Dart lowest = lowest_dart_round(map, d);
    if (lowest.cell.valid()) return lowest;
  }
  Dart lowest = d;
  for_each_volume_round_edge(map, d, [&](Dart e) {
    if (map.index(e.cell) < map.index(lowest.cell)) lowest = e;
    return true;
  });
  return lowest;
}

}  // namespace

template <int D>
dsw_edge_id edge_id(const Map<D>& map, Dart d) noexcept {
  return id_of_lowest(map, lowest_dart(map, d));
}

template <int D>
Dart dart_between(const Map<D>& map, Cell c, const uint32_t* ends) noexcept {
  for (uint32_t d = 0, darts = map.shape(c).dart_count(); d < darts; ++d) {
    const uint32_t a = dart_vertex(map, Dart{c, d}), b = dart_target(map, Dart{c, d});
    if ((a == ends[0] && b == ends[1]) || (a == ends[1] && b == ends[0])) return {c, d};
  }
  return {};
}

template <int D>
void name_lowest_wall(const Environment<D>& env, dsw_contact& contact) {
  const Map<D>& map = env.map;
  const dsw_cell named = contact.obstacle;
  if (contact.wall.generation == 0 || (named.kind != DSW_CELL_EDGE && named.kind != DSW_CELL_VERTEX)) return;
  uint32_t corners[2] = {named.index, named.index};
  if (named.kind == DSW_CELL_EDGE) {
    const Dart edge = dart_of_edge(map, map.cell(named.index), named.local);
    corners[0] = dart_vertex(map, edge);
    corners[1] = dart_target(map, edge);
  }
  const dsw_contact_kind kind = contact.kind;
  for_each_wall_at(env, map.cell(contact.front.index), corners, [&](Cell, uint32_t, HalfFacet wall) {
    const dsw_face_id id = face_id(map, canonical(map, wall));
    if (std::tie(id.volume, id.local) < std::tie(contact.wall.volume, contact.wall.local)) {
      name_wall(env, wall, contact);
    }
  });
  contact.kind = kind;
  contact.obstacle = named;
}

template void name_lowest_wall(const Environment<2>& env, dsw_contact& contact);
template void name_lowest_wall(const Environment<3>& env, dsw_contact& contact);
template Dart dart_between(const Map<2>& map, Cell c, const uint32_t* ends) noexcept;
template Dart dart_between(const Map<3>& map, Cell c, const uint32_t* ends) noexcept;
template dsw_edge_id edge_id(const Map<2>& map, Dart d) noexcept;
template dsw_edge_id edge_id(const Map<3>& map, Dart d) noexcept;

}  // namespace dsw
