#include "rod/chain_matrix.h"

#include <gtest/gtest.h>

#include "rods.h"

namespace physics {
namespace {

Eigen::MatrixXd dense(const ChainMatrix& chain) {
  const auto blocks = static_cast<Eigen::Index>(chain.columns.size());
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(4 * blocks, 4 * blocks);
  for (Eigen::Index i = 0; i < blocks; ++i) {
    const ChainMatrix::Column& column = chain.columns[static_cast<std::size_t>(i)];
    const Block* below[] = {&column.diagonal, &column.next, &column.after};
    for (Eigen::Index k = 0; k < 3 && i + k < blocks; ++k) {
      full.block<4, 4>(4 * (i + k), 4 * i) = *below[k];
      full.block<4, 4>(4 * i, 4 * (i + k)) = below[k]->transpose();
    }
  }
  return full;
}

ChainMatrix random_chain(std::size_t blocks) {
  std::srand(5);
  ChainMatrix chain;
  chain.set_zero(blocks);
  for (std::size_t i = 0; i < blocks; ++i) {  // sums of squares over three blocks, and a little more
    const Eigen::Matrix<double, 4, 3> g[3] = {Eigen::Matrix<double, 4, 3>::Random(),
                                              Eigen::Matrix<double, 4, 3>::Random(),
                                              Eigen::Matrix<double, 4, 3>::Random()};
    for (std::size_t a = 0; a < 3 && i + a < blocks; ++a) {
      chain.columns[i + a].diagonal += g[a] * g[a].transpose() + 0.1 * Block::Identity();
      if (a < 2 && i + a + 1 < blocks) {
        chain.columns[i + a].next += g[a + 1] * g[a].transpose();
      }
    }
    chain.columns[i].after += g[2] * g[0].transpose();
  }
  return chain;
}

TEST(ChainMatrix, SolvesAndInvertsAsAFullMatrixDoes) {
  for (const std::size_t blocks : {1u, 2u, 3u, 12u}) {
    const ChainMatrix chain = random_chain(blocks);
    const Eigen::MatrixXd full = dense(chain), inverse = full.inverse();
    ChainFactor factor;
    factor.factor(chain);
    BlockVector x(blocks);
    for (Eigen::Vector4d& block : x) {
      block.setRandom();
    }
    const BlockVector product = chain.times(x);
    BlockVector solved = product;
    factor.solve(&solved);
    ChainMatrix near;
    factor.invert(&near);
    for (std::size_t i = 0; i < blocks; ++i) {
      const auto at = static_cast<Eigen::Index>(4 * i);
      EXPECT_LT((solved[i] - x[i]).norm(), 1e-10);
      EXPECT_LT((near.columns[i].diagonal - inverse.block<4, 4>(at, at)).norm(), 1e-10);
      if (i + 1 < blocks) {
        EXPECT_LT((near.columns[i].next - inverse.block<4, 4>(at + 4, at)).norm(), 1e-10);
      }
      if (i + 2 < blocks) {
        EXPECT_LT((near.columns[i].after - inverse.block<4, 4>(at + 8, at)).norm(), 1e-10);
      }
    }
    const Eigen::Map<const Eigen::VectorXd> flat(x.front().data(), static_cast<Eigen::Index>(4 * blocks));
    const Eigen::Map<const Eigen::VectorXd> flat_product(product.front().data(), static_cast<Eigen::Index>(4 * blocks));
    EXPECT_LT((full * flat - flat_product).norm(), 1e-10);
  }
}

// What a force does far away passes through two neighbouring blocks.
TEST(ChainMatrix, TransfersCarryMotionOn) {
  constexpr std::size_t kBlocks = 12, kForce = 5;
  const ChainMatrix chain = random_chain(kBlocks);
  ChainFactor factor, backward;
  ChainMatrix scratch;
  std::vector<Transfer> towards_last;
  factor.factor(chain);
  find_transfers_towards_last(chain, &scratch, &backward, &towards_last);
  BlockVector x(kBlocks, Eigen::Vector4d::Zero());
  x[kForce].setRandom();
  factor.solve(&x);
  for (std::size_t i = kForce + 1; i < kBlocks; ++i) {
    EXPECT_LT((x[i] + towards_last[i].near * x[i - 1] + towards_last[i].far * x[i - 2]).norm(), 1e-10);
  }
  for (std::size_t i = 0; i < kForce; ++i) {
    const Transfer& transfer = factor.towards_first()[i];
    EXPECT_LT((x[i] + transfer.near * x[i + 1] + transfer.far * x[i + 2]).norm(), 1e-10);
  }
}

// The matrix of a stiff rod: its transfers extrapolate, so rounding must not grow along the chain.
TEST(ChainMatrix, TheInverseOfALongStiffRodKeepsItsDigits) {
  constexpr double kStep = 1e-3;
  const Rod rod = straight_rod(300, 1);
  ChainMatrix chain = rod.stiffness();
  for (ChainMatrix::Column& column : chain.columns) {
    column.diagonal = kStep * kStep * column.diagonal + Block::Identity();
    column.next *= kStep * kStep;
    column.after *= kStep * kStep;
  }
  ChainFactor factor;
  factor.factor(chain);
  ChainMatrix near;
  factor.invert(&near);
  for (std::size_t i = 0; i < rod.size(); i += 50) {
    for (int d = 0; d < 4; ++d) {
      BlockVector x(rod.size(), Eigen::Vector4d::Zero());
      x[i][d] = 1;
      factor.solve(&x);
      EXPECT_LT((near.columns[i].diagonal.col(d) - x[i]).norm(), 1e-8 * x[i].norm()) << i << ' ' << d;
    }
  }
}

}  // namespace
}  // namespace physics
