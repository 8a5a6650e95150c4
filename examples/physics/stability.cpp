#include "stability.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "channel.h"
#include "world.h"

namespace physics {
namespace {

constexpr int kLinks = 12;
constexpr double kLength = 0.1, kMass = 1;

// Physics that has exploded throws a body across the room in every step, which then meets this many walls and takes a thousand times as long as
// others: a scene ends when a twentieth of its steps was like that.
constexpr std::size_t kViolent = 60;

double spring_of(const StabilityRow& row) { return row.stiffness * kMass / (row.dt * row.dt); }

SoftBodyOptions options_of(const StabilityRow& row, std::size_t points) {
  SoftBodyOptions options;
  options.integrator.method = row.integrator;
  // Or an unstable body, thrown to and fro, is cut into ever more and smaller parts.
  options.move.min_length = 0.2 * kLength;
  options.most_vertices = points + 8;
  options.friction.otherwise = 0.3;
  return options;
}

// A rod along x or, upright, along z; its first point is at `start`.
SoftBody* add_rod(const StabilityRow& row, const Vector3& start, bool upright, World* world) {
  Positions line;
  for (int i = 0; i <= kLinks; ++i) {
    line.push_back(start + kLength * i * (upright ? Vector3(0, 0, 1) : Vector3(1, 0, 0)));
  }
  SoftBody* body = world->add(std::make_unique<SoftBody>(world->scene(), line, kMass, options_of(row, line.size())));
  const double k = spring_of(row);
  body->springs = make_rod(line, k * kLength, 0.01 * k * kLength * kLength * kLength);
  return body;
}

// In [-1, 1], different for each point and direction, the same in every run.
Vector3 throw_of(std::size_t i) {
  const double n = static_cast<double>(i);
  return {std::sin(1 + 7 * n), std::sin(2 + 11 * n), std::sin(3 + 13 * n)};
}

// A room with three posts in it.
Channel posts() {
  Channel channel;
  channel.cubes = {6, 3, 3};
  channel.scale = 0.4;
  channel.obstacles = {{1, 1, 0}, {3, 1, 0}, {4, 1, 0}};
  return channel;
}

// The larger one; what is no number is the largest.
double larger(double now, double largest) { return now <= largest || std::isnan(largest) ? largest : now; }

template <class Drive>
void run_steps(World* world, double dt, int steps, Outcome* outcome, Drive before_each) {
  int violent = 0;
  for (int step = 0; step < steps && 20 * violent < steps; ++step) {
    const std::size_t contacts = outcome->contacts;
    before_each();
    take_step(world, dt, true, outcome);
    violent += outcome->contacts > contacts + kViolent ? 1 : 0;
  }
}

void run_free(StabilityRow* row, int steps) {
  Channel channel;
  channel.scale = 1000;
  const Environment environment = make_channel(channel);
  World world(environment.get());
  SoftBody& body = *add_rod(*row, Vector3(500, 500, 500), false, &world);
  double thrown = 0;
  for (std::size_t i = 0; i < body.points.size(); ++i) {
    body.points.velocity[i] = throw_of(i);
    thrown += kMass * throw_of(i).norm();
  }
  const Vector3 momentum = momentum_of(body.points);
  const auto energy = [&body] { return kinetic_energy_of(body.points) + body.springs.energy(body.points.position); };
  const double start = energy();
  row->energy_largest = row->kinetic_largest = 1;
  row->largest_stretch = 0;
  for (int step = 0; step < steps; ++step) {
    take_step(&world, row->dt, true, &row->free);
    const double now = energy() / start;
    row->energy_largest = larger(now, row->energy_largest);
    row->kinetic_largest = larger(kinetic_energy_of(body.points) / start, row->kinetic_largest);
    row->largest_stretch = larger(body.springs.largest_stretch(body.points.position), row->largest_stretch);
    row->energy_drift = now - 1;
  }
  row->momentum_change = (momentum_of(body.points) - momentum).norm() / thrown;
}

void run_posts(StabilityRow* row, int steps) {
  const Environment environment = make_channel(posts());
  World world(environment.get());
  // Just above the posts, so that also the smallest time step gets there.
  SoftBody& body = *add_rod(*row, Vector3(0.55, 0.6, 0.4002), false, &world);
  for (std::size_t i = 0; i < body.points.size(); ++i) {
    body.points.velocity[i] = Vector3(0.2, 0, -1) + 0.1 * throw_of(i);
  }
  body.load.gravity = Vector3(0, 0, -9.81);
  run_steps(&world, row->dt, steps, &row->posts, [] {});
}

// The rod stands on end just above a post, its upper end in a hand that makes the same way in any number of steps: what happens depends on
// the stiffness alone.
double press(const StabilityRow& row, int steps, World* world, Outcome* outcome) {
  SoftBody& body = *add_rod(row, Vector3(0.6, 0.6, 0.4002), true, world);
  const std::size_t hand = kLinks;
  body.points.held[hand] = 1;
  const Vector3 push = 0.5 * kLength / (steps * row.dt) * Vector3(0.6, 0.3, -1);
  body.points.velocity.assign(body.points.size(), push);  // or it would hang from the hand at first
  double largest = 0;
  run_steps(world, row.dt, steps, outcome, [&] {
    largest = larger(body.springs.largest_stretch(body.points.position), largest);
    body.points.velocity[hand] = push;
  });
  return larger(body.springs.largest_stretch(body.points.position), largest);
}

void run_pressed(StabilityRow* row, int steps) {
  Channel channel = posts();
  channel.cubes[2] = 5;
  const Environment environment = make_channel(channel);
  World world(environment.get());
  row->pressed_stretch = press(*row, steps, &world, &row->pressed);
}

void run_walls(StabilityRow* row, int steps) {
  Channel channel = posts();
  channel.cubes[2] = 5;
  std::unique_ptr<Walls> kept;  // goes after the environment, which reads its points there
  const Environment environment = make_channel(channel);
  World world(environment.get(), DSW_FEATURE_DEFORMING);
  WallOptions options;
  options.mass = kMass;
  options.stretching = options.anchor = spring_of(*row);
  options.integrator.method = row->integrator;
  options.deform.most_halvings = 3;  // where walls explode they are held, not followed to where they fold
  world.add_walls(options);
  press(*row, steps, &world, &row->walls);
  kept = world.release_walls();
}

// An octahedron, its faces in four: 18 points, 32 triangles.
void run_surface(StabilityRow* row, int steps) {
  const Environment environment = make_channel(posts());
  World world(environment.get());
  constexpr double kRadius = 0.3;
  const Vector3 centre(0.9, 0.55, 0.4 + kRadius + 0.0002);
  Positions corners = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  std::vector<std::uint32_t> triangles;
  const auto middle = [&corners](std::uint32_t a, std::uint32_t b) {
    const Vector3 at = (corners[a] + corners[b]).normalized();
    const auto found = std::find(corners.begin(), corners.end(), at);
    const auto index = static_cast<std::uint32_t>(found - corners.begin());
    if (found == corners.end()) {
      corners.push_back(at);
    }
    return index;
  };
  for (std::uint32_t octant = 0; octant < 8; ++octant) {
    std::array<std::uint32_t, 3> t = {octant & 1, 2 + (octant >> 1 & 1), 4 + (octant >> 2)};
    if (octant == 1 || octant == 2 || octant == 4 || octant == 7) {
      std::swap(t[0], t[1]);  // so that all are seen from outside in the same sense
    }
    const std::uint32_t ab = middle(t[0], t[1]), bc = middle(t[1], t[2]), ca = middle(t[2], t[0]);
    triangles.insert(triangles.end(), {t[0], ab, ca, ab, t[1], bc, ca, bc, t[2], ab, bc, ca});
  }
  for (Vector3& corner : corners) {
    corner = centre + kRadius * corner;
  }
  SoftBody& body = *world.add(
      std::make_unique<SoftBody>(world.scene(), corners, triangles, kMass, options_of(*row, corners.size())));
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const std::size_t a = triangles[i], b = triangles[i % 3 == 2 ? i - 2 : i + 1];
    if (a < b) {
      body.springs.distances.push_back({a, b, (corners[b] - corners[a]).norm(), spring_of(*row)});
    }
  }
  body.points.velocity.assign(corners.size(), kRadius / (steps * row->dt) * Vector3(0.3, 0.1, -1));
  run_steps(&world, row->dt, steps, &row->surface, [] {});
}

}  // namespace

Outcome StabilityRow::all() const {
  Outcome sum = free;
  for (const Outcome* more : {&posts, &pressed, &surface, &walls}) {
    sum.add(*more);
  }
  return sum;
}

StabilityRow run_stability(Integrator integrator, double stiffness, double dt, int steps) {
  StabilityRow row = {};
  row.integrator = integrator;
  row.stiffness = stiffness;
  row.dt = dt;
  run_free(&row, steps);
  run_posts(&row, steps);
  run_pressed(&row, steps);
  run_surface(&row, steps);
  run_walls(&row, steps);
  return row;
}

}  // namespace physics
