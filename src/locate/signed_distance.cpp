// The tree of obstacles finds the nearest simplex of the boundary, and those that are as near up to rounding. Mostly these
// tell the side, exactly:
//
// One simplex alone is nearest: the way to it passes nothing else, so the side of its plane decides.
//
// Two simplices are nearest in a ridge that they share. The point is inside of the wedge between them if it is below both
// planes, or, where the wedge is more than half of the space, below one.
//
// In space, several triangles are nearest in a vertex. No direction from the vertex into one of them makes an acute angle
// with the way to the point. On the sphere of directions the triangles are arcs that lie beyond the equator as seen from
// the point. So the first place of them that the point sees is the end of an arc, which is the edge that makes the
// least angle. The way there passes no other arc, so the wedge at this edge decides.
//
// What rounding leaves open is left to `locate`.

#include "locate/signed_distance.h"

#include <algorithm>
#include <limits>

#include "base/dimensions.h"
#include "base/position.h"
#include "base/sort.h"
#include "locate/locate.h"
#include "predicates/filtered.h"
#include "predicates/plane_hit.h"
#include "predicates/touch.h"

namespace dsw {
namespace {

constexpr double kClear = 0x1p-36;  // share of the terms of a sum from which on its sign is trusted

/** A sum of products, and whether it is surely of one sign. */
struct Sum {
  double value, terms;
  bool is_positive() const { return value > kClear * terms; }
  bool is_negative() const { return value < -kClear * terms; }
};
Sum along(const Vec& way, const Vec& x) noexcept {
  return {-dot(way, x), std::sqrt(dot(way, way)) * std::sqrt(dot(x, x))};
}
Sum difference_of(const Sum& a, const Sum& b, const Sum& c, const Sum& d) noexcept {
  return {a.value * b.value - c.value * d.value, a.terms * b.terms + c.terms * d.terms};
}

/** The corners that have a share in the place of a simplex that is nearest to the origin, a bit for each; 0 if rounding
 * leaves that open. */
uint32_t carriers_of(const Vec (&x)[2]) noexcept {
  const Vec d = x[1] - x[0];
  const Sum first = along(d, x[0]), second = along(d, x[1]);
  return first.is_negative() ? 1 : second.is_positive() ? 2 : first.is_positive() && second.is_negative() ? 3 : 0;
}
uint32_t carriers_of(const Vec (&x)[3]) noexcept {
  const Vec ab = x[1] - x[0], ac = x[2] - x[0], bc = x[2] - x[1];
  const Sum d1 = along(ab, x[0]), d2 = along(ac, x[0]), d3 = along(ab, x[1]), d4 = along(ac, x[1]),
            d5 = along(ab, x[2]), d6 = along(ac, x[2]), e2 = along(bc, x[1]), e3 = along(bc, x[2]);
  const Sum to_bc = difference_of(d3, d6, d5, d4), to_ac = difference_of(d5, d2, d1, d6),
            to_ab = difference_of(d1, d4, d3, d2);
  if (d1.is_negative() && d2.is_negative()) return 1;
  if (d3.is_positive() && e2.is_negative()) return 2;
  if (d6.is_positive() && e3.is_positive()) return 4;
  if (to_ab.is_negative() && d1.is_positive() && d3.is_negative()) return 3;
  if (to_ac.is_negative() && d2.is_positive() && d6.is_negative()) return 5;
  if (to_bc.is_negative() && e2.is_positive() && e3.is_negative()) return 6;
  return to_ab.is_positive() && to_ac.is_positive() && to_bc.is_positive() ? 7 : 0;
}
Vec way_to(const Vec (&x)[2]) noexcept { return nearest_on(x[0], x[1]); }
Vec way_to(const Vec (&x)[3]) noexcept { return nearest_on(x[0], x[1], x[2]); }

template <int D>
class BoundarySearch {
 public:
  BoundarySearch(const Environment<D>& env, const double* point)
      : env_(env), point_(point), scale_(fitting_scale<D>(env, {point})) {}

  SignedDistance<D> run(const BoundaryTree<D>* boundary) {
    if (boundary == nullptr) {
      look_round();
    } else if (scale_ != 1 || !boundary->visit_near(point_, [&](const OuterSimplex<D>& each) {
                 look(each.vertices, each.facet);
                 return std::sqrt(limit_);
               })) {
      boundary->for_each([&](const OuterSimplex<D>& each) { look(each.vertices, each.facet); });
    }
    SignedDistance<D> result;
    result.scale = scale_;
    if (nearest_ == nullptr) return result;
    result.facet = nearest_->facet;
    if (is_on_boundary()) {
      result.distance = 0;
      return result;
    }
    result.way = nearest_->way;
    // Not on the boundary, so not at distance 0, if rounding says that.
    const double distance = std::max(length_of_way(result.way) / scale_, std::numeric_limits<double>::denorm_min());
    const bool inside = is_inside();
    result.distance = inside ? -distance : distance;
    result.normal = is_normal_to_face() ? face_normal(inside) : Vec::Zero() - unit(result.way);
    return result;
  }

 private:
  /** Looks at all that is near. */
  void look_round() {
    const CellTree<D>* const tree = scale_ == 1 ? env_.obstacles.find(env_) : nullptr;
    const auto visit = [&](uint32_t index) {
      look(env_.map.cell(index));
      const double reach = std::sqrt(limit_);
      return reach + 0x1p-40 * (reach + tree->length());
    };
    bool is_done = false;
    if (tree != nullptr) {
      env_.obstacles.for_each_beside(*tree, visit);
      is_done = tree->visit_near(point_, HUGE_VAL, visit);
    }
    if (is_done) return;
    for_each_cell(env_.map, [&](Cell c) { look(c); });
    env_.obstacles.note_flood(env_, env_.map.cell_count);
  }

  struct Near {
    Vec way;
    double square;
    HalfFacet facet;
    uint32_t vertices[D];  // oriented outwards
  };
  static constexpr uint32_t kMost = 24;
  static constexpr double kRoom = 0x1p-40;  // of squared distances that count as equal

  /** Calls visit(vertices, facet) for the outer simplices of a cell, oriented outwards. */
  template <class Visit>
  void for_each_outer(Cell c, const Visit& visit) const {
    if (!c.valid()) return;
    const uint32_t facets = env_.map.facets_of(c);
    for (uint32_t f = 0; f < facets; ++f) {
      const HalfFacet h = env_.map.half_facet(c, f);
      if (env_.map.opposite(h).valid()) continue;
      const Shape shape = env_.map.shape(c);
      for (uint32_t s = shape.simplex_first(f); s < shape.simplex_first(f + 1); ++s) {
        uint32_t vertices[D];
        for (uint32_t k = 0; k < D; ++k) vertices[k] = env_.map.vertex(c, shape.simplices()[s * D + k]);
        visit(vertices, h);
      }
    }
  }
  void look(Cell c) {
    for_each_outer(c, [&](const uint32_t(&vertices)[D], HalfFacet h) { look(vertices, h); });
  }

  void look(const uint32_t (&vertices)[D], HalfFacet h) {
    Near near;
    Vec at[D];
    double far = 0;  // the largest difference of a coordinate from the point
    for (int k = 0; k < D; ++k) {
      near.vertices[k] = vertices[k];
      at[k] = relative<D>(env_.point(near.vertices[k]), point_, scale_);
      far = std::max(far, largest(at[k]));
    }
    near.way = way_to(at);
    const double square = near.square = dot(near.way, near.way);
    if (!(square <= limit_)) return;
    near.facet = h;
    // The error of a squared distance is below this share of the largest differences times the distance.
    const double limit = square + kRoom * (square + far * (kRoom * far + std::sqrt(square) * 0x1p-6));
    if (limit < limit_) {
      limit_ = limit;
      uint32_t kept = 0;
      for (uint32_t i = 0; i < count_; ++i) {
        if (near_[i].square <= limit_) near_[kept++] = near_[i];
      }
      count_ = kept;
    }
    if (count_ == kMost) {
      is_crowded_ = true;
      count_ = 0;  // the sign is asked for otherwise
    }
    near_[count_++] = near;
    nearest_ = &near_[0];
    for (uint32_t i = 1; i < count_; ++i) {
      if (comes_before(near_[i], *nearest_)) nearest_ = &near_[i];
    }
  }

  /** The nearer one comes first, of equals the lower face. */
  bool comes_before(const Near& a, const Near& b) const {
    if (a.square != b.square) return a.square < b.square;
    const Cell c = env_.map.cell_of(a.facet), d = env_.map.cell_of(b.facet);
    const uint32_t i = env_.map.index(c), k = env_.map.index(d);
    return i != k ? i < k : env_.map.local_of(a.facet, c) < env_.map.local_of(b.facet, d);
  }

  /** Whether rounding matters to the way to the nearest simplex. */
  bool is_close() const {
    double far = 0;
    for (const uint32_t v : nearest_->vertices)
      far = std::max(far, largest(relative<D>(env_.point(v), point_, scale_)));
    return std::sqrt(nearest_->square) <= 0x1p-40 * far;
  }

  /** Whether the point lies exactly on a simplex that is near. */
  bool is_on_boundary() const {
    if (!is_close()) return false;
    bool found = false;
    const auto decide = [&](const uint32_t(&vertices)[D], HalfFacet) {
      const double* corners[D];
      for (int k = 0; k < D; ++k) corners[k] = env_.point(vertices[k]);
      found = found || point_touch<D>(point_, point_, corners, D).time == 0;
    };
    for (uint32_t i = 0; i < count_; ++i) decide(near_[i].vertices, near_[i].facet);
    if (is_crowded_) for_each_cell(env_.map, [&](Cell c) { for_each_outer(c, decide); });
    return found;
  }

  /** Whether the way ends within a face, and is so short that its direction is that of rounding. */
  bool is_normal_to_face() const {
    uint32_t vertices[D];
    return is_zero(nearest_->way) || (is_close() && carriers(*nearest_, vertices) == D);
  }
  /** Normal to the nearest face, towards the side of the point. */
  Vec face_normal(bool inside) const {
    const double* corners[D];
    for (int k = 0; k < D; ++k) corners[k] = env_.point(nearest_->vertices[k]);
    double outward[3] = {};
    unit_normal<D>(corners, outward);
    const Vec normal = to_vec<D>(outward);
    return inside ? Vec::Zero() - normal : normal;
  }

  bool is_inside() const {
    bool inside = false;
    return !is_crowded_ && tell(inside) ? inside
                                        : locate(env_, point_, env_.map.cell_of(nearest_->facet), nullptr).cell.valid();
  }

  /** The vertices that have a share in the nearest place, ascending; their number, 0 where that is open. */
  uint32_t carriers(const Near& near, uint32_t* vertices) const {
    Vec at[D];
    for (int k = 0; k < D; ++k) at[k] = relative<D>(env_.point(near.vertices[k]), point_, scale_);
    const uint32_t corners = carriers_of(at);
    uint32_t count = 0;
    for (uint32_t k = 0; k < D; ++k) {
      if ((corners >> k & 1) != 0) vertices[count++] = near.vertices[k];
    }
    dsw::sort(vertices, vertices + count);
    return count;
  }

  int side(const Near& near, const double* x) const {
    const double* corners[D];
    for (int k = 0; k < D; ++k) corners[k] = env_.point(near.vertices[k]);
    return orient<D>(corners, x);
  }

  /** Whether it can be told; then whether the point is inside. */
  bool tell(bool& inside) const {
    if (count_ == 1) {
      const int at = side(near_[0], point_);
      inside = at < 0;
      return at != 0;
    }
    uint32_t first[D], other[D];
    const uint32_t count = carriers(near_[0], first);
    if (count == 0) return false;
    for (uint32_t i = 1; i < count_; ++i) {
      if (carriers(near_[i], other) != count || !std::equal(first, first + count, other)) return false;
    }
    if (count == D - 1) return count_ == 2 && tell_by_wedge(near_[0], near_[1], first, inside);
    if constexpr (D == 3) return tell_by_edge(first[0], inside);
    return false;
  }

  /** By two simplices with a ridge in common. */
  bool tell_by_wedge(const Near& a, const Near& b, const uint32_t* ridge, bool& inside) const {
    uint32_t far = kNoCell;
    for (const uint32_t v : b.vertices) {
      if (std::find(ridge, ridge + D - 1, v) == ridge + D - 1) far = v;
    }
    const int fold = side(a, env_.point(far)), at_a = side(a, point_), at_b = side(b, point_);
    if (fold == 0) {  // in one plane, or back along it
      inside = at_a < 0;
      return at_a != 0 && at_a == at_b;
    }
    inside = fold < 0 ? at_a < 0 && at_b < 0 : at_a < 0 || at_b < 0;
    return true;
  }

  /** By the edge at a vertex that makes the least angle with the way to the point. */
  bool tell_by_edge(uint32_t vertex, bool& inside) const {
    const Vec back = -nearest_->way;
    double best = -HUGE_VAL, second = -HUGE_VAL;
    uint32_t end = kNoCell;
    for (uint32_t i = 0; i < count_; ++i) {
      for (const uint32_t v : near_[i].vertices) {
        if (v == vertex || v == end) continue;
        const Vec edge = scale_ * (to_vec<D>(env_.point(v)) - to_vec<D>(env_.point(vertex)));
        const double angle = dot(edge, back) / std::sqrt(dot(edge, edge));
        if (!(angle > second)) continue;
        second = angle;
        if (!(angle > best)) continue;
        second = best;
        best = angle;
        end = v;
      }
    }
    const double length = std::sqrt(nearest_->square);
    if (end == kNoCell || !(best - second > 0x1p-30 * length)) return false;
    const uint32_t ridge[2] = {vertex, end};
    const Near* both[2] = {};
    uint32_t count = 0;
    for (uint32_t i = 0; i < count_; ++i) {
      const auto& v = near_[i].vertices;
      if (std::find(v, v + D, end) == v + D) continue;
      if (count == 2) return false;
      both[count++] = &near_[i];
    }
    return count == 2 && tell_by_wedge(*both[0], *both[1], ridge, inside);
  }

  const Environment<D>& env_;
  const double* point_;
  double scale_, limit_ = HUGE_VAL;
  Near near_[kMost];
  uint32_t count_ = 0;
  const Near* nearest_ = nullptr;
  bool is_crowded_ = false;
};

}  // namespace

template <int D>
SignedDistance<D> find_signed_distance(const Environment<D>& env, const double* point,
                                       const BoundaryTree<D>* boundary) noexcept {
  return BoundarySearch<D>(env, point).run(boundary);
}

DSW_INSTANTIATE(find_signed_distance);

}  // namespace dsw
