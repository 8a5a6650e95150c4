// Rods that step together: each with walls, and with places where a rod is near another rod or near itself.
//
// A row between two rods gets an impulse, and the other rod the opposite one. Sweeps along each rod (rod_contacts.h)
// take turns with sweeps over these rows, for which their full compliance is formed: O(rows^2), once in a step.
#ifndef DARTSWEEP_ROD_ROD_SYSTEM_H
#define DARTSWEEP_ROD_ROD_SYSTEM_H

#include "rod.h"

namespace physics {

class RodSystem {
 public:
  std::vector<Rod> rods;

  // Velocities of the next time step, from `predict` of all rods on. `rows` are by rod; a row names its other rod.
  // Their impulses are those of the contacts of the rod that has the row: which a row starts from.
  // Between two rods friction is the geometric mean. Sweeps end when the strictest of the rods' options is met.
  RodContactReport finish(double dt, const std::vector<NearRows>& rows);

 private:
  struct Side {
    std::uint32_t rod;
    std::uint32_t vertices[2];
    double weight[2];  // with a sign: minus at the obstacle
    double push[2];    // of impulses: 0 at held vertices
  };
  struct Row : RowState {
    std::uint32_t owner, number;
    double friction;
    Side sides[2];
    std::vector<std::uint32_t> rods;    // one or two
    std::vector<BlockVector> response;  // by these rods, then by direction of the frame
  };

  Side side_of(std::uint32_t rod, const std::uint32_t* vertices, const double* weights, std::uint32_t count,
               double sign) const;
  void prepare(double dt, const std::vector<NearRows>& rows);
  void couple();
  double sweep();
  Vector3 velocity_of(const Row& row, const std::vector<BlockVector>& velocity) const;

  std::vector<Row> rows_;
  std::vector<BlockVector> base_;            // by rod: velocities without the impulses of walls
  std::vector<Eigen::Matrix3d> compliance_;  // of rows with rows: in frames
  std::vector<Vector3> slip_;                // by row
};

}  // namespace physics

#endif
