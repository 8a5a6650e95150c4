// A wire as a body of the library and a rod, in a vessel of the benchmark.
#ifndef DARTSWEEP_TESTS_BENCHMARK_PHYSICS_WIRE_H
#define DARTSWEEP_TESTS_BENCHMARK_PHYSICS_WIRE_H

#include "vessel_case.h"

#include "rod/near_rows.h"
#include "rod/rod.h"

#include <optional>

namespace dsw::bench {

/** A straight rod that is laid along the centreline, so it presses on the walls of bends. Its end is pushed to and fro. */
class PhysicsWire {
 public:
  /** @param radius of the body. @param thickness up to which rows keep walls away. */
  PhysicsWire(const VesselCase& vessel, std::size_t edges, double length, double radius, double thickness);

  void find_rows() { physics::find_near_rows(scene_.get(), body_, near_, &rows_); }
  void solve(std::size_t step, double dt);
  /** Takes walls and wire to where they want to be, at once. */
  void deform(std::vector<double>& next);
  void accept(double dt);

  /** Whether every edge is free by other calls of the library, and thick ones keep their distance. */
  bool is_free();
  /** Whether rows press, or the last deformation met a wall. */
  bool touches() const { return rows_pressing_ > 0 || contacts_ > 0; }
  /** Whether something did not get where it wanted. */
  bool is_short() const { return outcome_ != DSW_DEFORM_DONE; }

 private:
  double radius_;
  physics::NearRowOptions near_;
  physics::Scene scene_;
  dsw_body_id body_{};
  std::optional<physics::Rod> rod_;
  physics::NearRows rows_;
  physics::Positions positions_;
  Eigen::Vector3d along_;  // unit, at the end that is pushed
  std::size_t rows_pressing_ = 0, contacts_ = 0;
  dsw_deform_outcome outcome_ = DSW_DEFORM_DONE;
};

}  // namespace dsw::bench

#endif
