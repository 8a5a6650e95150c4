#include "apart.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace knot {
namespace {

/// A sum of doubles that is exact: its parts do not overlap, the last is the largest [Shewchuk 1997, grow expansion].
class ExactSum {
 public:
  void add(double x) {
    for (double& part : parts_) {
      const double sum = x + part, virtual_part = sum - x;
      part = (x - (sum - virtual_part)) + (part - virtual_part);
      x = sum;
    }
    parts_.push_back(x);
  }
  void add_product(double a, double b) {
    const double high = a * b;
    add(high);
    add(std::fma(a, b, -high));
  }
  void add_product(double a, double b, double c) {
    const double high = a * b;
    add_product(high, c);
    add_product(std::fma(a, b, -high), c);
  }
  int sign() const {
    for (std::size_t i = parts_.size(); i-- > 0;) {
      if (parts_[i] != 0) return parts_[i] > 0 ? 1 : -1;
    }
    return 0;
  }

 private:
  std::vector<double> parts_;
};

/// The side of line a b on which x lies, seen along an axis.
int side(const Point& a, const Point& b, const Point& x, std::size_t axis) {
  const std::size_t i = (axis + 1) % 3, j = (axis + 2) % 3;
  ExactSum sum;
  const Point* const points[3] = {&a, &b, &x};
  for (std::size_t k = 0; k < 3; ++k) {
    const Point &from = *points[k], &to = *points[(k + 1) % 3];
    sum.add_product(from[i], to[j]);
    sum.add_product(-from[j], to[i]);
  }
  return sum.sign();
}

/// The determinant of three rows.
void add_determinant(ExactSum& sum, double sign, const Point& a, const Point& b, const Point& c) {
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
    sum.add_product(sign * a[k], b[l], c[m]);
    sum.add_product(-sign * a[k], b[m], c[l]);
  }
}

/// Whether four points lie in one plane.
bool are_coplanar(const Point& a, const Point& b, const Point& c, const Point& d) {
  double u[3], v[3], w[3], largest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    u[k] = b[k] - a[k], v[k] = c[k] - a[k], w[k] = d[k] - a[k];
    largest = std::max({largest, std::fabs(u[k]), std::fabs(v[k]), std::fabs(w[k])});
  }
  const double volume =
      u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2]) + u[2] * (v[0] * w[1] - v[1] * w[0]);
  if (std::fabs(volume) > 1e-14 * largest * largest * largest) return false;  // some 6 times what rounding can do
  ExactSum sum;
  add_determinant(sum, 1, b, c, d);
  add_determinant(sum, -1, a, c, d);
  add_determinant(sum, 1, a, b, d);
  add_determinant(sum, -1, a, b, c);
  return sum.sign() == 0;
}

}  // namespace

bool are_apart(const Point& a, const Point& b, const Point& c, const Point& d) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (std::max(a[k], b[k]) < std::min(c[k], d[k]) || std::max(c[k], d[k]) < std::min(a[k], b[k])) return true;
  }
  if (!are_coplanar(a, b, c, d)) return true;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const int at_c = side(a, b, c, axis), at_d = side(a, b, d, axis);
    const int at_a = side(c, d, a, axis), at_b = side(c, d, b, axis);
    // Where all are 0 the plane is seen edge-on.
    if (at_a != 0 || at_b != 0 || at_c != 0 || at_d != 0) return at_a * at_b > 0 || at_c * at_d > 0;
  }
  return false;  // in one line, and their boxes overlap
}

}  // namespace knot
