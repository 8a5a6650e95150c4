#include <cmath>
#include <functional>

#include "channel.h"
#include "curve.h"
#include "dials.h"
#include "fold.h"
#include "world.h"

namespace physics {
namespace {

constexpr int kLinks = 12;
constexpr double kLength = 0.1, kStep = 1e-3;

struct Fallen {
  Positions shape;
  double seconds = 0;  // a step
  std::size_t contacts = 0, vertices = 0;
};

// A rod falls on posts and drapes itself over them.
Fallen fall(const std::function<void(SoftBodyOptions*)>& set, int steps) {
  Channel channel;
  channel.cubes = {6, 3, 3};
  channel.scale = 0.4;
  channel.obstacles = {{1, 1, 0}, {3, 1, 0}, {4, 1, 0}};
  const Environment environment = make_channel(channel);
  World world(environment.get());
  Positions line;
  for (int i = 0; i <= kLinks; ++i) {
    line.push_back(Vector3(0.55 + kLength * i, 0.6, 0.45 + 0.004 * i));
  }
  SoftBodyOptions options;
  options.integrator.method = Integrator::kImplicitEuler;
  options.friction.otherwise = 0.3;
  options.move.min_length = 0.2 * kLength;
  set(&options);
  SoftBody* body = world.add(std::make_unique<SoftBody>(world.scene(), line, 1.0, options));
  body->springs = make_rod(line, 1e5 * kLength, 10 * kLength);
  body->load.gravity = Vector3(0, 0.5, -9.81);
  body->load.drag = 2;
  Fallen fallen;
  const double start = processor_seconds();
  for (int step = 0; step < steps; ++step) {
    world.step(kStep);
    fallen.contacts += world.report(0).move.contact_count;
  }
  fallen.seconds = (processor_seconds() - start) / steps;
  fallen.vertices = body->count();
  fallen.shape.assign(body->points.position.begin(), body->points.position.begin() + kLinks + 1);
  return fallen;
}

// The rotation of a bar that is pressed on a ridge and lifted, by step.
std::vector<double> turns(double negligible, double* seconds, std::size_t* left) {
  FoldOptions options;
  options.aside = 1;
  options.negligible = negligible;
  options.press = options.lift = options.rest = 50;
  Fold fold(options);
  std::vector<double> turned;
  const double start = processor_seconds();
  while (!fold.is_over()) {
    const FoldStep step = fold.step();
    turned.push_back(step.turned);
    *left = step.vertices;
  }
  *seconds = (processor_seconds() - start) / static_cast<double>(turned.size());
  return turned;
}

}  // namespace

bool measure_contacts(const std::string& folder, bool quick) {
  const int steps = quick ? 200 : 1000;
  CurvePanel panel{"", "step", "distance from the rod with 64 rounds, without memory and bound", "m", {}};
  const Fallen reference = fall([](SoftBodyOptions* options) { options->contact_rounds = 64; }, steps);
  const auto measure = [&](const std::string& method, double value, const std::function<void(SoftBodyOptions*)>& set) {
    const Fallen fallen = fall(
        [&](SoftBodyOptions* options) {
          options->contact_rounds = 64;
          set(options);
        },
        steps);
    panel.points.push_back(
        {method, value, fallen.seconds, mean_distance(fallen.shape, reference.shape), static_cast<std::size_t>(steps),
         std::to_string(fallen.contacts) + " contacts, " + std::to_string(fallen.vertices) + " vertices"});
  };
  for (const int rounds : {1, 2, 4, 8, 16, 64}) {
    measure("rounds of impulses", rounds, [=](SoftBodyOptions* options) { options->contact_rounds = rounds; });
  }
  for (const int memory : {0, 1, 2, 5, 10, 50}) {
    measure("steps that contacts are kept", memory,
            [=](SoftBodyOptions* options) { options->contact_memory = memory; });
  }
  for (const int most : {13, 14, 16, 20, 1000}) {
    measure("most vertices", most,
            [=](SoftBodyOptions* options) { options->most_vertices = static_cast<std::size_t>(most); });
  }
  return write_curve(folder, "contact_response", {panel},
                     "8 rounds (default) put the rod " + in_words(panel.points[3].error) + " m beside 64, 1 round " +
                         in_words(panel.points[0].error) + "; contacts kept for 5 steps " +
                         in_words(panel.points[9].error) + ".");
}

bool measure_negligible(const std::string& folder, bool) {
  CurvePanel panel{"of the radius", "step", "rotation, against removal at 1e-6", "degrees", {}};
  double seconds = 0;
  std::size_t left = 0;
  const std::vector<double> exact = turns(1e-6, &seconds, &left);
  for (const double negligible : {1e-6, 1e-4, 1e-3, 0.01, 0.03, 0.1}) {
    const std::vector<double> turned = turns(negligible, &seconds, &left);
    double off = 0;
    for (std::size_t i = 0; i < turned.size(); ++i) {
      off += std::abs(turned[i] - exact[i]) / static_cast<double>(turned.size());
    }
    panel.points.push_back({"removal of [JCD10] 7.3.1", negligible, seconds, off, turned.size(),
                            std::to_string(left) + " vertices at the end"});
  }
  return write_curve(folder, "negligible", {panel},
                     "At 0.01 (default) the rotation is " + in_words(panel.points[3].error) + " degrees off, at 0.1 " +
                         in_words(panel.points[5].error) + ".");
}

}  // namespace physics
