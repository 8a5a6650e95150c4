#include "body_course.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace dsw::oracle {
namespace {

constexpr uint32_t kLossless[] = {DSW_BODY_SEQUENCES, DSW_BODY_NO_SEQUENCES, DSW_BODY_SKIP_BY_ENVIRONMENT,
                                  DSW_BODY_SKIP_BY_CLEARANCE | DSW_BODY_NO_SEQUENCES,
                                  DSW_BODY_SEQUENCES | DSW_BODY_SKIP_BY_ENVIRONMENT | DSW_BODY_SKIP_BY_CLEARANCE};

}  // namespace

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
    const std::vector<dsw_volume_id>& ids = arena_.ids();
    if (rng_.chance(0.5)) {
      for (size_t v = 0; v < plan.at.size(); ++v) {
        hints.push_back(rng_.chance(0.4) ? dsw_volume_id{0, 0} : ids[rng_.below(ids.size())]);
      }
    }
    const dsw_status status = create_body(scene_, plan, level_, flags, hints, &body);
    bool outside = false, impassable = false;
    for (const Vec& p : plan.at) {
      const int cell = arena_.locate(p);
      outside = outside || cell < 0;
      impassable = impassable || (cell >= 0 && arena_.marked(cell));
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
  dsw_move_options options = defaults(dsw_move_options_init);
  const double distances[] = {0, 0, -1, 1e-3 * arena_.size()};
  options.stand_off = distances[rng_.below(4)];
  if (move.all) options.search = DSW_SEARCH_EXHAUSTIVE;
  options.order = move.order.data();
  options.order_count = move.order.size();
  return options;
}

bool Course::moved(dsw_body_id body, const BodyMove& move, const dsw_move_options& options, BodyAnswer& answer,
                   SweepReport& faults) {
  const std::string fault = move_body(scene_, body, move.targets, &options, answer);
  if (!fault.empty()) faults.fault(SweepReport::kWrong, fault);
  for (const dsw_body_contact& contact : answer.contacts) {
    if (arena_.dimension == 2) break;  // libccd knows space alone
    if (report_.cross_checks.ask(environment_, contact)) continue;
    faults.fault(SweepReport::kWrong, std::string("a question for a cross-check: ") + dsw_last_error_message());
  }
  return fault.empty();
}

void Course::stopping() {
  SweepReport& faults = report_.at(level_);
  BodyChecker checker(arena_, faults);
  Bodies source(arena_, places_, rng_, level_);
  BodyPlan plan;
  BodyState state;
  dsw_body_id body;
  const uint32_t flags = rng_.chance(0.5) ? 0 : kLossless[rng_.below(std::size(kLossless))];
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
  std::vector<dsw_body_contact> before;
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
    checker.history(before, answer.contacts, how);
    before = answer.contacts;
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
  BodyChecker checker(arena_, faults);
  Bodies source(arena_, places_, rng_, level_);
  BodyPlan plan;
  BodyState state;
  dsw_body_id body;
  if (!create(checker, source, faults, rng_.chance(0.5) ? 0 : kLossless[rng_.below(4)], plan, body, state)) return;
  BodyAnswer answer;
  for (int i = 0; i < 8; ++i) {
    const BodyMove move = source.move(state);
    dsw_move_options options = options_of(move);
    options.vertex_response = rng_.chance(0.5) ? DSW_RESPONSE_STOP : DSW_RESPONSE_SLIDE;
    options.edge_response = static_cast<dsw_response>(rng_.below(6));
    options.min_part = rng_.chance(0.5) ? 0 : 0.02;
    options.noise_share = rng_.chance(0.5) ? 0 : 0.05;
    const bool bisects = rng_.chance(0.15);  // then it is free all the same, and no more is promised
    if (bisects) options.search = DSW_SEARCH_BISECTION;
    if (!moved(body, move, options, answer, faults)) break;
    ++report_.responses;
    report_.edits += answer.report.edit_count;
    const std::string how = " responses " + std::to_string(options.vertex_response) + " and " +
                            std::to_string(options.edge_response) + " move " + std::to_string(i);
    for (const dsw_body_contact& c : answer.contacts) {
      if (!bisects) checker.alone(c, how);
    }
    checker.placed(answer.after, level_, "after" + how);
    state = answer.after;
  }
  dsw_body_destroy(scene_, body);
}

void Course::eliminating() {
  BodyChecker checker(arena_, report_.similar);
  Bodies source(arena_, places_, rng_, level_);
  BodyPlan plan;
  BodyState state;
  dsw_body_id body;
  if (!create(checker, source, report_.similar, DSW_BODY_SKIP_SIMILAR_MOTION, plan, body, state)) return;
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
    if (!moved(body, move, options_of(move), answer, report_.similar)) break;
    checker.replay(state, move, level_, answer, " similar motion, move " + std::to_string(i));
    state = answer.after;
  }
  report_.similar_contacts += checker.true_contacts;
  report_.similar_dropped += checker.dropped;
  dsw_body_destroy(scene_, body);
}

}  // namespace dsw::oracle
