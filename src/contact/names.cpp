#include "contact/names.h"

namespace dsw {

template <int D>
dsw_edge_id edge_id(const Map<D>& map, Dart d) noexcept {
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
