#include "sweep_scenes.h"

#include <algorithm>
#include <cmath>

namespace dsw::oracle {
namespace {

Mesh wide_hexes(Rng& rng) {
  Mesh mesh = hex_grid(axis(6, 16), axis(6, 16), axis(rng.between(4, 6), 16));
  const int warp = rng.chance(0.5) ? 0 : 3;
  for (Vec& p : mesh.points) {
    for (double& x : p) x += rng.between(-warp, warp);
  }
  return mesh;
}

Mesh wide_warped(Rng& rng) {
  Mesh mesh = hex_grid(axis(5, 1), axis(5, 1), axis(5, 1));
  for (Vec& p : mesh.points) {
    for (double& x : p) x += rng.range(-0.2, 0.2);
  }
  return mesh;
}

Mesh wide_delaunay(Rng& rng) { return delaunay(rng, 40, rng.chance(0.5) ? 32 : 1000); }

}  // namespace

const std::vector<SceneKind>& sweep_scenes() {
  static const std::vector<SceneKind> kinds = [] {
    std::vector<SceneKind> all = scene_kinds();
    all.push_back({"wide_hexes", wide_hexes, false});
    all.push_back({"wide_warped", wide_warped, false});
    all.push_back({"wide_delaunay", wide_delaunay, false});
    return all;
  }();
  return kinds;
}

std::vector<SweepTurn> sweep_turns(const std::string& only) {
  std::vector<SweepTurn> turns;
  for (const SceneKind& kind : sweep_scenes()) {
    const std::string name = kind.name;
    if (!only.empty() && name != only) continue;
    const bool fine = name == "hex_thin" || name == "tet_slivers" || name == "waist_slivers";
    const bool wide = name.compare(0, 5, "wide_") == 0;
    for (int i = 0; i < (wide ? 6 : 2); ++i) turns.push_back({&kind, Transform::kNone});
    if (!fine) turns.push_back({&kind, Transform::kFar});
    turns.push_back({&kind, Transform::kLarge});
    turns.push_back({&kind, Transform::kSmall});
  }
  return turns;
}

std::unique_ptr<Stage> make_stage(const SweepTurn& turn, uint64_t seed, Rng& rng, SweepReport& report) {
  Mesh mesh = turn.kind->make(rng);
  shuffle_cells(mesh, rng);
  apply_transform(mesh, turn.transform);
  for (size_t c = 0; c < mesh.cells.size(); ++c) mesh.tags.push_back(static_cast<uint32_t>(rng.next()));
  report.begin(turn.kind->name,
               std::string(turn.kind->name) + transform_name(turn.transform) + " scene seed " + std::to_string(seed));
  if (may_be_refused(mesh)) return nullptr;
  EnvironmentPtr environment = create_environment(mesh, {}, rng.chance(0.5) ? DSW_ENVIRONMENT_LOCATE_GRID : 0);
  if (environment == nullptr) {
    report.fault(SweepReport::kWrong, "a valid mesh was refused");
    return nullptr;
  }
  auto stage = std::make_unique<Stage>(mesh, std::move(environment));
  if (!stage->world.fault().empty()) {
    report.fault(SweepReport::kWrong, stage->world.fault());
    return nullptr;
  }
  stage->mark(rng, report);
  return stage;
}

void Stage::mark(Rng& rng, SweepReport& report) {
  static const double volume_shares[] = {0, 0, 0.05, 0.15}, face_shares[] = {0, 0.03, 0.1, 0.2},
                      wire_shares[] = {0, 0.03, 0.1, 0.3};
  const double volumes = volume_shares[rng.below(4)], shares = face_shares[rng.below(4)];
  const double wire_share = wire_shares[rng.below(4)];
  std::vector<dsw_volume_id> ids;
  std::vector<dsw_face_id> chosen;
  std::vector<dsw_edge_id> edges;
  for (size_t c = 0; c < world.ids.size(); ++c) {
    if (!rng.chance(volumes)) continue;
    world.cell_marked[c] = 1;
    ids.push_back(world.ids[c]);
  }
  for (size_t i = 0; i < world.faces.size(); ++i) {
    Face& f = world.faces[i];
    if (!rng.chance(shares)) continue;
    f.marked = true;
    const dsw_volume_id owner = world.ids[static_cast<size_t>(f.cell[0])];
    chosen.push_back({owner.index, owner.generation, static_cast<uint32_t>(f.local[0])});
    if (f.cell[1] >= 0) free_standing.push_back(static_cast<int>(i));
  }
  for (size_t c = 0; c < world.ids.size(); ++c) {
    uint32_t local = 0;
    for (const auto& e : cell_edges(world.mesh.cells[c])) {
      if (rng.chance(wire_share)) {
        wires.push_back(e);
        edges.push_back({world.ids[c].index, world.ids[c].generation, local});
      }
      ++local;
    }
  }
  dsw_environment* env = environment.get();
  if (dsw_environment_mark_volumes(env, ids.data(), ids.size(), DSW_MARK_IMPASSABLE, 0, nullptr) != DSW_STATUS_OK ||
      dsw_environment_mark_faces(env, chosen.data(), chosen.size(), DSW_MARK_IMPASSABLE) != DSW_STATUS_OK ||
      dsw_environment_mark_edges(env, edges.data(), edges.size(), DSW_MARK_IMPASSABLE) != DSW_STATUS_OK) {
    report.fault(SweepReport::kWrong, std::string("marking failed: ") + dsw_last_error_message());
  }
}

void Stage::mark_vertices(Rng& rng, SweepReport& report) {
  static const double shares[] = {0.02, 0.1, 0.4};
  const double share = shares[rng.below(3)];
  std::vector<dsw_vertex_id> ids;
  std::vector<char> used(world.mesh.points.size(), 0);
  for (const Triangle& t : world.triangles) {
    for (int v : t.v) used[static_cast<size_t>(v)] = 1;
  }
  for (size_t v = 0; v < used.size(); ++v) {
    dsw_vertex_id id;
    if (used[v] == 0 || !rng.chance(share) ||
        dsw_environment_get_vertex(environment.get(), static_cast<uint32_t>(v), &id) != DSW_STATUS_OK) {
      continue;
    }
    ids.push_back(id);
    marked_vertices.push_back(static_cast<int>(v));
  }
  if (dsw_environment_mark_vertices(environment.get(), ids.data(), ids.size(), DSW_MARK_IMPASSABLE) != DSW_STATUS_OK) {
    report.fault(SweepReport::kWrong, std::string("marking failed: ") + dsw_last_error_message());
  }
}

Vec Sweeps::near(const Vec& from, double share) {
  Vec p;
  for (size_t k = 0; k < 3; ++k) p[k] = from[k] + rng_.range(-share, share) * stage_.world.size;
  return p;
}

Vec Sweeps::along(const Vec& from, const Vec& to, double by) const {
  Vec p;
  for (size_t k = 0; k < 3; ++k) p[k] = from[k] + by * (to[k] - from[k]);
  return p;
}

Vec Sweeps::corner(const Loop& loop, size_t i) const {
  return stage_.world.mesh.points[static_cast<size_t>(loop[i % loop.size()])];
}

/// A triangle round a place on a wire, or round the corner of a free-standing face, so that its sides may be free.
void Sweeps::round_obstacle(Sweep& s) {
  Vec site;
  std::array<Vec, 2> span;  // two directions of the triangle's plane
  const double reach = rng_.chance(0.5) ? 0.1 : 0.3;
  for (Vec& d : span) d = near({0, 0, 0}, reach);
  const std::vector<int>& faces = stage_.free_standing;
  const bool wire = !stage_.wires.empty() && (faces.empty() || rng_.chance(0.5));
  const bool exactly = rng_.chance(0.2);
  if (wire) {
    const auto& e = stage_.wires[rng_.below(stage_.wires.size())];
    const std::vector<Vec>& points = stage_.world.mesh.points;
    site = along(points[static_cast<size_t>(e[0])], points[static_cast<size_t>(e[1])], exactly ? 0.5 : rng_.unit());
  } else if (!faces.empty()) {
    const Loop& loop = stage_.world.faces[static_cast<size_t>(faces[rng_.below(faces.size())])].loop;
    const size_t i = rng_.below(loop.size()), n = loop.size();
    const Vec middle = along(corner(loop, i + 1), corner(loop, i + n - 1), 0.5);
    site = along(corner(loop, i), middle, exactly ? 0 : rng_.range(0.02, 0.4));
    // Most of the plane lies across the corner: what it cuts off is short.
    Vec w = along(corner(loop, i), middle, 1);
    double square = 0;
    for (size_t k = 0; k < 3; ++k) square += (w[k] -= corner(loop, i)[k]) * w[k];
    for (Vec& d : span) {
      double part = 0;
      for (size_t k = 0; k < 3; ++k) part += d[k] * w[k];
      if (!std::isnormal(square) || !std::isfinite(part)) break;
      for (size_t k = 0; k < 3; ++k) d[k] -= 0.9 * part / square * w[k];
    }
  } else {
    site = motions_.site();
  }
  // Corners so that the site has positive weights.
  const double w[3] = {rng_.range(0.2, 1), rng_.range(0.2, 1), rng_.range(0.2, 1)};
  const double scale = exactly && stage_.world.lattice ? std::ldexp(1, std::ilogb(stage_.world.size) - 6) : 0;
  for (size_t k = 0; k < 3; ++k) {
    double a = span[0][k], b = span[1][k], c = -(w[0] * a + w[1] * b) / w[2];
    if (scale > 0) {
      a = scale * std::round(a / scale);
      b = scale * std::round(b / scale);
      c = -a - b;
    }
    s.from[k] = site[k] + a;
    s.to[k] = site[k] + b;
    s.fixed[k] = site[k] + c;
  }
  if (rng_.chance(0.5)) std::swap(s.to, s.fixed);
}

/// One or more ends on the vertices or edges of what is impassable.
void Sweeps::anchored(Sweep& s) {
  const World& world = stage_.world;
  const auto anchor = [&]() {
    for (int tries = 0; tries < 30; ++tries) {
      const auto& faces = stage_.free_standing;
      const size_t f = faces.empty() || rng_.chance(0.2) ? rng_.below(world.faces.size())
                                                         : static_cast<size_t>(faces[rng_.below(faces.size())]);
      if (!world.impassable(static_cast<int>(f))) continue;
      const size_t i = rng_.below(world.faces[f].loop.size());
      const double by = rng_.chance(0.7) ? 0 : 0.25 * rng_.between(0, 4);
      return along(corner(world.faces[f].loop, i), corner(world.faces[f].loop, i + 1), by);
    }
    return motions_.site();
  };
  s.fixed = anchor();
  s.from = rng_.chance(0.3) ? anchor() : rng_.chance(0.5) ? near(s.fixed, 0.3) : motions_.start();
  s.to = rng_.chance(0.4) ? anchor() : rng_.chance(0.5) ? near(s.from, 0.3) : motions_.target(s.from);
  if (rng_.chance(0.2)) std::swap(s.from, s.fixed);
}

/// p, p' and q in a row, or falling together.
void Sweeps::in_line(Sweep& s) {
  s.from = motions_.start();
  switch (rng_.below(5)) {
    case 0:
      s.to = s.from;
      s.fixed = motions_.target(s.from);
      return;
    case 1:
      s.fixed = s.from;
      s.to = motions_.target(s.from);
      return;
    case 2:
      s.fixed = motions_.target(s.from);
      s.to = s.fixed;
      return;
    case 3: {  // along an axis
      s.to = s.fixed = s.from;
      const size_t k = rng_.below(3);
      s.to[k] = motions_.site()[k];
      s.fixed[k] = motions_.site()[k];
      return;
    }
    default: {
      static const double by[] = {-1, -0.5, 0.25, 0.5, 1.5, 2};
      s.fixed = motions_.target(s.from);
      s.to = along(s.from, s.fixed, by[rng_.below(6)]);
      return;
    }
  }
}

Sweep Sweeps::next() {
  static const double steps[] = {1e-6, 0.01, 0.1, 0.3, 1, 4};
  Sweep s;
  const uint32_t kind = rng_.below(20);
  const int most = rng_.chance(0.1) ? 1 : 12;  // some may start as they fall
  for (int tries = 0; tries < most; ++tries) {
    if (kind < 5) {
      s.from = motions_.start();
      s.fixed = rng_.chance(0.5) ? near(s.from, 0.2) : motions_.start();
      s.to = near(s.from, steps[rng_.below(6)]);
    } else if (kind < 9) {
      s.from = motions_.site();
      s.fixed = motions_.site();
      s.to = rng_.chance(0.5) ? motions_.site() : motions_.target(s.from);
    } else if (kind < 11) {
      in_line(s);
    } else if (kind < 14) {
      anchored(s);
    } else {
      round_obstacle(s);
    }
    for (Vec* p : {&s.from, &s.to, &s.fixed}) {
      for (double& x : *p) x = std::isfinite(x) ? x : 0;
    }
    const int start = stage_.world.locate(stage_.world.body(s.from.data()));
    if (start < 0 || stage_.world.cell_marked[static_cast<size_t>(start)] != 0) continue;
    if (exact_.blocked(s.from, s.fixed)) continue;
    // What is to be met inside only needs three free sides.
    if (kind < 14 || tries + 2 > most || (!exact_.blocked(s.from, s.to) && !exact_.blocked(s.to, s.fixed))) break;
  }
  s.truth = exact_.sweep(s.from, s.to, s.fixed);
  return s;
}

}  // namespace dsw::oracle
