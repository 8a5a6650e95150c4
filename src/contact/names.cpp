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

template Dart dart_between(const Map<2>& map, Cell c, const uint32_t* ends) noexcept;
template Dart dart_between(const Map<3>& map, Cell c, const uint32_t* ends) noexcept;
template dsw_edge_id edge_id(const Map<2>& map, Dart d) noexcept;
template dsw_edge_id edge_id(const Map<3>& map, Dart d) noexcept;

}  // namespace dsw
