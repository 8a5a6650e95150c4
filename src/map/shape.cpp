#include "map/shape.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace dsw {
namespace {

constexpr uint32_t kLimit = 0xffff, kFewVertices = 32;

/** Scratch for one polyhedron: on the stack unless it is large. */
template <class T>
class Scratch {
 public:
  Scratch(size_t count, const Memory* memory) : large_(count > kFew ? count : 0, memory) {}
  /** The next `count` of these. */
  T* take(size_t count) {
    T* const words = (large_.empty() ? few_ : large_.data()) + taken_;
    taken_ += count;
    return words;
  }
  /** Takes the next `count` words and sets all of them to `value`. */
  T* take(size_t count, T value) {
    T* const words = take(count);
    std::fill_n(words, count, value);
    return words;
  }

 private:
  static constexpr size_t kFew = 512;

  Array<T> large_;
  T few_[kFew];
  size_t taken_ = 0;
};

/** Darts of a polyhedron, facet by facet: where each starts, its facet, and, to be found, its opposite and its edge. */
struct Darts {
  uint32_t count, vertex_count;
  const uint16_t *origin, *facet;
  uint16_t *beta2, *edge;
  const uint16_t* first;  // of the facets
  uint32_t facet_count;

  /** Calls visit(dart, from, to), with its vertices, until it returns false; whether it never did. */
  template <class Visit>
  bool for_each(Visit visit) const {
    for (uint32_t f = 0; f < facet_count; ++f) {
      const uint32_t last = first[f + 1] - 1u;
      for (uint32_t d = first[f]; d < last; ++d) {
        if (!visit(d, origin[d], origin[d + 1])) return false;
      }
      if (!visit(last, origin[last], origin[first[f]])) return false;
    }
    return true;
  }
};

/** Sorts pairs of vertices by one of the two; pairs that have the same stay in their order. */
template <class Key>
void sort_pairs(const uint64_t* pairs, uint32_t count, uint32_t vertices, Key key, uint32_t* places, uint64_t* sorted) {
  std::fill_n(places, vertices + 1, 0u);
  for (uint32_t i = 0; i < count; ++i) ++places[key(pairs[i]) + 1];
  for (uint32_t k = 0; k < vertices; ++k) places[k + 1] += places[k];
  for (uint32_t i = 0; i < count; ++i) sorted[places[key(pairs[i])]++] = pairs[i];
}

/** Links darts to their opposites inside the cell: of few vertices, by a table of the ways from one to another. */
bool link_few(const Darts& darts) {
  constexpr uint16_t kNone = 0xffff;
  uint16_t ways[kFewVertices * kFewVertices];  // the dart that takes it
  std::fill_n(ways, darts.vertex_count * darts.vertex_count, kNone);
  const auto way = [&](uint32_t from, uint32_t to) -> uint16_t& { return ways[from * darts.vertex_count + to]; };
  const auto take = [&](uint32_t d, uint32_t from, uint32_t to) {
    const bool is_free = way(from, to) == kNone;
    way(from, to) = static_cast<uint16_t>(d);
    return is_free;
  };
  const auto link = [&](uint32_t d, uint32_t from, uint32_t to) { return (darts.beta2[d] = way(to, from)) != kNone; };
  return darts.for_each(take) && darts.for_each(link);
}

/** Links darts to their opposites inside the cell, also of many vertices: it sorts the undirected edges. `pairs` holds
 * two words for each dart. */
bool link_many(const Darts& darts, uint64_t* pairs, Scratch<uint32_t>& scratch) {
  const uint32_t n = darts.count;
  if (n % 2 != 0) return false;
  // The lower vertex of each edge, the higher one, and the dart: 16 bits each.
  uint64_t *const edges = pairs, *const by_higher = pairs + n;
  uint32_t* const places = scratch.take(size_t{darts.vertex_count} + 1);
  darts.for_each([&](uint32_t d, uint64_t a, uint64_t b) {
    edges[d] = (a < b ? a << 32 | b << 16 : b << 32 | a << 16) | d;
    return true;
  });
  const auto higher = [](uint64_t edge) { return static_cast<uint32_t>(edge >> 16 & 0xffff); };
  const auto lower = [](uint64_t edge) { return static_cast<uint32_t>(edge >> 32); };
  sort_pairs(edges, n, darts.vertex_count, higher, places, by_higher);
  sort_pairs(by_higher, n, darts.vertex_count, lower, places, edges);
  for (uint32_t i = 0; i < n; i += 2) {
    const auto a = static_cast<uint32_t>(edges[i] & 0xffff), b = static_cast<uint32_t>(edges[i + 1] & 0xffff);
    const bool pair = edges[i] >> 16 == edges[i + 1] >> 16, third = i + 2 < n && edges[i] >> 16 == edges[i + 2] >> 16;
    if (!pair || third || darts.origin[a] == darts.origin[b]) return false;
    darts.beta2[a] = static_cast<uint16_t>(b);
    darts.beta2[b] = static_cast<uint16_t>(a);
  }
  return true;
}

/** Numbers edges in the order of their first darts; how many there are. */
uint32_t number_edges(const Darts& darts) {
  uint32_t count = 0;
  for (uint32_t d = 0; d < darts.count; ++d) {
    const uint32_t other = darts.beta2[d];
    darts.edge[d] = other > d ? static_cast<uint16_t>(count++) : darts.edge[other];
  }
  return count;
}

/** Connected, and V - E + F = 2: then the loops close a sphere if every vertex has a dart. Let V' be the number of
 * discs round vertices. A connected surface without a rim has V' - E + F <= 2, and 2 only if it is a sphere. Every
 * vertex has a disc, so V <= V'. Hence V - E + F = 2 means V = V' and a sphere. */
bool is_sphere(const Darts& darts, Scratch<uint32_t>& scratch, uint32_t edge_count) {
  uint32_t *const reached = scratch.take(darts.facet_count, 0), *const stack = scratch.take(darts.facet_count);
  uint32_t height = 1, count = 1;  // from facet 0
  stack[0] = 0;
  reached[0] = 1;
  while (height != 0 && count != darts.facet_count) {
    const uint32_t f = stack[--height];
    for (uint32_t d = darts.first[f]; d < darts.first[f + 1]; ++d) {
      const uint32_t beyond = darts.facet[darts.beta2[d]];
      if (reached[beyond] != 0) continue;
      reached[beyond] = 1;
      stack[height++] = beyond;
      ++count;
    }
  }
  return count == darts.facet_count && darts.vertex_count + darts.facet_count == edge_count + 2;
}

struct StandardTables {
  Array<uint16_t> words;
  std::array<uint32_t, 1 + 2 + 8 + 64> offset{};

  static constexpr uint32_t first(Form form) {
    return form == Form::kSimplex ? 0u : form == Form::kPyramid ? 1u : form == Form::kPrism ? 3u : 11u;
  }

  DSW_COLD StandardTables() {
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

ShapeDefect append_polyhedron(const FacetLoops& loops, const uint16_t* base, Array<uint16_t>& tables,
                              const uint16_t* triangles) {
  const uint32_t facets = loops.facet_count, n = loops.first[facets], vertices = loops.vertex_count;
  if (facets >= kLimit || n >= kLimit || vertices >= kLimit) return ShapeDefect::kTooLarge;
  if (facets < 4) return ShapeDefect::kOpen;
  const Memory* const memory = tables.get_allocator().memory;
  Scratch<uint32_t> scratch(2 * size_t{vertices} + 2 * size_t{facets} + 1, memory);
  Scratch<uint64_t> pairs(vertices <= kFewVertices ? 0 : 2 * size_t{n}, memory);
  uint32_t* const last_facet = scratch.take(vertices, facets);
  uint32_t simplices = 0, used = 0;  // vertices that have a dart
  for (uint32_t f = 0; f < facets; ++f) {
    const uint32_t begin = loops.first[f], end = loops.first[f + 1];
    if (end < begin + 3) return ShapeDefect::kShortFacet;
    simplices += end - begin - 2;
    for (uint32_t d = begin; d < end; ++d) {
      const uint32_t origin = loops.vertices[d];
      if (origin >= vertices) return ShapeDefect::kOpen;
      if (last_facet[origin] == f) return ShapeDefect::kRepeatedVertex;
      used += last_facet[origin] == facets ? 1u : 0u;
      last_facet[origin] = f;
    }
  }
  const size_t at = tables.size();
  tables.resize(at + Shape::kHeader + 2 * (facets + 1) + 4 * n + 4 * simplices);
  uint16_t* const table = tables.data() + at;
  uint16_t *const origin = table + Shape::kHeader + 2 * (facets + 1), *const facet = origin + n;
  std::copy_n(loops.vertices, n, origin);
  for (uint32_t f = 0; f < facets; ++f) {
    std::fill(facet + loops.first[f], facet + loops.first[f + 1], static_cast<uint16_t>(f));
  }
  const Darts darts{n, vertices, origin, facet, facet + n, facet + 2 * n, loops.first, facets};
  const bool is_linked =
      vertices <= kFewVertices ? link_few(darts) : link_many(darts, pairs.take(2 * size_t{n}), scratch);
  const uint32_t edge_count = is_linked ? number_edges(darts) : 0;
  if (!is_linked || used != vertices || !is_sphere(darts, scratch, edge_count)) {
    tables.resize(at);
    return is_linked ? ShapeDefect::kNotSphere : ShapeDefect::kOpen;
  }
  uint16_t* out = table;
  const auto put = [&](uint32_t value) { *out++ = static_cast<uint16_t>(value); };
  for (const uint32_t value : {vertices, facets, edge_count, n, simplices}) put(value);
  for (uint32_t f = 0; f <= facets; ++f) put(loops.first[f]);
  for (uint32_t f = 0; f <= facets; ++f) put(loops.first[f] - 2 * f);
  out = origin + 4 * n + 3 * simplices;
  for (uint32_t f = 0; f < facets; ++f) {
    for (uint32_t i = loops.first[f] + 2; i < loops.first[f + 1]; ++i) put(f);
  }
  if (triangles != nullptr) {
    std::copy_n(triangles, 3 * simplices, origin + 4 * n);
  } else {
    for (uint32_t f = 0; f < facets; ++f) write_fan(table, f, base == nullptr ? 0 : base[f]);
  }
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
