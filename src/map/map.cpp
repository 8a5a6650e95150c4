#include "map/map.h"

namespace dsw {

template <int D>
Shape Map<D>::shape(Cell c) const {
  const uint32_t word0 = record(c)[0];
  const Form f = form_of(word0);
  if (f == Form::kGeneral) return general_shape(word0);
  if constexpr (D == 2) {
    return planar_shape(f == Form::kSimplex ? 3u : 4u);
  } else {
    return standard_shape(f, f == Form::kSimplex ? 0u : word0 & kShapeMask);
  }
}

template struct Map<2>;
template struct Map<3>;

}  // namespace dsw
