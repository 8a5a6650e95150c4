#include "contact/names.h"

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

void name_lower_wall(const Environment<3>& env, dsw_contact& contact) noexcept {
  const Map<3>& map = env.map;
  if (contact.obstacle.kind != DSW_CELL_EDGE || contact.wall.generation == 0) return;
  const dsw_cell named = contact.obstacle;
  const Dart edge = dart_of_edge(map, map.cell(named.index), named.local);
  const uint32_t ends[2] = {dart_vertex(map, edge), dart_target(map, edge)};
  const Dart begin = dart_between(map, map.cell(contact.front.index), ends);
  if (!begin.cell.valid()) return;
  const auto less = [](dsw_face_id a, dsw_face_id b) {
    return a.volume != b.volume ? a.volume < b.volume : a.local < b.local;
  };
  for (Dart d : {begin, beta2(map, begin)}) {
    const Dart first = d;
    while (!is_impassable(env, half_facet(map, d))) {
      d = beta2(map, beta3(map, d));
      if (d == first) return;  // no wall of this edge
    }
    const HalfFacet wall = half_facet(map, d);
    if (!less(face_id(map, canonical(map, wall)), contact.wall)) continue;
    name_wall(env, wall, contact);
    contact.kind = DSW_CONTACT_EDGE;
    contact.obstacle = named;
  }
}

template Dart dart_between(const Map<2>& map, Cell c, const uint32_t* ends) noexcept;
template Dart dart_between(const Map<3>& map, Cell c, const uint32_t* ends) noexcept;
template dsw_edge_id edge_id(const Map<2>& map, Dart d) noexcept;
template dsw_edge_id edge_id(const Map<3>& map, Dart d) noexcept;

}  // namespace dsw
