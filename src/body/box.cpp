#include "body/box.h"

#include <algorithm>

namespace dsw {

Box Box::everything() noexcept {
  Box box;
  std::swap(box.lower, box.upper);
  return box;
}

bool Box::contains(const double* point) const noexcept {
  for (int k = 0; k < 3; ++k) {
    if (!(lower[k] <= point[k] && point[k] <= upper[k])) return false;
  }
  return true;
}

bool Box::overlaps(const double* const* points, int count) const noexcept {
  Box box;
  for (int i = 0; i < count; ++i) box.add(points[i]);
  return overlaps(box);
}

}  // namespace dsw
