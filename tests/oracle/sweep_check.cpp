#include "sweep_check.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstdio>

namespace dsw::oracle {
namespace {

std::string number(double x) {
  char text[64];
  std::snprintf(text, sizeof text, "%a", x);
  return text;
}

std::string name(dsw_volume_id v) { return std::to_string(v.index) + "." + std::to_string(v.generation); }
std::string name(dsw_face_id f) {
  return std::to_string(f.volume) + "." + std::to_string(f.generation) + "/" + std::to_string(f.local);
}
std::string name(dsw_edge_id f) {
  return std::to_string(f.volume) + "." + std::to_string(f.generation) + "/" + std::to_string(f.local);
}
std::string name(const SweepEvent& e) {
  return e.triangle >= 0 ? "triangle " + std::to_string(e.triangle)
                         : "edge " + std::to_string(e.a) + "-" + std::to_string(e.b);
}

bool same(const double* a, const double* b) { return a[0] == b[0] && a[1] == b[1] && a[2] == b[2]; }
bool none(dsw_face_id f) { return f.volume == 0 && f.generation == 0 && f.local == 0; }
bool none(dsw_edge_id f) { return f.volume == 0 && f.generation == 0 && f.local == 0; }
double dot(const Vec& x, const Vec& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }
double length(const Vec& x) { return std::sqrt(dot(x, x)); }

/// Of a point from segment a b.
double distance(const Vec& a, const Vec& b, const double* point) {
  double most = DBL_MIN;
  for (size_t k = 0; k < 3; ++k) most = std::max({most, std::fabs(b[k] - a[k]), std::fabs(point[k] - a[k])});
  Vec u, w;
  for (size_t k = 0; k < 3; ++k) {
    u[k] = (b[k] - a[k]) / most;
    w[k] = (point[k] - a[k]) / most;
  }
  const double square = dot(u, u), by = square > 0 ? std::min(1.0, std::max(0.0, dot(u, w) / square)) : 0;
  for (size_t k = 0; k < 3; ++k) w[k] -= by * u[k];
  return length(w) * most;
}

bool same_feature(const SweepEvent& x, const SweepEvent& y) {
  return x.triangle == y.triangle && x.a == y.a && x.b == y.b;
}

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

SweepChecker::SweepChecker(World& world, SweepWorld& exact, SweepReport& report)
    : world_(world), exact_(exact), report_(report) {
  for (size_t c = 0; c < world.mesh.cells.size(); ++c) {
    uint32_t local = 0;
    for (const auto& e : cell_edges(world.mesh.cells[c])) {
      const dsw_volume_id owner = world.ids[c];
      edges_.insert({{std::min(e[0], e[1]), std::max(e[0], e[1])}, {owner.index, owner.generation, local++}});
    }
  }
  for (size_t t = 0; t < world.triangles.size(); ++t) {
    const int* v = world.triangles[t].v;
    for (size_t k = 0; k < 3; ++k) {
      const int a = v[k], b = v[(k + 1) % 3];
      triangles_at_[{std::min(a, b), std::max(a, b)}].push_back(static_cast<int>(t));
    }
  }
}

bool SweepChecker::same_volume(dsw_volume_id id, int cell) const {
  if (cell < 0) return id.index == 0 && id.generation == 0;
  const dsw_volume_id want = world_.ids[static_cast<size_t>(cell)];
  return id.index == want.index && id.generation == want.generation;
}

/// The face with that canonical name, or -1.
int SweepChecker::face_of(dsw_face_id id) const {
  if (id.volume >= world_.ids.size() || id.generation != world_.ids[id.volume].generation) return -1;
  const std::vector<int>& faces = world_.cell_faces[id.volume];
  if (id.local >= faces.size()) return -1;
  const int face = faces[id.local];
  return world_.faces[static_cast<size_t>(face)].cell[0] == static_cast<int>(id.volume) ? face : -1;
}

bool SweepChecker::may_start(const SweepTruth& truth) const {
  return truth.start >= 0 && world_.cell_marked[static_cast<size_t>(truth.start)] == 0 && truth.start_free;
}

const std::vector<SweepEvent>& SweepChecker::first(const SweepTruth& truth, dsw_level level) {
  static const std::vector<SweepEvent> nothing;
  if (level == DSW_LEVEL_POINTS) return truth.path;
  if (level == DSW_LEVEL_EDGES && !truth.path_hit && !truth.new_edge_hit) return nothing;
  return truth.swept;
}

bool SweepChecker::normal_of(int triangle, bool into_first, const dsw_sweep& got) const {
  double tolerance = 0;
  const Vec normal = world_.unit_normal(triangle, &tolerance);
  for (size_t k = 0; k < 3; ++k) {
    if (!(std::fabs(got.normal[k] - (into_first ? -normal[k] : normal[k])) <= tolerance)) return false;
  }
  return true;
}

std::string SweepChecker::wrong_wall(const dsw_sweep& got, const std::vector<int>& around,
                                     const std::vector<dsw_cell_kind>& alone) const {
  const bool lone = std::none_of(around.begin(), around.end(), [&](int t) {
    return world_.impassable(world_.triangles[static_cast<size_t>(t)].face);
  });
  const bool front_there = std::any_of(around.begin(), around.end(), [&](int t) {
    const int* cell = world_.triangles[static_cast<size_t>(t)].cell;
    return same_volume(got.front, cell[0]) || (cell[1] >= 0 && same_volume(got.front, cell[1]));
  });
  if (!front_there || world_.cell_marked[got.front.index] != 0) return " front " + name(got.front);
  if (lone) {
    const bool right = none(got.face) && got.tag == 0 && std::count(alone.begin(), alone.end(), got.obstacle) != 0;
    return right ? "" : " a face, an obstacle or a tag where there is no wall";
  }
  const int face = face_of(got.face);
  if (face < 0 || !world_.impassable(face)) return " face " + name(got.face) + " is not canonical or not impassable";
  const bool bears = std::any_of(around.begin(), around.end(),
                                 [&](int t) { return world_.triangles[static_cast<size_t>(t)].face == face; });
  if (!bears) return " face " + name(got.face) + " does not bear the obstacle";
  const Face& f = world_.faces[static_cast<size_t>(face)];
  if (got.obstacle != (f.marked || f.cell[1] < 0 ? DSW_CELL_FACE : DSW_CELL_VOLUME)) {
    return " obstacle " + std::to_string(got.obstacle);
  }
  // Behind the face as seen from the front; where the front does not touch it, behind may be either side.
  std::string wrong = " tag " + std::to_string(got.tag);
  for (size_t side = 0; side < 2; ++side) {
    const int behind = f.cell[side], other = f.cell[1 - side];
    if (same_volume(got.front, behind) && other >= 0) continue;
    const auto tagged = static_cast<size_t>(behind >= 0 ? behind : other);
    if (got.tag == world_.mesh.tags[tagged] || (other < 0 && got.tag == world_.mesh.tags[got.front.index])) wrong = "";
  }
  return wrong;
}

/// The normal of a contact at an edge: across it and the swept edge, against the motion. In doubles, so only where it
/// is well determined.
std::string SweepChecker::wrong_across(const Sweep& s, const SweepEvent& event, const dsw_sweep& got) const {
  const Vec& a = world_.mesh.points[static_cast<size_t>(event.a)];
  const Vec& b = world_.mesh.points[static_cast<size_t>(event.b)];
  double most = 0;
  for (const Vec* p : {&s.from, &s.to, &s.fixed, &a, &b}) {
    for (double x : *p) most = std::max(most, std::fabs(x));
  }
  const int e = -std::ilogb(most);
  Vec edge, swept, move;
  for (size_t k = 0; k < 3; ++k) {
    edge[k] = std::ldexp(b[k], e) - std::ldexp(a[k], e);
    move[k] = std::ldexp(s.to[k], e) - std::ldexp(s.from[k], e);
    swept[k] = std::ldexp(s.fixed[k], e) - (std::ldexp(s.from[k], e) + event.time * move[k]);
  }
  Vec n;
  for (size_t k = 0; k < 3; ++k) {
    const size_t i = (k + 1) % 3, j = (k + 2) % 3;
    n[k] = swept[i] * edge[j] - swept[j] * edge[i];
  }
  const double size = length(n), tolerance = 1e-14 * (length(edge) + length(swept)) / size + 1e-13;
  if (!(size > 0) || !(tolerance < 1e-4)) return "";
  const double against = dot(n, move);
  for (double& x : n) x /= against > 0 ? -size : size;
  const Vec reported = {got.normal[0], got.normal[1], got.normal[2]};
  const double cosine = dot(n, reported);
  // A motion that lies in the plane of both leaves the side to rounding.
  if (std::fabs(against) <= tolerance * size * length(move)) {
    return std::fabs(std::fabs(cosine) - 1) <= tolerance ? "" : " normal is not across the edges";
  }
  for (size_t k = 0; k < 3; ++k) {
    if (!(std::fabs(reported[k] - n[k]) <= tolerance)) return " normal " + hex(reported) + " for " + hex(n);
  }
  return "";
}

std::string SweepChecker::wrong_contact(const Sweep& s, const SweepEvent& event, const dsw_sweep& got) const {
  if (event.triangle >= 0) {
    const Triangle& t = world_.triangles[static_cast<size_t>(event.triangle)];
    const Face& face = world_.faces[static_cast<size_t>(t.face)];
    const int front = t.cell[event.side > 0 ? 0 : 1], behind = t.cell[event.side > 0 ? 1 : 0];
    if (got.kind != DSW_CONTACT_PLANE || !none(got.edge)) return " kind " + std::to_string(got.kind);
    if (face_of(got.face) != t.face) return " face " + name(got.face);
    if (!same_volume(got.front, front)) return " front " + name(got.front) + " for " + std::to_string(front);
    if (got.along != 0) return " along " + number(got.along);
    if (got.obstacle != (face.marked || behind < 0 ? DSW_CELL_FACE : DSW_CELL_VOLUME)) {
      return " obstacle " + std::to_string(got.obstacle);
    }
    if (got.tag != world_.mesh.tags[static_cast<size_t>(behind >= 0 ? behind : front)]) {
      return " tag " + std::to_string(got.tag);
    }
    return normal_of(event.triangle, event.side > 0, got) ? "" : " normal " + hex(got.normal);
  }
  if (got.front.index >= world_.ids.size()) return " front " + name(got.front);
  const std::string wrong = wrong_wall(got, triangles_at_.at({event.a, event.b}), {DSW_CELL_EDGE});
  if (!wrong.empty()) return wrong;
  const auto real = edges_.find({event.a, event.b});
  if (real != edges_.end()) {
    const dsw_edge_id want = real->second;
    if (got.kind != DSW_CONTACT_EDGE) return " kind " + std::to_string(got.kind);
    if (got.edge.volume != want.volume || got.edge.generation != want.generation || got.edge.local != want.local) {
      return " edge " + name(got.edge) + " for " + name(want);
    }
    return wrong_across(s, event, got);
  }
  if (got.kind != DSW_CONTACT_PLANE || !none(got.edge)) return " kind " + std::to_string(got.kind) + " at a diagonal";
  return wrong_across(s, event, got);
}

std::string SweepChecker::wrong_event(const Sweep& s, const SweepEvent& event, const dsw_sweep& got) const {
  return wrong_contact(s, event, got) + wrong_place(s, &event, got);
}

/// Position and point: at its time and place along the edge, and on the obstacle's edge.
std::string SweepChecker::wrong_place(const Sweep& s, const SweepEvent* event, const dsw_sweep& got) const {
  double most = 0;
  for (const Vec* p : {&s.from, &s.to, &s.fixed}) {
    for (double x : *p) most = std::max(most, std::fabs(x));
  }
  if (!(most < DBL_MAX / 4)) return "";
  for (size_t k = 0; k < 3; ++k) {
    const double way = got.time * (s.to[k] - s.from[k]), at = s.from[k] + way;
    const double allowed = 1e-15 * (std::fabs(s.from[k]) + std::fabs(way)) + 2 * DBL_TRUE_MIN;
    if (!(std::fabs(got.position[k] - at) <= allowed)) return " position " + hex(got.position);
  }
  if (event == nullptr) return "";
  if (!(got.along >= 0 && got.along <= 1)) return " along " + number(got.along);
  const double allowed = 32 * DBL_EPSILON * most;
  Vec there;
  for (size_t k = 0; k < 3; ++k) there[k] = got.position[k] + got.along * (s.fixed[k] - got.position[k]);
  const double off = distance(there, there, got.point);
  if (!(off <= allowed)) {
    return " point " + hex(got.point) + " is not at along " + number(got.along) + ", off by " +
           number(off / world_.size);
  }
  if (event->triangle >= 0) return "";
  const std::vector<Vec>& points = world_.mesh.points;
  const double away = distance(points[static_cast<size_t>(event->a)], points[static_cast<size_t>(event->b)], got.point);
  if (away <= allowed) return "";
  return " point " + hex(got.point) + " is not on the obstacle's edge, off by " + number(away / world_.size);
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
  if (got.reserved != 0) wrong(" reserved is set");
  if (want == DSW_OUTCOME_CONTACT) {
    if (!(got.time == events[0].time)) {
      const std::string text = " time " + number(got.time) + " for " + number(events[0].time) + " " + name(events[0]);
      report_.fault(got.time < events[0].time ? SweepReport::kEarly : SweepReport::kLate, what + text);
      return;
    }
    std::string text;
    for (const SweepEvent& e : events) {
      const std::string fault = wrong_event(s, e, got);
      if (fault.empty()) text = " ";
      if (text.empty())
        text = fault + ", " + name(e) + " time " + number(e.time) + (e.order == 0 ? "" : " by the shift");
    }
    if (text != " ") wrong(text);
    const Vec n = {got.normal[0], got.normal[1], got.normal[2]};
    if (!(std::fabs(length(n) - 1) <= 1e-14)) wrong(" normal is not a unit: " + hex(n));
  } else {
    const double zero[3] = {0, 0, 0};
    if (!none(got.face) || !none(got.edge) || !same_volume(got.front, -1) || !same(got.normal, zero) || got.tag != 0 ||
        got.kind != DSW_CONTACT_NONE || got.obstacle != DSW_CELL_NONE) {
      wrong(" members of a contact are set without one");
    }
    if (!(got.time == (want == DSW_OUTCOME_REACHED ? 1 : 0))) wrong(" time " + number(got.time));
    const Vec& there = want == DSW_OUTCOME_REACHED ? s.to : s.from;
    if (!same(got.position, there.data())) wrong(" position " + hex(got.position));
  }
  const int cell = want == DSW_OUTCOME_REACHED ? world_.locate(world_.body(s.to.data())) : truth.start;
  if (!same_volume(got.volume, cell)) wrong(" volume " + name(got.volume) + " for " + std::to_string(cell));
}

void SweepChecker::compare_limited(const Sweep& s, uint32_t max_cells, const dsw_sweep& whole, const dsw_sweep& got,
                                   const std::string& how) {
  // One budget for the casts and the flood.
  const bool stopped = got.outcome == DSW_OUTCOME_WORK_LIMIT;
  std::string wrong;
  if (stopped != (whole.cells_visited > max_cells)) wrong += " outcome " + std::to_string(got.outcome);
  if (stopped && (got.cells_visited != max_cells || got.time != 0 || !same(got.position, s.from.data()) ||
                  !same_volume(got.volume, s.truth.start) || !none(got.face) || !none(got.edge))) {
    wrong += " stopped after " + std::to_string(got.cells_visited) + " at " + number(got.time);
  }
  if (!stopped &&
      (got.outcome != whole.outcome || got.time != whole.time || got.cells_visited != whole.cells_visited)) {
    wrong += " another answer than without a limit";
  }
  if (wrong.empty()) return;
  report_.fault(SweepReport::kWrong, "sweep " + hex(s.from) + " to " + hex(s.to) + " fixed " + hex(s.fixed) + how +
                                         " limit " + std::to_string(max_cells) + " of " +
                                         std::to_string(whole.cells_visited) + ":" + wrong);
}

void SweepChecker::check_truth(const Sweep& s) {
  const SweepTruth& t = s.truth;
  const std::string what = "TRUTH of " + hex(s.from) + " to " + hex(s.to) + " fixed " + hex(s.fixed) + ":";
  const auto wrong = [&](const std::string& text) { report_.fault(SweepReport::kWrong, what + text); };
  if (t.start == -2) return wrong(" several cells contain the start");
  if (!may_start(t)) return;
  const Walk walk = world_.cast(world_.body(s.from.data()), world_.body(s.to.data()), t.start);
  if (t.path_hit != (walk.outcome == Walk::kContact) || t.path.size() > 1 ||
      (t.path_hit && (walk.triangle != t.path[0].triangle || walk.time != t.path[0].time))) {
    wrong(" the path is not that of the oracle's cast");
  }
  if (t.new_edge_hit && t.swept.empty()) wrong(" the new edge meets something, the triangle nothing");
  if (!t.swept.empty() && t.path_hit && compare_times(t.swept[0], t.path[0]) > 0) wrong(" the path is met first");
  // With three free sides the corners may change places.
  if (!t.path_hit && !t.new_edge_hit) {
    const Vec* corner[3] = {&s.from, &s.to, &s.fixed};
    for (const auto& turn : {std::array<size_t, 3>{1, 0, 2}, {1, 2, 0}, {2, 1, 0}}) {
      const SweepTruth other = exact_.sweep(*corner[turn[0]], *corner[turn[1]], *corner[turn[2]]);
      if (other.swept.empty() != t.swept.empty()) wrong(" the triangle is met by some of its corners only");
    }
  }
  // Half of the way: met if and only if the first time is before it, and then by the same feature.
  Vec half;
  for (size_t k = 0; k < 3; ++k) {
    half[k] = s.from[k] + 0.5 * (s.to[k] - s.from[k]);
    if (mpq_class(half[k]) * 2 != mpq_class(s.from[k]) + mpq_class(s.to[k])) return;
  }
  const SweepTruth before = exact_.sweep(s.from, half, s.fixed);
  const double time = t.swept.empty() ? 2 : t.swept[0].time;
  if (time < 0.5
          ? before.swept.empty() || !same_feature(before.swept[0], t.swept[0]) || before.swept[0].time != 2 * time
          : time > 0.5 && !before.swept.empty()) {
    wrong(" half of the way is met at another time");
  }
  if (time > 0.5 && before.new_edge_hit) wrong(" half of the way is not free");
}

}  // namespace dsw::oracle
