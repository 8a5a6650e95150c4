#include "environment/recut.h"

#include <vector>

#include "predicates/filtered.h"

namespace dsw {
namespace {

/** One facet with its loop as both of its cells number it. */
struct Facet {
  Cell cell, other;  // other is invalid at the outer boundary
  uint32_t local = 0, other_local = 0;
  std::vector<uint16_t> loop, other_loop;  // local vertices, position by position the same vertex
  double apex[3], other_apex[3];
};

Facet read_facet(const Environment<3>& env, Cell c, uint32_t f) {
  const Map<3>& map = env.map;
  Facet facet;
  facet.cell = c;
  facet.local = f;
  centre(env, c, facet.apex);
  const Shape shape = map.shape(c);
  for (uint32_t d = shape.facet_first(f); d < shape.facet_first(f + 1); ++d) {
    facet.loop.push_back(static_cast<uint16_t>(shape.dart_vertex(d)));
  }
  const HalfFacet o = map.opposite(map.half_facet(c, f));
  if (!o.valid()) return facet;
  facet.other = map.cell_of(o);
  facet.other_local = map.local_of(o, facet.other);
  centre(env, facet.other, facet.other_apex);
  const Shape other = map.shape(facet.other);
  for (const uint16_t v : facet.loop) {
    uint32_t d = other.facet_first(facet.other_local);
    while (map.vertex(facet.other, other.dart_vertex(d)) != map.vertex(c, v)) ++d;
    facet.other_loop.push_back(static_cast<uint16_t>(other.dart_vertex(d)));
  }
  return facet;
}

/** Writes triangles, given by loop positions, into one cell; the other side sees them turned round. */
void write_triangles(Map<3>& map, Cell c, uint32_t f, const std::vector<uint16_t>& loop, const Array<size_t>& triangles,
                     bool turned) {
  uint32_t* w = map.record(c);
  if (map.form(c) == Form::kGeneral) {
    std::vector<uint16_t> local;
    for (size_t t = 0; t < triangles.size(); t += 3) {
      local.push_back(loop[triangles[t]]);
      local.push_back(loop[triangles[t + (turned ? 2 : 1)]]);
      local.push_back(loop[triangles[t + (turned ? 1 : 2)]]);
    }
    set_triangles(map.shape_tables.data() + map.shape_offsets[w[0] & kShapeMask], f, local.data());
    return;
  }
  // A quad of a standard form: its cut says whether the diagonal starts at its first loop vertex. The corner that is in
  // one triangle only is not on the diagonal.
  const Shape shape = map.shape(c);
  uint32_t quad = 0, uses[4] = {};
  for (uint32_t g = 0; g < f; ++g) quad += shape.facet_size(g) == 4 ? 1u : 0u;
  for (const size_t position : triangles) ++uses[position];
  const uint32_t on_diagonal = uses[0] == 2 ? loop[0] : loop[1];
  const bool from_first = on_diagonal == shape.dart_vertex(shape.facet_first(f)) ||
                          on_diagonal == shape.dart_vertex(shape.facet_first(f) + 2);
  w[0] = (w[0] & ~(1u << quad)) | (from_first ? 0u : 1u << quad);
}

bool is_cut_well(const Environment<3>& env, Cell c, uint32_t f, const double* apex) {
  const Shape shape = env.map.shape(c);
  const double* points[3];
  for (uint32_t s = shape.simplex_first(f); s < shape.simplex_first(f + 1); ++s) {
    simplex_points(env, c, shape, s, points);
    if (orient<3>(points, apex) >= 0) return false;
  }
  return true;
}

}  // namespace

/** The part between positions i and j has such triangles if some k between them makes a positive triangle and both
 * remaining parts have them. Fans are among what is tried. */
Array<size_t> triangulate(const Array<const double*>& loop, const double* apex, const double* beyond) {
  const size_t n = loop.size();
  const auto is_positive = [&](size_t i, size_t j, size_t k) {
    const double* points[3] = {loop[i], loop[j], loop[k]};
    return orient<3>(points, apex) < 0 && (beyond == nullptr || orient<3>(points, beyond) > 0);
  };
  Array<size_t> triangles(loop.get_allocator());
  if (n == 3) {
    if (is_positive(0, 1, 2)) triangles = {{0, 1, 2}, loop.get_allocator()};
    return triangles;
  }
  Array<size_t> third(n * n, n, loop.get_allocator());
  const auto possible = [&](size_t i, size_t j) { return j == i + 1 || third[i * n + j] != n; };
  for (size_t span = 2; span < n; ++span) {
    for (size_t i = 0; i + span < n; ++i) {
      const size_t j = i + span;
      for (size_t k = i + 1; k < j && third[i * n + j] == n; ++k) {
        if (possible(i, k) && possible(k, j) && is_positive(i, k, j)) third[i * n + j] = k;
      }
    }
  }
  if (!possible(0, n - 1)) return triangles;
  triangles.reserve(3 * (n - 2));
  struct Part {
    size_t i, j;
  };
  Array<Part> parts{third.get_allocator()};
  parts.push_back({0, n - 1});
  while (!parts.empty()) {
    const auto [i, j] = parts.back();
    parts.pop_back();
    if (j == i + 1) continue;
    const size_t k = third[i * n + j];
    triangles.insert(triangles.end(), {i, k, j});
    parts.push_back({i, k});
    parts.push_back({k, j});
  }
  return triangles;
}

void recut_cell(Environment<3>& env, Cell c, Array<Cell>& changed) {
  double apex[3];
  centre(env, c, apex);
  for (uint32_t f = 0; f < env.map.facets_of(c); ++f) {
    const uint32_t size = env.map.shape(c).facet_size(f);
    if (size == 3 || size > kMostTriangulated || is_cut_well(env, c, f, apex)) continue;
    const Facet facet = read_facet(env, c, f);
    Array<const double*> loop{env.memory};
    for (const uint16_t v : facet.loop) loop.push_back(env.point(c, v));
    const Array<size_t> triangles = triangulate(loop, facet.apex, facet.other.valid() ? facet.other_apex : nullptr);
    if (triangles.empty()) continue;
    write_triangles(env.map, c, f, facet.loop, triangles, false);
    if (!facet.other.valid()) continue;
    write_triangles(env.map, facet.other, facet.other_local, facet.other_loop, triangles, true);
    changed.push_back(facet.other);
  }
}

}  // namespace dsw
