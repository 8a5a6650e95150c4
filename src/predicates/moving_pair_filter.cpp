#include "predicates/moving_pair_filter.h"

#include <cmath>

#include "predicates/double_double.h"
#include "predicates/filter_bounds.h"
#include "predicates/integers.h"

namespace dsw {

namespace {

constexpr double kCoefficientError = 512 * kUnitRoundoff;
constexpr double kRootError = 0x1p-92;
constexpr int kMostHalvings = 24;

// Coefficients in the basis of Bernstein.
template <int N>
struct Curve {
  double c[N];

  // 1 or -1 if all values surely have this sign, else 0.
  int sign(double error) const noexcept {
    double least = c[0], most = c[0];
    for (int i = 1; i < N; ++i) {
      least = c[i] < least ? c[i] : least;
      most = c[i] > most ? c[i] : most;
    }
    return least > error ? 1 : most < -error ? -1 : 0;
  }

  // Changes into the first half, and returns the second.
  Curve halve() noexcept {
    Curve second = *this;
    for (int round = N - 1; round > 0; --round) {
      c[N - 1 - round] = second.c[0];
      for (int i = 0; i < round; ++i) second.c[i] = 0.5 * (second.c[i] + second.c[i + 1]);
    }
    c[N - 1] = second.c[0];
    return second;
  }

  double at(double t) const noexcept {
    double value[N];
    for (int i = 0; i < N; ++i) value[i] = c[i];
    for (int round = N - 1; round > 0; --round) {
      for (int i = 0; i < round; ++i) value[i] = (1 - t) * value[i] + t * value[i + 1];
    }
    return value[0];
  }
};

template <int D>
struct Piece {
  static constexpr int kConditions = D == 3 ? 4 : 2;
  double low, high;
  int halvings;
  Curve<D + 1> volume;
  Curve<D> condition[kConditions];
};

// Whether conditions of these signs part the pair, join it, or leave it open. The same rule as areas_part, but here 0 is
// unknown.
Filtered judge(PairKind kind, const int (&s)[4]) noexcept {
  if (kind == PairKind::kEdgeEdge) {
    if (s[0] * s[1] > 0 || s[2] * s[3] > 0) return Filtered::kApart;
    return s[0] * s[1] < 0 && s[2] * s[3] < 0 ? Filtered::kTouches : Filtered::kUnknown;
  }
  const int a = s[0] * s[3], b = -s[1] * s[3], c = s[2] * s[3];
  if (a < 0 || b < 0 || c < 0) return Filtered::kApart;
  return a > 0 && b > 0 && c > 0 ? Filtered::kTouches : Filtered::kUnknown;
}
Filtered judge(PairKind, const int (&s)[2]) noexcept {
  return s[0] * s[1] > 0 ? Filtered::kApart : s[0] * s[1] < 0 ? Filtered::kTouches : Filtered::kUnknown;
}

double determinant(const double* a, const double* b, const double* c) noexcept {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

template <int D>
class Filter {
 public:
  explicit Filter(const MovingPair<D>& pair) noexcept : pair_(pair) {}

  // Whether one feature is on one side of the other at the start and at the end, along an axis. Then it is on this side at
  // all times: each difference of coordinates is linear in time.
  bool apart_on_axis() const noexcept {
    constexpr bool space = D == 3;
    const int first = space && pair_.kind == PairKind::kEdgeEdge ? 2 : 1;  // points of the first feature
    const double* const* const sides[2] = {pair_.start, pair_.end};
    for (int k = 0; k < D; ++k) {
      bool below = true, above = true;
      for (const double* const* points : sides) {
        double low[2], high[2];
        for (int f = 0; f < 2; ++f) {
          const int begin = f == 0 ? 0 : first, end = f == 0 ? first : D + 1;
          low[f] = high[f] = points[begin][k];
          for (int i = begin + 1; i < end; ++i) {
            low[f] = points[i][k] < low[f] ? points[i][k] : low[f];
            high[f] = points[i][k] > high[f] ? points[i][k] : high[f];
          }
        }
        below = below && high[0] < low[1];
        above = above && low[0] > high[1];
      }
      if (below || above) return true;
    }
    return false;
  }

  int kept_side(bool* is_sure) noexcept {
    *is_sure = find_volume();
    if (!*is_sure) return 0;
    const int side = whole_.volume.sign(volume_error_);
    const double first = whole_.volume.c[0], last = whole_.volume.c[D];
    *is_sure =
        side != 0 || (std::fabs(first) > volume_error_ && std::fabs(last) > volume_error_ && (first > 0) != (last > 0));
    return side;
  }

  Filtered first_touch(double* time) noexcept {
    if (!find_volume()) return Filtered::kUnknown;
    if (whole_.volume.sign(volume_error_) != 0) return Filtered::kApart;
    find_conditions();
    Piece<D> left[kMostHalvings + 1];
    int count = 0;
    left[count++] = whole_;
    while (count > 0) {
      Piece<D>& piece = left[--count];
      if (piece.volume.sign(volume_error_) != 0) continue;
      const Filtered conditions = judge_piece(piece);
      if (conditions == Filtered::kApart) continue;
      if (has_one_root(piece.volume)) {
        const Filtered root = judge_root(piece, conditions, time);
        if (root == Filtered::kApart) continue;
        return root;
      }
      if (piece.halvings == kMostHalvings) return Filtered::kUnknown;
      halve(left, &count);
    }
    return Filtered::kApart;
  }

 private:
  // Coefficients of the volume and the bounds; false if they are out of range.
  bool find_volume() noexcept {
    double extent[D] = {};
    for (int i = 1; i <= D; ++i) {
      for (int k = 0; k < D; ++k) {
        const double s = pair_.start[i][k] - pair_.start[0][k], e = pair_.end[i][k] - pair_.end[0][k];
        row_[0][i - 1][k] = s;
        row_[1][i - 1][k] = e;
        const double larger = std::fabs(s) > std::fabs(e) ? std::fabs(s) : std::fabs(e);
        extent[k] = larger > extent[k] ? larger : extent[k];
      }
    }
    product_ = 1;
    for (int k = 0; k < D; ++k) {
      if (!(extent[k] >= kTimeFilterMin && extent[k] <= kTimeFilterMax)) return false;
      product_ *= extent[k];
      extent_[k] = extent[k];
    }
    volume_error_ = kCoefficientError * product_;
    whole_.low = 0;
    whole_.high = 1;
    whole_.halvings = 0;
    double* const c = whole_.volume.c;
    const auto& s = row_[0];
    const auto& e = row_[1];
    if constexpr (D == 3) {
      c[0] = determinant(s[0], s[1], s[2]);
      c[1] = (determinant(e[0], s[1], s[2]) + determinant(s[0], e[1], s[2]) + determinant(s[0], s[1], e[2])) / 3;
      c[2] = (determinant(s[0], e[1], e[2]) + determinant(e[0], s[1], e[2]) + determinant(e[0], e[1], s[2])) / 3;
      c[3] = determinant(e[0], e[1], e[2]);
    } else {
      set_area(0, 1, 0, 1, &whole_.volume);
    }
    return true;
  }

  // The area that rows i and j span along axes x and y.
  void set_area(int i, int j, int x, int y, Curve<3>* area) const noexcept {
    const auto cross = [&](int first, int second) {
      const double *a = row_[first][i], *b = row_[second][j];
      return a[x] * b[y] - a[y] * b[x];
    };
    area->c[0] = cross(0, 0);
    area->c[1] = 0.5 * (cross(0, 1) + cross(1, 0));
    area->c[2] = cross(1, 1);
  }

  void find_conditions() noexcept {
    if constexpr (D == 3) {
      const int view = best_view(), x = (view + 1) % 3, y = (view + 2) % 3;
      condition_error_ = kCoefficientError * extent_[x] * extent_[y];
      Curve<3>* const area = whole_.condition;
      set_area(0, 1, x, y, &area[0]);
      set_area(0, 2, x, y, &area[1]);
      set_area(1, 2, x, y, &area[2]);
      for (int i = 0; i < 3; ++i) area[3].c[i] = area[0].c[i] - area[1].c[i] + area[2].c[i];
    } else {
      const int axis = extent_[0] >= extent_[1] ? 0 : 1;
      condition_error_ = kCoefficientError * extent_[axis];
      for (int i = 0; i < 2; ++i) {
        for (int side = 0; side < 2; ++side) whole_.condition[i].c[side] = row_[side][i][axis];
      }
    }
  }

  // The axis along which the areas are largest beside their errors, half way.
  int best_view() const noexcept {
    double m[3][3];
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) m[i][k] = row_[0][i][k] + row_[1][i][k];
    }
    const bool edges = pair_.kind == PairKind::kEdgeEdge;
    int best = 0;
    double most = -1;
    for (int k = 0; k < 3; ++k) {
      const int x = (k + 1) % 3, y = (k + 2) % 3;
      const double ax = edges ? m[0][x] : m[1][x] - m[0][x], ay = edges ? m[0][y] : m[1][y] - m[0][y];
      const double bx = m[2][x] - m[edges ? 1 : 0][x], by = m[2][y] - m[edges ? 1 : 0][y];
      const double size = std::fabs(ax * by - ay * bx) * extent_[k];
      if (size > most) {
        most = size;
        best = k;
      }
    }
    return best;
  }

  Filtered judge_piece(const Piece<D>& piece) const noexcept {
    int signs[Piece<D>::kConditions];
    for (int i = 0; i < Piece<D>::kConditions; ++i) signs[i] = piece.condition[i].sign(condition_error_);
    return judge(pair_.kind, signs);
  }

  // The signs at the ends differ, and the coefficients change their sign once, whatever their errors.
  bool has_one_root(const Curve<D + 1>& v) const noexcept {
    const double first = v.c[0], last = v.c[D];
    if (!(std::fabs(first) > volume_error_ && std::fabs(last) > volume_error_) || (first > 0) == (last > 0))
      return false;
    if constexpr (D == 2) return true;
    // Three roots need the signs + - + - or - + - +. One of the inner coefficients surely has another sign.
    const double s = first > 0 ? 1 : -1;
    return s * v.c[1] > volume_error_ || s * v.c[2] < -volume_error_;
  }

  // The root of the whole volume in this piece; `conditions` are those of the piece.
  Filtered judge_root(const Piece<D>& piece, Filtered conditions, double* time) const noexcept {
    if (!find_root(piece, time)) return Filtered::kUnknown;
    if (conditions != Filtered::kUnknown) return conditions;
    int signs[Piece<D>::kConditions];
    for (int i = 0; i < Piece<D>::kConditions; ++i) {
      const double value = whole_.condition[i].at(*time);
      signs[i] = value > condition_error_ ? 1 : value < -condition_error_ ? -1 : 0;
    }
    return judge(pair_.kind, signs);
  }

  bool find_root(const Piece<D>& piece, double* floor) const noexcept {
    const bool rising = piece.volume.c[0] < 0;
    const double error = kRootError * product_;
    double guess = guess_root(piece, rising);
    for (int tries = 0; tries < 3; ++tries) {
      const double step = next(guess) - guess;
      const dd::Number value = volume_at(guess);
      // The volume rises with this slope; the root is where it has made up for `here`.
      const double here = rising ? value.high + value.low : -(value.high + value.low);
      const double slope = rising ? slope_at(guess) : -slope_at(guess);
      const double steps = std::floor(-here / (slope * step)), to = guess + steps * step;
      if (!(to >= piece.low && to < piece.high)) return false;
      // Doubles below and above the guess have the same step, unless there is a power of two between them.
      if (std::fabs(steps) <= 3 && to - guess == steps * step && next(to) - to == step) {
        *floor = to;
        return here + slope * (to - guess) < -error && here + slope * (to + step - guess) > error;
      }
      guess = to;
    }
    return false;
  }

  static double next(double x) noexcept { return integers::of_bits(integers::bits_of(x) + 1); }

  // Newton's method, with bisection where a step leaves the interval.
  double guess_root(const Piece<D>& piece, bool rising) const noexcept {
    double low = piece.low, high = piece.high;
    double t = low + (high - low) * (piece.volume.c[0] / (piece.volume.c[0] - piece.volume.c[D]));
    for (int i = 0; i < 60; ++i) {
      const double value = whole_.volume.at(t);
      if ((value > 0) == rising) {
        high = t;
      } else {
        low = t;
      }
      double to = t - value / slope_at(t);
      if (!(to >= low && to <= high)) to = 0.5 * (low + high);
      const double move = std::fabs(to - t);
      t = to;
      if (move <= 0x1p-48 * t) break;
    }
    return t;
  }

  double slope_at(double t) const noexcept {
    Curve<D> slope;
    for (int i = 0; i < D; ++i) slope.c[i] = D * (whole_.volume.c[i + 1] - whole_.volume.c[i]);
    return slope.at(t);
  }

  dd::Number volume_at(double t) const noexcept {
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

  // The last piece becomes two, the first of them last.
  static void halve(Piece<D>* left, int* count) noexcept {
    Piece<D>& second = left[*count];
    Piece<D>& first = left[*count + 1];
    first = second;
    ++first.halvings;
    second.halvings = first.halvings;
    first.high = second.low = 0.5 * (first.low + first.high);
    second.volume = first.volume.halve();
    for (int i = 0; i < Piece<D>::kConditions; ++i) second.condition[i] = first.condition[i].halve();
    *count += 2;
  }

  const MovingPair<D>& pair_;
  double row_[2][D][D];  // points 1 to D less point 0, at the start and at the end
  double extent_[D];
  double product_ = 0, volume_error_ = 0, condition_error_ = 0;
  Piece<D> whole_;
};

}  // namespace

template <int D>
Filtered filter_first_touch(const MovingPair<D>& pair, double* time) noexcept {
  Filter<D> filter(pair);
  if (filter.apart_on_axis()) return Filtered::kApart;
  return filter.first_touch(time);
}

template <int D>
int filter_kept_side(const MovingPair<D>& points, bool* is_sure) noexcept {
  return Filter<D>(points).kept_side(is_sure);
}

template int filter_kept_side(const MovingPair<2>&, bool*) noexcept;
template int filter_kept_side(const MovingPair<3>&, bool*) noexcept;
template Filtered filter_first_touch(const MovingPair<2>&, double*) noexcept;
template Filtered filter_first_touch(const MovingPair<3>&, double*) noexcept;

}  // namespace dsw
