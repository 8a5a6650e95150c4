// Back-edge elimination [JCD10] 6.2 and hybrid elimination 6.3: closed bodies that drift, swell and bend among the
// obstacles of the swept scenes, every vertex's step against exact arithmetic.
#include "back_edges.h"

#include "body_check.h"
#include "rounds.h"
#include "sweep_scenes.h"

#include <algorithm>
#include <cmath>

namespace dsw::oracle {
namespace {

constexpr uint32_t kFlags[] = {DSW_BODY_SKIP_BACK_EDGES, DSW_BODY_SKIP_BACK_EDGES | DSW_BODY_SKIP_BY_ENVIRONMENT,
                               DSW_BODY_SKIP_BACK_EDGES | DSW_BODY_SEQUENCES};
constexpr uint32_t kOthers[] = {0, DSW_BODY_SKIP_BY_CLEARANCE};
constexpr int kMoves = 10;  // of a body

/// A closed body, its faces counter-clockwise seen from outside: a tetrahedron, an octahedron or a cube.
BodyPlan unit_body(Rng& rng) {
  switch (rng.below(3)) {
    case 0:
      return {{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}, {}, {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}};
    case 1: {
      BodyPlan plan;
      plan.at = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
      for (uint32_t i = 0; i < 4; ++i) {
        plan.faces.push_back({i, (i + 1) % 4, 4});
        plan.faces.push_back({(i + 1) % 4, i, 5});
      }
      return plan;
    }
    default: {
      BodyPlan plan;
      for (int i = 0; i < 8; ++i) plan.at.push_back({i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0});
      plan.faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
      return plan;
    }
  }
}

class ClosedBody {
 public:
  ClosedBody(Arena& arena, Places& places, dsw_scene* scene, Rng& rng, BackEdgeReport& report)
      : arena_(arena), places_(places), scene_(scene), rng_(rng), report_(report), checker_(arena, report.faults) {}

  void run() {
    BodyPlan plan = unit_body(rng_);
    static const double scales[] = {0.01, 0.03, 0.1};
    radius_ = scales[rng_.below(3)] * arena_.size();
    const Vec centre = rng_.chance(0.5) ? places_.near(places_.obstacle(0.5), 0.1) : places_.start();
    for (Vec& p : plan.at) {
      for (size_t k = 0; k < 3; ++k) p[k] = centre[k] + radius_ * (p[k] + rng_.range(-0.3, 0.3));
    }
    dsw_body_id body;
    const uint32_t left = rng_.chance(0.5) ? DSW_BODY_LEAVE_BACK_EDGES : 0;
    const uint32_t flags = kFlags[rng_.below(3)] | kOthers[rng_.below(2)] | left;
    const dsw_status status = create_body(scene_, plan, DSW_LEVEL_EDGES, flags, {}, &body);
    if (status != DSW_STATUS_OK) {
      const bool right = status == DSW_STATUS_OUTSIDE || status == DSW_STATUS_IMPASSABLE ||
                         status == DSW_STATUS_OCCUPIED || status == DSW_STATUS_NON_FINITE ||
                         (status == DSW_STATUS_NOT_ORIENTED && !(radius_ > 1e-9 * std::fabs(centre[0])));
      if (!right) report_.faults.fault(SweepReport::kWrong, std::string("not made: ") + dsw_last_error_message());
      return;
    }
    BodyState state;
    const std::string fault = read_body(scene_, body, state);
    if (!fault.empty()) report_.faults.fault(SweepReport::kWrong, "a new body: " + fault);
    for (int i = 0; i < kMoves && fault.empty(); ++i) {
      if (!move(body, state)) break;
    }
    dsw_body_destroy(scene_, body);
    report_.contacts += checker_.true_contacts;
    report_.missed += checker_.dropped;
  }

 private:
  bool move(dsw_body_id body, BodyState& state) {
    BodyMove move;
    move.drops = true;
    for (uint32_t v = 0; v < state.at.size(); ++v) move.order.push_back(v);
    if (rng_.chance(0.5)) {
      for (size_t i = move.order.size(); i > 1; --i) std::swap(move.order[i - 1], move.order[rng_.below(i)]);
    }
    move.targets = state.at;
    Vec middle = {0, 0, 0}, drift;
    for (const Vec& p : state.at) {
      for (size_t k = 0; k < 3; ++k) middle[k] += p[k] / static_cast<double>(state.at.size());
    }
    static const double ways[] = {0.05, 0.2, 0.6};  // of a body's radius: small against it, as the paper has them
    const double way = ways[rng_.below(3)] * radius_, swell = rng_.range(-0.2, 0.2), bend = rng_.range(0, 0.3);
    for (double& x : drift) x = way * rng_.range(-1, 1);
    for (Vec& p : move.targets) {
      for (size_t k = 0; k < 3; ++k) p[k] += drift[k] + swell * (p[k] - middle[k]) + bend * way * rng_.range(-1, 1);
      if (!finite(p)) return false;
    }
    dsw_move_options options = defaults(dsw_move_options_init);
    options.order = move.order.data();
    options.order_count = move.order.size();
    BodyAnswer answer;
    const std::string fault = move_body(scene_, body, move.targets, &options, answer);
    if (!fault.empty()) {
      report_.faults.fault(SweepReport::kWrong, fault);
      return false;
    }
    checker_.replay(state, move, DSW_LEVEL_EDGES, answer, " back edges");
    report_.left += answer.after.untested.size();
    for (const size_t e : checker_.blocked_edges(answer.after, DSW_LEVEL_EDGES)) {
      const uint32_t index = answer.after.edge_ids[e].index;
      report_.crossed += std::count(answer.after.untested.begin(), answer.after.untested.end(), index) != 0 ? 1 : 0;
    }
    ++report_.moves;
    report_.swept += answer.report.edges_swept;
    report_.skipped += answer.report.edges_skipped;
    state = answer.after;
    return true;
  }

  Arena& arena_;
  Places& places_;
  dsw_scene* scene_;
  Rng& rng_;
  BackEdgeReport& report_;
  BodyChecker checker_;
  double radius_ = 0;
};

void one_scene(const SweepTurn& turn, uint64_t seed, BackEdgeReport& report) {
  Rng rng(seed);
  report.faults.begin(turn.kind->name, std::string(turn.kind->name) + transform_name(turn.transform) + " scene seed " +
                                           std::to_string(seed));
  const std::unique_ptr<Stage> stage = make_stage(turn, seed, rng, report.faults);
  if (stage == nullptr) return;
  SpaceArena arena(stage->world, stage->marked_edges);
  StagePlaces places(*stage, rng);
  dsw_scene* made = nullptr;
  dsw_scene_create(stage->environment.get(), nullptr, &made);
  const ScenePtr scene(made);
  for (int bodies = 0; bodies < 20; ++bodies) ClosedBody(arena, places, scene.get(), rng, report).run();
}

}  // namespace

void run_back_edges(uint64_t moves, uint64_t seed, BackEdgeReport& report) {
  run_rounds(
      sweep_turns(""), Rng(seed << 21), moves, [&] { return report.moves; },
      [&](const SweepTurn& turn, uint64_t scene_seed) { one_scene(turn, scene_seed, report); });
}

std::string to_json(const BackEdgeReport& report) {
  const auto share = [](uint64_t part, uint64_t all) {
    return all == 0 ? 0 : static_cast<double>(part) / static_cast<double>(all);
  };
  const SweepTally& t = report.faults.total;
  char text[800];
  std::snprintf(text, sizeof text,
                "{\n  \"edges.back_edge_moves\": %.10g,\n  \"edges.back_edge_contacts\": %.10g,\n"
                "  \"edges.back_edge_not_free_after\": %.10g,\n  \"edges.back_edge_missed_share\": %.10g,\n"
                "  \"edges.back_edge_skipped_share\": %.10g,\n  \"edges.back_edge_faults\": %.10g,\n"
                "  \"edges.back_edge_untested\": %.10g,\n  \"edges.back_edge_untested_crossed\": %.10g\n}\n",
                static_cast<double>(report.moves), static_cast<double>(report.contacts),
                static_cast<double>(t.not_free_after), share(report.missed, report.contacts),
                share(report.skipped, report.swept), static_cast<double>(t.faults()), static_cast<double>(report.left),
                static_cast<double>(report.crossed));
  return text;
}

}  // namespace dsw::oracle
