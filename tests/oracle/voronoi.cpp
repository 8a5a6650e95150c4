// Voronoi cells: polyhedra with many faces, some of them tiny. Their vertices are circumcentres of Delaunay tetrahedra,
// rounded, so that hardly any face is flat.
#include "scenes.h"

#include <algorithm>
#include <map>

namespace dsw::oracle {
namespace {

Vec minus(const Vec& a, const Vec& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vec cross(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// The dual of tetrahedra: a vertex for each, at its circumcentre and for a share at its barycentre; a cell a point.
Mesh dual(const Mesh& tets, double share) {
  Mesh mesh;
  std::map<std::array<int, 2>, std::vector<size_t>> round_edge;
  std::map<std::array<int, 3>, int> sides;
  for (size_t t = 0; t < tets.cells.size(); ++t) {
    const std::vector<int>& v = tets.cells[t].vertices;
    const auto at = [&](size_t i) -> const Vec& { return tets.points[static_cast<size_t>(v[i])]; };
    const Vec a = minus(at(1), at(0)), b = minus(at(2), at(0)), c = minus(at(3), at(0));
    const Vec bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
    Vec p;
    for (size_t k = 0; k < 3; ++k) {
      const double circum = (dot(a, a) * bc[k] + dot(b, b) * ca[k] + dot(c, c) * ab[k]) / (2 * dot(a, bc));
      p[k] = at(0)[k] + (1 - share) * circum + share * (a[k] + b[k] + c[k]) / 4;
    }
    mesh.points.push_back(p);
    for (size_t i = 0; i < 4; ++i) {
      std::array<int, 3> side = {v[(i + 1) % 4], v[(i + 2) % 4], v[(i + 3) % 4]};
      std::sort(side.begin(), side.end());
      ++sides[side];
      for (size_t j = i + 1; j < 4; ++j) round_edge[{std::min(v[i], v[j]), std::max(v[i], v[j])}].push_back(t);
    }
  }
  std::vector<bool> inside(tets.points.size(), true);
  for (const auto& [side, count] : sides) {
    for (int v : side) inside[static_cast<size_t>(v)] = inside[static_cast<size_t>(v)] && count == 2;
  }
  std::vector<std::vector<Loop>> faces(tets.points.size());
  for (auto& entry : round_edge) {
    const std::array<int, 2>& edge = entry.first;
    std::vector<size_t>& round = entry.second;
    if (!inside[static_cast<size_t>(edge[0])] && !inside[static_cast<size_t>(edge[1])]) continue;
    // Neighbours share two vertices beside the edge's.
    const auto share_side = [&](size_t s, size_t t) {
      const std::vector<int>&a = tets.cells[s].vertices, &b = tets.cells[t].vertices;
      return std::count_if(a.begin(), a.end(), [&](int v) { return std::count(b.begin(), b.end(), v) != 0; }) == 3;
    };
    for (size_t i = 1; i < round.size(); ++i) {
      const auto next = std::find_if(round.begin() + static_cast<std::ptrdiff_t>(i), round.end(),
                                     [&](size_t t) { return share_side(round[i - 1], t); });
      std::iter_swap(round.begin() + static_cast<std::ptrdiff_t>(i), next);
    }
    Loop loop(round.begin(), round.end());
    Vec normal = {0, 0, 0};
    for (size_t i = 1; i + 1 < loop.size(); ++i) {
      const Vec& o = mesh.points[round[0]];
      const Vec n = cross(minus(mesh.points[round[i]], o), minus(mesh.points[round[i + 1]], o));
      for (size_t k = 0; k < 3; ++k) normal[k] += n[k];
    }
    const Vec along = minus(tets.points[static_cast<size_t>(edge[1])], tets.points[static_cast<size_t>(edge[0])]);
    if (dot(normal, along) < 0) std::reverse(loop.begin(), loop.end());
    faces[static_cast<size_t>(edge[0])].push_back(loop);
    std::reverse(loop.begin(), loop.end());
    faces[static_cast<size_t>(edge[1])].push_back(loop);
  }
  for (size_t v = 0; v < faces.size(); ++v) {
    if (inside[v]) mesh.add_polyhedron(faces[v]);
  }
  return mesh;
}

}  // namespace

Mesh voronoi(Rng& rng, double share, int count) {
  for (;;) {
    Mesh mesh = dual(delaunay(rng, count, 4096), share);
    if (mesh.cells.size() < 3 || may_be_refused(mesh)) continue;
    // Points of no cell are left out.
    std::vector<int> number(mesh.points.size(), -1);
    std::vector<Vec> points;
    for (Cell& cell : mesh.cells) {
      for (Loop& loop : cell.faces) {
        for (int& v : loop) {
          int& n = number[static_cast<size_t>(v)];
          if (n < 0) {
            n = static_cast<int>(points.size());
            points.push_back(mesh.points[static_cast<size_t>(v)]);
          }
          v = n;
        }
      }
    }
    mesh.points = points;
    return mesh;
  }
}

}  // namespace dsw::oracle
