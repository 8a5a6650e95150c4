// Two convex features that touch, as reports tell of them, and what libccd says of their normal.
#pragma once

#include "cross_check/second_normal.h"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace dsw::test {

using Vec = std::array<double, 3>;
using Points = std::vector<Vec>;  // a vertex, an edge or a face

Vec to_vec(const double* x);
Vec along(const Vec& from, const double* direction, double distance);

/// How many touches of a kind libccd has a normal of, and how far it is from ours.
class Figures {
 public:
  /// `obstacle` may have four points in one plane. What lies behind them, against the normal, is made solid.
  void ask(const Points& body, const Points& obstacle, const Vec& point, const double* normal);
  /// A touch of two corners, or of a corner and an edge: any normal between many is right, and libccd is not asked.
  void leave_out() { ++not_asked_; }

  size_t count() const { return count_; }
  double share() const { return count_ == 0 ? 0 : static_cast<double>(degrees_.size()) / static_cast<double>(count_); }
  double quantile(double part) const;
  std::string text() const;

 private:
  size_t count_ = 0, parallel_ = 0, not_converged_ = 0, not_unique_ = 0, not_asked_ = 0;
  std::vector<double> degrees_;
};

}  // namespace dsw::test
