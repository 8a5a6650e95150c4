#include <algorithm>
#include <cmath>

#include "channel.h"
#include "curve.h"
#include "dials.h"
#include "world.h"

namespace physics {
namespace {

constexpr double kSeconds = 2;

// A beam of 4 x 1 x 1 cubes of 0.1 m, held at one end. Returns how far its other end hangs in the second half of the time, in the mean, and the
// time taken in `seconds`.
double sag_of(double match, double dt, double* seconds) {
  Channel channel;
  channel.scale = 10;
  const Environment environment = make_channel(channel);
  World world(environment.get());
  Positions corners;
  for (int i = 0; i < 20; ++i) {
    corners.push_back(Vector3(5, 5, 5) + 0.1 * Vector3(i / 4, i % 2, i / 2 % 2));
  }
  SoftBodyOptions options;
  options.match = match;
  SoftBody* body = world.add(std::make_unique<SoftBody>(world.scene(), corners, 0.01, options));
  body->shape.emplace(body->points);
  std::fill_n(body->points.held.begin(), 4, 1);
  body->load.gravity = Vector3(0, 0, -9.81);
  body->load.drag = 5;
  const auto steps = std::llround(kSeconds / dt);
  double sum = 0;
  const double start = processor_seconds();
  for (long long step = 0; step < steps; ++step) {
    world.step(dt);
    sum += 2 * step >= steps ? corners.back().z() - body->points.position.back().z() : 0;
  }
  *seconds = processor_seconds() - start;
  return 2 * sum / static_cast<double>(steps);
}

}  // namespace

bool measure_shape_matching(const std::string& folder, bool quick) {
  CurvePanel panel{"share", "simulated second", "sag of a beam that should be rigid", "m", {}};
  const std::vector<double> shares =
      quick ? std::vector<double>{0.01, 0.1, 0.5, 1} : std::vector<double>{0.01, 0.03, 0.1, 0.2, 0.5, 0.8, 1};
  for (const double dt : {1e-2, 3e-3, 1e-3}) {
    for (const double share : shares) {
      double seconds = 0;
      const double sag = std::abs(sag_of(share, dt, &seconds));
      panel.points.push_back({"dt = " + in_words(dt) + " s", share, seconds / kSeconds, sag,
                              static_cast<std::size_t>(std::llround(kSeconds / dt)), ""});
    }
  }
  const auto sag = [&panel](std::size_t first, double share) {
    for (std::size_t i = first; i < panel.points.size(); ++i) {
      if (panel.points[i].setting == share) {
        return in_words(1e3 * panel.points[i].error);
      }
    }
    return std::string("?");
  };
  return write_curve(folder, "shape_matching", {panel},
                     "The share of the way that a shape makes to its goals costs nothing, so take 1 for the stiffest, "
                     "and smaller steps where that is "
                     "too soft: a beam of 0.4 m sags by " +
                         sag(0, 0.1) + " mm at 0.1 and " + sag(0, 1) + " mm at 1 with dt = 0.01 s, by " +
                         sag(2 * shares.size(), 0.1) + " and " + sag(2 * shares.size(), 1) + " mm with dt = 0.001 s.");
}

}  // namespace physics
