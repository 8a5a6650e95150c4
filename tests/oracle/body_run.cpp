#include "body_run.h"

#include "body_scenes.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>

namespace dsw::oracle {
namespace {

constexpr uint32_t kLossless[] = {DSW_BODY_SEQUENCES, DSW_BODY_SKIP_BY_ENVIRONMENT, DSW_BODY_SKIP_BY_CLEARANCE,
                                  DSW_BODY_SEQUENCES | DSW_BODY_SKIP_BY_ENVIRONMENT | DSW_BODY_SKIP_BY_CLEARANCE};
constexpr dsw_level kLevels[] = {DSW_LEVEL_POINTS, DSW_LEVEL_EDGES, DSW_LEVEL_EDGES_SWEPT, DSW_LEVEL_FACES};

ScenePtr scene_of(dsw_environment* environment) {
  dsw_scene* scene = nullptr;
  dsw_scene_create(environment, nullptr, &scene);
  return ScenePtr(scene);
}

/// Bodies of one level in one scene.
class Course {
 public:
  Course(Stage& stage, SweepWorld& exact, const SweepChecker& walls, dsw_scene* scene, dsw_level level, Rng& rng,
         BodyReport& report)
      : stage_(stage), exact_(exact), walls_(walls), scene_(scene), level_(level), rng_(rng), report_(report) {}

  /// A body that stops at what it touches, beside others that leave out work, all of the same bits.
  void stopping();
  void responding();
  /// Elimination by motion: nothing may be met where it ends, on the way something may be.
  void eliminating();

 private:
  bool create(BodyChecker& checker, Bodies& source, SweepReport& faults, uint32_t flags, BodyPlan& plan,
              dsw_body_id& body, BodyState& state);
  void compare_made(const BodyState& want, const BodyState& got, SweepReport& faults);
  dsw_move_options options_of(const BodyMove& move);
  bool moved(dsw_body_id body, const BodyMove& move, const dsw_move_options& options, BodyAnswer& answer,
             SweepReport& faults);

  Stage& stage_;
  SweepWorld& exact_;
  const SweepChecker& walls_;
  dsw_scene* scene_;
  dsw_level level_;
  Rng& rng_;
  BodyReport& report_;
};

void Course::compare_made(const BodyState& want, const BodyState& got, SweepReport& faults) {
  const auto sorted = [](auto list) {
    for (auto& part : list) std::sort(part.begin(), part.end());
    std::sort(list.begin(), list.end());
    return list;
  };
  if (got.at != want.at) faults.fault(SweepReport::kWrong, "a body is made elsewhere");
  if (sorted(got.edges) != sorted(want.edges) || sorted(got.faces) != sorted(want.faces)) {
    faults.fault(SweepReport::kWrong, "a body has other edges or faces than it was given");
  }
}

bool Course::create(BodyChecker& checker, Bodies& source, SweepReport& faults, uint32_t flags, BodyPlan& plan,
                    dsw_body_id& body, BodyState& state) {
  for (int tries = 0; tries < 20; ++tries) {
    plan = source.next();
    const BodyState want = state_of(plan);
    std::vector<dsw_volume_id> hints;
    const std::vector<dsw_volume_id>& ids = stage_.world.ids;
    if (rng_.chance(0.5)) {
      for (size_t v = 0; v < plan.at.size(); ++v) {
        hints.push_back(rng_.chance(0.4) ? dsw_volume_id{0, 0} : ids[rng_.below(ids.size())]);
      }
    }
    const dsw_status status = create_body(scene_, plan, level_, flags, hints, &body);
    bool outside = false, impassable = false;
    for (const Vec& p : plan.at) {
      const int cell = stage_.world.locate(stage_.world.body(p.data()));
      outside = outside || cell < 0;
      impassable = impassable || (cell >= 0 && stage_.world.cell_marked[static_cast<size_t>(cell)] != 0);
    }
    const std::vector<size_t> blocked = checker.blocked_edges(want, level_);
    const bool right = outside || impassable ? (outside && status == DSW_STATUS_OUTSIDE) ||
                                                   (impassable && status == DSW_STATUS_IMPASSABLE)
                                             : status == (blocked.empty() ? DSW_STATUS_OK : DSW_STATUS_OCCUPIED);
    if (!right) {
      std::string text = "creating a body answers " + std::string(dsw_status_string(status)) + ", outside " +
                         std::to_string(outside) + " impassable " + std::to_string(impassable) + " blocked " +
                         std::to_string(blocked.size()) + ":";
      for (const Vec& p : plan.at) text += " " + hex(p);
      for (const auto& e : want.edges) text += " " + std::to_string(e[0]) + "-" + std::to_string(e[1]);
      faults.fault(status == DSW_STATUS_OK ? SweepReport::kNotFreeAfter : SweepReport::kWrong, text);
    }
    if (status == DSW_STATUS_OCCUPIED) {
      const uint32_t* pairs = nullptr;
      size_t count = 0;
      dsw_scene_get_offending_edges(scene_, &pairs, &count);
      std::vector<std::array<uint32_t, 2>> got, must;
      for (size_t i = 0; i < count; ++i) {
        got.push_back({std::min(pairs[2 * i], pairs[2 * i + 1]), std::max(pairs[2 * i], pairs[2 * i + 1])});
      }
      for (size_t e : blocked) {
        must.push_back({std::min(want.edges[e][0], want.edges[e][1]), std::max(want.edges[e][0], want.edges[e][1])});
      }
      std::sort(got.begin(), got.end());
      std::sort(must.begin(), must.end());
      // Where edges themselves are not free, faces need not have been looked at; of a face one edge is enough.
      const std::vector<size_t> alone = checker.blocked_edges(want, std::min(level_, DSW_LEVEL_EDGES_SWEPT));
      const bool of_edges = std::all_of(alone.begin(), alone.end(), [&](size_t e) {
        const std::array<uint32_t, 2> ends = {std::min(want.edges[e][0], want.edges[e][1]),
                                              std::max(want.edges[e][0], want.edges[e][1])};
        return std::binary_search(got.begin(), got.end(), ends);
      });
      if (got.empty() || !of_edges || !std::includes(must.begin(), must.end(), got.begin(), got.end()) ||
          (level_ != DSW_LEVEL_FACES && got != must)) {
        faults.fault(SweepReport::kWrong,
                     std::to_string(count) + " offending edges for " + std::to_string(must.size()));
      }
    }
    if (status != DSW_STATUS_OK) {
      ++report_.refused;
      continue;
    }
    ++report_.bodies;
    const std::string fault = read_body(scene_, body, state);
    if (!fault.empty()) {
      faults.fault(SweepReport::kWrong, "a new body: " + fault);
      dsw_body_destroy(scene_, body);
      return false;
    }
    compare_made(want, state, faults);
    checker.placed(state, level_, "a new body");
    return true;
  }
  return false;
}

dsw_move_options Course::options_of(const BodyMove& move) {
  dsw_move_options options;
  dsw_move_options_init(&options, sizeof options);
  const double distances[] = {0, 0, -1, 1e-3 * stage_.world.size};
  options.stand_off = distances[rng_.below(4)];
  if (move.all) options.search = DSW_SEARCH_ALL;
  options.order = move.order.data();
  options.order_count = move.order.size();
  return options;
}

bool Course::moved(dsw_body_id body, const BodyMove& move, const dsw_move_options& options, BodyAnswer& answer,
                   SweepReport& faults) {
  const std::string fault = move_body(scene_, body, move.targets, &options, answer);
  if (!fault.empty()) faults.fault(SweepReport::kWrong, fault);
  return fault.empty();
}

void Course::stopping() {
  SweepReport& faults = report_.at(level_);
  BodyChecker checker(stage_.world, exact_, walls_, faults);
  Bodies source(stage_, exact_, rng_, level_);
  BodyPlan plan;
  BodyState state;
  dsw_body_id body;
  const uint32_t flags = rng_.chance(0.5) ? 0 : kLossless[rng_.below(4)];
  if (!create(checker, source, faults, flags, plan, body, state)) return;
  std::vector<dsw_body_id> twins;
  if (rng_.chance(0.25)) {
    for (uint32_t twin_flags : kLossless) {
      dsw_body_id twin;
      if (create_body(scene_, plan, level_, flags == twin_flags ? 0 : twin_flags, {}, &twin) == DSW_STATUS_OK) {
        twins.push_back(twin);
      } else {
        faults.fault(SweepReport::kWrong, std::string("a twin is refused: ") + dsw_last_error_message());
      }
    }
  }
  report_.twins += twins.size();
  const int moves = rng_.between(4, 14);
  BodyAnswer answer, other;
  for (int i = 0; i < moves; ++i) {
    BodyMove move = source.move(state);
    move.all = rng_.chance(0.1);
    dsw_move_options options = options_of(move);
    if (move.order.size() == plan.at.size() && rng_.chance(0.5)) {
      std::sort(move.order.begin(), move.order.end());
      options.order = nullptr;
      options.order_count = 0;
    }
    if (!moved(body, move, options, answer, faults)) break;
    const std::string how = " flags " + std::to_string(flags) + (move.all ? " all" : "") + " order of " +
                            std::to_string(move.order.size()) + " move " + std::to_string(i);
    move.stand_off = options.stand_off > 0;
    checker.replay(state, move, level_, answer, how);
    const std::string bits = bits_of(answer);
    for (size_t t = 0; t < twins.size(); ++t) {
      if (!moved(twins[t], move, options, other, faults) || bits_of(other) == bits) continue;
      faults.fault(SweepReport::kWrong, "twin " + std::to_string(t) + " of flags" + how + " has other bits");
    }
    state = answer.after;
  }
  report_.time_error = std::max(report_.time_error, checker.time_error);
  for (dsw_body_id twin : twins) dsw_body_destroy(scene_, twin);
  if (dsw_body_destroy(scene_, body) != DSW_STATUS_OK) faults.fault(SweepReport::kWrong, dsw_last_error_message());
}

void Course::responding() {
  SweepReport& faults = report_.at(level_);
  BodyChecker checker(stage_.world, exact_, walls_, faults);
  Bodies source(stage_, exact_, rng_, level_);
  BodyPlan plan;
  BodyState state;
  dsw_body_id body;
  if (!create(checker, source, faults, rng_.chance(0.5) ? 0 : kLossless[rng_.below(4)], plan, body, state)) return;
  BodyAnswer answer;
  for (int i = 0; i < 8; ++i) {
    const BodyMove move = source.move(state);
    dsw_move_options options = options_of(move);
    options.vertex_response = rng_.chance(0.5) ? DSW_RESPONSE_STOP : DSW_RESPONSE_SLIDE;
    options.edge_response = static_cast<dsw_response>(rng_.below(5));
    options.min_part = rng_.chance(0.5) ? 0 : 0.02;
    options.noise_share = rng_.chance(0.5) ? 0 : 0.05;
    if (!moved(body, move, options, answer, faults)) break;
    ++report_.responses;
    report_.edits += answer.report.edit_count;
    const std::string how = " responses " + std::to_string(options.vertex_response) + " and " +
                            std::to_string(options.edge_response) + " move " + std::to_string(i);
    for (const dsw_contact& c : answer.contacts) checker.alone(c, how);
    checker.placed(answer.after, level_, "after" + how);
    state = answer.after;
  }
  dsw_body_destroy(scene_, body);
}

void Course::eliminating() {
  BodyChecker checker(stage_.world, exact_, walls_, report_.hybrid);
  Bodies source(stage_, exact_, rng_, level_);
  BodyPlan plan;
  BodyState state;
  dsw_body_id body;
  if (!create(checker, source, report_.hybrid, DSW_BODY_SKIP_BY_MOTION, plan, body, state)) return;
  BodyAnswer answer;
  for (int i = 0; i < 12; ++i) {
    BodyMove move = source.move(state);
    move.drops = true;
    // Short steps are what it is for.
    const double share = rng_.chance(0.8) ? 0.02 : 1;
    for (size_t v = 0; v < move.targets.size(); ++v) {
      for (size_t k = 0; k < 3; ++k) {
        const double x = state.at[v][k] + share * (move.targets[v][k] - state.at[v][k]);
        move.targets[v][k] = std::isfinite(x) ? x : state.at[v][k];
      }
    }
    if (!moved(body, move, options_of(move), answer, report_.hybrid)) break;
    checker.replay(state, move, level_, answer, " elimination by motion, move " + std::to_string(i));
    state = answer.after;
  }
  report_.hybrid_contacts += checker.true_contacts;
  report_.hybrid_dropped += checker.dropped;
  dsw_body_destroy(scene_, body);
}

void one_scene(const SweepTurn& turn, uint64_t seed, uint64_t steps, const BodyRunOptions& options,
               BodyReport& report) {
  Rng rng(seed);
  for (SweepReport& r : report.levels)
    r.begin(turn.kind->name,
            std::string(turn.kind->name) + transform_name(turn.transform) + " scene seed " + std::to_string(seed));
  report.hybrid.begin(turn.kind->name, "scene seed " + std::to_string(seed));
  const std::unique_ptr<Stage> stage = make_stage(turn, seed, rng, report.levels[0]);
  if (stage == nullptr) return;
  stage->mark_vertices(rng, report.levels[0]);
  SweepWorld exact(stage->world, stage->wires, stage->marked_vertices);
  const SweepChecker walls(stage->world, exact, report.levels[0]);
  const ScenePtr scene = scene_of(stage->environment.get());
  for (dsw_level level : kLevels) {
    if (options.level != 0 && options.level != level) continue;
    // A level's sequence is its own: it can be run alone.
    Rng own(seed + static_cast<uint64_t>(level));
    Course course(*stage, exact, walls, scene.get(), level, own, report);
    const uint64_t before = report.at(level).total.sweeps;
    for (int bodies = 0; bodies < 40 && report.at(level).total.sweeps < before + steps; ++bodies) course.stopping();
    if (options.responses) course.responding();
    if (level == DSW_LEVEL_EDGES) course.eliminating();
  }
}

}  // namespace

uint64_t BodyReport::faults() const {
  uint64_t sum = hybrid.total.faults();
  for (const SweepReport& level : levels) sum += level.total.faults();
  return sum;
}

void run_bodies(const BodyRunOptions& options, BodyReport& report) {
  std::vector<SweepTurn> turns;
  for (const SweepTurn& turn : sweep_turns(options.only)) {
    const bool with_ties = turn.kind->integer && turn.transform == Transform::kNone;
    turns.insert(turns.end(), with_ties ? 3 : 1, turn);
  }
  Rng rng(options.seed);
  const uint64_t each = std::min<uint64_t>(150, std::max<uint64_t>(20, options.steps / (turns.size() + 1)));
  const auto least = [&]() {
    uint64_t steps = UINT64_MAX;
    for (dsw_level level : kLevels) {
      if (options.level == 0 || options.level == level) steps = std::min(steps, report.at(level).total.sweeps);
    }
    return steps;
  };
  while (least() < options.steps && !turns.empty()) {
    const uint64_t before = least();
    for (const SweepTurn& turn : turns) {
      const uint64_t seed = rng.next() >> 1;
      if (least() < options.steps) one_scene(turn, seed, each, options, report);
    }
    if (least() == before) break;  // a defect that keeps every body from being made
  }
  report.bisection_slope = bisection_slope(options.seed, report);
}

std::string to_json(const BodyReport& report) {
  static const char* const names[] = {"points", "edges", "edges_swept", "faces"};
  std::string text;
  const auto add = [&](const std::string& key, double value) {
    char line[128];
    std::snprintf(line, sizeof line, "%s  \"%s\": %.10g", text.empty() ? "{\n" : ",\n", key.c_str(), value);
    text += line;
  };
  const auto share = [](uint64_t part, uint64_t all) {
    return all == 0 ? 0 : static_cast<double>(part) / static_cast<double>(all);
  };
  uint64_t not_free = 0;
  for (size_t i = 0; i < 4; ++i) {
    const SweepTally& t = report.levels[i].total;
    const std::pair<const char*, uint64_t> counts[] = {
        {"steps", t.sweeps},
        {"missed", t.missed},
        {"late", t.late},
        {"early", t.early},
        {"wrong", t.wrong},
        {"not_free_after", t.not_free_after},
        {"contacts", t.contacts},
        {"edge_contacts", t.edge_contacts},
        {"face_contacts", t.face_contacts},
        {"stuck", t.stuck},
    };
    const std::string prefix = std::string("body.oracle.") + names[i] + ".";
    for (const auto& [key, value] : counts) add(prefix + key, static_cast<double>(value));
    add(prefix + "ties_share", share(t.ties, t.sweeps));
    add(prefix + "inside_only_share", share(t.inside_only, t.contacts));  // of the contacts
    not_free += t.not_free_after;
  }
  add("body.oracle.bodies", static_cast<double>(report.bodies));
  add("body.oracle.refused", static_cast<double>(report.refused));
  add("body.oracle.twins", static_cast<double>(report.twins));
  add("body.oracle.responses", static_cast<double>(report.responses));
  add("body.oracle.edits", static_cast<double>(report.edits));
  add("sweep.oracle.not_free_after", static_cast<double>(not_free + report.hybrid.total.not_free_after));
  add("edges.hybrid_missed_share", share(report.hybrid_dropped, report.hybrid_contacts));
  add("edges.hybrid_contacts", static_cast<double>(report.hybrid_contacts));
  add("edges.hybrid_not_free_after", static_cast<double>(report.hybrid.total.not_free_after));
  add("contact.time_error_exact", report.time_error);
  add("contact.bisection_slope", report.bisection_slope);
  return text + "\n}\n";
}

}  // namespace dsw::oracle
