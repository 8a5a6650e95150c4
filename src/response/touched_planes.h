#pragma once
// What touched walls allow of a rigid motion: the part of it that is nearest to the whole and goes into none of them.

#include "base/vec.h"
#include "body/body.h"

namespace dsw {

/** A small rigid motion about the middle of a body: its way, and its turn as twice the vector of a quaternion over its w. */
struct Twist {
  Vec shift = Vec::Zero(), turn = Vec::Zero();
};

/** The lower triangle of the tensor of inertia of a body's vertices about a point, for lengths in units of `size`, so that no square
 * overflows.
 * @param share of each vertex.
 * @param ball on the diagonal: vertices count as small balls, so a line has an inertia about itself. */
template <int D>
void find_inertia(const Body<D>& body, const Vec& centre, double size, double share, double ball,
                  double (&tensor)[3][3]) noexcept;

/** How vertices of equal mass resist a turn about their middle, for lengths in units of their size: the mean of
 * find_inertia. */
template <int D>
struct Inertia {
  Vec middle;
  double size;          // not 0
  double factor[3][3];  // the lower triangular factor of the mean tensor

  explicit Inertia(const Body<D>& body) noexcept;
};

/** Walls that a body has touched, each as a plane that a point of the body stays before. */
template <int D>
class TouchedPlanes {
 public:
  void clear() noexcept { count_ = 0; }
  bool empty() const noexcept { return count_ == 0; }
  /** Adds a plane. If there are too many, the oldest one goes first.
   * @param normal towards the side of the body, of length 1. */
  void add(const Vec& normal, const Vec& point) noexcept;
  /** Adds a plane that may go along.
   * @param at of the plane; `point`: of the body.
   * @param way of the plane while the body makes the motion that is asked for.
   * @param tilt by how much its normal turns on that way.
   * @param missing how far behind the plane the point is. The motion brings it back by so much, and no farther. */
  void add_moving(const Vec& normal, const Vec& at, const Vec& point, const Vec& way, double tilt,
                  double missing = 0) noexcept;
  /** The body has moved, and its points with it. */
  void follow(const RigidMotion<D>& made) noexcept;

  /** The part of a twist that the planes allow: among all small motions that enter no plane, finds the one that brings the vertices
   * nearest to where the wanted twist would. Planes are kept at a distance of `off`, and by as much more as points bend off their
   * ways. Planes that go along push. False: next to nothing is allowed. */
  bool allow(const Inertia<D>& inertia, const Twist& wanted, double off, Twist* allowed) const noexcept;

 private:
  static constexpr int kMost = 12;
  struct Plane {
    Vec normal, at, point;  // at: of the plane; point: of the body, where it is now
    Vec way = Vec::Zero();
    double tilt = 0, missing = 0;
    bool moves = false;
  };
  void make_room() noexcept;
  Plane planes_[kMost];
  int count_ = 0;
};

}  // namespace dsw
