#include "body/box.h"

#include <algorithm>
#include <cmath>

#include "base/dimensions.h"

namespace dsw {

template <int D>
Box<D> Box<D>::everything() noexcept {
  Box<D> box;
  std::swap(box.lower, box.upper);
  return box;
}

template <int D>
bool Box<D>::overlaps(const double* const* points, int count) const noexcept {
  Box<D> box;
  for (int i = 0; i < count; ++i) box.add(points[i]);
  return overlaps(box);
}

template <int D>
Box<D> widened(const Box<D>& box, double room) noexcept {
  Box<D> wide = box;
  for (int k = 0; room > 0 && k < D; ++k) {
    const double all = room + 0x1p-40 * (room + std::fabs(box.lower[k]) + std::fabs(box.upper[k]));
    wide.lower[k] -= all;
    wide.upper[k] += all;
  }
  return wide;
}

template struct Box<2>;
template struct Box<3>;
DSW_INSTANTIATE(widened);

}  // namespace dsw
