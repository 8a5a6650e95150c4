// Facet loops of small polyhedra, sound and unsound.
#pragma once

#include <cstdint>
#include <vector>

#include "map/shape.h"

namespace dsw::test {

using Loops = std::vector<std::vector<uint16_t>>;

/** The shape of loops whose vertices are numbered without gaps. */
inline ShapeDefect append(const Loops& loops, Array<uint16_t>& tables, const uint16_t* base = nullptr) {
  std::vector<uint16_t> vertices, first{0};
  uint16_t count = 0;
  for (const auto& loop : loops) {
    for (const uint16_t v : loop) {
      vertices.push_back(v);
      if (v >= count) count = static_cast<uint16_t>(v + 1);
    }
    first.push_back(static_cast<uint16_t>(vertices.size()));
  }
  return append_polyhedron({vertices.data(), first.data(), static_cast<uint32_t>(loops.size()), count}, base, tables);
}

inline Loops tetrahedron() { return {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {0, 2, 1}}; }
inline Loops box() { return {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}}; }

/** Two n-gons and n quads between them. */
inline Loops prism_over(int n) {
  Loops loops(2);
  for (int i = 0; i < n; ++i) {
    const int j = (i + 1) % n;
    loops[0].push_back(static_cast<uint16_t>(n - 1 - i));
    loops[1].push_back(static_cast<uint16_t>(n + i));
    loops.push_back({static_cast<uint16_t>(i), static_cast<uint16_t>(j), static_cast<uint16_t>(n + j),
                     static_cast<uint16_t>(n + i)});
  }
  return loops;
}

/** A box without its corner 6: facets of three, four and five vertices. */
inline Loops cut_corner() {
  return {{0, 4, 7, 3}, {1, 2, 6, 8, 5}, {0, 1, 5, 4}, {3, 7, 9, 6, 2}, {0, 3, 2, 1}, {4, 5, 8, 9, 7}, {6, 9, 8}};
}

/** Nine quads closed both ways. */
inline Loops torus() {
  Loops loops;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const auto at = [](int a, int b) { return static_cast<uint16_t>(3 * (a % 3) + b % 3); };
      loops.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return loops;
}

/** Two tetrahedra, the second with its vertices moved up by `offset` but vertex 0, which becomes `shared`. */
inline Loops two_tetrahedra(uint16_t offset, uint16_t shared) {
  Loops loops = tetrahedron();
  for (auto loop : tetrahedron()) {
    for (uint16_t& v : loop) v = v == 0 ? shared : static_cast<uint16_t>(v + offset);
    loops.push_back(loop);
  }
  return loops;
}
inline Loops two_spheres() { return two_tetrahedra(4, 4); }
inline Loops pinched() { return two_tetrahedra(3, 0); }

}  // namespace dsw::test
