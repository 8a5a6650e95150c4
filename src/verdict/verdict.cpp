#include "verdict/verdict.h"

#include <algorithm>

#include "environment/validity.h"
#include "predicates/plane_hit.h"
#include "predicates/sweep_events.h"

namespace dsw {
namespace {

bool is_outside(const double* a, const double* b, const double* c, const double* point) noexcept {
  const double* const triangle[] = {a, b, c};
  return exact::plane_side<3>(triangle, point).sign > 0;
}

int line_sign(const double* p, const double* q, const double* a, const double* b) noexcept {
  const double* const line[] = {a, b};
  return exact::line_side<3>(p, q, line).sign;
}

/** Whether body segment p q passes triangle a b c; its ends are on different sides then. */
bool passes(const double* p, const double* q, const double* const* t) noexcept {
  if (is_outside(t[0], t[1], t[2], p) == is_outside(t[0], t[1], t[2], q)) return false;
  const int first = line_sign(p, q, t[0], t[1]);
  return first == line_sign(p, q, t[1], t[2]) && first == line_sign(p, q, t[2], t[0]);
}

/** Whether line a b of the environment passes the triangle of body points p q r. */
bool is_passed(const double* const* t, const double* a, const double* b) noexcept {
  // Here the triangle is shifted, not the point: the same as minus the shift of the point, which is that of the mirror image.
  double mirrored[5][3];
  const double* const points[] = {t[0], t[1], t[2], a, b};
  for (int i = 0; i < 5; ++i) {
    for (int k = 0; k < 3; ++k) mirrored[i][k] = -points[i][k];
  }
  if (is_outside(mirrored[0], mirrored[1], mirrored[2], mirrored[3]) ==
      is_outside(mirrored[0], mirrored[1], mirrored[2], mirrored[4])) {
    return false;
  }
  const int first = line_sign(t[0], t[1], a, b);
  return first == line_sign(t[1], t[2], a, b) && first == line_sign(t[2], t[0], a, b);
}

Box<3> box_of(const double* const* points, int count) noexcept {
  Box<3> box;
  for (int i = 0; i < count; ++i) box.add(points[i]);
  return box;
}

}  // namespace

bool exactly_contains(const Environment<3>& env, Cell c, const double* point) noexcept {
  const Shape shape = env.map.shape(c);
  const bool is_convex = env.map.convex(c);
  double o[3];
  centre(env, c, o);
  for (uint32_t s = 0; s < shape.simplex_count(); ++s) {
    const double* t[3];
    simplex_points(env, c, shape, s, t);
    const bool outside = is_outside(t[0], t[1], t[2], point);
    if (is_convex && outside) return false;
    if (is_convex || outside) continue;
    // One of the star's tetrahedra.
    if (!is_outside(o, t[1], t[0], point) && !is_outside(o, t[2], t[1], point) && !is_outside(o, t[0], t[2], point)) {
      return true;
    }
  }
  return is_convex;
}

void Judge::add(uint32_t subject, const double* p, const double* q, const double* r) {
  Claim claim;
  claim.points[0] = p;
  claim.points[1] = q;
  claim.points[2] = r;
  claim.subject = subject;
  claims_.push_back(claim);
  boxes_.push_back(box_of(claim.points, r == nullptr ? 2 : 3));
  all_.add(boxes_.back());
}

void Judge::meet_triangle(const double* const* triangle) noexcept {
  const Box<3> box = box_of(triangle, 3);
  if (!box.overlaps(all_)) return;
  for (size_t i = 0; i < claims_.size(); ++i) {
    Claim& claim = claims_[i];
    if (claim.points[2] != nullptr || !box.overlaps(boxes_[i])) continue;
    const double *const p = claim.points[0], *const q = claim.points[1];
    if (std::equal(p, p + 3, q) || !passes(p, q, triangle)) continue;
    const bool leaves = is_outside(triangle[0], triangle[1], triangle[2], q);
    const double* const seen[] = {triangle[0], triangle[leaves ? 1 : 2], triangle[leaves ? 2 : 1]};
    claim.is_met = true;
    claim.time = std::min(claim.time, crossing_time<3>(p, q, seen));
  }
  for (int k = 0; k < 3; ++k) meet_line(triangle[k], triangle[(k + 1) % 3]);
}

void Judge::meet_line(const double* a, const double* b) noexcept {
  const double* const ends[] = {a, b};
  const Box<3> box = box_of(ends, 2);
  if (!box.overlaps(all_)) return;
  for (size_t i = 0; i < claims_.size(); ++i) {
    Claim& claim = claims_[i];
    if (claim.points[2] == nullptr || !box.overlaps(boxes_[i]) || !is_passed(claim.points, a, b)) continue;
    const SweepEvent event{{claim.points[2], a, b}, EventKind::kEdge};
    claim.is_met = true;
    claim.time = std::min(claim.time, event_time<3>(claim.points[0], claim.points[1], event));
  }
}

bool Judge::is_folded(size_t claim) const noexcept {
  bool is_near = false;
  for_each_cell(env_.map, [&](Cell c) {
    if (is_near) return;
    Box<3> box;
    for (uint32_t k = 0, n = env_.map.vertices_of(c); k < n; ++k) box.add(env_.point(env_.map.vertex(c, k)));
    if (!box.overlaps(boxes_[claim])) return;
    const CellState state = check_cell(env_, c);
    is_near = state == CellState::kInverted || state == CellState::kInvalid;
  });
  return is_near;
}

void Judge::run() {
  for_each_cell(env_.map, [&](Cell c) {
    const Shape shape = env_.map.shape(c);
    for (uint32_t f = 0; f < shape.facet_count(); ++f) {
      const HalfFacet h = env_.map.half_facet(c, f);
      if (canonical(env_.map, h) != h || !is_impassable(env_, h)) continue;
      for (uint32_t s = shape.simplex_first(f); s < shape.simplex_first(f + 1); ++s) {
        const double* triangle[3];
        simplex_points(env_, c, shape, s, triangle);
        meet_triangle(triangle);
      }
    }
  });
  Array<uint64_t> wires{Allocator<uint64_t>(env_.memory)};
  env_.edge_marks.copy_sorted(wires);
  for (const uint64_t wire : wires) {
    meet_line(env_.point(static_cast<uint32_t>(wire >> 32)), env_.point(static_cast<uint32_t>(wire)));
  }
}

}  // namespace dsw
