// The fall of main.c, in C++.
#include <cstdint>
#include <vector>

#include <dartsweep/dartsweep.hpp>

int main() {
  const std::vector<double> points = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};
  const std::vector<std::int64_t> cube = {0, 1, 2, 3, 4, 5, 6, 7};
  const auto environment = dartsweep::Environment::of(DSW_CELL_TYPE_HEXAHEDRON, points, cube);
  return environment.cast({0.5, 0.25, 0.5}, {0.5, 0.25, -0.5}).time == 0.5 ? 0 : 1;
}
