#pragma once
// The way of a body that turns: where its vertices come by, and what bounds the way between two places.

#include "body/body.h"
#include "body/box.h"
#include "predicates/turning_pair.h"
#include "response/rigid_move.h"

namespace dsw {

/** Keeps its memory from call to call. Throws std::bad_alloc. */
template <int D>
class RigidWay {
 public:
  static constexpr uint32_t kMostPieces = 32;
  static constexpr double kLeastStep = 0x1p-53;

  explicit RigidWay(const Memory* memory) : origins_(memory), places_(memory), radii_(memory) {}

  /** Takes where the vertices are as the begin of the motion. */
  void start(const Body<D>& body, const RigidMove<D>& motion);

  /** The way of points that begin at origin(), from time 0 to 1. */
  const TurningWay& exact() const noexcept { return way_; }
  const double* origin(uint32_t vertex) const noexcept { return origins_.data() + D * size_t{vertex}; }
  /** In how many pieces the way is looked at. */
  uint32_t pieces() const noexcept { return pieces_; }
  /** Where a vertex is at the begin of a piece, or at the end of the last one. Rounded. */
  const double* place(uint32_t piece, uint32_t vertex) const noexcept {
    return places_.data() + D * (size_t{piece} * radii_.size() + vertex);
  }
  /** A box around the ways of some vertices in a piece, and of all of them. */
  Box<D> box(uint32_t piece, const uint32_t* vertices, uint32_t count) const noexcept;
  const Box<D>& box(uint32_t piece) const noexcept { return boxes_[piece]; }
  /** A box around the ways of all vertices in all pieces. */
  const Box<D>& box() const noexcept { return whole_; }
  /** How far at most a vertex is beside the straight way between its places at both ends of a piece. */
  double room(uint32_t vertex) const noexcept { return room_of(radii_[vertex]); }
  /** How far at most any vertex is beside the straight way between two places whose fractions differ by this. */
  double sagitta(double step) const noexcept { return 0.125 * bend_ * radius_ * step * step; }
  /** The share of the motion in which no vertex goes further than one unit in the last place. */
  double least_step() const noexcept { return least_step_; }
  /** Whether neighbouring doubles of the motion can be further apart than that. */
  bool is_coarse() const noexcept { return least_step_ == kLeastStep; }
  /** One unit in the last place of the largest coordinate on the way. */
  double unit() const noexcept { return unit_; }
  /** The largest coordinate on the way. */
  double largest() const noexcept { return largest_; }
  bool turns() const noexcept { return bend_ > 0; }
  /** A unit vector: beside straight ways points are across it alone. Zero if nothing turns. */
  const Vec& axis() const noexcept { return axis_; }

 private:
  void find_places(const Body<D>& body, const RigidMove<D>& motion);
  double room_of(double radius) const noexcept;

  TurningWay way_;
  Array<double> origins_;
  Array<double> places_;
  Array<double> radii_;  // from the axis, by vertex
  uint32_t pieces_ = kMostPieces;
  Box<D> boxes_[kMostPieces], whole_;
  Vec axis_ = Vec::Zero();
  double bend_ = 0;  // of the way of a point at distance 1 from the axis: its largest second derivative
  double radius_ = 0, largest_ = 0, unit_ = 0, least_step_ = 0;
};

}  // namespace dsw
