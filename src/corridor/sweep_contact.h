#pragma once
// What the swept edges and faces of one moving vertex meet, and in which order.

#include <algorithm>
#include <cmath>

#include "base/simplex.h"
#include "environment/environment.h"
#include "map/dart.h"
#include "predicates/sweep_events.h"
#include "walk/cast.h"

namespace dsw {

constexpr uint32_t kNoVertex = 0xffffffffu;

/** What an edge or a face meets. Its event borrows the body's points. */
struct SweepContact {
  SweepEvent event;
  Cell front;       // the cell from which it is met
  HalfFacet facet;  // impassable, seen from `front`; invalid for a marked edge. Of a face: the lowest impassable facet
      // at the vertex by its canonical name, from its passable side; invalid if only a marked vertex or edge makes it
      // impassable
  bool faces_start = false;     // p lies on this side of the plane
  uint32_t simplex = 0;         // of `front`, in `facet`; not of a face
  uint32_t dart = kNoFacet;     // of `front`, along the obstacle's edge; kNoFacet for other events and on a diagonal
  Dart lowest;                  // of the obstacle's edge, in the cell of the lowest index round it, if that is known
  uint32_t vertex = kNoVertex;  // of a face, in the plane of an edge: the environment vertex it meets
  Simplex part{Simplex::kVertex, kNoVertex};  // that meets it; a vertex: the moving one. A sweep leaves this open
};

/** That of a cast which hit something: the moving end alone. */
template <int D>
SweepContact path_contact(const Environment<D>& env, const CastResult& path) noexcept;

/** In the order in which they count at one time. */
enum class ContactKind : uint32_t { kVertex, kEdge, kPlane };

inline ContactKind kind_of(const SweepContact& c) {
  if (c.vertex != kNoVertex) return ContactKind::kVertex;
  return c.dart != kNoFacet ? ContactKind::kEdge : ContactKind::kPlane;
}

/** A time in [0,1] that is not earlier than that of an event. */
template <int D>
double time_after(const double* p, const double* to, const SweepEvent& event) noexcept {
  return std::min(1.0, std::nextafter(event_time<D>(p, to, event), 2.0));
}

/** Whether two contacts are the same thing of the body at the same thing of the environment, seen from any cell. */
bool same_event(const SweepContact& a, const SweepContact& b) noexcept;

/** Whether `a` counts before `b` when a vertex goes from p to p' and they are contacts of any of its edges and faces:
 * by exact time, then kind, then the canonical names of what is met and from where. Neither comes before the other only
 * if the same is met from the same place: then the caller's order of edges and faces counts. */
template <int D>
bool comes_before(const Map<D>& map, const double* p, const double* to, const SweepContact& a,
                  const SweepContact& b) noexcept;

}  // namespace dsw
