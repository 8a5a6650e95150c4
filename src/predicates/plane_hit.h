// Where the flight of a body point meets a plane it crosses: reported values, rounded in a fixed direction.
#pragma once

#include <cstdint>

#include "base/fp_rules.h"

namespace dsw {

template <int D>
struct PlaneHit {
  double time;
  double normal[D];  // -n/|n|: out of the obstacle, towards p
};

// The largest double <= the exact t = -n.(p-a) / n.(q-p), clamped to [0,1], and the normal. p and q lie on opposite
// sides of the plane or on it, n.(q-p) > 0. Exactly that double for any finite input. The shift does not enter.
template <int D>
PlaneHit<D> plane_hit(const double* p, const double* q, const double* const* simplex) noexcept;

// Computes plane_hit by doubles alone, for any p and q. Returns false if doubles do not decide, and where n.(q-p) <= 0. Always false in
// the plane.
template <int D>
bool quick_plane_hit(const double* p, const double* q, const double* const* simplex, PlaneHit<D>* hit) noexcept;

template <int D>
struct PlaneFlight {
  const double* p;
  const double* q;
  const double* simplex[D];
};

// Computes plane_hit for several flights side by side.
template <int D>
void plane_hits(const PlaneFlight<D>* flights, uint32_t count, PlaneHit<D>* hits) noexcept;

// Computes the time of plane_hit, without the normal.
template <int D>
double crossing_time(const double* p, const double* q, const double* const* simplex) noexcept;

// Outward n/|n|, from the exact n: a few ulp also for slivers and at any scale. Zero if the simplex is degenerate.
template <int D>
void unit_normal(const double* const* simplex, double* normal) noexcept;

}  // namespace dsw
