#include <algorithm>
#include <functional>

#include "curve.h"
#include "dials.h"
#include "rod/ring_lumen.h"

namespace physics {
namespace {

struct Pushed {
  Positions shape;
  double seconds = 0;   // a step
  double deepest = 0;   // how far a row's point was beyond the wall
  double velocity = 0;  // the largest change of a row's motion in the last sweep, a length
};

Pushed push(const RodOptions& options, std::size_t links, int steps) {
  Rod rod = RingLumen::wire(links);
  rod.options = options;
  Pushed pushed;
  const double start = processor_seconds();
  for (int step = 0; step < steps; ++step) {
    const NearRows rows = RingLumen::rows(rod, links / 2, step > 0);
    for (const NearRow& row : rows) {
      pushed.deepest = std::max(pushed.deepest, -row.gap);
    }
    pushed.velocity = std::max(pushed.velocity, RingLumen::step(&rod, rows).last_change);
  }
  pushed.seconds = (processor_seconds() - start) / steps;
  pushed.shape = rod.shape.position;
  return pushed;
}

}  // namespace

bool measure_rod(const std::string& folder, bool quick) {
  const std::size_t links = quick ? 60 : 120;
  const int steps = quick ? 60 : 400;
  RodOptions best;
  best.drag = 20;
  best.linearisations = 2;
  best.contact.most_sweeps = 1000;
  const Pushed reference = push(best, links, steps);
  CurvePanel places{"", "step", "distance from the wire with two linearisations and 1000 sweeps", "mm", {}};
  CurvePanel depths{"", "step", "depth beyond the wall", "mm", {}};
  const auto measure = [&](const std::string& method, double value, const std::function<void(RodOptions*)>& set) {
    RodOptions options = best;
    set(&options);
    const Pushed pushed = push(options, links, steps);
    const std::string note = "last sweep moved a row by " + in_words(pushed.velocity) + " mm at most";
    places.points.push_back({method, value, pushed.seconds, mean_distance(pushed.shape, reference.shape),
                             static_cast<std::size_t>(steps), note});
    depths.points.push_back({method, value, pushed.seconds, pushed.deepest, static_cast<std::size_t>(steps), note});
  };
  for (const int count : {1, 2}) {
    measure("linearisations", count, [&](RodOptions* options) { options->linearisations = count; });
  }
  for (const int count : {2, 4, 8, 16, 40, 100}) {
    measure("most sweeps", count, [&](RodOptions* options) { options->contact.most_sweeps = count; });
  }
  for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
    measure("tolerance, mm", tolerance, [&](RodOptions* options) { options->contact.tolerance = tolerance; });
  }
  for (const int count : {2, 4, 8, 16}) {
    measure("sweeps between direct solutions, of 40", count, [&](RodOptions* options) {
      options->contact.most_sweeps = 40;
      options->contact.together = count;
    });
  }
  for (const double share : {0.02, 0.1, 0.2, 0.5, 1.0}) {
    measure("recovery", share, [&](RodOptions* options) { options->contact.recovery = share; });
  }
  const CurvePoint* enough = cheapest_within(places, "most sweeps", 1e-3);
  const std::string advice =
      "One linearisation puts the wire " + in_words(places.points.front().error) + " mm beside two; " +
      (enough == nullptr ? "100 sweeps do not reach 0.001 mm." : in_words(enough->setting) + " sweeps reach 0.001 mm.");
  return write_curve(folder, "rod", {places, depths}, advice);
}

}  // namespace physics
