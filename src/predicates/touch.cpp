// Everything is an orientation without the shift, in space or, for what lies in a plane, along an axis along which the
// plane is not seen edge-on. Every time is that of a vertex passing a plane: planes through what lies in a plane or
// line get points beside it. Those beside a plane have no part in the plane's own dimension.
#include "predicates/touch.h"

#include <algorithm>

#include "base/dimensions.h"
#include "predicates/filtered.h"
#include "predicates/swept_plane.h"

namespace dsw {
namespace {

int side(const double* a, const double* b, const double* c, const double* x) noexcept {
  const double* const triangle[3] = {a, b, c};
  return orient<3>(triangle, x);
}

// Axes along which what lies in a plane may be seen; the plane itself is seen as it is.
template <int D>
constexpr int kViews = D == 3 ? 3 : 1;

// Seen along an axis.
template <int D>
int side(const double* a, const double* b, const double* x, int axis) noexcept {
  if constexpr (D == 3) {
    const int i = (axis + 1) % 3, j = (axis + 2) % 3;
    const double from[2] = {a[i], a[j]}, to[2] = {b[i], b[j]}, at[2] = {x[i], x[j]};
    const double* const line[2] = {from, to};
    return orient<2>(line, at);
  } else {
    const double* const line[2] = {a, b};
    return orient<2>(line, x);
  }
}

bool same_side(int a, int b) noexcept { return a * b > 0; }
// All on one side, or on the boundary.
bool agree(int a, int b, int c) noexcept { return (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0); }

// Whether a line a b, which is not in the plane of a triangle t, meets it. The three determinants have their vectors in
// common; see swept_plane.h on their bounds. Where these do not know, each is asked for its own.
bool line_meets(const double* a, const double* b, const double* const* t) noexcept {
  const filter::Vec<3> way = filter::difference<3>(b, a);
  const filter::Vec<3> x = filter::difference<3>(t[0], a), y = filter::difference<3>(t[1], a),
                       z = filter::difference<3>(t[2], a);
  const filter::Vec<3> n = filter::cross(way, x), o = filter::cross(way, y);
  const double xy = filter::dot(n, y), xz = filter::dot(n, z), yz = filter::dot(o, z);
  const double size = filter::largest(way), size_x = filter::largest(x), size_y = filter::largest(y),
               size_z = filter::largest(z);
  const double bound = kPlaneFilter3 * size;
  const bool certain = filter::in_range(size) && filter::in_range(size_x) && filter::in_range(size_y) &&
                       filter::in_range(size_z) && std::fabs(xy) > bound * size_x * size_y &&
                       std::fabs(xz) > bound * size_x * size_z && std::fabs(yz) > bound * size_y * size_z;
  if (certain) return (xy > 0) == (yz > 0) && (xy > 0) == (xz < 0);
  const int first = side(a, b, t[0], t[1]), second = side(a, b, t[1], t[2]);
  return !(first * second < 0) && agree(first, second, side(a, b, t[2], t[0]));
}

bool is_between(double x, double a, double b) noexcept { return std::min(a, b) <= x && x <= std::max(a, b); }

// A point beside x along an axis.
template <int D>
struct Beside {
  double at[D];

  Beside(const double* x, int axis) noexcept {
    std::copy_n(x, D, at);
    at[axis] = x[axis] == 0 ? 1 : 0;
  }
};

// In the plane the line a b is passed.
template <int D>
double plane_time(const double* p, const double* to, const double* a, const double* b, const double* c) noexcept {
  SweepEvent event;
  event.points[0] = a;
  event.points[1] = b;
  event.points[2] = c;
  return event_time<D>(p, to, event);
}

// An axis along which the plane of three points is not seen edge-on; -1: they lie in a line.
int open_axis(const double* a, const double* b, const double* c) noexcept {
  for (int axis = 0; axis < 3; ++axis) {
    if (side<3>(a, b, c, axis) != 0) return axis;
  }
  return -1;
}

// The earlier end of a b that is on p p', where all lie in one line; 0 if neither is: then p is on a b.
template <int D>
EdgeTouch first_on_line(const double* p, const double* to, const double* a, const double* b) noexcept {
  int axis = 0;
  while (axis < D - 1 && p[axis] == to[axis]) ++axis;
  EdgeTouch first;
  const double* const ends[2] = {a, b};
  for (int k = 0; k < 2; ++k) {
    const double* const x = ends[k];
    if (!is_between(x[axis], p[axis], to[axis])) continue;
    const Beside<D> up(x, (axis + 1) % D), out(x, (axis + 2) % D);
    const double time = plane_time<D>(p, to, x, up.at, out.at);
    if (time < first.time) first = {time, k == 0 ? TouchPlace::kFirst : TouchPlace::kSecond};
  }
  if (first.time == kNever) first = {0, TouchPlace::kVertex};
  return first;
}

void keep_earlier(EdgeTouch& first, const EdgeTouch& other) noexcept {
  if (other.time < first.time) first = other;
}

// The segment lies in the plane of the swept triangle and touches it.
EdgeTouch edge_touch_in_plane(const EdgeMotion& m, const double* a, const double* b) noexcept {
  EdgeTouch first = path_touch<3>(m.p, m.to, a, b);
  const int axis = open_axis(m.p, m.to, m.q);
  if (axis < 0) return first;
  const double* const ends[2] = {a, b};
  for (int k = 0; k < 2; ++k) {
    const double* const x = ends[k];
    if (!agree(side<3>(m.p, m.to, x, axis), side<3>(m.to, m.q, x, axis), side<3>(m.q, m.p, x, axis))) continue;
    const Beside<3> beside(x, axis);
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

template <int D>
bool segments_touch(const double* a, const double* b, const double* c, const double* d) noexcept {
  for (int k = 0; k < D; ++k) {
    if (std::max(a[k], b[k]) < std::min(c[k], d[k]) || std::max(c[k], d[k]) < std::min(a[k], b[k])) return false;
  }
  if constexpr (D == 3) {
    if (side(a, b, c, d) != 0) return false;
  }
  for (int axis = 0; axis < kViews<D>; ++axis) {
    const int at_c = side<D>(a, b, c, axis), at_d = side<D>(a, b, d, axis);
    const int at_a = side<D>(c, d, a, axis), at_b = side<D>(c, d, b, axis);
    // Where any of them is not 0, the common plane is not seen edge-on.
    if ((at_a | at_b | at_c | at_d) != 0) return !same_side(at_a, at_b) && !same_side(at_c, at_d);
  }
  return true;  // in one line, and their boxes overlap
}

template <int D>
EdgeTouch path_touch(const double* p, const double* to, const double* a, const double* b) noexcept {
  if (!segments_touch<D>(p, to, a, b)) return {};
  for (int axis = 0; axis < kViews<D>; ++axis) {
    if (side<D>(p, to, a, axis) == 0 && side<D>(p, to, b, axis) == 0) continue;
    const Beside<D> beside(a, axis);
    return {plane_time<D>(p, to, a, b, beside.at), TouchPlace::kVertex};
  }
  return first_on_line<D>(p, to, a, b);
}

bool triangle_touches(const double* const* t, const double* a, const double* b) noexcept {
  const int at_a = orient<3>(t, a), at_b = orient<3>(t, b);
  if (same_side(at_a, at_b)) return false;
  if (at_a != 0 || at_b != 0) return line_meets(a, b, t);
  for (int k = 0; k < 3; ++k) {
    if (segments_touch<3>(t[k], t[(k + 1) % 3], a, b)) return true;
  }
  // All of the segment is inside of the triangle, or nothing.
  const int axis = open_axis(t[0], t[1], t[2]);
  return axis >= 0 && agree(side<3>(t[0], t[1], a, axis), side<3>(t[1], t[2], a, axis), side<3>(t[2], t[0], a, axis));
}

double vertex_touch(const double* p, const double* to, const double* const* t) noexcept {
  if (!triangle_touches(t, p, to)) return kNever;
  if (orient<3>(t, p) != 0 || orient<3>(t, to) != 0) return plane_time<3>(p, to, t[0], t[1], t[2]);
  EdgeTouch first;
  for (int k = 0; k < 3; ++k) keep_earlier(first, path_touch<3>(p, to, t[k], t[(k + 1) % 3]));
  return first.time == kNever ? 0 : first.time;
}

namespace {

// Whether what lies strictly between p and p' touches segment a b.
template <int D>
bool inside_touches_segment(const double* p, const double* to, const double* a, const double* b) noexcept {
  if (!segments_touch<D>(p, to, a, b)) return false;
  for (int axis = 0; axis < kViews<D>; ++axis) {
    if (side<D>(p, to, a, axis) == 0 && side<D>(p, to, b, axis) == 0) continue;
    // They have one point in common.
    return !segments_touch<D>(p, p, a, b) && !segments_touch<D>(to, to, a, b);
  }
  int axis = 0;  // in one line
  while (axis < D && p[axis] == to[axis]) ++axis;
  return axis < D && std::max(a[axis], b[axis]) > std::min(p[axis], to[axis]) &&
         std::min(a[axis], b[axis]) < std::max(p[axis], to[axis]);
}

bool inside_touches_triangle(const double* p, const double* to, const double* const* t) noexcept {
  const int at_p = orient<3>(t, p), at_to = orient<3>(t, to);
  if (at_p != 0 || at_to != 0) return at_p * at_to < 0 && line_meets(p, to, t);
  for (int k = 0; k < 3; ++k) {
    if (inside_touches_segment<3>(p, to, t[k], t[(k + 1) % 3])) return true;
  }
  // All of it is inside of the triangle, which is convex, or nothing.
  return !std::equal(p, p + 3, to) && triangle_touches(t, p, p) && triangle_touches(t, to, to);
}

}  // namespace

template <int D>
EdgeTouch point_touch(const double* p, const double* to, const double* const* corners, uint32_t count) noexcept {
  const bool is_triangle = D == 3 && count == 3;
  const double *const a = corners[0], *const b = corners[count == 1 ? 0 : 1];
  EdgeTouch touch = is_triangle ? EdgeTouch{vertex_touch(p, to, corners)} : path_touch<D>(p, to, a, b);
  if (is_triangle) touch.place = TouchPlace::kVertex;
  if (touch.time == 0 || touch.time == kNever) return touch;
  const bool starts = is_triangle ? triangle_touches(corners, p, p) : segments_touch<D>(p, p, a, b);
  return starts ? EdgeTouch{0, TouchPlace::kVertex} : touch;
}

template <int D>
bool inside_touches(const double* p, const double* to, const double* const* corners, uint32_t count) noexcept {
  if (D == 3 && count == 3) return inside_touches_triangle(p, to, corners);
  return inside_touches_segment<D>(p, to, corners[0], corners[count == 1 ? 0 : 1]);
}

EdgeTouch edge_touch(const EdgeMotion& m, const double* a, const double* b) noexcept {
  const double* const swept[3] = {m.p, m.to, m.q};
  const SweptPlane plane(m);
  const auto side_of = [&](const double* x) {
    const int known = plane.side(x);
    return known != 0 ? known : orient<3>(swept, x);
  };
  const int at_a = side_of(a), at_b = a == b ? at_a : side_of(b);
  if (same_side(at_a, at_b)) return {};
  if (at_a == 0 && at_b == 0) return triangle_touches(swept, a, b) ? edge_touch_in_plane(m, a, b) : EdgeTouch{};
  if (!line_meets(a, b, swept)) return {};
  SweepEvent event;
  event.kind = EventKind::kEdge;
  event.points[0] = m.q;
  event.points[1] = a;
  event.points[2] = b;
  const TouchPlace place = at_a == 0 ? TouchPlace::kFirst : at_b == 0 ? TouchPlace::kSecond : TouchPlace::kInside;
  return {event_time<3>(m.p, m.to, event), place};
}

template <int D>
double solid_touch(const SolidMotion<D>& m, const double* v) noexcept {
  const double* points[D + 1] = {m.p, m.to, m.q};
  SweepEvent event;
  event.points[0] = m.q;
  if constexpr (D == 3) {
    event.kind = EventKind::kFace;
    event.points[1] = points[3] = m.r;
  } else {
    event.kind = EventKind::kEdge;
  }
  event.points[D - 1] = v;
  const int whole = orient<D>(points, points[D]);
  if (whole == 0) return kNever;
  for (const double*& each : points) {
    const double* const replaced = each;
    each = v;
    if (orient<D>(points, points[D]) * whole < 0) return kNever;
    each = replaced;
  }
  return event_time<D>(m.p, m.to, event);
}

DSW_INSTANTIATE(segments_touch);
DSW_INSTANTIATE(path_touch);
DSW_INSTANTIATE(point_touch);
DSW_INSTANTIATE(inside_touches);
DSW_INSTANTIATE(solid_touch);

}  // namespace dsw
