// A vessel of 200,000 tetrahedra and the line along which a catheter is pushed into it.
#ifndef DARTSWEEP_TESTS_BENCHMARK_VESSEL_CASE_H
#define DARTSWEEP_TESTS_BENCHMARK_VESSEL_CASE_H

#include "ours.h"

namespace dsw::bench {

/** Reads what read_mesh.py wrote; region 1 is the lumen. Throws. */
scenes::VolumeMesh read_vessel(const std::string& path);

/** A lattice of tetrahedra with a winding lumen. */
scenes::VolumeMesh make_vessel();

/** A polyline by its length. */
class Line {
 public:
  explicit Line(std::vector<std::array<double, 3>> points);
  double length() const { return at_.back(); }
  /** The point at a distance from the start. */
  std::array<double, 3> point(double distance) const;
  /** Unit direction there. */
  std::array<double, 3> direction(double distance) const;

 private:
  std::vector<std::array<double, 3>> points_;
  std::vector<double> at_;  // of each point
};

/** The mesh with its wall marked, and a centreline from the entry to the end. */
struct VesselCase {
  /** @param mesh_file of read_mesh.py, empty: a generated vessel. @param line_file of its centreline. */
  VesselCase(const std::string& mesh_file, const std::string& line_file);

  scenes::VolumeMesh mesh;
  World world;
  WallMesh walls;
  Line line;
};

}  // namespace dsw::bench

#endif
