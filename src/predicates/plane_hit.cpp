// Times and normals: double-double where its bound leaves one answer, else the exact integers of the predicates, which
// also decide times that are doubles themselves. Both give the same bits.
#include "predicates/plane_hit.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "base/dimensions.h"
#include "predicates/certified_hit.h"
#include "predicates/integers.h"
#include "predicates/ratio.h"

namespace dsw {

namespace {

using integers::decode;
using integers::dot;
using integers::evaluate;
using integers::Normal;
using integers::Points;
using integers::Span;
using integers::wide;

// significand * 2^exponent: significand 0 or in [0.5, 1].
struct Scaled {
  double significand;
  int exponent;
};

template <int N>
Scaled scaled(const WideInt<N>& x) noexcept {
  if (x.sign() == 0) return {0, 0};
  const int bits = x.bit_length();
  // The conversion rounds to nearest what has a bit below for all that was cut off.
  const std::uint64_t sticky = limbs::any_below(x.limb(), x.size(), bits - 64) ? 1 : 0;
  const double top = static_cast<double>(limbs::bits_from(x.limb(), x.size(), bits - 64) | sticky) * 0x1p-64;
  return {x.sign() < 0 ? -top : top, bits};
}

// Divides by the length components that are at most 1, the largest at least a half.
template <int D>
void divide_by_length(double* unit) noexcept {
  double square = 0;
  for (int k = 0; k < D; ++k) square += unit[k] * unit[k];
  const double length = std::sqrt(square);
  for (int k = 0; k < D; ++k) unit[k] /= length;
}

// n/|n|, or zero for zero. Each component is rounded from the exact one, at a common scale on which the largest is in
// [0.5, 1]: squares that underflow do not matter then.
template <class R, int D>
void normalize(const Normal<R, D>& n, const Span<D>& span, double* unit) noexcept {
  // In units of the scaled axes n_k lacks a factor 2^low for each axis but k.
  Scaled s[D];
  int highest = 0;
  bool found = false;
  for (int k = 0; k < D; ++k) {
    s[k] = scaled(wide(n.v[k]));
    if (s[k].significand == 0) continue;
    for (int j = 0; j < D; ++j) s[k].exponent += j == k ? 0 : span.low[j];
    highest = !found || s[k].exponent > highest ? s[k].exponent : highest;
    found = true;
  }
  for (int k = 0; k < D; ++k) {
    const int down = s[k].exponent - highest;
    unit[k] = s[k].significand == 0 || down < -1022 ? 0 : s[k].significand * power_of_two(down);
  }
  if (found) divide_by_length<D>(unit);
}

// -n/|n| of certified components: each is 0 or between 2^-700 and 2^330.
void point_back(const double* n, double* unit) noexcept {
  const double largest = std::max(std::max(std::fabs(n[0]), std::fabs(n[1])), std::fabs(n[2]));
  const double scale = power_of_two(1022 - decode(largest).exponent);
  for (int k = 0; k < 3; ++k) unit[k] = n[k] * scale;
  divide_by_length<3>(unit);
  for (int k = 0; k < 3; ++k) unit[k] = 0 - unit[k];  // never -0
}

// Points p, q, simplex.
template <class R, int D, int Count>
double time_of(const Points<R, D, Count>& x, const Normal<R, D>& n) noexcept {
  return ratio_down(wide(dot<R>(n, x.difference(2, 0))), wide(dot<R>(n, x.difference(1, 0))));
}

template <int D>
struct FlightPoints {
  const double* points[D + 2];

  FlightPoints(const double* p, const double* q, const double* const* simplex) noexcept : points{p, q} {
    for (int i = 0; i < D; ++i) points[2 + i] = simplex[i];
  }
};

}  // namespace

template <int D>
bool quick_plane_hit(const double* p, const double* q, const double* const* simplex, PlaneHit<D>* hit) noexcept {
  if constexpr (D == 3) {
    CertifiedHit certified;
    if (!certified_hit(p, q, simplex, true, &certified)) return false;
    hit->time = certified.time;
    point_back(certified.normal, hit->normal);
    return true;
  }
  return false;
}

template <int D>
PlaneHit<D> plane_hit(const double* p, const double* q, const double* const* simplex) noexcept {
  PlaneHit<D> quick;
  if (quick_plane_hit(p, q, simplex, &quick)) return quick;
  const FlightPoints<D> flight(p, q, simplex);
  return evaluate<D>(flight.points, [](const auto& x) noexcept {
    const auto n = x.normal(2);
    PlaneHit<D> hit;
    hit.time = time_of(x, n);
    normalize(n, x.span(), hit.normal);
    for (int k = 0; k < D; ++k) hit.normal[k] = 0 - hit.normal[k];  // never -0
    return hit;
  });
}

template <int D>
void plane_hits(const PlaneFlight<D>* flights, uint32_t count, PlaneHit<D>* hits) noexcept {
  for (uint32_t i = 0; i < count; i += kHitsAbreast) {
    const uint32_t now = std::min(kHitsAbreast, count - i);
    PlaneFlight<D> together[kHitsAbreast];  // repeats the last
    PlaneHit<D> certified[kHitsAbreast];
    for (uint32_t j = 0; j < kHitsAbreast; ++j) together[j] = flights[i + std::min(j, now - 1)];
    uint32_t decided = 0;
    if constexpr (D == 3) decided = certified_hits(together, certified);
    for (uint32_t j = 0; j < now; ++j) {
      const PlaneFlight<D>& f = together[j];
      hits[i + j] = (decided >> j & 1u) != 0 ? certified[j] : plane_hit<D>(f.p, f.q, f.simplex);
    }
  }
}

template <int D>
double crossing_time(const double* p, const double* q, const double* const* simplex) noexcept {
  if constexpr (D == 3) {
    CertifiedHit certified;
    if (certified_hit(p, q, simplex, false, &certified)) return certified.time;
  }
  const FlightPoints<D> flight(p, q, simplex);
  return evaluate<D>(flight.points, [](const auto& x) noexcept { return time_of(x, x.normal(2)); });
}

template <int D>
void unit_normal(const double* const* simplex, double* normal) noexcept {
  const double* points[D];
  for (int i = 0; i < D; ++i) points[i] = simplex[i];
  evaluate<D>(points, [normal](const auto& x) noexcept {
    normalize(x.normal(0), x.span(), normal);
    return 0;
  });
}

DSW_INSTANTIATE(quick_plane_hit);
DSW_INSTANTIATE(plane_hit);
DSW_INSTANTIATE(plane_hits);
DSW_INSTANTIATE(crossing_time);
DSW_INSTANTIATE(unit_normal);

}  // namespace dsw
