#include "response/rigid_way.h"

#include <algorithm>
#include <cmath>

#include "base/vec.h"
#include "walk/retreat.h"

namespace dsw {

// Let h be half the angle of the whole turn, so the quaternion goes from 1 to (sin h) a + cos h with cos h >= 0. At time s its
// square is n(s) >= (1 + cos h) / 2, and it turns by the angular velocity w(s) = 2 sin h / n(s). n' is at most 2 (1 - cos h),
// so w' is at most 4 sin h (1 - cos h) / n^2. A point at distance 1 from the axis has a second derivative of w^2 + w' at most, and
// beside a chord of length t in time its way bends by 1/8 of that times t^2.
template <int D>
void RigidWay<D>::start(const Body<D>& body, const RigidMove<D>& motion) {
  way_ = motion.way();
  const double* const q = way_.turn[1];
  const double sine = std::sqrt((q[0] * q[0] + q[1] * q[1]) + q[2] * q[2]), least = 0.5 * (1 + q[3]);
  const double speed = 2 * sine / least, change = 4 * sine * (1 - q[3]) / (least * least);
  axis_ = sine > 0 ? Vec(Vec(q[0], q[1], q[2]) / sine) : Vec(Vec::Zero());
  bend_ = (speed * speed + change) * (1 + 0x1p-20);
  // Beside its chord a piece bends by 1/64 of the radius at most.
  pieces_ = 4;
  while (pieces_ < kMostPieces && 8 * bend_ > pieces_ * pieces_) pieces_ *= 2;
  const auto count = static_cast<uint32_t>(body.vertices.size());
  radii_.assign(count, 0);
  origins_.assign(size_t{D} * count, 0);
  radius_ = 0;
  for (uint32_t v = 0; v < count; ++v) {
    if (!body.has_vertex(v)) continue;
    std::copy_n(body.position(v), D, origins_.data() + D * size_t{v});
    const Vec across = axis_.cross(to_vec<D>(body.position(v)) - to_vec<D>(way_.centre));
    radii_[v] = std::sqrt(dot(across, across)) * (1 + 0x1p-20);
    radius_ = std::max(radius_, radii_[v]);
  }
  find_places(body, motion);
  double length = 0;
  for (int k = 0; k < D; ++k) length += std::fabs(way_.place[1][k] - way_.place[0][k]);
  length += speed * radius_;
  unit_ = std::nextafter(largest_, 2 * largest_ + 1) - largest_;
  least_step_ = length > 0 ? std::clamp(unit_ / length, kLeastStep, 1.0) : 1;
}

/** Finds places and boxes of the pieces. */
template <int D>
void RigidWay<D>::find_places(const Body<D>& body, const RigidMove<D>& motion) {
  const auto count = static_cast<uint32_t>(radii_.size());
  places_.assign(size_t{D} * count * (pieces_ + 1), 0);
  largest_ = 0;
  Box<D> at[kMostPieces + 1];
  for (uint32_t piece = 0; piece <= pieces_; ++piece) {
    const RigidMotion<D> part = motion.part(static_cast<double>(piece) / pieces_);
    for (uint32_t v = 0; v < count; ++v) {
      if (!body.has_vertex(v)) continue;
      double* const to = places_.data() + D * (size_t{piece} * count + v);
      part.place(origin(v), to);
      at[piece].add(to);
    }
    if (at[piece].empty()) continue;
    largest_ = std::max({largest_, largest_coordinate<D>(at[piece].lower), largest_coordinate<D>(at[piece].upper)});
  }
  whole_ = Box<D>();
  for (uint32_t piece = 0; piece < pieces_; ++piece) {
    boxes_[piece] = at[piece];
    boxes_[piece].add(at[piece + 1]);
    boxes_[piece] = widened(boxes_[piece], room_of(radius_));
    whole_.add(boxes_[piece]);
  }
}

template <int D>
double RigidWay<D>::room_of(double radius) const noexcept {
  const double step = 1.0 / pieces_;
  return 0.125 * bend_ * radius * step * step + 0x1p-40 * largest_;
}

template <int D>
Box<D> RigidWay<D>::box(uint32_t piece, const uint32_t* vertices, uint32_t count) const noexcept {
  Box<D> box;
  double radius = 0;
  for (uint32_t i = 0; i < count; ++i) {
    box.add(place(piece, vertices[i]));
    box.add(place(piece + 1, vertices[i]));
    radius = std::max(radius, radii_[vertices[i]]);
  }
  return widened(box, room_of(radius));
}

template class RigidWay<2>;
template class RigidWay<3>;

}  // namespace dsw
