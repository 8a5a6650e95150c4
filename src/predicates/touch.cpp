// Everything is an orientation without the shift, in space or, for what lies in a plane, along an axis along which the plane is not seen
// edge-on. Every time is that of a vertex passing a plane: planes through what lies in a plane or line get points beside it.
#include "predicates/touch.h"

#include <algorithm>

#include "predicates/filtered.h"

namespace dsw {
namespace {

int side(const double* a, const double* b, const double* c, const double* x) noexcept {
  const double* const triangle[3] = {a, b, c};
  return orient<3>(triangle, x);
}

// Seen along an axis.
int side(const double* a, const double* b, const double* x, int axis) noexcept {
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  const double from[2] = {a[i], a[j]}, to[2] = {b[i], b[j]}, at[2] = {x[i], x[j]};
  const double* const line[2] = {from, to};
  return orient<2>(line, at);
}

bool same_side(int a, int b) noexcept { return a * b > 0; }
// All on one side, or on the boundary.
bool agree(int a, int b, int c) noexcept { return (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0); }

bool is_between(double x, double a, double b) noexcept { return std::min(a, b) <= x && x <= std::max(a, b); }

// A point beside x along an axis.
struct Beside {
  double at[3];

  Beside(const double* x, int axis) noexcept {
    std::copy_n(x, 3, at);
    at[axis] = x[axis] == 0 ? 1 : 0;
  }
};

double plane_time(const double* p, const double* to, const double* a, const double* b, const double* c) noexcept {
  SweepEvent event;
  event.points[0] = a;
  event.points[1] = b;
  event.points[2] = c;
  return event_time<3>(p, to, event);
}

// An axis along which the plane of three points is not seen edge-on; -1: they lie in a line.
int open_axis(const double* a, const double* b, const double* c) noexcept {
  for (int axis = 0; axis < 3; ++axis) {
    if (side(a, b, c, axis) != 0) return axis;
  }
  return -1;
}

// The earlier end of a b that is on p p', where all lie in one line; 0 if neither is: then p is on a b.
EdgeTouch first_on_line(const double* p, const double* to, const double* a, const double* b) noexcept {
  int axis = 0;
  while (axis < 2 && p[axis] == to[axis]) ++axis;
  EdgeTouch first;
  const double* const ends[2] = {a, b};
  for (int k = 0; k < 2; ++k) {
    const double* const x = ends[k];
    if (!is_between(x[axis], p[axis], to[axis])) continue;
    const Beside up(x, (axis + 1) % 3), out(x, (axis + 2) % 3);
    const double time = plane_time(p, to, x, up.at, out.at);
    if (time < first.time) first = {time, k == 0 ? TouchPlace::kFirst : TouchPlace::kSecond};
  }
  if (first.time == kNever) first = {0, TouchPlace::kVertex};
  return first;
}

// When the moving vertex is on segment a b.
EdgeTouch path_touch(const double* p, const double* to, const double* a, const double* b) noexcept {
  if (!segments_touch(p, to, a, b)) return {};
  for (int axis = 0; axis < 3; ++axis) {
    if (side(p, to, a, axis) == 0 && side(p, to, b, axis) == 0) continue;
    const Beside beside(a, axis);
    return {plane_time(p, to, a, b, beside.at), TouchPlace::kVertex};
  }
  return first_on_line(p, to, a, b);
}

void keep_earlier(EdgeTouch& first, const EdgeTouch& other) noexcept {
  if (other.time < first.time) first = other;
}

// The segment lies in the plane of the swept triangle and touches it.
EdgeTouch edge_touch_in_plane(const EdgeMotion& m, const double* a, const double* b) noexcept {
  EdgeTouch first = path_touch(m.p, m.to, a, b);
  const int axis = open_axis(m.p, m.to, m.q);
  if (axis < 0) return first;
  const double* const ends[2] = {a, b};
  for (int k = 0; k < 2; ++k) {
    const double* const x = ends[k];
    if (!agree(side(m.p, m.to, x, axis), side(m.to, m.q, x, axis), side(m.q, m.p, x, axis))) continue;
    const Beside beside(x, axis);
    SweepEvent event;
    event.kind = EventKind::kEdge;
    event.points[0] = m.q;
    event.points[1] = x;
    event.points[2] = beside.at;
    keep_earlier(first, {event_time<3>(m.p, m.to, event), k == 0 ? TouchPlace::kFirst : TouchPlace::kSecond});
  }
  return first;
}

}  // namespace

bool are_collinear(const double* a, const double* b, const double* c) noexcept { return open_axis(a, b, c) < 0; }

bool segments_touch(const double* a, const double* b, const double* c, const double* d) noexcept {
  for (int k = 0; k < 3; ++k) {
    if (std::max(a[k], b[k]) < std::min(c[k], d[k]) || std::max(c[k], d[k]) < std::min(a[k], b[k])) return false;
  }
  if (side(a, b, c, d) != 0) return false;
  for (int axis = 0; axis < 3; ++axis) {
    const int at_c = side(a, b, c, axis), at_d = side(a, b, d, axis);
    const int at_a = side(c, d, a, axis), at_b = side(c, d, b, axis);
    // Where any of them is not 0, the common plane is not seen edge-on.
    if ((at_a | at_b | at_c | at_d) != 0) return !same_side(at_a, at_b) && !same_side(at_c, at_d);
  }
  return true;  // in one line, and their boxes overlap
}

bool triangle_touches(const double* const* t, const double* a, const double* b) noexcept {
  const int at_a = orient<3>(t, a), at_b = orient<3>(t, b);
  if (same_side(at_a, at_b)) return false;
  if (at_a != 0 || at_b != 0) return agree(side(a, b, t[0], t[1]), side(a, b, t[1], t[2]), side(a, b, t[2], t[0]));
  for (int k = 0; k < 3; ++k) {
    if (segments_touch(t[k], t[(k + 1) % 3], a, b)) return true;
  }
  // All of the segment is inside of the triangle, or nothing.
  const int axis = open_axis(t[0], t[1], t[2]);
  return axis >= 0 && agree(side(t[0], t[1], a, axis), side(t[1], t[2], a, axis), side(t[2], t[0], a, axis));
}

double vertex_touch(const double* p, const double* to, const double* const* t) noexcept {
  if (!triangle_touches(t, p, to)) return kNever;
  if (orient<3>(t, p) != 0 || orient<3>(t, to) != 0) return plane_time(p, to, t[0], t[1], t[2]);
  EdgeTouch first;
  for (int k = 0; k < 3; ++k) keep_earlier(first, path_touch(p, to, t[k], t[(k + 1) % 3]));
  return first.time == kNever ? 0 : first.time;
}

EdgeTouch edge_touch(const EdgeMotion& m, const double* a, const double* b) noexcept {
  const double* const swept[3] = {m.p, m.to, m.q};
  if (!triangle_touches(swept, a, b)) return {};
  const int at_a = orient<3>(swept, a), at_b = orient<3>(swept, b);
  if (at_a == 0 && at_b == 0) return edge_touch_in_plane(m, a, b);
  SweepEvent event;
  event.kind = EventKind::kEdge;
  event.points[0] = m.q;
  event.points[1] = a;
  event.points[2] = b;
  const TouchPlace place = at_a == 0 ? TouchPlace::kFirst : at_b == 0 ? TouchPlace::kSecond : TouchPlace::kInside;
  return {event_time<3>(m.p, m.to, event), place};
}

double face_touch(const FaceMotion& m, const double* v) noexcept {
  const int whole = side(m.p, m.to, m.q, m.r);
  if (whole == 0) return kNever;
  const int parts[4] = {side(v, m.to, m.q, m.r), side(m.p, v, m.q, m.r), side(m.p, m.to, v, m.r),
                        side(m.p, m.to, m.q, v)};
  for (const int part : parts) {
    if (part * whole < 0) return kNever;
  }
  SweepEvent event;
  event.kind = EventKind::kFace;
  event.points[0] = m.q;
  event.points[1] = m.r;
  event.points[2] = v;
  return event_time<3>(m.p, m.to, event);
}

}  // namespace dsw
