#include "proximity/sight.h"

#include <algorithm>

#include "base/dimensions.h"
#include "base/search.h"

namespace dsw {
namespace {

constexpr uint32_t kStays = UINT32_MAX;

/** Finds the facets through which a line leaves one cell after the other. */
template <int D>
class SightWalk {
 public:
  SightWalk(const Environment<D>& env, Sightline<D>& line, const uint32_t* target, uint32_t target_count) noexcept
      : env_(env), line_(line), target_(target), target_count_(target_count) {}

  /** The facet through which the line leaves a cell, or kStays. */
  uint32_t leave(Cell c) {
    const Shape shape = env_.map.shape(c);
    return env_.map.convex(c) ? leave_convex(c, shape) : leave_other(c, shape);
  }
  void enter(HalfFacet through) noexcept { through_ = through; }

 private:
  /** One plane for each facet. Of those that the end lies beyond, the line passes just one. So what doubles tell of the
   * planes is mostly enough, also where the end lies on some. */
  uint32_t leave_convex(Cell c, const Shape& shape) {
    bool is_open = false;
    uint32_t exit = choose(c, shape, [&](uint32_t f, const double* const* points) {
      const int side = line_.certain_end_side(points);
      is_open = is_open || (side == 0 && !is_at_target(c, shape, f));
      return side > 0;
    });
    if (is_open && (exit == kStays || !passes(c, shape, exit))) {
      exit = choose(c, shape, [&](uint32_t f, const double* const* points) {
        return !is_at_target(c, shape, f) && line_.ends_beyond(points);
      });
    }
    if (exit != kStays) simplex_points(env_, c, shape, shape.simplex_first(exit), passed_);
    return exit;
  }
  /** The facet that the line passes, if is_beyond(facet, points of its plane) is true for it; else any other with that
   * property. */
  template <class IsBeyond>
  uint32_t choose(Cell c, const Shape& shape, IsBeyond is_beyond) {
    uint32_t exit = kStays;
    for (uint32_t f = 0; f < shape.facet_count(); ++f) {
      const double* points[D];
      simplex_points(env_, c, shape, shape.simplex_first(f), points);
      if (env_.map.half_facet(c, f).word == through_.word || !is_beyond(f, points)) continue;
      if (exit != kStays && passes(c, shape, exit)) break;
      exit = f;
    }
    return exit;
  }

  bool passes(Cell c, const Shape& shape, uint32_t facet) {
    for (uint32_t s = shape.simplex_first(facet); s < shape.simplex_first(facet + 1); ++s) {
      const double* points[D];
      simplex_points(env_, c, shape, s, points);
      if (line_.pierces(points)) return true;
    }
    return false;
  }

  /** The first simplex that the line passes outwards after it has come in. */
  uint32_t leave_other(Cell c, const Shape& shape) {
    uint32_t exit = kStays;
    const double* first[D] = {};
    for (uint32_t f = 0; f < shape.facet_count(); ++f) {
      for (uint32_t s = shape.simplex_first(f); s < shape.simplex_first(f + 1); ++s) {
        const double* points[D];
        simplex_points(env_, c, shape, s, points);
        const int side = line_.certain_end_side(points);
        if (side < 0 || (side == 0 && has_target(c, shape.simplices() + size_t{s} * D, D))) continue;
        if (side == 0 && !line_.ends_beyond(points)) continue;
        if (line_.starts_beyond(points) || !line_.pierces(points)) continue;
        if (through_.valid() && !line_.passes_before(passed_, points)) continue;
        if (exit != kStays && !line_.passes_before(points, first)) continue;
        exit = f;
        std::copy_n(points, D, first);
      }
    }
    std::copy_n(first, D, passed_);
    return exit;
  }

  /** Whether local vertices of a cell are all of the target's, or more. */
  bool has_target(Cell c, const uint16_t* local, uint32_t count) const noexcept {
    if (target_count_ == 0) return false;
    return dsw::all_of(target_, target_ + target_count_, [&](uint32_t v) {
      return dsw::any_of(local, local + count, [&](uint16_t i) { return env_.map.vertex(c, i) == v; });
    });
  }
  bool is_at_target(Cell c, const Shape& shape, uint32_t facet) const noexcept {
    if constexpr (D == 2) return has_target(c, shape.simplices() + size_t{2} * facet, 2);
    return has_target(c, shape.dart_vertices() + shape.facet_first(facet), shape.facet_size(facet));
  }

  const Environment<D>& env_;
  Sightline<D>& line_;
  const uint32_t* target_;
  uint32_t target_count_;
  HalfFacet through_;             // the facet crossed last, seen from the cell entered
  const double* passed_[D] = {};  // its simplex, seen from the cell before
};

/** Where a cell has the vertices of an obstacle. */
template <int D>
class ObstacleInCell {
 public:
  ObstacleInCell(const Map<D>& map, Cell c, const Shape& shape, const uint32_t* vertices, uint32_t count) noexcept
      : shape_(shape), count_(count) {
    for (uint32_t i = 0; i < shape.vertex_count(); ++i) {
      const uint32_t* const at = dsw::find(vertices, vertices + count, map.vertex(c, i));
      if (at != vertices + count) local_[at - vertices] = i;
    }
  }
  /** Whether a triangle of the cell's surface, in the plane a side, has all of them. */
  bool is_on(uint32_t simplex) const noexcept {
    const uint16_t* const corners = shape_.simplices() + size_t{D} * simplex;
    uint32_t shared = 0;
    for (int i = 0; i < D; ++i) {
      for (uint32_t k = 0; k < count_; ++k) shared += corners[i] == local_[k];
    }
    return shared == count_;
  }
  /** Whether one has. A cell can have all vertices and another way between them. */
  bool is_there() const noexcept {
    for (uint32_t s = 0; s < shape_.simplex_count(); ++s) {
      if (is_on(s)) return true;
    }
    return false;
  }

 private:
  const Shape& shape_;
  uint32_t count_, local_[3] = {UINT32_MAX, UINT32_MAX, UINT32_MAX};
};

}  // namespace

template <int D>
SightResult walk_along(const Environment<D>& env, Sightline<D>& line, Cell start, const uint32_t* target,
                       uint32_t target_count) {
  SightWalk<D> walk(env, line, target, target_count);
  for (Cell c = start;;) {
    const uint32_t exit = walk.leave(c);
    if (exit == kStays) return {false, c};
    const HalfFacet h = env.map.half_facet(c, exit);
    if (is_impassable(env, h)) return {true, c};
    const HalfFacet beyond = env.map.opposite(h);
    walk.enter(beyond);
    c = env.map.cell_of(beyond);
  }
}

template <int D>
Cell find_cell_at_end(const Environment<D>& env, Sightline<D>& line, Cell end, const uint32_t* vertices, uint32_t count,
                      CellQueue& cells) {
  cells.clear();
  cells.insert(end);
  for (size_t i = 0; i < cells.size(); ++i) {
    const Cell c = cells[i];
    const Shape shape = env.map.shape(c);
    if (ObstacleInCell<D>(env.map, c, shape, vertices, count).is_there()) return c;
    for (uint32_t s = 0; s < shape.simplex_count(); ++s) {
      const double* points[D];
      simplex_points(env, c, shape, s, points);
      if (!line.ends_on(points)) continue;
      const HalfFacet h = env.map.half_facet(c, shape.simplex_facets(D)[s]);
      if (!is_impassable(env, h)) cells.insert(env.map.cell_of(env.map.opposite(h)));
    }
  }
  return {};
}

template <int D>
bool PassableFan<D>::reaches(Cell c) {
  for (; !cells_.contains(c); ++next_) {
    if (next_ == cells_.size()) return false;
    const Cell at = cells_[next_];
    const Shape shape = env_.map.shape(at);
    const ObstacleInCell<D> obstacle(env_.map, at, shape, vertices_, count_);
    for (uint32_t s = 0; s < shape.simplex_count(); ++s) {
      if (!obstacle.is_on(s)) continue;
      const HalfFacet h = env_.map.half_facet(at, shape.simplex_facets(D)[s]);
      if (!is_impassable(env_, h)) cells_.insert(env_.map.cell_of(env_.map.opposite(h)));
    }
  }
  return true;
}

DSW_INSTANTIATE(walk_along);
DSW_INSTANTIATE(find_cell_at_end);
template class PassableFan<2>;
template class PassableFan<3>;

}  // namespace dsw
