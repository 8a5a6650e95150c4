// Whether and when closed simplices of bodies touch. Both are shifted alike, so the shift cancels and does not enter:
// touching counts, also where everything lies in one plane or line. A vertex goes from p to p' (`to`), the rest of its
// body stays; times are the largest doubles not above the exact ones, for any finite input.
#pragma once

#include "predicates/sweep_events.h"

namespace dsw {

// Later than any time of a move.
constexpr double kNever = 2;

bool are_collinear(const double* a, const double* b, const double* c) noexcept;

// Whether segments a b and c d have a point in common; either may be a point.
template <int D>
bool segments_touch(const double* a, const double* b, const double* c, const double* d) noexcept;

// Whether triangle x y z and segment a b have one; both may be degenerate.
bool triangle_touches(const double* const* triangle, const double* a, const double* b) noexcept;

// Where a moving edge touches a segment a b: inside of it, or at one of its ends, or with the moving vertex.
enum class TouchPlace : uint32_t { kInside, kFirst, kSecond, kVertex };
struct EdgeTouch {
  double time = kNever;
  TouchPlace place = TouchPlace::kInside;
};

// The first time at which the moving vertex is on segment a b, if it does not start there. a and b may be one point.
template <int D>
EdgeTouch path_touch(const double* p, const double* to, const double* a, const double* b) noexcept;

// The first time at which the moving vertex is on triangle a b c, if it does not start there.
double vertex_touch(const double* p, const double* to, const double* const* triangle) noexcept;

// The first time at which a point on its way from p to p' is on a vertex, edge or triangle with so many corners; 0 if it
// starts there. The place is that of an edge or a vertex.
template <int D>
EdgeTouch point_touch(const double* p, const double* to, const double* const* corners, uint32_t count) noexcept;

// Whether what lies strictly between p and p' has a point in common with a vertex, edge or triangle.
template <int D>
bool inside_touches(const double* p, const double* to, const double* const* corners, uint32_t count) noexcept;

// The first time at which edge p(t) q touches segment a b, if it does not at the start. a and b may be one point; so
// may p and q: then the vertex alone moves.
EdgeTouch edge_touch(const EdgeMotion& m, const double* a, const double* b) noexcept;

// The first time at which point v is on face p(t) q r, in the plane on edge p(t) q. Nothing where p, p', q, r lie in
// one plane, or p, p', q in one line: its edges, or the path, touch v then.
template <int D>
double solid_touch(const SolidMotion<D>& m, const double* v) noexcept;

}  // namespace dsw
