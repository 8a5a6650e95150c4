#include "predicates/moving_pair_filter.h"

#include <algorithm>

#include "predicates/filter_bounds.h"
#include "predicates/flat_pair.h"

namespace dsw {

namespace {

constexpr double kCoefficientError = 512 * kUnitRoundoff;
constexpr double kRootError = 0x1p-92;

double determinant(const double* a, const double* b, const double* c) noexcept {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

template <int D>
class Filter {
 public:
  explicit Filter(const MovingPair<D>& pair) noexcept : pair_(pair), search_(pair.kind) {}

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
    find_rows();
    *is_sure = find_bounds();
    if (!*is_sure) return 0;
    if (const int plain = plain_side(); plain != 0) return plain;
    find_volume();
    const int side = search_.whole.volume.sign(search_.volume_error);
    const double first = search_.whole.volume.c[0], last = search_.whole.volume.c[D];
    *is_sure = side != 0 || (std::fabs(first) > search_.volume_error && std::fabs(last) > search_.volume_error &&
                             (first > 0) != (last > 0));
    return side;
  }

  Filtered first_touch(double until, double* time) noexcept {
    constexpr int kHalvingsOfCut = 2;
    find_rows();
    if (volume_at_start() == 0 && touches_at_start()) {
      *time = 0;
      return Filtered::kTouches;
    }
    if (!find_bounds()) return Filtered::kUnknown;
    find_volume();
    if (until < 1) search_.end_at(touch_search::end_after(until), kHalvingsOfCut);
    search_.root_error = kRootError * product_;
    return search_.first_touch([this] { find_conditions(); }, [this](double t) { return volume_at(t); }, time);
  }

 private:
  void find_rows() noexcept {
    for (int i = 1; i <= D; ++i) {
      for (int k = 0; k < D; ++k) {
        const double s = pair_.start[i][k] - pair_.start[0][k], e = pair_.end[i][k] - pair_.end[0][k];
        row_[0][i - 1][k] = s;
        row_[1][i - 1][k] = e;
        const double larger = std::fabs(s) > std::fabs(e) ? std::fabs(s) : std::fabs(e);
        extent_[k] = larger > extent_[k] ? larger : extent_[k];
      }
    }
  }

  // False if they are out of range.
  bool find_bounds() noexcept {
    product_ = 1;
    for (int k = 0; k < D; ++k) {
      if (!(extent_[k] >= kTimeFilterMin && extent_[k] <= kTimeFilterMax)) return false;
      product_ *= extent_[k];
    }
    search_.volume_error = kCoefficientError * product_;
    return true;
  }

  double volume_at_start() const noexcept {
    const auto& s = row_[0];
    if constexpr (D == 3) return determinant(s[0], s[1], s[2]);
    return s[0][0] * s[1][1] - s[0][1] * s[1][0];
  }

  // Whether the pair, whose volume at the start is 0 in doubles, surely touches there. Pairs that touch from the start on are common.
  DSW_COLD bool touches_at_start() const noexcept {
    if (!is_start_short()) return false;
    const auto sign = [](double x) { return (x > 0) - (x < 0); };
    const auto area = [&](int view, int triangle) {
      const int x = (view + 1) % 3, y = (view + 2) % 3;
      const auto cross = [&](int i, int j) {
        const double *a = row_[0][i], *b = row_[0][j];
        return a[x] * b[y] - a[y] * b[x];
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
    const auto& s = row_[0];
    double way[D] = {};
    for (int i = 0; i < D; ++i) {
      for (int k = 0; k < D; ++k) way[k] = std::max(way[k], std::fabs(row_[1][i][k] - s[i][k]));
    }
    const double volume = volume_at_start();
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

  // Coefficients of the volume.
  void find_volume() noexcept {
    double* const c = search_.whole.volume.c;
    const auto& s = row_[0];
    const auto& e = row_[1];
    if constexpr (D == 3) {
      c[0] = determinant(s[0], s[1], s[2]);
      c[1] = (determinant(e[0], s[1], s[2]) + determinant(s[0], e[1], s[2]) + determinant(s[0], s[1], e[2])) / 3;
      c[2] = (determinant(s[0], e[1], e[2]) + determinant(e[0], s[1], e[2]) + determinant(e[0], e[1], s[2])) / 3;
      c[3] = determinant(e[0], e[1], e[2]);
    } else {
      set_area(0, 1, 0, 1, &search_.whole.volume);
    }
  }

  // The area that rows i and j span along axes x and y.
  void set_area(int i, int j, int x, int y, touch_search::Curve<3>* area) const noexcept {
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
      search_.condition_error = kCoefficientError * extent_[x] * extent_[y];
      touch_search::Curve<3>* const area = search_.whole.condition;
      set_area(0, 1, x, y, &area[0]);
      set_area(0, 2, x, y, &area[1]);
      set_area(1, 2, x, y, &area[2]);
      for (int i = 0; i < 3; ++i) area[3].c[i] = area[0].c[i] - area[1].c[i] + area[2].c[i];
    } else {
      const int axis = extent_[0] >= extent_[1] ? 0 : 1;
      search_.condition_error = kCoefficientError * extent_[axis];
      for (int i = 0; i < 2; ++i) {
        for (int side = 0; side < 2; ++side) search_.whole.condition[i].c[side] = row_[side][i][axis];
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

  const MovingPair<D>& pair_;
  double row_[2][D][D];  // points 1 to D less point 0, at the start and at the end
  double extent_[D] = {};
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
