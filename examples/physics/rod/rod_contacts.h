// Unilateral constraints with Coulomb friction on the compliance of a rod: Lenoir, Cotin, Duriez and Neumann 2006.
//
// The rows see the exact compliance J A^-1 J^T, but nobody forms this full matrix. Block Gauss-Seidel sweeps run
// along the chain and back. A sweep carries the motion that the impulses behind it cause to the next block, so a
// sweep is O(blocks + rows).
#ifndef DARTSWEEP_PHYSICS_ROD_ROD_CONTACTS_H
#define DARTSWEEP_PHYSICS_ROD_ROD_CONTACTS_H

#include "chain_matrix.h"
#include "near_row.h"

namespace physics {

struct RodContactOptions {
  double friction = 0.04;
  double recovery = 0.2;  // share of a negative gap that a step takes back
  int most_sweeps = 40;   // in both directions together
  double tolerance = 0;   // length: sweeps end when no row moves by more in a sweep
};

struct RodContactReport {
  int sweeps = 0;
  double last_change = 0;    // length: the largest motion of a row in the last sweep
  std::size_t pressing = 0;  // rows with an impulse
};

class RodContacts {
 public:
  // Finds impulses for which `velocity` + A^-1 J^T impulses keeps every row: no gap becomes negative in a time step,
  // and friction stays in its cone and brakes as much as it can. `held` vertices take no impulse. The rows start from
  // the impulses of their `previous`, or, if they are solved `again` in one step, from their own.
  RodContactReport solve(const NearRows& rows, const ChainMatrix& matrix, const ChainFactor& factor,
                         const std::vector<char>& held, const BlockVector& velocity, double dt, bool again,
                         const RodContactOptions& options);
  // Adds J^T impulses.
  void add_impulses(BlockVector* sum) const;
  // By row, what the rod got.
  const Positions& impulses() const { return impulses_; }
  // The next `solve` sees the rows of the next step, `previous` refers to those of this one.
  void end_step() { last_impulses_ = impulses_; }

 private:
  struct Row {
    std::uint32_t number, pair;  // in the list; between vertices `pair` and `pair` + 1
    double weight[2];            // of velocities
    double push[2];              // of impulses: 0 at held vertices
    Eigen::Matrix3d frame;       // normal, and two directions along the obstacle that friction does not couple
    Eigen::Matrix3d compliance;  // in this frame
    Eigen::Matrix<double, 8, 3> response;
    Vector3 wanted;   // velocity in the frame: the least one along the normal, that of the obstacle across
    Vector3 impulse;  // in the frame
  };

  void start(const NearRows& rows, bool again);
  void prepare(const NearRows& rows, const std::vector<char>& held, double dt, const RodContactOptions& options);
  double update(double friction, const Vector3& velocity, Row* row) const;
  double visit_pair(std::size_t pair, const BlockVector& velocity, double friction, bool changes);
  double sweep_to_last(const BlockVector& velocity, double friction);
  double sweep_to_first(const BlockVector& velocity, double friction, bool changes);

  std::vector<Row> rows_;             // by pair
  std::vector<std::uint32_t> first_;  // of each pair
  Positions impulses_, last_impulses_;
  ChainMatrix inverse_, scratch_;
  ChainFactor backward_;
  const ChainFactor* forward_ = nullptr;
  std::vector<Transfer> towards_last_;
  // The motion of each pair that is caused by impulses on earlier pairs, on later pairs, and on the pair itself.
  using Vector8 = Eigen::Matrix<double, 8, 1>;
  std::vector<Vector8> from_first_, from_last_, own_;
};

}  // namespace physics

#endif
