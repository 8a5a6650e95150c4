#include "contact/names.h"

namespace dsw {

dsw_edge_id edge_id(const Map<3>& map, Dart d) noexcept {
  dsw_edge_id lowest{UINT32_MAX, kGeneration, 0};
  for_each_volume_round_edge(map, d, [&](Dart e) {
    const uint32_t volume = map.index(e.cell);
    if (volume < lowest.volume) {
      lowest.volume = volume;
      lowest.local = map.shape(e.cell).dart_edge(e.local);
    }
    return true;
  });
  return lowest;
}

}  // namespace dsw
