#pragma once
// A cast: one straight flight of a point through an environment, cell by cell, to its target or to the first impassable
// facet [JCD10] 3.3. Exact under the shift of predicates/: start and target are thought of as shifted by one
// infinitesimal, so the start lies in one cell and the segment pierces one simplex of a facet at a time.

#include <cstdint>

#include "environment/environment.h"

namespace dsw {

enum class CastEnd : uint32_t { kReached, kHit, kWorkLimit };

/** Where a flight ended. */
struct alignas(8) CastResult {
  CastEnd end = CastEnd::kReached;
  Cell cell;                        // the last cell entered
  HalfFacet facet;                  // kHit: the impassable facet, seen from `cell`
  uint32_t simplex = 0;             // kHit: which simplex of `cell` was pierced. kWorkLimit: that through which `cell`
                                    // was entered, in the numbering of `previous`, or the first of its facet if
                                    // that is flat
  Cell previous;                    // the cell before `cell`; invalid if it is the first
  uint32_t volumes_visited = 1;     // the first included
  uint32_t first_facet = kNoFacet;  // local number of the facet through which the first cell was left, or tried to be
};

/** Counters of casts; plain adds into a struct of the calling thread. */
struct CastCounters {
  uint64_t casts = 0, volumes_visited = 0, orientation_tests = 0, exact_fallbacks = 0, ties = 0;
  void add(const CastCounters& o) {
    casts += o.casts;
    volumes_visited += o.volumes_visited;
    orientation_tests += o.orientation_tests;
    exact_fallbacks += o.exact_fallbacks;
    ties += o.ties;
  }
};

/** Is told every cell entered after the first: the cell it came from, the simplex of that cell which was pierced, the
 * cell entered. */
using CrossingFn = void (*)(void* user, Cell from, uint32_t simplex, Cell to);

struct alignas(64) CastRequest {
  const double* from;  // D finite doubles, in `start` under the shift
  const double* to;
  Cell start;
  Cell end = {};  // contains `to` under the shift, if that is known: a convex one is entered and not looked at
  uint32_t max_volumes = 0;      // 0: no limit
  uint32_t forecast = kNoFacet;  // local facet of `start` to test first, in convex cells of other than the common forms
  bool through_walls = false;    // ends only at the target or the outer boundary (locating)
  CrossingFn crossing = nullptr;
  void* crossing_user = nullptr;
};
static_assert(sizeof(CastRequest) == 64);  // one line, and a place is found by a shift

/** Casts. Work is O(cells crossed). Every step crosses a facet later on the segment than the one before, so it ends. */
template <int D>
CastResult cast(const Environment<D>& env, const CastRequest& request, CastCounters* counters) noexcept;

/** A plain cast. */
template <int D>
CastResult cast(const Environment<D>& env, const double* from, const double* to, Cell start, uint32_t max_volumes = 0,
                CastCounters* counters = nullptr) noexcept {
  CastRequest request;
  request.from = from;
  request.to = to;
  request.start = start;
  request.max_volumes = max_volumes;
  return cast(env, request, counters);
}

constexpr uint32_t kPacket = 128;  // most casts that run side by side

/** Casts `count` <= kPacket segments, which together take half the time of single casts or less. Results and counters
 * do not depend on how casts are grouped. */
template <int D>
void cast_side_by_side(const Environment<D>& env, const CastRequest* requests, uint32_t count, CastResult* results,
                       CastCounters* counters) noexcept;

/** Whether a point, shifted, lies in a cell: inside all planes of a convex one; else nothing of the cell's boundary
 * stands between its centre and the point. */
template <int D>
bool contains(const Environment<D>& env, Cell cell, const double* point) noexcept;

/** Whether the filter sees that a point lies strictly inside of all boundary planes of a hexahedron that need not be
 * convex, in the plane of the lines of a polygon's sides. All points with that property form a convex set, which holds
 * the centre of a valid cell; on the way from there to one of them no boundary simplex can be passed, as its plane is
 * not. So the set lies in the cell. And a cell is star-shaped as seen from each of them: what joins it to any other
 * point of the cell lies in the cell. False for other polyhedra. */
template <int D>
bool sees_all(const Environment<D>& env, Cell cell, const double* point, CastCounters* counters) noexcept;

/** Tells whether a cell admits a cast, as `admits` does, and gives the cell's centre. Looking at a hexahedron of moving
 * points takes half the time. */
template <int D>
bool admits_with_centre(const Environment<D>& env, Cell cell, double* centre) noexcept;

/** Largest double not later than the time at which the segment crosses simplex `simplex` of `cell`. */
template <int D>
double crossing_time(const Environment<D>& env, Cell cell, uint32_t simplex, const double* from,
                     const double* to) noexcept;

}  // namespace dsw
