// Bodies pressed into corners, wedges, channels and bends, where what a frictionless contact leaves is known.
#ifndef DARTSWEEP_TESTS_BENCHMARK_PRESSED_H
#define DARTSWEEP_TESTS_BENCHMARK_PRESSED_H

#include "scenes/mesh.h"
#include "scenes/random.h"

#include <Eigen/Core>

#include <functional>
#include <string>
#include <vector>

namespace dsw::bench {

using Point = Eigen::Vector3d;
using Points = std::vector<Point>;

/** What walls without friction leave of a way: so much, in a unit direction. */
struct Allowed {
  Point direction = Point::Zero();
  double length = 0;
};

/** Its walls are the boundary of the mesh. */
struct PressedScene {
  std::string name;
  scenes::VolumeMesh mesh;
  Points start;                      // of a vertex, or of a chain
  std::size_t steps = 0, first = 0;  // in all, and those that only press the body to where it is to be
  /** Where the vertices are to go in this step. */
  std::function<Points(std::size_t step, const Points& at, scenes::Random& random)> targets;
  /** What the walls leave of the way of a vertex that is pressed on them. Without this function: what the walls that
   * were met leave, as planes. */
  std::function<Allowed(const Point& from, const Point& to)> allowed;
};

/** The part of a way that goes into none of the walls, nearest to the way. @param normals out of the walls */
Allowed allowed_by(const Points& normals, const Point& way);

/** @param way that is asked of a vertex in a step; edges of walls are 0.25 to 0.3 long. */
std::vector<PressedScene> pressed_scenes(double way);

}  // namespace dsw::bench

#endif
