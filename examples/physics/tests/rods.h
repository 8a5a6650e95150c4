// Rods for tests.
#ifndef DARTSWEEP_PHYSICS_TESTS_RODS_H
#define DARTSWEEP_PHYSICS_TESTS_RODS_H

#include "rod/rod.h"

namespace physics {

// Along x, at the height 0, edges of length 1 and mass 1.
inline Rod straight_rod(std::size_t edges, double edge_mass) {
  Positions line;
  for (std::size_t i = 0; i <= edges; ++i) {
    line.emplace_back(static_cast<double>(i), 0, 0);
  }
  RodEdge edge;
  edge.mass = edge_mass;
  return Rod(line, std::vector<RodEdge>(edges, edge));
}

// Stretched, pressed, bent and twisted, with edges that differ.
inline Rod crooked_rod() {
  std::srand(7);
  constexpr std::size_t kEdges = 8;
  Rod rod = straight_rod(kEdges, 1);
  Positions to = rod.shape.position;
  for (Vector3& at : to) {
    at += 0.2 * Vector3::Random();
  }
  std::vector<double> turn;
  for (std::size_t i = 0; i < kEdges; ++i) {
    rod.edges[i].length = 1 + 0.02 * static_cast<double>(i);
    rod.edges[i].bending *= 1 + 0.1 * static_cast<double>(i);
    rod.edges[i].stretching = 1e8;
    rod.rest_curvature[i] = 0.2 * Vector2::Random();
    turn.push_back(0.3 * static_cast<double>(i % 3));
  }
  rod.shape.advance(to, turn);
  return rod;
}

// Crooked, and without any tension.
inline Rod curved_rod_at_rest() {
  Rod rod = crooked_rod();
  for (std::size_t i = 0; i < rod.edges.size(); ++i) {
    rod.edges[i].length = rod.shape.length[i];
    if (i > 0) {
      rod.rest_curvature[i] = bend_of(rod.shape, i).curvature;
      rod.rest_twist[i] = rod.shape.twist[i];
    }
  }
  return rod;
}

}  // namespace physics

#endif
