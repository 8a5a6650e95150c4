#include "predicates/moving_pair_small.h"

#include "predicates/fixed_int.h"
#include "predicates/quick_touch.h"

// Sizes. Coordinates are below 2^60, differences below 2^61. A coefficient of an area has at most four products below 2^122 for two
// rows, and twelve for the last triangle: below 2^126. A coefficient of the volume has 18 products of three differences:
// below 2^188. Coefficients of powers of t are at most eight times larger.

namespace dsw {

namespace {

// A curve whose coefficients have N words. At a double t that is a multiple of 2^-64 its value has Degree words more.
template <int Degree, int N>
class MachineCurve {
 public:
  MachineCurve() = default;

  FixedInt<N> c[Degree + 1];

  void find_signs() noexcept {
    for (int i = 0; i <= Degree; ++i) sign_[i] = static_cast<std::int8_t>(c[i].sign());
    has_power_ = has_rough_ = false;
  }

  static constexpr int degree() noexcept { return Degree; }
  int sign(int i) const noexcept { return sign_[i]; }
  Ball ball(int i) const noexcept { return c[i].ball(); }

  const bernstein::RoughCurve& rough() const noexcept {
    if (!has_rough_) {
      has_rough_ = true;
      rough_.degree = Degree;
      for (int i = 0; i <= Degree; ++i) {
        const bool is_end = i == 0 || i == Degree;
        rough_.c[i] = is_end ? c[i].rounded() : c[i].rounded() / Degree;
      }
    }
    return rough_;
  }

  template <class Other>
  int sign_at_root(const Other&, const bernstein::Place&) const noexcept {
    return kOpenSign;
  }

  int sure_sign(double t) const noexcept { return rough().sure_sign(t); }

  // A coefficient of t^i.
  const auto& power(int i) const noexcept {
    find_power();
    return power_[i];
  }

  int sign_at(double t) const noexcept {
    const integers::Decoded d = integers::decode(t);
    const int zeros = static_cast<int>(lowest_bit(d.magnitude)), shift = d.exponent - 1075 + 64;
    if (shift + zeros < 0) return bernstein::value_at(*this, ball_of(t)).sign();
    const std::uint64_t m = shift >= 0 ? d.magnitude << shift : d.magnitude >> -shift;  // t is m / 2^64
    find_power();
    Power sum = power_[Degree] * m + power_[Degree - 1].up(1);
    if constexpr (Degree > 1) sum = sum * m + power_[Degree - 2].up(2);
    if constexpr (Degree > 2) sum = sum * m + power_[Degree - 3].up(3);
    return sum.sign();
  }

 private:
  using Power = FixedInt<N + Degree + (Degree == 2 ? 1 : 0)>;

  // Coefficients of powers of t.
  void find_power() const noexcept {
    if (has_power_) return;
    has_power_ = true;
    const auto wide = [this](int i) { return Power(c[i]); };
    power_[0] = wide(0);
    if constexpr (Degree == 1) {
      power_[1] = wide(1) - wide(0);
    } else if constexpr (Degree == 2) {
      power_[1] = wide(1) - wide(0) * 2;
      power_[2] = wide(2) - wide(1) + wide(0);
    } else {
      power_[1] = wide(1) - wide(0) * 3;
      power_[2] = wide(2) - wide(1) * 2 + wide(0) * 3;
      power_[3] = (wide(3) - wide(2)) + (wide(1) - wide(0));
    }
  }

  std::int8_t sign_[Degree + 1];
  mutable bool has_power_, has_rough_;
  mutable Power power_[Degree + 1];
  mutable bernstein::RoughCurve rough_;
};

using Length = MachineCurve<1, 1>;
using Area = MachineCurve<2, 2>;
using Volume = MachineCurve<3, 4>;

using Small = integers::Small;

template <int D>
class SmallCurves {
 public:
  SmallCurves(const MovingPair<D>& pair, const int (&low)[D]) noexcept {
    for (int side = 0; side < 2; ++side) {
      const double* const* const points = side == 0 ? pair.start : pair.end;
      for (int k = 0; k < D; ++k) {
        const std::int64_t first = Small::coordinate(points[0][k], low[k]);
        row_[side][0][k] = 0;
        for (int i = 1; i <= D; ++i) row_[side][i][k] = Small::coordinate(points[i][k], low[k]) - first;
      }
    }
  }

  const std::conditional_t<D == 3, Volume, Area>& volume() noexcept {
    if constexpr (D == 2) {
      return area(0, 0);
    } else {
      if (has_volume_) return volume_;
      has_volume_ = true;
      const std::int64_t *const start = row_[0][1], *const end = row_[1][1];
      Int128 minor[3][3];  // coefficients, axes
      for (int k = 0; k < 3; ++k) {
        const int x = (k + 1) % 3, y = (k + 2) % 3;
        for (int i = 0; i < 3; ++i) minor[i][k] = cross(2, 3, x, y, i);
        set_area(k, 2, minor[0][k], minor[1][k], minor[2][k]);
      }
      using Wide = FixedInt<4>;
      volume_.c[0] = Wide(Small::dot3(minor[0], start));
      volume_.c[1] = Wide(Small::dot3(minor[0], end)) + Wide(Small::dot3(minor[1], start));
      volume_.c[2] = Wide(Small::dot3(minor[1], end)) + Wide(Small::dot3(minor[2], start));
      volume_.c[3] = Wide(Small::dot3(minor[2], end));
      volume_.find_signs();
      return volume_;
    }
  }

  const Area& area(int view, int triangle) noexcept {
    if (!has_area_[view][triangle]) {
      const int x = D == 3 ? (view + 1) % 3 : 0, y = D == 3 ? (view + 2) % 3 : 1;
      const auto [a, b, c] = exact_touch::kTriangle[triangle];
      Int128 sum[3];
      for (int i = 0; i < 3; ++i) sum[i] = area_of(a, b, c, x, y, i);
      set_area(view, triangle, sum[0], sum[1], sum[2]);
    }
    return area_[view][triangle];
  }

  int volume_at_start() const noexcept {
    if constexpr (D == 2) {
      return integers::sign(cross(1, 2, 0, 1, 0));
    } else {
      const Int128 minor[3] = {cross(2, 3, 1, 2, 0), cross(2, 3, 2, 0, 0), cross(2, 3, 0, 1, 0)};
      return integers::sign(Small::dot3(minor, row_[0][1]));
    }
  }
  int area_at_start(int view, int triangle) const noexcept {
    const auto [a, b, c] = exact_touch::kTriangle[triangle];
    return integers::sign(area_of(a, b, c, (view + 1) % 3, (view + 2) % 3, 0));
  }

  template <class Curve>
  static int discriminant(const Curve&) noexcept {
    return kOpenSign;
  }
  template <class Curve>
  static int factors(const Curve&, std::optional<Curve> (&)[2]) noexcept {
    return 0;
  }

  const Length& difference(int axis, int i, int j) noexcept {
    Length& length = length_[axis][i][j];
    for (int side = 0; side < 2; ++side) length.c[side] = FixedInt<1>(row_[side][j][axis] - row_[side][i][axis]);
    length.find_signs();
    return length;
  }

 private:
  static constexpr int kViews = D == 3 ? 3 : 1;
  static constexpr int kTriangles = D == 3 ? 4 : 1;

  // A coefficient of the area of three points.
  Int128 area_of(int a, int b, int c, int x, int y, int coefficient) const noexcept {
    const Int128 sum = cross(b, c, x, y, coefficient);
    return a == 0 ? sum : sum + cross(a, b, x, y, coefficient) - cross(a, c, x, y, coefficient);
  }

  // A coefficient of the area that rows a and b span.
  Int128 cross(int a, int b, int x, int y, int coefficient) const noexcept {
    const auto of = [&](int s, int t) {
      return Small::minor(row_[s][a][x], row_[t][b][y], row_[s][a][y], row_[t][b][x]);
    };
    return coefficient == 0 ? of(0, 0) : coefficient == 1 ? of(0, 1) + of(1, 0) : of(1, 1);
  }

  void set_area(int view, int triangle, Int128 first, Int128 middle, Int128 last) noexcept {
    Area& area = area_[view][triangle];
    area.c[0] = FixedInt<2>(first);
    area.c[1] = FixedInt<2>(middle);
    area.c[2] = FixedInt<2>(last);
    area.find_signs();
    has_area_[view][triangle] = true;
  }

  std::int64_t row_[2][D + 1][D];  // start and end, points less point 0
  bool has_area_[kViews][kTriangles] = {};
  bool has_volume_ = false;
  Volume volume_;
  Area area_[kViews][kTriangles];
  Length length_[D][D + 1][D + 1];
};

template <int N>
Integer integer_of(IntegerPool& pool, const FixedInt<N>& x) {
  const FixedInt<N> magnitude = x.is_negative() ? -x : x;
  int size = N;
  while (size > 0 && magnitude.limb[size - 1] == 0) --size;
  if (size == 0) return {};
  std::uint64_t* const r = pool.room(size);
  for (int i = 0; i < size; ++i) r[i] = magnitude.limb[i];
  pool.keep(size);
  return {&pool, r, size, x.is_negative()};
}

template <class Curve>
Polynomial polynomial_of(IntegerPool& pool, const Curve& curve) {
  Polynomial p;
  p.degree = curve.degree();
  for (int i = 0; i <= p.degree; ++i) p.c[i] = integer_of(pool, curve.power(i));
  p.trim();
  return p;
}

}  // namespace

template <int D>
bool small_first_touch(const MovingPair<D>& pair, FirstTouch* first) noexcept {
  const double* points[2 * (D + 1)];
  for (int i = 0; i <= D; ++i) {
    points[i] = pair.start[i];
    points[D + 1 + i] = pair.end[i];
  }
  const integers::Span<D> span(points);
  if (span.width > kMostSmallSpan) return false;
  SmallCurves<D> curves(pair, span.low);
  return QuickTouch<D, SmallCurves<D>>(curves, pair.kind).find_first(first);
}

template <int D>
DSW_COLD Polynomial SmallPoints<D>::difference(IntegerPool& pool, int axis, int i, int j) const {
  return polynomial_of(pool, SmallCurves<D>(pair_, low_).difference(axis, i, j));
}

template <int D>
DSW_COLD Polynomial SmallPoints<D>::area(IntegerPool& pool, int view, int triangle) const {
  return polynomial_of(pool, SmallCurves<D>(pair_, low_).area(view, triangle));
}

template <int D>
DSW_COLD Polynomial SmallPoints<D>::volume(IntegerPool& pool) const {
  return polynomial_of(pool, SmallCurves<D>(pair_, low_).volume());
}

template class SmallPoints<2>;
template class SmallPoints<3>;
template bool small_first_touch(const MovingPair<2>&, FirstTouch*) noexcept;
template bool small_first_touch(const MovingPair<3>&, FirstTouch*) noexcept;

}  // namespace dsw
