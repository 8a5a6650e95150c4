#pragma once
// The shape of a body that moves as a whole, from which all of its places follow: no number of motions bends it.

#include "base/memory.h"

namespace dsw {

template <int D>
struct Body;

/** A rigid motion: x becomes x + (R - 1) (x - centre) + translation. */
template <int D>
struct RigidMotion {
  double rotation[4] = {0, 0, 0, 1};  // unit quaternion x, y, z, w; in the plane x and y are 0
  double centre[D] = {};
  double translation[D] = {};

  /** Where a point goes; without a rotation and translation to where it is, to the bit. `to` may
   * be `from`. */
  void place(const double* from, double* to) const noexcept;
  /** Where the centre goes. */
  void centre_now(double* to) const noexcept;
  /** Adds a motion after this one: by a unit quaternion about where the centre is now, then by
   * `shift`. */
  void add(const double* turn, const double* shift) noexcept;
  /** Adds one by a unit quaternion about any point, then by `shift`. */
  void add_about(const double* turn, const double* point, const double* shift) noexcept;
};

/** Length 1. */
void normalise(double (&quaternion)[4]) noexcept;

/** The motion that has taken a body from its rest places, which it had when its vertices were
 * moved singly last, to its present places: these are the rest places moved and rounded, once,
 * after any number of motions. */
template <int D>
struct RigidShape {
  Array<double> rest;  // D for each vertex; empty: not taken yet
  RigidMotion<D> moved;

  explicit RigidShape(const Memory* memory) : rest(memory) {}
  uint64_t memory_bytes() const noexcept { return array_bytes(rest); }
};

/** Makes the body's present places its rest places, unless they are what the shape gives. Throws
 * std::bad_alloc with the shape as it was. */
template <int D>
void keep_shape(Body<D>& body);

/** Where the shape has a vertex. */
template <int D>
inline const double* rest_of(const RigidShape<D>& shape, uint32_t vertex) noexcept {
  return shape.rest.data() + D * size_t{vertex};
}

}  // namespace dsw
