#include <algorithm>
#include <cmath>

#include "channel.h"
#include "curve.h"
#include "dials.h"
#include "world.h"

namespace physics {
namespace {

constexpr double kSeconds = 0.2;
constexpr int kLinks = 12;
constexpr double kLink = 0.1, kCube = 0.4;
constexpr double kPostLower = 2 * kCube, kPostUpper = 3 * kCube;  // of the post, in x and y

// A rigid rod that turns about one end, which moves. Where it wants to be at a time does not depend on what it meets.
struct Motion {
  int pose;

  Vector3 at(int i, double t) const {
    const double angle = 0.1 + 5 * t, x = 0.35 + 0.03 * pose + 0.5 * t, y = 0.45 + 0.02 * pose + 0.2 * t;
    return Vector3(x, y, 0.37) + kLink * i * Vector3(std::cos(angle), std::sin(angle), 0);
  }

  bool meets_post(double t) const {
    const Vector3 p = at(0, t), way = at(kLinks, t) - p;
    double enters = 0, leaves = 1;
    for (int k = 0; k < 2; ++k) {
      const double a = (kPostLower - p[k]) / way[k], b = (kPostUpper - p[k]) / way[k];
      enters = std::max(enters, std::min(a, b));
      leaves = std::min(leaves, std::max(a, b));
    }
    return enters <= leaves;
  }

  // When the rod touches the post if all of it moves at once.
  double contact_time() const {
    double free = 0, met = 0;
    while (!meets_post(met)) {
      free = met;
      met += 1e-4;
    }
    for (int halving = 0; halving < 40; ++halving) {
      const double middle = 0.5 * (free + met);
      (meets_post(middle) ? met : free) = middle;
    }
    return met;
  }
};

struct Reached {
  double contact_time = kSeconds, seconds = 0;
  Positions shape;
};

// One vertex after the other, from the turning end to the tip or the other way round. What touches stays.
Reached run(const Motion& motion, double dt, bool from_tip) {
  Channel channel;
  channel.cubes = {6, 6, 2};
  channel.scale = kCube;
  channel.obstacles = {{2, 2, 0}, {2, 2, 1}};
  const Environment environment = make_channel(channel);
  World world(environment.get());
  const auto shape_at = [&motion, from_tip](double t) {
    Positions line;
    for (int i = 0; i <= kLinks; ++i) {
      line.push_back(motion.at(from_tip ? kLinks - i : i, t));
    }
    return line;
  };
  SoftBody* body = world.add(std::make_unique<SoftBody>(world.scene(), shape_at(0), 1.0, SoftBodyOptions()));
  dsw_move_options options;
  dsw_move_options_init(&options, sizeof options);
  options.vertex_response = options.edge_response = DSW_RESPONSE_STOP;

  Reached reached;
  const auto steps = std::llround(kSeconds / dt);
  bool touched = false;
  const double start = processor_seconds();
  for (long long step = 0; step < steps; ++step) {
    const Positions targets = shape_at(static_cast<double>(step + 1) * dt);
    dsw_move_report report;
    check(dsw_body_move(world.scene(), body->id(), targets.front().data(), targets.size(), 0, &options, &report),
          "moving");
    if (report.contact_count > 0 && !touched) {
      const dsw_body_contact* contacts = nullptr;
      std::size_t count = 0;
      check(dsw_body_get_contacts(world.scene(), body->id(), &contacts, &count), "reading contacts");
      reached.contact_time = (static_cast<double>(step) + contacts[0].time) * dt;
      touched = true;
    }
  }
  reached.seconds = processor_seconds() - start;
  body->read_positions();
  reached.shape = body->points.position;
  if (from_tip) {
    std::reverse(reached.shape.begin(), reached.shape.end());
  }
  return reached;
}

double distance_of(const Positions& a, const Positions& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest = std::max(largest, (a[i] - b[i]).norm());
  }
  return largest;
}

}  // namespace

bool measure_time_step(const std::string& folder, bool quick) {
  const int poses = quick ? 3 : 8;
  const double finest = quick ? 1e-5 : 2e-6;
  const std::vector<double> steps = quick ? std::vector<double>{1e-1, 2e-2, 1e-2, 1e-3, 1e-4}
                                          : std::vector<double>{1e-1, 5e-2, 2e-2, 1e-2, 5e-3, 2e-3, 1e-3, 1e-4, 1e-5};
  CurvePanel times{"s", "simulated second", "time of first contact", "s", {}};
  CurvePanel shapes{
      "s", "simulated second", "largest distance to the shape reached by both orders in the limit", "m", {}};
  // In the limit all vertices move at once: what both orders reach with the finest step, in the middle.
  std::vector<Positions> limits;
  double apart = 0;
  for (int pose = 0; pose < poses; ++pose) {
    Positions a = run({pose}, finest, false).shape;
    const Positions b = run({pose}, finest, true).shape;
    apart = std::max(apart, distance_of(a, b));
    for (std::size_t i = 0; i < a.size(); ++i) {
      a[i] = 0.5 * (a[i] + b[i]);
    }
    limits.push_back(a);
  }
  for (const bool from_tip : {false, true}) {
    const std::string method = from_tip ? "from the tip" : "from the turning end";
    for (const double dt : steps) {
      double time_error = 0, shape_error = 0, seconds = 0;
      for (int pose = 0; pose < poses; ++pose) {
        const Motion motion{pose};
        const Reached reached = run(motion, dt, from_tip);
        time_error = std::max(time_error, std::abs(reached.contact_time - motion.contact_time()));
        shape_error = std::max(shape_error, distance_of(reached.shape, limits[static_cast<std::size_t>(pose)]));
        seconds += reached.seconds / (poses * kSeconds);
      }
      const auto count = static_cast<std::size_t>(poses);
      times.points.push_back({method, dt, seconds, time_error, count, "against all vertices moving at once"});
      shapes.points.push_back({method, dt, seconds, shape_error, count, "limits are " + in_words(apart) + " m apart"});
    }
  }
  double share = 0;
  for (const CurvePoint& point : times.points) {
    share = std::max(share, point.error / point.setting);
  }
  const CurvePoint *first = cheapest_within(shapes, "from the turning end", 1e-3),
                   *second = cheapest_within(shapes, "from the tip", 1e-3);
  std::string advice = "Moving vertices one at a time puts the first contact off by at most " + in_words(share) +
                       " of a time step, in either order, and never passes anything";
  if (first != nullptr && second != nullptr) {
    advice += "; for a shape right to 1 mm at a tip that moves 6 m/s take dt = " +
              in_words(std::min(first->setting, second->setting)) + " s (" +
              in_words(1e3 * std::max(first->seconds_per_item, second->seconds_per_item)) + " ms for each second)";
  }
  return write_curve(folder, "time_step", {times, shapes}, advice + ".");
}

}  // namespace physics
