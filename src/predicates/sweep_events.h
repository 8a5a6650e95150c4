// When what hangs on a moving body vertex meets the environment. The vertex goes from p to p' (`to`), the rest of its
// body stays; all body points are shifted together, see exact.h. Each time is a ratio N/D of polynomials in the shift:
//   kVertex, p(t) in the plane of triangle abc:   N = n.(a-p-s)    D = n.(p'-p)       n = (b-a) x (c-a)
//   kEdge, edge p(t) q meets the line ab:         N = L(p)         D = L(p) - L(p')   L(x) = orient3(x+s, q+s, a, b)
//   kFace, face p(t) q r meets point v:           N = L(p)         D = L(p) - L(p')   L(x) = orient3(x+s, q+s, r+s, v)
// where orient3(x, y, z, w) = (y-x).((z-x) x (w-x)). Of L the shift takes its coefficients from
// (q-x) x (b-a), or (q-x) x (q-r).
// In the plane there are two kinds, with n = (y, -x) of a vector:
//   kVertex, p(t) on the line ab:                 N = n.(a-p-s)    D = n.(p'-p)       n of b-a
//   kEdge, edge p(t) q meets point v:             N = L(p)         D = L(p) - L(p')   L(x) = n.(v-x-s), n of q-x
#pragma once

#include <cstdint>
#include <type_traits>

#include "predicates/exact.h"

namespace dsw {

struct EdgeMotion {
  const double *p, *to, *q;
};

struct FaceMotion {
  const double *p, *to, *q, *r;
};

// What sweeps a part of the space of its full dimension.
template <int D>
using SolidMotion = std::conditional_t<D == 2, EdgeMotion, FaceMotion>;

enum class EventKind : uint32_t { kVertex, kEdge, kFace };

// What meets what: points are a b c, or q a b, or q r v; in the plane a b, or q v. They are borrowed.
struct SweepEvent {
  const double* points[3] = {};
  EventKind kind = EventKind::kVertex;
};
static_assert(sizeof(SweepEvent) == 4 * sizeof(void*), "an event is four words");

// Side of environment point v: sign of n.(v-p-s) with n = (p'-p) x (q-p), for any three body points. 0 only if they are
// collinear.
ShiftedSign swept_side(const EdgeMotion& m, const double* v) noexcept;

// Sign of t_a - t_b for two events of one vertex's move, on whatever edges and faces, that take place: each N/D lies in
// [0,1] and no D is the zero polynomial. tie: the times are equal but for the shift, or the shift alone decides one of
// them. 0: they are the same in all orders.
template <int D>
ShiftedSign compare_events(const double* p, const double* to, const SweepEvent& a, const SweepEvent& b) noexcept;

// Largest double <= the standard part of the time of an event that takes place.
template <int D>
double event_time(const double* p, const double* to, const SweepEvent& event) noexcept;

}  // namespace dsw
