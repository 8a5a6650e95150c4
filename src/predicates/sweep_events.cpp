#include "predicates/sweep_events.h"

#include <algorithm>
#include <cmath>

#include "predicates/filtered.h"
#include "predicates/integers.h"
#include "predicates/plane_hit.h"
#include "predicates/ratio.h"
#include "predicates/tally.h"

namespace dsw {
namespace {

using integers::cross;
using integers::dot;
using integers::Large;
using integers::Normal;
using integers::Points;
using integers::Span;
using integers::Vec;
using integers::wide;

constexpr int kP = 0, kTo = 1, kFirst = 2, kSecond = 5, kCount = 8;

// Of one event: the values without the shift and the coefficients of its components.
template <class R>
struct Coefficients {
  using Value = decltype(wide(typename R::Det{}) - wide(typename R::Det{}));
  Value n0, d0;
  Normal<R, 3> n, d;
};

// L without the shift; y, z, w follow each other.
template <class R>
typename R::Det line_value(const Points<R, 3, kCount>& x, int from, int y) noexcept {
  return dot<R>(cross<R>(x.difference(y + 1, from), x.difference(y + 2, from)), x.difference(y, from));
}

template <class R>
Coefficients<R> coefficients(const Points<R, 3, kCount>& x, int first, EventKind kind) noexcept {
  Coefficients<R> c;
  const Vec<R, 3> move = x.difference(kTo, kP);
  if (kind == EventKind::kVertex) {
    const Normal<R, 3> normal = x.normal(first);
    c.n0 = wide(dot<R>(normal, x.difference(first, kP)));
    c.d0 = wide(dot<R>(normal, move));
    // -n, as that of the triangle turned over; a constant denominator.
    c.n = cross<R>(x.difference(first + 2, first), x.difference(first + 1, first));
    const Vec<R, 3> none = x.difference(first, first);
    c.d = cross<R>(none, none);
  } else {
    const auto from = wide(line_value(x, kP, first));
    c.n0 = from;
    c.d0 = from - wide(line_value(x, kTo, first));
    const Vec<R, 3> line =
        kind == EventKind::kEdge ? x.difference(first + 2, first + 1) : x.difference(first, first + 1);
    c.n = cross<R>(x.difference(first, kP), line);
    c.d = cross<R>(move, line);
  }
  return c;
}

template <class R>
int sign_of_denominator(const Coefficients<R>& c) noexcept {
  return c.d0.sign() != 0 ? c.d0.sign() : c.d.first_sign();
}

// N_a D_b - N_b D_a as a polynomial in e, where s = (e, e^2, e^3): sign of its first coefficient that is not 0. Axes have one
// scale here, 2^g, so that coefficients with one component of s want a factor 2^g and those with two 2^2g.
int compare_shifted(const Coefficients<Large>& a, const Coefficients<Large>& b, int g) noexcept {
  const auto product = [](const auto& x, const auto& y) { return wide(x) * wide(y); };
  // Both sums of the coefficient of e^k with one component, and with components i and j.
  const auto one = [&](int k) {
    return (product(a.n0, b.d.v[k]) + product(a.n.v[k], b.d0)) - (product(b.n0, a.d.v[k]) + product(b.n.v[k], a.d0));
  };
  const auto two = [&](int i, int j) { return product(a.n.v[i], b.d.v[j]) - product(b.n.v[i], a.d.v[j]); };
  // Of equal degree: `single` 2^g + `twice` 2^2g, without the common factor.
  const auto mixed = [&](const auto& single, const auto& twice) {
    const WideInt<36> up(1, false, g > 0 ? g : 0), down(1, false, g < 0 ? -g : 0);
    return (single * down + twice * up).sign();
  };
  int s = one(0).sign();
  if (s == 0) s = mixed(one(1), two(0, 0));
  if (s == 0) s = mixed(one(2), two(0, 1) + two(1, 0));
  if (s == 0) s = (two(0, 2) + two(2, 0) + two(1, 1)).sign();
  if (s == 0) s = (two(1, 2) + two(2, 1)).sign();
  if (s == 0) s = two(2, 2).sign();
  return s;
}

struct EventPoints {
  const double* points[kCount];

  EventPoints(const double* p, const double* to, const SweepEvent& a, const SweepEvent& b) noexcept
      : points{p, to, a.points[0], a.points[1], a.points[2], b.points[0], b.points[1], b.points[2]} {}
};

[[gnu::noinline]] int compare_ties(const EventPoints& at, EventKind a_kind, EventKind b_kind) noexcept {
  Span<3> span(at.points);
  const int low = std::min({span.low[0], span.low[1], span.low[2]});
  for (int& each : span.low) each = low;
  const Points<Large, 3, kCount> x(at.points, span);
  const Coefficients<Large> a = coefficients(x, kFirst, a_kind), b = coefficients(x, kSecond, b_kind);
  return compare_shifted(a, b, 1075 - low) * sign_of_denominator(a) * sign_of_denominator(b);
}

// The filter: as that of compare_times. L is one determinant for p and one for p', of an error below 50uM each
// (filter_bounds.h), M over the vectors of both, and one rounded difference of values below 6.1M: 113uM for numerator and
// denominator.
constexpr double kTurnFilter = 113 * kUnitRoundoff;

filter::Ratio turn_ratio(const double* p, const double* to, const SweepEvent& event, bool& in_range) noexcept {
  using filter::difference;
  const auto value = [&](const double* x, filter::Vec<3>& reach) {
    const filter::Vec<3> u = difference<3>(event.points[0], x), a = difference<3>(event.points[1], x),
                         b = difference<3>(event.points[2], x);
    reach = filter::extent(reach, u, a, b);
    return filter::dot(filter::cross(a, b), u);
  };
  filter::Vec<3> reach{0, 0, 0};
  const double at_start = value(p, reach), at_end = value(to, reach);
  in_range = in_range && filter::lowest(reach) >= kTimeFilterMin && filter::highest(reach) <= kTimeFilterMax;
  return {at_start, at_start - at_end, kTurnFilter * reach.x * reach.y * reach.z};
}

filter::Ratio event_ratio(const double* p, const double* to, const SweepEvent& event, bool& in_range) noexcept {
  if (event.kind != EventKind::kVertex) return turn_ratio(p, to, event, in_range);
  return filter::time_ratio<3>(p, filter::difference<3>(to, p), event.points, in_range);
}

}  // namespace

ShiftedSign swept_side(const EdgeMotion& m, const double* v) noexcept {
  const double* const body[3] = {m.p, m.to, m.q};
  const int s = orient<3>(body, v);
  if (s != 0) return {s, false};
  return {-exact::plane_side<3>(body, m.p).sign, true};  // p lies in its own plane: what remains is the sign of n
}

ShiftedSign compare_events(const double* p, const double* to, const SweepEvent& a, const SweepEvent& b) noexcept {
  bool in_range = true;
  const filter::Ratio ta = event_ratio(p, to, a, in_range), tb = event_ratio(p, to, b, in_range);
  const ShiftedSign quick = filter::compare_ratios(ta, tb, in_range);
  if (quick.sign != filter::kUncertain) return quick;
  const EventPoints at(p, to, a, b);
  int s = 0;
  integers::evaluate<3>(at.points, [&](const auto& x) noexcept {
    const auto ca = coefficients(x, kFirst, a.kind), cb = coefficients(x, kSecond, b.kind);
    const int turn = ca.d0.sign() * cb.d0.sign();
    if (turn != 0) s = turn * compare(ca.n0 * cb.d0, cb.n0 * ca.d0);
    return 0;
  });
  if (s != 0) return {s, false};
  return {compare_ties(at, a.kind, b.kind), true};
}

namespace {

// What all kinds of events are without the shift: p passes the plane of three points, turned so that it passes it outwards. False
// where a filter does not see it pass.
bool plane_passed(const double* p, const double* to, const SweepEvent& event, const double* (&plane)[3]) noexcept {
  std::copy_n(event.points, 3, plane);
  bool in_range = true;
  const filter::Ratio ratio = filter::time_ratio<3>(p, filter::difference<3>(to, p), plane, in_range);
  if (!in_range || !(std::fabs(ratio.denominator) > ratio.bound)) return false;
  if (ratio.denominator < 0) std::swap(plane[0], plane[1]);
  return true;
}

}  // namespace

double event_time(const double* p, const double* to, const SweepEvent& event) noexcept {
  const double* plane[3];
  if (plane_passed(p, to, event, plane)) return crossing_time<3>(p, to, plane);
  const EventPoints at(p, to, event, event);
  double time = 0;
  integers::evaluate<3>(at.points, [&](const auto& x) noexcept {
    const auto c = coefficients(x, kFirst, event.kind);
    const auto ratio = [](const auto& n, const auto& d) {
      return d.sign() < 0 ? ratio_down(-n, -d) : ratio_down(n, d);
    };
    if (c.d0.sign() != 0) {
      time = ratio(c.n0, c.d0);
      return 0;
    }
    // Numerators of lower order than the denominator are 0, since the event takes place.
    for (int k = 0; k < 3; ++k) {
      const auto d = wide(c.d.v[k]);
      if (d.sign() == 0) continue;
      time = ratio(wide(c.n.v[k]), d);
      break;
    }
    return 0;
  });
  return time;
}

}  // namespace dsw
