#include "deform_run.h"

#include "rounds.h"
#include "space_ground.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

namespace dsw::oracle {
namespace {

class Deformer {
 public:
  Deformer(Ground& ground, Rng& rng, DeformReport& report)
      : ground_(ground), arena_(ground.arena()), dimension_(arena_.dimension), rng_(rng), report_(report) {}

  void run(int count);

 private:
  struct Lodger {
    dsw_body_id id;
    dsw_level level;
    BodyState state;
    bool rigid;
    std::vector<Vec> first;  // where it was made
  };
  struct Particle {
    dsw_particle_id id;
    Vec at;
    int chamber;
  };

  void settle();
  std::vector<Vec> next_points();
  void move_towards_body(std::vector<Vec>& points);
  dsw_deform_options next_options();
  bool step();
  void check_way(const Deformed& d, const std::string& how);
  void check(Deformed& d, const std::string& how);
  void check_shape(const Lodger& lodger, const BodyState& now, const std::string& how);
  void check_vertex(Picture& now, const Vec& at, dsw_volume_id volume, int chamber, const std::string& what);
  int chamber_of(const BodyState& before, const BodyState& now, size_t vertex) const;
  void add_parts(const Lodger& lodger, const BodyState& now, const Deformed& d);
  void find_chambers();
  std::vector<double> flat(const std::vector<Vec>& points) const;
  void wrong(const std::string& text) {
    ++report_.wrong;
    report_.faults.fault(SweepReport::kWrong, text);
  }

  Ground& ground_;
  Arena& arena_;
  const size_t dimension_;
  Rng& rng_;
  DeformReport& report_;
  ScenePtr scene_;
  std::vector<Lodger> lodgers_;
  std::vector<Particle> particles_;
  std::vector<Part> parts_;   // what lay there before the deformation at hand
  std::vector<int> chamber_;  // by cell: what can be reached without passing anything impassable
  std::vector<Vec> now_;
  bool whole_ = true;
  std::vector<std::vector<double>> arrays_;  // what the library reads, and the next one
};

std::vector<double> Deformer::flat(const std::vector<Vec>& points) const {
  std::vector<double> all;
  for (const Vec& p : points) all.insert(all.end(), p.begin(), p.begin() + static_cast<ptrdiff_t>(dimension_));
  return all;
}

void Deformer::find_chambers() {
  chamber_.resize(arena_.ids().size());
  std::iota(chamber_.begin(), chamber_.end(), 0);
  const auto find = [&](int c) {
    while (chamber_[static_cast<size_t>(c)] != c) c = chamber_[static_cast<size_t>(c)];
    return c;
  };
  for (const auto& [one, other] : ground_.passages()) chamber_[static_cast<size_t>(find(one))] = find(other);
  for (int& c : chamber_) c = find(c);
}

/// Bodies and particles.
void Deformer::settle() {
  const uint32_t bodies = 1 + rng_.below(3u);
  for (uint32_t i = 0; i < bodies; ++i) {
    const auto level = static_cast<dsw_level>(1 + rng_.below(dimension_ == 3 ? 4u : 3u));
    Bodies source(arena_, ground_.places(), rng_, level);
    for (int tries = 0; tries < 10; ++tries) {
      Lodger lodger{{0, 0}, level, {}, rng_.chance(0.5), {}};
      const uint32_t flags =
          (rng_.chance(0.5) ? uint32_t{DSW_BODY_SEQUENCES} : 0u) | (lodger.rigid ? uint32_t{DSW_BODY_RIGID} : 0u);
      if (create_body(scene_.get(), source.next(), level, flags, {}, &lodger.id) != DSW_STATUS_OK) continue;
      const std::string fault = read_body(scene_.get(), lodger.id, lodger.state);
      if (!fault.empty()) wrong("a new body: " + fault);
      lodger.first = lodger.state.at;
      report_.rigid += lodger.rigid ? 1 : 0;
      lodgers_.push_back(lodger);
      ++report_.bodies;
      break;
    }
  }
  Vec lower = now_[0], upper = lower;
  for (const Vec& p : now_) {
    for (size_t k = 0; k < 3; ++k) lower[k] = std::min(lower[k], p[k]), upper[k] = std::max(upper[k], p[k]);
  }
  for (int i = 0; i < 6; ++i) {
    Particle particle{{0, 0}, {0, 0, 0}, 0};
    for (size_t k = 0; k < dimension_; ++k) particle.at[k] = rng_.range(lower[k], upper[k]);
    dsw_volume_id volume;
    if (dsw_particle_create(scene_.get(), particle.at.data(), {0, 0}, &particle.id) != DSW_STATUS_OK ||
        dsw_particle_get_position(scene_.get(), particle.id, nullptr, &volume) != DSW_STATUS_OK) {
      continue;
    }
    particle.chamber = chamber_[volume.index];
    particles_.push_back(particle);
    ++report_.particles;
  }
}

/// A vertex goes to, exactly through, or past a body's.
void Deformer::move_towards_body(std::vector<Vec>& points) {
  if (lodgers_.empty()) return;
  const BodyState& s = lodgers_[rng_.below(lodgers_.size())].state;
  const size_t v = rng_.below(s.at.size());
  if (s.vertices[v].generation == 0) return;
  Vec& p = points[static_cast<size_t>(ground_.corner(static_cast<int>(s.volumes[v].index), rng_))];
  const double shares[] = {0.5, 1, 1, 1.5, 2};
  const double share = shares[rng_.below(5u)];
  for (size_t k = 0; k < 3; ++k) p[k] += share * (s.at[v][k] - p[k]);
}

std::vector<Vec> Deformer::next_points() {
  const std::vector<Vec>& first = ground_.points();
  std::vector<Vec> points = now_;
  const double size = arena_.size(), count = static_cast<double>(arena_.ids().size()) + 1;
  const double cell = size / (dimension_ == 3 ? std::cbrt(count) : std::sqrt(count));
  const double scales[] = {0.02, 0.1, 0.3};
  const double scale = scales[rng_.below(3u)] * cell;
  const auto any = [&](double low, double high) {
    Vec x = {0, 0, 0};
    for (size_t k = 0; k < dimension_; ++k) x[k] = rng_.range(low, high);
    return x;
  };
  switch (rng_.below(7u)) {
    case 0: {  // waves
      const Vec phase = any(0, 6);
      for (Vec& p : points) {
        const Vec at = p;
        for (size_t k = 0; k < dimension_; ++k) {
          p[k] += 2 * scale * std::sin(3 * at[(k + 1) % dimension_] / size + phase[k]);
        }
      }
      break;
    }
    case 1:  // noise
      for (Vec& p : points) {
        for (size_t k = 0; k < dimension_; ++k) p[k] += scale * rng_.range(-1, 1);
      }
      break;
    case 2: {  // everything goes on
      const Vec by = any(-2, 2);
      for (Vec& p : points) {
        for (size_t k = 0; k < 3; ++k) p[k] += (k == 2 ? 0.5 : 1) * by[k] * cell;
      }
      break;
    }
    case 3: {  // larger, smaller, flatter
      const Vec by = any(0.7, 1.3);
      for (Vec& p : points) {
        for (size_t k = 0; k < dimension_; ++k) p[k] = first[0][k] + by[k] * (p[k] - first[0][k]);
      }
      break;
    }
    case 4:  // back
      points = first;
      break;
    default:
      for (uint32_t i = 0, n = 1 + rng_.below(4u); i < n; ++i) move_towards_body(points);
  }
  return std::all_of(points.begin(), points.end(), finite) ? points : now_;
}

dsw_deform_options Deformer::next_options() {
  dsw_deform_options options = defaults(dsw_deform_options_init);
  options.method = rng_.chance(0.75) ? DSW_DEFORM_SWEPT : DSW_DEFORM_END_STATE;
  options.response = static_cast<dsw_wall_response>(rng_.below(4u));
  if (options.method == DSW_DEFORM_END_STATE && options.response == DSW_WALL_HOLD) options.response = DSW_WALL_STOP;
  options.invalid = rng_.chance(0.7) ? DSW_INVALID_HOLD : DSW_INVALID_REFUSE;
  options.most_halvings = 1 + rng_.below(5u);
  return options;
}

void Deformer::check_vertex(Picture& now, const Vec& at, dsw_volume_id volume, int chamber, const std::string& what) {
  const auto cell = static_cast<int>(volume.index);
  const bool in = now.contains(cell, at);
  int valid = 0;
  dsw_environment_is_valid(ground_.environment(), volume, &valid);
  if (in && valid == 1 && arena_.passable(cell) && chamber_[static_cast<size_t>(cell)] == chamber) return;
  ++report_.lost;
  report_.faults.fault(SweepReport::kWrong, what + " at " + hex(at) + (in ? "" : " is not") + " in " +
                                                (valid == 1 ? "" : "invalid ") + "volume " + std::to_string(cell) +
                                                ", chamber " + std::to_string(chamber_[static_cast<size_t>(cell)]) +
                                                " for " + std::to_string(chamber));
}

/// Where a vertex must be: where it was, or if it is new, where its neighbours are.
int Deformer::chamber_of(const BodyState& before, const BodyState& now, size_t vertex) const {
  const auto old = [&](size_t v) { return v < before.at.size() && before.vertices[v].generation != 0; };
  if (old(vertex)) return chamber_[before.volumes[vertex].index];
  for (const auto& e : now.edges) {
    for (size_t k = 0; k < 2; ++k) {
      if (e[k] == vertex) return chamber_[now.volumes[e[1 - k]].index];
    }
  }
  return -1;
}

/// Whether all vertices that are not held made the part of their way that is told.
void Deformer::check_way(const Deformed& d, const std::string& how) {
  const double part = d.report.fraction;
  std::vector<char> held(d.now.size(), 0);
  for (const dsw_vertex_id v : d.held) held[v.index] = 1;
  for (size_t v = 0; v < d.now.size(); ++v) {
    const bool there = d.now[v] == point_on_way(d.start[v], d.target[v], part);
    if (there != (held[v] == 0)) wrong(how + ": vertex " + std::to_string(v) + " is not where it is said to be");
  }
  int exponent = 0;
  const bool halved = part == 0 || std::frexp(part, &exponent) == 0.5;
  const dsw_deform_outcome outcome = part != 1        ? DSW_DEFORM_FRACTION
                                     : d.held.empty() ? DSW_DEFORM_DONE
                                                      : DSW_DEFORM_HELD;
  const bool swept = d.options.method == DSW_DEFORM_SWEPT;
  if (!halved || d.report.outcome != outcome || d.report.held_count != d.held.size() ||
      d.report.contact_count != d.contacts.size() || (swept ? d.report.steps == 0 : d.report.steps != 0) ||
      (part != 1 && d.contacts.empty() && d.report.invalid_count == 0 && swept)) {
    wrong(how + ": the report does not fit");
  }
}

void Deformer::add_parts(const Lodger& lodger, const BodyState& now, const Deformed& d) {
  const BodyState& s = lodger.state;
  const bool touched = std::any_of(d.contacts.begin(), d.contacts.end(),
                                   [&](const dsw_wall_contact& c) { return same_id(c.body, lodger.id); });
  const auto rests = [&](size_t v) { return !touched && now.vertices[v].generation != 0 && now.at[v] == s.at[v]; };
  Part part;
  part.body = lodger.id;
  part.level = lodger.level;
  for (size_t v = 0; v < s.at.size(); ++v) {
    if (s.vertices[v].generation == 0) continue;
    part.at = {s.at[v]};
    part.at_rest = rests(v);
    parts_.push_back(part);
  }
  for (size_t e = 0; e < s.edges.size() && lodger.level >= DSW_LEVEL_EDGES; ++e) {
    part.edge = s.edge_ids[e];
    part.at = {s.at[s.edges[e][0]], s.at[s.edges[e][1]]};
    const auto is_same = [&](dsw_body_edge_id id) { return same_id(id, s.edge_ids[e]); };
    const auto found = std::find_if(now.edge_ids.begin(), now.edge_ids.end(), is_same);
    part.at_rest = rests(s.edges[e][0]) && rests(s.edges[e][1]) && found != now.edge_ids.end() &&
                   now.edges[static_cast<size_t>(found - now.edge_ids.begin())] == s.edges[e];  // else it is split
    parts_.push_back(part);
  }
}

/// Whether a rigid body keeps its vertices, edges and distances, to 8 units in the last place of the largest
/// coordinate.
void Deformer::check_shape(const Lodger& lodger, const BodyState& now, const std::string& how) {
  if (!lodger.rigid) return;
  if (now.at != lodger.state.at) ++report_.rigid_moves;
  double largest = 0;
  for (const std::vector<Vec>* places : {&lodger.first, &now.at}) {
    for (const Vec& p : *places) {
      for (const double x : p) largest = std::max(largest, std::fabs(x));
    }
  }
  bool keeps = now.edges == lodger.state.edges && now.faces == lodger.state.faces;
  for (size_t a = 0; a < now.at.size(); ++a) {
    for (size_t b = 0; b < a; ++b) {
      const auto distance = [&](const std::vector<Vec>& at) {
        // Not all at once: libc++ before version 15 squares three numbers as they are, and 1e300 overflows.
        return std::hypot(std::hypot(at[a][0] - at[b][0], at[a][1] - at[b][1]), at[a][2] - at[b][2]);
      };
      keeps =
          keeps && std::fabs(distance(now.at) - distance(lodger.first)) <= 8 * std::max(0x1p-52 * largest, 0x1p-1074);
    }
  }
  if (keeps) return;
  ++report_.bent;
  report_.faults.fault(SweepReport::kWrong, how + ": a rigid body has lost its shape");
}

/// Everything against a picture of the environment as it is.
void Deformer::check(Deformed& d, const std::string& how) {
  const std::unique_ptr<Picture> now = ground_.picture(now_);
  // Where cells are folded over, one that is far away may lie over everything.
  const bool whole = now->is_sound() && dsw_environment_check(ground_.environment(), nullptr) == DSW_STATUS_OK;
  report_.whole += whole ? 1 : 0;
  d.whole = whole && whole_;
  whole_ = whole;
  parts_.clear();
  for (Lodger& lodger : lodgers_) {
    BodyState state;
    const std::string fault = read_body(scene_.get(), lodger.id, state);
    if (!fault.empty()) wrong(how + ": " + fault);
    for (size_t v = 0; v < state.at.size() && now->is_sound(); ++v) {
      if (state.vertices[v].generation == 0) continue;
      check_vertex(*now, state.at[v], state.volumes[v], chamber_of(lodger.state, state, v),
                   how + ": vertex " + std::to_string(v));
    }
    check_shape(lodger, state, how);
    add_parts(lodger, state, d);
    lodger.state = state;
    if (!whole) continue;
    const std::string blocked = BodyChecker(now->arena(), report_.faults).not_free(state, lodger.level);
    if (blocked.empty()) continue;
    ++report_.not_free;
    report_.faults.fault(SweepReport::kNotFreeAfter, how + ": level " + std::to_string(lodger.level) + " " + blocked);
  }
  for (Particle& particle : particles_) {
    Vec at = {0, 0, 0};
    dsw_volume_id volume;
    const std::string what = how + ": particle " + std::to_string(particle.id.index);
    if (dsw_particle_get_position(scene_.get(), particle.id, at.data(), &volume) != DSW_STATUS_OK) {
      wrong(what + " is gone");
      continue;
    }
    if (now->is_sound()) check_vertex(*now, at, volume, particle.chamber, what);
    const bool touched = std::any_of(d.contacts.begin(), d.contacts.end(),
                                     [&](const dsw_wall_contact& c) { return same_id(c.particle, particle.id); });
    Part part;
    part.particle = particle.id;
    part.at = {particle.at};
    part.at_rest = !touched && at == particle.at;
    parts_.push_back(part);
    particle.at = at;
  }
  const Validation validation = ground_.validate(d, parts_);
  report_.validated_parts += validation.parts;
  report_.validated_contacts += validation.contacts;
  for (const std::string& fault : validation.faults) wrong(how + ": " + fault);
}

bool Deformer::step() {
  Deformed d;
  d.start = now_;
  d.target = next_points();
  d.options = next_options();
  std::vector<double> next = flat(d.target);
  const std::vector<double> asked = next;
  const dsw_status status = dsw_environment_deform(dsw_scene_get_environment(scene_.get()), next.data(),
                                                   d.target.size(), &d.options, &d.report);
  const std::string how = "step " + std::to_string(report_.steps) + " method " + std::to_string(d.options.method) +
                          " response " + std::to_string(d.options.response) + " halvings " +
                          std::to_string(d.options.most_halvings);
  ++report_.steps;
  if (status != DSW_STATUS_OK) {
    wrong(how + " answers " + dsw_status_string(status) + ": " + dsw_last_error_message());
    return false;
  }
  ++report_.outcomes[d.report.outcome];
  report_.contacts += d.report.contact_count;
  report_.pushed += d.report.pushed_count;
  const bool refused = d.report.outcome == DSW_DEFORM_REFUSED;
  if (refused && next != asked) wrong(how + ": refused, and next is changed");
  if (!refused) {
    arrays_.push_back(std::move(next));
    if (arrays_.size() > 2) arrays_.erase(arrays_.begin());
    for (size_t v = 0; v < now_.size(); ++v) std::copy_n(&arrays_.back()[dimension_ * v], dimension_, now_[v].begin());
  }
  d.now = now_;
  const double* points = nullptr;
  size_t count = 0;
  dsw_environment_get_points(ground_.environment(), &points, &count);
  if (count != now_.size() || !std::equal(points, points + dimension_ * count, flat(now_).begin())) {
    wrong(how + ": the environment reads other points");
  }
  const dsw_wall_contact* contacts = nullptr;
  const dsw_vertex_id* held = nullptr;
  dsw_environment_get_wall_contacts(dsw_scene_get_environment(scene_.get()), &contacts, &count);
  d.contacts.assign(contacts, contacts + count);
  dsw_environment_get_held_vertices(dsw_scene_get_environment(scene_.get()), &held, &count);
  d.held.assign(held, held + count);
  if (!refused) check_way(d, how);
  check(d, how);
  return true;
}

void Deformer::run(int count) {
  dsw_scene_desc desc = defaults(dsw_scene_desc_init);
  desc.features = DSW_FEATURE_DEFORMING;
  dsw_scene* scene = nullptr;
  if (dsw_scene_create(ground_.environment(), &desc, &scene) != DSW_STATUS_OK) {
    wrong("no scene");
    return;
  }
  scene_.reset(scene);
  now_ = ground_.points();
  find_chambers();
  settle();
  for (int i = 0; i < count && step(); ++i) {
  }
}

void one_scene(const SweepTurn& turn, uint64_t seed, DeformReport& report) {
  Rng rng(seed);
  const std::unique_ptr<Ground> ground = space_ground_of(turn, seed, rng, report.faults);
  if (ground != nullptr) run_on_ground(*ground, rng, report);
}

}  // namespace

Vec point_on_way(const Vec& from, const Vec& to, double fraction) {
  if (fraction == 0) return from;
  if (fraction == 1) return to;
  Vec at = {0, 0, 0};
  for (size_t k = 0; k < 3; ++k) {
    const double way = to[k] - from[k];
    at[k] = std::isfinite(way) ? from[k] + fraction * way : (1 - fraction) * from[k] + fraction * to[k];
  }
  return at;
}

void run_on_ground(Ground& ground, Rng& rng, DeformReport& report) { Deformer(ground, rng, report).run(8); }

void run_deformations(const DeformRunOptions& options, DeformReport& report) {
  const std::vector<SweepTurn> turns = sweep_turns(options.only);
  if (options.scene_seed != 0) {
    for (const SweepTurn& turn : turns) one_scene(turn, options.scene_seed, report);
    return;
  }
  run_rounds(
      turns, Rng(options.seed << 20), options.steps, [&] { return report.steps; },
      [&](const SweepTurn& turn, uint64_t seed) { one_scene(turn, seed, report); });
}

std::string to_json(const DeformReport& r, const std::string& prefix) {
  const std::pair<const char*, uint64_t> figures[] = {{"deform.oracle.steps", r.steps},
                                                      {"deform.oracle.not_free_after", r.not_free},
                                                      {"deform.lost", r.lost},
                                                      {"deform.oracle.wrong", r.wrong},
                                                      {"deform.oracle.whole", r.whole},
                                                      {"deform.oracle.done", r.outcomes[DSW_DEFORM_DONE]},
                                                      {"deform.oracle.held", r.outcomes[DSW_DEFORM_HELD]},
                                                      {"deform.oracle.fraction", r.outcomes[DSW_DEFORM_FRACTION]},
                                                      {"deform.oracle.refused", r.outcomes[DSW_DEFORM_REFUSED]},
                                                      {"deform.oracle.bodies", r.bodies},
                                                      {"deform.oracle.particles", r.particles},
                                                      {"deform.oracle.contacts", r.contacts},
                                                      {"deform.oracle.pushed", r.pushed},
                                                      {"deform.oracle.rigid", r.rigid},
                                                      {"deform.oracle.rigid_moves", r.rigid_moves},
                                                      {"deform.oracle.bent", r.bent},
                                                      {"deform.oracle.validated_parts", r.validated_parts},
                                                      {"deform.oracle.validated_contacts", r.validated_contacts}};
  std::string text = "{";
  for (const auto& [key, value] : figures) {
    text += std::string(text == "{" ? "\n" : ",\n") + "  \"" + prefix + key + "\": " + std::to_string(value);
  }
  return text + "\n}\n";
}

}  // namespace dsw::oracle
