#pragma once
// Loops with repeated points: what a cell is geometrically whose corners lie on each other.

#include <cstdint>
#include <vector>

namespace dsw {

/** Leaves out corners that follow themselves and ways that go back where they came from, round a loop. */
void clean_loop(std::vector<uint32_t>& loop);

/** Cleans the loops of a polyhedron, leaves out those with fewer than three corners, and pairs of loops that are the same,
 * turned against each other. Loop f is vertices[first[f]] .. vertices[first[f + 1] - 1]. */
void clean_loops(std::vector<uint16_t>& vertices, std::vector<uint16_t>& first);

}  // namespace dsw
