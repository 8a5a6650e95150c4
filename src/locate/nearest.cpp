#include "locate/nearest.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/vec.h"
#include "environment/marking.h"
#include "map/dart.h"

namespace dsw {
namespace {

/** Nearest point of segment ab to the origin. */
Vec nearest_on(const Vec& a, const Vec& b) {
  const Vec d = b - a;
  const double length = dot(d, d), t = -dot(a, d);
  if (!(t > 0)) return a;
  return t >= length ? b : Vec(a + t / length * d);
}

/** `v` without its part along `d`. Done twice, because the first time leaves a rounding error of the size of v. */
Vec without(const Vec& v, const Vec& d, double length) {
  const Vec once = v - dot(v, d) / length * d;
  return once - dot(once, d) / length * d;
}

/** Nearest point of triangle abc to the origin, ab its longest edge. In coordinates x along ab and y along the height
 * over it the foot of the origin is found to a rounding error over the height, where barycentric coordinates lose it
 * twice. */
Vec nearest_over_longest(const Vec& a, const Vec& b, const Vec& c) {
  const Vec ab = b - a, ac = c - a;
  const double length = dot(ab, ab);
  const Vec height = without(ac, ab, length);
  const double square = dot(height, height);
  if (length > 0 && square > 0) {
    const double apex = dot(ac, ab) / length, y = -dot(a, height) / square, x = -dot(a, ab) / length;
    if (y > 0 && y < 1 && x > apex * y && x < apex * y + (1 - y)) return a + x * ab + y * height;
  }
  Vec best = nearest_on(a, b);
  for (const Vec& other : {nearest_on(b, c), nearest_on(c, a)}) {
    if (dot(other, other) < dot(best, best)) best = other;
  }
  return best;
}

Vec nearest_on(const Vec& a, const Vec& b, const Vec& c) {
  const Vec ab = b - a, bc = c - b, ca = a - c;
  const double lab = dot(ab, ab), lbc = dot(bc, bc), lca = dot(ca, ca);
  if (lab >= lbc && lab >= lca) return nearest_over_longest(a, b, c);
  return lbc >= lca ? nearest_over_longest(b, c, a) : nearest_over_longest(c, a, b);
}

/** A cell to visit, and how near it may hold something. */
struct Visit {
  double distance;
  uint32_t index;  // of the cell: the order of ties must not depend on where records lie
  bool operator<(const Visit& o) const { return distance != o.distance ? distance > o.distance : index > o.index; }
};

template <int D>
class Flood {
 public:
  Flood(const Environment<D>& env, const double* point, double radius, NearestResult& result)
      : env_(env),
        map_(env.map),
        point_(point),
        result_(result),
        heap_(Allocator<Visit>(env.memory)),
        seen_(64, kNoCell, Allocator<uint32_t>(env.memory)) {
    // One power of two brings all coordinates to where squares neither over- nor underflow.
    double largest = 0;
    for (int k = 0; k < D; ++k) {
      largest = std::max({largest, std::fabs(env.lower[k]), std::fabs(env.upper[k]), std::fabs(point[k])});
    }
    int exponent = 0;
    std::frexp(largest, &exponent);
    scale_ = exponent > 300 || exponent < -300 ? std::ldexp(1.0, std::clamp(-exponent, -1000, 1000)) : 1;
    best_ = radius * scale_;
  }

  bool run(Cell start) {
    heap_.push_back({0, map_.index(start)});
    while (!heap_.empty() && heap_.front().distance <= best_) {
      std::pop_heap(heap_.begin(), heap_.end());
      const Cell c = map_.cell(heap_.back().index);
      heap_.pop_back();
      if (!see(c)) continue;
      ++result_.volumes_visited;
      visit(c);
    }
    if (found_) finish();
    return found_;
  }

 private:
  Vec relative(Cell c, uint32_t local) const {
    const double* v = env_.point(c, local);
    Vec at{v[0] * scale_ - point_[0] * scale_, v[1] * scale_ - point_[1] * scale_, 0};
    if constexpr (D == 3) at.z() = v[2] * scale_ - point_[2] * scale_;
    return at;
  }

  void visit(Cell c) {
    const Shape shape = map_.shape(c);
    for (uint32_t f = 0; f < shape.facet_count(); ++f) {
      const HalfFacet h = map_.half_facet(c, f);
      const bool impassable = is_impassable(env_, h);
      if (!impassable && is_seen(map_.cell_of(map_.opposite(h)))) continue;
      const Vec at = nearest_of_facet(c, shape, f);
      const double distance = std::sqrt(dot(at, at));
      if (!(distance <= best_)) continue;
      if (impassable) {
        const HalfFacet first = canonical(map_, h);
        const Cell owner = map_.cell_of(first);
        offer(distance, at, {D - 1, owner, map_.local_of(first, owner)});
      } else {
        // A cell can stand in the heap once for each of its facets: a nearer way in must not be lost to a farther one.
        heap_.push_back({distance, map_.index(map_.cell_of(map_.opposite(h)))});
        std::push_heap(heap_.begin(), heap_.end());
      }
    }
    if constexpr (D == 3) {
      if (env_.marked_edges != 0) visit_marked_edges(c, shape);
    }
    if (env_.marked_vertices != 0) visit_vertices(c, shape);
  }

  Vec nearest_of_facet(Cell c, const Shape& shape, uint32_t f) const {
    Vec best{};
    for (uint32_t s = shape.simplex_first(f); s < shape.simplex_first(f + 1); ++s) {
      const Vec at = nearest_of_simplex(c, shape.simplices() + static_cast<uint32_t>(D) * s);
      if (s == shape.simplex_first(f) || dot(at, at) < dot(best, best)) best = at;
    }
    return best;
  }

  Vec nearest_of_simplex(Cell c, const uint16_t* local) const {
    if constexpr (D == 2) {
      return nearest_on(relative(c, local[0]), relative(c, local[1]));
    } else {
      return nearest_on(relative(c, local[0]), relative(c, local[1]), relative(c, local[2]));
    }
  }

  void visit_marked_edges(Cell c, const Shape& shape) {
    for (uint32_t d = 0; d < shape.dart_count(); ++d) {
      const uint32_t from = shape.dart_vertex(d), to = shape.dart_vertex(shape.beta1(d));
      if (shape.dart_beta2(d) < d || !edge_marked(env_, map_.vertex(c, from), map_.vertex(c, to))) continue;
      const Vec at = nearest_on(relative(c, from), relative(c, to));
      Dart lowest{c, d};
      for_each_volume_round_edge(map_, {c, d}, [&](Dart e) {
        if (map_.index(e.cell) < map_.index(lowest.cell)) lowest = e;
        return true;
      });
      offer(std::sqrt(dot(at, at)), at, {1, lowest.cell, map_.shape(lowest.cell).dart_edge(lowest.local)});
    }
  }

  void visit_vertices(Cell c, const Shape& shape) {
    for (uint32_t i = 0; i < shape.vertex_count(); ++i) {
      if (!vertex_marked(env_, map_.vertex(c, i))) continue;
      const Vec at = relative(c, i);
      offer(std::sqrt(dot(at, at)), at, {0, c, i});
    }
  }

  /** What decides between features at the same distance. */
  bool precedes(const FeatureRef& a, const FeatureRef& b) const {
    if (a.dimension != b.dimension) return a.dimension < b.dimension;
    if (a.dimension == 0) return map_.vertex(a.cell, a.local) < map_.vertex(b.cell, b.local);
    if (a.cell != b.cell) return map_.index(a.cell) < map_.index(b.cell);
    return a.local < b.local;
  }

  void offer(double distance, const Vec& at, const FeatureRef& feature) {
    if (!(distance <= best_)) return;
    if (found_ && distance == best_ && !precedes(feature, result_.feature)) return;
    found_ = true;
    best_ = distance;
    at_ = at;
    result_.feature = feature;
  }

  void finish() {
    result_.distance = best_ / scale_;
    double at[D];
    store<D>(at_, at);
    for (int k = 0; k < D; ++k) {
      result_.point[k] = point_[k] + at[k] / scale_;
      result_.normal[k] = best_ > 0 ? -at[k] / best_ : 0;
    }
  }

  /** Enters a cell into the set of seen ones; whether it is new. Open addressing, at most half full. */
  bool see(Cell c) {
    if (2 * (seen_count_ + 1) > seen_.size()) {
      Array<uint32_t> old(2 * seen_.size(), kNoCell, seen_.get_allocator());
      old.swap(seen_);
      for (const uint32_t unit : old) {
        if (unit != kNoCell) seen_[slot_of(unit)] = unit;
      }
    }
    uint32_t& slot = seen_[slot_of(c.unit)];
    if (slot == c.unit) return false;
    slot = c.unit;
    ++seen_count_;
    return true;
  }
  bool is_seen(Cell c) const { return seen_[slot_of(c.unit)] == c.unit; }
  size_t slot_of(uint32_t unit) const {
    const size_t mask = seen_.size() - 1;
    size_t slot = (unit * 0x9e3779b1u) & mask;
    while (seen_[slot] != kNoCell && seen_[slot] != unit) slot = (slot + 1) & mask;
    return slot;
  }

  const Environment<D>& env_;
  const Map<D>& map_;
  const double* point_;
  NearestResult& result_;
  Array<Visit> heap_;
  Array<uint32_t> seen_;
  size_t seen_count_ = 0;
  double scale_ = 1, best_ = 0;
  Vec at_{};
  bool found_ = false;
};

}  // namespace

template <int D>
bool find_nearest(const Environment<D>& env, const double* point, Cell start, double radius, NearestResult& result) {
  result = {};
  return Flood<D>(env, point, radius, result).run(start);
}

template bool find_nearest(const Environment<2>&, const double*, Cell, double, NearestResult&);
template bool find_nearest(const Environment<3>&, const double*, Cell, double, NearestResult&);

}  // namespace dsw
