#include "mesh.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <set>

namespace dsw::oracle {

const std::vector<Loop>& standard_faces(int type) {
  static const std::vector<Loop> tetra = {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {0, 2, 1}};
  static const std::vector<Loop> hexahedron = {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4},
                                               {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}};
  static const std::vector<Loop> wedge = {{0, 1, 2}, {3, 5, 4}, {0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 3, 0}};
  static const std::vector<Loop> pyramid = {{0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  static const std::vector<Loop> none;
  switch (type) {
    case DSW_CELL_TYPE_TETRA:
      return tetra;
    case DSW_CELL_TYPE_HEXAHEDRON:
      return hexahedron;
    case DSW_CELL_TYPE_WEDGE:
      return wedge;
    case DSW_CELL_TYPE_PYRAMID:
      return pyramid;
    default:
      return none;
  }
}

void Mesh::add_standard(int type, std::vector<int> vertices) {
  Cell cell;
  cell.type = type;
  for (const Loop& local : standard_faces(type)) {
    Loop face;
    for (int i : local) face.push_back(vertices[static_cast<size_t>(i)]);
    cell.faces.push_back(face);
  }
  cell.vertices = std::move(vertices);
  cells.push_back(std::move(cell));
}

void Mesh::add_polyhedron(std::vector<Loop> faces) {
  Cell cell;
  cell.faces = std::move(faces);
  cells.push_back(std::move(cell));
}

std::vector<std::array<int, 2>> cell_edges(const Cell& cell) {
  std::vector<std::array<int, 2>> edges;
  std::set<std::pair<int, int>> seen;
  for (const Loop& f : cell.faces) {
    for (size_t i = 0; i < f.size(); ++i) {
      const int a = f[i], b = f[(i + 1) % f.size()];
      if (seen.insert({std::min(a, b), std::max(a, b)}).second) edges.push_back({a, b});
    }
  }
  return edges;
}

DescArrays::DescArrays(const Mesh& mesh, const Layout& layout) {
  dsw_environment_desc_init(&desc, sizeof desc);
  points.assign(mesh.points.size() * layout.stride, 0);
  for (size_t i = 0; i < mesh.points.size(); ++i) {
    std::memcpy(points.data() + i * layout.stride, mesh.points[i].data(), 24);
  }
  offsets.push_back(0);
  if (!mesh.loose.empty()) desc.flags = DSW_ENVIRONMENT_CONFORM;
  for (const Cell& cell : mesh.loose.empty() ? mesh.cells : mesh.loose) {
    types.push_back(static_cast<uint8_t>(cell.type));
    locations.push_back(0);
    if (cell.type != DSW_CELL_TYPE_POLYHEDRON) {
      connectivity.insert(connectivity.end(), cell.vertices.begin(), cell.vertices.end());
    } else {
      std::vector<int64_t> stream = {static_cast<int64_t>(cell.faces.size())};
      std::vector<int> used;
      for (const Loop& f : cell.faces) {
        stream.push_back(static_cast<int64_t>(f.size()));
        for (int v : f) {
          stream.push_back(v);
          if (std::find(used.begin(), used.end(), v) == used.end()) used.push_back(v);
        }
      }
      if (layout.separate_faces) {
        locations.back() = static_cast<int64_t>(faces.size());
        faces.insert(faces.end(), stream.begin(), stream.end());
        connectivity.insert(connectivity.end(), used.begin(), used.end());
      } else {
        connectivity.insert(connectivity.end(), stream.begin(), stream.end());
      }
    }
    offsets.push_back(static_cast<int64_t>(connectivity.size()));
  }
  desc.dimension = 3;
  desc.points = reinterpret_cast<const double*>(points.data());
  desc.point_count = mesh.points.size();
  desc.point_stride_bytes = layout.stride == 24 ? 0 : layout.stride;
  desc.cell_types = types.data();
  desc.volume_count = mesh.cells.size();
  desc.connectivity_count = connectivity.size();
  if (layout.index_bytes == 4) {
    offsets32.assign(offsets.begin(), offsets.end());
    connectivity32.assign(connectivity.begin(), connectivity.end());
    faces32.assign(faces.begin(), faces.end());
    locations32.assign(locations.begin(), locations.end());
    desc.index_bytes = 4;
    desc.offsets = offsets32.data();
    desc.connectivity = connectivity32.data();
  } else {
    desc.index_bytes = 8;
    desc.offsets = offsets.data();
    desc.connectivity = connectivity.data();
  }
  if (layout.separate_faces && !faces.empty()) {
    desc.faces_count = faces.size();
    desc.faces = layout.index_bytes == 4 ? static_cast<const void*>(faces32.data()) : faces.data();
    desc.face_locations = layout.index_bytes == 4 ? static_cast<const void*>(locations32.data()) : locations.data();
  }
  desc.regions = mesh.regions.empty() ? nullptr : mesh.regions.data();
  desc.tags = mesh.tags.empty() ? nullptr : mesh.tags.data();
}

void split_to_pyramids(Mesh& mesh, size_t cell, const Vec& centre) {
  const int apex = static_cast<int>(mesh.points.size());
  mesh.points.push_back(centre);
  const std::vector<Loop> faces = mesh.cells[cell].faces;
  std::vector<Cell> pyramids;
  Mesh scratch;
  for (const Loop& f : faces) scratch.add_standard(DSW_CELL_TYPE_PYRAMID, {f[3], f[2], f[1], f[0], apex});
  mesh.cells[cell] = scratch.cells[0];
  mesh.cells.insert(mesh.cells.end(), scratch.cells.begin() + 1, scratch.cells.end());
}

void split_pyramid(Mesh& mesh, size_t cell) {
  const std::vector<int> v = mesh.cells[cell].vertices;
  Mesh scratch;
  scratch.add_standard(DSW_CELL_TYPE_TETRA, {v[0], v[1], v[2], v[4]});
  scratch.add_standard(DSW_CELL_TYPE_TETRA, {v[0], v[2], v[3], v[4]});
  mesh.cells[cell] = scratch.cells[0];
  mesh.cells.push_back(scratch.cells[1]);
}

void truncate_vertex(Mesh& mesh, int v, double depth) {
  std::map<int, int> cut;  // neighbour -> new point
  const auto cut_point = [&](int other) {
    const auto found = cut.find(other);
    if (found != cut.end()) return found->second;
    Vec p;
    for (size_t k = 0; k < 3; ++k) {
      const double a = mesh.points[static_cast<size_t>(v)][k], b = mesh.points[static_cast<size_t>(other)][k];
      p[k] = a + (b - a) * depth;
    }
    const int index = static_cast<int>(mesh.points.size());
    mesh.points.push_back(p);
    cut[other] = index;
    return index;
  };
  std::vector<Loop> gap;
  std::map<std::pair<int, int>, int> open;  // links of the gap's faces, to see whether it closes
  for (Cell& cell : mesh.cells) {
    std::map<int, int> links;
    for (Loop& f : cell.faces) {
      const auto at = std::find(f.begin(), f.end(), v);
      if (at == f.end()) continue;
      const size_t n = f.size(), i = static_cast<size_t>(at - f.begin());
      const int a = cut_point(f[(i + n - 1) % n]), b = cut_point(f[(i + 1) % n]);
      links[b] = a;
      f[i] = a;
      f.insert(f.begin() + static_cast<std::ptrdiff_t>(i) + 1, b);
    }
    if (links.empty()) continue;
    Loop face;
    int x = links.begin()->first;
    do {
      face.push_back(x);
      x = links.at(x);
    } while (x != face.front());
    cell.faces.push_back(face);
    cell.type = DSW_CELL_TYPE_POLYHEDRON;
    cell.vertices.clear();
    gap.emplace_back(face.rbegin(), face.rend());
    for (size_t i = 0; i < face.size(); ++i) {
      const int a = face[i], b = face[(i + 1) % face.size()];
      ++open[{std::min(a, b), std::max(a, b)}];
    }
  }
  const bool closed = std::all_of(open.begin(), open.end(), [](const auto& e) { return e.second == 2; });
  if (closed && !gap.empty()) mesh.add_polyhedron(gap);
}

}  // namespace dsw::oracle
