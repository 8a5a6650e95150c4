#include "body/box.h"

#include <algorithm>

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

template struct Box<2>;
template struct Box<3>;

}  // namespace dsw
