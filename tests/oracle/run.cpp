#include "run.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstdio>
#include <cstring>

namespace dsw::oracle {
namespace {

struct Turn {
  const SceneKind* kind;
  Transform transform;
};

std::vector<Turn> turns(const std::string& only) {
  std::vector<Turn> list;
  for (const SceneKind& kind : all_kinds()) {
    const std::string name = kind.name;
    if (!only.empty() && name != only) continue;
    const bool fine = name == "hex_thin" || name == "tet_slivers" || name == "waist_slivers";
    list.push_back({&kind, Transform::kNone});
    list.push_back({&kind, Transform::kNone});
    if (!fine) list.push_back({&kind, Transform::kFar});  // 1e-12 is nothing beside 1e8
    list.push_back({&kind, Transform::kLarge});
    list.push_back({&kind, Transform::kSmall});
    list.push_back({&kind, Transform::kPower});
    if (kind.integer) {
      list.push_back({&kind, Transform::kDenormal});
      list.push_back({&kind, Transform::kCoarse});
    }
  }
  return list;
}

void mark(World& world, dsw_environment* environment, Rng& rng, Report& report) {
  const double volumes = rng.chance(0.5) ? 0.1 : 0, share = rng.chance(0.5) ? 0.1 : rng.chance(0.2) ? 1 : 0;
  std::vector<dsw_volume_id> ids;
  for (size_t c = 0; c < world.ids.size(); ++c) {
    if (!rng.chance(volumes)) continue;
    world.cell_marked[c] = 1;
    ids.push_back(world.ids[c]);
  }
  std::vector<dsw_face_id> chosen;
  for (Face& f : world.faces) {
    if (!rng.chance(share)) continue;
    f.marked = true;
    const size_t side = f.cell[1] >= 0 && rng.chance(0.5) ? 1 : 0;  // either name is accepted
    const dsw_volume_id owner = world.ids[static_cast<size_t>(f.cell[side])];
    chosen.push_back({owner.index, owner.generation, static_cast<uint32_t>(f.local[side])});
  }
  if (dsw_environment_mark_volumes(environment, ids.data(), ids.size(), DSW_MARK_IMPASSABLE, 0, nullptr) !=
          DSW_STATUS_OK ||
      dsw_environment_mark_faces(environment, chosen.data(), chosen.size(), DSW_MARK_IMPASSABLE) != DSW_STATUS_OK) {
    report.mismatch(std::string("marking failed: ") + dsw_last_error_message());
  }
}

void one_scene(const Turn& turn, uint64_t seed, uint64_t casts, Report& report) {
  Rng rng(seed);
  Mesh mesh = turn.kind->make(rng);
  shuffle_cells(mesh, rng);
  apply_transform(mesh, turn.transform);
  for (size_t c = 0; c < mesh.cells.size(); ++c) mesh.tags.push_back(static_cast<uint32_t>(rng.next()));
  Layout layout;
  layout.index_bytes = rng.chance(0.5) ? 4 : 8;
  layout.separate_faces = rng.chance(0.5);
  layout.stride = rng.chance(0.3) ? 40 : 24;
  const uint32_t plain_flags = rng.chance(0.5) ? DSW_ENVIRONMENT_LOCATE_TREE : 0;
  const uint32_t flags = plain_flags | (turn.kind->may_cross ? DSW_ENVIRONMENT_CHECK_BOUNDARY : 0);
  report.begin(turn.kind->name,
               std::string(turn.kind->name) + transform_name(turn.transform) + " scene seed " + std::to_string(seed));
  const EnvironmentPtr environment = create_environment(mesh, layout, flags);
  if (environment == nullptr) {
    if (const EnvironmentPtr unchecked =
            flags != plain_flags ? create_environment(mesh, layout, plain_flags) : nullptr) {
      const World world(mesh, unchecked.get());
      if (world.fault().empty() && world.outer_boundary_crosses()) {
        ++report.refused;
      } else {
        report.mismatch("a sound outer boundary was refused");
      }
      return;
    }
    // Where doubles are as coarse as the cells, a centre is rounded out of the kernel of its cell.
    const bool coarse = turn.transform == Transform::kDenormal || turn.transform == Transform::kCoarse;
    const bool stars =
        std::any_of(mesh.cells.begin(), mesh.cells.end(), [](const Cell& c) { return c.type != DSW_CELL_TYPE_TETRA; });
    if ((coarse && stars) || may_be_refused(mesh)) {
      ++report.refused;
    } else {
      report.mismatch("a valid mesh was refused");
    }
    return;
  }
  World world(mesh, environment.get());
  if (!world.fault().empty()) {
    report.mismatch(world.fault());
    return;
  }
  if (turn.kind->may_cross && world.outer_boundary_crosses()) {
    report.mismatch("an outer boundary that crosses itself was accepted");
    return;
  }
  dsw_scene_desc desc = defaults(dsw_scene_desc_init);
  const bool crossings = rng.chance(0.5);
  desc.features = rng.chance(0.5) ? uint32_t{DSW_FEATURE_STATISTICS} : 0;
  if (crossings) desc.features |= uint32_t{DSW_FEATURE_CROSSINGS};
  dsw_scene* raw = nullptr;
  if (dsw_scene_create(environment.get(), &desc, &raw) != DSW_STATUS_OK) {
    report.mismatch(std::string("scene: ") + dsw_last_error_message());
    return;
  }
  const ScenePtr scene(raw);
  mark(world, environment.get(), rng, report);
  Checker checker(world, environment.get(), report);
  Motions motions(world, rng);
  const auto any_hint = [&]() {
    return rng.chance(0.4) ? dsw_volume_id{0, 0} : world.ids[rng.below(world.ids.size())];
  };

  std::vector<dsw_particle_id> particles;
  for (int tries = 0; tries < 40 && particles.size() < 8; ++tries) {
    const Vec p = motions.start();
    const int cell = world.locate(world.body(p.data()));
    const dsw_status want = cell < 0                                            ? DSW_STATUS_OUTSIDE
                            : world.cell_marked[static_cast<size_t>(cell)] != 0 ? DSW_STATUS_IMPASSABLE
                                                                                : DSW_STATUS_OK;
    dsw_particle_id id;
    const dsw_status status = dsw_particle_create(scene.get(), p.data(), any_hint(), &id);
    if (status != want) report.mismatch("particle at " + hex(p) + ": " + dsw_status_string(status));
    if (status == DSW_STATUS_OK) particles.push_back(id);
  }

  const uint64_t before = report.total.casts;
  Vec p = motions.start();
  for (uint64_t i = 0; report.total.casts - before < casts && i < 4 * casts; ++i) {
    const uint32_t limit = rng.chance(0.1) ? 1 + rng.below(4u) : 0;
    if (!particles.empty() && rng.chance(0.4)) {
      const dsw_particle_id particle = particles[rng.below(particles.size())];
      Vec from;
      dsw_particle_get_position(scene.get(), particle, from.data(), nullptr);
      checker.move(scene.get(), particle, motions.target(from), limit, crossings);
      continue;
    }
    if (rng.chance(0.05)) checker.locate(motions.site(), any_hint());
    const Vec q = motions.target(p);
    checker.free_cast(p, q, static_cast<Checker::Way>(rng.below(static_cast<int>(Checker::kWays))), any_hint(),
                      rng.chance(0.4), limit);
    p = rng.chance(0.15) ? q : motions.start();
  }
}

}  // namespace

Vec Motions::vertex() {
  const Face& f = world_.faces[rng_.below(world_.faces.size())];
  return world_.mesh.points[static_cast<size_t>(f.loop[rng_.below(f.loop.size())])];
}

Vec Motions::site() {
  const Face& f = world_.faces[rng_.below(world_.faces.size())];
  const auto corner = [&](size_t i) { return world_.mesh.points[static_cast<size_t>(f.loop[i % f.loop.size()])]; };
  const size_t i = rng_.below(f.loop.size());
  Vec p;
  switch (rng_.below(8)) {
    case 0:
      return corner(i);
    case 1: {  // on an edge
      const Vec a = corner(i), b = corner(i + 1);
      const double t = rng_.below(5) * 0.25;
      for (size_t k = 0; k < 3; ++k) p[k] = a[k] + t * (b[k] - a[k]);
      return p;
    }
    case 2: {  // on a triangle of a face, often on its diagonal
      const auto& t = world_.triangles[static_cast<size_t>(f.triangles[rng_.below(f.triangles.size())])].v;
      const double weights[4][3] = {{0.5, 0.25, 0.25}, {0.5, 0.5, 0}, {0, 0.5, 0.5}, {0.25, 0, 0.75}};
      const double* w = weights[rng_.below(4)];
      for (size_t k = 0; k < 3; ++k) {
        p[k] = 0;
        for (size_t j = 0; j < 3; ++j) p[k] += w[j] * world_.mesh.points[static_cast<size_t>(t[j])][k];
      }
      return p;
    }
    case 3: {  // between two vertices anywhere
      const Vec a = vertex(), b = vertex();
      for (size_t k = 0; k < 3; ++k) p[k] = a[k] + 0.5 * (b[k] - a[k]);
      return p;
    }
    case 4:  // near a vertex
      p = vertex();
      for (double& x : p) x = rng_.chance(0.5) ? std::nextafter(x, rng_.chance(0.5) ? DBL_MAX : -DBL_MAX) : x;
      return p;
    default: {
      for (size_t k = 0; k < 3; ++k) p[k] = world_.lower[k] + rng_.unit() * (world_.upper[k] - world_.lower[k]);
      if (rng_.chance(0.3)) p = {p[0], corner(i)[1], p[2]};
      return p;
    }
  }
}

Vec Motions::start() {
  if (rng_.chance(0.4)) return site();
  // Somewhere among the vertices of one cell: inside it as a rule.
  const Cell& cell = world_.mesh.cells[rng_.below(world_.mesh.cells.size())];
  Vec p = {0, 0, 0};
  double left = 1;
  for (int i = 0; i < 6; ++i) {
    const Loop& f = cell.faces[rng_.below(cell.faces.size())];
    const Vec& v = world_.mesh.points[static_cast<size_t>(f[rng_.below(f.size())])];
    const double w = i == 5 ? left : left * rng_.unit();
    left -= w;
    for (size_t k = 0; k < 3; ++k) p[k] += w * v[k];
  }
  return p;
}

std::array<Vec, 2> Motions::ends() {
  const Face& f = world_.faces[rng_.below(world_.faces.size())];
  const int other = f.loop[1 + rng_.below(f.loop.size() - 1)];
  return {world_.mesh.points[static_cast<size_t>(f.loop[0])], world_.mesh.points[static_cast<size_t>(other)]};
}

void run(const RunOptions& options, Report& report) {
  const std::vector<Turn> list = turns(options.only);
  Rng rng(options.seed);
  const uint64_t each = std::min<uint64_t>(4000, std::max<uint64_t>(20, options.casts / (list.size() * 2 + 1)));
  for (int round = 0; report.total.casts < options.casts && !list.empty(); ++round) {
    for (const Turn& turn : list) {
      const uint64_t scene_seed = rng.next() >> 1;
      one_scene(turn, scene_seed, options.casts_a_scene != 0 ? options.casts_a_scene : each, report);
      if (report.total.casts >= options.casts && round > 0) break;
    }
    // A defect that keeps every scene from being made must not loop for ever.
    if (report.total.casts == 0) break;
  }
}

std::string to_json(const Report& report) {
  std::string text = "{\n";
  const auto add = [&](const std::string& key, double value, bool last = false) {
    char line[256];
    std::snprintf(line, sizeof line, "  \"%s\": %.10g%s\n", key.c_str(), value, last ? "" : ",");
    text += line;
  };
  const Tally& t = report.total;
  add("oracle.casts", static_cast<double>(t.casts));
  add("oracle.mismatches", static_cast<double>(t.mismatches));
  add("oracle.lost", static_cast<double>(t.lost));
  add("oracle.ties", static_cast<double>(t.ties));
  add("oracle.tie_share", t.casts == 0 ? 0 : static_cast<double>(t.ties) / static_cast<double>(t.casts));
  add("oracle.contacts", static_cast<double>(t.contacts));
  for (const auto& [name, s] : report.scenes) {
    add("oracle." + name + ".casts", static_cast<double>(s.casts));
    add("oracle." + name + ".mismatches", static_cast<double>(s.mismatches));
    add("oracle." + name + ".ties", static_cast<double>(s.ties));
  }
  add("oracle.refused", static_cast<double>(report.refused));
  add("oracle.stuck", static_cast<double>(t.stuck), true);
  return text + "}\n";
}

}  // namespace dsw::oracle
