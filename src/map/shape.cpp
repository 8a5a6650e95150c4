#include "map/shape.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace dsw {
namespace {

constexpr uint32_t kLimit = 0xffff;

/** Links darts to their opposites inside the cell by sorting the undirected edges. */
ShapeDefect link_darts(const std::vector<uint32_t>& origin, const std::vector<uint32_t>& target,
                       std::vector<uint32_t>& beta2, std::vector<uint32_t>& edge, uint32_t& edge_count) {
  const uint32_t n = static_cast<uint32_t>(origin.size());
  std::vector<std::array<uint32_t, 3>> keys(n);
  for (uint32_t d = 0; d < n; ++d) keys[d] = {std::min(origin[d], target[d]), std::max(origin[d], target[d]), d};
  std::sort(keys.begin(), keys.end());
  if (n % 2 != 0) return ShapeDefect::kOpen;
  for (uint32_t i = 0; i < n; i += 2) {
    const uint32_t a = keys[i][2], b = keys[i + 1][2];
    const bool pair = keys[i][0] == keys[i + 1][0] && keys[i][1] == keys[i + 1][1];
    const bool third = i + 2 < n && keys[i][0] == keys[i + 2][0] && keys[i][1] == keys[i + 2][1];
    if (!pair || third || origin[a] != target[b] || origin[a] == target[a]) return ShapeDefect::kOpen;
    beta2[a] = b;
    beta2[b] = a;
  }
  edge_count = 0;
  for (uint32_t d = 0; d < n; ++d) edge[d] = beta2[d] > d ? edge_count++ : edge[beta2[d]];
  return ShapeDefect::kNone;
}

/** Connected, one disc round every vertex, and V - E + F = 2: then the loops close a sphere. */
bool is_sphere(const std::vector<uint32_t>& origin, const std::vector<uint32_t>& facet,
               const std::vector<uint32_t>& next, const std::vector<uint32_t>& beta2, uint32_t facet_count,
               uint32_t vertex_count, uint32_t edge_count) {
  const uint32_t n = static_cast<uint32_t>(facet.size());
  std::vector<char> seen(n, 0);
  std::vector<uint32_t> stack{0};
  uint32_t reached = 0;
  seen[0] = 1;
  while (!stack.empty()) {
    const uint32_t d = stack.back();
    stack.pop_back();
    ++reached;
    for (const uint32_t e : {next[d], beta2[d]}) {
      if (!seen[e]) {
        seen[e] = 1;
        stack.push_back(e);
      }
    }
  }
  if (reached != n) return false;
  uint32_t discs = 0;
  std::vector<char> has_disc(vertex_count, 0);
  std::fill(seen.begin(), seen.end(), static_cast<char>(0));
  for (uint32_t d = 0; d < n; ++d) {
    if (seen[d]) continue;
    if (has_disc[origin[d]]) return false;
    has_disc[origin[d]] = 1;
    ++discs;
    for (uint32_t e = d; !seen[e]; e = next[beta2[e]]) seen[e] = 1;
  }
  return discs == vertex_count && vertex_count + facet_count == edge_count + 2;
}

struct StandardTables {
  Array<uint16_t> words;
  std::array<uint32_t, 1 + 2 + 8 + 64> offset{};

  static constexpr uint32_t first(Form form) {
    return form == Form::kSimplex ? 0u : form == Form::kPyramid ? 1u : form == Form::kPrism ? 3u : 11u;
  }

  StandardTables() {
    add(Form::kSimplex, 4, {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {0, 2, 1}});
    add(Form::kPyramid, 5, {{0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});
    add(Form::kPrism, 6, {{0, 1, 2}, {3, 5, 4}, {0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 3, 0}});
    add(Form::kBox, 8, {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}});
  }

  void add(Form form, uint32_t vertex_count, const std::vector<std::vector<uint16_t>>& facets) {
    std::vector<uint16_t> vertices, starts{0};
    for (const auto& loop : facets) {
      vertices.insert(vertices.end(), loop.begin(), loop.end());
      starts.push_back(static_cast<uint16_t>(vertices.size()));
    }
    const uint32_t facet_count = static_cast<uint32_t>(facets.size());
    for (uint32_t cuts = 0; cuts < (1u << quad_count(form)); ++cuts) {
      std::vector<uint16_t> base(facet_count, 0);
      uint32_t quad = 0;
      for (uint32_t f = 0; f < facet_count; ++f) {
        if (facets[f].size() == 4) base[f] = static_cast<uint16_t>((cuts >> quad++) & 1u);
      }
      offset[first(form) + cuts] = static_cast<uint32_t>(words.size());
      append_polyhedron({vertices.data(), starts.data(), facet_count, vertex_count}, base.data(), words);
    }
  }
};

void write_fan(uint16_t* table, uint32_t facet, uint32_t base) {
  const Shape shape(table);
  const uint32_t first = shape.facet_first(facet), size = shape.facet_size(facet);
  uint16_t* out = const_cast<uint16_t*>(shape.simplices()) + 3 * shape.simplex_first(facet);
  const auto at = [&](uint32_t i) { return static_cast<uint16_t>(shape.dart_vertex(first + (base + i) % size)); };
  for (uint32_t i = 1; i + 1 < size; ++i) {
    *out++ = at(0);
    *out++ = at(i);
    *out++ = at(i + 1);
  }
}

}  // namespace

ShapeDefect append_polyhedron(const FacetLoops& loops, const uint16_t* base, Array<uint16_t>& tables) {
  const uint32_t facets = loops.facet_count, n = loops.first[facets];
  if (facets >= kLimit || n >= kLimit || loops.vertex_count >= kLimit) return ShapeDefect::kTooLarge;
  if (facets < 4) return ShapeDefect::kOpen;
  std::vector<uint32_t> origin(n), target(n), facet(n), next(n), beta2(n), edge(n);
  std::vector<uint32_t> last_facet(loops.vertex_count, facets);
  uint32_t simplices = 0;
  for (uint32_t f = 0; f < facets; ++f) {
    const uint32_t begin = loops.first[f], end = loops.first[f + 1];
    if (end < begin + 3) return ShapeDefect::kShortFacet;
    simplices += end - begin - 2;
    for (uint32_t d = begin; d < end; ++d) {
      origin[d] = loops.vertices[d];
      next[d] = d + 1 == end ? begin : d + 1;
      target[d] = loops.vertices[next[d]];
      facet[d] = f;
      if (origin[d] >= loops.vertex_count) return ShapeDefect::kOpen;
      if (last_facet[origin[d]] == f) return ShapeDefect::kRepeatedVertex;
      last_facet[origin[d]] = f;
    }
  }
  uint32_t edge_count = 0;
  const ShapeDefect defect = link_darts(origin, target, beta2, edge, edge_count);
  if (defect != ShapeDefect::kNone) return defect;
  if (!is_sphere(origin, facet, next, beta2, facets, loops.vertex_count, edge_count)) return ShapeDefect::kNotSphere;

  const size_t at = tables.size();
  tables.resize(at + Shape::kHeader + 2 * (facets + 1) + 4 * n + 4 * simplices);
  uint16_t* out = tables.data() + at;
  const auto put = [&](uint32_t value) { *out++ = static_cast<uint16_t>(value); };
  put(loops.vertex_count);
  put(facets);
  put(edge_count);
  put(n);
  put(simplices);
  for (uint32_t f = 0; f <= facets; ++f) put(loops.first[f]);
  for (uint32_t f = 0; f <= facets; ++f) put(loops.first[f] - 2 * f);
  for (const auto* column : {&origin, &facet, &beta2, &edge}) {
    for (const uint32_t value : *column) put(value);
  }
  out += 3 * simplices;
  for (uint32_t f = 0; f < facets; ++f) {
    for (uint32_t i = loops.first[f] + 2; i < loops.first[f + 1]; ++i) put(f);
  }
  for (uint32_t f = 0; f < facets; ++f) write_fan(tables.data() + at, f, base == nullptr ? 0 : base[f]);
  return ShapeDefect::kNone;
}

void set_triangles(uint16_t* table, uint32_t facet, const uint16_t* triangles) {
  const Shape shape(table);
  const uint32_t first = 3 * shape.simplex_first(facet), last = 3 * shape.simplex_first(facet + 1);
  std::copy(triangles, triangles + (last - first), table + (shape.simplices() - table) + first);
}

ShapeDefect append_polygon(uint32_t vertex_count, Array<uint16_t>& tables) {
  if (vertex_count >= kLimit) return ShapeDefect::kTooLarge;
  if (vertex_count < 3) return ShapeDefect::kShortFacet;
  const uint32_t n = vertex_count;
  const auto put = [&](uint32_t value) { tables.push_back(static_cast<uint16_t>(value)); };
  for (uint32_t i = 0; i < Shape::kHeader; ++i) put(n);
  for (uint32_t part = 0; part < 2; ++part) {
    for (uint32_t i = 0; i <= n; ++i) put(i);
  }
  for (uint32_t column = 0; column < 4; ++column) {
    for (uint32_t i = 0; i < n; ++i) put(i);
  }
  for (uint32_t i = 0; i < n; ++i) {
    put(i);
    put((i + 1) % n);
  }
  for (uint32_t i = 0; i < n; ++i) put(i);
  return ShapeDefect::kNone;
}

Shape planar_shape(uint32_t vertex_count) {
  struct Tables {
    Array<uint16_t> triangle, quadrilateral;
    Tables() {
      append_polygon(3, triangle);
      append_polygon(4, quadrilateral);
    }
  };
  static const Tables tables;
  return Shape(vertex_count == 3 ? tables.triangle.data() : tables.quadrilateral.data());
}

Shape standard_shape(Form form, uint32_t cuts) {
  static const StandardTables tables;
  return Shape(tables.words.data() + tables.offset[StandardTables::first(form) + cuts]);
}

}  // namespace dsw
