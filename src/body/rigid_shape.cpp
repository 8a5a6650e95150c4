#include "body/rigid_shape.h"

#include <algorithm>

#include "base/dimensions.h"
#include "base/eigen.h"
#include "base/vec.h"
#include "body/body.h"

namespace dsw {

void normalise(double (&q)[4]) noexcept { Eigen::Map<Eigen::Quaterniond>(q).normalize(); }

template <int D>
void RigidMotion<D>::place(const double* from, double* to) const noexcept {
  const Vec axis = to_vec<3>(rotation), start = to_vec<D>(from), across = axis.cross(start - to_vec<D>(centre));
  // Added to where it was, unlike in q * x, so that no motion leaves it there to the bit.
  store<D>(start + (2 * (rotation[3] * across + axis.cross(across)) + to_vec<D>(translation)), to);
}

template <int D>
void RigidMotion<D>::centre_now(double* to) const noexcept {
  for (int k = 0; k < D; ++k) to[k] = centre[k] + translation[k];
}

template <int D>
void RigidMotion<D>::add(const double* turn, const double* shift) noexcept {
  if (!is_zero(to_vec<3>(turn))) {
    // Normalised each time, so that its length does not drift.
    const Eigen::Quaterniond all = (Eigen::Quaterniond(turn) * Eigen::Quaterniond(rotation)).normalized();
    std::copy_n(all.coeffs().data(), 4, rotation);
  }
  for (int k = 0; k < D; ++k) translation[k] += shift[k];
}

template <int D>
void RigidMotion<D>::add_about(const double* turn, const double* point, const double* shift) noexcept {
  RigidMotion about;
  std::copy_n(turn, 4, about.rotation);
  std::copy_n(point, D, about.centre);
  double was[D], is[D];
  centre_now(was);
  about.place(was, is);
  for (int k = 0; k < D; ++k) is[k] = (is[k] - was[k]) + shift[k];
  add(turn, is);
}

template <int D>
void keep_shape(Body<D>& body) {
  RigidShape<D>& shape = body.shape[0];
  const size_t count = body.vertices.size();
  bool fits = shape.rest.size() == D * count;
  for (uint32_t v = 0; fits && v < count; ++v) {
    double at[D];
    if (!body.has_vertex(v)) continue;
    shape.moved.place(rest_of(shape, v), at);
    fits = std::equal(at, at + D, body.position(v));
  }
  if (fits) return;
  shape.rest.resize(D * count);
  shape.moved = {};
  // The mean of all places, by parts that do not overflow.
  const double share = 1.0 / static_cast<double>(std::max<size_t>(body.vertex_slots.alive_count(), 1));
  for (uint32_t v = 0; v < count; ++v) {
    std::fill_n(&shape.rest[D * size_t{v}], D, 0.0);
    if (!body.has_vertex(v)) continue;
    std::copy_n(body.position(v), D, &shape.rest[D * size_t{v}]);
    for (int k = 0; k < D; ++k) shape.moved.centre[k] += share * body.position(v)[k];
  }
}

template struct RigidMotion<2>;
template struct RigidMotion<3>;
DSW_INSTANTIATE(keep_shape);

}  // namespace dsw
