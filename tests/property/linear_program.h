// A linear program by the simplex method, small and dense: what is largest among points that rows allow.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

namespace dsw::oracle {

/// Finds y >= 0 with the largest sum of costs times y, where each row times y is at most its bound, which is not negative.
class LinearProgram {
 public:
  explicit LinearProgram(std::vector<double> costs) : costs_(std::move(costs)) {}

  void add_row(std::vector<double> row, double bound) {
    rows_.push_back(std::move(row));
    bounds_.push_back(bound);
  }
  std::vector<double> solve() {
    const size_t n = costs_.size(), m = rows_.size();
    std::vector<size_t> outside(n), inside(m);  // names of columns and rows
    for (size_t k = 0; k < n; ++k) outside[k] = k;
    for (size_t i = 0; i < m; ++i) inside[i] = n + i;
    for (size_t pivots = 0;; ++pivots) {
      if (pivots == 100 * (n + m)) throw std::runtime_error("the simplex method does not end");
      // The column with the largest cost enters. That may go round in circles, so after some pivots the
      // first column does, as in Bland's rule.
      const bool is_first = pivots > 2 * (n + m);
      size_t column = n;
      for (size_t k = 0; k < n; ++k) {
        if (costs_[k] <= kLeast) continue;
        if (column == n || (is_first ? outside[k] < outside[column] : costs_[k] > costs_[column])) column = k;
      }
      if (column == n) break;
      // Several rows may end the way at the same place. The row with the largest coefficient leaves, since a division by a small
      // coefficient loses all digits.
      size_t row = m;
      double least = std::numeric_limits<double>::infinity();
      for (size_t i = 0; i < m; ++i) {
        if (rows_[i][column] > kLeast) least = std::min(least, std::max(bounds_[i], 0.0) / rows_[i][column]);
      }
      for (size_t i = 0; i < m; ++i) {
        if (rows_[i][column] <= kLeast || bounds_[i] / rows_[i][column] > least + kSame) continue;
        if (row == m || rows_[i][column] > rows_[row][column]) row = i;
      }
      if (row == m) break;
      pivot(row, column);
      std::swap(inside[row], outside[column]);
    }
    std::vector<double> y(n, 0.0);
    for (size_t i = 0; i < m; ++i) {
      if (inside[i] < n) y[inside[i]] = bounds_[i];
    }
    return y;
  }

 private:
  static constexpr double kLeast = 1e-11, kSame = 1e-12;

  void pivot(size_t row, size_t column) {
    const double by = 1 / rows_[row][column];
    for (double& each : rows_[row]) each *= by;
    rows_[row][column] = by;
    bounds_[row] *= by;
    const auto take = [&](std::vector<double>& from, double& bound, double sign) {
      const double share = from[column];
      if (share == 0) return;
      from[column] = 0;
      for (size_t k = 0; k < from.size(); ++k) from[k] -= share * rows_[row][k];
      bound -= sign * share * bounds_[row];
    };
    for (size_t i = 0; i < rows_.size(); ++i) {
      if (i != row) take(rows_[i], bounds_[i], 1);
    }
    double gained = 0;
    take(costs_, gained, 1);
  }

  std::vector<double> costs_;
  std::vector<std::vector<double>> rows_;
  std::vector<double> bounds_;
};

}  // namespace dsw::oracle
