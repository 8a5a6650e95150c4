// Moves in which all vertices go at once, beside moves one vertex at a time: what they cost, and how often they stop
// what nothing stops.
#include "parts.h"

#include "chain_case.h"
#include "fall_case.h"
#include "rope.h"
#include "timing.h"

#include "scenes/random.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

namespace dsw::bench {

namespace {

using Vector = std::array<double, 3>;

/** Nanoseconds of a step, in turn and together: means of blocks, since most steps use what others have found. */
struct Times {
  static constexpr std::size_t kBlock = 10;

  void add(int mode, double ns) {
    if (steps % kBlock == 0) blocks[mode].push_back(0);
    in_block[mode] = steps % kBlock == 0 ? ns : in_block[mode] + ns;
    blocks[mode].back() = in_block[mode] / static_cast<double>(steps % kBlock + 1);
  }

  std::vector<double> blocks[2];
  std::size_t steps = 0;
  double in_block[2] = {};
};

/** One body twice, in scenes of their own. */
class Beside {
 public:
  Beside(dsw_environment* environment, const Variant& variant, const BodyShape& shape, const std::vector<double>& at)
      : in_turn_(environment, variant, shape, at), together_(environment, variant, shape, at) {}

  std::vector<double> places() const {
    std::vector<double> at;
    std::vector<dsw_volume_id> volumes;
    in_turn_.places(at, volumes);
    return at;
  }
  /** Moves both. Times are kept apart for steps in which a vertex stops. */
  void move(const std::vector<double>& targets) {
    const auto move_in_turn = [&] { in_turn_.move(targets.data()); };
    const auto move_together = [&] { together_.move_together(targets.data(), DSW_TOGETHER_STOP_FEATURE); };
    double ns[2] = {};
    const bool is_swapped = ++steps_ % 2 == 0;
    if (is_swapped) ns[1] = cpu_time_ns(move_together);
    ns[0] = cpu_time_ns(move_in_turn);
    if (!is_swapped) ns[1] = cpu_time_ns(move_together);
    const bool stops = in_turn_.stopped() != 0 || together_.stopped() != 0;
    Times& times = times_[stops ? 1 : 0];
    for (int mode = 0; mode < 2; ++mode) times.add(mode, ns[mode]);
    ++times.steps;
    if (!stops) return;
    stopped_[0] += static_cast<double>(in_turn_.stopped());
    stopped_[1] += static_cast<double>(together_.stopped());
    // The next step starts from the same places, as far as nothing is in between.
    together_.move_together(places().data(), DSW_TOGETHER_STOP_FEATURE);
  }
  void add_to(Beside& sum) const {
    for (int k = 0; k < 2; ++k) {
      for (int mode = 0; mode < 2; ++mode) {
        auto& all = sum.times_[k].blocks[mode];
        all.insert(all.end(), times_[k].blocks[mode].begin(), times_[k].blocks[mode].end());
      }
      sum.times_[k].steps += times_[k].steps;
      sum.stopped_[k] += stopped_[k];
    }
  }
  /** @return ratio of the free steps */
  double report(const std::string& name, Report& report) const {
    double free_ratio = 0;
    for (int k = 0; k < 2; ++k) {
      const std::string key = name + (k == 0 ? "" : ".contacts");
      if (times_[k].steps == 0) continue;
      const double us[2] = {1e-3 * median(times_[k].blocks[0]), 1e-3 * median(times_[k].blocks[1])};
      report.set("together.us_in_turn." + key, us[0]);
      report.set("together.us." + key, us[1]);
      report.set("together.over_sequential." + key, us[1] / us[0]);
      if (k == 0) free_ratio = us[1] / us[0];
    }
    const auto steps = static_cast<double>(std::max<std::size_t>(times_[1].steps, 1));
    report.set("together.stopped_in_turn." + name, stopped_[0] / steps);
    report.set("together.stopped." + name, stopped_[1] / steps);
    return free_ratio;
  }

 private:
  Flock in_turn_, together_;
  std::size_t steps_ = 0;
  Times times_[2];          // of free steps and of those in which a vertex stops
  double stopped_[2] = {};  // vertices
};

const Variant kVariants[] = {{"", DSW_LEVEL_EDGES_SWEPT, 0},
                             {".edges", DSW_LEVEL_EDGES, 0},
                             {".edges_known", DSW_LEVEL_EDGES, DSW_BODY_SEQUENCES}};

/** A catheter is pushed along its line, then aside until it presses on the wall, step by step from where it is. */
double run_catheter_steps(const Options& options, Report& report) {
  const std::string line = options.data + "/vessels/vascular_phantom_centreline.csv";
  const bool is_real = !options.vessel.empty() && std::filesystem::exists(line);
  if (!is_real) std::printf("  no data: a generated vessel instead of the phantom\n");
  const VesselCase vessel(is_real ? options.vessel : "", line);
  const BodyShape shape = chain(kChainParticles);
  double ratio = 0;
  for (const Variant& each : kVariants) {
    Beside all(vessel.world.environment(), each, shape, chain_at(vessel.line, kChainParticles, 0));
    for (std::size_t step = 1; step <= (options.quick ? 2 : 8) * kStroke; ++step) {
      all.move(chain_at(vessel.line, kChainParticles, step));
    }
    scenes::Random random(43);
    for (int trial = 0; trial < (options.quick ? 10 : 60); ++trial) {
      Vector aside = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
      const double size = std::hypot(aside[0], aside[1], aside[2]);
      for (double& x : aside) x *= 2 * kPush / size;
      const std::size_t start = random.index(2 * kStroke);
      Beside pressed(vessel.world.environment(), each, shape, chain_at(vessel.line, kChainParticles, start));
      for (int step = 0; step < 80; ++step) {
        std::vector<double> targets = pressed.places();
        for (std::size_t i = 0; i < targets.size(); ++i) targets[i] += aside[i % 3];
        pressed.move(targets);
      }
      pressed.add_to(all);
    }
    const double of_level = all.report(std::string("catheter") + each.name, report);
    if (&each == kVariants) ratio = of_level;
  }
  return ratio;
}

/** The surface of figure 12 falls, presses on obstacles and is lifted again. */
double run_hand_steps(const Options& options, Report& report) {
  const Fall fall = make_fall(hand_path(options.data), kFineCube);
  World world(fall.pyramids.mesh, 1);
  mark_obstacles(world, fall);
  double ratio = 0;
  for (const Variant& each : kVariants) {
    Beside hand(world.environment(), each, fall.shape, fall.surface.points);
    const std::size_t steps = options.quick ? kFallSteps / 2 : 2 * kFallSteps;
    for (std::size_t step = 1; step <= steps; ++step) hand.move(place(fall, step));
    const double of_level = hand.report(std::string("hand") + each.name, report);
    if (&each == kVariants) ratio = of_level;
  }
  return ratio;
}

/** Bodies that a common motion carries. */
struct Carried {
  BodyShape shape;
  dsw_level level;
  std::vector<double> at;  // one after the other
};

constexpr double kTurn = 6.283185307179586;
constexpr double kMiddle = 5;  // of the lattice

Carried strands() {
  constexpr std::size_t kPoints = 21;
  Carried made{chain(kPoints), DSW_LEVEL_EDGES_SWEPT, {}};
  for (int y = 0; y < 3; ++y) {
    for (int z = 0; z < 3; ++z) {
      for (std::size_t i = 0; i < kPoints; ++i) {
        const double x = 0.1 * static_cast<double>(i) - 1;
        made.at.insert(made.at.end(), {kMiddle + x, kMiddle + 0.02 * y + 0.1 * std::sin(2 * x), kMiddle + 0.02 * z});
      }
    }
  }
  return made;
}

Carried coil() {
  constexpr std::size_t kPoints = 200;
  Carried made{chain(kPoints), DSW_LEVEL_EDGES_SWEPT, {}};
  for (std::size_t i = 0; i < kPoints; ++i) {
    const double turns = static_cast<double>(i) / 16;
    made.at.insert(made.at.end(), {kMiddle + 0.5 * std::cos(kTurn * turns), kMiddle + 0.5 * std::sin(kTurn * turns),
                                   kMiddle + 0.01 * turns});
  }
  return made;
}

/** A strip of triangles that is rolled up. */
Carried cloth() {
  constexpr std::uint32_t kPoints = 160;
  Carried made{{}, DSW_LEVEL_FACES, {}};
  made.shape.vertices = kPoints;
  for (std::uint32_t i = 0; i < kPoints; ++i) {
    const double angle = 0.35 * (i / 2), radius = 0.3 + 0.01 * angle;
    made.at.insert(made.at.end(), {kMiddle + radius * std::cos(angle), kMiddle + radius * std::sin(angle),
                                   kMiddle + (i % 2 == 0 ? 0.0 : 0.3)});
    if (i < 2) continue;
    const std::uint32_t a = i % 2 == 0 ? i - 2 : i - 1, b = i % 2 == 0 ? i - 1 : i - 2;
    made.shape.corners.insert(made.shape.corners.end(), {a, b, i});
  }
  return made;
}

Vector centre_of(const std::vector<double>& at) {
  Vector centre = {0, 0, 0};
  for (std::size_t i = 0; i < at.size(); ++i) centre[i % 3] += at[i] * 3 / static_cast<double>(at.size());
  return centre;
}

/** A turn by up to 30 degrees about the centre, and a way to a place near the middle. */
std::vector<double> carry(const std::vector<double>& at, scenes::Random& random) {
  constexpr double kMostTurn = kTurn / 12;
  const Vector centre = centre_of(at);
  Vector axis, to;
  double size = 0;
  do {
    for (double& x : axis) x = random.uniform(-1, 1);
    size = std::hypot(axis[0], axis[1], axis[2]);
  } while (size < 0.1 || size > 1);
  for (double& x : axis) x /= size;
  for (double& x : to) x = kMiddle + random.uniform(-1, 1);
  const double angle = random.uniform(-kMostTurn, kMostTurn), c = std::cos(angle), s = std::sin(angle);
  std::vector<double> image;
  for (std::size_t i = 0; i < at.size(); i += 3) {
    const Vector x = {at[i] - centre[0], at[i + 1] - centre[1], at[i + 2] - centre[2]};
    const double along = axis[0] * x[0] + axis[1] * x[1] + axis[2] * x[2];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
      const double across = axis[l] * x[m] - axis[m] * x[l];
      image.push_back(to[k] + c * x[k] + s * across + (1 - c) * along * axis[k]);
    }
  }
  return image;
}

/** Carries bodies rigidly, and counts the steps in which a vertex stops. */
void run_false_stops(const Options& options, Report& report) {
  const RopeSpace space;
  double sums[2] = {};
  const auto run = [&](const char* name, const Carried& carried, std::size_t steps) {
    const Variant variant{"", carried.level, DSW_BODY_SELF_CONTACTS};
    const auto make = [&](const std::vector<double>& at) {
      return std::make_unique<Flock>(space.environment(), variant, carried.shape, at, DSW_FEATURE_BODY_CONTACTS);
    };
    const auto together = make(carried.at);
    scenes::Random random(47);
    double stops[2] = {};
    for (std::size_t step = 0; step < steps; ++step) {
      std::vector<double> at;
      std::vector<dsw_volume_id> volumes;
      together->places(at, volumes);
      const std::vector<double> targets = carry(at, random);
      const auto in_turn = make(at);  // what has stopped has another shape, so each step begins anew
      in_turn->move(targets.data());
      together->move_together(targets.data(), DSW_TOGETHER_STOP_ALL);
      stops[0] += in_turn->stopped() != 0 ? 1 : 0;
      stops[1] += together->stopped() != 0 ? 1 : 0;
    }
    report.set(std::string("together.false_stops.") + name, stops[1]);
    report.set(std::string("together.false_stops_sequential.") + name, stops[0]);
    for (int mode = 0; mode < 2; ++mode) sums[mode] += stops[mode];
  };
  const std::size_t steps = options.quick ? 500 : 10000;
  run("strands", strands(), steps * 4 / 10);
  run("coil", coil(), steps * 3 / 10);
  run("cloth", cloth(), steps * 3 / 10);
  report.set("together.carried_steps", static_cast<double>(steps));
  report.set("together.false_stops", sums[1]);
  report.set("together.false_stops_sequential", sums[0]);
}

}  // namespace

void run_together(const Options& options, Report& report) {
  const double catheter = run_catheter_steps(options, report), hand = run_hand_steps(options, report);
  report.set("together.over_sequential", std::max(catheter, hand));
  run_false_stops(options, report);
}

}  // namespace dsw::bench
