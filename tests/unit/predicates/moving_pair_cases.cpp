#include "moving_pair_cases.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <tuple>
#include <utility>

namespace dsw {
namespace {

template <int D>
using Coordinates = std::array<double, D>;

/** Calls each(start, end) for all coordinates. */
template <int D, class Each>
void for_coordinates(MovingCase<D>& c, Each each) {
  for (size_t i = 0; i <= D; ++i) {
    for (size_t k = 0; k < D; ++k) each(c.start[i][k], c.end[i][k], k);
  }
}

size_t index_below(Random& random, size_t n) { return static_cast<size_t>(random.below(static_cast<int>(n))); }

template <class List>
void shuffle(Random& random, List& list) {
  for (size_t i = list.size(); i > 1; --i) std::swap(list[i - 1], list[index_below(random, i)]);
}
template <int D>
void shuffle_points(Random& random, MovingCase<D>& c) {
  for (size_t i = D; i > 0; --i) {
    const size_t j = index_below(random, i + 1);
    std::swap(c.start[i], c.start[j]);
    std::swap(c.end[i], c.end[j]);
  }
}

template <int D>
void fill_lattice(Random& random, int range, MovingCase<D>& c) {
  for_coordinates(c, [&](double& start, double& end, size_t) {
    start = random.between(-range, range);
    end = random.between(-range, range);
  });
}
int some_range(Random& random) { return random.below(4) == 0 ? 1 << random.between(3, 24) : random.between(1, 3); }

template <int D>
Coordinates<D> some_vector(Random& random, int range) {
  Coordinates<D> v;
  for (double& x : v) x = random.between(-range, range);
  return v;
}

template <int D>
void put_in_one_plane(Random& random, MovingCase<D>& c) {
  fill_lattice(random, some_range(random), c);
  const size_t axis = index_below(random, D);
  Coordinates<D> slope = some_vector<D>(random, 2);
  slope[axis] = 0;
  for (auto* points : {&c.start, &c.end}) {
    for (auto& x : *points) {
      x[axis] = 1;
      for (size_t k = 0; k < D; ++k) x[axis] += k == axis ? 0 : slope[k] * x[k];
    }
  }
}

template <int D>
void put_in_one_line(Random& random, MovingCase<D>& c) {
  const int range = some_range(random);
  const Coordinates<D> from = some_vector<D>(random, 2), way = some_vector<D>(random, 2);
  for (auto* points : {&c.start, &c.end}) {
    for (auto& x : *points) {
      const int share = random.between(-range, range);
      for (size_t k = 0; k < D; ++k) x[k] = from[k] + share * way[k];
    }
  }
}

/** m/n. */
struct Fraction {
  std::int64_t m, n;
};
Fraction some_fraction(Random& random) {
  const int n = random.below(3) == 0 ? random.between(1, 1 << 20) : random.between(1, 8);
  return {random.between(-1, n + 1), n};
}
/** Their difference is 1 / (n n'). */
std::pair<Fraction, Fraction> close_fractions(Random& random) {
  const int bits = random.between(4, 30);
  const std::int64_t most = std::int64_t{1} << bits;
  if (random.below(3) == 0) {  // one of them is a double
    const std::int64_t m = 2 * (static_cast<std::int64_t>(random.next() >> 34) % (most / 2)) + 1;
    std::int64_t inverse = 1;  // of m modulo 2^bits, by Newton's rule
    for (int right = 1; right < bits; right *= 2) inverse = inverse * ((2 - m * inverse) % most) % most;
    const std::int64_t n = random.below(2) == 0 ? (most + inverse) % most : (most - inverse) % most;
    return {{m, most}, {(m * n + most / 2) / most, n}};
  }
  std::pair<Fraction, Fraction> r{{0, 1}, {1, 1}};
  while (r.first.n + r.second.n < most) {
    const Fraction between{r.first.m + r.second.m, r.first.n + r.second.n};
    (random.below(2) == 0 ? r.first : r.second) = between;
  }
  return r;
}

/** A linear function by its values at 0 and 1. */
using Linear = std::array<double, 2>;
Linear with_zero(Random& random, Fraction zero) {
  const int factor = random.below(2) == 0 ? 1 : random.between(-3, 3);
  return {static_cast<double>(-zero.m * factor), static_cast<double>((zero.n - zero.m) * factor)};
}
Linear some_linear(Random& random) {
  return {static_cast<double>(random.between(-3, 3)), static_cast<double>(random.between(-3, 3))};
}

template <int D>
using Pencil = std::array<std::array<Linear, D>, D>;  // rows

template <int D>
Pencil<D> product(const std::array<std::array<int, D>, D>& left, const Pencil<D>& p,
                  const std::array<std::array<int, D>, D>& right) {
  Pencil<D> r{};
  for (size_t i = 0; i < D; ++i) {
    for (size_t j = 0; j < D; ++j) {
      for (size_t a = 0; a < D; ++a) {
        for (size_t b = 0; b < D; ++b) {
          for (size_t e = 0; e < 2; ++e) r[i][j][e] += left[i][a] * p[a][b][e] * right[b][j];
        }
      }
    }
  }
  return r;
}

/** The differences of three points from the fourth are the columns, in other coordinates and combined. */
template <int D>
void put_on_pencil(Random& random, const Pencil<D>& columns, MovingCase<D>& c) {
  std::array<std::array<int, D>, D> left{}, right{};
  for (size_t i = 0; i < D; ++i) left[i][i] = right[i][i] = 1;
  for (auto* matrix : {&left, &right}) {
    if (random.below(3) == 0) continue;
    for (auto& row : *matrix) {
      for (int& x : row) x += random.between(-1, 1);
    }
  }
  const Pencil<D> p = product<D>(left, columns, right);
  for (size_t k = 0; k < D; ++k) {
    c.start[0][k] = random.between(-3, 3);
    c.end[0][k] = random.between(-3, 3);
    for (size_t i = 0; i < D; ++i) {
      c.start[i + 1][k] = c.start[0][k] + p[k][i][0];
      c.end[i + 1][k] = c.end[0][k] + p[k][i][1];
    }
  }
  shuffle_points(random, c);
}

template <int D>
void make_singular(Random& random, MovingCase<D>& c) {
  // Kronecker: all singular pencils consist of such blocks.
  Pencil<D> p{};
  if (D == 2) {
    p[0] = {some_linear(random), some_linear(random)};
    if (random.below(2) == 0) p = {{{p[0][0], {}}, {p[0][1], {}}}};
  } else {
    switch (random.below(3)) {
      case 0:
        for (size_t i = 0; i + 1 < D; ++i) {
          for (Linear& x : p[i]) x = some_linear(random);
        }
        break;
      case 1:
        for (size_t i = 0; i + 1 < D; ++i) {
          for (auto& row : p) row[i] = some_linear(random);
        }
        break;
      default:
        p[0][0] = some_linear(random);
        p[0][1] = some_linear(random);
        for (auto& row : p) row[D - 1] = some_linear(random);
    }
  }
  put_on_pencil<D>(random, p, c);
}

template <int D>
void make_product(Random& random, std::array<Fraction, D> zeros, MovingCase<D>& c) {
  Pencil<D> p{};
  const bool is_diagonal = random.below(3) == 0;
  for (size_t i = 0; i < D; ++i) {
    for (size_t j = 0; j < i && !is_diagonal; ++j) p[i][j] = some_linear(random);
    p[i][i] = with_zero(random, zeros[i]);
  }
  put_on_pencil<D>(random, p, c);
}

template <int D>
void make_multiple_zeros(Random& random, MovingCase<D>& c) {
  std::array<Fraction, D> zeros;
  for (Fraction& each : zeros) each = some_fraction(random);
  zeros[0] = zeros[1];
  if (random.below(2) == 0) zeros[D - 1] = zeros[0];
  shuffle(random, zeros);
  make_product<D>(random, zeros, c);
}

template <int D>
void make_close_zeros(Random& random, MovingCase<D>& c) {
  std::array<Fraction, D> zeros;
  for (Fraction& each : zeros) each = some_fraction(random);
  std::tie(zeros[0], zeros[1]) = close_fractions(random);
  if (random.below(3) == 0) zeros[D - 1] = zeros[random.below(2) == 0 ? 0 : 1];
  shuffle(random, zeros);
  make_product<D>(random, zeros, c);
}

template <int D>
void make_zero_that_is_double(Random& random, MovingCase<D>& c) {
  const auto digits = [&] { return std::floor(std::ldexp(random.uniform(), random.between(4, 40))); };
  Pencil<D> p{};
  for (size_t i = 0; i < D; ++i) {
    for (size_t j = 0; j < i; ++j) p[i][j] = {digits(), digits()};
    p[i][i] = {digits(), digits()};
  }
  const int n = 1 << random.between(1, 30);
  const size_t row = index_below(random, D);
  p[row][row] = with_zero(random, {random.between(0, n), n});
  put_on_pencil<D>(random, p, c);
}

/** They touch at a time m/n. */
template <int D>
void make_touching(Random& random, Fraction time, MovingCase<D>& c) {
  const int range = random.below(3) == 0 ? 1 << random.between(3, 12) : random.between(1, 3);
  const Coordinates<D> place = some_vector<D>(random, range), d = some_vector<D>(random, range),
                       e = some_vector<D>(random, range);
  const auto at = [&](int along_d, int along_e) {
    Coordinates<D> x = place;
    for (size_t k = 0; k < D; ++k) x[k] += along_d * d[k] + along_e * e[k];
    return x;
  };
  const int i = random.between(0, 2), j = random.between(0, 2);
  std::array<Coordinates<D>, D + 1> then;
  if constexpr (D == 2) {
    then = {place, at(-i, 0), at(j, 0)};
  } else if (c.kind == PairKind::kVertexFace) {
    then = {place, at(-i, -j), at(4 - i, -j), at(-i, 4 - j)};
  } else {
    then = {at(-i, 0), at(random.between(0, 2), 0), at(0, -j), at(0, random.between(0, 2))};
  }
  const bool together = random.below(4) == 0;
  Coordinates<D> way{};
  for (size_t p = 0; p <= D; ++p) {
    if (p == 0 || !together) way = some_vector<D>(random, range);
    if (random.below(8) == 0) way = {};
    for (size_t k = 0; k < D; ++k) {
      c.start[p][k] = then[p][k] - static_cast<double>(time.m) * way[k];
      c.end[p][k] = then[p][k] + static_cast<double>(time.n - time.m) * way[k];
    }
  }
}
Fraction some_time(Random& random) {
  Fraction time = some_fraction(random);
  time.m = std::min(std::max(time.m, std::int64_t{0}), time.n);
  return time;
}

MovingFamily one_of_the_others(Random& random) {
  return static_cast<MovingFamily>(random.below(static_cast<int>(MovingFamily::kNearMiss)));
}

template <int D>
void scale(MovingCase<D>& c, const std::array<int, D>& exponents) {
  for_coordinates(c, [&](double& start, double& end, size_t k) {
    for (double* x : {&start, &end}) *x = std::ldexp(*x, exponents[k]);
  });
}
template <int D>
int largest_exponent(MovingCase<D>& c) {
  int largest = -1100;
  for_coordinates(c, [&](double& start, double& end, size_t) {
    for (const double x : {start, end}) largest = x != 0 ? std::max(largest, std::ilogb(x)) : largest;
  });
  return largest;
}

template <int D>
void map_at_random(Random& random, MovingCase<D>& c) {
  std::array<Coordinates<D>, D> rows;
  for (auto& row : rows) {
    for (double& x : row) x = random.uniform();
  }
  const double offset = random.below(2) == 0 ? 0 : random.uniform();
  for (auto* points : {&c.start, &c.end}) {
    for (auto& x : *points) {
      const Coordinates<D> old = x;
      for (size_t k = 0; k < D; ++k) {
        x[k] = offset;
        for (size_t j = 0; j < D; ++j) x[k] += rows[k][j] * old[j];
      }
    }
  }
}

template <int D>
void take_point_set(Random& random, MovingCase<D>& c) {
  PointSet<D> s;
  draw(random, kMaxPoints, s);
  for (size_t i = 0; i <= D; ++i) {
    std::copy_n(s.x[i], D, c.start[i].begin());
    std::copy_n(s.x[i + D + 1], D, c.end[i].begin());
  }
}

}  // namespace

template <int D>
MovingPair<D> MovingCase<D>::pair() const {
  MovingPair<D> r{};
  r.kind = kind;
  for (size_t i = 0; i <= D; ++i) {
    r.start[i] = start[i].data();
    r.end[i] = end[i].data();
  }
  return r;
}

template <int D>
std::string MovingCase<D>::text() const {
  std::string r = kind == PairKind::kVertexFace ? "{kVertexFace"
                  : kind == PairKind::kEdgeEdge ? "{kEdgeEdge"
                                                : "{kVertexEdge";
  for (const auto* points : {&start, &end}) {
    for (size_t i = 0; i <= D; ++i) {
      for (size_t k = 0; k < D; ++k) {
        char number[40];
        std::snprintf(number, sizeof number, "%s%a%s", k == 0 ? (i == 0 ? ", {{{" : ", {") : ", ", (*points)[i][k],
                      k == D - 1 ? (i == D ? "}}}" : "}") : "");
        r += number;
      }
    }
  }
  return r + "}";
}

const char* name_of(MovingFamily family) {
  constexpr const char* kNames[] = {"Uniform",      "Lattice",      "OnePlane",   "OneLine",       "OneAxisPlane",
                                    "Standing",     "Equal",        "Singular",   "MultipleZeros", "CloseZeros",
                                    "ZeroIsDouble", "TouchAtStart", "TouchAtEnd", "TouchBetween",  "NearMiss",
                                    "Rounded",      "Huge",         "Tiny",       "PerAxis",       "Spread",
                                    "Offset",       "PointSet"};
  static_assert(std::size(kNames) == static_cast<size_t>(MovingFamily::kCount), "a name for each");
  return kNames[static_cast<size_t>(family)];
}

template <int D>
void draw(Random& random, MovingFamily family, PairKind kind, MovingCase<D>& c) {
  c.kind = kind;
  switch (family) {
    case MovingFamily::kUniform:
    case MovingFamily::kCount:
      for_coordinates(c, [&](double& start, double& end, size_t) {
        start = random.uniform();
        end = random.uniform();
      });
      break;
    case MovingFamily::kLattice:
      fill_lattice(random, some_range(random), c);
      break;
    case MovingFamily::kOnePlane:
      put_in_one_plane(random, c);
      break;
    case MovingFamily::kOneLine:
      put_in_one_line(random, c);
      break;
    case MovingFamily::kOneAxisPlane: {
      const size_t axis = index_below(random, D);
      draw(random, random.below(2) == 0 ? MovingFamily::kUniform : MovingFamily::kLattice, kind, c);
      for (auto* points : {&c.start, &c.end}) {
        for (auto& x : *points) x[axis] = 0.3;
      }
      break;
    }
    case MovingFamily::kStanding: {
      draw(random, random.below(2) == 0 ? MovingFamily::kLattice : MovingFamily::kTouchBetween, kind, c);
      const int standing = random.between(1, (1 << (D + 1)) - 1);
      for (size_t i = 0; i <= D; ++i) {
        if ((standing >> i & 1) != 0) (random.below(2) == 0 ? c.start : c.end)[i] = c.start[i];
      }
      for (size_t i = 0; i <= D; ++i) {
        if ((standing >> i & 1) != 0) c.end[i] = c.start[i];
      }
      break;
    }
    case MovingFamily::kEqual:
      draw(random, random.below(2) == 0 ? MovingFamily::kLattice : MovingFamily::kUniform, kind, c);
      for (int times = random.between(1, 3); times > 0; --times) {
        const size_t from = index_below(random, D + 1), to = index_below(random, D + 1);
        const int which = random.below(3);
        if (which != 0) c.start[to] = c.start[from];
        if (which != 1) c.end[to] = c.end[from];
      }
      break;
    case MovingFamily::kSingular:
      make_singular(random, c);
      break;
    case MovingFamily::kMultipleZeros:
      make_multiple_zeros(random, c);
      break;
    case MovingFamily::kCloseZeros:
      make_close_zeros(random, c);
      break;
    case MovingFamily::kZeroIsDouble:
      make_zero_that_is_double(random, c);
      break;
    case MovingFamily::kTouchAtStart:
      make_touching(random, {0, 1}, c);
      break;
    case MovingFamily::kTouchAtEnd:
      make_touching(random, {1, 1}, c);
      break;
    case MovingFamily::kTouchBetween:
      make_touching(random, some_time(random), c);
      break;
    case MovingFamily::kNearMiss:
      draw(random, one_of_the_others(random), kind, c);
      if (random.below(2) == 0) {
        for_coordinates(c, [](double& start, double& end, size_t) {
          start *= 0.1;
          end *= 0.1;
        });
      }
      nudge(random, c);
      break;
    case MovingFamily::kRounded:
      draw(random, one_of_the_others(random), kind, c);
      map_at_random(random, c);
      break;
    case MovingFamily::kHuge: {
      draw(random, one_of_the_others(random), kind, c);
      std::array<int, D> exponents;
      exponents.fill(1023 - largest_exponent(c));
      scale<D>(c, exponents);
      break;
    }
    case MovingFamily::kTiny: {
      draw(random, one_of_the_others(random), kind, c);
      std::array<int, D> exponents;
      exponents.fill(-1074 + random.between(0, 60));
      scale<D>(c, exponents);
      break;
    }
    case MovingFamily::kPerAxis: {
      draw(random, one_of_the_others(random), kind, c);
      std::array<int, D> exponents;
      for (int& each : exponents) each = random.between(-940, 940);
      scale<D>(c, exponents);
      break;
    }
    case MovingFamily::kSpread: {
      draw(random, one_of_the_others(random), kind, c);
      const int most = random.below(8) == 0 ? 900 : random.between(1, 50);
      for_coordinates(c, [&](double& start, double& end, size_t) {
        start = std::ldexp(start, random.between(-most, most));
        end = std::ldexp(end, random.between(-most, most));
      });
      break;
    }
    case MovingFamily::kOffset: {
      draw(random, one_of_the_others(random), kind, c);
      const double offset = std::ldexp(1.0, random.between(20, 52));
      for_coordinates(c, [&](double& start, double& end, size_t) {
        start += offset;
        end += offset;
      });
      break;
    }
    case MovingFamily::kPointSet:
      take_point_set(random, c);
      break;
  }
}

template <int D>
void rename(Random& random, MovingCase<D>& c) {
  const auto swap_points = [&](size_t i, size_t j) {
    std::swap(c.start[i], c.start[j]);
    std::swap(c.end[i], c.end[j]);
  };
  if (c.kind == PairKind::kEdgeEdge) {
    if (random.below(2) == 0) swap_points(0, 1);
    if (random.below(2) == 0) swap_points(2, D);
    if (random.below(2) == 0) {
      swap_points(0, 2);
      swap_points(1, D);
    }
  } else {
    for (size_t i = D; i > 1; --i) swap_points(i, 1 + index_below(random, i));
  }
  std::array<size_t, D> axes;
  Coordinates<D> signs;
  for (size_t k = 0; k < D; ++k) {
    axes[k] = k;
    signs[k] = random.below(2) == 0 ? 1 : -1;
  }
  shuffle(random, axes);
  for (auto* points : {&c.start, &c.end}) {
    for (auto& x : *points) {
      const Coordinates<D> old = x;
      for (size_t k = 0; k < D; ++k) x[k] = signs[k] * old[axes[k]];
    }
  }
}

template <int D>
void nudge(Random& random, MovingCase<D>& c) {
  double& x = (random.below(2) == 0 ? c.start : c.end)[index_below(random, D + 1)][index_below(random, D)];
  const double next = std::nextafter(x, random.below(2) == 0 ? HUGE_VAL : -HUGE_VAL);
  if (std::isfinite(next)) x = next;
}

template <int D>
void shear(Random& random, MovingCase<D>& c) {
  const size_t from = index_below(random, D), to = (from + 1 + index_below(random, D - 1)) % D;
  const int factor = random.below(2) == 0 ? 1 : -2;
  for (auto* points : {&c.start, &c.end}) {
    for (auto& x : *points) {
      const double sum = x[to] + factor * x[from];
      if (std::isfinite(sum)) x[to] = sum;
    }
  }
}

template struct MovingCase<2>;
template struct MovingCase<3>;
template void draw<2>(Random&, MovingFamily, PairKind, MovingCase<2>&);
template void draw<3>(Random&, MovingFamily, PairKind, MovingCase<3>&);
template void rename<2>(Random&, MovingCase<2>&);
template void rename<3>(Random&, MovingCase<3>&);
template void nudge<2>(Random&, MovingCase<2>&);
template void nudge<3>(Random&, MovingCase<3>&);
template void shear<2>(Random&, MovingCase<2>&);
template void shear<3>(Random&, MovingCase<3>&);

}  // namespace dsw
