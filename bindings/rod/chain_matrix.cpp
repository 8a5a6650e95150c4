#include "chain_matrix.h"

#include <algorithm>
#include <cmath>

namespace physics {
namespace {

constexpr double kLeastPivot = 1e-16;  // share of the trace

// The inverse of the Cholesky factor.
Block inverse_factor(const Block& a) {
  const double least = kLeastPivot * a.trace() + 1e-300;
  Block inverse = Block::Zero(), lower = Block::Zero();
  for (int j = 0; j < 4; ++j) {
    double pivot = a(j, j);
    for (int k = 0; k < j; ++k) {
      pivot -= lower(j, k) * lower(j, k);
    }
    const double reciprocal = 1 / std::sqrt(std::max(pivot, least));
    for (int i = j + 1; i < 4; ++i) {
      double sum = a(i, j);
      for (int k = 0; k < j; ++k) {
        sum -= lower(i, k) * lower(j, k);
      }
      lower(i, j) = sum * reciprocal;
    }
    inverse(j, j) = reciprocal;
    for (int k = 0; k < j; ++k) {
      double sum = 0;
      for (int l = k; l < j; ++l) {
        sum += lower(j, l) * inverse(l, k);
      }
      inverse(j, k) = -sum * reciprocal;
    }
  }
  return inverse;
}

}  // namespace

void ChainMatrix::set_zero(std::size_t blocks) {
  columns.assign(blocks, {Block::Zero(), Block::Zero(), Block::Zero()});
}

BlockVector ChainMatrix::times(const BlockVector& x) const {
  BlockVector sum(x.size(), Eigen::Vector4d::Zero());
  for (std::size_t i = 0; i < x.size(); ++i) {
    sum[i] += columns[i].diagonal * x[i];
    if (i + 1 < x.size()) {
      sum[i + 1] += columns[i].next * x[i];
      sum[i] += columns[i].next.transpose() * x[i + 1];
    }
    if (i + 2 < x.size()) {
      sum[i + 2] += columns[i].after * x[i];
      sum[i] += columns[i].after.transpose() * x[i + 2];
    }
  }
  return sum;
}

void ChainFactor::factor(const ChainMatrix& matrix) {
  const std::size_t count = matrix.columns.size();
  work_ = matrix.columns;
  inverse_pivot_.resize(count);
  towards_first_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Block inverse = inverse_factor(work_[i].diagonal);
    inverse_pivot_[i].noalias() = inverse.transpose() * inverse;
    towards_first_[i] = {Block::Zero(), Block::Zero()};
    if (i + 1 == count) {
      break;
    }
    // D - X^T X rounds less than D - A D^-1 A^T.
    Block next, after;
    next.noalias() = inverse * work_[i].next.transpose();
    work_[i + 1].diagonal.noalias() -= next.transpose() * next;
    towards_first_[i].near.noalias() = inverse.transpose() * next;
    if (i + 2 < count) {
      after.noalias() = inverse * work_[i].after.transpose();
      work_[i + 1].next.noalias() -= after.transpose() * next;
      work_[i + 2].diagonal.noalias() -= after.transpose() * after;
      towards_first_[i].far.noalias() = inverse.transpose() * after;
    }
  }
}

void ChainFactor::solve(BlockVector* x) const {
  const std::size_t count = x->size();
  for (std::size_t i = 0; i < count; ++i) {
    if (i + 1 < count) {
      (*x)[i + 1].noalias() -= towards_first_[i].near.transpose() * (*x)[i];
    }
    if (i + 2 < count) {
      (*x)[i + 2].noalias() -= towards_first_[i].far.transpose() * (*x)[i];
    }
  }
  for (std::size_t i = count; i-- > 0;) {
    Eigen::Vector4d sum = inverse_pivot_[i] * (*x)[i];
    if (i + 1 < count) {
      sum.noalias() -= towards_first_[i].near * (*x)[i + 1];
    }
    if (i + 2 < count) {
      sum.noalias() -= towards_first_[i].far * (*x)[i + 2];
    }
    (*x)[i] = sum;
  }
}

void ChainFactor::invert(ChainMatrix* inverse) const {
  const std::size_t count = inverse_pivot_.size();
  std::vector<ChainMatrix::Column>& z = inverse->columns;
  z.resize(count);
  for (std::size_t i = count; i-- > 0;) {
    z[i].diagonal = inverse_pivot_[i];
    const Transfer& t = towards_first_[i];
    if (i + 1 < count) {
      z[i].next.noalias() = -(z[i + 1].diagonal * t.near.transpose());
      if (i + 2 < count) {
        z[i].next.noalias() -= z[i + 1].next.transpose() * t.far.transpose();
        z[i].after.noalias() = -(z[i + 1].next * t.near.transpose());
        z[i].after.noalias() -= z[i + 2].diagonal * t.far.transpose();
        z[i].diagonal.noalias() -= t.far * z[i].after;
      }
      z[i].diagonal.noalias() -= t.near * z[i].next;
    }
    // Rounding that is not symmetric would double with each block.
    z[i].diagonal = (0.5 * (z[i].diagonal + z[i].diagonal.transpose())).eval();
  }
}

void find_transfers_towards_last(const ChainMatrix& matrix, ChainMatrix* scratch, ChainFactor* factor,
                                 std::vector<Transfer>* towards_last) {
  const std::size_t count = matrix.columns.size();
  scratch->columns.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    ChainMatrix::Column& to = scratch->columns[count - 1 - i];
    to.diagonal = matrix.columns[i].diagonal;
    if (i >= 1) {
      to.next = matrix.columns[i - 1].next.transpose();
    }
    if (i >= 2) {
      to.after = matrix.columns[i - 2].after.transpose();
    }
  }
  factor->factor(*scratch);
  towards_last->assign(factor->towards_first().rbegin(), factor->towards_first().rend());
}

}  // namespace physics
