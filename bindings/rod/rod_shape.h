// The discrete elastic rod: where it is, and how much each vertex is bent and twisted. Bergou, Wardetzky, Robinson,
// Audoly and Grinspun 2008; Bergou, Audoly, Vouga, Wardetzky and Grinspun 2010.
#ifndef DARTSWEEP_ROD_ROD_SHAPE_H
#define DARTSWEEP_ROD_ROD_SHAPE_H

#include "chain_matrix.h"
#include "positions.h"

namespace physics {

using Vector2 = Eigen::Vector2d;

// Edge i joins vertices i and i + 1.
struct RodShape {
  Positions position;
  Positions director;         // by edge: unit, across it; it turns with the material
  std::vector<double> twist;  // by vertex: how much the director turns there, all turns counted; the ends have 0

  // Found by `find_edges`.
  Positions tangent;           // by edge, unit
  std::vector<double> length;  // by edge

  void find_edges();
  // Moves vertices to `to` and turns each director by `turn` about its edge. The director follows its edge without
  // twist.
  void advance(const Positions& to, const std::vector<double>& turn);
};

// Turns `vector` as the smallest rotation turns the unit vector `from` into `to`. Opposite directions: the vector
// stays.
Vector3 transported(const Vector3& vector, const Vector3& from, const Vector3& to);

// Bending at an inner vertex, and the gradient of its three numbers.
struct RodBend {
  Vector2 curvature =
      Vector2::Zero();  // about the two material axes, integrated over the vertex: 2 tan(angle / 2) for an angle
  double twist = 0;
  // By the blocks of the vertex before, this one and the next: rows are the position and the angle of the edge behind
  // it. Columns are the two curvatures and the twist.
  Eigen::Matrix<double, 4, 3> gradient[3];
};

// At the vertex between edges `vertex` - 1 and `vertex`. Sharper folds than about 160 degrees count as such a fold.
RodBend bend_of(const RodShape& shape, std::size_t vertex);

}  // namespace physics

#endif
