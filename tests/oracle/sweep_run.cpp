#include "sweep_run.h"

#include "rounds.h"
#include "sweep_scenes.h"
#include "sweeps.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>

namespace dsw::oracle {
namespace {

/// Hands sweeps of like flags over in one call for each level, and compares.
void call(const Arena& arena, const dsw_environment* environment, const std::vector<const Sweep*>& sweeps,
          uint32_t flags, Rng& rng, SweepChecker& checker, SweepReport& report) {
  if (sweeps.empty()) return;
  const size_t dimension = arena.dimension, stride = dimension + (rng.chance(0.3) ? 2 : 0);
  std::vector<double> from, to, fixed;
  std::vector<dsw_volume_id> starts;
  for (const Sweep* s : sweeps) {
    for (auto [list, p] : {std::pair{&from, &s->from}, {&to, &s->to}, {&fixed, &s->fixed}}) {
      list->insert(list->end(), p->begin(), p->begin() + static_cast<ptrdiff_t>(dimension));
      list->resize(list->size() + stride - dimension, NAN);
    }
    const std::vector<dsw_volume_id>& ids = arena.ids();
    const dsw_volume_id right = s->truth.start >= 0 ? ids[static_cast<size_t>(s->truth.start)] : dsw_volume_id{0, 0};
    const bool known = (flags & DSW_SWEEP_START_KNOWN) != 0 || rng.chance(0.3);
    starts.push_back(known ? right : rng.chance(0.4) ? dsw_volume_id{0, 0} : ids[rng.below(ids.size())]);
  }
  const bool any_start = flags != 0 || rng.chance(0.8);
  dsw_sweep_options options = defaults(dsw_sweep_options_init);
  options.flags = flags;
  const auto ask = [&](size_t first, size_t count, dsw_sweep* reports) {
    std::memset(reports, 0xee, count * sizeof *reports);
    const size_t at = first * stride;
    const bool defaults =
        flags == 0 && options.level == DSW_LEVEL_EDGES_SWEPT && options.max_volumes == 0 && rng.chance(0.5);
    const dsw_status status = dsw_environment_sweep_edges(
        environment, count, any_start ? starts.data() + first : nullptr, from.data() + at, to.data() + at,
        fixed.data() + at, stride == dimension ? 0 : stride * sizeof(double), defaults ? nullptr : &options, reports);
    if (status != DSW_STATUS_OK) {
      report.fault(SweepReport::kWrong, std::string(dsw_status_string(status)) + ": " + dsw_last_error_message());
    }
    return status == DSW_STATUS_OK;
  };
  for (dsw_level level : {DSW_LEVEL_POINTS, DSW_LEVEL_EDGES, DSW_LEVEL_EDGES_SWEPT}) {
    options.level = level;
    options.max_volumes = 0;
    std::vector<dsw_sweep> reports(sweeps.size());
    if (!ask(0, sweeps.size(), reports.data())) continue;
    for (size_t i = 0; i < sweeps.size(); ++i) {
      const std::string how = " start " + std::to_string(starts[i].index) + "." + std::to_string(starts[i].generation) +
                              (any_start ? "" : " not given") + " flags " + std::to_string(flags);
      checker.compare(*sweeps[i], level, reports[i], how);
      if (!rng.chance(0.05)) continue;
      dsw_sweep limited;
      options.max_volumes = 1 + rng.below(reports[i].volumes_visited + 1);
      if (ask(i, 1, &limited)) checker.compare_limited(*sweeps[i], options.max_volumes, reports[i], limited, how);
      options.max_volumes = 0;
    }
  }
}

void one_scene(const SweepTurn& turn, uint64_t seed, uint64_t sweeps, SweepReport& report) {
  Rng rng(seed);
  const std::unique_ptr<Stage> stage = make_stage(turn, seed, rng, report);
  if (stage == nullptr) return;
  SpaceArena arena(stage->world, stage->marked_edges);
  StagePlaces places(*stage, rng);
  sweep_arena(arena, places, stage->environment.get(), sweeps, rng, report);
}

}  // namespace

void sweep_arena(Arena& arena, Places& places, dsw_environment* environment, uint64_t sweeps, Rng& rng,
                 SweepReport& report) {
  SweepChecker checker(arena, report);
  Sweeps source(arena, places, rng);
  std::vector<Sweep> all;
  for (uint64_t i = 0; i < sweeps; ++i) {
    all.push_back(source.next());
    report.sweep(all.back().truth, checker.may_start(all.back().truth));
    if (rng.chance(0.1)) checker.check_truth(all.back());
  }
  std::array<std::vector<const Sweep*>, 4> by_flags;
  for (const Sweep& s : all) {
    const uint32_t known = s.truth.start >= 0 && rng.chance(0.3) ? uint32_t{DSW_SWEEP_START_KNOWN} : 0;
    const uint32_t free = s.truth.start_free && rng.chance(0.3) ? uint32_t{DSW_SWEEP_START_FREE} : 0;
    by_flags[known | free].push_back(&s);
  }
  for (uint32_t flags = 0; flags < by_flags.size(); ++flags) {
    call(arena, environment, by_flags[flags], flags, rng, checker, report);
  }
}

void run_sweeps(const SweepRunOptions& options, SweepReport& report) {
  const std::vector<SweepTurn> turns = sweep_turns(options.only);
  const uint64_t each = std::min<uint64_t>(100, std::max<uint64_t>(10, options.sweeps / (turns.size() + 1)));
  run_rounds(
      turns, Rng(options.seed), options.sweeps, [&] { return report.total.sweeps; },
      [&](const SweepTurn& turn, uint64_t seed) { one_scene(turn, seed, each, report); });
}

std::string to_json(const SweepReport& report) {
  const SweepTally& t = report.total;
  const double all = t.sweeps == 0 ? 1 : static_cast<double>(t.sweeps);
  const std::pair<const char*, double> values[] = {
      {"sweeps", static_cast<double>(t.sweeps)},
      {"missed", static_cast<double>(t.missed)},
      {"late", static_cast<double>(t.late)},
      {"early", static_cast<double>(t.early)},
      {"wrong", static_cast<double>(t.wrong)},
      {"contacts", static_cast<double>(t.contacts)},
      {"edge_contacts", static_cast<double>(t.edge_contacts)},
      {"not_free", static_cast<double>(t.not_free)},
      {"ties_share", static_cast<double>(t.ties) / all},
      {"inside_only_share", static_cast<double>(t.inside_only) / all},
  };
  std::string text;
  for (const auto& [key, value] : values) {
    char line[128];
    std::snprintf(line, sizeof line, "%s  \"sweep.oracle.%s\": %.10g", text.empty() ? "{\n" : ",\n", key, value);
    text += line;
  }
  return text + "\n}\n";
}

}  // namespace dsw::oracle
