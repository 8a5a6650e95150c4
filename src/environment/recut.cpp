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
void write_triangles(Map<3>& map, Cell c, uint32_t f, const std::vector<uint16_t>& loop, const LoopPlaces& triangles,
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
  for (const uint32_t position : triangles) ++uses[position];
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
bool triangulate(const double* const* loop, uint32_t size, const double* apex, const double* beyond, LoopPlaces& out) {
  const auto is_positive = [&](uint32_t i, uint32_t j, uint32_t k) {
    const double* const points[3] = {loop[i], loop[j], loop[k]};
    const filter::Vec<3> e1 = filter::difference<3>(points[1], points[0]),
                         e2 = filter::difference<3>(points[2], points[0]), normal = filter::cross(e1, e2);
    const auto side = [&](const double* q) {
      const filter::Vec<3> w = filter::difference<3>(q, points[0]);
      const double det = filter::dot(normal, w);
      return filter::certain(det, filter::extent(w, e1, e2)) ? filter::sign_of(det) : orient<3>(points, q);
    };
    return side(apex) < 0 && (beyond == nullptr || side(beyond) > 0);
  };
  if (size == 3) {
    if (!is_positive(0, 1, 2)) return false;
    out.assign({0, 1, 2});
    return true;
  }
  ShortArray<uint32_t, 64> third(out.get_allocator());  // by i and j; `size`: none
  third.assign(size * size, size);
  const auto possible = [&](uint32_t i, uint32_t j) { return j == i + 1 || third[i * size + j] != size; };
  for (uint32_t span = 2; span < size; ++span) {
    for (uint32_t i = 0; i + span < size; ++i) {
      const uint32_t j = i + span;
      for (uint32_t k = i + 1; k < j && third[i * size + j] == size; ++k) {
        if (possible(i, k) && possible(k, j) && is_positive(i, k, j)) third[i * size + j] = k;
      }
    }
  }
  if (!possible(0, size - 1)) return false;
  ShortArray<uint32_t, 32> parts(third.get_allocator());  // i and j of each
  parts.assign({0, size - 1});
  while (!parts.empty()) {
    const uint32_t j = parts.back(), i = parts[parts.size() - 2];
    parts.pop_back();
    parts.pop_back();
    if (j == i + 1) continue;
    const uint32_t k = third[i * size + j];
    for (const uint32_t place : {i, k, j}) out.push_back(place);
    for (const uint32_t end : {i, k, k, j}) parts.push_back(end);
  }
  return true;
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
    LoopPlaces triangles{env.memory};
    const double* const beyond = facet.other.valid() ? facet.other_apex : nullptr;
    if (!triangulate(loop.data(), size, facet.apex, beyond, triangles)) continue;
    write_triangles(env.map, c, f, facet.loop, triangles, false);
    if (!facet.other.valid()) continue;
    write_triangles(env.map, facet.other, facet.other_local, facet.other_loop, triangles, true);
    changed.push_back(facet.other);
  }
}

}  // namespace dsw
