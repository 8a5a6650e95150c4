#include "turning_pair_cases.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace dsw {
namespace {

using Numbers = std::array<double, 3>;

/** Quaternions of 0, 60, 90, 120 and 180 degrees, in components that are integers. */
void set_structured_turn(Random& random, bool about_z, double* turn) {
  static const double kTurns[][4] = {{0, 0, 0, 1},  {0, 0, 1, 1},  {0, 0, 1, 0}, {0, 0, -1, 1}, {0, 0, 0, -1},
                                     {0, 0, 1, 2},  {0, 0, 3, 1},  {1, 0, 0, 1}, {0, 1, 0, 1},  {1, 0, 0, 0},
                                     {1, 1, 1, 1},  {1, 1, 0, 0},  {1, 1, 1, 3}, {-1, 1, 1, 1}, {1, 0, 1, 0},
                                     {0, 2, -1, 2}, {1, -2, 1, -1}};
  const double* const drawn = kTurns[random.below(about_z ? 7 : 17)];
  const double length = random.below(3) == 0 ? random.between(1, 3) : 1;
  for (int k = 0; k < 4; ++k) turn[k] = length * drawn[k];
}

/** Whether the quaternion is never 0 on its way, clearly: it turns by less than half of a whole turn of its own. */
template <int D>
bool is_allowed(const TurningWay& way) {
  double first = 0, last = 0, dot = 0;
  for (int k = D == 3 ? 0 : 2; k < 4; ++k) {
    first += way.turn[0][k] * way.turn[0][k];
    last += way.turn[1][k] * way.turn[1][k];
    dot += way.turn[0][k] * way.turn[1][k];
  }
  return first > 0 && last > 0 && (dot > 0 || first * last - dot * dot > 1e-9 * first * last);
}

/** Where a point is at a time, nearly. */
Numbers place_of(const TurningWay& way, const double* x, int dimension, double t) {
  double q[4], n = 0;
  for (int k = 0; k < 4; ++k) {
    q[k] = dimension == 2 && k < 2 ? 0 : (1 - t) * way.turn[0][k] + t * way.turn[1][k];
    n += q[k] * q[k];
  }
  Numbers d{}, r{};
  for (size_t k = 0; k < static_cast<size_t>(dimension); ++k) d[k] = x[k] - way.centre[k];
  const double dot = q[0] * d[0] + q[1] * d[1] + q[2] * d[2];
  for (size_t k = 0; k < static_cast<size_t>(dimension); ++k) {
    const size_t i = (k + 1) % 3, j = (k + 2) % 3;
    const double turned = (2 * q[3] * q[3] - n) * d[k] + 2 * dot * q[k] + 2 * q[3] * (q[i] * d[j] - q[j] * d[i]);
    r[k] = turned / n + (1 - t) * way.place[0][k] + t * way.place[1][k];
  }
  return r;
}

template <int D, class Draw>
void fill_points(MovingCase<D>& c, Draw draw) {
  for (auto* points : {&c.start, &c.end}) {
    for (auto& x : *points) {
      for (double& value : x) value = draw();
    }
  }
}

template <int D>
void set_small_ways(Random& random, TurningCase<D>& c, bool about_z) {
  for (TurningWay& way : c.ways) {
    do {
      set_structured_turn(random, about_z, way.turn[0]);
      set_structured_turn(random, about_z, way.turn[1]);
    } while (!is_allowed<D>(way));
    for (size_t k = 0; k < 3; ++k) {
      way.centre[k] = random.below(2) == 0 ? 0 : random.between(-2, 2);
      way.place[0][k] = way.centre[k];
      way.place[1][k] = way.centre[k] + (random.below(3) == 0 ? random.between(-2, 2) : 0);
    }
  }
}

template <int D>
void set_any_ways(Random& random, TurningCase<D>& c, double size) {
  for (TurningWay& way : c.ways) {
    const bool is_small = random.below(3) == 0;
    double last[4];
    do {
      for (int k = 0; k < 4; ++k) {
        way.turn[0][k] = random.uniform();
        last[k] = random.uniform();
        way.turn[1][k] = is_small ? way.turn[0][k] + 0x1p-6 * last[k] : last[k];
      }
    } while (!is_allowed<D>(way));
    for (size_t k = 0; k < 3; ++k) {
      way.centre[k] = size * random.uniform();
      way.place[0][k] = way.centre[k] + 0.25 * size * random.uniform();
      way.place[1][k] = way.place[0][k] + 0.25 * size * random.uniform();
    }
  }
}

/** Whatever stands where a feature stands. */
template <int D>
void stand(Random& random, TurningCase<D>& c) {
  if (random.below(2) == 0) c.points.end = c.points.start;
}

/** Takes the second feature to where the first is at a time. */
template <int D>
void plant(Random& random, TurningCase<D>& c) {
  const size_t of_first = c.points.kind == PairKind::kEdgeEdge ? 2 : 1;
  static constexpr double kTimes[] = {0, 0.5, 1, 0.25, 0.75};
  const double t = kTimes[random.below(5)];
  const TurningPair<D> pair = c.pair();
  const auto where = [&](size_t i) {
    const TurningWay* const way = pair.way[i < of_first ? 0 : 1];
    if (way != nullptr) return place_of(*way, pair.start[i], D, t);
    Numbers r{};
    for (size_t k = 0; k < D; ++k) r[k] = (1 - t) * pair.start[i][k] + t * pair.end[i][k];
    return r;
  };
  const size_t from = static_cast<size_t>(random.below(static_cast<int>(of_first)));
  const Numbers at = where(from);
  Numbers to = where(of_first);
  if (random.below(2) == 0) {
    const Numbers other = where(of_first + 1);
    for (size_t k = 0; k < D; ++k) to[k] = 0.5 * (to[k] + other[k]);
  }
  for (size_t k = 0; k < D; ++k) {
    const double shift = at[k] - to[k];
    if (pair.way[1] != nullptr) {
      for (auto& place : c.ways[1].place) place[k] += shift;
    } else {
      for (size_t i = of_first; i <= D; ++i) {
        c.points.start[i][k] += shift;
        c.points.end[i][k] += shift;
      }
    }
  }
}

/** The first point turns by 180 degrees about z; the second feature stands where the circle comes nearest to it. */
template <int D>
void graze(Random& random, TurningCase<D>& c) {
  const double radius = random.below(2) == 0 ? random.between(1, 4) : 1 + random.uniform();
  fill_points(c.points, [&] { return random.between(-2, 2); });
  for (auto* points : {&c.points.start, &c.points.end}) {
    for (auto& x : *points) x[0] = radius;
    (*points)[0] = {};
    (*points)[0][1] = -radius;
  }
  if (c.points.kind == PairKind::kEdgeEdge) {
    c.points.start[1] = c.points.start[0];
    if (random.below(2) == 0) c.points.start[1][0] = -radius;
    c.points.end[1] = c.points.start[1];
  }
  c.points.end = c.points.start;
  for (TurningWay& way : c.ways) {
    way = {{{0, 0, 0, 1}, {0, 0, 1, 0}}, {}, {}};
    if (random.below(3) == 0) way.turn[1][2] = 0.25 + std::fabs(random.uniform());
  }
  if (c.turns[1]) {  // about an axis that leaves its plane as it is
    double(&turn)[4] = c.ways[1].turn[1];
    turn[2] = 0;
    turn[0] = D == 3 ? 1 : 0;
    turn[3] = D == 3 ? 0 : 1;
  }
}

}  // namespace

const char* name_of(TurningFamily family) {
  static constexpr const char* kNames[] = {"Random",  "Hinged",  "Structured", "Flat",
                                           "Planted", "Grazing", "Together",   "OfMovingPairs"};
  return kNames[static_cast<int>(family)];
}

template <int D>
TurningPair<D> TurningCase<D>::pair() const {
  TurningPair<D> r;
  r.kind = points.kind;
  for (size_t i = 0; i <= D; ++i) {
    r.start[i] = points.start[i].data();
    r.end[i] = points.end[i].data();
  }
  for (size_t side = 0; side < 2; ++side) r.way[side] = turns[side] ? &ways[side] : nullptr;
  return r;
}

template <int D>
std::string TurningCase<D>::text() const {
  std::string r = points.text();
  for (size_t side = 0; side < 2; ++side) {
    r += turns[side] ? " turns" : " goes";
    if (!turns[side]) continue;
    const double* const numbers = ways[side].turn[0];
    for (size_t i = 0; i < 17; ++i) {
      char number[40];
      std::snprintf(number, sizeof number, " %a", numbers[i]);
      r += number;
    }
  }
  return r;
}

template <int D>
void nudge(Random& random, TurningCase<D>& c) {
  const int which = random.below(3);
  TurningWay& way = c.ways[static_cast<size_t>(random.below(2))];
  const auto k = static_cast<size_t>(random.below(D));
  double* const x = which == 0   ? &c.points.start[static_cast<size_t>(random.below(D + 1))][k]
                    : which == 1 ? &way.turn[random.below(2)][3 - k]
                                 : &way.place[random.below(2)][k];
  const double before = *x;
  *x = before == 0 && random.below(8) != 0 ? 0x1p-53 : std::nextafter(before, random.below(2) == 0 ? 1e9 : -1e9);
  if (!is_allowed<D>(way)) *x = before;
}

template <int D>
TurningCase<D> draw_turning(Random& random, TurningFamily family, PairKind kind, int turning) {
  TurningCase<D> c;
  c.points.kind = kind;
  c.turns = {(turning & 1) != 0, (turning & 2) != 0};
  c.ways = {};
  switch (family) {
    case TurningFamily::kRandom:
      fill_points(c.points, [&] { return random.uniform(); });
      set_any_ways(random, c, 1);
      stand(random, c);
      break;
    case TurningFamily::kHinged: {
      fill_points(c.points, [&] { return random.uniform(); });
      for (auto& x : c.points.end) {
        for (double& value : x) value *= 0.125;
      }
      for (size_t i = 0; i <= D; ++i) {
        for (size_t k = 0; k < D; ++k) c.points.end[i][k] += c.points.start[i][k];
      }
      set_any_ways(random, c, 2);
      stand(random, c);
      if (random.below(2) == 0) plant(random, c);
      break;
    }
    case TurningFamily::kStructured:
    case TurningFamily::kFlat: {
      const bool flat = family == TurningFamily::kFlat;
      fill_points(c.points, [&] { return random.between(-2, 2); });
      set_small_ways(random, c, flat);
      stand(random, c);
      if (!flat) break;
      for (auto* points : {&c.points.start, &c.points.end}) {
        for (auto& x : *points) x[D - 1] = D == 3 || random.below(2) == 0 ? 0 : x[D - 1];
      }
      for (TurningWay& way : c.ways) {
        if (random.below(4) == 0) std::swap(way.centre[2], way.place[1][2]);
        if (random.below(2) == 0) continue;
        for (double* x : {way.centre, way.place[0], way.place[1]}) x[2] = 0;
      }
      break;
    }
    case TurningFamily::kPlanted:
      fill_points(c.points, [&] { return random.between(-2, 2); });
      set_small_ways(random, c, random.below(2) == 0);
      stand(random, c);
      plant(random, c);
      if (random.below(2) == 0) nudge(random, c);
      break;
    case TurningFamily::kGrazing:
      graze(random, c);
      if (random.below(3) != 0) nudge(random, c);
      break;
    case TurningFamily::kTogether:
      fill_points(c.points, [&] { return random.between(-1, 1); });
      if (random.below(2) == 0) {
        set_small_ways(random, c, random.below(2) == 0);
      } else {
        set_any_ways(random, c, 1);
      }
      c.ways[1] = c.ways[0];
      if (random.below(2) == 0) nudge(random, c);
      break;
    case TurningFamily::kOfMovingPairs:
    default: {
      draw(random, static_cast<MovingFamily>(random.below(static_cast<int>(MovingFamily::kCount))), kind, c.points);
      set_small_ways(random, c, random.below(4) == 0);
      if (random.below(4) == 0) set_any_ways(random, c, 1);
      for (TurningWay& way : c.ways) {
        const auto point = [&]() -> const double* {
          const auto i = static_cast<size_t>(random.below(D + 1));
          return (random.below(2) == 0 ? c.points.start : c.points.end)[i].data();
        };
        std::copy_n(point(), D, way.centre);
        std::copy_n(way.centre, D, way.place[0]);
        if (random.below(2) == 0) std::copy_n(point(), D, way.place[0]);
        std::copy_n(way.place[0], D, way.place[1]);
        if (random.below(2) == 0) std::copy_n(point(), D, way.place[1]);
      }
      stand(random, c);
      break;
    }
  }
  return c;
}

#define DSW_TURNING_CASES(D)                                                           \
  template struct TurningCase<D>;                                                      \
  template TurningCase<D> draw_turning(Random&, TurningFamily, PairKind, int turning); \
  template void nudge(Random&, TurningCase<D>&)
DSW_TURNING_CASES(2);
DSW_TURNING_CASES(3);
#undef DSW_TURNING_CASES

}  // namespace dsw
