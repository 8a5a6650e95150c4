// The closed surface of figure 12.
#ifndef DARTSWEEP_TESTS_BENCHMARK_SURFACE_H
#define DARTSWEEP_TESTS_BENCHMARK_SURFACE_H

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace dsw::bench {

struct Surface {
  std::vector<double> points;
  std::vector<std::array<std::uint32_t, 3>> faces;
};

/** Vertices and triangles of an .obj file. Throws if it holds anything else. */
Surface read_surface(const std::string& path);

/** A bumpy torus of 12,000 vertices with six neighbours each, as large as the hand. */
Surface make_surface();

/** Every edge once, two vertices each. */
std::vector<std::uint32_t> surface_edges(const Surface& surface);

}  // namespace dsw::bench

#endif
