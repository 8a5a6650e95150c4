#include "rod_solver.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "rod/rod_system.h"

namespace dartsweep_python {
namespace {

using physics::Vector3;

constexpr std::uint32_t kIgnored = 0xfffffffeu;
constexpr std::size_t kOfVertex = 13, kOfEdge = 11;
constexpr int kTogether = 2;
constexpr double kAcross = 1e-6, kLeastLength = 1e-100;

// A unit vector across a tangent: `wanted` as far as it is, or any.
Vector3 across_of(const Vector3& wanted, const Vector3& tangent) {
  const Vector3 across = wanted - tangent.dot(wanted) * tangent;
  if (across.norm() > kAcross) {
    return across.normalized();
  }
  const Vector3 any = std::abs(tangent.x()) < 0.6 ? Vector3::UnitX() : Vector3::UnitY();
  return tangent.cross(any).normalized();
}

double largest_speed(const physics::BlockVector& velocities, std::size_t vertices) {
  double largest = 0;
  for (std::size_t i = 0; i < std::min(vertices, velocities.size()); ++i) {
    const double speed = velocities[i].head<3>().norm();
    largest = speed <= largest ? largest : speed;  // also what is no number
  }
  return largest;
}

}  // namespace

struct RodSolver::State {
  physics::RodSystem system;
  std::vector<physics::NearRows> rows;

  physics::Rod& rod(std::uint32_t number) { return system.rods.at(number); }
};

RodSolver::RodSolver(std::uint32_t rods) : state_(std::make_unique<State>()) {
  const physics::Positions line = {Vector3::Zero(), Vector3::UnitX()};
  state_->system.rods.assign(rods, physics::Rod(line, std::vector<physics::RodEdge>(1)));
  state_->rows.resize(rods);
}

RodSolver::~RodSolver() = default;

void RodSolver::set_rod(std::uint32_t number, dartsweep::View<const double> vertices,
                        dartsweep::View<const double> edges) {
  const std::size_t count = vertices.count / kOfVertex;
  if (count < 2 || vertices.count != kOfVertex * count || edges.count != kOfEdge * (count - 1)) {
    throw dartsweep::Error(DSW_STATUS_WRONG_SIZE, "a rod has numbers for its vertices and edges");
  }
  physics::Rod& rod = state_->rod(number);
  if (rod.size() != count) {
    const physics::RodOptions options = rod.options;
    rod = physics::Rod(physics::Positions(count, Vector3::Zero()), std::vector<physics::RodEdge>(count - 1));
    rod.options = options;
  }
  for (std::size_t i = 0; i < count; ++i) {
    const double* from = vertices.data + kOfVertex * i;
    rod.shape.position[i] = Eigen::Map<const Vector3>(from);
    rod.velocity[i] = Eigen::Map<const Vector3>(from + 3);
    rod.load[i] = Eigen::Map<const Vector3>(from + 6);
    rod.mass[i] = from[9];
    rod.rest_curvature[i] = Eigen::Map<const Eigen::Vector2d>(from + 10);
    rod.held[i] = from[12] != 0;
  }
  rod.shape.find_edges();
  for (std::size_t i = 0; i + 1 < count; ++i) {
    const double* from = edges.data + kOfEdge * i;
    rod.shape.director[i] = across_of(Eigen::Map<const Vector3>(from), rod.shape.tangent[i]);
    rod.spin[i] = from[3];
    rod.shape.twist[i + 1] = i + 2 < count ? from[4] : 0;
    physics::RodEdge& edge = rod.edges[i];
    edge.length = from[5];
    edge.mass = 0.5 * (vertices.data[kOfVertex * i + 9] + vertices.data[kOfVertex * (i + 1) + 9]);
    edge.stretching = from[6];
    edge.bending = from[7];
    edge.twisting = from[8];
    rod.held_turn[i] = from[9] != 0;
    edge.radius = from[10];
  }
}

dartsweep::Array<double> RodSolver::carry_director(std::uint32_t number, dartsweep::View<const double> across,
                                                   double turned) {
  if (across.count != 3) {
    throw dartsweep::Error(DSW_STATUS_WRONG_SIZE, "a director has 3 numbers");
  }
  physics::RodShape& shape = state_->rod(number).shape;
  const std::size_t last = shape.tangent.size() - 1;
  const Vector3 left = across_of(Eigen::Map<const Vector3>(across.data), shape.tangent[last]);
  shape.director[last] = std::cos(turned) * left + std::sin(turned) * shape.tangent[last].cross(left);
  for (std::size_t i = last; i-- > 0;) {
    shape.director[i] = across_of(physics::transported(shape.director[i + 1], shape.tangent[i + 1], shape.tangent[i]),
                                  shape.tangent[i]);
  }
  dartsweep::Array<double> out(3 + 3 * shape.director.size());
  std::copy_n(left.data(), 3, out.data());
  std::copy_n(shape.director.front().data(), 3 * shape.director.size(), out.data() + 3);
  return out;
}

dartsweep::Array<double> RodSolver::curvatures(std::uint32_t number) const {
  const physics::Rod& rod = state_->rod(number);
  dartsweep::Array<double> out(2 * rod.size());
  std::fill_n(out.data(), out.size(), 0);
  for (std::size_t i = 1; i + 1 < rod.size(); ++i) {
    std::copy_n(physics::bend_of(rod.shape, i).curvature.data(), 2, out.data() + 2 * i);
  }
  return out;
}

double RodSolver::predict(std::uint32_t number, double dt, double drag, std::uint32_t vertices) {
  physics::Rod& rod = state_->rod(number);
  rod.options.drag = drag;
  return largest_speed(rod.predict(dt), vertices);
}

void RodSolver::set_rows(std::uint32_t number, dartsweep::View<const dsw_near_row> rows,
                         dartsweep::View<const std::uint32_t> others, dartsweep::View<const double> impulses) {
  physics::Rod& rod = state_->rod(number);
  if (others.count != rows.count || impulses.count != 3 * rows.count) {
    throw dartsweep::Error(DSW_STATUS_WRONG_SIZE, "a row has the number of its other rod and an impulse");
  }
  physics::NearRows& to = state_->rows[number];
  to.assign(rows.count, physics::NearRow());
  rod.contacts().impulses().resize(rows.count);
  for (std::size_t i = 0; i < rows.count; ++i) {
    const dsw_near_row& from = rows.data[i];
    physics::NearRow& row = to[i];
    const std::uint32_t other = others.data[i];
    row.count = other == kIgnored ? 0 : from.vertices[1] == UINT32_MAX ? 1 : 2;
    for (std::uint32_t k = 0; k < row.count; ++k) {
      row.vertices[k] = from.vertices[k];
      row.weights[k] = from.weights[k];
    }
    row.normal = Eigen::Map<const Vector3>(from.normal);
    row.gap = from.gap;
    rod.contacts().impulses()[i] = Eigen::Map<const Vector3>(impulses.data + 3 * i);
    if (row.count > 0 && other != physics::kNoRod) {
      row.rod = other;
      const bool is_vertex = from.obstacle_vertices[1] == UINT32_MAX;
      row.rod_vertices[0] = from.obstacle_vertices[0];
      row.rod_vertices[1] = from.obstacle_vertices[is_vertex ? 0 : 1];
      row.rod_weights[0] = from.obstacle_weights[0];
      row.rod_weights[1] = is_vertex ? 0 : from.obstacle_weights[1];
    }
    const auto is_known = [&](const std::uint32_t* vertices, std::uint32_t count, std::size_t size) {
      return std::all_of(vertices, vertices + count, [&](std::uint32_t vertex) { return vertex < size; });
    };
    if (!is_known(row.vertices, row.count, rod.size()) ||
        (row.is_at_rod() && !is_known(row.rod_vertices, 2, state_->rod(row.rod).size()))) {
      throw dartsweep::Error(DSW_STATUS_OUT_OF_RANGE, "a row has a vertex that its rod has not");
    }
  }
}

void RodSolver::set_options(std::uint32_t number, double friction, double recovery, double tolerance, int most_sweeps) {
  physics::RodContactOptions& options = state_->rod(number).options.contact;
  options.friction = friction;
  options.recovery = recovery;
  options.tolerance = tolerance;
  options.most_sweeps = most_sweeps;
  options.together = kTogether;
}

dartsweep::Array<double> RodSolver::finish(double dt) {
  const physics::RodContactReport report = state_->system.finish(dt, state_->rows);
  const double numbers[] = {static_cast<double>(report.sweeps), report.last_change};
  return dartsweep::Array<double>(numbers, 2);
}

double RodSolver::largest_turn(std::uint32_t number, double dt) const {
  const physics::Rod& rod = state_->rod(number);
  double largest = 0;
  for (std::size_t i = 0; i + 1 < rod.size(); ++i) {
    const Vector3& tangent = rod.shape.tangent[i];
    const Vector3 along = rod.velocity[i + 1] - rod.velocity[i];
    const double turn = (along - tangent.dot(along) * tangent).norm() / std::max(rod.shape.length[i], kLeastLength);
    largest = std::max(largest, dt * turn);
  }
  return largest;
}

dartsweep::Array<double> RodSolver::targets(std::uint32_t number, double dt, std::uint32_t vertices,
                                            double most) const {
  const physics::Rod& rod = state_->rod(number);
  const std::size_t count = std::min<std::size_t>(vertices, rod.size());
  const double share = 1 / std::max(1.0, dt * largest_speed(rod.predicted(), count) / most);
  dartsweep::Array<double> out(3 * count);
  for (std::size_t i = 0; i < count; ++i) {
    Eigen::Map<Vector3>(out.data() + 3 * i) = rod.shape.position[i] + share * dt * rod.velocity[i];
  }
  return out;
}

dartsweep::Array<double> RodSolver::spins(std::uint32_t number) const {
  const std::vector<double>& spin = state_->rod(number).spin;
  return dartsweep::Array<double>(spin.data(), spin.size());
}

dartsweep::Array<double> RodSolver::impulses(std::uint32_t number) const {
  const physics::Positions& impulses = state_->rod(number).contacts().impulses();
  return dartsweep::Array<double>(impulses.empty() ? nullptr : impulses.front().data(), 3 * impulses.size());
}

dartsweep::Array<double> RodSolver::advance(std::uint32_t number, double dt, dartsweep::View<const double> positions) {
  physics::Rod& rod = state_->rod(number);
  if (positions.count != 3 * rod.size()) {
    throw dartsweep::Error(DSW_STATUS_WRONG_SIZE, "a rod has a position for each vertex");
  }
  physics::Positions to(rod.size());
  std::vector<double> turn(rod.spin.size());
  for (std::size_t i = 0; i < to.size(); ++i) {
    to[i] = Eigen::Map<const Vector3>(positions.data + 3 * i);
    if (i + 1 < to.size()) {
      turn[i] = dt * rod.spin[i];
    }
  }
  rod.shape.advance(to, turn);
  dartsweep::Array<double> out(3 * turn.size() + to.size());
  std::copy_n(rod.shape.director.front().data(), 3 * turn.size(), out.data());
  std::copy(rod.shape.twist.begin(), rod.shape.twist.end(), out.data() + 3 * turn.size());
  return out;
}

}  // namespace dartsweep_python
