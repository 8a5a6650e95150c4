#include "topology/layout.h"

#include <numeric>

#include "base/error.h"
#include "topology/standard_form.h"

namespace dsw {

template <>
bool lay_out<3>(const CellDraft& draft, Layout& out) {
  size_t corners = 0;
  for (const FacetDraft& facet : draft.facets) corners += facet.loop.size();
  if (corners >= UINT16_MAX) fail(DSW_STATUS_TOO_LARGE, "a volume would have %zu corners of faces", corners);
  Array<uint32_t>& vertices = out.listed;  // each once, in the order of first use
  vertices.clear();
  vertices.reserve(corners);
  out.loops.resize(corners);
  out.first.clear();
  out.first.reserve(draft.facets.size() + 1);
  out.first.push_back(0);
  Numbering number(vertices);
  uint16_t* loop = out.loops.data();
  out.triangles.resize(3 * corners);
  uint16_t* corner = out.triangles.data();
  for (const FacetDraft& facet : draft.facets) {
    for (const uint32_t v : facet.loop) *loop++ = static_cast<uint16_t>(number(v));
    out.first.push_back(static_cast<uint16_t>(loop - out.loops.data()));
    for (const uint32_t v : facet.triangles) *corner++ = static_cast<uint16_t>(number(v));
  }
  const auto facets = static_cast<uint32_t>(draft.facets.size());
  const FacetLoops faces{out.loops.data(), out.first.data(), facets, static_cast<uint32_t>(vertices.size())};
  out.table.clear();
  if (append_polyhedron(faces, nullptr, out.table, out.triangles.data()) != ShapeDefect::kNone) return false;
  const StandardMatch match = match_standard_form(Shape(out.table.data()));
  out.form = match.form;
  out.cuts = match.cuts;
  out.facets.resize(facets);
  if (match.form == Form::kGeneral) {
    std::iota(out.facets.begin(), out.facets.end(), 0u);
    out.vertices = vertices;
    return true;
  }
  out.vertices.resize(vertices.size());
  for (uint32_t f = 0; f < facets; ++f) out.facets[match.facet[f]] = f;
  for (size_t k = 0; k < vertices.size(); ++k) out.vertices[k] = vertices[match.vertex[k]];
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
  out.vertices.clear();
  out.table.clear();
  for (uint32_t k = 0; k < corners; ++k) {
    out.facets[order[k]] = k;
    out.vertices.push_back(draft.facets[order[k]].loop[0]);
  }
  return out.form != Form::kGeneral || append_polygon(static_cast<uint32_t>(corners), out.table) == ShapeDefect::kNone;
}

}  // namespace dsw
