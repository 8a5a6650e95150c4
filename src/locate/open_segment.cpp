// A flood through all passable cells whose closure the open segment touches, from those into which it leads at its
// start. It goes on through passable facets that are touched. So if no impassable facet is touched, the cells entered
// cover the segment: they cover a closed part of it, and around each point of that part all cells have been entered. If
// some are touched, the first of them belongs to a cell that was entered.

#include "locate/open_segment.h"

#include <algorithm>
#include <new>

#include "locate/classify.h"
#include "locate/locate.h"
#include "predicates/filtered.h"
#include "predicates/touch.h"

namespace dsw {
namespace {

/** Whether a way from a point of a closed simplex with D + 1 corners begins in it. */
template <int D>
bool leads_into(const double* const* corners, const double* from, const double* to) noexcept {
  for (int i = 0; i <= D; ++i) {
    const double* side[D];
    for (int k = 0, n = 0; k <= D; ++k) {
      if (k != i) side[n++] = corners[k];
    }
    const int inside = orient<D>(side, corners[i]), at = orient<D>(side, from);
    if (at * inside < 0 || (at == 0 && orient<D>(side, to) * inside < 0)) return false;
  }
  return true;
}

/** Whether a way from a point on the boundary of a cell begins in the closed cell. */
template <int D>
bool leads_into(const Environment<D>& env, Cell c, const double* from, const double* to) noexcept {
  const Shape shape = env.map.shape(c);
  const double* corners[D + 1];
  if (shape.vertex_count() == D + 1) {
    for (uint32_t i = 0; i <= D; ++i) corners[i] = env.point(c, i);
    return leads_into<D>(corners, from, to);
  }
  double middle[D];
  centre(env, c, middle);
  corners[D] = middle;
  for (uint32_t s = 0; s < shape.simplex_count(); ++s) {
    simplex_points(env, c, shape, s, corners);
    if (leads_into<D>(corners, from, to)) return true;
  }
  return false;
}

template <int D>
bool is_lower(const Map<D>& map, HalfFacet a, HalfFacet b) noexcept {
  const HalfFacet first = canonical(map, a), second = canonical(map, b);
  const uint32_t i = map.index(map.cell_of(first)), k = map.index(map.cell_of(second));
  return i != k ? i < k : map.local_of(first, map.cell_of(first)) < map.local_of(second, map.cell_of(second));
}

}  // namespace

template <int D>
void OpenSegments<D>::enter(Cell c) {
  const uint32_t before = seen_.size();
  if (seen_.insert(c.unit) == before) cells_.push_back(c);
}

template <int D>
void OpenSegments<D>::look_at_start(Cell c) {
  if (is_closed(env_, c)) return;
  bool inside = false;
  if (classify(env_, from_, c, &inside).dimension == D) return;
  at_start_.push_back(c);
  if (leads_into(env_, c, from_, to_)) enter(c);
}

/** Enters the cells into which the segment leads; false: its start is not in or on passable space. */
template <int D>
bool OpenSegments<D>::find_first_cells(Cell start) {
  bool inside = false;
  if (start.valid() && classify(env_, from_, start, &inside).dimension == D) {
    if (is_closed(env_, start)) return false;
    enter(start);
    return true;
  }
  const auto look = [&](uint32_t index) {
    const Cell c = env_.map.cell(index);
    if (c.valid() && box_holds(env_, c, from_)) look_at_start(c);
  };
  // What visits cells of the tree can't throw.
  Array<uint32_t> near(env_.memory);
  bool is_full = false;
  const auto note = [&](uint32_t index) {
    try {
      near.push_back(index);
    } catch (const std::bad_alloc&) {
      is_full = true;
    }
  };
  if (env_.index.visit(env_, from_, note)) {
    if (is_full) throw std::bad_alloc();
    for (const uint32_t index : near) look(index);
  } else {
    for (uint32_t i = 0, count = env_.map.index_count(); i < count; ++i) look(i);
  }
  return !at_start_.empty();
}

template <int D>
void OpenSegments<D>::meet(HalfFacet h, uint32_t simplex, double time) {
  const bool is_first = result_.end != OpenEnd::kMet || time < result_.time;
  if (!is_first && (time > result_.time || !is_lower(env_.map, h, result_.facet))) return;
  result_.end = OpenEnd::kMet;
  result_.time = time;
  result_.facet = h;
  result_.simplex = simplex;
}

template <int D>
void OpenSegments<D>::look(Cell c) {
  const Shape shape = env_.map.shape(c);
  for (uint32_t f = 0; f < shape.facet_count(); ++f) {
    const HalfFacet h = env_.map.half_facet(c, f);
    const bool is_wall = is_impassable(env_, h);
    for (uint32_t s = shape.simplex_first(f); s < shape.simplex_first(f + 1); ++s) {
      const double* simplex[D];
      simplex_points(env_, c, shape, s, simplex);
      if (!inside_touches<D>(from_, to_, simplex, D)) continue;
      if (!is_wall) {
        enter(env_.map.cell_of(env_.map.opposite(h)));
        break;
      }
      meet(h, s, point_touch<D>(from_, to_, simplex, D).time);
    }
  }
}

/** The segment leaves passable space where it begins: it meets a wall on which its start lies, of those that it leaves
 * by if there are some. */
template <int D>
void OpenSegments<D>::stop_at_start() {
  bool leaves = false;
  for (const Cell c : at_start_) {
    const Shape shape = env_.map.shape(c);
    for (uint32_t f = 0; f < shape.facet_count(); ++f) {
      const HalfFacet h = env_.map.half_facet(c, f);
      if (!is_impassable(env_, h)) continue;
      for (uint32_t s = shape.simplex_first(f); s < shape.simplex_first(f + 1); ++s) {
        const double* simplex[D];
        simplex_points(env_, c, shape, s, simplex);
        if (point_touch<D>(from_, from_, simplex, D).time != 0) continue;
        const bool is_left = orient<D>(simplex, to_) > 0;
        if (is_left && !leaves) result_ = {};
        if (is_left || !leaves) meet(h, s, 0);
        leaves = leaves || is_left;
      }
    }
  }
}

template <int D>
OpenSegmentResult OpenSegments<D>::ask(const double* from, const double* to, Cell start, uint32_t max_volumes) {
  from_ = from;
  to_ = to;
  result_ = {};
  seen_.clear();
  cells_.clear();
  at_start_.clear();
  if (!find_first_cells(start)) {
    result_.end = start.valid() ? OpenEnd::kImpassable : OpenEnd::kOutside;
    return result_;
  }
  if (std::equal(from, from + D, to)) return result_;
  if (cells_.empty()) stop_at_start();
  for (size_t i = 0; i < cells_.size(); ++i) {
    if (max_volumes != 0 && i == max_volumes) {
      result_ = {};
      result_.end = OpenEnd::kWorkLimit;
      break;
    }
    look(cells_[i]);
  }
  result_.volumes_visited = static_cast<uint32_t>(cells_.size());
  return result_;
}

template class OpenSegments<2>;
template class OpenSegments<3>;

}  // namespace dsw
