// The bounds of facet_bounds.h: the same operations in the same order on every instruction set. Included once for each,
// after its `Four`: four doubles side by side.

/** Corners of four triangles in the frame. */
struct Corners {
  Four t, u, v;
};

inline Corners operator-(const Corners& a, const Corners& b) noexcept { return {a.t - b.t, a.u - b.u, a.v - b.v}; }
inline Four dot(const Corners& a, const Corners& b) noexcept { return (a.t * b.t + a.u * b.u) + a.v * b.v; }
inline Corners cross(const Corners& a, const Corners& b) noexcept {
  return {a.u * b.v - a.v * b.u, a.v * b.t - a.t * b.v, a.t * b.u - a.u * b.t};
}
inline Four least(const Four& a, const Four& b, const Four& c) noexcept { return Four::min(Four::min(a, b), c); }
inline Four most(const Four& a, const Four& b, const Four& c) noexcept { return Four::max(Four::max(a, b), c); }

template <int D>
[[gnu::always_inline]] inline Corners turned(const SegmentFrame& frame, const double* const* points) noexcept {
  Four x, y, z;
  read<D>(points, x, y, z);
  const Four scale = Four::all(frame.scale);
  x = x * scale - Four::all(frame.first[0]);
  y = y * scale - Four::all(frame.first[1]);
  z = z * scale - Four::all(frame.first[2]);
  const auto along = [&](int k) {
    const double(&axis)[3] = frame.axes[k];
    return (x * Four::all(axis[0]) + y * Four::all(axis[1])) + z * Four::all(axis[2]);
  };
  return {along(0), along(1), along(2)};
}

/** A side of the triangles. */
struct Side {
  Four turn;     // positive: it passes the segment's line counter-clockwise
  Four across2;  // the squared distance of the line from it
  Four whole2;   // the squared distance of the segment from its point that is nearest to the line
};

[[gnu::always_inline]] inline Side side(const Corners& a, const Corners& b, const Four& length) noexcept {
  const Four zero = Four::all(0), tiny = Four::all(0x1p-900);
  const Corners way = b - a;
  const Four square = way.u * way.u + way.v * way.v, ahead = zero - (a.u * way.u + a.v * way.v);
  const Four at = Four::if_positive(square - tiny, Four::min(Four::max(ahead / square, zero), Four::all(1)), zero);
  const Four t = a.t + at * way.t, u = a.u + at * way.u, v = a.v + at * way.v;
  const Four across2 = u * u + v * v, gap = most(t - length, zero - t, zero);
  return {a.u * way.v - a.v * way.u, across2, across2 + gap * gap};
}

[[gnu::always_inline]] inline void find_bounds(const Corners& a, const Corners& b, const Corners& c,
                                               double segment_length, FacetBounds& bounds) noexcept {
  const Four zero = Four::all(0), length = Four::all(segment_length);
  const Side ab = side(a, b, length), bc = side(b, c, length), ca = side(c, a, length);
  const Four low = least(a.t, b.t, c.t), high = most(a.t, b.t, c.t), gap = most(low - length, zero - high, zero);
  const Four is_passed = Four::max(least(ab.turn, bc.turn, ca.turn), zero - most(ab.turn, bc.turn, ca.turn));
  const Four across2 = Four::if_positive(is_passed, zero, least(ab.across2, bc.across2, ca.across2));
  const Four size = (Four::max(high, zero - low) + most(absolute(a.u), absolute(b.u), absolute(c.u))) +
                    (most(absolute(a.v), absolute(b.v), absolute(c.v)) + length);

  const Corners first = b - a, second = c - a, normal = cross(first, second);
  const Four height = dot(normal, a), last = height - normal.t * length;
  const Four sides = Four::all(1.5) * (dot(first, first) + dot(second, second));
  const Four over =
      Four::max(Four::min(height, last), zero - Four::max(height, last)) - Four::all(0x1p-47) * sides * size;
  const Four square = dot(normal, normal) + Four::all(0x1p-46) * sides * sides, away = Four::max(over, zero);
  const Four plane2 = Four::if_positive(square - Four::all(0x1p-900), away * away / square, zero);

  const Four slack = Four::all(0x1p-44) * size + Four::all(0x1p-400);
  store(root(Four::max(across2 + gap * gap, plane2)) - slack, bounds.lower);
  store(root(least(ab.whole2, bc.whole2, ca.whole2)) + slack, bounds.upper);
}

template <int D>
void triangle_bounds(const SegmentFrame& frame, const double* const* corners, FacetBounds& bounds) noexcept {
  const Corners a = turned<D>(frame, corners), b = turned<D>(frame, corners + 4);
  if constexpr (D == 3) {
    find_bounds(a, b, turned<D>(frame, corners + 8), frame.length, bounds);
  } else {
    // The triangle that leaves the plane at the side is as near.
    const Corners way = b - a;
    find_bounds(a, b, {a.t, a.u, absolute(way.t) + absolute(way.u)}, frame.length, bounds);
  }
}

inline void tetrahedron_bounds(const SegmentFrame& frame, const double* const* corners, FacetBounds& bounds) noexcept {
  const Corners p = turned<3>(frame, corners);
  // kTetrahedronFacets.
  const Corners a{p.t.turned<0, 1, 2, 0>(), p.u.turned<0, 1, 2, 0>(), p.v.turned<0, 1, 2, 0>()};
  const Corners b{p.t.turned<1, 2, 0, 2>(), p.u.turned<1, 2, 0, 2>(), p.v.turned<1, 2, 0, 2>()};
  const Corners c{p.t.turned<3, 3, 3, 1>(), p.u.turned<3, 3, 3, 1>(), p.v.turned<3, 3, 3, 1>()};
  find_bounds(a, b, c, frame.length, bounds);
}

template <int D>
BoundsKernel<D> this_kernel() noexcept {
  if constexpr (D == 3) {
    return {triangle_bounds<3>, tetrahedron_bounds};
  } else {
    return {triangle_bounds<2>, nullptr};
  }
}
