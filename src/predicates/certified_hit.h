// Times and normals of ordinary contacts without integers: double-double arithmetic with a bound of its error, which
// answers only where the bound leaves one answer. Private to this folder.
#pragma once

#include <cstdint>

#include "predicates/plane_hit.h"

namespace dsw {

// The exact value of a contact rounded as plane_hit.h says; the normal's components rounded to nearest, not normalized.
struct CertifiedHit {
  double time;
  double normal[3];  // n, outward
};

// False if it cannot tell: extreme ranges, times within 2^-90 or so of a double, components that cancel to next to
// nothing. `hit` is undefined then. Without `with_normal` only the time.
bool certified_hit(const double* p, const double* q, const double* const* triangle, bool with_normal,
                   CertifiedHit* hit) noexcept;

// The two it chooses from: the first wants AVX2 and FMA.
bool certified_hit_with_fma(const double* p, const double* q, const double* const* triangle, bool with_normal,
                            CertifiedHit* hit) noexcept;
bool certified_hit_without_fma(const double* p, const double* q, const double* const* triangle, bool with_normal,
                               CertifiedHit* hit) noexcept;

// Flights that certified_hits looks at together.
constexpr uint32_t kHitsAbreast = 4;

// Whole hits of so many flights. A bit for each that it can tell; the others are undefined.
uint32_t certified_hits(const PlaneFlight<3>* flights, PlaneHit<3>* hits) noexcept;
uint32_t certified_hits_with_fma(const PlaneFlight<3>* flights, PlaneHit<3>* hits) noexcept;

}  // namespace dsw
