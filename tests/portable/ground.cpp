#include "ground.h"

#include "defaults.h"
#include "plane_scenes.h"

#include <algorithm>
#include <cfloat>
#include <cmath>

namespace dsw::portable {
namespace {

using oracle::Cell;
using oracle::Loop;
using oracle::Mesh;
using oracle::Transform;

constexpr Transform kTransforms[] = {Transform::kNone,  Transform::kFar,    Transform::kLarge,   Transform::kSmall,
                                     Transform::kPower, Transform::kCoarse, Transform::kDenormal};

void measure(Ground& ground) {
  if (ground.points.empty()) return;
  ground.lower = ground.upper = ground.points[0];
  for (const Vec& p : ground.points) {
    for (size_t k = 0; k < 3; ++k) {
      ground.lower[k] = std::min(ground.lower[k], p[k]);
      ground.upper[k] = std::max(ground.upper[k], p[k]);
    }
  }
  for (size_t k = 0; k < 3; ++k) ground.size = std::max(ground.size, ground.upper[k] - ground.lower[k]);
}

Ground in_space(const Mesh& mesh, const oracle::Layout& layout, uint32_t flags, dsw_context* context) {
  Ground ground;
  ground.points = mesh.points;
  for (const Cell& cell : mesh.cells) {
    std::vector<int> vertices;
    for (const Loop& face : cell.faces) {
      ground.facets.push_back(face);
      vertices.insert(vertices.end(), face.begin(), face.end());
    }
    ground.cells.push_back(vertices);
  }
  measure(ground);
  oracle::DescArrays arrays(mesh, layout);
  arrays.desc.flags = flags;
  dsw_environment* environment = nullptr;
  ground.status = dsw_environment_create(context, &arrays.desc, &environment, nullptr);
  ground.environment.reset(environment);
  return ground;
}

Ground in_plane(const oracle::plane::Turn& turn, const oracle::plane::World& world, Rng& rng, dsw_context* context) {
  Ground ground;
  ground.dimension = 2;
  for (const oracle::plane::Vec& p : world.points) ground.points.push_back({p[0], p[1], 0});
  for (const oracle::plane::Side& side : world.sides) ground.facets.push_back({side.a, side.b});
  ground.cells = world.cells;
  measure(ground);
  ground.environment = oracle::plane::make_environment(turn, world, rng, context);
  ground.status = ground.environment != nullptr ? DSW_STATUS_OK : DSW_STATUS_INVALID_CELL;
  return ground;
}

const oracle::SceneKind* space_kind(const std::string& name) {
  for (const oracle::SceneKind& kind : oracle::scene_kinds()) {
    if (name == kind.name) return &kind;
  }
  return nullptr;
}

/// A block of boxes, or a tube of them with a bend.
Mesh large_mesh(const std::string& name, Rng& rng) {
  const bool tube = name == "tube";
  Mesh mesh = oracle::hex_grid(oracle::axis(tube ? 20 : 8, 1), oracle::axis(tube ? 4 : 6, 1), oracle::axis(4, 1));
  for (Vec& p : mesh.points) {
    for (double& x : p) x += rng.range(-0.1, 0.1);
    if (tube) p[1] += p[0] * p[0] / 64;
  }
  return mesh;
}

double cell_size(const std::string& name, size_t dimension) {
  if (name == "hall" || name == "tube") return 1;
  if (dimension == 2) {
    const bool small = name == "quads_warped" || name == "thin";
    return small ? 1 : name == "wide" ? 64 : name == "quads" || name == "quads_flat" || name == "joined" ? 8 : 200;
  }
  if (name == "voronoi" || name == "voronoi_warped") return 1;
  return name == "tet_random" ? 400 : name == "tet_lattice" ? 8 : 16;
}

}  // namespace

std::vector<double> Ground::positions() const {
  std::vector<double> all;
  for (const Vec& p : points) all.insert(all.end(), p.begin(), p.begin() + static_cast<std::ptrdiff_t>(dimension));
  return all;
}

std::vector<Kind> kinds() {
  std::vector<Kind> all;
  for (const oracle::SceneKind& kind : oracle::scene_kinds()) all.push_back({kind.name, 3});
  for (const oracle::plane::Kind& kind : oracle::plane::kinds()) all.push_back({kind.name, 2});
  return all;
}

size_t transform_count(const Kind& kind) {
  if (kind.dimension == 2) return oracle::plane::turns(kind.name).size();
  return space_kind(kind.name)->integer ? std::size(kTransforms) : std::size(kTransforms) - 2;
}

Ground make_ground(const Kind& kind, size_t transform, uint64_t seed, dsw_context* context) {
  Rng rng(seed);
  if (kind.dimension == 2) {
    const oracle::plane::Turn turn = oracle::plane::turns(kind.name)[transform];
    const oracle::plane::World world = oracle::plane::make_world(turn, rng);
    return in_plane(turn, world, rng, context);
  }
  Mesh mesh = space_kind(kind.name)->make(rng);
  oracle::shuffle_cells(mesh, rng);
  oracle::apply_transform(mesh, kTransforms[transform]);
  for (size_t c = 0; c < mesh.cells.size(); ++c) mesh.tags.push_back(static_cast<uint32_t>(rng.next()));
  oracle::Layout layout;
  layout.index_bytes = rng.chance(0.5) ? 4 : 8;
  layout.separate_faces = rng.chance(0.5);
  layout.stride = rng.chance(0.3) ? 40 : 24;
  return in_space(mesh, layout, rng.chance(0.5) ? uint32_t{DSW_ENVIRONMENT_LOCATE_TREE} : 0, context);
}

Ground make_even_ground(const Kind& kind, double unit, uint64_t seed, dsw_context* context) {
  Rng rng(seed);
  const double scale = unit / cell_size(kind.name, kind.dimension);
  const auto place = [scale](auto& points) {
    auto lower = points[0];
    for (const auto& p : points) {
      for (size_t k = 0; k < p.size(); ++k) lower[k] = std::min(lower[k], p[k]);
    }
    for (auto& p : points) {
      for (size_t k = 0; k < p.size(); ++k) p[k] = (p[k] - lower[k]) * scale;
    }
  };
  if (kind.dimension == 2) {
    const oracle::plane::Turn turn = oracle::plane::turns(kind.name)[0];
    oracle::plane::World world = oracle::plane::make_world(turn, rng);
    place(world.points);
    return in_plane(turn, world, rng, context);
  }
  const oracle::SceneKind* const known = space_kind(kind.name);
  Mesh mesh = known != nullptr ? known->make(rng) : large_mesh(kind.name, rng);
  place(mesh.points);
  for (size_t c = 0; c < mesh.cells.size(); ++c) mesh.regions.push_back(static_cast<int32_t>(c % 3));
  return in_space(mesh, {}, 0, context);
}

void mark_some(const Ground& ground, double share, Rng& rng) {
  dsw_environment* const environment = ground.environment.get();
  for (uint32_t c = 0; c < ground.cells.size(); ++c) {
    const dsw_volume_id volume = {c, 1};
    uint32_t faces = 0, edges = 0;
    dsw_environment_get_volume_counts(environment, volume, nullptr, nullptr, &edges, &faces);
    if (rng.chance(share)) dsw_environment_mark_volumes(environment, &volume, 1, DSW_MARK_IMPASSABLE, 0, nullptr);
    if (rng.chance(share)) {
      const dsw_face_id face = {c, 1, rng.below(faces)};
      dsw_environment_mark_faces(environment, &face, 1, DSW_MARK_IMPASSABLE);
    }
    if (ground.dimension == 3 && rng.chance(share)) {
      const dsw_edge_id edge = {c, 1, rng.below(edges)};
      dsw_environment_mark_edges(environment, &edge, 1, DSW_MARK_IMPASSABLE);
    }
    if (rng.chance(share / 2)) {
      const std::vector<int>& of = ground.cells[c];
      const dsw_vertex_id vertex = {static_cast<uint32_t>(of[rng.below(of.size())]), 1};
      dsw_environment_mark_vertices(environment, &vertex, 1, DSW_MARK_IMPASSABLE);
    }
  }
}

Vec GroundPlaces::vertex() {
  const Loop& f = ground_.facets[rng_.below(ground_.facets.size())];
  return corner(f, rng_.below(f.size()));
}

std::array<Vec, 2> GroundPlaces::ends() {
  const Loop& f = ground_.facets[rng_.below(ground_.facets.size())];
  return {corner(f, 0), corner(f, 1 + rng_.below(f.size() - 1))};
}

Vec GroundPlaces::start() {
  if (rng_.chance(0.4)) return site();
  const std::vector<int>& cell = ground_.cells[rng_.below(ground_.cells.size())];
  Vec p = {0, 0, 0};
  double left = 1;
  for (int i = 0; i < 6; ++i) {
    const Vec& v = corner(cell, rng_.below(cell.size()));
    const double w = i == 5 ? left : left * rng_.unit();
    left -= w;
    for (size_t k = 0; k < 3; ++k) p[k] += w * v[k];
  }
  return p;
}

Vec GroundPlaces::site() {
  const Loop& f = ground_.facets[rng_.below(ground_.facets.size())];
  const size_t i = rng_.below(f.size());
  switch (rng_.below(8)) {
    case 0:
      return corner(f, i);
    case 1:  // on an edge
      return oracle::between(corner(f, i), corner(f, i + 1), rng_.below(5) * 0.25);
    case 2:  // on a face, often on its diagonal
      return oracle::between(corner(f, i), oracle::between(corner(f, i + 1), corner(f, i + 2), 0.5),
                             rng_.below(3) * 0.5);
    case 3: {  // between two vertices anywhere
      const Vec a = vertex();
      return oracle::between(a, vertex(), 0.5);
    }
    case 4: {  // near a vertex
      Vec p = vertex();
      for (size_t k = 0; k < dimension_; ++k) {
        if (rng_.chance(0.5)) p[k] = std::nextafter(p[k], rng_.chance(0.5) ? DBL_MAX : -DBL_MAX);
      }
      return p;
    }
    default: {
      Vec p;
      for (size_t k = 0; k < 3; ++k) p[k] = ground_.lower[k] + rng_.unit() * (ground_.upper[k] - ground_.lower[k]);
      if (rng_.chance(0.3)) p[1] = corner(f, i)[1];
      return p;
    }
  }
}

}  // namespace dsw::portable
