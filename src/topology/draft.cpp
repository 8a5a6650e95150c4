#include "topology/draft.h"

#include "base/error.h"
#include "environment/recut.h"
#include "predicates/filtered.h"

namespace dsw {
namespace {

/** Triangles as sorted triples in ascending order. */
void sort_triangles(const FacetDraft& facet, Array<uint32_t>& out) {
  out = facet.triangles;
  for (size_t t = 0; t < out.size(); t += 3)
    std::sort(out.begin() + static_cast<ptrdiff_t>(t), out.begin() + static_cast<ptrdiff_t>(t) + 3);
  // Few and short: insertion by whole triples.
  for (size_t t = 3; t < out.size(); t += 3) {
    for (size_t u = t; u >= 3; u -= 3) {
      const auto at = out.begin() + static_cast<ptrdiff_t>(u);
      if (!std::lexicographical_compare(at, at + 3, at - 3, at)) break;
      std::swap_ranges(at, at + 3, at - 3);
    }
  }
}

}  // namespace

FacetDraft draft_of(const Environment<3>& env, HalfFacet h) {
  const Map<3>& map = env.map;
  const Cell c = map.cell_of(h);
  const Shape shape = map.shape(c);
  const uint32_t f = map.local_of(h, c);
  FacetDraft facet(env.memory);
  for (uint32_t d = shape.facet_first(f); d < shape.facet_first(f + 1); ++d) {
    facet.loop.push_back(map.vertex(c, shape.dart_vertex(d)));
  }
  const uint16_t* const local = shape.simplices();
  for (uint32_t k = 3 * shape.simplex_first(f); k < 3 * shape.simplex_first(f + 1); ++k) {
    facet.triangles.push_back(map.vertex(c, local[k]));
  }
  facet.near = h;
  facet.far = map.opposite(h);
  facet.marked = map.facet_marked(h);
  return facet;
}

CellDraft draft_of(const Environment<3>& env, Cell c) {
  CellDraft draft(env.memory);
  const uint32_t facets = env.map.facets_of(c);
  draft.facets.reserve(facets);
  for (uint32_t f = 0; f < facets; ++f) draft.facets.push_back(draft_of(env, env.map.half_facet(c, f)));
  draft.from = c;
  draft.marked = env.map.marked(c);
  draft.region = env.region(c);
  draft.tag = env.tag(c);
  return draft;
}

bool face_each_other(const FacetDraft& a, const FacetDraft& b) {
  const size_t n = a.loop.size();
  if (b.loop.size() != n) return false;
  const uint32_t start = b.place_of(a.loop[0]);
  if (start == n) return false;
  for (size_t k = 1; k < n; ++k) {
    if (b.after(start, n - k) != a.loop[k]) return false;
  }
  return true;
}

bool cut_alike(const FacetDraft& a, const FacetDraft& b) {
  Array<uint32_t> of_a(a.triangles.get_allocator()), of_b(of_a);
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

bool cut_anew(const Environment<3>& env, FacetDraft& facet, const Array<uint32_t>& hole, const double* apex,
              const double* beyond) {
  if (hole.size() > kMostTriangulated) {
    fail(DSW_STATUS_TOO_LARGE, "a face of %zu vertices has to be cut anew, more than %u", hole.size(),
         kMostTriangulated);
  }
  Array<const double*> points{Allocator<const double*>(env.memory)};
  for (const uint32_t v : hole) points.push_back(env.point(v));
  const Array<size_t> triangles = triangulate(points, apex, beyond);
  for (const size_t place : triangles) facet.triangles.push_back(hole[place]);
  return !triangles.empty();
}

void list_vertices(const CellDraft& draft, Array<uint32_t>& out) {
  out.clear();
  for (const FacetDraft& facet : draft.facets) {
    for (const uint32_t v : facet.loop) {
      if (std::find(out.begin(), out.end(), v) == out.end()) out.push_back(v);
    }
  }
}

void centre(const Environment<3>& env, const CellDraft& draft, double* out) {
  Array<uint32_t> vertices{Allocator<uint32_t>(env.memory)};
  list_vertices(draft, vertices);
  const double count = static_cast<double>(vertices.size());
  for (int k = 0; k < 3; ++k) {
    out[k] = 0;
    for (const uint32_t v : vertices) out[k] += env.point(v)[k] / count;
  }
}

}  // namespace dsw
