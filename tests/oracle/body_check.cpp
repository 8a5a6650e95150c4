#include "body_check.h"

#include <algorithm>
#include <cfloat>
#include <cmath>

namespace dsw::oracle {
namespace {

bool same(const Vec& a, const double* b) { return a[0] == b[0] && a[1] == b[1] && a[2] == b[2]; }

double relative_error(const SweepEvent& e, double time) {
  if (!(e.time >= DBL_MIN)) return 0;
  const mpq_class exact = mpq_class(e.numerator.c[e.order]) / mpq_class(e.denominator.c[e.order]);
  return std::fabs(mpq_class((exact - mpq_class(time)) / exact).get_d());
}

}  // namespace

std::string describe(const VertexMove& f) {
  std::string text = hex(f.from) + " to " + hex(f.to) + " fixed";
  for (const Vec& q : f.fixed) text += " " + hex(q);
  for (const auto& face : f.faces) text += " face " + std::to_string(face[0]) + "-" + std::to_string(face[1]);
  return text;
}

std::string BodyChecker::not_free(const BodyState& s, dsw_level level) {
  for (size_t v = 0; v < s.at.size(); ++v) {
    if (s.vertices[v].generation == 0) continue;
    const int cell = arena_.locate(s.at[v]);
    if (!arena_.passable(cell)) {
      return "vertex " + std::to_string(v) + " " + hex(s.at[v]) + " lies in cell " + std::to_string(cell);
    }
  }
  if (level == DSW_LEVEL_POINTS) return "";
  for (size_t i = 0; i < s.edges.size(); ++i) {
    const auto& e = s.edges[i];
    if (std::binary_search(s.untested.begin(), s.untested.end(), s.edge_ids[i].index)) continue;
    if (arena_.exact.blocked(s.at[e[0]], s.at[e[1]])) return "edge " + hex(s.at[e[0]]) + " " + hex(s.at[e[1]]);
  }
  if (level != DSW_LEVEL_FACES) return "";
  for (const auto& f : s.faces) {
    if (arena_.exact.blocked(s.at[f[0]], s.at[f[1]], s.at[f[2]])) {
      return "face " + hex(s.at[f[0]]) + " " + hex(s.at[f[1]]) + " " + hex(s.at[f[2]]);
    }
  }
  return "";
}

std::vector<size_t> BodyChecker::blocked_edges(const BodyState& s, dsw_level level) {
  std::vector<std::array<uint32_t, 2>> of_faces;
  for (const auto& f : s.faces) {
    if (level != DSW_LEVEL_FACES || !arena_.exact.blocked(s.at[f[0]], s.at[f[1]], s.at[f[2]])) continue;
    for (size_t k = 0; k < 3; ++k) of_faces.push_back({std::min(f[k], f[(k + 1) % 3]), std::max(f[k], f[(k + 1) % 3])});
  }
  std::vector<size_t> list;
  for (size_t e = 0; e < s.edges.size() && level > DSW_LEVEL_POINTS; ++e) {
    const std::array<uint32_t, 2> ends = {std::min(s.edges[e][0], s.edges[e][1]),
                                          std::max(s.edges[e][0], s.edges[e][1])};
    const bool of_face = std::find(of_faces.begin(), of_faces.end(), ends) != of_faces.end();
    if (of_face || arena_.exact.blocked(s.at[ends[0]], s.at[ends[1]])) list.push_back(e);
  }
  return list;
}

void BodyChecker::placed(const BodyState& s, dsw_level level, const std::string& how) {
  const std::string fault = not_free(s, level);
  if (!fault.empty()) report_.fault(SweepReport::kNotFreeAfter, how + ": " + fault);
  for (size_t v = 0; v < s.at.size(); ++v) {
    if (s.vertices[v].generation == 0) continue;
    const int cell = arena_.locate(s.at[v]);
    if (cell >= 0 && arena_.same_volume(s.volumes[v], cell)) continue;
    report_.fault(SweepReport::kWrong, how + ": vertex " + std::to_string(v) + " " + hex(s.at[v]) + " has volume " +
                                           name(s.volumes[v]) + " for " + std::to_string(cell));
  }
}

/// A reported contact against the true first events. Ids of edges and faces, by number, or null where they are not
/// known.
void BodyChecker::judge(const VertexMove& flight, const MoveTruth& truth, const dsw_body_contact& c,
                        const std::string& what, const std::vector<dsw_body_edge_id>* edges,
                        const std::vector<dsw_body_face_id>* faces) {
  const double time = truth.events[0].time;
  if (!(c.time == time)) {
    char text[120];
    std::snprintf(text, sizeof text, " time %a for %a, ", c.time, time);
    report_.fault(c.time < time ? SweepReport::kEarly : SweepReport::kLate, what + text + name(truth.events[0]));
    return;
  }
  time_error = std::max(time_error, relative_error(truth.events[0], c.time));
  std::string wrong = " ";
  for (const SweepEvent& e : truth.events) {
    VertexMove own = {flight.from, flight.to, {}, {}};
    bool right_feature = true;
    if (e.edge >= 0) {
      own.fixed = {flight.fixed[static_cast<size_t>(e.edge)]};
      right_feature =
          edges == nullptr ? c.edge.generation != 0 : same_id((*edges)[static_cast<size_t>(e.edge)], c.edge);
    } else if (e.face >= 0) {
      for (size_t i : flight.faces[static_cast<size_t>(e.face)]) own.fixed.push_back(flight.fixed[i]);
      right_feature =
          faces == nullptr ? c.face.generation != 0 : same_id((*faces)[static_cast<size_t>(e.face)], c.face);
    }
    right_feature = right_feature && (e.edge >= 0 || c.edge.generation == 0) && (e.face >= 0 || c.face.generation == 0);
    std::string fault =
        right_feature ? arena_.wrong_contact(own, e, c) : " edge " + name(c.edge) + " face " + name(c.face);
    Vec fixed[2] = {{0, 0, 0}, {0, 0, 0}};
    std::copy(own.fixed.begin(), own.fixed.end(), fixed);
    const bool in_order = same(fixed[0], c.fixed[0]) && same(fixed[1], c.fixed[1]);
    if (!in_order && !(e.face >= 0 && same(fixed[1], c.fixed[0]) && same(fixed[0], c.fixed[1]))) fault += " fixed";
    if (fault.empty()) wrong.clear();
    if (wrong == " ") wrong = fault + ", for " + name(e) + (e.order == 0 ? "" : " by the shift");
    if (wrong.empty()) break;
  }
  const double length =
      std::sqrt(c.contact.normal[0] * c.contact.normal[0] + c.contact.normal[1] * c.contact.normal[1] +
                c.contact.normal[2] * c.contact.normal[2]);
  if (!(std::fabs(length - 1) <= 1e-14)) wrong += " normal is not a unit: " + hex(c.contact.normal);
  if (!wrong.empty()) report_.fault(SweepReport::kWrong, what + wrong);
}

void BodyChecker::alone(const dsw_body_contact& c, const std::string& how) {
  VertexMove flight = {{c.from[0], c.from[1], c.from[2]}, {c.to[0], c.to[1], c.to[2]}, {}, {}};
  const size_t ends = c.face.generation != 0 ? 2 : c.edge.generation != 0 ? 1 : 0;
  for (size_t i = 0; i < ends; ++i) flight.fixed.push_back({c.fixed[i][0], c.fixed[i][1], c.fixed[i][2]});
  dsw_level level = DSW_LEVEL_EDGES_SWEPT;
  if (ends == 2) {
    flight.faces.push_back({0, 1});
    level = DSW_LEVEL_FACES;
  }
  const std::string what = describe(flight) + how + ":";
  for (const Vec* p : {&flight.from, &flight.to}) {
    for (double x : *p) {
      if (!std::isfinite(x)) return report_.fault(SweepReport::kWrong, what + " a flight without end");
    }
  }
  const MoveTruth truth = arena_.exact.move(flight, level);
  if (truth.events.empty()) return report_.fault(SweepReport::kEarly, what + " a contact where there is none");
  judge(flight, truth, c, what, nullptr, nullptr);
}

void BodyChecker::history(const std::vector<dsw_body_contact>& before, const std::vector<dsw_body_contact>& now,
                          const std::string& how) {
  for (const dsw_body_contact& c : now) {
    const bool lasting = std::any_of(before.begin(), before.end(), [&](const dsw_body_contact& b) {
      return same_id(b.vertex, c.vertex) && b.contact.obstacle.kind == c.contact.obstacle.kind &&
             b.contact.obstacle.index == c.contact.obstacle.index &&
             b.contact.obstacle.generation == c.contact.obstacle.generation &&
             b.contact.obstacle.local == c.contact.obstacle.local;
    });
    if (c.history == (lasting ? DSW_HISTORY_LASTING : DSW_HISTORY_NEW)) continue;
    report_.fault(SweepReport::kWrong, "vertex " + name(c.vertex) + how + ": history " + std::to_string(c.history));
  }
}

void BodyChecker::step(const BodyState& now, size_t vertex, const Vec& to, dsw_level level, const BodyMove& move,
                       const dsw_body_contact* contact, const Vec& reached, const std::string& how) {
  std::vector<size_t> edges_of, faces_of;
  VertexMove flight = now.flight(vertex, to, &edges_of, &faces_of);
  const MoveTruth truth = arena_.exact.move(flight, level);
  report_.step(truth);
  const std::string what = "vertex " + std::to_string(vertex) + " " + describe(flight) + how + ":";
  const auto wrong = [&](const std::string& text) { report_.fault(SweepReport::kWrong, what + text); };
  true_contacts += move.drops && !truth.events.empty();
  if (contact == nullptr) {
    if (!same(reached, to.data())) wrong(" stopped without a contact at " + hex(reached));
    if (truth.events.empty()) return;
    // What may be dropped is met by edges only.
    if (move.drops && !truth.path_hit) {
      ++dropped;
      return;
    }
    report_.fault(SweepReport::kMissed, what + " no contact, for " + name(truth.events[0]));
    return;
  }
  if (!same(now.at[vertex], contact->from) || !same(to, contact->to)) wrong(" contact of another flight");
  if (truth.events.empty()) {
    report_.fault(SweepReport::kEarly, what + " a contact where there is none");
  } else if (move.drops && contact->time > truth.events[0].time) {
    ++dropped;
  } else {
    std::vector<dsw_body_edge_id> edges;
    std::vector<dsw_body_face_id> faces;
    for (size_t e : edges_of) edges.push_back(now.edge_ids[e]);
    for (size_t f : faces_of) faces.push_back(now.face_ids[f]);
    judge(flight, truth, *contact, what, &edges, &faces);
  }
  flight.to = reached;
  if (!move.drops && !arena_.exact.move(flight, level).events.empty()) {
    report_.fault(SweepReport::kNotFreeAfter, what + " the way to " + hex(reached) + " is not free");
  }
  double way = 0, left = 0, most = 0;
  for (size_t k = 0; k < 3; ++k) {
    way = std::max(way, std::fabs(to[k] - flight.from[k]));
    left = std::hypot(left, to[k] - reached[k]);
    most = std::max(most, std::fabs(to[k]));
  }
  // What is longer than a double can tell is infinite.
  if (contact->distance_left != left &&
      !(std::fabs(contact->distance_left - left) <= 1e-12 * left + 4 * DBL_EPSILON * most + 4 * DBL_TRUE_MIN))
    wrong(" distance left");
  const bool room = contact->time * way > 1e-3 * arena_.size();
  if (room && !move.stand_off && same(reached, contact->from)) report_.stuck();
}

void BodyChecker::replay(const BodyState& before, const BodyMove& move, dsw_level level, const BodyAnswer& answer,
                         const std::string& how) {
  BodyState now = before;
  const auto wrong = [&](const std::string& text) { report_.fault(SweepReport::kWrong, how + ":" + text); };
  size_t next = 0, stopped = 0;
  uint32_t sweeps = 0;
  for (uint32_t v : move.order) {
    const dsw_body_contact* contact = nullptr;
    if (next < answer.contacts.size() && same_id(answer.contacts[next].vertex, before.vertices[v])) {
      contact = &answer.contacts[next++];
      for (; move.all && next < answer.contacts.size() && same_id(answer.contacts[next].vertex, contact->vertex);
           ++next) {
        const dsw_body_contact &one = answer.contacts[next - 1], &two = answer.contacts[next];
        if (one.time <= two.time) continue;
        char text[160];
        std::snprintf(text, sizeof text, " obstacle kind %d at %a before kind %d at %a, flight ",
                      one.contact.obstacle.kind, one.time, two.contact.obstacle.kind, two.time);
        wrong(text + describe(now.flight(v, move.targets[v])));
      }
    }
    const Vec& reached = answer.after.at[v];
    step(now, v, move.targets[v], level, move, contact, reached, how);
    stopped += !same(reached, move.targets[v].data());
    now.at[v] = reached;
    const bool moves = level > DSW_LEVEL_POINTS && !same(before.at[v], move.targets[v].data());
    for (const auto& e : now.edges) sweeps += moves && (e[0] == v || e[1] == v);
  }
  if (next != answer.contacts.size()) {
    wrong(" contact " + std::to_string(next) + " is of vertex " + name(answer.contacts[next].vertex) +
          ", out of order or twice");
  }
  for (size_t v = 0; v < now.at.size(); ++v) {
    if (!same(now.at[v], answer.after.at[v].data()))
      wrong(" vertex " + std::to_string(v) + " moved without being asked");
  }
  const dsw_move_report& r = answer.report;
  if (r.fraction != 1 || r.vertices_moved != move.order.size() || r.vertices_stopped != stopped ||
      r.contact_count != answer.contacts.size() || r.edit_count != 0 || r.edges_skipped > r.edges_swept ||
      (answer.contacts.empty() && before.untested.empty() && answer.after.untested.empty() &&
       r.edges_swept != sweeps)) {  // what verifies a stop sweeps too
    wrong(" report: moved " + std::to_string(r.vertices_moved) + ", stopped " + std::to_string(r.vertices_stopped) +
          " for " + std::to_string(stopped) + ", contacts " + std::to_string(r.contact_count) + ", swept " +
          std::to_string(r.edges_swept) + " of " + std::to_string(sweeps) + ", skipped " +
          std::to_string(r.edges_skipped));
  }
  placed(answer.after, level, how);
}

}  // namespace dsw::oracle
