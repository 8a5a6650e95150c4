#include "extremes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "channel.h"

namespace physics {
namespace {

constexpr double kStep = 1e-3;

// One case: a line in a channel, and what is done to it before each step. Lengths are those of the channel's cubes.
struct Case {
  std::string name;
  Positions line;
  std::function<void(SoftBody* body, int step)> drive;
  int steps = 10;
  int proof_every = 1;
  double stiffness = 0.1;  // in units of mass / dt^2; 0: no springs
  Channel channel;
  double dt = kStep;

  Case() {
    channel.cubes = {8, 4, 4};
    channel.obstacles = {{3, 1, 0}, {3, 1, 1}, {6, 2, 1}};
  }
};

double largest_coordinate(const SoftBody& body) {
  double largest = 0;
  for (const Vector3& p : body.points.position) {
    largest = std::max(largest, p.cwiseAbs().maxCoeff());
  }
  return largest;
}

Extreme run(const Case& c) {
  const Environment environment = make_channel(c.channel);
  World world(environment.get());
  Positions line = c.line;
  for (Vector3& p : line) {
    p *= c.channel.scale;
  }
  SoftBodyOptions options;
  options.move.min_length = 0.1 * c.channel.scale;
  SoftBody* body = world.add(std::make_unique<SoftBody>(world.scene(), line, 1.0, options));
  if (c.stiffness > 0) {
    const double k = c.stiffness / (kStep * kStep), l = c.channel.scale;
    body->springs = make_rod(line, k * l, 0.01 * k * l * l * l);
  }
  Extreme extreme;
  extreme.name = c.name;
  for (int step = 0; step < c.steps; ++step) {
    c.drive(body, step);
    take_step(&world, c.dt, step % c.proof_every == 0 || step + 1 == c.steps, &extreme.outcome);
    extreme.largest = std::max(extreme.largest, largest_coordinate(*body));
  }
  // Back to ordinary physics.
  const Positions before = body->points.position;
  body->load = Load();
  for (int step = 0; step < 5; ++step) {
    for (std::size_t i = 0; i < body->points.size(); ++i) {
      const double away = body->points.position[i].x() > 2 * c.channel.scale ? -1 : 1;
      body->points.velocity[i] = Vector3(away * c.channel.scale, 0, 0);
    }
    take_step(&world, kStep, true, &extreme.outcome);
  }
  extreme.goes_on = body->points.position.front() != before.front();
  return extreme;
}

void set_velocity(SoftBody* body, const Vector3& velocity) {
  for (Vector3& v : body->points.velocity) {
    v = velocity;
  }
}

Case thrown(const std::string& name, const Positions& line, const Vector3& velocity) {
  Case c;
  c.name = name;
  c.line = line;
  c.drive = [velocity](SoftBody* body, int) { set_velocity(body, velocity); };
  return c;
}

Case pulled(const std::string& name, double force, int at) {
  Case c = thrown(name, {{1.5, 1.5, 1.5}, {2.25, 1.75, 1.5}, {2.5, 2.5, 1.5}}, Vector3::Zero());
  c.drive = [force, at](SoftBody* body, int step) {
    body->load.force.assign(body->points.size(), Vector3::Zero());
    body->load.force[1].x() = step == at ? force : 0;
  };
  return c;
}

const Positions kShort = {{1.5, 1.5, 1.5}, {2, 1.75, 1.75}};

}  // namespace

std::string what_happened(const Extreme& extreme) {
  const Outcome& o = extreme.outcome;
  const std::string then = extreme.goes_on ? "; the scene goes on" : "; the scene does not go on";
  if (!o.message.empty()) {
    return "refused: " + o.message + then;
  }
  return (o.refused > 0    ? "velocities that are no numbers became 0"
          : o.contacts > 0 ? "stopped by walls"
                           : "moved freely") +
         then;
}

std::vector<Extreme> run_extremes(int many) {
  const double infinity = std::numeric_limits<double>::infinity();
  std::vector<Case> cases;
  cases.push_back(pulled("force_nan", std::nan(""), 3));
  cases.push_back(pulled("force_infinite", infinity, 3));
  cases.push_back(pulled("force_1e300", 1e300, 3));
  cases.push_back(thrown("target_1e300", kShort, Vector3(1e300, 1e300, 0) / kStep));
  cases.push_back(thrown("velocity_denormal", kShort, {5e-324, 0, -5e-324}));
  cases.push_back(thrown("time_step_zero", kShort, {1, 0, 0}));
  cases.back().dt = 0;
  cases.push_back(thrown("time_step_1e100", kShort, {1, 0, 0}));
  cases.back().dt = 1e100;
  cases.back().stiffness = 0;  // with springs the implicit step ends where it begins

  for (const double scale : {1e100, 1e-100}) {
    cases.push_back(
        thrown(scale > 1 ? "coordinates_1e100" : "coordinates_1e-100", kShort, Vector3(200, 40, 30) * scale));
    cases.back().channel.scale = scale;
    cases.back().steps = 30;
  }
  cases.push_back(thrown("slivers_1e-12", {{0.5, 1.5, 1.5}, {0.9, 2.25, 1.5}}, {150, 10, 0}));
  cases.back().channel.sliver = 1e-12;
  cases.back().steps = 40;

  // Springs would take these off the lines: there are none.
  cases.push_back(thrown("along_faces", {{1.5, 0.5, 2}, {1.5, 3.5, 2}}, {125, 0, 0}));
  cases.push_back(thrown("along_edges", {{0.5, 2, 2}, {1.5, 2, 2}}, {125, 0, 0}));
  cases.push_back(thrown("through_vertices", {{0.5, 0.5, 0.5}, {0.25, 0.25, 0.25}}, {125, 125, 125}));
  for (std::size_t i = cases.size() - 3; i < cases.size(); ++i) {
    cases[i].stiffness = 0;
    cases[i].steps = 60;
  }
  // (4, 2, 2) is a corner of the obstacle; the free end swings against it and round it.
  cases.push_back(thrown("anchored_on_a_wall_vertex", {{4, 2, 2}, {4.5, 2.5, 2}}, Vector3::Zero()));
  cases.back().steps = 400;
  cases.back().drive = [](SoftBody* body, int) {
    body->points.held[0] = 1;
    body->load.gravity = Vector3(-3000, -1500, -1000);
  };

  cases.push_back(thrown("step_many_cells_long", {{0.5, 0.5, 0.5}, {0.75, 0.25, 0.5}}, {2.0 * many / kStep, 0, 0}));
  cases.back().channel.cubes = {many, 1, 1};
  cases.back().channel.obstacles.clear();
  cases.back().steps = 4;
  cases.back().drive = [many](SoftBody* body, int step) {
    set_velocity(body, Vector3((step % 2 == 0 ? 2.0 : -2.0) * many / kStep, 0, 0));
  };
  cases.push_back(thrown("many_steps", kShort, Vector3::Zero()));
  cases.back().steps = many;
  cases.back().proof_every = std::max(1, many / 1000);
  cases.back().drive = [](SoftBody* body, int step) {
    const double turn = 1e-3 * step;
    body->load.gravity = 3000 * Vector3(std::cos(turn), std::sin(1.3 * turn), std::sin(0.7 * turn));
  };

  std::vector<Extreme> extremes;
  for (const Case& c : cases) {
    extremes.push_back(run(c));
  }
  return extremes;
}

}  // namespace physics
