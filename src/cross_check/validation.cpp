#include "cross_check/validation.h"

#include <algorithm>

#include "environment/marking.h"
#include "environment/validity.h"
#include "predicates/plane_hit.h"
#include "predicates/sweep_events.h"

namespace dsw {
namespace {

template <int D>
bool is_outside(const double* const (&simplex)[D], const double* point) noexcept {
  return exact::plane_side<D>(simplex, point).sign > 0;
}

/** On which side body segment p q passes a ridge of D - 1 points. */
template <int D>
int ridge_sign(const double* p, const double* q, const double* const* ridge) noexcept {
  return exact::line_side<D>(p, q, ridge).sign;
}

/** Whether body segment p q passes a simplex; its ends are on different sides then. */
bool passes(const double* p, const double* q, const double* const (&t)[3]) noexcept {
  if (is_outside(t, p) == is_outside(t, q)) return false;
  const double *const second[] = {t[1], t[2]}, *const third[] = {t[2], t[0]};
  const int first = ridge_sign<3>(p, q, t);
  return first == ridge_sign<3>(p, q, second) && first == ridge_sign<3>(p, q, third);
}
bool passes(const double* p, const double* q, const double* const (&side)[2]) noexcept {
  return is_outside(side, p) != is_outside(side, q) && ridge_sign<2>(p, q, side) != ridge_sign<2>(p, q, side + 1);
}

/** Whether a ridge of the environment's passes the triangle of body points p q r, or in the plane lies in it. */
template <int D>
bool is_passed(const double* const* t, const double* const* ridge) noexcept {
  if constexpr (D == 3) {
    // Here the triangle is shifted, not the point: the same as minus the shift of the point, which is that of the
    // mirror image.
    double mirrored[5][3];
    const double* const points[] = {t[0], t[1], t[2], ridge[0], ridge[1]};
    for (int i = 0; i < 5; ++i) {
      for (int k = 0; k < 3; ++k) mirrored[i][k] = -points[i][k];
    }
    const double* const triangle[] = {mirrored[0], mirrored[1], mirrored[2]};
    if (is_outside(triangle, mirrored[3]) == is_outside(triangle, mirrored[4])) return false;
  }
  const int first = ridge_sign<D>(t[0], t[1], ridge);
  return first == ridge_sign<D>(t[1], t[2], ridge) && first == ridge_sign<D>(t[2], t[0], ridge);
}

template <int D>
Box<D> box_of(const double* const* points, int count) noexcept {
  Box<D> box;
  for (int i = 0; i < count; ++i) box.add(points[i]);
  return box;
}

}  // namespace

template <int D>
bool exactly_contains(const Environment<D>& env, Cell c, const double* point) noexcept {
  const Shape shape = env.map.shape(c);
  const bool is_convex = env.map.convex(c);
  double o[D];
  centre(env, c, o);
  for (uint32_t s = 0; s < shape.simplex_count(); ++s) {
    const double* t[D];
    simplex_points(env, c, shape, s, t);
    const bool outside = is_outside<D>(t, point);
    if (is_convex && outside) return false;
    if (is_convex || outside) continue;
    // One of the star's simplices: its other facets replace one corner by the centre.
    bool is_in = true;
    for (int k = 0; k < D; ++k) {
      const double* facet[D];
      std::copy_n(t, D, facet);
      facet[k] = o;
      std::swap(facet[0], facet[1]);
      is_in = is_in && !is_outside<D>(facet, point);
    }
    if (is_in) return true;
  }
  return is_convex;
}

template <int D>
void Validator<D>::add(uint32_t subject, const double* p, const double* q, const double* r) {
  Claim claim;
  claim.points[0] = p;
  claim.points[1] = q;
  claim.points[2] = r;
  claim.subject = subject;
  claims_.push_back(claim);
  boxes_.push_back(box_of<D>(claim.points, r == nullptr ? 2 : 3));
  all_.add(boxes_.back());
}

template <int D>
void Validator<D>::meet_simplex(const double* const* simplex) noexcept {
  const Box<D> box = box_of<D>(simplex, D);
  if (!box.overlaps(all_)) return;
  const double* seen[D];
  std::copy_n(simplex, D, seen);
  for (size_t i = 0; i < claims_.size(); ++i) {
    Claim& claim = claims_[i];
    if (claim.points[2] != nullptr || !box.overlaps(boxes_[i])) continue;
    const double *const p = claim.points[0], *const q = claim.points[1];
    if (std::equal(p, p + D, q) || !passes(p, q, seen)) continue;
    if (!is_outside<D>(seen, q)) std::swap(seen[D - 2], seen[D - 1]);
    claim.is_met = true;
    claim.time = std::min(claim.time, crossing_time<D>(p, q, seen));
  }
  for (int k = 0; k < D; ++k) {
    const double* const ridge[] = {simplex[k], simplex[(k + 1) % D]};
    meet_ridge(ridge);
  }
}

template <int D>
void Validator<D>::meet_ridge(const double* const* ridge) noexcept {
  const Box<D> box = box_of<D>(ridge, D - 1);
  if (!box.overlaps(all_)) return;
  for (size_t i = 0; i < claims_.size(); ++i) {
    Claim& claim = claims_[i];
    if (claim.points[2] == nullptr || !box.overlaps(boxes_[i]) || !is_passed<D>(claim.points, ridge)) continue;
    SweepEvent event{{claim.points[2]}, EventKind::kEdge};
    std::copy_n(ridge, D - 1, event.points + 1);
    claim.is_met = true;
    claim.time = std::min(claim.time, event_time<D>(claim.points[0], claim.points[1], event));
  }
}

template <int D>
bool Validator<D>::is_folded(size_t claim) const noexcept {
  bool is_near = false;
  for_each_cell(env_.map, [&](Cell c) {
    if (is_near) return;
    Box<D> box;
    for (uint32_t k = 0, n = env_.map.vertices_of(c); k < n; ++k) box.add(env_.point(env_.map.vertex(c, k)));
    if (!box.overlaps(boxes_[claim])) return;
    const CellState state = check_cell(env_, c);
    is_near = state == CellState::kInverted || state == CellState::kInvalid;
  });
  return is_near;
}

template <int D>
void Validator<D>::run() {
  for_each_cell(env_.map, [&](Cell c) {
    const Shape shape = env_.map.shape(c);
    for (uint32_t f = 0; f < shape.facet_count(); ++f) {
      const HalfFacet h = env_.map.half_facet(c, f);
      if (canonical(env_.map, h) != h || !is_impassable(env_, h)) continue;
      for (uint32_t s = shape.simplex_first(f); s < shape.simplex_first(f + 1); ++s) {
        const double* simplex[D];
        simplex_points(env_, c, shape, s, simplex);
        meet_simplex(simplex);
      }
    }
  });
  if constexpr (D == 3) {
    Array<uint64_t> marked{Allocator<uint64_t>(env_.memory)};
    env_.edge_marks.copy_sorted(marked);
    for (const uint64_t edge : marked) {
      const double* const ends[] = {env_.point(static_cast<uint32_t>(edge >> 32)),
                                    env_.point(static_cast<uint32_t>(edge))};
      meet_ridge(ends);
    }
  } else {
    for (uint32_t v = 0; v < env_.map.vertex_count; ++v) {
      const double* const point = env_.point(v);
      if (vertex_marked(env_, v)) meet_ridge(&point);
    }
  }
}

#define DSW_INSTANTIATE_VALIDATOR(D)                                                               \
  template bool exactly_contains(const Environment<D>& env, Cell c, const double* point) noexcept; \
  template class Validator<D>
DSW_INSTANTIATE_VALIDATOR(2);
DSW_INSTANTIATE_VALIDATOR(3);
#undef DSW_INSTANTIATE_VALIDATOR

}  // namespace dsw
