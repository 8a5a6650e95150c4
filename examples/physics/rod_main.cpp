// What a step of the rod costs: `rod [EDGES [ROWS [STEPS]]]`. A straight wire is bent into a ring-shaped lumen and
// pushed along it. Prints figures, a key and a value in each line.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "rod/rod.h"

namespace {

using physics::Vector3;

constexpr double kRing = 10, kLumen = 1, kLink = 0.25, kStep = 1e-3, kSpeed = 10;

Vector3 on_ring(double angle) { return {kRing * std::cos(angle), kRing * std::sin(angle), 0}; }

// `count` rows, evenly along the rod; every third one is in the middle of an edge.
physics::NearRows rows_in_lumen(const physics::Rod& rod, std::size_t count, bool has_previous) {
  physics::NearRows rows(count);
  for (std::uint32_t k = 0; k < count; ++k) {
    physics::NearRow& row = rows[k];
    row.vertices[0] = static_cast<std::uint32_t>(k * (rod.edges.size() - 1) / count);
    row.vertices[1] = row.vertices[0] + 1;
    row.count = k % 3 == 0 ? 2 : 1;
    row.weights[0] = row.count == 2 ? 0.5 : 1;
    row.weights[1] = 1 - row.weights[0];
    row.previous = has_previous ? k : physics::kNoRow;
    const Vector3 at =
        row.weights[0] * rod.shape.position[row.vertices[0]] + row.weights[1] * rod.shape.position[row.vertices[1]];
    const Vector3 inwards = on_ring(std::atan2(at.y(), at.x())) - at;
    row.normal = inwards.norm() > 0 ? Vector3(inwards.normalized()) : Vector3::UnitZ();
    row.gap = kLumen - inwards.norm();
  }
  return rows;
}

}  // namespace

int main(int argc, char** argv) {
  const auto option = [&](int i, std::size_t otherwise) {
    return argc > i ? std::strtoul(argv[i], nullptr, 10) : otherwise;
  };
  const std::size_t edges = std::max<std::size_t>(option(1, 200), 3), count = option(2, 75), steps = option(3, 200);
  physics::Positions line;
  for (std::size_t i = 0; i <= edges; ++i) {
    const double angle = static_cast<double>(i) * kLink / kRing;
    line.push_back(on_ring(angle) + 0.03 * angle * Vector3::UnitZ());
  }
  physics::RodEdge edge;
  edge.length = kLink;
  edge.mass = 0.4;
  physics::Rod rod(line, std::vector<physics::RodEdge>(edges, edge));
  rod.held[edges] = rod.held[edges - 1] = 1;
  rod.held_turn[edges - 1] = 1;
  rod.options.drag = 20;
  rod.options.contact.tolerance = 1e-4;
  const double end = static_cast<double>(edges) * kLink / kRing;
  const Vector3 push(kSpeed * std::sin(end), -kSpeed * std::cos(end), 0);
  double sweeps = 0, pressing = 0, seconds = 0, least_gap = kLumen, stretch = 0;
  for (std::size_t step = 0; step < steps; ++step) {
    rod.velocity[edges] = rod.velocity[edges - 1] = push;
    const physics::NearRows rows = rows_in_lumen(rod, count, step > 0);
    for (const physics::NearRow& row : rows) {
      least_gap = std::min(least_gap, row.gap);
    }
    const auto start = std::chrono::steady_clock::now();
    const physics::RodContactReport report = rod.step(kStep, rows);
    rod.accept(rod.targets(), kStep);
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
