#include "cutting/inside.h"

#include "base/dimensions.h"
#include "base/sort.h"
#include "cutting/start.h"
#include "map/dart.h"
#include "walk/cast.h"

namespace dsw {
namespace {

/** Seeds a flood with the simplices that meet a cell; whether there are any. */
template <int D>
bool seed_all(const Environment<D>& env, Crossings<D>& crossings, const BladeTree<D>& tree, Cell c) {
  bool any = false;
  tree.for_each_in({env, c}, [&](uint32_t simplex) { any = crossings.seed(c, simplex) || any; });
  return any;
}

}  // namespace

template <int D>
Inside<D>::Inside(const Environment<D>& env, const Blade<D>& blade, bool briefly, Crossings<D>& crossings)
    : env_(env), map_(env.map), blade_(blade), briefly_(briefly), crossings_(crossings), tree_(env.memory, blade) {}

template <int D>
void Inside<D>::flood_from(Cell start, uint32_t* visited) {
  if (flood(start)) return;
  const Cell first = find_start(env_, blade_, tree_, start, visited);
  if (first.valid()) flood(first);
}

/** Whether the cell is inside or crossed. */
template <int D>
bool Inside<D>::flood(Cell start) {
  add(start);
  for (; done_ < cells_.size(); ++done_) {
    const Known known = cells_[done_];
    if (known.turns == 0 && !known.crossed) continue;
    for (uint32_t f = 0, facets = map_.facets_of(known.cell); f < facets; ++f) {
      look_beyond(known, map_.half_facet(known.cell, f));
    }
  }
  if (!briefly_) crossings_.run();
  const uint32_t number = numbers_.find(start.unit);
  return number != KeyTable::kNone && (cells_[number].turns != 0 || cells_[number].crossed);
}

template <int D>
void Inside<D>::flood_all() {
  Array<uint32_t> near{env_.memory};  // indices of cells that overlap the box of all, and of some others
  const typename BladeTree<D>::Box& box = tree_.box();
  const auto note = [&](uint32_t index) {
    const Cell c = map_.cell(index);
    const bool counts = c.valid() && (!briefly_ || map_.marked(c));
    if (counts && typename BladeTree<D>::Box(env_, c).overlaps(box)) near.push_back(index);
    return true;
  };
  if (!env_.index.ask(
          env_, [&](const CellTree<D>& cells) { cells.visit_box(box.lower, box.upper, note); }, note)) {
    for (uint32_t i = 0; i < map_.index_count(); ++i) note(i);
  }
  dsw::sort(near.begin(), near.end());
  for (const uint32_t index : near) {
    if (briefly_) {
      add(map_.cell(index));
    } else {
      flood(map_.cell(index));
    }
  }
}

template <int D>
void Inside<D>::add(Cell c) {
  if (!admits(env_, c) || numbers_.insert(c.unit) != cells_.size()) return;
  double at[D];
  centre(env_, c, at);
  cells_.push_back({c, turns_round(at), seed(c)});
}

template <int D>
void Inside<D>::look_beyond(const Known& known, HalfFacet h) {
  const HalfFacet o = map_.opposite(h);
  if (!o.valid()) return;
  const Cell c = known.cell, beyond = map_.cell_of(o);
  if (!admits(env_, beyond) || numbers_.insert(beyond.unit) != cells_.size()) return;
  double from[D], to[D];
  centre(env_, c, from);
  centre(env_, beyond, to);
  const double* const by = env_.point(dart_vertex(map_, {c, map_.shape(c).facet_first(map_.local_of(h, c))}));
  const bool crossed = seed(beyond);
  const bool is_way = has_centre_in(c, from) && has_centre_in(beyond, to);
  const int turns = is_way ? known.turns + crossings_in(c, from, by) + crossings_in(beyond, by, to) : turns_round(to);
  cells_.push_back({beyond, turns, crossed});
}

template <int D>
bool Inside<D>::seed(Cell c) {
  return seed_all(env_, crossings_, tree_, c);
}

/** Whether the surface meets a cell, which need not be linked yet. */
template <int D>
bool Inside<D>::is_met(Cell c) const {
  bool any = false;
  tree_.for_each_in({env_, c}, [&](uint32_t simplex) { any = any || crossings_.is_met(c, simplex); });
  return any;
}

/** All of a cell can be seen from its centre, but the rounded one of a flat tetrahedron can lie beside it. */
template <int D>
bool Inside<D>::has_centre_in(Cell c, const double* at) const {
  return map_.form(c) != Form::kSimplex || contains(env_, c, at);
}

template <int D>
bool Inside<D>::holds(Cell c, const double* point) const {
  const uint32_t number = numbers_.find(c.unit);
  if (number == KeyTable::kNone) return turns_round(point) != 0;
  double from[D];
  centre(env_, c, from);
  if (!has_centre_in(c, from) || !contains(env_, c, point)) return turns_round(point) != 0;
  return cells_[number].turns + crossings_in(c, from, point) != 0;
}

template <int D>
void Inside<D>::carve(Edit<D>& edit, bool covers, Array<Cell>& carved) const {
  for (size_t i = 0; i < edit.cell_count(); ++i) {
    double at[D];
    centre(env_, edit.cell(i), at);
    if (!edit.draft(i).marked) continue;
    if (!holds(edit.draft(i).from, at) && !(covers && is_met(edit.cell(i)))) continue;
    edit.set_draft_mark(i, false);
    carved.push_back(edit.cell(i));
  }
  for (const Known& known : cells_) {
    if (known.turns == 0 && !(covers && known.crossed)) continue;
    if (!map_.marked(known.cell) || edit.is_removed(known.cell)) continue;
    edit.set_mark(known.cell, false);
    carved.push_back(known.cell);
  }
}

/** What a simplex adds to the turns round a point that goes from one place to another. */
template <int D>
int Inside<D>::crossings_of(uint32_t simplex, const double* from, const double* to) const {
  const BladeSimplex<D> blade = blade_.simplex(simplex);
  if ((blade.beyond_box(from) & blade.beyond_box(to)) != 0) return 0;
  const int side = blade.side(to);
  if (blade.side(from) == side || !blade.is_passed(from, to, side)) return 0;
  return side < 0 ? 1 : -1;
}

/** Sums what all simplices in a cell add to the turns round a point whose way lies in that cell. */
template <int D>
int Inside<D>::crossings_in(Cell c, const double* from, const double* to) const {
  int sum = 0;
  const uint32_t number = crossings_.number(c);
  if (number == KeyTable::kNone) return 0;
  crossings_.for_each_simplex(number, [&](uint32_t simplex) { sum += crossings_of(simplex, from, to); });
  return sum;
}

/** Along a ray from the surface's lower side, which the shift moves away from there. */
template <int D>
int Inside<D>::turns_round(const double* point) const {
  double from[D];
  std::copy_n(point, D, from);
  from[0] = tree_.box().lower[0];
  if (point[0] <= from[0]) return 0;
  typename BladeTree<D>::Box ray;
  ray.add(from);
  ray.add(point);
  int sum = 0;
  tree_.for_each_in(ray, [&](uint32_t simplex) { sum += crossings_of(simplex, from, point); });
  return sum;
}

template <int D>
void find_all(const Environment<D>& env, const BladeTree<D>& tree, Crossings<D>& crossings) {
  KeyTable near(env.memory);
  for_each_near(env, tree, [&](Cell c, uint32_t) {
    near.insert(env.map.index(c));
    return true;
  });
  Array<uint32_t> indices{env.memory};
  for (uint32_t i = 0; i < near.size(); ++i) indices.push_back(static_cast<uint32_t>(near[i]));
  dsw::sort(indices.begin(), indices.end());
  for (const uint32_t index : indices) seed_all(env, crossings, tree, env.map.cell(index));
  crossings.run();
}

template <int D>
bool closes(const Environment<D>& env, const Crossings<D>& crossings) {
  bool crosses = false;
  for (uint32_t i = 0; i < crossings.cell_count(); ++i) {
    const MetCell& met = crossings.cell(i);
    if (is_closed(env, met.cell)) continue;
    if (met.holds_rim) return false;
    crosses = true;
  }
  return crosses;
}

template class Inside<2>;
template class Inside<3>;
DSW_INSTANTIATE(find_all);
DSW_INSTANTIATE(closes);

}  // namespace dsw
