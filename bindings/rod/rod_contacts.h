// Unilateral constraints with Coulomb friction on the compliance of a rod: Lenoir, Cotin, Duriez and Neumann 2006.
//
// The rows see the exact compliance J A^-1 J^T, but nobody forms this full matrix. Block Gauss-Seidel sweeps run
// along the chain and back. A sweep carries the motion that the impulses behind it cause to the next block, so a
// sweep is O(blocks + rows).
#ifndef DARTSWEEP_ROD_ROD_CONTACTS_H
#define DARTSWEEP_ROD_ROD_CONTACTS_H

#include "chain_matrix.h"
#include "near_row.h"
#include "rod_row.h"

namespace physics {

struct RodContactOptions {
  double friction = 0.04;
  double recovery = 0.2;  // share of a negative gap that a step takes back
  int most_sweeps = 40;   // in both directions together
  double tolerance = 0;   // length: sweeps end when no row moves by more in a sweep
  // Sweeps, an even number, from one direct solution of the rows that press to the next, twice as many each time that
  // it did not help. 0: there is none.
  int together = 0;
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
  // the impulses of their `previous`, or, if they are solved `again` in one step, from their own. Rows at other rods
  // are left to rod_system.h.
  RodContactReport solve(const NearRows& rows, const ChainMatrix& matrix, const ChainFactor& factor,
                         const std::vector<char>& held, const BlockVector& velocity, double dt, bool again,
                         const RodContactOptions& options);

  // What `solve` does, in parts. `rows`, `matrix` and `factor` have to stay until `end`.
  void begin(const NearRows& rows, const ChainMatrix& matrix, const ChainFactor& factor, const std::vector<char>& held,
             const BlockVector& velocity, double dt, bool again, const RodContactOptions& options);
  // Sweep number `sweep`. Returns the largest change of a row's velocity.
  double sweep(int sweep, const BlockVector& velocity, const RodContactOptions& options);
  // Returns how many rows have an impulse.
  std::size_t end();
  bool has_rows() const { return !rows_.empty(); }
  // Adds J^T impulses.
  void add_impulses(BlockVector* sum) const;
  // By row, what the rod got.
  const Positions& impulses() const { return impulses_; }
  Positions& impulses() { return impulses_; }
  // The next `solve` sees the rows of the next step, `previous` refers to those of this one.
  void end_step() { last_impulses_ = impulses_; }

 private:
  enum Grip { kLoose, kSlides, kSticks };
  struct Row : RowState {
    std::uint32_t number, pair;  // in the list; between vertices `pair` and `pair` + 1
    double weight[2];            // of velocities
    double push[2];              // of impulses: 0 at held vertices
    Grip grip;                   // for the direct solution
    double spring;               // there: impulse over velocity
    Eigen::Matrix<double, 8, 3> response;

    void add_push(const Vector3& impulse_in_space, BlockVector* sum) const;
    // How it is taken along, in its frame, by a motion in which nothing that is held moves.
    Vector3 taken(const BlockVector& motion) const;
    // The part of a vector that its grip is about.
    Vector3 gripped(const Vector3& in_frame) const;
  };

  void start(const NearRows& rows, bool again);
  void prepare(const NearRows& rows, const std::vector<char>& held, double dt, const RodContactOptions& options);
  double visit_pair(std::size_t pair, const BlockVector& velocity, double friction, bool changes);
  double sweep_to_last(const BlockVector& velocity, double friction);
  double sweep_to_first(const BlockVector& velocity, double friction, bool changes);
  void carry_impulses(const BlockVector& velocity);
  void solve_pressing(const Positions& off, Positions* change, BlockVector* moved);
  Positions slips(const BlockVector& velocity) const;
  bool press(const BlockVector& velocity, const RodContactOptions& options, bool sticking);
  void press_together(const BlockVector& velocity, const RodContactOptions& options);

  std::vector<Row> rows_;             // by pair
  std::vector<std::uint32_t> first_;  // of each pair
  Positions impulses_, last_impulses_;
  ChainMatrix inverse_, scratch_;
  ChainFactor backward_, penalised_;
  const ChainMatrix* matrix_ = nullptr;
  double dt_ = 1;
  bool slides_ = false;                    // the direct solution leaves friction as it is, in this step
  int next_together_ = 0, wait_ = 0;       // sweeps: the next direct solution, and from the last one to it
  double change_ = 0, change_before_ = 0;  // of the last sweep, and of that before the last direct solution
  const ChainFactor* forward_ = nullptr;
  std::vector<Transfer> towards_last_;
  // The motion of each pair that is caused by impulses on earlier pairs, on later pairs, and on the pair itself.
  using Vector8 = Eigen::Matrix<double, 8, 1>;
  std::vector<Vector8> from_first_, from_last_, own_;
};

}  // namespace physics

#endif
