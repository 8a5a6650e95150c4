// A wire with its physics in a vessel that beats, 1,000 steps a second: dsw_scene_deform moves the walls and the wire at once.
#include "contact_parts.h"

#include "physics_wire.h"
#include "timing.h"
#include "vessel_case.h"

#include <cstdio>

namespace dsw::bench {

namespace {

constexpr double kStep = 1e-3;  // s
constexpr double kTurn = 6.283185307179586;
constexpr double kBeats = 1.2;       // a second
constexpr double kSwell = 0.05;      // of the distance from the centreline
constexpr double kReach = 15;        // mm, from the centreline, over which tissue goes along
constexpr double kRadius = 0.15;     // mm, of the wire
constexpr double kWireLength = 150;  // mm
constexpr std::size_t kEdges = 200, kSettling = 200;

/** Where the points of a vessel go while it beats. */
class Beat {
 public:
  explicit Beat(const VesselCase& vessel) : rest_(vessel.mesh.points), ways_(rest_.size()) {
    std::vector<std::array<double, 3>> line;
    for (double at = 0; at < vessel.line.length(); at += 1) line.push_back(vessel.line.point(at));
    for (std::size_t i = 0; i < rest_.size(); i += 3) {
      double nearest = 1e300;
      for (const std::array<double, 3>& point : line) {
        const double d[3] = {rest_[i] - point[0], rest_[i + 1] - point[1], rest_[i + 2] - point[2]};
        const double square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
        if (square >= nearest) continue;
        nearest = square;
        for (std::size_t k = 0; k < 3; ++k) ways_[i + k] = d[k];
      }
      for (std::size_t k = 0; k < 3; ++k) ways_[i + k] *= kSwell * std::exp(-nearest / (kReach * kReach));
    }
  }
  void place(std::size_t step, std::vector<double>& points) const {
    const double part = std::sin(kTurn * kBeats * kStep * static_cast<double>(step));
    points.resize(rest_.size());
    for (std::size_t i = 0; i < rest_.size(); ++i) points[i] = rest_[i] + part * ways_[i];
  }

 private:
  std::vector<double> rest_, ways_;
};

struct Times {
  std::vector<double> deform, near, rod, whole;  // ms, a step
  std::size_t free = 0, touching = 0, held = 0;
};

Times run_wire(const VesselCase& vessel, const Beat& beat, double radius, std::size_t steps) {
  PhysicsWire wire(vessel, kEdges, kWireLength, radius, kRadius);
  std::vector<double> arrays[2];
  Times times;
  for (std::size_t step = 1; step <= kSettling + steps; ++step) {
    std::vector<double>& next = arrays[step % 2];  // the environment reads the other one
    beat.place(step, next);
    const double near = 1e-6 * cpu_time_ns([&] { wire.find_rows(); });
    const double rod = 1e-6 * cpu_time_ns([&] { wire.solve(step, kStep); });
    const double deform = 1e-6 * cpu_time_ns([&] { wire.deform(next); });
    const double rest = 1e-6 * cpu_time_ns([&] { wire.accept(kStep); });
    if (step <= kSettling) continue;  // the wire comes to lie on the walls
    times.near.push_back(near);
    times.rod.push_back(rod + rest);
    times.deform.push_back(deform);
    times.whole.push_back(near + rod + deform + rest);
    times.free += wire.is_free() ? 1 : 0;
    times.touching += wire.touches() ? 1 : 0;
    times.held += wire.is_short() ? 1 : 0;
  }
  return times;
}

void report_times(const std::string& name, const Times& times, Report& report) {
  const std::string key = "together.beating_vessel" + name;
  const auto count = static_cast<double>(times.deform.size());
  double sum = 0;
  for (const double each : times.whole) sum += each;
  report.set(key + ".steps", count);
  report.set(key + ".free_share", static_cast<double>(times.free) / count);
  report.set(key + ".contact_share", static_cast<double>(times.touching) / count);
  report.set(key + ".short_share", static_cast<double>(times.held) / count);
  report.set(key + ".ms", median(times.deform));
  report.set(key + ".ms_p999", quantile(times.deform, 0.999));
  report.set(key + ".ms_max", quantile(times.deform, 1));
  report.set(key + ".near_ms", median(times.near));
  report.set(key + ".rod_ms", median(times.rod));
  report.set(key + ".real_time", 1e3 * kStep * count / sum);
}

}  // namespace

void run_beating(const ContactOptions& options, Report& report) {
  if (options.vessel.empty()) std::printf("  no data: a generated vessel instead of the phantom\n");
  const std::size_t steps = options.quick ? 200 : 3000;
  for (const double radius : {0.0, kRadius}) {
    VesselCase vessel(options.vessel, options.line);
    const Beat beat(vessel);
    report_times(radius == 0 ? ".thin" : "", run_wire(vessel, beat, radius, steps), report);
  }
}

}  // namespace dsw::bench
