// Meshes whose parts lie on each other, as the library sews them: their cells are read back from an environment.
#include "environments.h"
#include "scenes.h"

namespace dsw::oracle {
namespace {

constexpr double kWidest = 16;  // of the largest boxes: halves and quarters are integers

/// A box with points of its own.
void add_own_box(Mesh& mesh, const Vec& low, double side) {
  const int first = static_cast<int>(mesh.points.size());
  for (int k = 0; k < 8; ++k) {
    const bool x = k % 4 == 1 || k % 4 == 2, y = k % 4 >= 2, z = k >= 4;
    mesh.points.push_back({low[0] + (x ? side : 0), low[1] + (y ? side : 0), low[2] + (z ? side : 0)});
  }
  std::vector<int> corners;
  for (int k = 0; k < 8; ++k) corners.push_back(first + k);
  mesh.add_standard(DSW_CELL_TYPE_HEXAHEDRON, std::move(corners));
}

void divide_box(Mesh& mesh, const Vec& low, double side, int levels, Rng& rng) {
  if (levels == 0 || rng.chance(0.6)) {
    add_own_box(mesh, low, side);
    return;
  }
  const double half = side / 2;
  for (int k = 0; k < 8; ++k) {
    divide_box(mesh, {low[0] + half * (k & 1), low[1] + half * (k >> 1 & 1), low[2] + half * (k >> 2)}, half,
               levels - 1, rng);
  }
}

/// Cells of sizes 1, 1/2 and 1/4.
Mesh octree(Rng& rng) {
  Mesh mesh;
  for (int k = 0; k < 4; ++k) divide_box(mesh, {kWidest * (k & 1), kWidest * (k >> 1), 0}, kWidest, 2, rng);
  return mesh;
}

using Corners = std::vector<std::array<double, 2>>;

/// A square of side 1 as 2, 4 or 5 triangles, counter-clockwise: 5 have a point on a side.
std::vector<Corners> triangles_of_square(Rng& rng) {
  const uint32_t kind = rng.below(4);
  const std::array<double, 2> a{0, 0}, b{1, 0}, c{1, 1}, d{0, 1}, m{0.5, 0.5}, side{0.5, 0};
  if (kind == 0) return {{a, b, c}, {a, c, d}};
  if (kind == 1) return {{a, b, d}, {b, c, d}};
  if (kind == 2) return {{a, b, m}, {b, c, m}, {c, d, m}, {d, a, m}};
  return {{a, side, m}, {side, b, m}, {b, c, m}, {c, d, m}, {d, a, m}};
}

/// Hexahedra below, and above each a few wedges, all with points of their own.
Mesh unlike_faces(Rng& rng) {
  Mesh mesh;
  const int nx = rng.between(1, 3), ny = rng.between(1, 2);
  for (int y = 0; y < ny; ++y) {
    for (int x = 0; x < nx; ++x) {
      add_own_box(mesh, {kWidest * x, kWidest * y, 0}, kWidest);
      for (const Corners& triangle : triangles_of_square(rng)) {
        std::vector<int> wedge;
        for (const double z : {kWidest, 2 * kWidest}) {
          for (const size_t k : {size_t{0}, size_t{2}, size_t{1}}) {  // counter-clockwise seen from below
            wedge.push_back(static_cast<int>(mesh.points.size()));
            mesh.points.push_back({kWidest * (x + triangle[k][0]), kWidest * (y + triangle[k][1]), z});
          }
        }
        mesh.add_standard(DSW_CELL_TYPE_WEDGE, std::move(wedge));
      }
    }
  }
  return mesh;
}

/// Layers that are shifted against each other by half of a box or a quarter of it: no face lies in another one.
Mesh bricks(Rng& rng) {
  Mesh mesh;
  const int layers = rng.between(2, 3);
  for (int z = 0; z < layers; ++z) {
    const double shift = kWidest / 4 * rng.between(0, 3);
    for (int x = 0; x < 3; ++x) add_own_box(mesh, {kWidest * x + shift, 0, kWidest * z}, kWidest);
  }
  return mesh;
}

std::vector<int> loop_of(const dsw_environment* environment, const dsw_cell& cell) {
  size_t count = 0;
  dsw_environment_copy_vertices(environment, cell, nullptr, 0, &count);
  std::vector<dsw_vertex_id> ids(count);
  dsw_environment_copy_vertices(environment, cell, ids.data(), count, &count);
  std::vector<int> vertices;
  for (const dsw_vertex_id& id : ids) vertices.push_back(static_cast<int>(id.index));
  return vertices;
}

/// Each as the volume has it, from its first vertex on, so that edges are numbered as there.
std::vector<Loop> loops_of(const dsw_environment* environment, const dsw_volume_id& volume, uint32_t count) {
  std::vector<Loop> faces;
  for (uint32_t f = 0; f < count; ++f) {
    faces.push_back(loop_of(environment, {DSW_CELL_FACE, volume.index, volume.generation, f}));
  }
  return faces;
}

template <Mesh (*Make)(Rng&)>
Mesh sewn(Rng& rng) {
  Mesh loose = Make(rng);
  if (rng.chance(0.5)) shear(loose, rng);
  return conformed(loose);
}

}  // namespace

Mesh conformed(const Mesh& loose) {
  const EnvironmentPtr environment = create_environment(loose, {}, DSW_ENVIRONMENT_CONFORM);
  Mesh made;
  if (environment == nullptr) return made;
  made.points = loose.points;
  made.loose = loose.cells;
  for (size_t c = 0; c < loose.cells.size(); ++c) {
    dsw_volume_id volume;
    dsw_cell_type type;
    uint32_t faces = 0;
    dsw_environment_get_volume_id(environment.get(), static_cast<uint32_t>(c), &volume);
    dsw_environment_get_volume_counts(environment.get(), volume, &type, nullptr, nullptr, &faces);
    if (type == DSW_CELL_TYPE_POLYHEDRON) {
      made.add_polyhedron(loops_of(environment.get(), volume, faces));
    } else {
      made.add_standard(type, loop_of(environment.get(), {DSW_CELL_VOLUME, volume.index, volume.generation, 0}));
    }
  }
  return made;
}

const std::vector<SceneKind>& conformed_kinds() {
  static const std::vector<SceneKind> kinds = {
      {"octree", sewn<octree>, false}, {"unlike_faces", sewn<unlike_faces>, false}, {"bricks", sewn<bricks>, false}};
  return kinds;
}

const std::vector<SceneKind>& all_kinds() {
  static const std::vector<SceneKind> kinds = [] {
    std::vector<SceneKind> all = scene_kinds();
    all.insert(all.end(), conformed_kinds().begin(), conformed_kinds().end());
    return all;
  }();
  return kinds;
}

}  // namespace dsw::oracle
