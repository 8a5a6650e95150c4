#include "scenes.h"

#include <algorithm>
#include <cmath>

namespace dsw::oracle {
namespace {

constexpr double kSide = 16;  // cells of the integer scenes: wide enough for mid points and quarter cuts

// Numbers are drawn one statement at a time: arguments of one call are evaluated in any order.

Mesh grid(Rng& rng) {
  const int nz = rng.between(1, 3), ny = rng.between(2, 4), nx = rng.between(2, 4);
  return hex_grid(axis(nx, kSide), axis(ny, kSide), axis(nz, kSide));
}

void jitter_lattice(Mesh& mesh, Rng& rng, int most) {
  for (Vec& p : mesh.points) {
    for (double& x : p) x += rng.between(-most, most);
  }
}

void jitter(Mesh& mesh, Rng& rng, double most) {
  for (Vec& p : mesh.points) {
    for (double& x : p) x += rng.range(-most, most);
  }
}

/// Half of the time a lattice scene is sheared.
Mesh maybe_sheared(Mesh mesh, Rng& rng) {
  if (rng.chance(0.5)) shear(mesh, rng);
  return mesh;
}

/// Wedges in place of every hexahedron, the diagonal chosen by column so that the mesh stays conformal.
Mesh prisms_of(const Mesh& hexes, Rng& rng, int columns) {
  std::vector<bool> turn(static_cast<size_t>(columns));
  for (size_t i = 0; i < turn.size(); ++i) turn[i] = rng.chance(0.5);
  Mesh out;
  out.points = hexes.points;
  for (size_t i = 0; i < hexes.cells.size(); ++i) {
    const std::vector<int>& v = hexes.cells[i].vertices;
    // Seen from outside means from below for the lower triangle: clockwise from above.
    if (turn[i % turn.size()]) {
      out.add_standard(DSW_CELL_TYPE_WEDGE, {v[0], v[2], v[1], v[4], v[6], v[5]});
      out.add_standard(DSW_CELL_TYPE_WEDGE, {v[0], v[3], v[2], v[4], v[7], v[6]});
    } else {
      out.add_standard(DSW_CELL_TYPE_WEDGE, {v[0], v[3], v[1], v[4], v[7], v[5]});
      out.add_standard(DSW_CELL_TYPE_WEDGE, {v[1], v[3], v[2], v[5], v[7], v[6]});
    }
  }
  return out;
}

Mesh prisms_grid(Rng& rng) {
  const int nx = rng.between(2, 3), ny = rng.between(2, 3), nz = rng.between(1, 3);
  return prisms_of(hex_grid(axis(nx, kSide), axis(ny, kSide), axis(nz, kSide)), rng, nx * ny);
}

Mesh pyramids_grid(Rng& rng) {
  const int nz = rng.between(1, 2), ny = rng.between(1, 2);
  Mesh mesh = hex_grid(axis(2, kSide), axis(ny, kSide), axis(nz, kSide));
  const size_t count = mesh.cells.size();
  for (size_t c = 0; c < count; ++c) {
    Vec centre = {0, 0, 0};
    for (int v : mesh.cells[c].vertices) {
      for (size_t k = 0; k < 3; ++k) centre[k] += mesh.points[static_cast<size_t>(v)][k] / 8;
    }
    split_to_pyramids(mesh, c, centre);
  }
  return mesh;
}

/// Kuhn's six tetrahedra of every cube: conformal, many of them share planes.
Mesh kuhn_grid(Rng& rng) {
  const Mesh hexes = hex_grid(axis(2, kSide), axis(2, kSide), axis(rng.between(1, 2), kSide));
  static const int paths[6][4] = {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6}, {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}};
  Mesh out;
  out.points = hexes.points;
  for (const Cell& c : hexes.cells) {
    for (const auto& p : paths) {
      std::vector<int> v;
      for (int i : p) v.push_back(c.vertices[static_cast<size_t>(i)]);
      out.add_standard(DSW_CELL_TYPE_TETRA, v);
    }
  }
  return out;
}

Mesh truncated_grid(Rng& rng) {
  Mesh mesh = hex_grid(axis(rng.between(2, 3), kSide), axis(2, kSide), axis(2, kSide));
  const int count = static_cast<int>(mesh.points.size());
  for (int v = 0; v < count; ++v) {
    if (rng.chance(0.4)) truncate_vertex(mesh, v, 0.25);
  }
  return mesh;
}

/// Columns whose cross-section is an L of three squares (not convex, vertices in a row) beside a square, and
/// boxes merged from two, all as polyhedra.
Mesh merged_columns(Rng& rng) {
  const int layers = rng.between(1, 3), blocks = rng.between(1, 3);
  Mesh mesh;
  const auto id = [&](int i, int j, int k) { return (k * 3 + j) * (2 * blocks + 1) + i; };
  for (int k = 0; k <= layers; ++k) {
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i <= 2 * blocks; ++i) mesh.points.push_back({i * kSide, j * kSide, k * kSide});
    }
  }
  const auto column = [&](const std::vector<std::array<int, 2>>& base) {
    for (int k = 0; k < layers; ++k) {
      std::vector<Loop> faces(2);
      for (const auto& c : base) faces[1].push_back(id(c[0], c[1], k + 1));
      for (auto c = base.rbegin(); c != base.rend(); ++c) faces[0].push_back(id((*c)[0], (*c)[1], k));
      for (size_t i = 0; i < base.size(); ++i) {
        const auto &a = base[i], &b = base[(i + 1) % base.size()];
        faces.push_back({id(a[0], a[1], k), id(b[0], b[1], k), id(b[0], b[1], k + 1), id(a[0], a[1], k + 1)});
      }
      mesh.add_polyhedron(faces);
    }
  };
  for (int b = 0; b < blocks; ++b) {
    const int x = 2 * b;
    if (rng.chance(0.6)) {
      column({{x, 0}, {x + 1, 0}, {x + 2, 0}, {x + 2, 1}, {x + 1, 1}, {x + 1, 2}, {x, 2}, {x, 1}});
      column({{x + 1, 1}, {x + 2, 1}, {x + 2, 2}, {x + 1, 2}});
    } else {
      column({{x, 0}, {x + 1, 0}, {x + 2, 0}, {x + 2, 1}, {x + 1, 1}, {x, 1}});
      column({{x, 1}, {x + 1, 1}, {x + 2, 1}, {x + 2, 2}, {x + 1, 2}, {x, 2}});
    }
  }
  return mesh;
}

/// All cell types side by side: columns of wedges and of hexahedra, some turned into pyramids (those with a base on
/// the boundary into tetrahedra), some vertices cut off.
Mesh mixed_grid(Rng& rng) {
  const int nx = 3, ny = 2, nz = 2;
  const Mesh hexes = hex_grid(axis(nx, kSide), axis(ny, kSide), axis(nz, kSide));
  Mesh mesh;
  mesh.points = hexes.points;
  bool wedge[6];
  for (bool& w : wedge) w = rng.chance(0.35);
  for (size_t i = 0; i < hexes.cells.size(); ++i) {
    const std::vector<int>& v = hexes.cells[i].vertices;
    if (wedge[i % (nx * ny)]) {
      mesh.add_standard(DSW_CELL_TYPE_WEDGE, {v[0], v[2], v[1], v[4], v[6], v[5]});
      mesh.add_standard(DSW_CELL_TYPE_WEDGE, {v[0], v[3], v[2], v[4], v[7], v[6]});
    } else {
      mesh.add_standard(DSW_CELL_TYPE_HEXAHEDRON, v);
    }
  }
  size_t count = mesh.cells.size();
  for (size_t c = 0; c < count; ++c) {
    if (mesh.cells[c].type != DSW_CELL_TYPE_HEXAHEDRON || rng.chance(0.5)) continue;
    Vec centre = {0, 0, 0};
    for (int v : mesh.cells[c].vertices) {
      for (size_t k = 0; k < 3; ++k) centre[k] += mesh.points[static_cast<size_t>(v)][k] / 8;
    }
    split_to_pyramids(mesh, c, centre);
  }
  count = mesh.cells.size();
  for (size_t c = 0; c < count; ++c) {
    if (mesh.cells[c].type != DSW_CELL_TYPE_PYRAMID) continue;
    const Vec& a = mesh.points[static_cast<size_t>(mesh.cells[c].vertices[0])];
    const Vec& b = mesh.points[static_cast<size_t>(mesh.cells[c].vertices[2])];
    const double high[3] = {nx * kSide, ny * kSide, nz * kSide};
    for (size_t k = 0; k < 3; ++k) {
      if (a[k] == b[k] && (a[k] == 0 || a[k] == high[k]) && rng.chance(0.5)) {
        split_pyramid(mesh, c);
        break;
      }
    }
  }
  const int points = static_cast<int>(mesh.points.size());
  for (int v = 0; v < points; ++v) {
    if (rng.chance(0.12)) truncate_vertex(mesh, v, 0.25);
  }
  return mesh;
}

/// Tetrahedra over squares whose corners lie at heights 0 and 1e-12, between two layers of wedges.
Mesh waist_slivers(Rng& rng) {
  const int nx = rng.between(1, 3), ny = rng.between(1, 3);
  Mesh mesh;
  const double thin = 1e-12 * rng.range(0.5, 2);
  const auto id = [&](int i, int j, int k) { return (k * (ny + 1) + j) * (nx + 1) + i; };
  for (int k = 0; k < 3; ++k) {
    for (int j = 0; j <= ny; ++j) {
      for (int i = 0; i <= nx; ++i) {
        const bool up = (i + j) % 2 != 0;
        mesh.points.push_back({i * 1.0, j * 1.0, k == 1 ? (up ? thin : 0.0) : k - 1.0});
      }
    }
  }
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      std::array<std::array<int, 2>, 4> c = {{{i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j + 1}}};
      if ((i + j) % 2 != 0) std::rotate(c.begin(), c.begin() + 1, c.end());  // c[0], c[2] low, c[1], c[3] high
      int v[4][3];
      for (size_t a = 0; a < 4; ++a) {
        for (int k = 0; k < 3; ++k) v[a][k] = id(c[a][0], c[a][1], k);
      }
      mesh.add_standard(DSW_CELL_TYPE_TETRA, {v[0][1], v[1][1], v[2][1], v[3][1]});
      // Above: the two triangles that the high diagonal makes; below: those of the low diagonal.
      const int above[2][3] = {{1, 3, 0}, {1, 2, 3}}, below[2][3] = {{0, 1, 2}, {0, 2, 3}};
      for (const auto& t : above) {
        mesh.add_standard(DSW_CELL_TYPE_WEDGE,
                          {v[t[0]][1], v[t[2]][1], v[t[1]][1], v[t[0]][2], v[t[2]][2], v[t[1]][2]});
      }
      for (const auto& t : below) {
        mesh.add_standard(DSW_CELL_TYPE_WEDGE,
                          {v[t[0]][0], v[t[2]][0], v[t[1]][0], v[t[0]][1], v[t[2]][1], v[t[1]][1]});
      }
    }
  }
  return mesh;
}

Mesh thin_layers(Rng& rng) {
  const std::vector<double> z = {0, 1, 1 + 1e-12, 1 + 2e-12, 2};
  Mesh mesh = hex_grid({0, 1e-12, 1, 2}, axis(2, 1), z);
  return rng.chance(0.5) ? mesh : prisms_of(mesh, rng, 6);
}

Mesh scaled(Mesh mesh, double x, double y, double z) {
  for (Vec& p : mesh.points) p = {p[0] * x, p[1] * y, p[2] * z};
  return mesh;
}

Mesh warped(Mesh mesh, Rng& rng, double by) {
  jitter(mesh, rng, by * kSide);
  return mesh;
}

Mesh make_hex(Rng& rng) { return grid(rng); }
Mesh make_hex_sheared(Rng& rng) {
  Mesh mesh = grid(rng);
  shear(mesh, rng);
  return mesh;
}
Mesh make_hex_warped_lattice(Rng& rng) {
  Mesh mesh = grid(rng);
  jitter_lattice(mesh, rng, 3);
  return maybe_sheared(std::move(mesh), rng);
}
Mesh make_hex_warped(Rng& rng) { return warped(grid(rng), rng, 0.2); }
Mesh make_tet_kuhn(Rng& rng) { return maybe_sheared(kuhn_grid(rng), rng); }
Mesh make_tet_lattice(Rng& rng) {
  const int size = rng.chance(0.5) ? 16 : 64;
  return delaunay(rng, rng.between(8, 16), size);
}
Mesh make_tet_random(Rng& rng) {
  return scaled(delaunay(rng, rng.between(8, 16), 4096), 0.31622776601683794, 0.31415926535897931, 0.33333333333333331);
}
Mesh make_tet_slivers(Rng& rng) { return scaled(delaunay(rng, rng.between(8, 16), 1000), 1, 1.1, 1e-12); }
Mesh make_pyramids(Rng& rng) { return maybe_sheared(pyramids_grid(rng), rng); }
Mesh make_pyramids_warped(Rng& rng) { return warped(pyramids_grid(rng), rng, 0.1); }
Mesh make_prisms(Rng& rng) { return maybe_sheared(prisms_grid(rng), rng); }
Mesh make_prisms_warped(Rng& rng) { return warped(prisms_grid(rng), rng, 0.15); }
Mesh make_polyhedra(Rng& rng) { return maybe_sheared(truncated_grid(rng), rng); }
Mesh make_polyhedra_warped(Rng& rng) { return warped(truncated_grid(rng), rng, 0.04); }
Mesh make_polyhedra_merged(Rng& rng) { return maybe_sheared(merged_columns(rng), rng); }
Mesh make_voronoi(Rng& rng) { return scaled(voronoi(rng, 0), 1.0 / 1024, 1.0 / 1024, 1.0 / 1024); }
Mesh make_voronoi_warped(Rng& rng) { return scaled(voronoi(rng, 0.3), 1.0 / 1024, 1.0 / 1024, 1.0 / 1024); }
Mesh make_mixed(Rng& rng) { return maybe_sheared(mixed_grid(rng), rng); }
Mesh make_mixed_warped(Rng& rng) {
  Mesh mesh = mixed_grid(rng);
  if (rng.chance(0.5)) {
    mesh = scaled(std::move(mesh), 4, 4, 4);
    jitter_lattice(mesh, rng, 1);
  } else {
    jitter(mesh, rng, 0.015 * kSide);
  }
  return mesh;
}

}  // namespace

void shear(Mesh& mesh, Rng& rng) {
  int m[3][3], det = 0;
  do {
    for (auto& row : m) {
      for (int& x : row) x = rng.between(-2, 2);
    }
    det = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
          m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  } while (det <= 0);
  for (Vec& p : mesh.points) {
    const Vec q = p;
    for (size_t k = 0; k < 3; ++k) p[k] = m[k][0] * q[0] + m[k][1] * q[1] + m[k][2] * q[2];
  }
}

std::vector<double> axis(int n, double s) {
  std::vector<double> a;
  for (int i = 0; i <= n; ++i) a.push_back(i * s);
  return a;
}

Mesh hex_grid(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& z) {
  Mesh mesh;
  const int nx = static_cast<int>(x.size()), ny = static_cast<int>(y.size());
  for (double c : z) {
    for (double b : y) {
      for (double a : x) mesh.points.push_back({a, b, c});
    }
  }
  const auto id = [&](int i, int j, int k) { return (k * ny + j) * nx + i; };
  for (int k = 0; k + 1 < static_cast<int>(z.size()); ++k) {
    for (int j = 0; j + 1 < ny; ++j) {
      for (int i = 0; i + 1 < nx; ++i) {
        mesh.add_standard(DSW_CELL_TYPE_HEXAHEDRON,
                          {id(i, j, k), id(i + 1, j, k), id(i + 1, j + 1, k), id(i, j + 1, k), id(i, j, k + 1),
                           id(i + 1, j, k + 1), id(i + 1, j + 1, k + 1), id(i, j + 1, k + 1)});
      }
    }
  }
  return mesh;
}

void shuffle_cells(Mesh& mesh, Rng& rng) {
  std::vector<Cell>& cells = mesh.loose.empty() ? mesh.cells : mesh.loose;
  for (size_t i = cells.size(); i > 1; --i) std::swap(cells[i - 1], cells[rng.below(i)]);
  if (mesh.loose.empty()) return;
  Mesh loose;  // faces of a cell are in the order of the cells beside it
  loose.points = mesh.points;
  loose.cells = mesh.loose;
  mesh = conformed(loose);
}

namespace {

struct Transformation {
  const char* name;
  double factor, offset;
};

Transformation transformation_of(Transform t) {
  switch (t) {
    case Transform::kFar:
      return {"+1e8", 1, 1e8};
    case Transform::kLarge:
      return {"*1e100", 1e100, 0};
    case Transform::kSmall:
      return {"*1e-100", 1e-100, 0};
    case Transform::kPower:
      return {"*2^900", 0x1p900, 0};
    case Transform::kDenormal:
      return {"*2^-1074", 0x1p-1074, 0};
    case Transform::kCoarse:  // neighbouring doubles are 1 apart
      return {"+2^52", 1, 0x1p52 + 0x1p20};
    case Transform::kVast:
      return {"*1e300", 1e300, 0};
    case Transform::kTiny:
      return {"*1e-300", 1e-300, 0};
    default:
      return {"", 1, 0};
  }
}

}  // namespace

const char* transform_name(Transform t) { return transformation_of(t).name; }

double transformed(double x, Transform t) {
  const Transformation by = transformation_of(t);
  return by.offset != 0 ? x + by.offset : x * by.factor;
}

void apply_transform(Mesh& mesh, Transform t) {
  if (t != Transform::kNone && t != Transform::kPower) mesh.loose.clear();  // rounding would part what was sewn
  for (Vec& p : mesh.points) {
    for (double& x : p) x = transformed(x, t);
  }
}

const std::vector<SceneKind>& scene_kinds() {
  static const std::vector<SceneKind> kinds = {
      {"hex", make_hex, true},
      {"hex_sheared", make_hex_sheared, true},
      {"hex_warped_lattice", make_hex_warped_lattice, true},
      {"hex_warped", make_hex_warped, false},
      {"hex_thin", thin_layers, false},
      {"tet_kuhn", make_tet_kuhn, true},
      {"tet_lattice", make_tet_lattice, true},
      {"tet_random", make_tet_random, false},
      {"tet_slivers", make_tet_slivers, false},
      {"waist_slivers", waist_slivers, false},
      {"pyramids", make_pyramids, true},
      {"pyramids_warped", make_pyramids_warped, false},
      {"prisms", make_prisms, true},
      {"prisms_warped", make_prisms_warped, false},
      {"polyhedra", make_polyhedra, false},
      {"polyhedra_warped", make_polyhedra_warped, false},
      {"polyhedra_merged", make_polyhedra_merged, false},
      {"voronoi", make_voronoi, false},
      {"voronoi_warped", make_voronoi_warped, false, true},
      {"mixed", make_mixed, false},
      {"mixed_warped", make_mixed_warped, false},
  };
  return kinds;
}

}  // namespace dsw::oracle
