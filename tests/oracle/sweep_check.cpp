#include "sweep_check.h"

#include <cmath>
#include <cstdio>

namespace dsw::oracle {
namespace {

bool same(const double* a, const double* b) { return a[0] == b[0] && a[1] == b[1] && a[2] == b[2]; }

}  // namespace

void SweepReport::begin(const std::string& scene, const std::string& reproduce) {
  scene_ = &scenes[scene];
  reproduce_ = reproduce;
}

void SweepReport::sweep(const SweepTruth& truth, bool may_start) {
  for (SweepTally* t : {&total, scene_}) {
    ++t->sweeps;
    t->ties += truth.tie;
    if (!may_start) {
      ++t->not_free;
      continue;
    }
    t->contacts += !truth.swept.empty();
    t->edge_contacts += !truth.swept.empty() && truth.swept[0].triangle < 0;
    t->inside_only += !truth.swept.empty() && !truth.path_hit && !truth.new_edge_hit;
  }
}

void SweepReport::step(const MoveTruth& truth) {
  for (SweepTally* t : {&total, scene_}) {
    ++t->sweeps;
    t->ties += truth.tie;
    if (truth.events.empty()) continue;
    ++t->contacts;
    t->edge_contacts += truth.events[0].edge >= 0;
    t->face_contacts += truth.events[0].face >= 0;
    t->inside_only += truth.inside_only();
  }
}

void SweepReport::stuck() {
  for (SweepTally* t : {&total, scene_}) ++t->stuck;
}

void SweepReport::fault(Fault fault, const std::string& text) {
  static const char* const names[] = {"MISSED", "LATE", "EARLY", "WRONG", "NOT FREE"};
  for (SweepTally* t : {&total, scene_}) {
    uint64_t* const counts[] = {&t->missed, &t->late, &t->early, &t->wrong, &t->not_free_after};
    ++*counts[fault];
  }
  if (printed_++ < print_most_) std::printf("%s [%s] %s\n", names[fault], reproduce_.c_str(), text.c_str());
  std::fflush(stdout);
}

bool SweepChecker::may_start(const SweepTruth& truth) const { return arena_.passable(truth.start) && truth.start_free; }

const std::vector<SweepEvent>& SweepChecker::first(const SweepTruth& truth, dsw_level level) {
  static const std::vector<SweepEvent> nothing;
  if (level == DSW_LEVEL_POINTS) return truth.path;
  if (level == DSW_LEVEL_EDGES && !truth.path_hit && !truth.new_edge_hit) return nothing;
  return truth.swept;
}

void SweepChecker::compare(const Sweep& s, dsw_level level, const dsw_sweep& got, const std::string& how) {
  const SweepTruth& truth = s.truth;
  const std::string what = "sweep " + hex(s.from) + " to " + hex(s.to) + " fixed " + hex(s.fixed) + " level " +
                           std::to_string(level) + how + ":";
  const auto wrong = [&](const std::string& text) { report_.fault(SweepReport::kWrong, what + text); };
  const std::vector<SweepEvent>& events = first(truth, level);
  dsw_outcome want = events.empty() ? DSW_OUTCOME_REACHED : DSW_OUTCOME_CONTACT;
  if (!may_start(truth)) want = truth.start < 0 ? DSW_OUTCOME_OUTSIDE : DSW_OUTCOME_IMPASSABLE;
  if (got.outcome != want) {
    const std::string text =
        what + " outcome " + std::to_string(got.outcome) + " for " + std::to_string(want) +
        (want == DSW_OUTCOME_CONTACT ? " at " + number(events[0].time) + " " + name(events[0]) : "");
    const bool contact = got.outcome == DSW_OUTCOME_CONTACT, reached = got.outcome == DSW_OUTCOME_REACHED;
    const bool missed = want == DSW_OUTCOME_CONTACT && reached, early = want == DSW_OUTCOME_REACHED && contact;
    report_.fault(missed ? SweepReport::kMissed : early ? SweepReport::kEarly : SweepReport::kWrong, text);
    return;
  }
  if (want == DSW_OUTCOME_CONTACT) {
    if (!(got.time == events[0].time)) {
      const std::string text = " time " + number(got.time) + " for " + number(events[0].time) + " " + name(events[0]);
      report_.fault(got.time < events[0].time ? SweepReport::kEarly : SweepReport::kLate, what + text);
      return;
    }
    std::string text;
    for (const SweepEvent& e : events) {
      const std::string fault = arena_.wrong_event(s, e, got);
      if (fault.empty()) text = " ";
      if (text.empty())
        text = fault + ", " + name(e) + " time " + number(e.time) + (e.order == 0 ? "" : " by the shift");
    }
    if (text != " ") wrong(text);
    const Vec n = {got.contact.normal[0], got.contact.normal[1], got.contact.normal[2]};
    if (!(std::fabs(length(n) - 1) <= 1e-14)) wrong(" normal is not a unit: " + hex(n));
  } else {
    const double zero[3] = {0, 0, 0};
    if (!none(got.contact.wall) || !none(got.contact.obstacle) || !arena_.same_volume(got.contact.front, -1) ||
        !same(got.contact.normal, zero) || got.contact.tag != 0 || got.contact.kind != DSW_CONTACT_NONE ||
        got.contact.marked_kind != DSW_CELL_NONE) {
      wrong(" members of a contact are set without one");
    }
    if (!(got.time == (want == DSW_OUTCOME_REACHED ? 1 : 0))) wrong(" time " + number(got.time));
    const Vec& there = want == DSW_OUTCOME_REACHED ? s.to : s.from;
    if (!same(got.position, there.data())) wrong(" position " + hex(got.position));
  }
  const int cell = want == DSW_OUTCOME_REACHED ? arena_.locate(s.to) : truth.start;
  if (!arena_.same_volume(got.volume, cell)) wrong(" volume " + name(got.volume) + " for " + std::to_string(cell));
}

void SweepChecker::compare_limited(const Sweep& s, uint32_t max_volumes, const dsw_sweep& whole, const dsw_sweep& got,
                                   const std::string& how) {
  // One budget for the casts and the flood.
  const bool stopped = got.outcome == DSW_OUTCOME_WORK_LIMIT;
  std::string wrong;
  if (stopped != (whole.volumes_visited > max_volumes)) wrong += " outcome " + std::to_string(got.outcome);
  if (stopped &&
      (got.volumes_visited != max_volumes || got.time != 0 || !same(got.position, s.from.data()) ||
       !arena_.same_volume(got.volume, s.truth.start) || !none(got.contact.wall) || !none(got.contact.obstacle))) {
    wrong += " stopped after " + std::to_string(got.volumes_visited) + " at " + number(got.time);
  }
  if (!stopped &&
      (got.outcome != whole.outcome || got.time != whole.time || got.volumes_visited != whole.volumes_visited)) {
    wrong += " another answer than without a limit";
  }
  if (wrong.empty()) return;
  report_.fault(SweepReport::kWrong, "sweep " + hex(s.from) + " to " + hex(s.to) + " fixed " + hex(s.fixed) + how +
                                         " limit " + std::to_string(max_volumes) + " of " +
                                         std::to_string(whole.volumes_visited) + ":" + wrong);
}

void SweepChecker::check_truth(const Sweep& s) {
  const SweepTruth& t = s.truth;
  const std::string what = "TRUTH of " + hex(s.from) + " to " + hex(s.to) + " fixed " + hex(s.fixed) + ":";
  const auto wrong = [&](const std::string& text) { report_.fault(SweepReport::kWrong, what + text); };
  if (t.start == -2) return wrong(" several cells contain the start");
  if (!may_start(t)) return;
  const std::string second = arena_.second_normal(s);
  if (!second.empty()) wrong(second);
  if (t.new_edge_hit && t.swept.empty()) wrong(" the new edge meets something, the triangle nothing");
  if (!t.swept.empty() && t.path_hit && compare_times(t.swept[0], t.path[0]) > 0) wrong(" the path is met first");
  // With three free sides the corners may change places.
  if (!t.path_hit && !t.new_edge_hit) {
    const Vec* corner[3] = {&s.from, &s.to, &s.fixed};
    for (const auto& turn : {std::array<size_t, 3>{1, 0, 2}, {1, 2, 0}, {2, 1, 0}}) {
      const SweepTruth other = arena_.exact.sweep(*corner[turn[0]], *corner[turn[1]], *corner[turn[2]]);
      if (other.swept.empty() != t.swept.empty()) wrong(" the triangle is met by some of its corners only");
    }
  }
  // Half of the way: met if and only if the first time is before it, and then by the same feature.
  Vec half;
  for (size_t k = 0; k < 3; ++k) {
    half[k] = s.from[k] + 0.5 * (s.to[k] - s.from[k]);
    if (mpq_class(half[k]) * 2 != mpq_class(s.from[k]) + mpq_class(s.to[k])) return;
  }
  const SweepTruth before = arena_.exact.sweep(s.from, half, s.fixed);
  const double time = t.swept.empty() ? 2 : t.swept[0].time;
  if (time < 0.5
          ? before.swept.empty() || !same_feature(before.swept[0], t.swept[0]) || before.swept[0].time != 2 * time
          : time > 0.5 && !before.swept.empty()) {
    wrong(" half of the way is met at another time");
  }
  if (time > 0.5 && before.new_edge_hit) wrong(" half of the way is not free");
}

}  // namespace dsw::oracle
