#include "predicates/sweep_events.h"

#include <algorithm>
#include <cmath>

#include "base/compiler.h"
#include "base/dimensions.h"
#include "predicates/filtered.h"
#include "predicates/integers.h"
#include "predicates/plane_hit.h"
#include "predicates/ratio.h"
#include "predicates/tally.h"

namespace dsw {
namespace {

using integers::cross;
using integers::dot;
using integers::Kind;
using integers::Large;
using integers::Normal;
using integers::Points;
using integers::Span;
using integers::turned;
using integers::Vec;
using integers::wide;

// Points of two events: p, p', those of the first, those of the second.
constexpr int kP = 0, kTo = 1, kFirst = 2;
template <int D>
constexpr int kSecond = kFirst + D;
template <int D>
constexpr int kCount = kFirst + 2 * D;

// The numbers of one event: its values without the shift, and the coefficients of the shift's components.
template <class R, int D>
struct Coefficients {
  using Value = decltype(wide(typename Kind<R, D>::Value{}) - wide(typename Kind<R, D>::Value{}));
  Value n0, d0;
  Normal<R, D> n, d;
};

// L without the shift; of an event's points y is the first.
template <class R, int D>
typename Kind<R, D>::Value turn_value(const Points<R, D, kCount<D>>& x, int from, int y) noexcept {
  if constexpr (D == 3) {
    return dot<R>(cross<R>(x.difference(y + 1, from), x.difference(y + 2, from)), x.difference(y, from));
  } else {
    return dot<R>(turned<R>(x.difference(y, from)), x.difference(y + 1, from));
  }
}

template <class R, int D>
Coefficients<R, D> coefficients(const Points<R, D, kCount<D>>& x, int first, EventKind kind) noexcept {
  Coefficients<R, D> c;
  const Vec<R, D> move = x.difference(kTo, kP);
  if (kind == EventKind::kVertex) {
    const Normal<R, D> normal = x.normal(first);
    c.n0 = wide(dot<R>(normal, x.difference(first, kP)));
    c.d0 = wide(dot<R>(normal, move));
    // -n, as that of the simplex turned over; a constant denominator.
    const Vec<R, D> none = x.difference(first, first);
    if constexpr (D == 3) {
      c.n = cross<R>(x.difference(first + 2, first), x.difference(first + 1, first));
      c.d = cross<R>(none, none);
    } else {
      c.n = turned<R>(x.difference(first, first + 1));
      c.d = turned<R>(none);
    }
    return c;
  }
  const auto from = wide(turn_value(x, kP, first));
  c.n0 = from;
  c.d0 = from - wide(turn_value(x, kTo, first));
  if constexpr (D == 3) {
    const Vec<R, 3> line =
        kind == EventKind::kEdge ? x.difference(first + 2, first + 1) : x.difference(first, first + 1);
    c.n = cross<R>(x.difference(first, kP), line);
    c.d = cross<R>(move, line);
  } else {
    c.n = turned<R>(x.difference(kP, first));
    c.d = turned<R>(x.difference(kP, kTo));
  }
  return c;
}

template <class R, int D>
int sign_of_denominator(const Coefficients<R, D>& c) noexcept {
  return c.d0.sign() != 0 ? c.d0.sign() : c.d.first_sign();
}

// N_a D_b - N_b D_a as a polynomial in e, where s = (e, e^2, e^3), or (e, e^2): sign of its first coefficient that is
// not 0. Axes have one scale here, 2^g: coefficients with one component of s want a factor 2^g, those with two 2^2g.
template <int D>
int compare_shifted(const Coefficients<Large, D>& a, const Coefficients<Large, D>& b, int g) noexcept {
  const auto product = [](const auto& x, const auto& y) { return wide(x) * wide(y); };
  // Both sums of the coefficient of e^k with one component, and with components i and j.
  const auto one = [&](int k) {
    return (product(a.n0, b.d.v[k]) + product(a.n.v[k], b.d0)) - (product(b.n0, a.d.v[k]) + product(b.n.v[k], a.d0));
  };
  const auto two = [&](int i, int j) { return product(a.n.v[i], b.d.v[j]) - product(b.n.v[i], a.d.v[j]); };
  // Two coefficients of equal degree are added: `single` 2^g + `twice` 2^2g, without the common factor.
  const auto mixed = [&](const auto& single, const auto& twice) {
    const WideInt<36> up(1, false, g > 0 ? g : 0), down(1, false, g < 0 ? -g : 0);
    return (single * down + twice * up).sign();
  };
  int s = one(0).sign();
  if (s == 0) s = mixed(one(1), two(0, 0));
  if constexpr (D == 3) {
    if (s == 0) s = mixed(one(2), two(0, 1) + two(1, 0));
    if (s == 0) s = (two(0, 2) + two(2, 0) + two(1, 1)).sign();
    if (s == 0) s = (two(1, 2) + two(2, 1)).sign();
    if (s == 0) s = two(2, 2).sign();
  } else {
    if (s == 0) s = (two(0, 1) + two(1, 0)).sign();
    if (s == 0) s = two(1, 1).sign();
  }
  return s;
}

template <int D>
struct EventPoints {
  const double* points[kCount<D>];

  EventPoints(const double* p, const double* to, const SweepEvent& a, const SweepEvent& b) noexcept : points{p, to} {
    std::copy_n(a.points, D, points + kFirst);
    std::copy_n(b.points, D, points + kSecond<D>);
  }
};

template <int D>
DSW_NOINLINE int compare_ties(const EventPoints<D>& at, EventKind a_kind, EventKind b_kind) noexcept {
  Span<D> span(at.points);
  const int low = *std::min_element(span.low, span.low + D);
  for (int& each : span.low) each = low;
  const Points<Large, D, kCount<D>> x(at.points, span);
  const auto a = coefficients(x, kFirst, a_kind), b = coefficients(x, kSecond<D>, b_kind);
  return compare_shifted(a, b, 1075 - low) * sign_of_denominator(a) * sign_of_denominator(b);
}

// The filter: as that of compare_times. In space L is one determinant for p and one for p', of an error below 50uM each
// (filter_bounds.h), M over the vectors of both, and one rounded difference of values below 6.1M: 113uM for numerator
// and denominator. In the plane these are 10uM and 2.1M: 25uM.
template <int D>
constexpr double kTurnFilter = (D == 3 ? 113 : 25) * kUnitRoundoff;

template <int D>
filter::Ratio turn_ratio(const double* p, const double* to, const SweepEvent& event, bool& in_range) noexcept {
  using filter::difference;
  const auto value = [&](const double* x, filter::Vec<D>& reach) {
    const filter::Vec<D> u = difference<D>(event.points[0], x), a = difference<D>(event.points[1], x);
    if constexpr (D == 3) {
      const filter::Vec<3> b = difference<3>(event.points[2], x);
      reach = filter::extent(reach, u, a, b);
      return filter::dot(filter::cross(a, b), u);
    } else {
      reach = filter::extent(reach, u, a);
      return u.y * a.x - u.x * a.y;
    }
  };
  filter::Vec<D> reach{};
  const double at_start = value(p, reach), at_end = value(to, reach);
  in_range = in_range && filter::lowest(reach) >= kTimeFilterMin && filter::highest(reach) <= kTimeFilterMax;
  double size = reach.x * reach.y;
  if constexpr (D == 3) size *= reach.z;
  return {at_start, at_start - at_end, kTurnFilter<D> * size};
}

template <int D>
filter::Ratio event_ratio(const double* p, const double* to, const SweepEvent& event, bool& in_range) noexcept {
  if (event.kind != EventKind::kVertex) return turn_ratio<D>(p, to, event, in_range);
  return filter::time_ratio<D>(p, filter::difference<D>(to, p), event.points, in_range);
}

}  // namespace

ShiftedSign swept_side(const EdgeMotion& m, const double* v) noexcept {
  const double* const body[3] = {m.p, m.to, m.q};
  const int s = orient<3>(body, v);
  if (s != 0) return {s, false};
  return {-exact::plane_side<3>(body, m.p).sign, true};  // p lies in its own plane: what remains is the sign of n
}

template <int D>
ShiftedSign compare_events(const double* p, const double* to, const SweepEvent& a, const SweepEvent& b) noexcept {
  bool in_range = true;
  const filter::Ratio ta = event_ratio<D>(p, to, a, in_range), tb = event_ratio<D>(p, to, b, in_range);
  const ShiftedSign quick = filter::compare_ratios(ta, tb, in_range);
  if (quick.sign != filter::kUncertain) return quick;
  const EventPoints<D> at(p, to, a, b);
  int s = 0;
  integers::evaluate<D>(at.points, [&](const auto& x) noexcept {
    const auto ca = coefficients(x, kFirst, a.kind), cb = coefficients(x, kSecond<D>, b.kind);
    const int turn = ca.d0.sign() * cb.d0.sign();
    if (turn != 0) s = turn * compare(ca.n0 * cb.d0, cb.n0 * ca.d0);
    return 0;
  });
  if (s != 0) return {s, false};
  return {compare_ties(at, a.kind, b.kind), true};
}

namespace {

// What all kinds of events are without the shift: p passes the plane of three points, in the plane the line of two,
// turned so that it passes it outwards. False where a filter does not see it pass.
template <int D>
bool plane_passed(const double* p, const double* to, const SweepEvent& event, const double* (&plane)[D]) noexcept {
  std::copy_n(event.points, D, plane);
  bool in_range = true;
  const filter::Ratio ratio = filter::time_ratio<D>(p, filter::difference<D>(to, p), plane, in_range);
  if (!in_range || !(std::fabs(ratio.denominator) > ratio.bound)) return false;
  if (ratio.denominator < 0) std::swap(plane[0], plane[1]);
  return true;
}

}  // namespace

template <int D>
double event_time(const double* p, const double* to, const SweepEvent& event) noexcept {
  const double* plane[D];
  if (plane_passed(p, to, event, plane)) return crossing_time<D>(p, to, plane);
  const EventPoints<D> at(p, to, event, event);
  double time = 0;
  integers::evaluate<D>(at.points, [&](const auto& x) noexcept {
    const auto c = coefficients(x, kFirst, event.kind);
    const auto ratio = [](const auto& n, const auto& d) {
      return d.sign() < 0 ? ratio_down(-n, -d) : ratio_down(n, d);
    };
    if (c.d0.sign() != 0) {
      time = ratio(c.n0, c.d0);
      return 0;
    }
    // Numerators of lower order than the denominator are 0, since the event takes place.
    for (int k = 0; k < D; ++k) {
      const auto d = wide(c.d.v[k]);
      if (d.sign() == 0) continue;
      time = ratio(wide(c.n.v[k]), d);
      break;
    }
    return 0;
  });
  return time;
}

DSW_INSTANTIATE(compare_events);
DSW_INSTANTIATE(event_time);

}  // namespace dsw
