// Edges split by a vertex, merged where a vertex goes, and collapsed. All volumes round the edge, or the vertex,
// change. In the plane edges are the sides of polygons.

#include "base/dimensions.h"
#include "base/error.h"
#include "base/position.h"
#include "base/search.h"
#include "environment/marking.h"
#include "map/cell_queue.h"
#include "predicates/filtered.h"
#include "topology/operations.h"

namespace dsw {
namespace {

/** Takes a vertex out of a facet; the loop that its triangles leave, from the vertex after it to the one before. */
Vertices take_out(FacetDraft& facet, uint32_t vertex) {
  const uint32_t at = facet.place_of(vertex);
  const uint32_t last = facet.after(at, facet.loop.size() - 1);
  Vertices hole(facet.loop.get_allocator());
  hole.push_back(facet.after(at));
  while (hole.back() != last) {
    for (size_t t = 0; t < facet.triangles.size(); t += 3) {
      const auto first = facet.triangles.begin() + static_cast<ptrdiff_t>(t);
      const auto corner = dsw::find(first, first + 3, vertex);
      if (corner == first + 3) continue;
      const uint32_t place = static_cast<uint32_t>(corner - first);
      if (first[(place + 1) % 3] != hole.back()) continue;
      hole.push_back(first[(place + 2) % 3]);
      facet.triangles.erase(first, first + 3);
      break;
    }
  }
  facet.loop.erase(facet.loop.begin() + at);
  return hole;
}

/** The two neighbours of a vertex that has two edges in a cell; false if it has more. */
bool find_neighbours(const Map<3>& map, Cell c, uint32_t vertex, uint32_t* ends) {
  const Shape shape = map.shape(c);
  uint32_t count = 0;
  for (uint32_t d = 0; d < shape.dart_count(); ++d) {
    if (map.vertex(c, shape.dart_vertex(d)) != vertex) continue;
    if (count == 2) return false;
    ends[count++] = dart_target(map, {c, d});
  }
  return count == 2;
}

/** The other end of an edge, one end of which has to be `vertex`. */
template <int D>
uint32_t other_end(const Map<D>& map, Dart d, uint32_t vertex) {
  const uint32_t a = dart_vertex(map, d), b = dart_target(map, d);
  if (a != vertex && b != vertex) {
    fail(DSW_STATUS_BAD_TOPOLOGY, "vertex %u is no end of the edge between vertices %u and %u", vertex, a, b);
  }
  return a == vertex ? b : a;
}

template <int D>
void check_alone(const Map<D>& map, uint32_t vertex, size_t cells) {
  if (map.vertex_uses[vertex] == cells) return;
  fail(DSW_STATUS_BAD_TOPOLOGY,
       "vertex %u has %u volumes, only %zu of them are connected through faces to those of the edge", vertex,
       map.vertex_uses[vertex], cells);
}

/** Moves a facet's vertex to another one. Whether a facet is left. */
template <int D>
bool move_vertex(FacetDraft& facet, uint32_t from, uint32_t to) {
  const uint32_t at = facet.place_of(from);
  if (at == facet.loop.size()) return true;
  if (!facet.has(to)) {
    std::replace(facet.loop.begin(), facet.loop.end(), from, to);
    std::replace(facet.triangles.begin(), facet.triangles.end(), from, to);
    return true;
  }
  if (facet.after(at) != to && facet.after(at, facet.loop.size() - 1) != to) {
    fail(DSW_STATUS_BAD_TOPOLOGY, "vertices %u and %u are both in a face, where no edge joins them", from, to);
  }
  facet.loop.erase(facet.loop.begin() + at);
  for (size_t t = 0; t < facet.triangles.size();) {
    const auto first = facet.triangles.begin() + static_cast<ptrdiff_t>(t);
    std::replace(first, first + 3, from, to);
    if (std::count(first, first + 3, to) == 2) {
      facet.triangles.erase(first, first + 3);
    } else {
      t += 3;
    }
  }
  return facet.loop.size() >= static_cast<size_t>(D);
}

/** Collapses one edge: the cells at its end that goes, some of which come to nothing. */
template <int D>
class Collapse {
 public:
  Collapse(Edit<D>& edit, uint32_t from, uint32_t to)
      : edit_(edit), env_(edit.environment()), map_(env_.map), from_(from), to_(to) {}

  void run(Cell first) {
    CellQueue around(env_.memory);
    around.insert(first);
    for_each_cell_at_vertex(map_, from_, around, [&](Cell c) { cells_.push_back(c); });
    check_alone(map_, from_, cells_.size());
    check_boundary();
    move_marks();
    for (const Cell c : cells_) {
      CellDraft draft = draft_of(env_, c);
      const auto is_gone = [&](FacetDraft& facet) { return !move_vertex<D>(facet, from_, to_); };
      draft.facets.erase(std::remove_if(draft.facets.begin(), draft.facets.end(), is_gone), draft.facets.end());
      edit_.remove(c);
      if (draft.facets.size() == 2 && face_each_other(draft.facets[0], draft.facets[1]) &&
          cut_alike(draft.facets[0], draft.facets[1])) {
        flat_.push_back({c, {draft.facets[0].near, draft.facets[1].near}});
      } else {
        edit_.add(std::move(draft));
      }
    }
    for (const Cell c : cells_) {
      CellDraft* const draft = edit_.find_draft(c);
      if (draft == nullptr) continue;
      for (FacetDraft& facet : draft->facets) pass_flat(facet);
    }
  }

 private:
  struct Flat {
    Cell cell;
    HalfFacet sides[2];
  };

  /** The outer boundary keeps its form exactly if no triangle of it that moves sweeps a volume (no side an area). */
  void check_boundary() const {
    for (const Cell c : cells_) {
      const Shape shape = map_.shape(c);
      for (uint32_t s = 0; s < shape.simplex_count(); ++s) {
        const uint16_t* const local = shape.simplices() + D * s;
        const auto has = [&](uint32_t v) {
          return dsw::any_of(local, local + D, [&](uint32_t corner) { return map_.vertex(c, corner) == v; });
        };
        if (!has(from_) || has(to_) || map_.opposite(map_.half_facet(c, shape.simplex_facets(D)[s])).valid()) continue;
        const double* simplex[D];
        simplex_points(env_, c, shape, s, simplex);
        if (orient<D>(simplex, env_.point(to_)) == 0) continue;
        fail(DSW_STATUS_BAD_TOPOLOGY, "the outer boundary at vertex %u would change its form", from_);
      }
    }
  }

  void move_marks() {
    if (vertex_marked(env_, from_)) edit_.set_mark(to_, true);
    if (env_.edge_marks.size() == 0) return;
    for (const Cell c : cells_) {
      for (uint32_t d = 0, n = map_.shape(c).dart_count(); d < n; ++d) {
        const uint32_t end = dart_target(map_, {c, d});
        if (dart_vertex(map_, {c, d}) != from_ || end == to_ || !edge_marked(env_, from_, end)) continue;
        edit_.set_mark(to_, end, true);
      }
    }
  }

  /** What is behind a facet when the cells that come to nothing are left out. */
  void pass_flat(FacetDraft& facet) const {
    for (;;) {
      const Cell behind = facet.far.valid() ? map_.cell_of(facet.far) : Cell{};
      const auto flat = dsw::find_if(flat_.begin(), flat_.end(), [&](const Flat& f) { return f.cell == behind; });
      if (!behind.valid() || flat == flat_.end()) return;
      const HalfFacet exit = flat->sides[flat->sides[0] == facet.far ? 1 : 0];
      facet.marked = facet.marked || map_.facet_marked(exit);
      facet.far = map_.opposite(exit);
      facet.exit_patch = exit_patch(env_, exit);
    }
  }

  Edit<D>& edit_;
  const Environment<D>& env_;
  const Map<D>& map_;
  uint32_t from_, to_;
  Array<Cell> cells_{env_.memory};
  Array<Flat> flat_{env_.memory};
};

}  // namespace

template <int D>
uint32_t split_edge(Edit<D>& edit, Dart d, double share) {
  const Map<D>& map = edit.environment().map;
  const uint32_t a = dart_vertex(map, d), b = dart_target(map, d);
  const uint32_t middle = edit.add_vertex(a, b, share);
  for_each_volume_round_edge(map, d, [&](Dart e) {
    insert_vertex(edit.draft(edit.replace(e.cell)), a, b, middle);
    return true;
  });
  return middle;
}

MergedEdge merge_edges(Edit<3>& edit, Dart d, uint32_t vertex) {
  const Environment<3>& env = edit.environment();
  const Map<3>& map = env.map;
  uint32_t ends[2] = {other_end(map, d, vertex), 0};
  size_t count = 0;
  for_each_volume_round_edge(map, d, [&](Dart e) {
    uint32_t found[2];
    if (!find_neighbours(map, e.cell, vertex, found)) {
      fail(DSW_STATUS_BAD_TOPOLOGY, "vertex %u has more than two edges", vertex);
    }
    const uint32_t other = found[0] == ends[0] ? found[1] : found[0];
    if (count != 0 && other != ends[1]) fail(DSW_STATUS_BAD_TOPOLOGY, "vertex %u has more than two edges", vertex);
    ends[1] = other;
    edit.replace(e.cell);
    ++count;
    return true;
  });
  check_alone(map, vertex, count);
  struct Hole {
    Cell cell;
    uint32_t facet;
    Vertices loop;
  };
  Array<Hole> holes{env.memory};
  for (size_t i = 0; i < count; ++i) {
    CellDraft& draft = edit.draft(i);
    for (uint32_t f = 0; f < draft.facets.size(); ++f) {
      if (!draft.facets[f].has(vertex)) continue;
      if (draft.facets[f].loop.size() == 3) {
        fail(DSW_STATUS_BAD_TOPOLOGY, "a face at vertex %u is a triangle and would vanish", vertex);
      }
      holes.push_back({draft.from, f, take_out(draft.facets[f], vertex)});
    }
  }
  for (const Hole& hole : holes) {
    CellDraft& draft = *edit.find_draft(hole.cell);
    FacetDraft& facet = draft.facets[hole.facet];
    if (facet.triangles.size() == 3 * (facet.loop.size() - 2))
      continue;  // filled from the other side, or nothing to fill
    CellDraft* const other = facet.far.valid() ? edit.find_draft(map.cell_of(facet.far)) : nullptr;
    double apex[3], beyond[3];
    centre(env, draft, apex);
    if (other != nullptr) centre(env, *other, beyond);
    if (!cut_anew(env, facet, hole.loop, apex, other != nullptr ? beyond : nullptr)) {
      fail(DSW_STATUS_INVALID_CELL, "a face without vertex %u can't be cut so that its volumes stay valid", vertex);
    }
    if (other != nullptr) cut_like(other->facets[facet_from(*other, facet.far)], facet);
  }
  if (edge_marked(env, ends[0], vertex) || edge_marked(env, vertex, ends[1])) edit.set_mark(ends[0], ends[1], true);
  return {ends[0], ends[1]};
}

MergedEdge merge_edges(Edit<2>& edit, Dart d, uint32_t vertex) {
  const Environment<2>& env = edit.environment();
  const Map<2>& map = env.map;
  other_end(map, d, vertex);
  const uint32_t n = map.facets_of(d.cell), at = dart_vertex(map, d) == vertex ? d.local : (d.local + 1) % n;
  const uint32_t before = (at + n - 1) % n, after = (at + 1) % n;
  const HalfFacet h = map.half_facet(d.cell, before), g = map.half_facet(d.cell, at);
  const auto beyond = [&](HalfFacet side) {
    return map.opposite(side).valid() ? map.cell_of(map.opposite(side)) : Cell{};
  };
  const Cell other = beyond(h);
  if (beyond(g) != other) fail(DSW_STATUS_BAD_TOPOLOGY, "vertex %u has more than two edges", vertex);
  check_alone(map, vertex, other.valid() ? 2 : 1);
  for (const Cell c : {d.cell, other}) {
    if (!c.valid() || map.facets_of(c) > 3) continue;
    fail(DSW_STATUS_BAD_TOPOLOGY, "volume %u at vertex %u is a triangle and would vanish", map.index(c), vertex);
  }
  Vertices ends{env.memory};
  for (const uint32_t corner : {before, after}) ends.push_back(map.vertex(d.cell, corner));
  edit.replace(d.cell);
  unite(edit, h, g, ends);
  return {ends[0], ends[1]};
}

template <int D>
void collapse_edge(Edit<D>& edit, Dart d, uint32_t vertex) {
  const uint32_t to = other_end(edit.environment().map, d, vertex);
  Collapse<D>(edit, vertex, to).run(d.cell);
}

DSW_INSTANTIATE(split_edge);
DSW_INSTANTIATE(collapse_edge);

}  // namespace dsw
