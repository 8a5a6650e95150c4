#pragma once
// The walk, compiled for several instruction sets. All give the same bits; which one runs is chosen once, when the library
// is loaded. This header holds what they share, so that the files included per instruction set include nothing.

#include <algorithm>
#include <cmath>
#include <new>

#include "motion/cast.h"
#include "motion/prefetch.h"
#include "predicates/filtered.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

// What runs for every cell is inlined into the walk; what runs for one in a thousand stays out of its registers.
#define DSW_HOT inline __attribute__((always_inline))
#define DSW_COLD __attribute__((noinline, cold))

namespace dsw {

/** Counting in the hot loops: a policy, so that a scene without statistics pays nothing. */
struct CountNothing {
  void test() noexcept {}
  void tests(uint32_t) noexcept {}
  void exact() noexcept {}
  void tie() noexcept {}
};

struct CountAll {
  CastCounters* counters;
  void test() noexcept { ++counters->orientation_tests; }
  void tests(uint32_t n) noexcept { counters->orientation_tests += n; }
  void exact() noexcept { ++counters->exact_fallbacks; }
  void tie() noexcept { ++counters->ties; }
};

/** The facets of standard_shape, for kernels that know them by heart. */
constexpr uint8_t kTetrahedronFacets[4][3] = {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {0, 2, 1}};
constexpr uint8_t kBoxFacets[6][4] = {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4},
                                      {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}};

/** Of a flat facet any three vertices give the plane, so that vertices 0 and 6 of a box need not be read: what remains of a
 * facet are three neighbours on the ring 1 2 3 7 4 5. */
constexpr uint8_t kFlatFacets[3][6] = {{4, 5, 1, 2, 3, 7}, {7, 1, 5, 3, 2, 4}, {3, 2, 4, 7, 1, 5}};

/** The ridge that two facets share: its vertices in the order of the first facet; a == b if there is none. */
struct Ridge {
  uint8_t a = 0, b = 0;
};

template <uint32_t Facets>
struct RidgeTable {
  Ridge of[Facets][Facets];
};

template <uint32_t Facets, uint32_t Vertices>
constexpr RidgeTable<Facets> make_ridges(const uint8_t (&facets)[Facets][Vertices]) {
  RidgeTable<Facets> table{};
  for (uint32_t f = 0; f < Facets; ++f) {
    for (uint32_t g = 0; g < Facets; ++g) {
      for (uint32_t i = 0; i < Vertices * Vertices; ++i) {
        const uint8_t a = facets[f][i / Vertices], b = facets[f][(i / Vertices + 1) % Vertices];
        if (facets[g][i % Vertices] == b && facets[g][(i % Vertices + 1) % Vertices] == a) table.of[f][g] = {a, b};
      }
    }
  }
  return table;
}
constexpr RidgeTable<4> kTetrahedronRidges = make_ridges(kTetrahedronFacets);
constexpr RidgeTable<6> kBoxRidges = make_ridges(kBoxFacets);

/** Triangle `half` of facet f of a hexahedron, as its standard shape has it. */
inline void box_triangle(const Environment<3>& env, const uint32_t* w, uint32_t f, uint32_t half,
                         const double* (&triangle)[3]) noexcept {
  const uint32_t base = w[0] >> f & 1u;
  triangle[0] = env.point(w[kUnitWords + kBoxFacets[f][base]]);
  triangle[1] = env.point(w[kUnitWords + kBoxFacets[f][base + 1 + half]]);
  triangle[2] = env.point(w[kUnitWords + kBoxFacets[f][(base + 2 + half) & 3u]]);
}

template <int D>
struct Walk {
  void (*plain)(const Environment<D>& env, const CastRequest* requests, uint32_t count, CastResult* results) noexcept;
  void (*counted)(const Environment<D>& env, const CastRequest* requests, uint32_t count, CastResult* results,
                  CastCounters* counters) noexcept;
  bool (*contains)(const Environment<D>& env, Cell cell, const double* centre, const double* point) noexcept;
};

template <int D>
Walk<D> portable_walk() noexcept;
#if defined(__x86_64__)
Walk<3> avx2_walk() noexcept;
Walk<3> avx512_walk() noexcept;
#endif

}  // namespace dsw
