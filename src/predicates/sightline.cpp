// A filter by doubles, then integers, then the shift.
//
// The filter knows an end as a rounded point x and bounds E_k of what it lacks on each axis (`Bounded`). A determinant of
// differences is linear in each of its points. So what E adds to its error is at most the sum over k of E_k times the
// minors without axis k, each of which is at most 2 m_i m_j, with m_k at least |component k| of all vectors, and E_k more
// where both ends occur. The rest is the bound of filter_bounds.h, which has 1.9 u mx my mz to spare for underflow. The
// factor 2.01 pays for the roundings of the terms with E.
//
// The integers. All axes are scaled by one power of two, as dot products add axes. Every value is linear in x and w of
// each end, so the coefficients of the shift are the values of the shift's vectors with w = 0.

#include "predicates/sightline.h"

#include <algorithm>
#include <cmath>

#include "base/compiler.h"
#include "predicates/filtered.h"

namespace dsw {
namespace {

// A double, and how far the exact value is away at most.
struct Bounded {
  double value, error;
  bool is_zero() const noexcept { return value == 0 && error == 0; }
};
// Pays for the roundings of an error's own evaluation, at most seven.
constexpr double kMore = 1 + 0x1p-50, kTiny = 0x1p-1074;

// Exact zeros stay exact. Sums and products choose by arithmetic, since a foot takes a hundred of them.
DSW_HOT Bounded with_rounding(double value, double error) noexcept {
  return {value, (error + kUnitRoundoff * std::fabs(value)) * kMore};
}
DSW_HOT Bounded operator+(const Bounded& a, const Bounded& b) noexcept {
  const Bounded sum = with_rounding(a.value + b.value, a.error + b.error);
  return {sum.value, b.is_zero() ? a.error : sum.error};
}
DSW_HOT Bounded operator-(const Bounded& a) noexcept { return {-a.value, a.error}; }
DSW_HOT Bounded operator-(const Bounded& a, const Bounded& b) noexcept { return a + -b; }
DSW_HOT Bounded operator*(const Bounded& a, const Bounded& b) noexcept {
  const double error = std::fabs(a.value) * b.error + (std::fabs(b.value) + b.error) * a.error + kTiny;
  const Bounded product = with_rounding(a.value * b.value, error * kMore);
  return {product.value, a.is_zero() || b.is_zero() ? 0 : product.error};
}
// The divisor b is positive.
DSW_HOT Bounded operator/(const Bounded& a, const Bounded& b) noexcept {
  if (a.is_zero()) return a;
  const double least = b.value - b.error;
  if (!(least > 0)) return {0, HUGE_VAL};
  const double quotient = a.value / b.value;
  return with_rounding(quotient, (a.error + std::fabs(quotient) * b.error + kTiny) / least * kMore + kTiny);
}

template <class N, int D>
struct Tuple {
  N v[D];
};
template <class N, int D>
N dot(const Tuple<N, D>& a, const Tuple<N, D>& b) {
  N sum = a.v[0] * b.v[0] + a.v[1] * b.v[1];
  if constexpr (D == 3) sum = sum + a.v[2] * b.v[2];
  return sum;
}
template <class N>
Tuple<N, 3> cross(const Tuple<N, 3>& a, const Tuple<N, 3>& b) {
  return {{a.v[1] * b.v[2] - a.v[2] * b.v[1], a.v[2] * b.v[0] - a.v[0] * b.v[2], a.v[0] * b.v[1] - a.v[1] * b.v[0]}};
}
template <class N, int D>
Tuple<N, D> times(const N& s, const Tuple<N, D>& a) {
  Tuple<N, D> product;
  for (int k = 0; k < D; ++k) product.v[k] = s * a.v[k];
  return product;
}
template <class N, int D>
Tuple<N, D> sum_of(const Tuple<N, D>& a, const Tuple<N, D>& b) {
  Tuple<N, D> sum;
  for (int k = 0; k < D; ++k) sum.v[k] = a.v[k] + b.v[k];
  return sum;
}

// way/w leads from the first point of a simplex of two or three points to that which is nearest to another simplex.
template <class N, int D>
struct Foot {
  Tuple<N, D> way;
  N w;
};
// `difference(a, b)` is a - b.
template <class N, int D, class Difference>
Foot<N, D> foot_of(const SimplexPoints& of, const SimplexPoints& to, Difference difference) {
  const double* const* const p = of.at;
  const auto r = difference(to.at[0], p[0]), u = difference(p[1], p[0]);
  const N uu = dot(u, u), ur = dot(u, r);
  if (of.count == 2 && to.count == 1) return {times(ur, u), uu};
  const auto v = of.count == 3 ? difference(p[2], p[0]) : difference(to.at[1], to.at[0]);
  const N uv = dot(u, v), vv = dot(v, v), vr = dot(v, r);
  const N w = uu * vv - uv * uv;
  const auto along = times(ur * vv - vr * uv, u);
  if (of.count == 2) return {along, w};
  return {sum_of(along, times(uu * vr - uv * ur, v)), w};
}

template <int D>
Tuple<Bounded, D> difference_of(const double* a, const double* b) noexcept {
  Tuple<Bounded, D> d;
  for (int k = 0; k < D; ++k) d.v[k] = Bounded{a[k], 0} - Bounded{b[k], 0};
  return d;
}

// n.x, where n points out of a cell and x leads from the first corner of a simplex to a point.
template <class N, int D>
N plane_value(const Tuple<N, D>& e1, const Tuple<N, D>& e2, const Tuple<N, D>& x) {
  if constexpr (D == 3) {
    return dot(cross(e1, e2), x);
  } else {
    return e1.v[1] * x.v[0] - e1.v[0] * x.v[1];
  }
}

template <int D>
int lowest_bit_of(const SimplexPoints& points, int low) noexcept {
  for (uint32_t i = 0; i < points.count; ++i) {
    for (int k = 0; k < D; ++k) {
      const integers::Decoded d = integers::decode(points.at[i][k]);
      if (d.magnitude != 0) low = std::min(low, d.exponent + static_cast<int>(lowest_bit(d.magnitude)));
    }
  }
  return low;
}

// The sign of a determinant of vectors with extent m whose ends are known up to `error`, or 0 if that is not certain.
template <class V>
int certain_sign(double det, const V& m, double more) noexcept {
  const bool is_certain = filter::lowest(m) >= kFilterMin && filter::highest(m) <= kFilterMax &&
                          std::fabs(det) > filter::bound(m) + 2.01 * more;
  return is_certain ? filter::sign_of(det) : 0;
}
int certain_sign(double det, const filter::Vec<3>& m, const double* error) noexcept {
  return certain_sign(det, m, error[0] * m.y * m.z + error[1] * m.z * m.x + error[2] * m.x * m.y);
}
int certain_sign(double det, const filter::Vec<2>& m, const double* error) noexcept {
  return certain_sign(det, m, error[0] * m.y + error[1] * m.x);
}
filter::Vec<3> widened(const filter::Vec<3>& m, const double* by) noexcept {
  return {m.x + by[0], m.y + by[1], m.z + by[2]};
}
filter::Vec<2> widened(const filter::Vec<2>& m, const double* by) noexcept { return {m.x + by[0], m.y + by[1]}; }

/** Finds a foot in doubles, with bounds that hold for any vectors of this length. False: they are too wide, or the numbers
 * too large or small. Let m be at least all components of u, v and r, e = 2^-53. Rounded differences are off by e m, dot
 * products of up to 3 m^2 by less than 16 e m^2, and products of two of these, less one another, of up to 18 m^4, by less
 * than 256 e m^4. Times a component they are off by less than 320 e m^5. A foot on a triangle adds two of them. */
template <int D>
bool find_foot(const SimplexPoints& of, const SimplexPoints& to, double* way, double* error) noexcept {
  using filter::difference, filter::dot;
  const auto r = difference<D>(to.at[0], of.at[0]), u = difference<D>(of.at[1], of.at[0]);
  const bool is_line_alone = of.count == 2 && to.count == 1;
  const auto v = is_line_alone   ? u
                 : of.count == 3 ? difference<D>(of.at[2], of.at[0])
                                 : difference<D>(to.at[1], to.at[0]);
  const double m = filter::highest(filter::extent(r, u, v));
  if (!(m > 0x1p-190 && m < 0x1p190)) return false;
  const double uu = dot(u, u), ur = dot(u, r), mm = m * m;
  double w = uu, s = ur, t = 0, more = 24 * kUnitRoundoff * mm * m, less = 16 * kUnitRoundoff * mm;
  if (!is_line_alone) {
    const double uv = dot(u, v), vv = dot(v, v), vr = dot(v, r);
    w = uu * vv - uv * uv;
    s = ur * vv - vr * uv;
    if (of.count == 3) t = uu * vr - uv * ur;
    more = 700 * kUnitRoundoff * mm * mm * m;
    less = 256 * kUnitRoundoff * mm * mm;
  }
  if (!(w > 0x1p30 * less)) return false;
  const double scale = 1 / w;
  const auto set = [&](int k, double of_u, double of_v) {
    way[k] = (s * of_u + t * of_v) * scale;
    const bool is_still = of_u == 0 && (of.count == 2 || of_v == 0);
    error[k] = is_still
                   ? 0
                   : (more + std::fabs(way[k]) * less) * scale * (1 + 0x1p-20) + 4 * kUnitRoundoff * std::fabs(way[k]);
  };
  set(0, u.x, v.x);
  set(1, u.y, v.y);
  if constexpr (D == 3) set(2, u.z, v.z);
  return true;
}

}  // namespace

template <int D>
SightEnd<D>::SightEnd(const SimplexPoints& at, const SimplexPoints& nearest_to, EndShift how) noexcept
    : of(at), to(nearest_to), shift(how), near{}, error{} {
  const double* const base = of.at[0];
  std::copy_n(base, D, near);
  if (of.count == 1) return;
  double way[3], bound[3];
  if (find_foot<D>(of, to, way, bound)) {
    for (int k = 0; k < D; ++k) {
      near[k] = base[k] + way[k];
      error[k] = bound[k] == 0 ? 0 : bound[k] + kUnitRoundoff * std::fabs(near[k]) * kMore;
    }
    return;
  }
  const Foot<Bounded, D> foot = foot_of<Bounded, D>(of, to, difference_of<D>);
  for (int k = 0; k < D; ++k) {
    const Bounded x = Bounded{base[k], 0} + foot.way.v[k] / foot.w;
    near[k] = x.value;
    error[k] = x.error;
  }
}

template <int D>
Sightline<D>::Exact::Exact(const SightEnd<D>& of_from, const SightEnd<D>& of_to) : low(1075) {
  for (const SightEnd<D>* end : {&of_from, &of_to}) low = lowest_bit_of<D>(end->to, lowest_bit_of<D>(end->of, low));
  set(of_from, from);
  set(of_to, to);
}

template <int D>
void Sightline<D>::Exact::set(const SightEnd<D>& of, End& end) {
  const auto difference = [&](const double* a, const double* b) {
    Tuple<Integer, D> d;
    for (int k = 0; k < D; ++k) d.v[k] = integer_of(pool, a[k], low) - integer_of(pool, b[k], low);
    return d;
  };
  const double* const* const p = of.of.at;
  const uint32_t count = of.of.count;
  Foot<Integer, D> foot{{}, integer_of(pool, 1)};
  if (count > 1) foot = foot_of<Integer, D>(of.of, of.to, difference);
  end.w = foot.w;
  for (int k = 0; k < D; ++k) end.x[k] = foot.w * integer_of(pool, p[0][k], low) + foot.way.v[k];
  if (of.shift == EndShift::kStill || (of.shift == EndShift::kFoot && count == 1)) return;
  end.orders = D;
  // The part of each axis along the simplex, or the whole axis, times w and the unit of coordinates.
  Tuple<Integer, D> u{};
  if (of.shift == EndShift::kFoot) u = difference(p[1], p[0]);
  if constexpr (D == 3) {
    if (of.shift == EndShift::kFoot && count == 3) u = cross(u, difference(p[2], p[0]));
  }
  const bool is_along = of.shift == EndShift::kFoot && count == 2;
  for (int i = 0; i < D; ++i) {
    for (int k = 0; k < D; ++k) {
      const Integer product = u.v[i] * u.v[k], whole = i == k ? foot.w : Integer{};
      end.shift[i][k] = shifted(is_along ? product : whole - product, 1075 - low);
    }
  }
}

/** A sign that doubles have left open, of a value that is linear in each end. */
template <int D>
class Sightline<D>::Question {
 public:
  Question(Exact& exact, std::initializer_list<SimplexPoints> points)
      : exact_(exact), scope_(exact.pool), low_(exact.low) {
    for (const SimplexPoints& each : points) low_ = lowest_bit_of<D>(each, low_);
  }
  Tuple<Integer, D> difference(const double* a, const double* b) const {
    Tuple<Integer, D> d;
    for (int k = 0; k < D; ++k) d.v[k] = coordinate(a[k]) - coordinate(b[k]);
    return d;
  }
  /** From a point to an end, times w, or part i of its shift. */
  Tuple<Integer, D> way(const typename Exact::End& end, int i, const double* from) const {
    Tuple<Integer, D> v;
    for (int k = 0; k < D; ++k) {
      v.v[k] = shifted(i == 0 ? end.x[k] : end.shift[i - 1][k], exact_.low - low_);
      if (i == 0) v.v[k] = v.v[k] - end.w * coordinate(from[k]);
    }
    return v;
  }
  Integer plane_value(const typename Exact::End& end, int i, const double* const* simplex) const {
    return dsw::plane_value(difference(simplex[1], simplex[0]), difference(simplex[D - 1], simplex[0]),
                            way(end, i, simplex[0]));
  }
  /** The first coefficient in e that is not 0, of value(i, j) times e^(i+j). */
  template <class Value>
  static int first_sign(int from_orders, int to_orders, Value value) {
    for (int order = 0; order <= from_orders + to_orders; ++order) {
      Integer sum;
      for (int i = std::max(0, order - to_orders); i <= std::min(order, from_orders); ++i) {
        sum = sum + value(i, order - i);
      }
      if (sum.sign() != 0) return sum.sign();
    }
    return 0;
  }

 private:
  Integer coordinate(double x) const { return integer_of(exact_.pool, x, low_); }

  Exact& exact_;
  IntegerPool::Scope scope_;
  int low_;
};

namespace {
template <int D>
SimplexPoints points_of(const double* const* simplex, uint32_t count) noexcept {
  SimplexPoints points{{}, count};
  std::copy_n(simplex, count, points.at);
  return points;
}

template <int D>
int certain_plane_side(const SightEnd<D>& end, const double* const* simplex) noexcept {
  const filter::Plane<D> plane(simplex, end.near);
  return certain_sign(plane.det(), plane.reach(), end.error);
}
}  // namespace

template <int D>
int Sightline<D>::exact_plane_side(bool is_end, const double* const* simplex) {
  Exact& all = exact();
  const typename Exact::End& end = is_end ? all.to : all.from;
  const Question ask(all, {points_of<D>(simplex, D)});
  return ask.first_sign(end.orders, 0, [&](int i, int) { return ask.plane_value(end, i, simplex); });
}

template <int D>
int Sightline<D>::certain_end_side(const double* const* simplex) const noexcept {
  return certain_plane_side(to_, simplex);
}
template <int D>
bool Sightline<D>::ends_beyond(const double* const* simplex) {
  const int side = certain_plane_side(to_, simplex);
  return (side != 0 ? side : exact_plane_side(true, simplex)) > 0;
}
template <int D>
bool Sightline<D>::starts_beyond(const double* const* simplex) {
  const int side = certain_plane_side(from_, simplex);
  return (side != 0 ? side : exact_plane_side(false, simplex)) > 0;
}

// In space of (p - a) x (q - a).(b - a), in the plane of (p - a) x (q - a).
template <int D>
int Sightline<D>::ridge_side(const double* const* ridge) {
  double error[D];
  for (int k = 0; k < D; ++k) error[k] = from_.error[k] + to_.error[k];
  const auto p = filter::difference<D>(from_.near, ridge[0]), q = filter::difference<D>(to_.near, ridge[0]);
  int quick;
  if constexpr (D == 3) {
    const auto e = filter::difference<3>(ridge[1], ridge[0]);
    quick = certain_sign(filter::dot(filter::cross(p, q), e), widened(filter::extent(p, q, e), error), error);
  } else {
    quick = certain_sign(p.x * q.y - p.y * q.x, widened(filter::extent(p, q), error), error);
  }
  if (quick != 0) return quick;
  Exact& all = exact();
  const Question ask(all, {points_of<D>(ridge, D - 1)});
  return ask.first_sign(all.from.orders, all.to.orders, [&](int i, int j) {
    const auto from = ask.way(all.from, i, ridge[0]), to = ask.way(all.to, j, ridge[0]);
    if constexpr (D == 3) {
      return dot(cross(from, to), ask.difference(ridge[1], ridge[0]));
    } else {
      return from.v[0] * to.v[1] - from.v[1] * to.v[0];
    }
  });
}

template <int D>
bool Sightline<D>::pierces(const double* const* simplex) {
  if constexpr (D == 3) {
    for (int i = 0; i < 3; ++i) {
      const double* const ridge[] = {simplex[i], simplex[(i + 1) % 3]};
      if (ridge_side(ridge) <= 0) return false;
    }
    return true;
  } else {
    return ridge_side(simplex) < 0 && ridge_side(simplex + 1) > 0;
  }
}

template <int D>
bool Sightline<D>::ends_on(const double* const* simplex) {
  if (certain_plane_side(to_, simplex) != 0 || exact_plane_side(true, simplex) != 0) return false;
  // The line meets the plane at the end, so it passes all ridges on the side of the simplex, or touches them.
  int least = 1, most = -1;
  for (int i = 0; i < D; ++i) {
    const double* const ridge[] = {simplex[i], simplex[(i + 1) % D]};
    const int side = D == 2 && i == 0 ? -ridge_side(ridge) : ridge_side(ridge);
    least = std::min(least, side);
    most = std::max(most, side);
  }
  return least >= 0 || most <= 0;
}

template <int D>
bool Sightline<D>::passes_before(const double* const* a, const double* const* b) {
  const auto value_of = [](const SightEnd<D>& end, const double* const* simplex) {
    Tuple<Bounded, D> way = difference_of<D>(end.near, simplex[0]);
    for (int k = 0; k < D; ++k) way.v[k].error += 2 * end.error[k];
    return plane_value(difference_of<D>(simplex[1], simplex[0]), difference_of<D>(simplex[D - 1], simplex[0]), way);
  };
  const Bounded value = value_of(from_, a) * value_of(to_, b) - value_of(from_, b) * value_of(to_, a);
  if (std::fabs(value.value) > value.error) return value.value > 0;
  Exact& all = exact();
  const Question ask(all, {points_of<D>(a, D), points_of<D>(b, D)});
  return ask.first_sign(all.from.orders, all.to.orders, [&](int i, int j) {
    return ask.plane_value(all.from, i, a) * ask.plane_value(all.to, j, b) -
           ask.plane_value(all.from, i, b) * ask.plane_value(all.to, j, a);
  }) > 0;
}

template struct SightEnd<2>;
template struct SightEnd<3>;
template class Sightline<2>;
template class Sightline<3>;

}  // namespace dsw
