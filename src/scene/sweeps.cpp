#include "scene/sweeps.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <new>

#include "map/dart.h"
#include "motion/cast.h"
#include "motion/move.h"
#include "motion/standard_facets.h"
#include "motion/sweep.h"
#include "predicates/plane_hit.h"
#include "scene/batch.h"
#include "scene/report.h"
#include "scene/starts.h"

namespace dsw {
namespace {

struct Vec {
  double x, y, z;
};

Vec difference(const double* a, const double* b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vec cross(const Vec& a, const Vec& b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
double dot(const Vec& a, const Vec& b) { return (a.x * b.x + a.y * b.y) + a.z * b.z; }
Vec scaled(const Vec& a, double s) { return {a.x * s, a.y * s, a.z * s}; }

/** Length 1; zero if it is zero or not finite. By its largest component first, so that no square over- or underflows. */
Vec unit(const Vec& a) {
  const double largest = std::max({std::fabs(a.x), std::fabs(a.y), std::fabs(a.z)});
  if (!(largest > 0) || !std::isfinite(largest)) return {0, 0, 0};
  const Vec b{a.x / largest, a.y / largest, a.z / largest};
  const double length = std::sqrt(dot(b, b));
  return {b.x / length, b.y / length, b.z / length};
}
bool is_zero(const Vec& a) { return a.x == 0 && a.y == 0 && a.z == 0; }

/** Where segment ab pierces the swept plane, by the exact ratio. It does not lie in it: shifted, both ends of a line in that
 * plane are on one side. */
void piercing_point(const EdgeMotion& m, const double* a, const double* b, double* point) {
  const double* const swept[3] = {m.p, m.to, m.q};
  if (swept_side(m, b).sign < 0) std::swap(a, b);
  point_at<3>(a, b, crossing_time<3>(a, b, swept), point);
}

/** How far along the edge, which runs from `end` to q, a point on it lies: by the axis it is longest on. */
double share_along(const double* end, const double* q, const double* point) {
  int axis = 0;
  for (int k = 1; k < 3; ++k) {
    if (std::fabs(q[k] - end[k]) > std::fabs(q[axis] - end[axis])) axis = k;
  }
  const double share = (point[axis] - end[axis]) / (q[axis] - end[axis]);
  return share > 0 ? std::min(share, 1.0) : 0;
}

/** The normal of an edge contact; see dsw_sweep. */
Vec edge_normal(const EdgeMotion& m, const SweepContact& contact, const double* end, const Vec& triangle) {
  const Vec move = unit(difference(m.to, m.p));
  const Vec across =
      unit(cross(unit(difference(m.q, end)), unit(difference(contact.event.points[1], contact.event.points[0]))));
  const Vec chosen = !is_zero(across) ? across : !is_zero(triangle) ? triangle : scaled(move, -1);
  const double against = dot(chosen, move);
  const bool turn = against != 0 ? against > 0 : dot(chosen, triangle) < 0;
  return scaled(chosen, turn ? -1 : 1);
}

void report_contact(const Environment<3>& env, const EdgeMotion& m, const SweepContact& contact, dsw_sweep& sweep) {
  sweep.outcome = DSW_OUTCOME_CONTACT;
  sweep.front = volume_id(env.map, contact.front);
  sweep.time = event_time(m, contact.event);
  point_at<3>(m.p, m.to, sweep.time, sweep.position);
  Vec normal{0, 0, 0};
  if (contact.facet.valid()) {
    const double* triangle[3];
    boundary_points(env, contact.front, contact.simplex, triangle);
    double outward[3];
    unit_normal<3>(triangle, outward);
    normal = {0 - outward[0], 0 - outward[1], 0 - outward[2]};
    sweep.face = face_id(env.map, canonical(env.map, contact.facet));
    sweep.obstacle = obstacle_kind(env, contact.facet);
    sweep.tag = obstacle_tag(env, contact.facet, contact.front);
  } else {
    sweep.obstacle = DSW_CELL_EDGE;
  }
  sweep.kind = contact.dart == kNoFacet ? DSW_CONTACT_PLANE : DSW_CONTACT_EDGE;
  if (contact.dart != kNoFacet) {
    sweep.edge = edge_id(env.map, {contact.front, contact.dart});
  }
  if (contact.event.of_edge) normal = edge_normal(m, contact, sweep.position, normal);
  sweep.normal[0] = normal.x + 0.0;  // never -0
  sweep.normal[1] = normal.y + 0.0;
  sweep.normal[2] = normal.z + 0.0;
  if (contact.event.of_edge) {
    piercing_point(m, contact.event.points[0], contact.event.points[1], sweep.point);
    sweep.along = share_along(sweep.position, m.q, sweep.point);
  } else {
    std::copy_n(sweep.position, 3, sweep.point);
  }
}

/** The sweeps of one thread. */
class Sweeper {
 public:
  Sweeper(const Environment<3>& env, const SweepOptions& options) : env_(env), options_(options), flood_(env) {}

  void sweep(const EdgeMotion& m, Cell start, dsw_sweep& sweep) {
    sweep = dsw_sweep{};
    std::copy_n(m.p, 3, sweep.position);
    sweep.volume = volume_id(env_.map, start);
    if (!is_passable(env_, start)) {
      sweep.outcome = start.valid() ? DSW_OUTCOME_IMPASSABLE : DSW_OUTCOME_OUTSIDE;
      return;
    }
    if (!options_.start_free) {
      const CastEnd edge = fly(m.p, m.q, start, sweep).end;
      if (edge == CastEnd::kHit) sweep.outcome = DSW_OUTCOME_IMPASSABLE;
      if (edge != CastEnd::kReached) return;
    }
    const CastResult path = fly(m.p, m.to, start, sweep);
    if (path.end == CastEnd::kWorkLimit) return;
    const bool flooded = needs_flood(m, path, sweep);
    if (sweep.outcome == DSW_OUTCOME_WORK_LIMIT) return;
    if (flooded) {
      uint32_t left = 0;
      if (!work_left(sweep, left)) return;
      const SweepResult swept = flood_.sweep(m, start, left);
      sweep.cells_visited += swept.cells_visited;
      if (swept.end == SweepEnd::kWorkLimit) sweep.outcome = DSW_OUTCOME_WORK_LIMIT;
      if (swept.end == SweepEnd::kContact) report_contact(env_, m, swept.contact, sweep);
      if (swept.end != SweepEnd::kFree) return;
    }
    if (path.end == CastEnd::kHit) return report_path(m, path, sweep);
    sweep.outcome = DSW_OUTCOME_REACHED;
    sweep.time = 1;
    sweep.volume = volume_id(env_.map, path.cell);
    std::copy_n(m.to, 3, sweep.position);
  }

 private:
  /** How many cells may still be looked at; 0: as many as it takes. False, and the outcome is set, if none may. */
  bool work_left(dsw_sweep& sweep, uint32_t& left) const {
    left = options_.max_cells == 0 ? 0 : options_.max_cells - sweep.cells_visited;
    if (options_.max_cells == 0 || left != 0) return true;
    sweep.outcome = DSW_OUTCOME_WORK_LIMIT;
    return false;
  }

  CastResult fly(const double* from, const double* to, Cell start, dsw_sweep& sweep) const {
    CastResult result;
    result.end = CastEnd::kWorkLimit;
    CastRequest request;
    request.from = from;
    request.to = to;
    request.start = start;
    if (!work_left(sweep, request.max_cells)) return result;
    result = cast(env_, request, nullptr);
    sweep.cells_visited += result.cells_visited;
    if (result.end == CastEnd::kWorkLimit) sweep.outcome = DSW_OUTCOME_WORK_LIMIT;
    return result;
  }

  /** Whether the triangle has to be looked at; the outcome is set if the work limit leaves that open. */
  bool needs_flood(const EdgeMotion& m, const CastResult& path, dsw_sweep& sweep) const {
    if (options_.level == SweepLevel::kPoints) return false;
    if (options_.level == SweepLevel::kEdgesSwept || path.end == CastEnd::kHit) return true;
    return fly(m.to, m.q, path.cell, sweep).end == CastEnd::kHit;
  }

  /** The contact of the moving end alone. */
  void report_path(const EdgeMotion& m, const CastResult& path, dsw_sweep& sweep) const {
    SweepContact contact;
    contact.front = path.cell;
    contact.facet = path.facet;
    contact.simplex = path.simplex;
    boundary_points(env_, path.cell, path.simplex, contact.event.points);
    report_contact(env_, m, contact, sweep);
  }

  const Environment<3>& env_;
  const SweepOptions& options_;
  SweepFlood flood_;
};

}  // namespace

void sweep_edges(const Environment<3>& env, const Parallel& parallel, size_t count, const dsw_volume_id* starts,
                 PointArray from, PointArray to, PointArray fixed, const SweepOptions& options, dsw_sweep* sweeps) {
  const Starts<3> where(env, starts, options.start_known);
  std::atomic<bool> out_of_memory{false};
  auto body = [&](size_t begin, size_t end) noexcept {
    try {
      Sweeper sweeper(env, options);
      for (size_t i = begin; i < end; ++i) {
        sweeper.sweep({from[i], to[i], fixed[i]}, where.find(i, from[i]), sweeps[i]);
      }
    } catch (const std::bad_alloc&) {
      out_of_memory = true;
    }
  };
  share_out(parallel, count, body);
  if (out_of_memory) throw std::bad_alloc();
}

}  // namespace dsw
