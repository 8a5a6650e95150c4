#include "topology/draft.h"

#include <numeric>

#include "base/error.h"
#include "base/search.h"
#include "base/sort.h"
#include "environment/recut.h"
#include "predicates/filtered.h"

namespace dsw {
namespace {

/** Triangles as sorted triples in ascending order. */
void sort_triangles(const FacetDraft& facet, Vertices& out) {
  out = facet.triangles;
  for (size_t t = 0; t < out.size(); t += 3) dsw::sort(out.begin() + t, out.begin() + t + 3);
  // Few and short: insertion by whole triples.
  for (size_t t = 3; t < out.size(); t += 3) {
    for (size_t u = t; u >= 3; u -= 3) {
      uint32_t* const at = out.begin() + u;
      if (!std::lexicographical_compare(at, at + 3, at - 3, at)) break;
      std::swap_ranges(at, at + 3, at - 3);
    }
  }
}

/** The sides of a polygon on the way from the second of two corners to the first, and the rest. */
bool part_between(CellDraft& whole, const Vertices& ends, CellDraft& left, CellDraft& right) {
  Array<uint32_t> sides(ends.get_allocator());
  const auto starts = [&](const FacetDraft& side) { return side.loop[0] == ends[1]; };
  const auto first = dsw::find_if(whole.facets.begin(), whole.facets.end(), starts);
  if (first == whole.facets.end() || !order_sides(whole, static_cast<uint32_t>(first - whole.facets.begin()), sides)) {
    return false;
  }
  bool is_left = true;
  for (const uint32_t side : sides) {
    is_left = is_left && whole.facets[side].loop[0] != ends[0];
    (is_left ? left : right).facets.push_back(std::move(whole.facets[side]));
  }
  return !right.facets.empty();
}

/** Which facet of a cell runs along an edge from `a` to `b`, by hash. Every edge has a facet on each side. */
class SideTable {
 public:
  SideTable(const CellDraft& cell, Allocator<uint32_t> allocator) : slots_(allocator) {
    size_t corners = 0, slots = 64;
    for (const FacetDraft& facet : cell.facets) corners += facet.loop.size();
    while (slots < 2 * corners) slots *= 2;
    slots_.assign(slots, {0, 0, kNone, false});
    for (uint32_t f = 0; f < cell.facets.size(); ++f) {
      uint32_t before = cell.facets[f].loop.back();
      for (const uint32_t v : cell.facets[f].loop) {
        slots_[slot_of(before, v)] = {before, v, f, false};
        before = v;
      }
    }
  }
  struct Side {
    uint32_t a, b, facet;
    bool is_cut;  // the edge is on a loop along which the cell is parted
  };
  Side& along(uint32_t a, uint32_t b) { return slots_[slot_of(a, b)]; }

 private:
  static constexpr uint32_t kNone = 0xffffffffu;

  size_t slot_of(uint32_t a, uint32_t b) const {
    const uint64_t mixed = (uint64_t{a} << 32 | b) * 0x9e3779b97f4a7c15u;
    size_t slot = (mixed >> 40) & (slots_.size() - 1);
    while (slots_[slot].facet != kNone && (slots_[slot].a != a || slots_[slot].b != b)) {
      slot = (slot + 1) & (slots_.size() - 1);
    }
    return slot;
  }

  ShortArray<Side, 64> slots_;
};

/** Writes down facet `f` of a cell, whose vertices are at(local). */
template <int D, class VertexAt>
void read_facet(const Environment<D>& env, HalfFacet h, const Shape& shape, uint32_t f, VertexAt at,
                FacetDraft& facet) {
  uint32_t* corner = facet.loop.extend(D == 3 ? shape.facet_size(f) : 2);
  for_each_facet_vertex<D>(shape, f, [&](uint32_t local) { *corner++ = at(local); });
  if constexpr (D == 3) {
    const uint16_t *local = shape.simplices() + 3 * shape.simplex_first(f), *const end = shape.simplices() +
                                                                                         3 * shape.simplex_first(f + 1);
    corner = facet.triangles.extend(static_cast<size_t>(end - local));
    for (; local != end; ++local) *corner++ = at(*local);
  }
  facet.near = h;
  facet.far = env.map.opposite(h);
  facet.marked = env.map.facet_marked(h);
  facet.exit_patch = exit_patch(env, h);
}

}  // namespace

template <int D>
FacetDraft draft_of(const Environment<D>& env, HalfFacet h) {
  const Cell c = env.map.cell_of(h);
  const auto at = [&](uint32_t local) { return env.map.vertex(c, local); };
  FacetDraft facet(env.scratch.memory());
  read_facet(env, h, env.map.shape(c), env.map.local_of(h, c), at, facet);
  return facet;
}

template <int D>
CellDraft draft_of(const Environment<D>& env, Cell c) {
  CellDraft draft(env.scratch.memory());
  const Shape shape = env.map.shape(c);
  ShortArray<uint32_t, 32> vertices(env.scratch.memory());
  env.map.for_each_vertex(c, [&](uint32_t vertex) { vertices.push_back(vertex); });
  const uint32_t facets = shape.facet_count();
  draft.facets.reserve(2 * facets);  // each may be cut in two
  for (uint32_t f = 0; f < facets; ++f) {
    draft.facets.emplace_back(env.scratch.memory());
    read_facet(
        env, env.map.half_facet(c, f), shape, f, [&](uint32_t local) { return vertices[local]; }, draft.facets.back());
  }
  draft.from = c;
  draft.marked = env.map.marked(c);
  draft.region = env.region(c);
  draft.tag = env.tag(c);
  return draft;
}

bool face_each_other(const FacetDraft& a, const FacetDraft& b) {
  const size_t n = a.loop.size();
  if (b.loop.size() != n) return false;
  if (n == 2) return b.loop[0] == a.loop[1] && b.loop[1] == a.loop[0];  // of the plane: no cycle
  const uint32_t start = b.place_of(a.loop[0]);
  if (start == n) return false;
  for (size_t k = 1; k < n; ++k) {
    if (b.after(start, n - k) != a.loop[k]) return false;
  }
  return true;
}

bool cut_alike(const FacetDraft& a, const FacetDraft& b) {
  Vertices of_a(a.triangles.get_allocator()), of_b(a.triangles.get_allocator());
  sort_triangles(a, of_a);
  sort_triangles(b, of_b);
  return of_a == of_b;
}

void cut_like(FacetDraft& facet, const FacetDraft& other) {
  facet.triangles = other.triangles;
  for (size_t t = 0; t < facet.triangles.size(); t += 3) std::swap(facet.triangles[t + 1], facet.triangles[t + 2]);
}

bool is_cut_well(const Environment<3>& env, const FacetDraft& facet, const double* apex, const double* beyond) {
  for (size_t t = 0; t < facet.triangles.size(); t += 3) {
    const double* points[3];
    for (size_t k = 0; k < 3; ++k) points[k] = env.point(facet.triangles[t + k]);
    if (orient<3>(points, apex) >= 0 || (beyond != nullptr && orient<3>(points, beyond) <= 0)) return false;
  }
  return true;
}

bool cut_anew(const Environment<3>& env, FacetDraft& facet, const Vertices& hole, const double* apex,
              const double* beyond) {
  if (hole.size() > kMostTriangulated) {
    fail(DSW_STATUS_TOO_LARGE, "a face of %zu vertices has to be cut anew, more than %u", hole.size(),
         kMostTriangulated);
  }
  ShortArray<const double*, 12> points{env.scratch.memory()};
  for (const uint32_t v : hole) points.push_back(env.point(v));
  LoopPlaces triangles{env.scratch.memory()};
  if (!triangulate(points.data(), static_cast<uint32_t>(points.size()), apex, beyond, triangles)) return false;
  for (const uint32_t place : triangles) facet.triangles.push_back(hole[place]);
  return true;
}

void list_vertices(const CellDraft& draft, Array<uint32_t>& out) {
  out.clear();
  out.reserve(2 * draft.facets.size());  // of a convex cell with triangles or quads for facets
  Numbering number(out);
  for (const FacetDraft& facet : draft.facets) {
    for (const uint32_t v : facet.loop) number(v);
  }
}

template <int D>
void centre(const Environment<D>& env, const CellDraft& draft, double* out) {
  Array<uint32_t> vertices{env.scratch.memory()};
  list_vertices(draft, vertices);
  const double count = static_cast<double>(vertices.size());
  std::fill_n(out, D, 0.0);
  for (const uint32_t v : vertices) {
    for (int k = 0; k < D; ++k) out[k] += env.point(v)[k] / count;
  }
}

FacetDraft part_of(const FacetDraft& whole, uint32_t from, uint32_t to) {
  FacetDraft part(whole.loop.get_allocator().memory);
  part.near = whole.near;
  part.far = whole.far;
  part.pair = whole.pair;
  part.marked = whole.marked;
  part.exit_patch = whole.exit_patch;
  part.loop.reserve(whole.loop.size());
  part.triangles.reserve(whole.triangles.size());
  for (uint32_t at = whole.place_of(from);; ++at) {
    part.loop.push_back(whole.after(at, 0));
    if (part.loop.back() == to) return part;
  }
}

bool share_triangles(const FacetDraft& whole, FacetDraft& a, FacetDraft& b) {
  for (size_t t = 0; t < whole.triangles.size(); t += 3) {
    const uint32_t* const first = whole.triangles.begin() + t;
    const auto is_in = [&](const FacetDraft& part) {
      return dsw::all_of(first, first + 3, [&](uint32_t v) { return part.has(v); });
    };
    const bool in_a = is_in(a);
    if (!in_a && !is_in(b)) return false;
    (in_a ? a : b).triangles.append(first, first + 3);
  }
  return true;
}

FacetDraft turned(const FacetDraft& facet) {
  FacetDraft other = facet;
  std::reverse(other.loop.begin(), other.loop.end());
  cut_like(other, facet);
  std::swap(other.near, other.far);
  return other;
}

bool insert_between(FacetDraft& facet, uint32_t a, uint32_t b, uint32_t middle) {
  const uint32_t at = facet.place_of(a), size = static_cast<uint32_t>(facet.loop.size());
  if (at == size) return false;
  const bool ahead = facet.after(at) == b;
  if (!ahead && facet.after(at, size - 1) != b) return false;
  facet.loop.insert(facet.loop.begin() + (ahead ? at + 1 : at), middle);
  for (size_t t = 0; t < facet.triangles.size(); t += 3) {
    uint32_t* const corner = facet.triangles.begin() + t;
    const auto find = [&](uint32_t vertex) {
      return vertex == corner[0] ? 0 : vertex == corner[1] ? 1 : vertex == corner[2] ? 2 : 3;
    };
    const int of_a = find(a), of_b = find(b);
    if (of_a == 3 || of_b == 3) continue;
    const uint32_t rest[3] = {corner[0], corner[1], corner[2]};
    corner[of_a] = middle;  // the triangle keeps b; one with a in place of b comes on top
    for (const uint32_t v : rest) facet.triangles.push_back(v == b ? middle : v);
    return true;
  }
  return true;
}

void insert_vertex(CellDraft& draft, const Shape& shape, uint32_t dart, uint32_t a, uint32_t b, uint32_t middle) {
  for (const uint32_t d : {dart, shape.dart_beta2(dart)}) {
    insert_between(draft.facets[shape.dart_facet(d)], a, b, middle);
  }
}

void insert_vertex(CellDraft& draft, uint32_t a, uint32_t b, uint32_t middle) {
  for (FacetDraft& facet : draft.facets) {
    if (facet.loop.size() != 2) {
      insert_between(facet, a, b, middle);
    } else if (facet.has(a) && facet.has(b)) {
      FacetDraft rest = facet;
      rest.loop[0] = facet.loop[1] = middle;
      draft.facets.push_back(std::move(rest));
      return;
    }
  }
}

bool order_sides(const CellDraft& draft, uint32_t first, Array<uint32_t>& out) {
  const auto& sides = draft.facets;
  Array<uint32_t> by_start(sides.size(), 0, out.get_allocator());
  std::iota(by_start.begin(), by_start.end(), 0u);
  const auto less = [&](uint32_t a, uint32_t b) { return sides[a].loop[0] < sides[b].loop[0]; };
  dsw::sort(by_start.begin(), by_start.end(), less);
  const auto not_less = [&](uint32_t a, uint32_t b) { return !less(a, b); };
  if (std::adjacent_find(by_start.begin(), by_start.end(), not_less) != by_start.end()) return false;
  out.clear();
  uint32_t side = first;
  do {
    out.push_back(side);
    const auto next = std::lower_bound(by_start.begin(), by_start.end(), sides[side].loop[1],
                                       [&](uint32_t i, uint32_t vertex) { return sides[i].loop[0] < vertex; });
    if (next == by_start.end() || sides[*next].loop[0] != sides[side].loop[1]) return false;
    side = *next;
  } while (side != first && out.size() < sides.size());
  return side == first && out.size() == sides.size();
}

bool part_along(CellDraft& whole, const Vertices& loop, CellDraft& left, CellDraft& right) {
  if (loop.size() == 2) return part_between(whole, loop, left, right);
  SideTable sides(whole, loop.get_allocator());
  const auto facets = static_cast<uint32_t>(whole.facets.size());
  ShortArray<uint8_t, 32> is_left(loop.get_allocator());
  is_left.assign(facets, 0);
  ShortArray<uint32_t, 32> stack(loop.get_allocator());
  const auto visit = [&](uint32_t facet) {
    if (is_left[facet] != 0) return;
    is_left[facet] = 1;
    stack.push_back(facet);
  };
  for (uint32_t i = 0; i < loop.size(); ++i) {
    const uint32_t from = loop[i], to = loop[i + 1 == loop.size() ? 0 : i + 1];
    sides.along(from, to).is_cut = sides.along(to, from).is_cut = true;
    visit(sides.along(from, to).facet);
  }
  while (!stack.empty()) {
    const FacetDraft& facet = whole.facets[stack.back()];
    stack.pop_back();
    uint32_t before = facet.loop.back();
    for (const uint32_t v : facet.loop) {
      const SideTable::Side& beyond = sides.along(v, before);
      if (!beyond.is_cut) visit(beyond.facet);
      before = v;
    }
  }
  const auto lefts = static_cast<size_t>(std::count(is_left.begin(), is_left.end(), 1));
  left.facets.reserve(lefts + 1);  // and the new one
  right.facets.reserve(facets - lefts + 1);
  for (uint32_t f = 0; f < facets; ++f) (is_left[f] != 0 ? left : right).facets.push_back(std::move(whole.facets[f]));
  return !right.facets.empty();
}

template FacetDraft draft_of(const Environment<2>& env, HalfFacet h);
template FacetDraft draft_of(const Environment<3>& env, HalfFacet h);
template CellDraft draft_of(const Environment<2>& env, Cell c);
template CellDraft draft_of(const Environment<3>& env, Cell c);
template void centre(const Environment<2>& env, const CellDraft& draft, double* out);
template void centre(const Environment<3>& env, const CellDraft& draft, double* out);

}  // namespace dsw
