#pragma once
// The place of a body that is nearest to a point, in doubles.

#include "base/vec.h"
#include "proximity/partners.h"

namespace dsw {

/** A place on a body. */
template <int D>
struct BodyPlace {
  double distance = 0;  // less the radius of the body
  double scale = 1;     // a power of two that keeps squares from over- and underflow
  Vec way;              // to the place, without the radius, times the scale
  Partner<D> body{nullptr, 0, 0};
  Simplex part{Simplex::kVertex, kNone};  // a face, else an edge, else a vertex
};

/** A box that holds all that is so near a point; everything if the distance is infinite. */
template <int D>
Box<D> box_about(const double* point, double distance) noexcept;

/** Makes `place` the nearest place of the partner's body, if that is nearer to the point than `place` was; of equals the body
 * with the lower index counts, then the lower part. Reads boxes that are fresh, if the body keeps any. */
template <int D>
void find_nearest_place(const Partner<D>& partner, const double* point, BodyPlace<D>& place) noexcept;

}  // namespace dsw
