// Meshes of a few cells, every cell type among them, and what builds them.
#pragma once

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "../environment/test_mesh.h"

namespace dsw::testing_meshes {

using test::kHexahedron;
using test::kPolygon;
using test::kPolyhedron;
using test::kPyramid;
using test::kQuad;
using test::kTetra;
using test::kTriangle;
using test::kWedge;

struct SmallMesh : test::MeshData {
  std::string name;
  int dimension = 3;

  void point(double x, double y, double z = 0) {
    points.insert(points.end(), {x, y});
    if (dimension == 3) points.push_back(z);
  }
  void label() {
    for (size_t i = 0; i < types.size(); ++i) {
      regions.push_back(static_cast<int32_t>(i % 3) - 1);
      tags.push_back(static_cast<uint32_t>(1000 + 7 * i));
    }
  }
};

template <int D>
void build_mesh(Environment<D>& env, const SmallMesh& mesh) {
  BuildReport report;
  mesh.build_into(env, report);
}

inline std::vector<std::vector<int64_t>> box_faces(const std::vector<int64_t>& c) {
  return {{c[0], c[4], c[7], c[3]}, {c[1], c[2], c[6], c[5]}, {c[0], c[1], c[5], c[4]},
          {c[3], c[7], c[6], c[2]}, {c[0], c[3], c[2], c[1]}, {c[4], c[5], c[6], c[7]}};
}

/** Corners of cell (x, y, z) of a lattice with m points along x and y, in VTK's order. */
inline std::vector<int64_t> lattice_corners(int64_t x, int64_t y, int64_t z, int64_t m) {
  const int64_t a = x + m * (y + m * z), b = a + m * m;
  return {a, a + 1, a + 1 + m, a + m, b, b + 1, b + 1 + m, b + m};
}

inline SmallMesh lattice(int64_t n, uint8_t type, double jitter = 0) {
  SmallMesh mesh;
  mesh.name = (type == kPolyhedron ? "lattice of polyhedra "
               : jitter == 0       ? "lattice "
                                   : "warped lattice ") +
              std::to_string(n);
  uint64_t state = 88172645463325252ull;
  const auto noise = [&] {
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return jitter * (static_cast<double>(state % 2001) / 1000.0 - 1.0);
  };
  for (int64_t z = 0; z <= n; ++z) {
    for (int64_t y = 0; y <= n; ++y) {
      for (int64_t x = 0; x <= n; ++x) {
        const double px = static_cast<double>(x) + noise(), py = static_cast<double>(y) + noise();
        mesh.point(px, py, static_cast<double>(z) + noise());
      }
    }
  }
  for (int64_t z = 0; z < n; ++z) {
    for (int64_t y = 0; y < n; ++y) {
      for (int64_t x = 0; x < n; ++x) {
        const std::vector<int64_t> c = lattice_corners(x, y, z, n + 1);
        if (type == kPolyhedron) {
          mesh.polyhedron(box_faces(c));
        } else if (type == kTetra) {
          // Kuhn's six tetrahedra round the diagonal 0-6.
          const size_t steps[6][2] = {{1, 2}, {2, 3}, {3, 7}, {7, 4}, {4, 5}, {5, 1}};
          for (const auto& s : steps) mesh.cell(kTetra, {c[0], c[s[0]], c[s[1]], c[6]});
        } else {
          mesh.cell(type, c);
        }
      }
    }
  }
  if (type == kTetra) mesh.name = "tetrahedra " + std::to_string(n);
  return mesh;
}

/** `count` of `all` equal tetrahedra round the edge 0-1; closed if all are there. */
inline SmallMesh ring(int count, int all) {
  SmallMesh mesh;
  mesh.name = "ring " + std::to_string(count) + " of " + std::to_string(all);
  mesh.point(0, 0, -1);
  mesh.point(0, 0, 1);
  for (int i = 0; i < all; ++i) {
    const double angle = 6.283185307179586 * i / all;
    mesh.point(std::cos(angle), std::sin(angle));
  }
  for (int i = 0; i < count; ++i) mesh.cell(kTetra, {0, 2 + i, 2 + (i + 1) % all, 1});
  return mesh;
}

/** A prism over a regular polygon: n + 2 faces, 2 n vertices. `order` moves where its two large faces begin. */
inline SmallMesh polygon_prism(int64_t n, int64_t order = 0) {
  SmallMesh mesh;
  mesh.name = "prism over " + std::to_string(n) + " from " + std::to_string(order);
  for (int64_t z = 0; z < 2; ++z) {
    for (int64_t i = 0; i < n; ++i) {
      const double angle = 6.283185307179586 * static_cast<double>(i) / static_cast<double>(n);
      mesh.point(std::cos(angle), std::sin(angle), static_cast<double>(z));
    }
  }
  std::vector<std::vector<int64_t>> faces(2);
  for (int64_t i = 0; i < n; ++i) {
    faces[0].push_back((2 * n - i + order) % n);
    faces[1].push_back(n + (i + order) % n);
    faces.push_back({i, (i + 1) % n, n + (i + 1) % n, n + i});
  }
  mesh.polyhedron(faces);
  return mesh;
}

/** Two prisms over polygons with n corners, one on the other. */
inline SmallMesh two_polygon_prisms(int64_t n) {
  SmallMesh mesh = polygon_prism(n);
  mesh.name = "two prisms over " + std::to_string(n);
  for (int64_t i = 0; i < n; ++i) {
    const size_t below = static_cast<size_t>(3 * i);
    mesh.point(mesh.points[below], mesh.points[below + 1], 2);
  }
  std::vector<std::vector<int64_t>> faces(2);
  for (int64_t i = 0; i < n; ++i) {
    faces[0].push_back(n + (2 * n - i) % n);
    faces[1].push_back(2 * n + (i + 3) % n);
    faces.push_back({n + i, n + (i + 1) % n, 2 * n + (i + 1) % n, 2 * n + i});
  }
  mesh.polyhedron(faces);
  return mesh;
}

/** Two lattice boxes side by side, the first as itself or cut up, the second as itself or as a polyhedron; on their
 * common side a prism, a pyramid, a hexahedron or a polyhedron meets one of the others. */
inline SmallMesh pair_of(uint8_t left, uint8_t right) {
  SmallMesh mesh;
  mesh.name = "pair " + std::to_string(left) + " " + std::to_string(right);
  for (int z = 0; z < 2; ++z) {
    for (int y = 0; y < 2; ++y) {
      for (int x = 0; x < 3; ++x) mesh.point(x, y, z);
    }
  }
  const auto add = [&](int64_t i, uint8_t type) {
    const std::vector<int64_t> c = {i, i + 1, i + 4, i + 3, i + 6, i + 7, i + 10, i + 9};
    if (type == kHexahedron) mesh.cell(type, c);
    if (type == kPolyhedron) mesh.polyhedron(box_faces(c));
    if (type == kWedge) {  // cut along 1-3 and 5-7: quads on every side
      mesh.cell(type, {c[0], c[3], c[1], c[4], c[7], c[5]});
      mesh.cell(type, {c[1], c[3], c[2], c[5], c[7], c[6]});
    }
    if (type == kPyramid) {
      const int64_t apex = static_cast<int64_t>(mesh.points.size() / 3);
      mesh.point(static_cast<double>(i) + 0.5, 0.5, 0.5);
      for (const auto& face : box_faces(c)) mesh.cell(type, {face[3], face[2], face[1], face[0], apex});
    }
  };
  add(0, left);
  add(1, right);
  return mesh;
}

inline std::vector<SmallMesh> small_meshes() {
  std::vector<SmallMesh> all;
  SmallMesh one;
  one.name = "one tetrahedron";
  for (const auto& p : {std::pair{0, 0}, {1, 0}, {0, 1}}) one.point(p.first, p.second, 0);
  one.point(0, 0, 1);
  one.cell(kTetra, {0, 1, 2, 3});
  all.push_back(one);
  for (const uint8_t left : {kHexahedron, kWedge, kPyramid, kPolyhedron}) {
    for (const uint8_t right : {kHexahedron, kWedge, kPyramid, kPolyhedron}) all.push_back(pair_of(left, right));
  }
  all.push_back(ring(5, 5));
  all.push_back(ring(4, 6));
  all.push_back(polygon_prism(6));
  all.push_back(polygon_prism(9, 4));
  all.push_back(two_polygon_prisms(6));
  all.push_back(lattice(2, kHexahedron));
  all.push_back(lattice(2, kHexahedron, 0.1));
  all.push_back(lattice(2, kPolyhedron, 0.1));
  all.push_back(lattice(2, kTetra));
  // A tetrahedron on a prism's triangle, beside a part of its own.
  SmallMesh parts = pair_of(kWedge, kHexahedron);
  parts.name = "two parts";
  const int64_t p = static_cast<int64_t>(parts.points.size() / 3);
  parts.point(0.25, 0.25, 2);
  parts.cell(kTetra, {6, 7, 9, p});
  for (const auto& q : {std::pair{10, 0}, {11, 0}, {10, 1}}) parts.point(q.first, q.second, 0);
  parts.point(10, 0, 1);
  parts.point(77, 77, 77);  // used by no cell
  parts.cell(kTetra, {p + 1, p + 2, p + 3, p + 4});
  all.push_back(parts);
  for (SmallMesh& mesh : all) mesh.label();
  return all;
}

inline std::vector<SmallMesh> planar_meshes() {
  std::vector<SmallMesh> all(3);
  all[0].name = "squares";
  all[1].name = "triangles";
  all[2].name = "mixed polygons";
  for (SmallMesh& mesh : all) {
    mesh.dimension = 2;
    for (int y = 0; y < 3; ++y) {
      for (int x = 0; x < 3; ++x) mesh.point(x, y);
    }
    for (int64_t i = 0; i < 4; ++i) {
      const int64_t a = i % 2 + 3 * (i / 2);
      const bool cut = mesh.name == "triangles" || (mesh.name == "mixed polygons" && i == 2);
      if (cut) {
        mesh.cell(kTriangle, {a, a + 1, a + 4});
        mesh.cell(kTriangle, {a, a + 4, a + 3});
      } else {
        mesh.cell(kQuad, {a, a + 1, a + 4, a + 3});
      }
    }
  }
  SmallMesh& mixed = all[2];
  mixed.point(3.5, 0.5);
  mixed.point(3.5, 1.5);
  mixed.cell(kPolygon, {2, 9, 10, 8, 5});
  for (SmallMesh& mesh : all) mesh.label();
  return all;
}

}  // namespace dsw::testing_meshes
