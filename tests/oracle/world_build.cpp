// Builds a World: topology from the mesh, diagonals from the library's trace, numbers from the points.
#include "world.h"

#include <algorithm>
#include <cfloat>
#include <cstring>
#include <unordered_map>

namespace dsw::oracle {
namespace {

struct HashOfInts {
  size_t operator()(const std::vector<int>& v) const {
    uint64_t hash = 0;
    for (int x : v) hash = (hash ^ static_cast<uint32_t>(x)) * 0x9e3779b97f4a7c15u, hash ^= hash >> 32;
    return static_cast<size_t>(hash);
  }
};

std::vector<int> sorted(std::vector<int> v) {
  std::sort(v.begin(), v.end());
  return v;
}

/// The vertex of a cell that is there; -1: none is.
int vertex_at(const Mesh& mesh, const Cell& cell, const double* p) {
  int found = -1;
  for (const Loop& loop : cell.faces) {
    for (int v : loop) {
      const Vec& at = mesh.points[static_cast<size_t>(v)];
      if (at[0] == p[0] && at[1] == p[1] && at[2] == p[2]) found = v;
    }
  }
  return found;
}

}  // namespace

World::World(const Mesh& m, const dsw_environment* environment, const Changed& changed) : mesh(m) {
  read_topology(environment, changed);
  if (!fault_.empty()) return;
  prepare_numbers();
  for (size_t t = 0; t < triangles.size(); ++t) all_.push_back(static_cast<int>(t));
  tie_.assign(triangles.size(), 0);
}

void World::read_topology(const dsw_environment* environment, const Changed& changed) {
  const size_t count = mesh.cells.size();
  ids.resize(count);
  cell_marked.assign(count, 0);
  cell_triangles.resize(count);
  cell_faces.resize(count);
  used_.assign(mesh.points.size(), 0);
  // Sorted vertices, and what tells it from others with the same -> face.
  std::unordered_map<std::vector<int>, int, HashOfInts> face_of;
  for (size_t c = 0; c < count; ++c) {
    if (!changed.volumes.empty()) {
      ids[c] = changed.volumes[c];
    } else if (dsw_environment_get_volume_id(environment, static_cast<uint32_t>(c), &ids[c]) != DSW_STATUS_OK) {
      fault_ = "get_volume failed for cell " + std::to_string(c);
      return;
    }
    for (size_t f = 0; f < mesh.cells[c].faces.size(); ++f) {
      const Loop& loop = mesh.cells[c].faces[f];
      std::vector<int> key = sorted(loop);
      if (!changed.outer.empty() && changed.outer[c][f] != 0) key.push_back(-1 - static_cast<int>(c));
      const auto [it, fresh] = face_of.insert({key, static_cast<int>(faces.size())});
      if (fresh) {
        faces.emplace_back();
        faces.back().loop = loop;
      }
      Face& face = faces[static_cast<size_t>(it->second)];
      const size_t side = fresh ? 0 : 1;
      face.cell[side] = static_cast<int>(c);
      face.local[side] = static_cast<int>(f);
      cell_faces[c].push_back(it->second);
      for (int v : loop) used_[static_cast<size_t>(v)] = 1;
    }
  }
  dsw_trace* trace = nullptr;
  dsw_trace_create(nullptr, &trace);
  for (size_t c = 0; c < count && fault_.empty(); ++c) {
    dsw_trace_clear(trace);
    dsw_trace_data data;
    std::memset(&data, 0, sizeof data);
    data.struct_size = sizeof data;
    if (dsw_trace_add_volumes(trace, environment, &ids[c], 1, static_cast<uint32_t>(c)) != DSW_STATUS_OK ||
        dsw_trace_get_data(trace, &data) != DSW_STATUS_OK) {
      fault_ = "no trace of cell " + std::to_string(c);
      break;
    }
    std::vector<std::pair<int, int>> edges, reversed;  // of the triangles
    std::vector<int> in_face(mesh.cells[c].faces.size(), 0);
    for (size_t i = 0; i < data.triangle_count; ++i) {
      std::vector<int> v;
      for (size_t k = 0; k < 3; ++k) {
        const int found =
            vertex_at(mesh, mesh.cells[c], data.points + 3 * static_cast<size_t>(data.triangles[3 * i + k]));
        if (found < 0) {
          fault_ = "a triangle of cell " + std::to_string(c) + " has a point that is none of its vertices";
          break;
        }
        v.push_back(found);
      }
      if (!fault_.empty()) break;
      size_t f = 0;
      for (; f < mesh.cells[c].faces.size(); ++f) {
        const Loop& loop = mesh.cells[c].faces[f];
        const bool inside = std::all_of(v.begin(), v.end(),
                                        [&](int x) { return std::find(loop.begin(), loop.end(), x) != loop.end(); });
        if (inside && in_face[f] + 2 < static_cast<int>(loop.size())) break;
      }
      if (f == mesh.cells[c].faces.size()) {
        fault_ = "a triangle of cell " + std::to_string(c) + " belongs to none of its faces";
        break;
      }
      ++in_face[f];
      for (size_t k = 0; k < 3; ++k) {
        edges.emplace_back(v[k], v[(k + 1) % 3]);
        reversed.emplace_back(v[(k + 1) % 3], v[k]);
      }
      const int face = cell_faces[c][f];
      std::vector<int>& of_face = faces[static_cast<size_t>(face)].triangles;
      const auto it = std::find_if(of_face.begin(), of_face.end(), [&](int t) {
        return std::is_permutation(v.begin(), v.end(), triangles[static_cast<size_t>(t)].v);
      });
      const int index = it == of_face.end() ? static_cast<int>(triangles.size()) : *it;
      if (it == of_face.end()) {
        Triangle t;
        for (size_t k = 0; k < 3; ++k) t.v[k] = v[k];
        t.cell[0] = static_cast<int>(c);
        t.cell[1] = -1;
        t.face = face;
        triangles.push_back(t);
        of_face.push_back(index);
      } else {
        Triangle& t = triangles[static_cast<size_t>(index)];
        int turn = 0;
        while (turn < 3 && t.v[turn] != v[0]) ++turn;
        if (t.cell[1] >= 0 || t.face != face || t.v[(turn + 1) % 3] != v[2]) {
          fault_ = "the two sides of a triangle of cell " + std::to_string(c) + " do not fit";
          break;
        }
        t.cell[1] = static_cast<int>(c);
      }
      cell_triangles[c].push_back(index);
    }
    std::sort(edges.begin(), edges.end());
    std::sort(reversed.begin(), reversed.end());
    if (edges != reversed && fault_.empty()) fault_ = "the triangles of cell " + std::to_string(c) + " do not close";
    for (size_t f = 0; f < in_face.size() && fault_.empty(); ++f) {
      if (in_face[f] + 2 != static_cast<int>(mesh.cells[c].faces[f].size())) {
        fault_ = "face " + std::to_string(f) + " of cell " + std::to_string(c) + " is not covered by triangles";
      }
    }
  }
  dsw_trace_destroy(trace);
  for (const Triangle& t : triangles) {
    if (fault_.empty() && (t.cell[1] >= 0) != (faces[static_cast<size_t>(t.face)].cell[1] >= 0)) {
      fault_ = "a face of cell " + std::to_string(t.cell[0]) + " is cut differently from its two sides";
    }
  }
}

void World::prepare_numbers() {
  int lowest = INT_MAX;
  double most = 0;
  size_t first = mesh.points.size();
  lower = {HUGE_VAL, HUGE_VAL, HUGE_VAL};
  upper = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  for (size_t i = 0; i < mesh.points.size(); ++i) {
    if (used_[i] == 0) continue;
    first = std::min(first, i);
    for (size_t k = 0; k < 3; ++k) {
      const double x = mesh.points[i][k];
      lowest = std::min(lowest, lowest_exponent(x));
      most = std::max(most, std::fabs(x));
      lower[k] = std::min(lower[k], x);
      upper[k] = std::max(upper[k], x);
    }
  }
  for (size_t k = 0; k < 3; ++k) size = std::max(size, upper[k] - lower[k]);
  exponent_ = -std::ilogb(most);
  need_ = -lowest;
  // Three more bits than the points need, so that mid points and quarters stay on the lattice.
  fine_ = -lowest + 3;
  const double widest = std::ldexp(size, fine_), farthest = std::ldexp(most, fine_);
  lattice = widest <= 0x1p16 && farthest <= 0x1p50;
  for (size_t k = 0; k < 3; ++k) origin_[k] = lattice ? std::ldexp(mesh.points[first][k], fine_) : 0;
  norm_.resize(mesh.points.size());
  at_.resize(mesh.points.size());
  big_.resize(mesh.points.size());
  for (size_t i = 0; i < mesh.points.size(); ++i) {
    if (used_[i] == 0) continue;
    for (size_t k = 0; k < 3; ++k) {
      norm_[i][k] = std::ldexp(mesh.points[i][k], exponent_);
      if (std::ldexp(norm_[i][k], -exponent_) != mesh.points[i][k]) fault_ = "points of too different a size";
      at_[i][k] = lattice ? static_cast<int64_t>(std::ldexp(mesh.points[i][k], fine_) - origin_[k]) : 0;
      big_[i][k] = to_big(mesh.points[i][k], need_);
    }
  }
  for (Triangle& t : triangles) {
    const auto a = static_cast<size_t>(t.v[0]), b = static_cast<size_t>(t.v[1]), c = static_cast<size_t>(t.v[2]);
    for (size_t k = 0; k < 3; ++k) {
      const size_t i = (k + 1) % 3, j = (k + 2) % 3;
      const double l = (norm_[b][i] - norm_[a][i]) * (norm_[c][j] - norm_[a][j]);
      const double r = (norm_[b][j] - norm_[a][j]) * (norm_[c][i] - norm_[a][i]);
      t.n[k] = l - r;
      t.p[k] = std::fabs(l) + std::fabs(r);
      t.ln[k] = (at_[b][i] - at_[a][i]) * (at_[c][j] - at_[a][j]) - (at_[b][j] - at_[a][j]) * (at_[c][i] - at_[a][i]);
      t.bn[k] =
          (big_[b][i] - big_[a][i]) * (big_[c][j] - big_[a][j]) - (big_[b][j] - big_[a][j]) * (big_[c][i] - big_[a][i]);
    }
    if (sgn(t.bn[0]) == 0 && sgn(t.bn[1]) == 0 && sgn(t.bn[2]) == 0) fault_ = "a boundary triangle is flat";
  }
  // Two far ends for rays, in directions that no scene knows: one on the lattice, one not.
  Vec far[2];
  const double steps[3] = {190003, 170047, 230081};
  for (size_t k = 0; k < 3; ++k) {
    far[0][k] = lattice ? std::ldexp(origin_[k] + steps[k], -fine_) : 0;
    far[1][k] = std::ldexp(3.0 + 0.1 * static_cast<double>(k + 1), -exponent_);
  }
  far_ = {body(far[0].data()), body(far[1].data())};
}

std::vector<int> World::near_segment(const double* p, const double* q, double margin) const {
  // Clip p -> q to the enlarged box of the scene in plain doubles, then keep what the enlarged box of the rest meets.
  double t0 = 0, t1 = 1;
  for (size_t k = 0; k < 3; ++k) {
    const double u = q[k] - p[k], lo = lower[k] - margin, hi = upper[k] + margin;
    if (std::fabs(u) < DBL_MIN) continue;
    const double a = (lo - p[k]) / u, b = (hi - p[k]) / u;
    t0 = std::max(t0, std::min(a, b));
    t1 = std::min(t1, std::max(a, b));
  }
  Vec lo, hi;
  for (size_t k = 0; k < 3; ++k) {
    const double u = q[k] - p[k], a = p[k] + t0 * u, b = p[k] + t1 * u;
    lo[k] = std::min(a, b) - margin;
    hi[k] = std::max(a, b) + margin;
  }
  std::vector<unsigned> beyond(mesh.points.size(), 0);  // of which planes of the box each point is
  for (size_t i = 0; i < mesh.points.size(); ++i) {
    for (size_t k = 0; k < 3; ++k) {
      beyond[i] |= static_cast<unsigned>(mesh.points[i][k] < lo[k]) << k;
      beyond[i] |= static_cast<unsigned>(mesh.points[i][k] > hi[k]) << (k + 3);
    }
  }
  std::vector<int> near;
  for (size_t i = 0; i < triangles.size(); ++i) {
    const int* const v = triangles[i].v;
    const unsigned all =
        beyond[static_cast<size_t>(v[0])] & beyond[static_cast<size_t>(v[1])] & beyond[static_cast<size_t>(v[2])];
    if (all == 0) near.push_back(static_cast<int>(i));
  }
  return near;
}

}  // namespace dsw::oracle
