// Symmetric positive definite matrices of a chain: blocks of 4 x 4, each block coupled with the next two.
//
// All costs are O(blocks). The inverse of such a matrix is full, but what a force does far away passes through two
// neighbouring blocks: `towards_first` and `towards_last` carry it on, block by block. Contacts are solved with these
// (rod_contacts.h).
#ifndef DARTSWEEP_ROD_CHAIN_MATRIX_H
#define DARTSWEEP_ROD_CHAIN_MATRIX_H

#include <Eigen/Dense>
#include <vector>

namespace physics {

using Block = Eigen::Matrix4d;
using BlockVector = std::vector<Eigen::Vector4d>;

// The lower half: block i and its two blocks below.
struct ChainMatrix {
  struct Column {
    Block diagonal, next, after;  // A(i, i), A(i + 1, i), A(i + 2, i)
  };
  std::vector<Column> columns;  // what leads over the last block is not read

  void set_zero(std::size_t blocks);
  BlockVector times(const BlockVector& x) const;
};

// x(i) = - near * x(i +- 1) - far * x(i +- 2), where no force acts on block i or beyond.
struct Transfer {
  Block near, far;
};

// Block Cholesky from the first block to the last, as L D L^T: Golub and Van Loan, Matrix Computations, 4.5.
class ChainFactor {
 public:
  // Pivots that rounding made too small are raised, so the factor of any finite matrix is finite.
  void factor(const ChainMatrix& matrix);
  // In place.
  void solve(BlockVector* x) const;

  // Forces on later blocks only.
  const std::vector<Transfer>& towards_first() const { return towards_first_; }
  // The blocks of the inverse next to its diagonal: Takahashi, Fagan and Chen 1973. A column of the result is Z(i,
  // i), Z(i + 1, i), Z(i + 2, i).
  void invert(ChainMatrix* inverse) const;

 private:
  std::vector<Block> inverse_pivot_;
  std::vector<Transfer> towards_first_;
  std::vector<ChainMatrix::Column> work_;
};

// Forces on earlier blocks only: the transfers of the matrix with its blocks in reverse order. `scratch` keeps its
// memory.
void find_transfers_towards_last(const ChainMatrix& matrix, ChainMatrix* scratch, ChainFactor* factor,
                                 std::vector<Transfer>* towards_last);

}  // namespace physics

#endif
