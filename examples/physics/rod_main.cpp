// What a step of the rod costs: `rod [EDGES [ROWS [STEPS]]]`. A straight wire is bent into a ring-shaped lumen and
// pushed along it. Prints figures, a key and a value in each line.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "rod/ring_lumen.h"

int main(int argc, char** argv) {
  using physics::RingLumen;
  const auto option = [&](int i, std::size_t otherwise) {
    return argc > i ? std::strtoul(argv[i], nullptr, 10) : otherwise;
  };
  const std::size_t edges = std::max<std::size_t>(option(1, 200), 3), count = option(2, 75), steps = option(3, 200);
  physics::Rod rod = RingLumen::wire(edges);
  double sweeps = 0, pressing = 0, seconds = 0, least_gap = RingLumen::kLumen, stretch = 0;
  for (std::size_t step = 0; step < steps; ++step) {
    const physics::NearRows rows = RingLumen::rows(rod, count, step > 0);
    for (const physics::NearRow& row : rows) {
      least_gap = std::min(least_gap, row.gap);
    }
    const auto start = std::chrono::steady_clock::now();
    const physics::RodContactReport report = RingLumen::step(&rod, rows);
    seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    sweeps += report.sweeps;
    pressing += static_cast<double>(report.pressing);
    stretch = std::max(stretch, rod.largest_stretch());
  }
  const auto all = static_cast<double>(steps);
  std::printf(
      "rod.step_ms %.4g\nrod.sweeps %.3g\nrod.rows_pressing %.3g\nrod.least_gap %.3g\nrod.largest_stretch %.3g\n",
      1e3 * seconds / all, sweeps / all, pressing / all, least_gap, stretch);
  return 0;
}
