// A catheter as a chain of particles that is pushed along the line of a vessel, and pulled back.
#ifndef DARTSWEEP_TESTS_BENCHMARK_CHAIN_CASE_H
#define DARTSWEEP_TESTS_BENCHMARK_CHAIN_CASE_H

#include "surface_bodies.h"
#include "vessel_case.h"

namespace dsw::bench {

constexpr std::size_t kChainParticles = 20;
constexpr double kPush = 0.05;        // mm a step: 50 mm/s at 1 kHz
constexpr std::size_t kStroke = 200;  // steps in, then as many back

inline BodyShape chain(std::size_t particles) {
  BodyShape shape;
  shape.vertices = particles;
  for (std::uint32_t i = 1; i < particles; ++i) shape.edges.insert(shape.edges.end(), {i - 1, i});
  return shape;
}

/** Particles along the centreline, the last at its start as it is pushed in. */
inline std::vector<double> chain_at(const Line& line, std::size_t particles, std::size_t step) {
  constexpr double kSpacing = 5.6;  // between particles, mm
  const std::size_t in_stroke = step % (2 * kStroke);
  const double pushed = kPush * static_cast<double>(in_stroke <= kStroke ? in_stroke : 2 * kStroke - in_stroke);
  std::vector<double> positions;
  for (std::size_t i = particles; i-- > 0;) {
    const std::array<double, 3> at = line.point(kSpacing * static_cast<double>(i) + pushed);
    positions.insert(positions.end(), at.begin(), at.end());
  }
  return positions;
}

}  // namespace dsw::bench

#endif
