#include "split/facet_cuts.h"

#include <cmath>

#include "base/search.h"
#include "predicates/turn.h"
#include "split/ears.h"

namespace dsw {
namespace {

Array<uint32_t> loop_of(const Environment<3>& env, HalfFacet h) {
  const Cell c = env.map.cell_of(h);
  const Shape shape = env.map.shape(c);
  Array<uint32_t> loop(env.memory);
  for_each_facet_vertex<3>(shape, env.map.local_of(h, c),
                           [&](uint32_t local) { loop.push_back(env.map.vertex(c, local)); });
  return loop;
}

template <class Visit>
void for_each_own_triangle(const Environment<3>& env, HalfFacet h, const Visit& visit) {
  const Cell c = env.map.cell_of(h);
  const Shape shape = env.map.shape(c);
  const uint32_t f = env.map.local_of(h, c);
  for (uint32_t s = shape.simplex_first(f); s < shape.simplex_first(f + 1); ++s) {
    const uint16_t* const local = shape.simplices() + 3 * s;
    visit(env.map.vertex(c, local[0]), env.map.vertex(c, local[1]), env.map.vertex(c, local[2]));
  }
}

/** Turns of corners, seen along an axis; positive as the loop turns. */
class View {
 public:
  View(const Environment<3>& env, int axis, double area) : env_(env), axis_(axis), sense_(area < 0 ? -1 : 1) {}
  int operator()(uint32_t a, uint32_t b, uint32_t c) const {
    return turn_sign<3>(env_.point(a), env_.point(b), env_.point(c), axis_) * sense_;
  }
  bool are_alike(const PartHull<3>& triangles) const {
    return dsw::all_of(triangles.begin(), triangles.end(),
                       [this](const PartSide<3>& t) { return (*this)(t.v[0], t.v[1], t.v[2]) > 0; });
  }

 private:
  const Environment<3>& env_;
  int axis_, sense_;
};

/** The area of a loop along each axis, in units of its largest extent. */
void find_areas(const Environment<3>& env, const Array<uint32_t>& loop, double (&area)[3]) {
  const double* const origin = env.point(loop[0]);
  double scale = 0;
  for (const uint32_t v : loop) {
    for (int k = 0; k < 3; ++k) scale = std::max(scale, std::fabs(env.point(v)[k] / 2 - origin[k] / 2));
  }
  for (double& along : area) along = 0;
  for (size_t n = 0; n < loop.size() && scale > 0; ++n) {
    const double *const p = env.point(loop[n]), *const q = env.point(loop[n + 1 == loop.size() ? 0 : n + 1]);
    double a[3], b[3];
    for (int k = 0; k < 3; ++k) {
      a[k] = (p[k] / 2 - origin[k] / 2) / scale;
      b[k] = (q[k] / 2 - origin[k] / 2) / scale;
    }
    for (int k = 0; k < 3; ++k) area[k] += a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
  }
}

/** Three views of a loop, that along which it is largest first. */
struct Views {
  View at[3];

  static Views of(const Environment<3>& env, const Array<uint32_t>& loop) {
    double area[3];
    find_areas(env, loop, area);
    int axes[3] = {0, 1, 2};
    std::stable_sort(axes, axes + 3, [&](int i, int j) { return std::fabs(area[i]) > std::fabs(area[j]); });
    return {{View(env, axes[0], area[axes[0]]), View(env, axes[1], area[axes[1]]), View(env, axes[2], area[axes[2]])}};
  }
};

}  // namespace

FacetCuts::FacetCuts(const Environment<3>& env, const Array<Cell>& cells)
    : env_(env),
      cells_(cells),
      numbers_(env.memory),
      first_(env.memory),
      triangles_(env.memory),
      is_sound_(env.memory),
      is_broken_(env.memory),
      is_kept_(env.memory) {
  for (const Cell c : cells) {
    for (uint32_t f = 0; f < env.map.facets_of(c); ++f) add(canonical(env.map, env.map.half_facet(c, f)));
  }
  first_.push_back(static_cast<uint32_t>(triangles_.size()));
  is_broken_.assign(numbers_.size(), 0);
  is_kept_.assign(numbers_.size(), 0);
}

/** Whether there is a cell on this side, and it is split. */
bool FacetCuts::is_split(HalfFacet side) const {
  return std::binary_search(cells_.begin(), cells_.end(), env_.map.cell_of(side),
                            [](Cell a, Cell b) { return a.unit < b.unit; });
}

void FacetCuts::add(HalfFacet h) {
  if (numbers_.insert(h.word) != first_.size()) return;
  first_.push_back(static_cast<uint32_t>(triangles_.size()));
  PartHull<3> triangles(env_.memory);
  is_sound_.push_back(cut(h, loop_of(env_, h), triangles) ? 1 : 0);
  triangles_.insert(triangles_.end(), triangles.begin(), triangles.end());
}

/** False: no way was found, and these are its own triangles. */
bool FacetCuts::cut(HalfFacet h, const Array<uint32_t>& loop, PartHull<3>& out) const {
  for_each_own_triangle(env_, h, [&](uint32_t a, uint32_t b, uint32_t c) { out.push_back(make_simplex(a, b, c)); });
  const HalfFacet other = env_.map.opposite(h);
  if (loop.size() == 3 || !is_split(h) || (other.valid() && !is_split(other))) return true;
  for (const View& turn : Views::of(env_, loop).at) {
    if (turn.are_alike(out)) return true;
    Array<uint32_t> ears(env_.memory);
    if (!clip_ears(loop, turn, ears)) continue;
    out.clear();
    for (size_t k = 0; k < ears.size(); k += 3) out.push_back(make_simplex(ears[k], ears[k + 1], ears[k + 2]));
    return true;
  }
  return false;
}

/** Whether triangles of a facet are turned alike, and positive seen from the centre of a cell that stays. */
bool FacetCuts::is_good(HalfFacet h, const Array<uint32_t>& loop, const PartHull<3>& triangles) const {
  const Views views = Views::of(env_, loop);
  if (!dsw::any_of(views.at, views.at + 3, [&](const View& turn) { return turn.are_alike(triangles); })) return false;
  const HalfFacet other = env_.map.opposite(h);
  for (const HalfFacet side : {h, other}) {
    if (!side.valid() || is_split(side)) continue;
    double apex[3];
    centre(env_, env_.map.cell_of(side), apex);
    const int inside = side == h ? -1 : 1;
    for (const PartSide<3>& t : triangles) {
      const double* const points[3] = {env_.point(t.v[0]), env_.point(t.v[1]), env_.point(t.v[2])};
      if (orient<3>(points, apex) != inside) return false;
    }
  }
  return true;
}

void FacetCuts::vary(Cell c, uint32_t attempt) {
  for (uint32_t f = 0; f < env_.map.facets_of(c); ++f) {
    const HalfFacet h = canonical(env_.map, env_.map.half_facet(c, f));
    const uint32_t i = numbers_.find(h.word);
    const Array<uint32_t> loop = loop_of(env_, h);
    if (is_kept_[i] != 0 || loop.size() == 3) continue;
    uint32_t bits = (attempt * 0x9e3779b1u + f) * 0x85ebca77u;
    bits = (bits ^ bits >> 15) * 0x2c1b3c6du;
    const auto n = static_cast<uint32_t>(loop.size()), from = (bits ^ bits >> 13) % n;
    PartHull<3> fan(env_.memory);
    for (uint32_t k = 1; k + 1 < n; ++k) {
      fan.push_back(make_simplex(loop[from], loop[(from + k) % n], loop[(from + k + 1) % n]));
    }
    if (is_good(h, loop, fan)) std::copy(fan.begin(), fan.end(), triangles_.begin() + first_[i]);
  }
}

void FacetCuts::keep(Cell c) {
  for (uint32_t f = 0; f < env_.map.facets_of(c); ++f) is_kept_[find(env_.map.half_facet(c, f))] = 1;
}

}  // namespace dsw
