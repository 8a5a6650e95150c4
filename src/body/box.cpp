#include "body/box.h"

#include <algorithm>
#include <limits>

namespace dsw {

Box::Box() noexcept {
  std::fill(lower, lower + 3, std::numeric_limits<double>::infinity());
  std::fill(upper, upper + 3, -std::numeric_limits<double>::infinity());
}

Box Box::everything() noexcept {
  Box box;
  std::swap(box.lower, box.upper);
  return box;
}

void Box::add(const double* point) noexcept {
  for (int k = 0; k < 3; ++k) {
    lower[k] = std::min(lower[k], point[k]);
    upper[k] = std::max(upper[k], point[k]);
  }
}

bool Box::contains(const double* point) const noexcept {
  for (int k = 0; k < 3; ++k) {
    if (!(lower[k] <= point[k] && point[k] <= upper[k])) return false;
  }
  return true;
}

bool Box::overlaps(const Box& other) const noexcept {
  for (int k = 0; k < 3; ++k) {
    if (!(lower[k] <= other.upper[k] && other.lower[k] <= upper[k])) return false;
  }
  return true;
}

bool Box::overlaps(const double* const* points, int count) const noexcept {
  Box box;
  for (int i = 0; i < count; ++i) box.add(points[i]);
  return overlaps(box);
}

}  // namespace dsw
