#include "sweep_scenes.h"

#include <algorithm>
#include <cmath>
#include <set>

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
    all.insert(all.end(), conformed_kinds().begin(), conformed_kinds().end());
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
  EnvironmentPtr environment = create_environment(mesh, {}, rng.chance(0.5) ? DSW_ENVIRONMENT_LOCATE_TREE : 0);
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
                      edge_shares[] = {0, 0.03, 0.1, 0.3};
  const double volumes = volume_shares[rng.below(4)], shares = face_shares[rng.below(4)];
  const double edge_share = edge_shares[rng.below(4)];
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
      if (rng.chance(edge_share)) {
        marked_edges.push_back(e);
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
        dsw_environment_get_vertex_id(environment.get(), static_cast<uint32_t>(v), &id) != DSW_STATUS_OK) {
      continue;
    }
    ids.push_back(id);
    marked_vertices.push_back(static_cast<int>(v));
  }
  if (dsw_environment_mark_vertices(environment.get(), ids.data(), ids.size(), DSW_MARK_IMPASSABLE) != DSW_STATUS_OK) {
    report.fault(SweepReport::kWrong, std::string("marking failed: ") + dsw_last_error_message());
  }
}

StagePlaces::StagePlaces(const Stage& stage, Rng& rng) : Motions(stage.world, rng), stage_(stage) {
  std::set<int> ends(stage.marked_vertices.begin(), stage.marked_vertices.end());
  for (const auto& edge : stage.marked_edges) ends.insert({edge[0], edge[1]});
  for (int f : stage.free_standing) {
    for (int v : world_.faces[static_cast<size_t>(f)].loop) ends.insert(v);
  }
  for (const Face& f : world_.faces) {
    const auto marked = [&](int cell) { return cell < 0 || world_.cell_marked[static_cast<size_t>(cell)] != 0; };
    if (!marked(f.cell[0]) && !marked(f.cell[1])) continue;
    for (int v : f.loop) ends.erase(v);
  }
  spikes_.assign(ends.begin(), ends.end());
}

Vec StagePlaces::corner(const Loop& loop, size_t i) const {
  return world_.mesh.points[static_cast<size_t>(loop[i % loop.size()])];
}

/// A vertex with room around it, or a place on a marked edge or near the corner of a free-standing face.
Vec StagePlaces::obstacle(double exactly) {
  const auto point = [&](int v) { return world_.mesh.points[static_cast<size_t>(v)]; };
  if (!spikes_.empty() && rng_.chance(exactly)) return point(spikes_[rng_.below(spikes_.size())]);
  if (!stage_.marked_edges.empty() && (stage_.free_standing.empty() || rng_.chance(0.5))) {
    const auto& edge = stage_.marked_edges[rng_.below(stage_.marked_edges.size())];
    return between(point(edge[0]), point(edge[1]), rng_.chance(0.2) ? 0.5 : rng_.unit());
  }
  if (stage_.free_standing.empty()) return site();
  const auto f = static_cast<size_t>(stage_.free_standing[rng_.below(stage_.free_standing.size())]);
  const Loop& loop = world_.faces[f].loop;
  const size_t i = rng_.below(loop.size()), n = loop.size();
  const Vec middle = between(corner(loop, i + 1), corner(loop, i + n - 1), 0.5);
  return between(corner(loop, i), middle, rng_.chance(0.3) ? 0 : rng_.range(0.01, 0.3));
}

/// On a marked edge, or at the corner of a free-standing face, so that the triangle's sides may be free.
bool StagePlaces::round_obstacle(Vec& place, std::array<Vec, 2>& span) {
  const std::vector<int>& faces = stage_.free_standing;
  if (stage_.marked_edges.empty() && faces.empty()) return Motions::round_obstacle(place, span);
  const double reach = rng_.chance(0.5) ? 0.1 : 0.3;
  for (Vec& d : span) d = near({0, 0, 0}, reach);
  const bool at_edge = !stage_.marked_edges.empty() && (faces.empty() || rng_.chance(0.5));
  const bool exactly = rng_.chance(0.2);
  if (at_edge) {
    const auto& e = stage_.marked_edges[rng_.below(stage_.marked_edges.size())];
    const std::vector<Vec>& points = world_.mesh.points;
    place = between(points[static_cast<size_t>(e[0])], points[static_cast<size_t>(e[1])], exactly ? 0.5 : rng_.unit());
    return exactly;
  }
  const Loop& loop = world_.faces[static_cast<size_t>(faces[rng_.below(faces.size())])].loop;
  const size_t i = rng_.below(loop.size()), n = loop.size();
  const Vec middle = between(corner(loop, i + 1), corner(loop, i + n - 1), 0.5);
  place = between(corner(loop, i), middle, exactly ? 0 : rng_.range(0.02, 0.4));
  // Most of the plane lies across the corner: what it cuts off is short.
  Vec w = middle;
  double square = 0;
  for (size_t k = 0; k < 3; ++k) square += (w[k] -= corner(loop, i)[k]) * w[k];
  for (Vec& d : span) {
    double part = 0;
    for (size_t k = 0; k < 3; ++k) part += d[k] * w[k];
    if (!std::isnormal(square) || !std::isfinite(part)) break;
    for (size_t k = 0; k < 3; ++k) d[k] -= 0.9 * part / square * w[k];
  }
  return exactly;
}

Vec StagePlaces::anchor() {
  for (int tries = 0; tries < 30; ++tries) {
    const auto& faces = stage_.free_standing;
    const size_t f = faces.empty() || rng_.chance(0.2) ? rng_.below(world_.faces.size())
                                                       : static_cast<size_t>(faces[rng_.below(faces.size())]);
    if (!world_.impassable(static_cast<int>(f))) continue;
    const size_t i = rng_.below(world_.faces[f].loop.size());
    const double by = rng_.chance(0.7) ? 0 : 0.25 * rng_.between(0, 4);
    return between(corner(world_.faces[f].loop, i), corner(world_.faces[f].loop, i + 1), by);
  }
  return site();
}

}  // namespace dsw::oracle
