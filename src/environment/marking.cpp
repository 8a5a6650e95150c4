#include "environment/marking.h"

#include "base/dimensions.h"

namespace dsw {
namespace {

/** Counts a change of one mark. */
bool count_change(uint64_t& count, bool was, bool marked) noexcept {
  if (was == marked) return false;
  count = marked ? count + 1 : count - 1;
  return true;
}

/** Passes on whether a mark changed, and notes it. */
template <int D>
bool note_change(Environment<D>& env, bool changed, bool marked) noexcept {
  if (changed && marked) env.renew_version();
  if (changed && !marked) ++env.change_version;
  return changed;
}

/** Notes the cells that have an obstacle now: at the facets of a cell that became impassable the cells beyond, else
 * the cell. */
template <int D>
void note_obstacles(Environment<D>& env, Cell c, bool marked) noexcept {
  if (!env.obstacles.exists()) return;
  if (!marked) return env.obstacles.note_cell(env.map.index(c));
  for (uint32_t f = 0, facets = env.map.facets_of(c); f < facets; ++f) {
    const HalfFacet o = env.map.opposite(env.map.half_facet(c, f));
    if (o.valid()) env.obstacles.note_cell(env.map.index(env.map.cell_of(o)));
  }
}

void set_bit(uint32_t& word, bool marked) noexcept { word = marked ? word | kMarkBit : word & ~kMarkBit; }

}  // namespace

template <int D>
void reserve_edge_marks(Environment<D>& env, size_t more) {
  env.edge_marks.reserve(more);
}

template <int D>
void reserve_vertex_marks(Environment<D>& env) {
  if (env.vertex_marks.empty()) env.vertex_marks.resize((size_t{env.map.vertex_count} + 63) / 64, 0);
}

template <int D>
bool set_cell_mark(Environment<D>& env, Cell c, bool marked) noexcept {
  uint32_t& word = env.map.record(c)[0];
  const bool changed = count_change(env.marked_cells, (word & kMarkBit) != 0, marked);
  set_bit(word, marked);
  if (changed) note_obstacles(env, c, marked);
  return note_change(env, changed, marked);
}

template <int D>
bool set_facet_mark(Environment<D>& env, HalfFacet h, bool marked) noexcept {
  uint32_t& word = env.map.words[h.word];
  const HalfFacet other = env.map.opposite(h);
  const bool changed = count_change(env.marked_facets, (word & kMarkBit) != 0, marked);
  set_bit(word, marked);
  if (other.valid()) set_bit(env.map.words[other.word], marked);
  if (changed && marked && other.valid() && env.obstacles.exists()) {
    env.obstacles.note_cell(env.map.index(env.map.cell_of(h)));
    env.obstacles.note_cell(env.map.index(env.map.cell_of(other)));
  }
  return note_change(env, changed, marked);
}

template <int D>
bool set_edge_mark(Environment<D>& env, uint32_t a, uint32_t b, bool marked) noexcept {
  // Room was made by reserve_edge_marks, so insert does not allocate.
  const bool changed = marked ? env.edge_marks.insert(a, b) : env.edge_marks.erase(a, b);
  env.marked_edges = env.edge_marks.size();
  if (changed && marked) env.obstacles.note_vertex(a);
  return note_change(env, changed, marked);
}

template <int D>
bool set_vertex_mark(Environment<D>& env, uint32_t vertex, bool marked) noexcept {
  if (env.vertex_marks.empty()) return false;  // nothing is marked, and marking makes room first
  const bool changed = count_change(env.marked_vertices, vertex_marked(env, vertex), marked);
  const uint64_t bit = uint64_t{1} << (vertex % 64);
  uint64_t& word = env.vertex_marks[vertex / 64];
  word = marked ? word | bit : word & ~bit;
  if (changed && marked) env.obstacles.note_vertex(vertex);
  return note_change(env, changed, marked);
}

bool edge_impassable(const Environment<3>& env, Dart d) noexcept {
  const Map<3>& map = env.map;
  if (edge_marked(env, dart_vertex(map, d), dart_target(map, d))) return true;
  bool found = false;
  for_each_volume_round_edge(map, d, [&](Dart e) {
    found = is_impassable(env, half_facet(map, e)) || is_impassable(env, half_facet(map, beta2(map, e)));
    return !found;
  });
  return found;
}

template <int D>
bool vertex_impassable(const Environment<D>& env, uint32_t vertex) noexcept {
  if (vertex_marked(env, vertex)) return true;
  const Map<D>& map = env.map;
  for (uint32_t i = 0, count = map.index_count(); i < count; ++i) {
    const Cell c = map.cell(i);
    if (!c.valid()) continue;
    const Shape shape = map.shape(c);
    for (uint32_t d = 0; d < shape.dart_count(); ++d) {
      const uint32_t target = shape.dart_vertex(D == 2 ? (d + 1) % shape.dart_count() : shape.beta1(d));
      if (map.vertex(c, shape.dart_vertex(d)) != vertex && map.vertex(c, target) != vertex) continue;
      if (is_impassable(env, map.half_facet(c, shape.dart_facet(d)))) return true;
    }
  }
  return false;
}

DSW_INSTANTIATE(reserve_edge_marks);
DSW_INSTANTIATE(reserve_vertex_marks);
DSW_INSTANTIATE(set_cell_mark);
DSW_INSTANTIATE(set_facet_mark);
DSW_INSTANTIATE(set_edge_mark);
DSW_INSTANTIATE(set_vertex_mark);
DSW_INSTANTIATE(vertex_impassable);

}  // namespace dsw
