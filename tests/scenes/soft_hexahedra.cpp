#include "scenes/soft_hexahedra.h"

#include <algorithm>
#include <cmath>

namespace dsw::scenes {

namespace {

constexpr std::size_t kNumbers = 3 * kBodyVertices;

std::vector<double> cube(double edge) {
  std::vector<double> corners;
  for (std::size_t i = 0; i < kBodyVertices; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) corners.push_back((i >> axis & 1) != 0 ? 0.5 * edge : -0.5 * edge);
  }
  return corners;
}

/** Whether every cell that a box meets is passable. */
bool has_room(const HexGrid& grid, const Box& box) {
  const auto& [low, high] = box;
  if (grid.cell_at(low.data()) == kNone || grid.cell_at(high.data()) == kNone) return false;
  for (auto z = static_cast<std::uint32_t>(low[2]); z <= static_cast<std::uint32_t>(high[2]); ++z) {
    for (auto y = static_cast<std::uint32_t>(low[1]); y <= static_cast<std::uint32_t>(high[1]); ++y) {
      for (auto x = static_cast<std::uint32_t>(low[0]); x <= static_cast<std::uint32_t>(high[0]); ++x) {
        if (grid.obstacle[grid.cell(x, y, z)] != 0) return false;
      }
    }
  }
  return true;
}

}  // namespace

Box::Box(const double* vertices) {
  for (std::size_t k = 0; k < 3; ++k) {
    low[k] = high[k] = vertices[k];
    for (std::size_t i = 1; i < kBodyVertices; ++i) {
      low[k] = std::fmin(low[k], vertices[3 * i + k]);
      high[k] = std::fmax(high[k], vertices[3 * i + k]);
    }
  }
}

bool Box::overlaps(const Box& other) const {
  bool all = true;
  for (std::size_t k = 0; k < 3; ++k) all = all && low[k] <= other.high[k] && other.low[k] <= high[k];
  return all;
}

SoftHexahedra::SoftHexahedra(const HexGrid& grid, const SoftHexahedraOptions& options)
    : options_(options),
      shape_(cube(options.edge), std::vector<double>(kBodyVertices, 1.0)),
      rotations_(options.bodies),
      positions_(kNumbers * options.bodies),
      velocities_(positions_.size()),
      targets_(positions_.size()) {
  Random random(options.seed);
  const std::vector<double> rest = cube(options.edge);
  std::vector<Box> boxes;
  const auto fits = [&](const Box& box) {
    return has_room(grid, box) &&
           std::none_of(boxes.begin(), boxes.end(), [&box](const Box& other) { return other.overlaps(box); });
  };
  for (std::size_t body = 0; body < body_count(); ++body) {
    double* const at = &positions_[kNumbers * body];
    const auto frame = random_frame(random);
    rotations_[body] = kIdentity;
    do {
      std::array<double, 3> centre{};
      for (std::size_t k = 0; k < 3; ++k) centre[k] = random.uniform(0.0, double(grid.options.size[k]));
      for (std::size_t i = 0; i < kBodyVertices; ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
          at[3 * i + k] =
              centre[k] + rest[3 * i] * frame[0][k] + rest[3 * i + 1] * frame[1][k] + rest[3 * i + 2] * frame[2][k];
        }
      }
    } while (!fits(Box(at)));
    boxes.emplace_back(at);
    // The impulse: a velocity of the whole body, and one as large of one particle, which turns the body and deforms it.
    const double speed = random.uniform(options.step_low, options.step_high);
    const auto way = random_direction(random), more = random_direction(random);
    const std::size_t hit = random.index(kBodyVertices);
    for (std::size_t i = 0; i < kBodyVertices; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        velocities_[kNumbers * body + 3 * i + k] = speed * (way[k] + (i == hit ? more[k] : 0.0));
      }
    }
  }
}

const std::vector<double>& SoftHexahedra::aim() {
  std::array<double, kNumbers> goals{};
  for (std::size_t body = 0; body < body_count(); ++body) {
    const std::size_t first = kNumbers * body;
    shape_.find_goals(&positions_[first], rotations_[body], goals.data());
    for (std::size_t i = 0; i < kNumbers; ++i) {
      velocities_[first + i] += options_.stiffness * (goals[i] - positions_[first + i]);
      targets_[first + i] = positions_[first + i] + velocities_[first + i];
    }
  }
  return targets_;
}

void SoftHexahedra::bounce(std::size_t p, std::size_t q, double along, const double* normal) {
  const double shares[2] = {1 - along, along};
  double speed = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    speed += normal[k] * (shares[0] * velocities_[3 * p + k] + shares[1] * velocities_[3 * q + k]);
  }
  if (speed < 0) {
    const double impulse = -2 * speed / (shares[0] * shares[0] + shares[1] * shares[1]);
    for (std::size_t k = 0; k < 3; ++k) {
      velocities_[3 * p + k] += shares[0] * impulse * normal[k];
      velocities_[3 * q + k] += shares[1] * impulse * normal[k];
    }
  } else {  // another contact has turned it round before, and still it could not go on
    std::fill_n(&velocities_[3 * p], 3, 0.0);
  }
}

double SoftHexahedra::deformation() const {
  double sum = 0;
  std::array<double, kNumbers> goals{};
  for (std::size_t body = 0; body < body_count(); ++body) {
    Matrix rotation = rotations_[body];
    shape_.find_goals(&positions_[kNumbers * body], rotation, goals.data());
    for (std::size_t i = 0; i < kNumbers; ++i) {
      const double off = positions_[kNumbers * body + i] - goals[i];
      sum += off * off;
    }
  }
  return std::sqrt(sum / static_cast<double>(kBodyVertices * body_count())) / options_.edge;
}

double SoftHexahedra::speed() const {
  double sum = 0;
  for (std::size_t i = 0; i < velocities_.size(); i += 3) {
    sum += std::sqrt(velocities_[i] * velocities_[i] + velocities_[i + 1] * velocities_[i + 1] +
                     velocities_[i + 2] * velocities_[i + 2]);
  }
  return 3 * sum / static_cast<double>(velocities_.size());
}

}  // namespace dsw::scenes
