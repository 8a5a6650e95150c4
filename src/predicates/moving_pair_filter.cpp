#include "predicates/moving_pair_filter.h"

#include <algorithm>

#include "predicates/filter_bounds.h"
#include "predicates/flat_pair.h"

namespace dsw {

namespace {

constexpr double kCoefficientError = 512 * kUnitRoundoff;
constexpr double kRootError = 0x1p-92;
constexpr double kThird = 1.0 / 3;

// A number at the start and at the end. Both are computed in one instruction, so they take no longer than one of them.
using Ends = DoublePair;

template <int D>
class Filter {
 public:
  explicit Filter(const MovingPair<D>& pair) noexcept : pair_(pair), search_(pair.kind) {
    for (int i = 0; i <= D; ++i) {
      for (int k = 0; k < D; ++k) point_[i][k] = Ends{pair.start[i][k], pair.end[i][k]};
    }
  }

  // Whether one feature is on one side of the other at the start and at the end, along an axis. Then it is on this side at
  // all times: each difference of coordinates is linear in time.
  bool apart_on_axis() const noexcept {
    // Features are points 0 and `more`, and points D - 1, D and `third`, some of which are the same.
    const bool edges = D == 3 && pair_.kind == PairKind::kEdgeEdge;
    const Ends *const more = point_[edges ? 1 : 0], *const third = point_[edges ? D : 1];
    uint32_t apart = 0;
    for (int k = 0; k < D; ++k) {
      const Ends a = point_[D - 1][k], b = point_[D][k];
      const Ends low[2] = {smaller(point_[0][k], more[k]), smaller(smaller(a, b), third[k])};
      const Ends high[2] = {larger(point_[0][k], more[k]), larger(larger(a, b), third[k])};
      const uint32_t below = lanes_of(high[0] < low[1]), above = lanes_of(high[1] < low[0]);
      apart |= (below & below >> 1) | (above & above >> 1);
    }
    return apart != 0;
  }

  int kept_side(bool* is_sure) noexcept {
    find_rows();
    *is_sure = find_bounds();
    if (!*is_sure) return 0;
    find_outer();
    if (const int plain = plain_side(); plain != 0) return plain;
    find_middle();
    const int side = search_.whole.volume.sign(search_.volume_error);
    const double first = search_.whole.volume.c[0], last = search_.whole.volume.c[D];
    *is_sure = side != 0 || (std::fabs(first) > search_.volume_error && std::fabs(last) > search_.volume_error &&
                             (first > 0) != (last > 0));
    return side;
  }

  Filtered first_touch(double until, double* time) noexcept {
    find_rows();
    find_outer();
    if (search_.whole.volume.c[0] == 0 && touches_at_start()) {
      *time = 0;
      return Filtered::kTouches;
    }
    if (!find_bounds()) return Filtered::kUnknown;
    find_middle();
    if (search_.whole.volume.sign(search_.volume_error) != 0) return Filtered::kApart;
    double low = 0, high = until < 1 ? touch_search::end_after(until) : 1;
    if constexpr (D == 3) {
      find_areas();
      if (is_apart_between(&low, &high)) return Filtered::kApart;
    }
    find_conditions();
    search_.root_error = kRootError * product_;
    constexpr int kHalvingsOfPart = 2;
    return search_.first_touch_in(
        low, high, kHalvingsOfPart, [this](double t) { return volume_at(t); }, time);
  }

 private:
  void find_rows() noexcept {
    for (int i = 0; i < D; ++i) {
      for (int k = 0; k < D; ++k) row_[i][k] = point_[i + 1][k] - point_[0][k];
    }
    for (int k = 0; k < D; ++k) {
      Ends extent = magnitude_of(row_[0][k]);
      for (int i = 1; i < D; ++i) extent = larger(magnitude_of(row_[i][k]), extent);
      extent_[k] = extent[0] > extent[1] ? extent[0] : extent[1];
    }
  }

  // Finds the bounds of errors from the extents. Returns false if an extent is out of range.
  bool find_bounds() noexcept {
    product_ = 1;
    bool in_range = true;
    for (int k = 0; k < D; ++k) {
      in_range &= extent_[k] >= kTimeFilterMin && extent_[k] <= kTimeFilterMax;
      product_ *= extent_[k];
    }
    search_.volume_error = kCoefficientError * product_;
    return in_range;
  }

  // Whether the pair surely touches at the start. The volume there is 0 in doubles. Pairs that touch from the start on are common.
  DSW_COLD bool touches_at_start() const noexcept {
    if (!is_start_short()) return false;
    const auto sign = [](double x) { return (x > 0) - (x < 0); };
    const auto area = [&](int view, int triangle) {
      const int x = (view + 1) % 3, y = (view + 2) % 3;
      const auto cross = [&](int i, int j) {
        const Ends *a = row_[i], *b = row_[j];
        return a[x][0] * b[y][0] - a[y][0] * b[x][0];
      };
      return sign(triangle == 0   ? cross(0, 1)
                  : triangle == 1 ? cross(0, 2)
                  : triangle == 2 ? cross(1, 2)
                                  : cross(0, 1) - cross(0, 2) + cross(1, 2));
    };
    return exact_touch::flat_pair_touches<D>(
        pair_.kind, area, [&](int axis, int i, int j) { return sign(pair_.start[j][axis] - pair_.start[i][axis]); });
  }

  // Whether the rows at the start are exact and have at most 16 bits on each axis. Then their areas and their volume are exact, too.
  // Let 2^e <= extent < 2^(e+1) and q = 2^(e-15). A coordinate x whose sum with `large` is exact is a multiple of q: the sum is 2^(e+37)
  // or more if x is below that size, and doubles of this size are multiples of q. Differences of multiples of q that are less than 2^16 q
  // are exact. An area is at most 2^33 q^2 and a volume less than 2^51 q^3, so doubles hold them. With an extent of 0 all of them are 0.
  bool is_start_short() const noexcept {
    bool is_short = true;
    for (int k = 0; k < D; ++k) {
      const double extent = extent_[k], large = extent * 0x1p38;
      is_short &= extent == 0 || (extent >= kFilterMin && extent <= kFilterMax);
      for (const double* const point : pair_.start) is_short &= (point[k] + large) - large == point[k];
    }
    return is_short;
  }

  // The side at the start, if the ways are too short to change it; else 0. By Hadamard a determinant of entries up to 1 is at most 4, in
  // the plane 2. The change is a sum of D determinants, each with one column of ways.
  int plain_side() const noexcept {
    double way[D] = {};
    for (int i = 0; i < D; ++i) {
      for (int k = 0; k < D; ++k) way[k] = std::max(way[k], std::fabs(row_[i][k][1] - row_[i][k][0]));
    }
    const double volume = search_.whole.volume.c[0];
    double change;
    if constexpr (D == 3) {
      change = 4 * (way[0] * extent_[1] * extent_[2] + extent_[0] * (way[1] * extent_[2] + extent_[1] * way[2]));
    } else {
      change = 2 * (way[0] * extent_[1] + extent_[0] * way[1]);
    }
    // The volume loses at most 50 roundings of the product of the extents, and the change 24: less than the error of a coefficient.
    if (!(std::fabs(volume) > (1 + 0x1p-40) * change + 2 * search_.volume_error)) return 0;
    return volume > 0 ? 1 : -1;
  }

  // The first and the last coefficient of the volume.
  void find_outer() noexcept {
    double* const c = search_.whole.volume.c;
    Ends outer{};
    if constexpr (D == 3) {
      for (int k = 0; k < 3; ++k) {
        const int x = (k + 1) % 3, y = (k + 2) % 3;
        minor_[k] = row_[1][x] * row_[2][y] - row_[1][y] * row_[2][x];
        outer = outer + row_[0][k] * minor_[k];
      }
    } else {
      outer = row_[0][0] * row_[1][1] - row_[0][1] * row_[1][0];
    }
    c[0] = outer[0];
    c[D] = outer[1];
  }

  // The middle coefficients. In space a lane has three determinants of the rows of its side, start or end, each with one row of the other
  // side instead. Where the first row is of the other side, it meets minor_. Else it meets mixed_, the sum of the minors with one row of
  // each side. The coefficient is the mean of the three.
  void find_middle() noexcept {
    double* const c = search_.whole.volume.c;
    Ends middle{};
    if constexpr (D == 3) {
      for (int k = 0; k < 3; ++k) {
        const int x = (k + 1) % 3, y = (k + 2) % 3;
        const Ends ax = row_[1][x], ay = row_[1][y], bx = row_[2][x], by = row_[2][y];
        mixed_[k] = (turned(ax) * by - turned(ay) * bx) + (ax * turned(by) - ay * turned(bx));
        middle = middle + (turned(row_[0][k]) * minor_[k] + row_[0][k] * mixed_[k]);
      }
      c[1] = middle[0] * kThird;
      c[2] = middle[1] * kThird;
    } else {
      middle = row_[0][0] * turned(row_[1][1]) - row_[0][1] * turned(row_[1][0]);
      c[1] = 0.5 * (middle[0] + middle[1]);
    }
  }

  // Narrows the interval of time in which the pair may touch. Returns whether it becomes empty. Nearly all pairs that are apart, but not
  // along an axis, need one round or two.
  bool is_apart_between(double* low, double* high) const noexcept {
    constexpr int kMostRounds = 3;
    touch_search::Curve<4> part = search_.whole.volume;
    double length = 1;
    for (int round = 0; round < kMostRounds; ++round) {
      const double before = length;
      if (!narrow(part.c, *low, length, low, high)) return false;
      if (*low >= *high || is_flat_apart(*low, *high)) return true;
      length = *high - *low;
      if (!(length < 0.75 * before)) return false;
      find_part(*low, *high, part.c);
      if (part.sign(search_.volume_error) != 0) return true;
    }
    return false;
  }

  // Finds the coefficients of the volume between two times. Each lane evaluates at one of them.
  void find_part(double low, double high, double* part) const noexcept {
    const double* const c = search_.whole.volume.c;
    const DoublePair t{low, high}, rest = DoublePair{1, 1} - t;
    DoublePair value[4];
    for (int i = 0; i < 4; ++i) value[i] = DoublePair{c[i], c[i]};
    for (int round = 3; round > 1; --round) {
      for (int i = 0; i < round; ++i) value[i] = rest * value[i] + t * value[i + 1];
    }
    const DoublePair ends = rest * value[0] + t * value[1], middle = turned(rest) * value[0] + turned(t) * value[1];
    part[0] = ends[0];
    part[1] = middle[0];
    part[2] = middle[1];
    part[3] = ends[1];
  }

  // Narrows the interval of time in which the volume may be 0, by Bezier clipping. The control points of the volume between `from` and
  // from + length are (i / 3, c_i), and their convex hull contains its graph. Where the hull meets the axis, its edges join a positive
  // coefficient with a negative one. The line from c_i to c_j meets the axis at (i + (j - i) x) / 3 of the length, with
  // x = c_i / (c_i - c_j). Here each coefficient errs by at most 2^-20 of its size. The signs of c_i and c_j differ, so c_i - c_j does not
  // cancel, and x errs by less than 2^-18. Times are rounded to multiples of 2^-20. Together a time errs by less than 2^-17. Returns false
  // if a coefficient is too small for these bounds.
  bool narrow(const double* c, double from, double length, double* low, double* high) const noexcept {
    const DoublePair first{c[0], c[1]}, second{c[1], c[2]}, third{c[2], c[3]};
    const double least = 0x1p20 * search_.volume_error;
    if (lanes_of(smaller(magnitude_of(first), magnitude_of(third)) > DoublePair{least, least}) != 3) return false;
    constexpr DoublePair kNone{0, 0}, kAll{1, 1}, kBefore{-1, -1}, kAfter{2, 2};
    DoublePair begin = kAfter, end = kBefore;
    const auto add = [&](DoublePair a, DoublePair b, DoublePair base, DoublePair step) {
      const DoublePair x = a / (a - b), time = base + step * x;
      const PairMask differ = (x > kNone) & (x < kAll);
      begin = smaller(chosen(differ, time, kAfter), begin);
      end = larger(chosen(differ, time, kBefore), end);
    };
    add(first, second, DoublePair{0, kThird}, DoublePair{kThird, kThird});
    add(first, third, DoublePair{0, kThird}, DoublePair{2 * kThird, 2 * kThird});
    add(DoublePair{c[0], c[2]}, DoublePair{c[3], c[3]}, DoublePair{0, 2 * kThird}, DoublePair{1, kThird});
    const double after = begin[0] < begin[1] ? begin[0] : begin[1], before = end[0] > end[1] ? end[0] : end[1];
    constexpr double kRoom = 0x1p-17, kDigits = 0x1p32;  // doubles a little above 2^32 are multiples of 2^-20
    const double least_time = (from + length * after - kRoom + kDigits) - kDigits,
                 most_time = (from + length * before + kRoom + kDigits) - kDigits;
    *low = least_time > *low ? least_time : *low;
    *high = most_time < *high ? most_time : *high;
    return true;
  }

  // Whether the areas part the pair at all times between two, if its points lie in one plane then.
  bool is_flat_apart(double low, double high) const noexcept {
    const DoublePair error{search_.condition_error, search_.condition_error}, minus = DoublePair{} - error;
    const DoublePair a{low, low}, b{high, high}, one{1, 1}, rest_a = one - a, rest_b = one - b;
    uint32_t above = 0, below = 0;
    for (uint32_t i = 0; i < 2; ++i) {
      const DoublePair* const c = area_[i];
      const DoublePair first = rest_a * c[0] + a * c[1], second = rest_a * c[1] + a * c[2];
      const DoublePair third = rest_b * c[0] + b * c[1], fourth = rest_b * c[1] + b * c[2];
      const DoublePair begin = rest_a * first + a * second, middle = rest_b * first + b * second,
                       end = rest_b * third + b * fourth;
      above |= lanes_of(smaller(smaller(begin, middle), end) > error) << 2 * i;
      below |= lanes_of(larger(larger(begin, middle), end) < minus) << 2 * i;
    }
    // The rule of judge() in touch_search.h, on bits.
    if (pair_.kind == PairKind::kEdgeEdge) return (((above & above >> 1) | (below & below >> 1)) & 5) != 0;
    return ((above & 8) != 0 && ((below & 5) | (above & 2)) != 0) ||
           ((below & 8) != 0 && ((above & 5) | (below & 2)) != 0);
  }

  // Finds the areas, seen along one axis: that along which area 2, half way, is largest beside its error.
  void find_areas() noexcept {
    double size[3];
    for (int k = 0; k < 3; ++k) size[k] = std::fabs(minor_[k][0] + minor_[k][1] + mixed_[k][0]) * extent_[k];
    const int better = size[1] > size[0] ? 1 : 0, view = size[2] > size[better] ? 2 : better;
    const int x = (view + 1) % 3, y = (view + 2) % 3;
    search_.condition_error = kCoefficientError * extent_[x] * extent_[y];
    const Ends ax = row_[0][x], ay = row_[0][y], bx = row_[1][x], by = row_[1][y], cx = row_[2][x], cy = row_[2][y];
    const Ends first = ax * by - ay * bx, second = ax * cy - ay * cx, third = minor_[view];
    const Ends first_mixed = ax * turned(by) - ay * turned(bx), second_mixed = ax * turned(cy) - ay * turned(cx);
    const double half = 0.5 * mixed_[view][0];
    area_[0][0] = DoublePair{first[0], second[0]};
    area_[0][1] = DoublePair{0.5, 0.5} *
                  (DoublePair{first_mixed[0], second_mixed[0]} + DoublePair{first_mixed[1], second_mixed[1]});
    area_[0][2] = DoublePair{first[1], second[1]};
    const Ends last = first - second + third;
    area_[1][0] = DoublePair{third[0], last[0]};
    area_[1][1] = DoublePair{half, area_[0][1][0] - area_[0][1][1] + half};
    area_[1][2] = DoublePair{third[1], last[1]};
  }

  void find_conditions() noexcept {
    if constexpr (D == 3) {
      for (uint32_t i = 0; i < 4; ++i) {
        for (int k = 0; k < 3; ++k) search_.whole.condition[i].c[k] = area_[i / 2][k][i % 2];
      }
    } else {
      const int axis = extent_[0] >= extent_[1] ? 0 : 1;
      search_.condition_error = kCoefficientError * extent_[axis];
      for (int i = 0; i < 2; ++i) {
        for (uint32_t side = 0; side < 2; ++side) search_.whole.condition[i].c[side] = row_[i][axis][side];
      }
    }
  }

  // At -O3 it has three times the code and takes as long.
  DSW_COLD dd::Number volume_at(double t) const noexcept {
    const dd::Number rest = dd::sum(1, -t), part = {t, 0};
    dd::Number r[D][D];
    for (int i = 0; i < D; ++i) {
      for (int k = 0; k < D; ++k) {
        const dd::Number start = dd::sum(pair_.start[i + 1][k], -pair_.start[0][k]);
        const dd::Number end = dd::sum(pair_.end[i + 1][k], -pair_.end[0][k]);
        r[i][k] = dd::add(dd::multiply(start, rest), dd::multiply(end, part));
      }
    }
    if constexpr (D == 2) {
      return dd::minor_of(r[0][0], r[1][1], r[0][1], r[1][0]);
    } else {
      dd::Number sum = dd::multiply(r[0][0], dd::minor_of(r[1][1], r[2][2], r[1][2], r[2][1]));
      sum = dd::add(sum, dd::multiply(r[0][1], dd::minor_of(r[1][2], r[2][0], r[1][0], r[2][2])));
      return dd::add(sum, dd::multiply(r[0][2], dd::minor_of(r[1][0], r[2][1], r[1][1], r[2][0])));
    }
  }

  const MovingPair<D>& pair_;
  Ends point_[D + 1][D], row_[D][D];  // points, and points 1 to D less point 0
  Ends minor_[3], mixed_[3];          // in space, of the last two rows; see find_middle
  DoublePair area_[2][3];             // in space, coefficients of areas 0 and 1, 2 and 3
  double extent_[D];
  double product_ = 0;
  touch_search::Search<D, D - 1, D == 3 ? 4 : 2> search_;
};

}  // namespace

template <int D>
Filtered filter_first_touch(const MovingPair<D>& pair, double until, double* time) noexcept {
  Filter<D> filter(pair);
  if (filter.apart_on_axis()) return Filtered::kApart;
  return filter.first_touch(until, time);
}

template <int D>
int filter_kept_side(const MovingPair<D>& points, bool* is_sure) noexcept {
  return Filter<D>(points).kept_side(is_sure);
}

template int filter_kept_side(const MovingPair<2>&, bool*) noexcept;
template int filter_kept_side(const MovingPair<3>&, bool*) noexcept;
template Filtered filter_first_touch(const MovingPair<2>&, double, double*) noexcept;
template Filtered filter_first_touch(const MovingPair<3>&, double, double*) noexcept;

}  // namespace dsw
