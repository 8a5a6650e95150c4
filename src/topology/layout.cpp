#include "topology/layout.h"

#include <numeric>

#include "base/error.h"
#include "topology/standard_form.h"

namespace dsw {

template <>
bool lay_out<3>(const CellDraft& draft, Layout& out) {
  Array<uint16_t> loops(out.table.get_allocator()), first(loops);
  Array<uint32_t> vertices(out.vertices.get_allocator());
  list_vertices(draft, vertices);
  const auto local = [&](uint32_t v) {
    return static_cast<uint16_t>(std::find(vertices.begin(), vertices.end(), v) - vertices.begin());
  };
  size_t corners = 0;
  for (const FacetDraft& facet : draft.facets) corners += facet.loop.size();
  if (corners >= UINT16_MAX) fail(DSW_STATUS_TOO_LARGE, "a volume would have %zu corners of faces", corners);
  loops.reserve(corners);
  first.reserve(draft.facets.size() + 1);
  first.push_back(0);
  for (const FacetDraft& facet : draft.facets) {
    for (const uint32_t v : facet.loop) loops.push_back(local(v));
    first.push_back(static_cast<uint16_t>(loops.size()));
  }
  const auto facets = static_cast<uint32_t>(draft.facets.size());
  const FacetLoops faces{loops.data(), first.data(), facets, static_cast<uint32_t>(vertices.size())};
  if (append_polyhedron(faces, nullptr, out.table) != ShapeDefect::kNone) return false;
  Array<uint16_t> triangles(out.table.get_allocator());
  for (uint32_t f = 0; f < facets; ++f) {
    triangles.clear();
    for (const uint32_t v : draft.facets[f].triangles) triangles.push_back(local(v));
    set_triangles(out.table.data(), f, triangles.data());
  }
  const StandardMatch match = match_standard_form(Shape(out.table.data()));
  out.form = match.form;
  out.cuts = match.cuts;
  out.facets.resize(facets);
  if (match.form == Form::kGeneral) {
    std::iota(out.facets.begin(), out.facets.end(), 0u);
    out.vertices = std::move(vertices);
    return true;
  }
  out.vertices.reserve(vertices.size());
  for (uint32_t f = 0; f < facets; ++f) out.facets[match.facet[f]] = f;
  for (size_t k = 0; k < vertices.size(); ++k) out.vertices.push_back(vertices[match.vertex[k]]);
  return true;
}

template <>
bool lay_out<2>(const CellDraft& draft, Layout& out) {
  const size_t corners = draft.facets.size();
  if (corners >= UINT16_MAX) fail(DSW_STATUS_TOO_LARGE, "a volume would have %zu faces", corners);
  Array<uint32_t> order(out.facets.get_allocator());
  if (corners < 3 || !order_sides(draft, 0, order)) return false;
  out.form = corners == 3 ? Form::kSimplex : corners == 4 ? Form::kBox : Form::kGeneral;
  out.facets.resize(corners);
  for (uint32_t k = 0; k < corners; ++k) {
    out.facets[order[k]] = k;
    out.vertices.push_back(draft.facets[order[k]].loop[0]);
  }
  return out.form != Form::kGeneral || append_polygon(static_cast<uint32_t>(corners), out.table) == ShapeDefect::kNone;
}

}  // namespace dsw
