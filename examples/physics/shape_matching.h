// Shape matching (Mueller, Heidelberger, Teschner, Gross 2005), as [JCD10] 7.3 uses it: where the points would be if
// their shape had only turned and moved.
//
// Equation 1 asks for the rotation R and the translation T that minimise the sum of |omega_i (v_i - (R v0_i + T))|.
// We minimise the sum of the squares, since the paper solves it by the covariance matrix. So a point counts with the
// square of its omega, and with its mass at rest, as in the article above: the paper has no masses. R is the rotation
// part of the weighted covariance matrix A. The best T puts the weighted centre at rest on the weighted centre now;
// the plain centre that v_i is measured from cancels then.
#ifndef DARTSWEEP_PHYSICS_SHAPE_MATCHING_H
#define DARTSWEEP_PHYSICS_SHAPE_MATCHING_H

#include "points.h"

namespace physics {

// The rotation R of the polar decomposition A = R S with S symmetric: of all rotations the one nearest to A. Never a
// reflection: where the determinant of A is negative the direction that is stretched least is turned over, so S is
// then not positive definite. What A leaves open (flat, thin or empty shapes) is taken from `last`, so that a rod
// does not spin about itself from step to step. [JCD10] 7.3 finds R by Jacobi rotations: those diagonalise the square
// of S, A^T A, and R is A S^-1. Here Jacobi rotations diagonalise A itself (Eigen's JacobiSVD). R is the same, and
// exists also where S has no inverse: a sheet's has none.
Eigen::Matrix3d rotation_of(const Eigen::Matrix3d& a, const Eigen::Matrix3d& last);

// A shape at rest, by index of the points.
class ShapeMatching {
 public:
  // `omega` is that of inserted points in equation 1, 0 or more; original points have 1. At 0 inserted points follow
  // the shape and have no say in where it is. The larger omega is, the more a row of contacts pulls the shape towards
  // itself and turns it. `in_plane`: all third coordinates are 0 and stay so; R then turns about the third axis.
  explicit ShapeMatching(const Points& rest, double omega = 0.7, bool in_plane = false);

  // A response inserted a point at `share` of the edge from a to b (dsw_body_edit). Its place at rest is equation 2,
  // v0_added = r v0_a + (1 - r) v0_b with r = 1 - share: r is 1 at a. Its mass at rest is interpolated in the same way.
  void split(std::size_t a, std::size_t b, std::size_t added, double share);
  // It was removed again: the shape is what it was before.
  void merge(std::size_t gone);

  // Where between a and b a point lies at rest: 0 at a, 1 at b.
  double share_between(std::size_t a, std::size_t b, std::size_t point) const;

  // The goal of each point, R v0_i + T; free slots get zeros. O(points).
  void find_goals(const Positions& at, Positions* goals);

  // The rotation R of the last goals.
  const Eigen::Matrix3d& rotation() const { return rotation_; }
  // Radius of the shape at rest: the largest distance of an original point from their centre.
  double radius() const { return radius_; }
  const Vector3& rest(std::size_t i) const { return points_[i].rest; }
  double weight(std::size_t i) const { return points_[i].weight; }

 private:
  struct Point {
    Vector3 rest;
    double weight;  // in the sum of squares: mass at rest times omega^2; 0: free slot, or one that only follows
    double full;    // what it would be at omega 1; 0: free slot
  };

  std::vector<Point> points_;
  double omega_, radius_ = 0;
  bool in_plane_;
  Eigen::Matrix3d rotation_ = Eigen::Matrix3d::Identity();
};

}  // namespace physics

#endif
