// Bisection, which is not told the exact time: how much earlier than that the reported one is, at every depth.
#include "body_run.h"
#include "body_scenes.h"
#include "sweep_scenes.h"

#include <cmath>
#include <cstdio>

namespace dsw::oracle {

double bisection_slope(uint64_t seed, BodyReport& report) {
  constexpr uint32_t kFirst = 4, kLast = 40;
  constexpr int kMoves = 300;
  SweepReport& faults = report.at(DSW_LEVEL_EDGES_SWEPT);
  // One convex cell: whatever moves out of it meets one plane, with a vertex.
  const Mesh mesh = hex_grid({0, 1}, {0, 1}, {0, 1});
  faults.begin("bisection", "bisection seed " + std::to_string(seed));
  Stage stage(mesh, create_environment(mesh));
  dsw_scene* made = nullptr;
  if (dsw_scene_create(stage.environment.get(), nullptr, &made) != DSW_STATUS_OK) return 0;
  const ScenePtr scene(made);
  SpaceArena arena(stage.world);
  Rng rng(seed);
  const auto inside = [&]() { return Vec{rng.range(0.1, 0.9), rng.range(0.1, 0.9), rng.range(0.1, 0.9)}; };
  double errors[kLast + 1] = {0};
  int counted[kLast + 1] = {0};
  for (int i = 0; i < kMoves; ++i) {
    BodyPlan plan;
    plan.at = {inside(), inside()};
    plan.edges = {{0, 1}};
    std::vector<Vec> targets = {inside(), plan.at[1]};
    targets[0][rng.below(3)] += rng.chance(0.5) ? 1.5 : -1.5;
    const MoveTruth truth = arena.exact.move({plan.at[0], targets[0], {plan.at[1]}, {}}, DSW_LEVEL_EDGES_SWEPT);
    if (truth.events.empty() || truth.events[0].triangle < 0) continue;
    const SweepEvent& e = truth.events[0];
    const mpq_class time = mpq_class(e.numerator.c[e.order]) / mpq_class(e.denominator.c[e.order]);
    for (uint32_t depth = kFirst; depth <= kLast; ++depth) {
      dsw_body_id body;
      BodyAnswer answer;
      dsw_move_options options = defaults(dsw_move_options_init);
      options.search = DSW_SEARCH_BISECTION;
      options.bisection_depth = depth;
      options.stand_off = -1;
      if (create_body(scene.get(), plan, DSW_LEVEL_EDGES_SWEPT, 0, {}, &body) != DSW_STATUS_OK) continue;
      const std::string fault = move_body(scene.get(), body, targets, &options, answer);
      if (!fault.empty() || answer.contacts.size() != 1) {
        faults.fault(SweepReport::kMissed, "bisection of depth " + std::to_string(depth) + ": " + fault);
      } else {
        const double error = mpq_class(time - mpq_class(answer.contacts[0].time)).get_d();
        // Free at that time, and never further from the exact one than the last interval is long.
        if (!(error >= 0 && error <= std::ldexp(1, -static_cast<int>(depth)))) {
          char text[120];
          std::snprintf(text, sizeof text, "bisection of depth %u at %a, %g before the contact", depth,
                        answer.contacts[0].time, error);
          faults.fault(error < 0 ? SweepReport::kLate : SweepReport::kEarly, text);
        }
        errors[depth] += error;
        ++counted[depth];
      }
      dsw_body_destroy(scene.get(), body);
    }
  }
  // Least squares.
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (uint32_t depth = kFirst; depth <= kLast; ++depth) {
    if (counted[depth] == 0 || !(errors[depth] > 0)) continue;
    const double log = std::log2(errors[depth] / counted[depth]);
    n += 1;
    x += depth;
    y += log;
    xx += static_cast<double>(depth) * depth;
    xy += depth * log;
  }
  return n < 2 ? 0 : (n * xy - x * y) / (n * xx - x * x);
}

}  // namespace dsw::oracle
