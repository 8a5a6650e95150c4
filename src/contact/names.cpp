#include "contact/names.h"

#include "flood/fan.h"

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

template dsw_edge_id edge_id(const Map<2>& map, Dart d) noexcept;
template dsw_edge_id edge_id(const Map<3>& map, Dart d) noexcept;

}  // namespace dsw
