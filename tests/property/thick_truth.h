// Distances of hulls of one to four points in exact rational arithmetic: what a vertex, edge or face of a body sweeps,
// and what it must keep away from.
#pragma once

#include "mesh.h"

#include "../gmp_numbers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace dsw::oracle {

/// The corners: a point, a segment, a triangle or a tetrahedron. They need not be independent.
using Hull = std::vector<Vec>;

/// The nearest points of two hulls, in doubles or in rationals.
template <class Number>
class Nearest {
 public:
  using Point = std::array<Number, 3>;

  Nearest(const std::vector<Point>& a, const std::vector<Point>& b) : a_(a), b_(b) {
    // The nearest points lie in the inside of some pair of features, and are the only nearest ones of their planes if
    // the features are chosen as small as possible. If the hulls meet, such features have at most five corners.
    for (unsigned i = 1; i < 1u << a.size(); ++i) {
      for (unsigned j = 1; j < 1u << b.size(); ++j) {
        if (__builtin_popcount(i) + __builtin_popcount(j) <= 5) take(i, j);
      }
    }
  }

  Number square{};  // of the distance
  Point on_a{}, on_b{};

 private:
  static Number dot(const Point& x, const Point& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }
  static Point minus(const Point& x, const Point& y) { return {x[0] - y[0], x[1] - y[1], x[2] - y[2]}; }
  static Number det(const Point& x, const Point& y, const Point& z) {
    return x[0] * (y[1] * z[2] - y[2] * z[1]) - x[1] * (y[0] * z[2] - y[2] * z[0]) + x[2] * (y[0] * z[1] - y[1] * z[0]);
  }

  void take(unsigned i, unsigned j) {
    corners_a_.clear();
    corners_b_.clear();
    for (size_t k = 0; k < 4; ++k) {
      if ((i >> k & 1) != 0) corners_a_.push_back(&a_[k]);
      if ((j >> k & 1) != 0) corners_b_.push_back(&b_[k]);
    }
    std::array<Point, 3> ways;
    size_t count = 0;
    for (size_t k = 1; k < corners_a_.size(); ++k) ways[count++] = minus(*corners_a_[k], *corners_a_[0]);
    for (size_t k = 1; k < corners_b_.size(); ++k) ways[count++] = minus(*corners_b_[0], *corners_b_[k]);
    std::array<Number, 3> z;
    if (!solve(ways, count, minus(*corners_b_[0], *corners_a_[0]), z)) return;
    Point x, y;
    if (!sum(corners_a_, z.data(), x) || !sum(corners_b_, z.data() + corners_a_.size() - 1, y)) return;
    const Point way = minus(x, y);
    const Number found = dot(way, way);
    if (is_found_ && found >= square) return;
    is_found_ = true;
    square = found;
    on_a = x;
    on_b = y;
  }
  /// The normal equations; of three ways the system itself. False: there is no single solution.
  static bool solve(const std::array<Point, 3>& w, size_t count, const Point& rest, std::array<Number, 3>& z) {
    if (count == 0) return true;
    if (count == 1) {
      const Number square = dot(w[0], w[0]);
      if (square == 0) return false;
      z[0] = dot(w[0], rest) / square;
      return true;
    }
    if (count == 2) {
      const Number m00 = dot(w[0], w[0]), m01 = dot(w[0], w[1]), m11 = dot(w[1], w[1]);
      const Number r0 = dot(w[0], rest), r1 = dot(w[1], rest), d = m00 * m11 - m01 * m01;
      if (d == 0) return false;
      z[0] = (r0 * m11 - r1 * m01) / d;
      z[1] = (m00 * r1 - m01 * r0) / d;
      return true;
    }
    const Number d = det(w[0], w[1], w[2]);
    if (d == 0) return false;
    z = {det(rest, w[1], w[2]) / d, det(w[0], rest, w[2]) / d, det(w[0], w[1], rest) / d};
    return true;
  }
  /// False: not in the hull.
  static bool sum(const std::vector<const Point*>& corners, const Number* weights, Point& x) {
    x = *corners[0];
    Number left = 1;
    for (size_t k = 1; k < corners.size(); ++k) {
      const Number& w = weights[k - 1];
      if (w < 0) return false;
      left -= w;
      for (size_t axis = 0; axis < 3; ++axis) x[axis] += w * ((*corners[k])[axis] - (*corners[0])[axis]);
    }
    return left >= 0;
  }

  const std::vector<Point>&a_, &b_;
  std::vector<const Point*> corners_a_, corners_b_;
  bool is_found_ = false;
};

inline mpq_class square_of_distance(const Hull& a, const Hull& b) {
  using Point = Nearest<mpq_class>::Point;
  const auto exact = [](const Hull& hull) {
    std::vector<Point> points;
    for (const Vec& p : hull) points.push_back({mpq_class(p[0]), mpq_class(p[1]), mpq_class(p[2])});
    return points;
  };
  return Nearest<mpq_class>(exact(a), exact(b)).square;
}

/// Also where the square is out of the range of doubles.
inline mpf_class root(const mpq_class& square) {
  mpf_class wide(0, 256);
  wide = square;
  return sqrt(wide);
}

/// The distance of two hulls up to rounding, with certain bounds.
struct Apart {
  double low = 0, high = HUGE_VAL;
  Vec way{};  // unit, from b towards a; 0 if it is not known
};

inline Apart apart(const Hull& a, const Hull& b) {
  // Coordinates from one corner on, scaled by a power of two: all are at most 2, and rounded once.
  double most = 0;
  for (const Hull* hull : {&a, &b}) {
    for (const Vec& p : *hull) most = std::max({most, std::fabs(p[0]), std::fabs(p[1]), std::fabs(p[2])});
  }
  Apart found;
  if (most == 0) return {0, 0, {}};
  const int scale = std::ilogb(most) + 1;
  const auto small = [&](double x) { return std::ldexp(x, -scale); };
  double reach = 0;
  const auto from_corner = [&](const Hull& hull) {
    std::vector<Nearest<double>::Point> points;
    for (const Vec& p : hull) {
      Nearest<double>::Point q;
      for (size_t k = 0; k < 3; ++k) {
        q[k] = small(p[k]) - small(b[0][k]);
        reach = std::max(reach, std::fabs(q[k]));
      }
      points.push_back(q);
    }
    return points;
  };
  const auto p = from_corner(a), q = from_corner(b);
  const double error = 0x1p-46 * reach + 0x1p-1060;  // far more than a few sums of three products are off
  const Nearest<double> nearest(p, q);
  Vec way;
  for (size_t k = 0; k < 3; ++k) way[k] = nearest.on_a[k] - nearest.on_b[k];
  const double length = std::hypot(way[0], way[1], way[2]);
  found.high = std::ldexp(length + error, scale);
  if (!(length > 0)) return found;
  for (double& x : way) x /= length;
  found.way = way;
  // Two planes across the way between the nearest points have the hulls on their outer sides.
  const auto along = [&](const Nearest<double>::Point& x) { return x[0] * way[0] + x[1] * way[1] + x[2] * way[2]; };
  double least = HUGE_VAL, largest = -HUGE_VAL;
  for (const auto& x : p) least = std::min(least, along(x));
  for (const auto& x : q) largest = std::max(largest, along(x));
  found.low = std::max(0.0, std::ldexp(least - largest - error, scale));
  return found;
}

/// A distance to be kept, times a factor.
struct Limit {
  Limit(const mpq_class& length, const mpq_class& factor = 1) : square(length * factor) {
    low = square.get_d();  // truncated
    high = std::nextafter(low, HUGE_VAL);
    square *= square;
  }
  double low, high;
  mpq_class square;
};
/// 1 - 2^-bits, or 1 + 2^-bits.
inline mpq_class less_by(unsigned bits) { return 1 - mpq_class(1, mpz_class(1) << bits); }
inline mpq_class more_by(unsigned bits) { return 1 + mpq_class(1, mpz_class(1) << bits); }

/// Exactly.
inline bool is_nearer(const Hull& a, const Hull& b, const Limit& limit) {
  const Apart about = apart(a, b);
  if (about.low >= limit.high) return false;
  if (about.high < limit.low) return true;
  return square_of_distance(a, b) < limit.square;
}

struct HullBox {
  explicit HullBox(const Hull& hull) : low(hull[0]), high(hull[0]) {
    for (const Vec& p : hull) {
      for (size_t k = 0; k < 3; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
    }
  }
  /// Certainly farther than `by` from the other box, as the rounding of a difference is far below a thousandth.
  bool is_beyond(const HullBox& other, double by) const {
    const double wide = 1.001 * by;
    for (size_t k = 0; k < 3; ++k) {
      if (low[k] - other.high[k] > wide || other.low[k] - high[k] > wide) return true;
    }
    return false;
  }
  Vec low, high;
};

}  // namespace dsw::oracle
