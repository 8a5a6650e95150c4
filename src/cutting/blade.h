#pragma once
// A surface to cut with, of triangles: what a blade's edge sweeps, a shape, or what a loop spans. In the plane it is a
// line, of segments. Any of these simplices may be flat: what is degenerate cuts nothing.

#include <cmath>

#include "base/memory.h"
#include "base/points.h"
#include "predicates/swept_triangle.h"

namespace dsw {

/** One simplex of a blade against many points and edges of the environment, which stand still as it does. What is asked
 * of points that lie together is decided by one bound for all of them (`bound`), or else each time anew. */
template <int D>
class BladeSimplex;

template <>
class BladeSimplex<3> {
 public:
  explicit BladeSimplex(const double* const* corners) : swept_(EdgeMotion{corners[0], corners[1], corners[2]}) {}

  /** A point seen from the first two corners, rounded. */
  struct View {
    filter::Vec<3> from_first, from_second;
  };
  View view(const double* v) const {
    const EdgeMotion& m = swept_.motion();
    return {filter::difference<3>(v, m.p), filter::difference<3>(v, m.to)};
  }
  /** The error bound of all determinants below for the points in a box: one extent serves all of them, see
   * filter_bounds.h. No view of such a point reaches farther than those of the box's ends, since rounding is monotone.
   * Infinite if the filter is not to be used. */
  double bound(const double* lower, const double* upper) const {
    const View low = view(lower), high = view(upper);
    const filter::Vec<3> m = filter::extent(swept_.reach(), swept_.new_edge(), low.from_first, low.from_second,
                                            high.from_first, high.from_second);
    return filter::lowest(m) >= kFilterMin && filter::highest(m) <= kFilterMax ? filter::bound(m) : HUGE_VAL;
  }

  /** Bits of the sides of its box that v lies beyond, see PointBox. */
  uint32_t beyond_box(const double* v) const { return swept_.beyond_box(v); }
  /** On which side a point is: 1 before the blade, -1 behind it; 0 only if the simplex is flat. */
  int side(const double* v) const { return swept_.side(v); }
  int side(const double* v, const View& of_v, double bound) const {
    const double det = filter::dot(swept_.normal(), of_v.from_first);
    return std::fabs(det) > bound ? filter::sign_of(det) : swept_.side(v);
  }
  /** Where a segment, with b on side `side_of_b` and a on the other, passes through the plane of the simplex: a bit for
   * each side of it, from corner i to the next, that has this place outside. 0: it passes through the simplex. */
  uint32_t outside(const double* a, const double* b, const View& of_a, const View& of_b, int side_of_b,
                   double bound) const {
    const filter::Vec<3> first = filter::cross(of_a.from_first, of_b.from_first),
                         second = filter::cross(of_a.from_second, of_b.from_second);
    const double sides[3] = {filter::dot(first, swept_.move()), filter::dot(second, swept_.new_edge()),
                             -filter::dot(first, swept_.old_edge())};
    uint32_t bits = 0;
    bool sure = true;
    for (uint32_t i = 0; i < 3; ++i) {
      sure &= std::fabs(sides[i]) > bound;
      bits |= static_cast<uint32_t>((sides[i] > 0) != (side_of_b > 0)) << i;
    }
    return sure ? bits : swept_.outside(a, b, side_of_b);
  }
  static constexpr uint32_t kSides = SweptTriangle::kSides;
  /** Whether it passes through the simplex. */
  bool is_passed(const double* a, const double* b, int side_of_b) const { return swept_.outside(a, b, side_of_b) == 0; }

 private:
  SweptTriangle swept_;
};

/** Its front is on the right of the way from its first end to the other, as the outside of a polygon's side is. */
template <>
class BladeSimplex<2> {
 public:
  explicit BladeSimplex(const double* const* ends) : from_(ends[0]), to_(ends[1]), box_(from_, to_) {}

  struct View {};
  View view(const double*) const { return {}; }
  double bound(const double*, const double*) const { return 0; }

  uint32_t beyond_box(const double* v) const { return box_.beyond(v); }
  int side(const double* v) const { return -line_side<2>(from_, to_, &v, NoTally{}).sign; }
  int side(const double* v, const View&, double) const { return side(v); }
  bool is_passed(const double* a, const double* b, int) const {
    const double* const line[2] = {a, b};
    return plane_side<2>(line, from_, NoTally{}).sign != plane_side<2>(line, to_, NoTally{}).sign;
  }
  uint32_t outside(const double* a, const double* b, const View&, const View&, int side_of_b, double) const {
    return is_passed(a, b, side_of_b) ? 0 : 1;
  }

 private:
  const double *from_, *to_;
  PointBox<2> box_;
};

template <int D>
class Blade {
 public:
  static constexpr uint32_t kNone = 0xffffffffu;

  /** Points are read in place. Throws std::bad_alloc, as all that makes one. */
  Blade(const Memory* memory, PointArray points, uint32_t point_count);

  /** A chain of `columns` points at `rows` places, row after row: of each four neighbours, the triangle before the
   * diagonal from the first to the last, and that behind it. In the plane the chain is one point, and the segments join
   * its places. */
  static Blade of_grid(const Memory* memory, PointArray points, uint32_t rows, uint32_t columns);
  /** D points each. */
  static Blade of_simplices(const Memory* memory, PointArray points, uint32_t point_count, const uint32_t* corners,
                            uint32_t simplex_count);
  /** What a loop in space spans, from its centre: the last one of the points, which is not of the loop. */
  static Blade fan(const Memory* memory, PointArray points, uint32_t point_count);

  uint32_t point_count() const { return point_count_; }
  const double* point(uint32_t i) const { return points_[i]; }
  uint32_t simplex_count() const { return static_cast<uint32_t>(simplices_.size()); }

  void corners(uint32_t simplex, const double* out[D]) const {
    for (int k = 0; k < D; ++k) out[k] = points_[simplices_[simplex].corners[k]];
  }
  /** Number of a corner's point. */
  uint32_t corner(uint32_t simplex, int k) const { return simplices_[simplex].corners[k]; }
  /** The simplex across side `side` of a simplex, in which the blade goes on; kNone: it ends. In space the side joins
   * the corners `side` and the next, the other triangle runs the other way there; in the plane it is corner `side`. */
  uint32_t neighbour(uint32_t simplex, int side) const { return simplices_[simplex].neighbours[side]; }
  /** A simplex that has no neighbour across one of its sides, or kNone: the blade is closed. O(simplices). */
  uint32_t find_rim() const;

  BladeSimplex<D> simplex(uint32_t i) const {
    const double* at[D];
    corners(i, at);
    return BladeSimplex<D>(at);
  }

 private:
  struct Simplex {
    uint32_t corners[D], neighbours[D];
  };

  void add(const uint32_t (&corners)[D]);
  uint64_t way(size_t side, bool back) const;
  void join(const Memory* memory);

  PointArray points_;
  uint32_t point_count_;
  Array<Simplex> simplices_;
};

/** How far the nearest point of a simplex is, rounded. */
template <int D>
double distance_to_simplex(const double* from, const double* const* corners);

}  // namespace dsw
