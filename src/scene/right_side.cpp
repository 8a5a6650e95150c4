#include "scene/right_side.h"

#include <algorithm>
#include <cmath>

#include "base/dimensions.h"
#include "base/disjoint_sets.h"
#include "locate/nearest.h"
#include "predicates/plane_hit.h"
#include "walk/standard_facets.h"

namespace dsw {
namespace {

constexpr int kDodges = 8;     // walls that a vertex is led along on its way
constexpr int kHalvings = 40;  // of a way that ends before a wall

}  // namespace

template <int D>
Vec normal_of(const Environment<D>& env, const CastResult& hit, const Vec& way, const double** corner) {
  const double* simplex[D];
  boundary_points(env, hit.cell, hit.simplex, simplex);
  double normal[D];
  unit_normal<D>(simplex, normal);
  *corner = simplex[0];
  const Vec n = to_vec<D>(normal);
  return dot(n, way) > 0 ? -n : n;
}

template <int D>
void RightSide<D>::choose(Cell side, double smallest) {
  side_ = side;
  smallest_ = smallest;
  if (side_.valid()) keep_to_side();
  keep_largest_parts();
  inside_ = kept_;
}

/** Keeps vertices in cells that passable facets join with the side. */
template <int D>
void RightSide<D>::keep_to_side() {
  FloodNotes notes(env_.memory);
  Array<Cell> cells(env_.memory);
  notes.see(side_);
  cells.push_back(side_);
  for (size_t i = 0; i < cells.size(); ++i) {
    for (uint32_t f = 0; f < env_.map.facets_of(cells[i]); ++f) {
      const HalfFacet h = env_.map.half_facet(cells[i], f);
      if (is_impassable(env_, h)) continue;
      const Cell beyond = env_.map.cell_of(env_.map.opposite(h));
      if (notes.see(beyond)) cells.push_back(beyond);
    }
  }
  for (uint32_t v = 0; v < inside_.size(); ++v) inside_[v] = inside_[v] && notes.is_seen(body_.vertices[v].cell);
}

/** Keeps the most vertices that free edges join, in each connected part of the body. */
template <int D>
void RightSide<D>::keep_largest_parts() {
  const auto count = static_cast<uint32_t>(body_.vertices.size());
  DisjointSets whole(count, env_.memory), free(count, env_.memory);
  for (uint32_t e = 0; e < body_.edges.size(); ++e) {
    if (!body_.has_edge(e)) continue;
    const uint32_t a = body_.edges[e].ends[0], b = body_.edges[e].ends[1];
    whole.join(a, b);
    if (!inside_[a] || !inside_[b]) continue;
    const CastResult way = cast(env_, body_.position(a), body_.position(b), body_.vertices[a].cell);
    if (way.end == CastEnd::kReached && way.cell == body_.vertices[b].cell) free.join(a, b);
  }
  Array<uint32_t> sizes(count, 0u, env_.memory), largest(count, kNone, env_.memory);
  for (uint32_t v = 0; v < count; ++v) sizes[free.root(v)] += inside_[v] ? 1 : 0;
  for (uint32_t v = 0; v < count; ++v) {
    uint32_t& best = largest[whole.root(v)];
    if (free.root(v) == v && inside_[v] && (best == kNone || sizes[v] > sizes[best])) best = v;
  }
  kept_.assign(count, false);
  all_have_kept_ = true;
  for (uint32_t v = 0; v < count; ++v) {
    kept_[v] = inside_[v] && free.root(v) == largest[whole.root(v)];
    all_have_kept_ = all_have_kept_ && (!body_.has_vertex(v) || largest[whole.root(v)] != kNone);
  }
}

template <int D>
bool RightSide<D>::place_all() {
  queue_.clear();
  for (uint32_t v = 0; v < kept_.size(); ++v) {
    if (kept_[v]) queue_.push_back(v);
  }
  if (queue_.empty() && !side_.valid()) return false;
  grow();
  for (uint32_t v = 0; v < inside_.size(); ++v) {
    if (inside_[v] || !body_.has_vertex(v)) continue;
    place_first(v);
    grow();
  }
  return true;
}

/** Places the first vertex of a part that has none on the right side: from the nearest vertex there, or from the cell. */
template <int D>
void RightSide<D>::place_first(uint32_t v) {
  uint32_t from = kNone;
  for (uint32_t w = 0; w < inside_.size(); ++w) {
    if (inside_[w] && (from == kNone || distance_squared<D>(body_.position(w), body_.position(v)) <
                                            distance_squared<D>(body_.position(from), body_.position(v)))) {
      from = w;
    }
  }
  if (from != kNone) return place(v, body_.position(from), body_.vertices[from].cell);
  double middle[D];
  centre(env_, side_, middle);
  place(v, middle, side_);
}

/** Places the neighbours of all in the queue, and theirs. */
template <int D>
void RightSide<D>::grow() {
  for (size_t i = 0; i < queue_.size(); ++i) {
    const uint32_t v = queue_[i];
    for_each_edge(body_, v, [&](uint32_t e) {
      const uint32_t w = body_.edges[e].other(v);
      if (!inside_[w]) place(w, body_.position(v), body_.vertices[v].cell);
      return true;
    });
  }
}

template <int D>
void RightSide<D>::place(uint32_t v, const double* from, Cell start) {
  const Place place = lead(from, start, to_vec<D>(body_.position(v)));
  put_vertex(body_, v, place.position, place.cell);
  inside_[v] = true;
  queue_.push_back(v);
}

/** A place near a target to which a straight way from a point is free. A target behind a wall is replaced by the point
 * before the wall that is nearest to it. */
template <int D>
typename RightSide<D>::Place RightSide<D>::lead(const double* from, Cell start, Vec target) const {
  Place place;
  std::copy_n(from, D, place.position);
  place.cell = start;
  for (int i = 0; i < kDodges; ++i) {
    if (!std::isfinite(largest(target))) return place;
    const CastResult way = cast(env_, from, target.data(), start);
    if (way.end == CastEnd::kReached) {
      store<D>(target, place.position);
      place.cell = way.cell;
      return place;
    }
    if (i + 1 == kDodges && get_before(from, start, target, way, place)) return place;
    const double* corner = nullptr;
    const Vec normal = normal_of(env_, way, target - to_vec<D>(from), &corner);
    const double height = dot(normal, target - to_vec<D>(corner));
    target += normal * (std::max(0.0, -height) * (1 + kPenetrationMargin) + std::ldexp(smallest_, i) +
                        body_.radius * (1 + kPenetrationMargin));
  }
  return place;
}

/** Gives a place on the way to a wall. */
template <int D>
bool RightSide<D>::get_before(const double* from, Cell start, const Vec& target, const CastResult& hit,
                              Place& place) const {
  double share = crossing_time(env_, hit.cell, hit.simplex, from, target.data());
  for (int i = 0; i < kHalvings; ++i) {
    share /= 2;
    point_at<D>(from, target.data(), share, place.position);
    const CastResult way = cast(env_, from, place.position, start);
    place.cell = way.cell;
    if (way.end == CastEnd::kReached) return true;
  }
  std::copy_n(from, D, place.position);
  place.cell = start;
  return false;
}

template <int D>
void RightSide<D>::shift(uint32_t v, const Vec& by) {
  const BodyVertex<D>& at = body_.vertices[v];
  const Place place = lead(at.position, at.cell, to_vec<D>(at.position) + by);
  put_vertex(body_, v, place.position, place.cell);
}

template Vec normal_of(const Environment<2>&, const CastResult&, const Vec&, const double**);
template Vec normal_of(const Environment<3>&, const CastResult&, const Vec&, const double**);
template class RightSide<2>;
template class RightSide<3>;

}  // namespace dsw
