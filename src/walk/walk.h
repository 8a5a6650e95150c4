#pragma once
// The walk, compiled for several instruction sets. All give the same bits; which one runs, an environment says for each
// form of cells. This header holds what they share, so that the files included per instruction set include nothing.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <new>
#include <numeric>
#include <utility>

#include "base/compiler.h"
#include "environment/local_points.h"
#include "predicates/filtered.h"
#include "walk/cast.h"
#include "walk/prefetch.h"
#include "walk/shear.h"
#include "walk/standard_facets.h"

#if DSW_X86_64
#include <immintrin.h>
#endif

namespace dsw {

/** Counting in the hot loops: a policy, so that a scene without statistics pays nothing. */
struct CountNothing {
  static constexpr bool kCounts = false;
  void test() noexcept {}
  void tests(uint32_t) noexcept {}
  void exact() noexcept {}
  void tie() noexcept {}
};

struct CountAll {
  static constexpr bool kCounts = true;
  CastCounters* counters;
  void test() noexcept { ++counters->orientation_tests; }
  void tests(uint32_t n) noexcept { counters->orientation_tests += n; }
  void exact() noexcept { ++counters->exact_fallbacks; }
  void tie() noexcept { ++counters->ties; }
};

template <int D>
struct Walk {
  void (*plain)(const Environment<D>& env, const CastRequest* requests, uint32_t count, CastResult* results) noexcept;
  void (*find_outside)(const Environment<D>& env, const Cell* cells, const double* const* points, uint32_t count,
                       uint8_t* facets) noexcept;
  bool (*contains)(const Environment<D>& env, Cell cell, const double* centre, const double* point) noexcept;
  bool (*sees_all)(const Environment<D>& env, Cell cell, const double* point) noexcept;
  bool (*admits_with_centre)(const Environment<D>& env, Cell cell, double* centre) noexcept;
};

/** A walk that counts, the same for all instruction sets: what is counted does not depend on them. */
template <int D>
void walk_counted(const Environment<D>& env, const CastRequest* requests, uint32_t count, CastResult* results,
                  CastCounters* counters) noexcept;

// Constants that no code makes. They are there before the first constructor runs, and no instruction is run to make
// them that a processor has not.
extern const Walk<2> kPlaneWalk;
extern const Walk<3> kPortableWalk;
#if DSW_X86_64
extern const Walk<3> kAvx2Walk, kAvx512Walk;
#endif

}  // namespace dsw
