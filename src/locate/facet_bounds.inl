// The bounds of facet_bounds.h: the same operations in the same order on every instruction set. Included once for each,
// after its `Lanes`: eight numbers in single precision.

/** Points in the frame, or ways between them. */
struct Turned {
  Lanes t, u, v;
};

inline Turned operator-(const Turned& a, const Turned& b) noexcept { return {a.t - b.t, a.u - b.u, a.v - b.v}; }
inline Turned cross(const Turned& a, const Turned& b) noexcept {
  return {a.u * b.v - a.v * b.u, a.v * b.t - a.t * b.v, a.t * b.u - a.u * b.t};
}
inline Lanes dot(const Turned& a, const Turned& b) noexcept { return (a.t * b.t + a.u * b.u) + a.v * b.v; }
inline Lanes sum(const Turned& a) noexcept { return (absolute(a.t) + absolute(a.u)) + absolute(a.v); }
inline Lanes least(const Lanes& a, const Lanes& b, const Lanes& c) noexcept { return Lanes::min(Lanes::min(a, b), c); }
inline Lanes most(const Lanes& a, const Lanes& b, const Lanes& c) noexcept { return Lanes::max(Lanes::max(a, b), c); }

template <int D>
DSW_HOT Turned turned(const SegmentFrame<D>& frame, const double* const* points) noexcept {
  Lanes x, y, z;
  read<D>(frame, points, x, y, z);
  const auto along = [&](int k) {
    const float(&axis)[3] = frame.axes[k];
    return (x * Lanes::all(axis[0]) + y * Lanes::all(axis[1])) + z * Lanes::all(axis[2]);
  };
  return {along(0) - Lanes::all(frame.half), along(1), along(2)};
}

/** A side of the triangles. */
struct Side {
  Turned way;
  Lanes square;   // of its length in u and v
  Lanes turn;     // positive: it passes the segment's line counter-clockwise
  Lanes across2;  // the squared distance of the line from it
  Lanes whole2;   // the squared distance of the segment from its point that is nearest to the line
};

DSW_HOT Side side(const Turned& a, const Turned& b, const Lanes& half) noexcept {
  const Lanes zero = Lanes::all(0);
  const Turned way = b - a;
  const Lanes square = way.u * way.u + way.v * way.v, back = (a.u * way.u + a.v * way.v) / square;
  const Lanes at = where_above(square, 0x1p-100f, Lanes::max(Lanes::min(back, zero), Lanes::all(-1)));
  const Lanes t = a.t - at * way.t, u = a.u - at * way.u, v = a.v - at * way.v;
  const Lanes across2 = u * u + v * v, gap = Lanes::max(absolute(t) - half, zero);
  return {way, square, a.u * way.v - a.v * way.u, across2, across2 + gap * gap};
}

/** @param size at least the sum of the coordinates of any corner. */
DSW_HOT void find_bounds(const Turned& a, const Turned& b, const Turned& c, const Lanes& corners, float half_length,
                         FacetBounds& bounds) noexcept {
  const Lanes zero = Lanes::all(0), half = Lanes::all(half_length), size = corners + half;
  const Side ab = side(a, b, half), bc = side(b, c, half), ca = side(c, a, half);
  const Lanes gap = Lanes::max(Lanes::max(least(a.t, b.t, c.t), zero - most(a.t, b.t, c.t)) - half, zero);
  const Lanes passed = Lanes::max(least(ab.turn, bc.turn, ca.turn), zero - most(ab.turn, bc.turn, ca.turn));
  const Lanes across2 = where_not_above(passed, 0, least(ab.across2, bc.across2, ca.across2));

  const Turned normal = cross(ca.way, ab.way);
  const Lanes sides = Lanes::all(1.5f) * ((ab.square + ab.way.t * ab.way.t) + (ca.square + ca.way.t * ca.way.t));
  const Lanes height = (absolute(dot(normal, a)) - absolute(normal.t) * half) - Lanes::all(0x1p-18f) * sides * size;
  const Lanes square = dot(normal, normal) + Lanes::all(0x1p-17f) * sides * sides, over = Lanes::max(height, zero);
  const Lanes plane2 = where_above(square, 0x1p-100f, over / square * over);

  const Lanes slack = Lanes::all(0x1p-17f) * size + Lanes::all(0x1p-44f);
  // If the plane's distance is not a number, the other one is taken.
  store(root(Lanes::max(plane2, across2 + gap * gap)) - slack, bounds.lower);
  store(root(least(ab.whole2, bc.whole2, ca.whole2)) + slack, bounds.upper);
}

template <int D>
void triangle_bounds(const SegmentFrame<D>& frame, const double* const* corners, FacetBounds& bounds) noexcept {
  const Turned a = turned<D>(frame, corners), b = turned<D>(frame, corners + 8);
  Turned c;
  if constexpr (D == 3) {
    c = turned<D>(frame, corners + 16);
  } else {
    // The triangle that leaves the plane at the side is as near.
    c = {a.t, a.u, absolute(b.t - a.t) + absolute(b.u - a.u)};
  }
  find_bounds(a, b, c, most(sum(a), sum(b), sum(c)), frame.half, bounds);
}

inline void tetrahedra_bounds(const SegmentFrame<3>& frame, const double* const* vertices,
                              FacetBounds& bounds) noexcept {
  const Turned p = turned<3>(frame, vertices);
  Lanes size = sum(p);
  size = Lanes::max(size, size.turned<1, 0, 3, 2>());
  size = Lanes::max(size, size.turned<2, 3, 0, 1>());
  // kTetrahedronFacets.
  const Turned a{p.t.turned<0, 1, 2, 0>(), p.u.turned<0, 1, 2, 0>(), p.v.turned<0, 1, 2, 0>()};
  const Turned b{p.t.turned<1, 2, 0, 2>(), p.u.turned<1, 2, 0, 2>(), p.v.turned<1, 2, 0, 2>()};
  const Turned c{p.t.turned<3, 3, 3, 1>(), p.u.turned<3, 3, 3, 1>(), p.v.turned<3, 3, 3, 1>()};
  find_bounds(a, b, c, size, frame.half, bounds);
}
