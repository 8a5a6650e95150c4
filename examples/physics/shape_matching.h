// Shape matching (Mueller, Heidelberger, Teschner, Gross 2005): where the points would be if their shape had only turned and moved.
#ifndef DARTSWEEP_PHYSICS_SHAPE_MATCHING_H
#define DARTSWEEP_PHYSICS_SHAPE_MATCHING_H

#include "points.h"

namespace physics {

// The rotation R of the polar decomposition A = R S with S symmetric: of all rotations the one nearest to A. Never a reflection: where the
// determinant of A is negative the direction that is stretched least is turned over, so S is then not positive definite. What A leaves
// open (flat, thin or empty shapes) is taken from `last`, so that a rod does not spin about itself from step to step.
Eigen::Matrix3d rotation_of(const Eigen::Matrix3d& a, const Eigen::Matrix3d& last);

// A shape at rest, by index of the points.
class ShapeMatching {
 public:
  // `omega` is the weight of inserted points, relative to that of their neighbours, in [0, 1]: at 0 they follow the shape and have
  // no say in where it is, at 1 a row of contacts pulls the shape towards itself.
  explicit ShapeMatching(const Points& rest, double omega = 0.1);

  // A response inserted a point: its place at rest is (1 - share) of a's and share of b's, as in [JCD10] equation 2; its weight is
  // omega times what the same interpolation of the original weights gives.
  void split(std::size_t a, std::size_t b, std::size_t added, double share);
  // It was removed again: the shape is what it was before.
  void merge(std::size_t gone);

  // The goal of each point; free slots get zeros. O(points).
  void find_goals(const Positions& at, Positions* goals);

  const Eigen::Matrix3d& rotation() const { return rotation_; }
  const Vector3& rest(std::size_t i) const { return points_[i].rest; }
  double weight(std::size_t i) const { return points_[i].weight; }

 private:
  struct Point {
    Vector3 rest;
    double weight;  // 0: free slot, or one that only follows
    double full;    // what it would be at omega 1; 0: free slot
  };

  std::vector<Point> points_;
  double omega_;
  Eigen::Matrix3d rotation_ = Eigen::Matrix3d::Identity();
};

}  // namespace physics

#endif
