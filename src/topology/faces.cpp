// Faces split by an edge, and merged where an edge goes; in the plane sides merged where a vertex goes.

#include <utility>

#include "base/error.h"
#include "topology/operations.h"

namespace dsw {

SplitFacet split_facet(Edit<3>& edit, HalfFacet h, uint32_t a, uint32_t b) {
  const Environment<3>& env = edit.environment();
  const Map<3>& map = env.map;
  const HalfFacet o = map.opposite(h);
  const Cell c = map.cell_of(h), beyond = o.valid() ? map.cell_of(o) : Cell{};
  const FacetDraft whole = draft_of(env, h);
  const size_t n = whole.loop.size();
  for (const uint32_t v : {a, b}) {
    if (!whole.has(v)) fail(DSW_STATUS_BAD_TOPOLOGY, "vertex %u is not a vertex of the face", v);
  }
  const size_t distance = (whole.place_of(b) + n - whole.place_of(a)) % n;
  if (distance < 2 || distance > n - 2) {
    fail(DSW_STATUS_BAD_TOPOLOGY, "vertices %u and %u are the same, or joined already", a, b);
  }
  FacetDraft from_a = part_of(whole, a, b), from_b = part_of(whole, b, a);
  if (!share_triangles(whole, from_a, from_b)) {
    // The new edge crosses a cut: both parts are cut anew, as both volumes see them.
    double apex[3], apex_beyond[3];
    centre(env, c, apex);
    if (o.valid()) centre(env, beyond, apex_beyond);
    for (FacetDraft* part : {&from_a, &from_b}) {
      part->triangles.clear();
      if (!cut_anew(env, *part, part->loop, apex, o.valid() ? apex_beyond : nullptr)) {
        fail(DSW_STATUS_INVALID_CELL, "the parts of the face can't be cut so that the volumes beside it stay valid");
      }
    }
  }
  if (o.valid()) {
    CellDraft& other = edit.draft(edit.replace(beyond));
    other.facets[facet_from(other, o)] = turned(from_a);
    other.facets.push_back(turned(from_b));
  }
  const size_t i = edit.replace(c);
  CellDraft& draft = edit.draft(i);
  const uint32_t place = facet_from(draft, h);
  draft.facets[place] = std::move(from_a);
  draft.facets.push_back(std::move(from_b));
  return {i, place, static_cast<uint32_t>(draft.facets.size() - 1)};
}

template <int D>
MergedFacet unite(Edit<D>& edit, HalfFacet h, HalfFacet g, const Vertices& loop) {
  const Environment<D>& env = edit.environment();
  const Map<D>& map = env.map;
  if (map.facet_marked(h) != map.facet_marked(g)) {
    fail(DSW_STATUS_BAD_TOPOLOGY, "one of the two faces is marked, the other is not");
  }
  if (exit_patch(env, h) != exit_patch(env, g)) {
    fail(DSW_STATUS_BAD_TOPOLOGY, "the two faces are exits of different patches, or one of them is none");
  }
  const FacetDraft first = draft_of(env, h), second = draft_of(env, g);
  const bool two = first.far.valid();
  // Both sides have to name the merged face after the same one of the two.
  const bool after_first =
      !two || std::min(first.near.word, first.far.word) < std::min(second.near.word, second.far.word);
  FacetDraft merged(env.scratch.memory());
  merged.loop = loop;
  merged.triangles = first.triangles;
  merged.triangles.append(second.triangles.begin(), second.triangles.end());
  merged.near = after_first ? first.near : second.near;
  merged.far = after_first ? first.far : second.far;
  merged.marked = first.marked;
  merged.exit_patch = first.exit_patch;
  const auto put = [&](HalfFacet kept, HalfFacet gone, const FacetDraft& facet) {
    const size_t i = edit.replace(map.cell_of(kept));
    CellDraft& draft = edit.draft(i);
    draft.facets[facet_from(draft, kept)] = facet;
    draft.facets.erase(draft.facets.begin() + static_cast<ptrdiff_t>(facet_from(draft, gone)));
    return MergedFacet{i, facet_from(draft, kept)};
  };
  if (two) put(merged.far, after_first ? second.far : first.far, turned(merged));
  return put(merged.near, after_first ? second.near : first.near, merged);
}

MergedFacet merge_facets(Edit<3>& edit, Dart d) {
  const Environment<3>& env = edit.environment();
  const Map<3>& map = env.map;
  const Dart e = beta2(map, d);
  const Dart across_d = beta3(map, d), across_e = beta3(map, e);
  const bool two = across_d.cell.valid() && across_e.cell.valid() && beta2(map, across_d) == across_e;
  const uint32_t a = dart_vertex(map, d), b = dart_target(map, d);
  if (!two && (across_d.cell.valid() || across_e.cell.valid())) {
    fail(DSW_STATUS_BAD_TOPOLOGY, "the edge between vertices %u and %u has more than two faces", a, b);
  }
  const HalfFacet h = half_facet(map, d), g = half_facet(map, e);
  Vertices loop = part_of(draft_of(env, h), b, a).loop;
  const Vertices rest = part_of(draft_of(env, g), a, b).loop;
  loop.append(rest.begin() + 1, rest.end() - 1);
  return unite(edit, h, g, loop);
}

template MergedFacet unite(Edit<2>& edit, HalfFacet h, HalfFacet g, const Vertices& loop);

}  // namespace dsw
