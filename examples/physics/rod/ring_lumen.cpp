#include "rod/ring_lumen.h"

#include <cmath>

namespace physics {
namespace {

Vector3 on_ring(double angle) { return RingLumen::kRing * Vector3(std::cos(angle), std::sin(angle), 0); }

}  // namespace

Rod RingLumen::wire(std::size_t links) {
  Positions line;
  for (std::size_t i = 0; i <= links; ++i) {
    const double angle = static_cast<double>(i) * kLink / kRing;
    line.push_back(on_ring(angle) + 0.03 * angle * Vector3::UnitZ());
  }
  RodEdge edge;
  edge.length = kLink;
  edge.mass = 0.4;
  Rod rod(line, std::vector<RodEdge>(links, edge));
  rod.held[links] = rod.held[links - 1] = 1;
  rod.held_turn[links - 1] = 1;
  rod.options.drag = 20;
  rod.options.contact.tolerance = 1e-4;
  const double end = static_cast<double>(links) * kLink / kRing;
  rod.velocity[links] = rod.velocity[links - 1] = Vector3(kSpeed * std::sin(end), -kSpeed * std::cos(end), 0);
  return rod;
}

NearRows RingLumen::rows(const Rod& rod, std::size_t count, bool has_previous) {
  NearRows rows(count);
  for (std::uint32_t k = 0; k < count; ++k) {
    NearRow& row = rows[k];
    row.vertices[0] = static_cast<std::uint32_t>(k * (rod.edges.size() - 1) / count);
    row.vertices[1] = row.vertices[0] + 1;
    row.count = k % 3 == 0 ? 2 : 1;
    row.weights[0] = row.count == 2 ? 0.5 : 1;
    row.weights[1] = 1 - row.weights[0];
    row.previous = has_previous ? k : kNoRow;
    const Vector3 at =
        row.weights[0] * rod.shape.position[row.vertices[0]] + row.weights[1] * rod.shape.position[row.vertices[1]];
    const Vector3 inwards = on_ring(std::atan2(at.y(), at.x())) - at;
    row.normal = inwards.norm() > 0 ? Vector3(inwards.normalized()) : Vector3::UnitZ();
    row.gap = kLumen - inwards.norm();
  }
  return rows;
}

RodContactReport RingLumen::step(Rod* rod, const NearRows& rows) {
  const double end = static_cast<double>(rod->edges.size()) * kLink / kRing;
  rod->velocity[rod->edges.size()] = rod->velocity[rod->edges.size() - 1] =
      Vector3(kSpeed * std::sin(end), -kSpeed * std::cos(end), 0);
  const RodContactReport report = rod->step(kStep, rows);
  rod->accept(rod->targets(), kStep);
  return report;
}

}  // namespace physics
