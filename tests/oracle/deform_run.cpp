#include "deform_run.h"

#include "rounds.h"
#include "sweep_scenes.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

namespace dsw::oracle {
namespace {

/// The environment as it is now.
struct Picture {
  Picture(const Stage& stage, const std::vector<Vec>& points)
      : world(moved(stage.world.mesh, points), stage.environment.get()) {
    world.cell_marked = stage.world.cell_marked;
    for (size_t f = 0; f < world.faces.size(); ++f) world.faces[f].marked = stage.world.faces[f].marked;
  }
  static Mesh moved(Mesh mesh, const std::vector<Vec>& points) {
    mesh.points = points;
    return mesh;
  }
  World world;
};

class Deformer {
 public:
  Deformer(Stage& stage, Rng& rng, DeformReport& report)
      : stage_(stage),
        arena_(stage.world, stage.wires, stage.marked_vertices),
        places_(stage, rng),
        rng_(rng),
        report_(report) {}

  void run(int count);

 private:
  struct Lodger {
    dsw_body_id id;
    dsw_level level;
    BodyState state;
  };

  void settle();
  std::vector<Vec> next_points();
  void move_towards_body(std::vector<Vec>& points);
  dsw_deform_options next_options();
  bool step();
  void check(const std::string& how);
  void check_vertex(Picture& now, const Vec& at, dsw_volume_id volume, int chamber, const std::string& what);
  int chamber_of(const BodyState& before, const BodyState& now, size_t vertex) const;
  void find_chambers();
  void wrong(const std::string& text) {
    ++report_.wrong;
    report_.faults.fault(SweepReport::kWrong, text);
  }

  Stage& stage_;
  SpaceArena arena_;
  StagePlaces places_;
  Rng& rng_;
  DeformReport& report_;
  ScenePtr scene_;
  std::vector<Lodger> lodgers_;
  std::vector<dsw_particle_id> particles_;
  std::vector<int> chamber_;  // by cell: what can be reached without passing anything impassable
  std::vector<Vec> now_;
  std::vector<std::vector<double>> arrays_;  // what the library reads, and the next one
};

std::vector<double> flat(const std::vector<Vec>& points) {
  std::vector<double> all;
  for (const Vec& p : points) all.insert(all.end(), p.begin(), p.end());
  return all;
}

bool are_finite(const std::vector<Vec>& points) {
  return std::all_of(points.begin(), points.end(),
                     [](const Vec& p) { return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]); });
}

void Deformer::find_chambers() {
  const World& w = stage_.world;
  std::vector<int> root(w.ids.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int c) {
    while (root[static_cast<size_t>(c)] != c) c = root[static_cast<size_t>(c)];
    return c;
  };
  for (size_t f = 0; f < w.faces.size(); ++f) {
    if (w.faces[f].cell[1] < 0 || w.impassable(static_cast<int>(f))) continue;
    root[static_cast<size_t>(find(w.faces[f].cell[0]))] = find(w.faces[f].cell[1]);
  }
  chamber_.clear();
  for (size_t c = 0; c < w.ids.size(); ++c) chamber_.push_back(find(static_cast<int>(c)));
}

/// Bodies and particles.
void Deformer::settle() {
  const uint32_t bodies = 1 + rng_.below(3u);
  for (uint32_t i = 0; i < bodies; ++i) {
    const auto level = static_cast<dsw_level>(1 + rng_.below(4u));
    Bodies source(arena_, places_, rng_, level);
    for (int tries = 0; tries < 10; ++tries) {
      Lodger lodger{{0, 0}, level, {}};
      if (create_body(scene_.get(), source.next(), level, rng_.chance(0.5) ? uint32_t{DSW_BODY_SEQUENCES} : 0u, {},
                      &lodger.id) != DSW_STATUS_OK) {
        continue;
      }
      const std::string fault = read_body(scene_.get(), lodger.id, lodger.state);
      if (!fault.empty()) wrong("a new body: " + fault);
      lodgers_.push_back(lodger);
      ++report_.bodies;
      break;
    }
  }
  const World& w = stage_.world;
  for (int i = 0; i < 6; ++i) {
    double at[3];
    for (size_t k = 0; k < 3; ++k) at[k] = rng_.range(w.lower[k], w.upper[k]);
    dsw_particle_id id;
    if (dsw_particle_create(scene_.get(), at, {0, 0}, &id) != DSW_STATUS_OK) continue;
    particles_.push_back(id);
    ++report_.particles;
  }
}

/// A vertex goes to, exactly through, or past a body's.
void Deformer::move_towards_body(std::vector<Vec>& points) {
  if (lodgers_.empty()) return;
  const BodyState& s = lodgers_[rng_.below(lodgers_.size())].state;
  const size_t v = rng_.below(s.at.size());
  if (s.vertices[v].generation == 0) return;
  const Mesh& mesh = stage_.world.mesh;
  const Cell& cell = mesh.cells[s.volumes[v].index];
  const Loop& loop = cell.faces[rng_.below(cell.faces.size())];
  Vec& p = points[static_cast<size_t>(loop[rng_.below(loop.size())])];
  const double shares[] = {0.5, 1, 1, 1.5, 2};
  const double share = shares[rng_.below(5u)];
  for (size_t k = 0; k < 3; ++k) p[k] += share * (s.at[v][k] - p[k]);
}

std::vector<Vec> Deformer::next_points() {
  const World& w = stage_.world;
  std::vector<Vec> points = now_;
  const double size = w.size, cell = size / std::cbrt(static_cast<double>(w.ids.size()) + 1);
  const double scales[] = {0.02, 0.1, 0.3};
  const double scale = scales[rng_.below(3u)] * cell;
  switch (rng_.below(7u)) {
    case 0: {  // waves
      Vec phase = {rng_.range(0, 6), rng_.range(0, 6), rng_.range(0, 6)};
      for (Vec& p : points) {
        const Vec at = p;
        for (size_t k = 0; k < 3; ++k) p[k] += 2 * scale * std::sin(3 * at[(k + 1) % 3] / size + phase[k]);
      }
      break;
    }
    case 1:  // noise
      for (Vec& p : points) {
        for (double& x : p) x += scale * rng_.range(-1, 1);
      }
      break;
    case 2: {  // everything goes on
      const Vec by = {rng_.range(-2, 2) * cell, rng_.range(-2, 2) * cell, rng_.range(-1, 1) * cell};
      for (Vec& p : points) {
        for (size_t k = 0; k < 3; ++k) p[k] += by[k];
      }
      break;
    }
    case 3: {  // larger, smaller, flatter
      const Vec by = {rng_.range(0.7, 1.3), rng_.range(0.7, 1.3), rng_.range(0.7, 1.3)};
      for (Vec& p : points) {
        for (size_t k = 0; k < 3; ++k) p[k] = w.lower[k] + by[k] * (p[k] - w.lower[k]);
      }
      break;
    }
    case 4:  // back
      points = w.mesh.points;
      break;
    default:
      for (uint32_t i = 0, n = 1 + rng_.below(4u); i < n; ++i) move_towards_body(points);
  }
  return are_finite(points) ? points : now_;
}

dsw_deform_options Deformer::next_options() {
  dsw_deform_options options;
  dsw_deform_options_init(&options, sizeof options);
  options.method = rng_.chance(0.75) ? DSW_DEFORM_SWEPT : DSW_DEFORM_END_STATE;
  options.response = static_cast<dsw_wall_response>(rng_.below(4u));
  if (options.method == DSW_DEFORM_END_STATE && options.response != DSW_WALL_PUSH) options.response = DSW_WALL_STOP;
  options.invalid = rng_.chance(0.7) ? DSW_INVALID_HOLD : DSW_INVALID_REFUSE;
  options.most_halvings = 1 + rng_.below(5u);
  return options;
}

void Deformer::check_vertex(Picture& now, const Vec& at, dsw_volume_id volume, int chamber, const std::string& what) {
  const auto cell = static_cast<int>(volume.index);
  const bool in = now.world.contains(cell, now.world.body(at.data()));
  if (in && now.world.cell_marked[static_cast<size_t>(cell)] == 0 && chamber_[static_cast<size_t>(cell)] == chamber)
    return;
  ++report_.lost;
  int valid = 0;
  dsw_environment_is_valid(stage_.environment.get(), volume, &valid);
  report_.faults.fault(SweepReport::kWrong, what + " at " + hex(at) + (in ? "" : " is not") + " in " +
                                                (valid ? "" : "invalid ") + "volume " + std::to_string(cell) +
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

/// Everything against a picture of the environment as it is.
void Deformer::check(const std::string& how) {
  Picture now(stage_, now_);
  // Where cells are folded over, one that is far away may lie over everything.
  const bool whole =
      now.world.fault().empty() && dsw_environment_check(stage_.environment.get(), nullptr) == DSW_STATUS_OK;
  report_.whole += whole ? 1 : 0;
  SpaceArena arena(now.world, stage_.wires, stage_.marked_vertices);
  for (Lodger& lodger : lodgers_) {
    BodyState state;
    const std::string fault = read_body(scene_.get(), lodger.id, state);
    if (!fault.empty()) wrong(how + ": " + fault);
    if (!now.world.fault().empty()) {
      lodger.state = state;
      continue;
    }
    for (size_t v = 0; v < state.at.size(); ++v) {
      if (state.vertices[v].generation == 0) continue;
      check_vertex(now, state.at[v], state.volumes[v], chamber_of(lodger.state, state, v),
                   how + ": vertex " + std::to_string(v));
    }
    lodger.state = state;
    if (!whole) continue;
    const std::string blocked = BodyChecker(arena, report_.faults).not_free(state, lodger.level);
    if (blocked.empty()) continue;
    ++report_.not_free;
    report_.faults.fault(SweepReport::kNotFreeAfter, how + ": level " + std::to_string(lodger.level) + " " + blocked);
  }
  for (const dsw_particle_id id : particles_) {
    Vec at;
    dsw_volume_id volume;
    if (dsw_particle_get(scene_.get(), id, at.data(), &volume) != DSW_STATUS_OK) {
      wrong(how + ": a particle is gone");
    } else if (now.world.fault().empty()) {
      check_vertex(now, at, volume, chamber_[volume.index], how + ": particle " + std::to_string(id.index));
    }
  }
}

bool Deformer::step() {
  const std::vector<Vec> target = next_points();
  const dsw_deform_options options = next_options();
  std::vector<double> next = flat(target);
  const std::vector<double> asked = next;
  dsw_deform_report report;
  const dsw_status status = dsw_scene_deform(scene_.get(), next.data(), target.size(), &options, &report);
  const std::string how = "step " + std::to_string(report_.steps) + " method " + std::to_string(options.method) +
                          " response " + std::to_string(options.response) + " halvings " +
                          std::to_string(options.most_halvings);
  ++report_.steps;
  if (status != DSW_STATUS_OK) {
    wrong(how + " answers " + dsw_status_string(status) + ": " + dsw_last_error_message());
    return false;
  }
  ++report_.outcomes[report.outcome];
  report_.contacts += report.contact_count;
  report_.pushed += report.pushed_count;
  const bool refused = report.outcome == DSW_DEFORM_REFUSED;
  if (refused && next != asked) wrong(how + ": refused, and next is changed");
  if (report.outcome == DSW_DEFORM_DONE && next != asked) wrong(how + ": done, but not as asked");
  if (!refused) {
    arrays_.push_back(std::move(next));
    if (arrays_.size() > 2) arrays_.erase(arrays_.begin());
    for (size_t v = 0; v < now_.size(); ++v) std::copy_n(&arrays_.back()[3 * v], 3, now_[v].begin());
  }
  const double* points = nullptr;
  size_t count = 0;
  dsw_environment_get_points(stage_.environment.get(), &points, &count);
  if (count != now_.size() || !std::equal(points, points + 3 * count, flat(now_).begin())) {
    wrong(how + ": the environment reads other points");
  }
  check(how);
  return true;
}

void Deformer::run(int count) {
  dsw_scene_desc desc;
  dsw_scene_desc_init(&desc, sizeof desc);
  desc.features = DSW_FEATURE_DEFORMING;
  dsw_scene* scene = nullptr;
  if (dsw_scene_create(stage_.environment.get(), &desc, &scene) != DSW_STATUS_OK) {
    wrong("no scene");
    return;
  }
  scene_.reset(scene);
  now_ = stage_.world.mesh.points;
  find_chambers();
  settle();
  for (int i = 0; i < count && step(); ++i) {
  }
}

void one_scene(const SweepTurn& turn, uint64_t seed, DeformReport& report) {
  Rng rng(seed);
  report.faults.begin(turn.kind->name, std::string(turn.kind->name) + transform_name(turn.transform) + " scene seed " +
                                           std::to_string(seed));
  const std::unique_ptr<Stage> stage = make_stage(turn, seed, rng, report.faults);
  if (stage == nullptr) return;
  stage->mark_vertices(rng, report.faults);
  Deformer(*stage, rng, report).run(8);
}

}  // namespace

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

std::string to_json(const DeformReport& r) {
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
                                                      {"deform.oracle.pushed", r.pushed}};
  std::string text = "{";
  for (const auto& [key, value] : figures) {
    text += std::string(text == "{" ? "\n" : ",\n") + "  \"" + key + "\": " + std::to_string(value);
  }
  return text + "\n}\n";
}

}  // namespace dsw::oracle
