#include "route.h"

#include <algorithm>

namespace physics {
namespace {

constexpr int kRounds = 200;

bool is_free(const dsw_environment* environment, dsw_volume_id hint, const Vector3& a, const Vector3& b) {
  dsw_flight flight;
  check(dsw_environment_cast(environment, hint, a.data(), b.data(), nullptr, &flight), "casting along a route");
  return flight.outcome == DSW_OUTCOME_REACHED;
}

}  // namespace

Route::Route(const dsw_environment* environment, const demo_flow& flow) {
  if (flow.path_count < 2) {
    throw std::invalid_argument("the mesh has no lumen that leads anywhere");
  }
  for (std::size_t i = 0; i < flow.path_count; ++i) {
    line_.emplace_back(Eigen::Map<const Vector3>(flow.centre + 3 * std::size_t{flow.path[i]}));
  }
  smooth(environment, flow);
  from_inlet_.push_back(0);
  for (std::size_t i = 1; i < line_.size(); ++i) {
    from_inlet_.push_back(from_inlet_.back() + (line_[i] - line_[i - 1]).norm());
  }
}

// Middles of volumes zigzag. A point moves to the mean of itself and its neighbours only where both pieces at it stay free.
void Route::smooth(const dsw_environment* environment, const demo_flow& flow) {
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t i = 1; i + 1 < line_.size(); ++i) {
      const Vector3 mean = 0.25 * line_[i - 1] + 0.5 * line_[i] + 0.25 * line_[i + 1];
      const dsw_volume_id hint = flow.volumes[flow.path[i]];
      if (is_free(environment, hint, mean, line_[i - 1]) && is_free(environment, hint, mean, line_[i + 1])) {
        line_[i] = mean;
      }
    }
  }
}

Vector3 Route::at(double way) const {
  const auto behind = std::upper_bound(from_inlet_.begin(), from_inlet_.end(), std::max(way, 0.0));
  if (behind == from_inlet_.end()) {
    return line_.back();
  }
  const auto i = static_cast<std::size_t>(behind - from_inlet_.begin());
  const double share = (std::max(way, 0.0) - from_inlet_[i - 1]) / (from_inlet_[i] - from_inlet_[i - 1]);
  return line_[i - 1] + share * (line_[i] - line_[i - 1]);
}

double Route::nearest(const Vector3& point) const {
  const auto closer = [&point](const Vector3& a, const Vector3& b) {
    return (a - point).squaredNorm() < (b - point).squaredNorm();
  };
  return from_inlet_[static_cast<std::size_t>(std::min_element(line_.begin(), line_.end(), closer) - line_.begin())];
}

}  // namespace physics
