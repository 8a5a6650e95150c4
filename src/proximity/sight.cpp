#include "proximity/sight.h"

#include <algorithm>

#include "base/dimensions.h"
#include "base/search.h"
#include "walk/cast.h"
#include "walk/standard_facets.h"

namespace dsw {
namespace {

constexpr uint32_t kStays = UINT32_MAX;

/** What a Shape says of a tetrahedron. */
struct TetrahedronFacets {
  uint32_t facet_count() const noexcept { return 4; }
  uint32_t simplex_first(uint32_t facet) const noexcept { return facet; }
};

/** Finds the facets through which a line leaves one cell after the other. */
template <int D>
class SightWalk {
 public:
  SightWalk(const Environment<D>& env, Sightline<D>& line, const uint32_t* target, uint32_t target_count) noexcept
      : env_(env), line_(line), target_(target), target_count_(target_count) {}

  /** The facet through which the line leaves a cell, or kStays. */
  uint32_t leave(Cell c) {
    if (target_count_ != 0 && is_simplex_at(env_.map, c, target_, target_count_)) return kStays;
    if (D == 3 && env_.map.form(c) == Form::kSimplex) return leave_convex(c, TetrahedronFacets());
    const Shape shape = env_.map.shape(c);
    return env_.map.convex(c) ? leave_convex(c, shape) : leave_other(c, shape);
  }
  void enter(HalfFacet through) noexcept { through_ = through; }

 private:
  /** One plane for each facet. Of those that the end lies beyond, the line passes just one. So what doubles tell of the
   * planes is mostly enough, also where the end lies on some. */
  template <class Facets>
  uint32_t leave_convex(Cell c, const Facets& shape) {
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
    if (exit != kStays) points_of(c, shape, shape.simplex_first(exit), passed_);
    return exit;
  }
  /** The facet that the line passes, if is_beyond(facet, points of its plane) is true for it; else any other with that
   * property. */
  template <class Facets, class IsBeyond>
  uint32_t choose(Cell c, const Facets& shape, IsBeyond is_beyond) {
    uint32_t exit = kStays;
    for (uint32_t f = 0; f < shape.facet_count(); ++f) {
      if (env_.map.half_facet(c, f).word == through_.word) continue;
      const double* points[D];
      points_of(c, shape, shape.simplex_first(f), points);
      if (!is_beyond(f, points)) continue;
      if (exit != kStays && passes(c, shape, exit)) break;
      exit = f;
    }
    return exit;
  }

  void points_of(Cell c, const Shape& shape, uint32_t simplex, const double** out) const noexcept {
    simplex_points(env_, c, shape, simplex, out);
  }
  void points_of(Cell c, const TetrahedronFacets&, uint32_t simplex, const double** out) const noexcept {
    const uint32_t* const w = env_.map.record(c);
    for (int i = 0; i < D; ++i) out[i] = env_.point(w[kTetrahedronFacets[simplex][i]] & kVertexMask);
  }
  template <class Facets>
  bool passes(Cell c, const Facets& shape, uint32_t facet) {
    for (uint32_t s = shape.simplex_first(facet); s < shape.simplex_first(facet + 1); ++s) {
      const double* points[D];
      points_of(c, shape, s, points);
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
  // A tetrahedron with a facet at the target is not left.
  bool is_at_target(Cell, const TetrahedronFacets&, uint32_t) const noexcept { return false; }
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

// A simplex is convex, and its facets that do not have all the vertices keep away from the end.
template <int D>
bool is_simplex_at(const Map<D>& map, Cell c, const uint32_t* vertices, uint32_t count) noexcept {
  const uint32_t* const w = map.record(c);
  if (form_of(w[0]) != Form::kSimplex) return false;
  for (uint32_t i = 0; i < count; ++i) {
    bool is_one = false;
    for (int k = 0; k <= D; ++k) is_one |= (w[k] & kVertexMask) == vertices[i];
    if (!is_one) return false;
  }
  return true;
}

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
void EdgeWalk<D>::add(Cell from, uint32_t simplex, const SightResult& beyond) noexcept {
  is_known_ = is_known_ && count_ < kMostSteps && env_.map.convex(from);
  if (!is_known_) return;
  boundary_points(env_, from, simplex, steps_[count_].simplex);
  steps_[count_++].beyond = beyond;
}

template <int D>
void EdgeWalk<D>::begin(const double* const* ends, Cell start, Cell last) noexcept {
  start_ = start;
  count_ = 0;
  is_known_ = true;
  CastRequest request;
  request.from = ends[0];
  request.to = ends[1];
  request.start = start;
  request.end = last;
  request.crossing_user = this;
  request.crossing = [](void* walk, Cell from, uint32_t simplex, Cell to) {
    static_cast<EdgeWalk*>(walk)->add(from, simplex, {false, to});
  };
  const CastResult there = cast(env_, request, nullptr);
  if (there.end == CastEnd::kHit) add(there.cell, there.simplex, {true, there.cell});
  is_known_ = is_known_ && env_.map.convex(there.cell);
}

template <int D>
SightResult EdgeWalk<D>::to(Sightline<D>& line) {
  if (!is_known_) return walk_along(env_, line, start_, nullptr, 0);
  SightResult at{false, start_};
  for (uint32_t i = 0; i < count_ && line.ends_beyond(steps_[i].simplex); ++i) at = steps_[i].beyond;
  return at;
}

template <int D>
Cell find_cell_at_end(const Environment<D>& env, Sightline<D>& line, Cell end, const uint32_t* vertices, uint32_t count,
                      CellQueue& cells) {
  if (is_simplex_at(env.map, end, vertices, count)) return end;
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
void PassableFan<D>::follow(HalfFacet h) {
  if (!is_impassable(env_, h)) cells_.insert(env_.map.cell_of(env_.map.opposite(h)));
}

/** A facet has the vertices if the corner that it lacks is none of them. */
template <int D>
void PassableFan<D>::follow_tetrahedron(Cell c) {
  const uint32_t* const w = env_.map.record(c);
  for (uint32_t f = 0; f < 4; ++f) {
    const uint32_t tip = w[kTetrahedronTips[f]] & kVertexMask;
    if (dsw::find(vertices_, vertices_ + count_, tip) == vertices_ + count_) follow(env_.map.half_facet(c, f));
  }
}

/** Goes round an edge from the first cell, as far as there are tetrahedra: one way to a wall, then the other way. */
template <int D>
typename PassableFan<D>::Reach PassableFan<D>::go_round(Cell c) const noexcept {
  const Map<D>& map = env_.map;
  const uint32_t* const w = map.record(first());
  // A facet has the edge if the corner that it lacks is not on the edge.
  for (uint32_t f = 0; f < 4; ++f) {
    uint32_t tip = w[kTetrahedronTips[f]] & kVertexMask;
    if (tip == vertices_[0] || tip == vertices_[1]) continue;
    HalfFacet left = map.half_facet(first(), f);
    while (!is_impassable(env_, left)) {
      const HalfFacet entered = map.opposite(left);
      const Cell next = map.cell_of(entered);
      if (next == c) return Reach::kYes;
      if (next == first()) return Reach::kNo;
      if (map.form(next) != Form::kSimplex) return Reach::kUnknown;
      // The other facet with the edge lacks what the facet that was entered has beside the edge.
      const uint32_t* const record = map.record(next);
      const uint32_t in = entered.word % kUnitWords<D> - (kUnitWords<D> - 4);
      uint32_t out = 0;
      for (; out < 4; ++out) {
        tip = record[kTetrahedronTips[out]] & kVertexMask;
        if (out != in && tip != vertices_[0] && tip != vertices_[1]) break;
      }
      left = map.half_facet(next, out);
    }
  }
  return Reach::kNo;
}

template <int D>
bool PassableFan<D>::reaches(Cell c) {
  if (c == first()) return true;
  if (D == 3 && count_ == 2 && env_.map.form(first()) == Form::kSimplex) {
    const Reach reach = go_round(c);
    if (reach != Reach::kUnknown) return reach == Reach::kYes;
  }
  for (; !cells_.contains(c); ++next_) {
    if (next_ == cells_.size()) return false;
    const Cell at = cells_[next_];
    if (D == 3 && env_.map.form(at) == Form::kSimplex) {
      follow_tetrahedron(at);
      continue;
    }
    const Shape shape = env_.map.shape(at);
    const ObstacleInCell<D> obstacle(env_.map, at, shape, vertices_, count_);
    for (uint32_t s = 0; s < shape.simplex_count(); ++s) {
      if (obstacle.is_on(s)) follow(env_.map.half_facet(at, shape.simplex_facets(D)[s]));
    }
  }
  return true;
}

DSW_INSTANTIATE(is_simplex_at);
DSW_INSTANTIATE(walk_along);
DSW_INSTANTIATE(find_cell_at_end);
template class EdgeWalk<2>;
template class EdgeWalk<3>;
template class PassableFan<2>;
template class PassableFan<3>;

}  // namespace dsw
