// Swept edges and bodies in the plane.
#include "body_run.h"
#include "plane_arena.h"
#include "plane_run.h"
#include "plane_scenes.h"
#include "rounds.h"
#include "sweep_run.h"

#include <algorithm>

namespace dsw::oracle {
namespace {

constexpr uint64_t kLevels = 3;

struct Reports {
  explicit Reports(int print_most) : alone(print_most), bodies(print_most) {}
  uint64_t sweeps() const {
    uint64_t sum = alone.total.sweeps;
    for (const SweepReport& level : bodies.levels) sum += level.total.sweeps;
    return sum;
  }

  SweepReport alone;
  BodyReport bodies;
};

void one_scene(const plane::Turn& turn, uint64_t seed, uint64_t sweeps, const BodyRunOptions& options,
               Reports& reports) {
  Rng rng(seed);
  const std::string what = turn.name() + " scene seed " + std::to_string(seed);
  reports.alone.begin(turn.kind->name, what);
  reports.bodies.begin(turn.kind->name, what);
  plane::World world = plane::make_world(turn, rng);
  const EnvironmentPtr environment = make_environment(turn, world, rng);
  if (environment == nullptr) {
    if (!turn.may_be_refused()) reports.alone.fault(SweepReport::kWrong, dsw_last_error_message());
    return;
  }
  static const double cells[] = {0, 0, 0.05, 0.2}, sides[] = {0, 0.03, 0.1, 0.2}, vertices[] = {0, 0.05, 0.1, 0.4};
  std::vector<int> marked;
  const plane::Shares shares = {cells[rng.below(4)], sides[rng.below(4)], vertices[rng.below(4)]};
  const std::string fault = plane::mark(world, environment.get(), shares, rng, marked);
  if (!fault.empty()) return reports.alone.fault(SweepReport::kWrong, fault);
  PlaneArena arena(world, marked);
  const auto places_for = [&](Rng& own) { return std::make_unique<PlanePlaces>(world, arena, marked, own); };
  if (options.level == 0) sweep_arena(arena, *places_for(rng), environment.get(), sweeps, rng, reports.alone);
  bodies_in_arena(arena, places_for, environment.get(), seed, std::max<uint64_t>(1, sweeps / kLevels), options,
                  reports.bodies);
}

}  // namespace

void run_plane_sweeps(const PlaneRunOptions& options, int print_most, PlaneReport& report) {
  Reports reports(print_most);
  BodyRunOptions bodies;
  bodies.level = options.level;
  const std::vector<plane::Turn> turns = plane::turns(options.only);
  const uint64_t each = std::min<uint64_t>(150, std::max<uint64_t>(15, options.sweeps / (turns.size() + 1)));
  const auto one = [&](const plane::Turn& turn, uint64_t seed) { one_scene(turn, seed, each, bodies, reports); };
  if (options.scene_seed != 0) {
    for (const plane::Turn& turn : turns) one(turn, options.scene_seed);
  } else {
    run_rounds(
        turns, Rng(options.seed << 20), options.sweeps, [&] { return reports.sweeps(); }, one);
  }
  report.sweeps = reports.sweeps();
  const auto add = [&](const SweepTally& t) {
    report.contacts += t.contacts;
    report.vertex_contacts += t.edge_contacts;
    report.inside_only += t.inside_only;
    report.ties += t.ties;
    report.stuck += t.stuck;
    report.missed += t.missed;
    report.late += t.late;
    report.not_free_after += t.not_free_after;
    report.wrong += t.wrong + t.early;
  };
  add(reports.alone.total);
  add(reports.bodies.similar.total);
  for (const SweepReport& level : reports.bodies.levels) add(level.total);
  report.bodies = reports.bodies.bodies;
  report.twins = reports.bodies.twins;
  report.responses = reports.bodies.responses;
  report.edits = reports.bodies.edits + reports.bodies.body_edits;
  report.time_error = reports.bodies.time_error;
}

}  // namespace dsw::oracle
