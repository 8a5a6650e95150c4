#include <algorithm>
#include <cmath>
#include <fstream>

#include "curve.h"
#include "dials.h"
#include "swing.h"

namespace physics {
namespace {

constexpr Integrator kAll[] = {Integrator::kSymplecticEuler, Integrator::kImplicitEuler, Integrator::kXpbd};
constexpr double kSeconds = 1;
constexpr double kStiffness = 1e3;  // N/m: the fastest wave takes 0.2 s along the rope

// Times of short runs, the fastest of three.
double fastest(const Swing& swing, const IntegratorOptions& options, double dt, std::vector<Positions>* trace) {
  double best = run(swing, options, dt, kSeconds, trace);
  for (int again = 0; again < 2 && best < 0.1; ++again) {
    best = std::min(best, run(swing, options, dt, kSeconds, trace));
  }
  return best;
}

void write_points(const Positions& points, std::ostream& out) {
  const char* before = "[";
  for (const Vector3& p : points) {
    out << before << '[' << p.x() << ", " << p.y() << ", " << p.z() << ']';
    before = ", ";
  }
  out << ']';
}

// The rope and the truth about it, for peers.
bool write_swing(const std::string& file, const Swing& swing, const std::vector<double>& steps,
                 const std::vector<Positions>& truth) {
  std::ofstream out(file);
  out.precision(17);
  out << "{\"mass\": " << Swing::kMass << ", \"gravity\": " << Swing::kGravity << ", \"rest\": " << Swing::kLink
      << ", \"stiffness\": " << kStiffness << ", \"seconds\": " << kSeconds << ", \"samples\": " << truth.size()
      << ",\n \"points\": ";
  write_points(swing.points.position, out);
  out << ",\n \"time_steps\": [";
  for (std::size_t i = 0; i < steps.size(); ++i) {
    out << (i == 0 ? "" : ", ") << steps[i];
  }
  out << "],\n \"truth\": [";
  for (std::size_t t = 0; t < truth.size(); ++t) {
    out << (t == 0 ? "" : ",\n  ");
    write_points(truth[t], out);
  }
  out << "]}\n";
  out.close();
  return static_cast<bool>(out);
}

}  // namespace

bool measure_integrators(const std::string& folder, bool quick) {
  const Swing swing(kStiffness);
  std::vector<Positions> truth, trace;
  run_reference(swing, quick ? 1e-4 : 1e-5, kSeconds, &truth);
  CurvePanel panel{"s", "simulated second", "largest distance to the reference", "m", {}};
  const std::vector<double> steps = quick ? std::vector<double>{1e-1, 1e-2, 1e-3, 1e-4}
                                          : std::vector<double>{1e-1, 5e-2, 2e-2, 1e-2, 5e-3, 2e-3, 1e-3, 1e-4, 1e-5};
  for (const Integrator method : kAll) {
    IntegratorOptions options;
    options.method = method;
    for (const double dt : steps) {
      const double seconds = fastest(swing, options, dt, &trace), error = distance_of(trace, truth);
      panel.points.push_back({name_of(method), dt, seconds, error, Swing::kLinks * truth.size(),
                              error < Swing::kLinks * Swing::kLink ? "" : "explodes"});
    }
  }
  const double wanted = 0.01;  // m
  std::string advice;
  for (const Integrator method : kAll) {
    const CurvePoint* point = cheapest_within(panel, name_of(method), wanted);
    advice += (advice.empty() ? "For " + in_words(wanted) + " m after a second take " : "; ") + name_of(method) +
              (point == nullptr ? std::string(" at no step tried")
                                : " with dt = " + in_words(point->setting) + " s (" +
                                      in_words(1e3 * point->seconds_per_item) + " ms)");
  }
  const double limit = 2 / std::sqrt(4 * kStiffness / Swing::kMass);
  const auto others = std::count_if(panel.points.begin(), panel.points.end(), [](const CurvePoint& point) {
    return !point.note.empty() && point.method != name_of(Integrator::kSymplecticEuler);
  });
  advice += ". All three are of first order; symplectic Euler, the cheapest, explodes beyond dt = " + in_words(limit) +
            " s here, the others at " + (others == 0 ? "none" : std::to_string(others)) + " of the steps tried.";
  return write_curve(folder, "integrator", {panel}, advice) && write_swing(folder + "/swing.json", swing, steps, truth);
}

bool measure_solvers(const std::string& folder, bool quick) {
  constexpr double kRopeStep = 1e-2, kRopeTime = 0.5;
  const std::vector<int> sweeps =
      quick ? std::vector<int>{1, 4, 16, 64, 256} : std::vector<int>{1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 4096};
  CurvePanel panel{"steps", "time step", "largest distance to the solved step", "m", {}};
  std::string advice = "For 1 mm";
  for (const double stiffness : {1e1, 1e3, 1e5}) {  // m / dt^2
    const Swing swing(stiffness * Swing::kMass / (kRopeStep * kRopeStep));
    const std::string name = " at k = " + in_words(stiffness) + " m/dt^2";
    std::vector<Positions> solved, trace;
    IntegratorOptions options;
    options.method = Integrator::kImplicitEuler;
    options.newton_steps = 100;
    run(swing, options, kRopeStep, kRopeTime, &solved);
    const std::size_t count = Swing::kLinks * solved.size();
    for (const int steps : {1, 2, 4, 8, 16}) {
      options.newton_steps = steps;
      const double seconds = run(swing, options, kRopeStep, kRopeTime, &trace) * kRopeStep / kRopeTime;
      panel.points.push_back({"implicit_euler" + name, static_cast<double>(steps), seconds, distance_of(trace, solved),
                              count, "Newton steps"});
    }
    options.method = Integrator::kXpbd;
    for (const int steps : sweeps) {
      options.sweeps = steps;
      const double seconds = run(swing, options, kRopeStep, kRopeTime, &trace) * kRopeStep / kRopeTime;
      panel.points.push_back(
          {"xpbd" + name, static_cast<double>(steps), seconds, distance_of(trace, solved), count, "sweeps"});
    }
    for (const char* method : {"xpbd", "implicit_euler"}) {
      const CurvePoint* point = cheapest_within(panel, method + name, 1e-3);
      advice += std::string(method) == "xpbd" ? name + ": " : ", or ";
      advice += point == nullptr
                    ? std::string("no number of sweeps tried")
                    : in_words(point->setting) + " " + (point->note == "sweeps" ? "sweeps" : "Newton steps") + " (" +
                          in_words(1e6 * point->seconds_per_item) + " us a step)";
    }
    advice += stiffness == 1e5 ? "." : ";";
  }
  // The last point is XPBD with the most sweeps.
  advice += " XPBD leaves a term of the step out: no number of sweeps brings it nearer than " +
            in_words(1e3 * panel.points.back().error) + " mm.";
  return write_curve(folder, "solver_steps", {panel}, advice);
}

}  // namespace physics
