// Faces sewn and unsewn, volumes removed, merged and split.

#include "base/dimensions.h"
#include "base/error.h"
#include "base/search.h"
#include "base/sort.h"
#include "topology/operations.h"

namespace dsw {
namespace {

/** Whether a facet of a cell is still positive seen from the centre if it is cut like another one. */
bool can_cut_like(const Environment<3>& env, Cell c, FacetDraft facet, const FacetDraft& other) {
  double apex[3];
  centre(env, c, apex);
  cut_like(facet, other);
  return is_cut_well(env, facet, apex, nullptr);
}

template <int D>
void check_pair(const Environment<D>& env, const FacetPair& pair, size_t i) {
  const Map<D>& map = env.map;
  for (const HalfFacet h : {pair.a, pair.b}) {
    if (!map.opposite(h).valid()) continue;
    fail(DSW_STATUS_BAD_TOPOLOGY, "pair %zu: face %u of volume %u is not on the outer boundary", i,
         map.local_of(h, map.cell_of(h)), map.index(map.cell_of(h)));
  }
  if (map.cell_of(pair.a) == map.cell_of(pair.b)) {
    fail(DSW_STATUS_BAD_TOPOLOGY, "pair %zu: both faces belong to volume %u", i, map.index(map.cell_of(pair.a)));
  }
}

/** A facet as it will be. */
template <int D>
FacetDraft current(Edit<D>& edit, HalfFacet h) {
  const CellDraft* const draft = edit.find_draft(edit.environment().map.cell_of(h));
  return draft == nullptr ? draft_of(edit.environment(), h) : draft->facets[facet_from(*draft, h)];
}

/** Makes the two facets of a pair have the same triangles. */
template <int D>
void fit(Edit<D>& edit, const FacetPair& pair, size_t i) {
  const Environment<D>& env = edit.environment();
  const FacetDraft a = current(edit, pair.a), b = current(edit, pair.b);
  if (!face_each_other(a, b)) {
    fail(DSW_STATUS_BAD_TOPOLOGY, "pair %zu: the faces do not have the same vertices in opposite order", i);
  }
  if constexpr (D == 3) {
    if (cut_alike(a, b)) return;
    const auto cut = [&](HalfFacet h, const FacetDraft& like) {
      CellDraft& draft = edit.draft(edit.replace(env.map.cell_of(h)));
      cut_like(draft.facets[facet_from(draft, h)], like);
    };
    if (can_cut_like(env, env.map.cell_of(pair.b), b, a)) {
      cut(pair.b, a);
    } else if (can_cut_like(env, env.map.cell_of(pair.a), a, b)) {
      cut(pair.a, b);
    } else {
      fail(DSW_STATUS_INVALID_CELL, "pair %zu: the faces are cut differently, and neither volume can be cut anew", i);
    }
  }
}

/** Whether a cell has an edge that runs from one vertex to another. */
template <int D>
bool has_edge(const Map<D>& map, Cell c, uint32_t from, uint32_t to) {
  uint32_t d = 0;
  const uint32_t darts = map.shape(c).dart_count();
  while (d < darts && (dart_vertex(map, {c, d}) != from || dart_target(map, {c, d}) != to)) ++d;
  return d < darts;
}

/** Throws unless a loop runs along edges of a cell. */
void check_loop(const Map<3>& map, Cell c, const uint32_t* loop, size_t count) {
  if (count < 3) fail(DSW_STATUS_BAD_TOPOLOGY, "the loop has %zu vertices, must have at least 3", count);
  for (size_t i = 0; i < count; ++i) {
    const uint32_t from = loop[i], to = loop[(i + 1) % count];
    if (!has_edge(map, c, from, to)) {
      fail(DSW_STATUS_BAD_TOPOLOGY, "volume %u has no edge from vertex %u to vertex %u", map.index(c), from, to);
    }
    if (dsw::find(loop, loop + i, from) != loop + i) {
      fail(DSW_STATUS_BAD_TOPOLOGY, "vertex %u occurs twice in the loop", from);
    }
  }
}

/** Throws unless it leads from one corner of a polygon to another that is not next to it. */
void check_loop(const Map<2>& map, Cell c, const uint32_t* loop, size_t count) {
  if (count != 2) fail(DSW_STATUS_BAD_TOPOLOGY, "the loop has %zu vertices, in the plane it must have 2", count);
  for (size_t i = 0; i < 2; ++i) {
    uint32_t k = 0;
    while (k < map.vertices_of(c) && map.vertex(c, k) != loop[i]) ++k;
    if (k == map.vertices_of(c)) {
      fail(DSW_STATUS_BAD_TOPOLOGY, "volume %u does not have vertex %u", map.index(c), loop[i]);
    }
  }
  if (loop[0] == loop[1] || has_edge(map, c, loop[0], loop[1]) || has_edge(map, c, loop[1], loop[0])) {
    fail(DSW_STATUS_BAD_TOPOLOGY, "vertices %u and %u are the same, or joined already", loop[0], loop[1]);
  }
}

}  // namespace

template <int D>
void sew(Edit<D>& edit, const FacetPair* pairs, size_t count) {
  const Environment<D>& env = edit.environment();
  Array<uint32_t> words{env.memory};
  for (size_t i = 0; i < count; ++i) {
    check_pair(env, pairs[i], i);
    words.push_back(pairs[i].a.word);
    words.push_back(pairs[i].b.word);
  }
  dsw::sort(words.begin(), words.end());
  if (std::adjacent_find(words.begin(), words.end()) != words.end()) {
    fail(DSW_STATUS_DUPLICATE_ID, "a face occurs in two pairs");
  }
  for (size_t i = 0; i < count; ++i) fit(edit, pairs[i], i);
  for (size_t i = 0; i < count; ++i) {
    const HalfFacet sides[2] = {pairs[i].a, pairs[i].b};
    CellDraft* drafts[2];
    for (int k = 0; k < 2; ++k) drafts[k] = edit.find_draft(env.map.cell_of(sides[k]));
    const bool marked = env.map.facet_marked(sides[0]) || env.map.facet_marked(sides[1]);
    for (int k = 0; k < 2; ++k) {
      if (drafts[k] != nullptr) {
        FacetDraft& facet = drafts[k]->facets[facet_from(*drafts[k], sides[k])];
        facet.far = sides[1 - k];
        facet.marked = marked;
      } else if (drafts[1 - k] == nullptr) {
        edit.set_link(sides[k], sides[1 - k], marked);
      }
    }
  }
}

template <int D>
void unsew(Edit<D>& edit, HalfFacet h) {
  const Map<D>& map = edit.environment().map;
  const HalfFacet o = map.opposite(h);
  if (!o.valid()) fail(DSW_STATUS_BAD_TOPOLOGY, "the face is on the outer boundary already");
  const bool marked = map.facet_marked(h);
  edit.set_link(h, {}, marked);
  edit.set_link(o, {}, marked);
}

template <int D>
void remove_cells(Edit<D>& edit, const Cell* cells, size_t count) {
  for (size_t i = 0; i < count; ++i) edit.remove(cells[i]);
  if (edit.removed().size() == edit.environment().map.cell_count) {
    fail(DSW_STATUS_BAD_TOPOLOGY, "an environment must keep at least one volume");
  }
}

template <int D>
size_t merge_cells(Edit<D>& edit, HalfFacet h) {
  const Environment<D>& env = edit.environment();
  const Map<D>& map = env.map;
  const HalfFacet o = map.opposite(h);
  if (!o.valid()) fail(DSW_STATUS_BAD_TOPOLOGY, "the face is on the outer boundary: there is nothing to merge with");
  const Cell a = map.cell_of(h), b = map.cell_of(o);
  if (map.marked(a) != map.marked(b)) {
    fail(DSW_STATUS_BAD_TOPOLOGY, "one of volumes %u and %u is marked, the other is not", map.index(a), map.index(b));
  }
  CellDraft merged = draft_of(env, a), other = draft_of(env, b);
  const auto drop_shared = [&](CellDraft& draft, Cell beyond) {
    const auto is_shared = [&](const FacetDraft& facet) {
      return facet.far.valid() && map.cell_of(facet.far) == beyond;
    };
    draft.facets.erase(std::remove_if(draft.facets.begin(), draft.facets.end(), is_shared), draft.facets.end());
  };
  drop_shared(merged, b);
  drop_shared(other, a);
  for (FacetDraft& facet : other.facets) merged.facets.push_back(std::move(facet));
  merged.also.push_back(b);
  edit.remove(a);
  edit.remove(b);
  return edit.add(std::move(merged));
}

template <int D>
SplitCell split_cell(Edit<D>& edit, Cell c, const uint32_t* loop, size_t count) {
  const Environment<D>& env = edit.environment();
  check_loop(env.map, c, loop, count);
  CellDraft whole = draft_of(env, c), left(env.scratch.memory());
  left.from = c;
  left.marked = whole.marked;
  left.region = whole.region;
  left.tag = whole.tag;
  CellDraft right = left;
  right.keeps_index = false;
  FacetDraft inserted(env.scratch.memory());
  inserted.pair = 0;
  inserted.loop.assign(loop, loop + count);
  if (!part_along(whole, inserted.loop, left, right)) {
    fail(DSW_STATUS_BAD_TOPOLOGY, "the loop does not separate the faces of the volume");
  }
  FacetDraft turned = inserted;
  std::reverse(turned.loop.begin(), turned.loop.end());
  if constexpr (D == 3) {
    double left_apex[3], right_apex[3];
    centre(env, left, left_apex);
    centre(env, right, right_apex);
    if (!cut_anew(env, turned, turned.loop, left_apex, right_apex)) {
      fail(DSW_STATUS_INVALID_CELL, "the new face can't be cut into triangles that leave both volumes valid");
    }
    cut_like(inserted, turned);
  } else {
    std::swap(turned, inserted);  // a side has its polygon on its left, a loop of edges the facets seen from outside
  }
  left.facets.push_back(std::move(turned));
  right.facets.push_back(std::move(inserted));
  const auto left_facet = static_cast<uint32_t>(left.facets.size() - 1);
  const auto right_facet = static_cast<uint32_t>(right.facets.size() - 1);
  edit.remove(c);
  const size_t first = edit.add(std::move(left));
  return {first, edit.add(std::move(right)), left_facet, right_facet};
}

DSW_INSTANTIATE(sew);
DSW_INSTANTIATE(unsew);
DSW_INSTANTIATE(remove_cells);
DSW_INSTANTIATE(merge_cells);
DSW_INSTANTIATE(split_cell);

}  // namespace dsw
