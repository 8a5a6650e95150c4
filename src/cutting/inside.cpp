#include "cutting/inside.h"

#include "cutting/start.h"
#include "map/dart.h"
#include "motion/cast.h"

namespace dsw {
namespace {

BladeTree::Box box_of(const Environment<3>& env, Cell c) {
  BladeTree::Box box;
  for (uint32_t k = 0, n = env.map.vertices_of(c); k < n; ++k) box.add(env.point(c, k));
  return box;
}

/** Seeds a flood with the triangles that meet a cell; whether there are any. */
bool seed_all(Crossings& crossings, const BladeTree& tree, Cell c, const BladeTree::Box& box) {
  bool any = false;
  tree.for_each_in(box, [&](uint32_t triangle) { any = crossings.seed(c, triangle) || any; });
  return any;
}

}  // namespace

Inside::Inside(const Environment<3>& env, const Blade& blade, Crossings& crossings)
    : env_(env),
      map_(env.map),
      blade_(blade),
      crossings_(crossings),
      tree_(env.memory, blade),
      numbers_(env.memory),
      cells_(Allocator<Known>(env.memory)) {}

void Inside::flood_from(Cell start, uint32_t* visited) {
  if (flood(start)) return;
  const Cell first = find_start(env_, blade_, start, visited);
  if (first.valid()) flood(first);
}

/** Whether the cell is inside or crossed. */
bool Inside::flood(Cell start) {
  add(start);
  for (; done_ < cells_.size(); ++done_) {
    const Known known = cells_[done_];
    if (known.turns == 0 && !known.crossed) continue;
    for (uint32_t f = 0, facets = map_.facets_of(known.cell); f < facets; ++f) {
      look_beyond(known, map_.half_facet(known.cell, f));
    }
  }
  crossings_.run();
  const uint32_t number = numbers_.find(start.unit);
  return number != KeyTable::kNone && (cells_[number].turns != 0 || cells_[number].crossed);
}

void Inside::flood_all() {
  for_each_cell(map_, [&](Cell c) {
    if (box_of(env_, c).overlaps(tree_.box())) flood(c);
  });
}

void Inside::add(Cell c) {
  if (!admits(env_, c) || numbers_.insert(c.unit) != cells_.size()) return;
  double at[3];
  centre(env_, c, at);
  cells_.push_back({c, turns_round(at), seed(c)});
}

void Inside::look_beyond(const Known& known, HalfFacet h) {
  const HalfFacet o = map_.opposite(h);
  if (!o.valid()) return;
  const Cell c = known.cell, beyond = map_.cell_of(o);
  if (!admits(env_, beyond) || numbers_.insert(beyond.unit) != cells_.size()) return;
  double from[3], to[3];
  centre(env_, c, from);
  centre(env_, beyond, to);
  const double* const by = env_.point(dart_vertex(map_, {c, map_.shape(c).facet_first(map_.local_of(h, c))}));
  const bool crossed = seed(beyond);
  const bool is_way = has_centre_in(c, from) && has_centre_in(beyond, to);
  const int turns = is_way ? known.turns + crossings_in(c, from, by) + crossings_in(beyond, by, to) : turns_round(to);
  cells_.push_back({beyond, turns, crossed});
}

bool Inside::seed(Cell c) { return seed_all(crossings_, tree_, c, box_of(env_, c)); }

/** All of a cell can be seen from its centre, but the rounded one of a flat tetrahedron can lie beside it. */
bool Inside::has_centre_in(Cell c, const double* at) const {
  return map_.form(c) != Form::kSimplex || contains(env_, c, at);
}

bool Inside::holds(Cell c, const double* point) const {
  const uint32_t number = numbers_.find(c.unit);
  if (number == KeyTable::kNone) return turns_round(point) != 0;
  double from[3];
  centre(env_, c, from);
  if (!has_centre_in(c, from) || !contains(env_, c, point)) return turns_round(point) != 0;
  return cells_[number].turns + crossings_in(c, from, point) != 0;
}

void Inside::carve(Edit<3>& edit, Array<Cell>& carved) const {
  for (size_t i = 0; i < edit.cell_count(); ++i) {
    double at[3];
    centre(env_, edit.cell(i), at);
    if (!edit.draft(i).marked || !holds(edit.draft(i).from, at)) continue;
    edit.set_draft_mark(i, false);
    carved.push_back(edit.cell(i));
  }
  for (const Known& known : cells_) {
    if (known.turns == 0 || !map_.marked(known.cell) || edit.is_removed(known.cell)) continue;
    edit.set_mark(known.cell, false);
    carved.push_back(known.cell);
  }
}

/** What a triangle adds to the turns round a point that goes from one place to another. */
int Inside::crossings_of(uint32_t triangle, const double* from, const double* to) const {
  const SweptTriangle swept = blade_.swept(triangle);
  if ((swept.beyond_box(from) & swept.beyond_box(to)) != 0) return 0;
  const int side = swept.side(to);
  if (swept.side(from) == side || swept.outside(from, to, side) != 0) return 0;
  return side < 0 ? 1 : -1;
}

/** The same of all triangles, for a way that lies in a cell. */
int Inside::crossings_in(Cell c, const double* from, const double* to) const {
  int sum = 0;
  const uint32_t number = crossings_.number(c);
  if (number == KeyTable::kNone) return 0;
  crossings_.for_each_triangle(number, [&](uint32_t triangle) { sum += crossings_of(triangle, from, to); });
  return sum;
}

/** Along a ray from the surface's lower side, which the shift moves away from there. */
int Inside::turns_round(const double* point) const {
  const double from[3] = {tree_.box().lower[0], point[1], point[2]};
  if (point[0] <= from[0]) return 0;
  BladeTree::Box ray;
  ray.add(from);
  ray.add(point);
  int sum = 0;
  tree_.for_each_in(ray, [&](uint32_t triangle) { sum += crossings_of(triangle, from, point); });
  return sum;
}

void find_all(const Environment<3>& env, const Blade& blade, Crossings& crossings) {
  const BladeTree tree(env.memory, blade);
  for_each_cell(env.map, [&](Cell c) {
    if (admits(env, c)) seed_all(crossings, tree, c, box_of(env, c));
  });
  crossings.run();
}

bool closes(const Environment<3>& env, const Crossings& crossings) {
  bool crosses = false;
  for (uint32_t i = 0; i < crossings.cell_count(); ++i) {
    const MetCell& met = crossings.cell(i);
    if (is_closed(env, met.cell)) continue;
    if (met.holds_rim) return false;
    crosses = true;
  }
  return crosses;
}

}  // namespace dsw
