#include "scenes/random_turns.h"

#include <cmath>

namespace dsw::scenes {

std::array<double, 3> random_direction(Random& random) {
  for (;;) {
    const std::array<double, 3> v = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    const double length_sq = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    if (length_sq > 0.01 && length_sq <= 1.0) {
      const double scale = 1.0 / std::sqrt(length_sq);
      return {v[0] * scale, v[1] * scale, v[2] * scale};
    }
  }
}

std::array<std::array<double, 3>, 3> random_frame(Random& random) {
  const std::array<double, 3> a = random_direction(random);
  for (;;) {
    std::array<double, 3> b = random_direction(random);
    const double along = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    double length_sq = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      b[k] -= along * a[k];
      length_sq += b[k] * b[k];
    }
    if (length_sq < 0.01) continue;
    for (double& value : b) value /= std::sqrt(length_sq);
    return {a, b, {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
  }
}

std::array<double, 2> random_phase(Random& random) {
  for (;;) {
    const double x = random.uniform(-1, 1), y = random.uniform(-1, 1);
    const double length_sq = x * x + y * y;
    if (length_sq > 0.01 && length_sq <= 1.0) {
      const double scale = 1.0 / std::sqrt(length_sq);
      return {x * scale, y * scale};
    }
  }
}

}  // namespace dsw::scenes
