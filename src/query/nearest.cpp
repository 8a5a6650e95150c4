#include "query/nearest.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "base/batch.h"
#include "base/dimensions.h"
#include "base/owned.h"
#include "base/vec.h"
#include "contact/names.h"
#include "locate/bounded_flood.h"
#include "locate/inside.h"
#include "locate/locate.h"
#include "locate/signed_distance.h"
#include "predicates/plane_hit.h"
#include "query/locations.h"

namespace dsw {
namespace {

/** Whether the outward normal of a facet and a unit vector form an acute angle. A rounded cross product decides, unless
 * its error could matter: each component errs by less than 2^-50 of the product of the sides. */
template <int D>
bool is_outward(const double* const* simplex, const double* normal) {
  if constexpr (D == 3) {
    const Vec ab = difference<3>(simplex[1], simplex[0]), ac = difference<3>(simplex[2], simplex[0]);
    const double along = dot(ab.cross(ac), to_vec<3>(normal)), doubt = 0x1p-47 * largest(ab) * largest(ac);
    if (doubt > 0x1p-900 && std::isfinite(along) && std::fabs(along) > doubt) return along > 0;
  }
  double outward[3] = {};
  unit_normal<D>(simplex, outward);
  return outward[0] * normal[0] + outward[1] * normal[1] + outward[2] * normal[2] > 0;
}

/** The side of a facet that a viewer in the direction of `normal` sees. Behind a marked cell there is no viewer. */
template <int D>
HalfFacet seen_side(const Environment<D>& env, const FeatureRef& facet, const double* normal) noexcept {
  const HalfFacet h = env.map.half_facet(facet.cell, facet.local), o = env.map.opposite(h);
  if (!o.valid() || is_closed(env, env.map.cell_of(o))) return h;
  if (is_closed(env, facet.cell)) return o;
  const Shape shape = env.map.shape(facet.cell);
  const double* simplex[D];
  simplex_points(env, facet.cell, shape, shape.simplex_first(facet.local), simplex);
  return is_outward<D>(simplex, normal) ? o : h;
}

dsw_nearest nothing_near() noexcept {
  dsw_nearest answer{};
  answer.distance = std::numeric_limits<double>::infinity();
  return answer;
}

/** @param seen the side of a facet that was met, if that is known. */
template <int D>
dsw_nearest report_nearest(const Environment<D>& env, const NearestResult& found, HalfFacet seen) {
  dsw_nearest answer{};
  answer.distance = found.distance;
  std::copy(found.point, found.point + 3, answer.point);
  std::copy(found.normal, found.normal + 3, answer.normal);
  answer.cell = name_feature(env, found.feature);
  if (found.feature.dimension == D - 1) {
    if (!seen.valid()) seen = seen_side(env, found.feature, found.normal);
    answer.tag = obstacle_tag(env, seen, env.map.cell_of(seen));
  }
  return answer;
}

/** An obstacle on which a point lies exactly. */
template <int D>
dsw_nearest report_touched(const Environment<D>& env, const SeenObstacle& seen, const double* point) {
  dsw_nearest answer{};
  std::copy_n(point, D, answer.point);
  answer.cell = name_feature(env, seen.feature);
  if (seen.side.valid()) answer.tag = obstacle_tag(env, seen.side, seen.cell);
  return answer;
}

/** Asks for points or segments of a batch one after the other. */
template <int D>
class NearestOfBatch {
 public:
  NearestOfBatch(const Environment<D>& env, double radius) : env_(env), radius_(radius), notes_(env.memory) {}

  /** Forgets where the last question was asked, so that answers do not depend on how a batch is shared out. */
  void forget() noexcept {
    last_ = {};
    is_end_known_ = false;
  }

  /** Where a first point lies. `is_same`: the segment before was to go there. */
  Cell find_start(const double* point, const dsw_volume_id* hint, bool is_same) noexcept {
    const bool has_hint = hint != nullptr && !is_null(*hint);
    if (!has_hint && is_same && is_end_known_) return last_;
    return locate(env_, point, has_hint ? env_.map.cell(hint->index) : last_, nullptr).cell;
  }
  void ask(const double* point, Cell start, dsw_nearest& answer) {
    last_ = start;
    NearestResult found;
    const bool is_near = find_nearest_far(env_, point, start, radius_, notes_, found);
    const SeenObstacle seen = is_near ? find_touched_near(env_, point, start, found.distance) : SeenObstacle{};
    answer = seen.cell.valid() ? report_touched(env_, seen, point)
             : is_near         ? report_nearest(env_, found, {})
                               : nothing_near();
    answer.volumes_visited = found.volumes_visited;
  }
  void ask(const double* from, const double* to, Cell start, dsw_segment_nearest& answer) {
    SegmentNearest found;
    answer = {};
    answer.nearest = find_nearest_to_segment(env_, from, to, start, radius_, notes_, found)
                         ? report_nearest(env_, found, found.crossed)
                         : nothing_near();
    answer.nearest.volumes_visited = found.volumes_visited;
    answer.segment_parameter = found.parameter;
    std::copy_n(found.segment_point, 3, answer.segment_point);
    if (answer.nearest.cell.kind != DSW_CELL_NONE && !found.crossed.valid())
      decide_ends(from, to, start, found, answer);
    last_ = found.last;
    is_end_known_ = !found.crossed.valid();
  }

 private:
  /** A segment whose end lies exactly on an obstacle is at distance 0 from it. */
  void decide_ends(const double* from, const double* to, Cell start, const SegmentNearest& found,
                   dsw_segment_nearest& answer) const {
    for (const double* end : {from, to}) {
      const SeenObstacle seen = find_touched_near(env_, end, end == from ? start : found.last, found.distance);
      if (!seen.cell.valid()) continue;
      const uint32_t visited = answer.nearest.volumes_visited;
      answer.nearest = report_touched(env_, seen, end);
      answer.nearest.volumes_visited = visited;
      answer.segment_parameter = end == from ? 0 : 1;
      std::copy_n(end, D, answer.segment_point);
      return;
    }
  }

  const Environment<D>& env_;
  double radius_;
  BoundedNotes notes_;
  Cell last_;                  // where the last question was asked, or where its segment ended
  bool is_end_known_ = false;  // the segment's last point lies in last_
};

dsw_nearest& nearest_of(dsw_nearest& answer) { return answer; }
dsw_nearest& nearest_of(dsw_segment_nearest& answer) { return answer.nearest; }
template <int D>
void set_segment_point(dsw_nearest&, const double*) {}
template <int D>
void set_segment_point(dsw_segment_nearest& answer, const double* from) {
  std::copy_n(from, D, answer.segment_point);
}

/** Calls ask(batch, index, start) for what starts in a passable cell. */
template <int D, class Nearest, class IsSame, class Ask>
void for_each_nearest(const Environment<D>& env, const Parallel& parallel, size_t count, PointArray from,
                      const dsw_volume_id* hints, double radius, const NearestAnswers<Nearest>& answers, IsSame is_same,
                      Ask ask) {
  share_or_throw(
      [&](auto& chunk) { share_out(parallel, count, chunk); },
      [&](size_t begin, size_t end) {
        NearestOfBatch<D> batch(env, radius);
        for (size_t i = begin; i < end; ++i) {
          const bool is_first = i % kChunk == 0;
          if (is_first) batch.forget();
          const Cell start = batch.find_start(from[i], hints == nullptr ? nullptr : hints + i, !is_first && is_same(i));
          const dsw_location location = location_of(env, start);
          if (location == DSW_LOCATION_PASSABLE) {
            ask(batch, i, start);
          } else {
            answers.nearest[i] = {};
            const SeenObstacle seen = find_touched(env, from[i], start);
            nearest_of(answers.nearest[i]) = seen.cell.valid() ? report_touched(env, seen, from[i]) : nothing_near();
            if (seen.cell.valid()) set_segment_point<D>(answers.nearest[i], from[i]);
            batch.forget();
          }
          if (answers.volumes != nullptr) answers.volumes[i] = volume_id(env.map, start);
          if (answers.locations != nullptr) answers.locations[i] = location;
        }
      });
}

}  // namespace

template <int D>
dsw_nearest nearest_to_point(const Environment<D>& env, const double* point, Cell c, double radius) {
  if (!c.valid() || is_closed(env, c)) {
    const SeenObstacle seen = find_touched(env, point, c);
    if (!seen.cell.valid()) fail_not_free(env, "point", point, c);
    return report_touched(env, seen, point);
  }
  dsw_nearest answer;
  NearestOfBatch<D>(env, radius).ask(point, c, answer);
  return answer;
}

template <int D>
void nearest_to_points(const Environment<D>& env, const Parallel& parallel, size_t count, PointArray points,
                       const dsw_volume_id* hints, double radius, const NearestAnswers<dsw_nearest>& answers) {
  const auto is_same = [](size_t) { return false; };
  for_each_nearest(env, parallel, count, points, hints, radius, answers, is_same,
                   [&](NearestOfBatch<D>& batch, size_t i, Cell start) {  //
                     batch.ask(points[i], start, answers.nearest[i]);
                   });
}

template <int D>
void nearest_to_segments(const Environment<D>& env, const Parallel& parallel, size_t count, PointArray from,
                         PointArray to, const dsw_volume_id* hints, double radius,
                         const NearestAnswers<dsw_segment_nearest>& answers) {
  const auto is_same = [&](size_t i) { return std::memcmp(to[i - 1], from[i], D * sizeof(double)) == 0; };
  for_each_nearest(env, parallel, count, from, hints, radius, answers, is_same,
                   [&](NearestOfBatch<D>& batch, size_t i, Cell start) {  //
                     batch.ask(from[i], to[i], start, answers.nearest[i]);
                   });
}

template <int D>
void find_inside(const Environment<D>& env, const Parallel& parallel, size_t count, PointArray points,
                 const dsw_volume_id* hints, double by, double* inside, dsw_volume_id* volumes) {
  auto body = [&](size_t begin, size_t end) noexcept {
    for (size_t i = begin; i < end; ++i) {
      const Cell hint = hints == nullptr || is_null(hints[i]) ? Cell{} : env.map.cell(hints[i].index);
      const Cell c = find_inside(env, points[i], hint, by, inside + i * D);
      if (volumes != nullptr) volumes[i] = volume_id(env.map, c);
    }
  };
  share_out(parallel, count, body);
}

namespace {

template <int D>
dsw_nearest report_boundary(const Environment<D>& env, const double* point, const SignedDistance<D>& found) {
  if (!found.facet.valid()) return nothing_near();  // no place of the boundary is finite
  dsw_nearest answer{};
  answer.distance = std::fabs(found.distance);
  for (int k = 0; k < D; ++k) answer.point[k] = point[k] + found.way[k] / found.scale;
  if (std::isfinite(answer.distance)) store<D>(found.normal, answer.normal);
  const Cell c = env.map.cell_of(found.facet);
  answer.cell = name_feature(env, {D - 1, c, env.map.local_of(found.facet, c)});
  answer.tag = obstacle_tag(env, found.facet, c);
  return answer;
}

}  // namespace

template <int D>
void signed_distances(const Environment<D>& env, const Parallel& parallel, size_t count, PointArray points,
                      double* distances, dsw_nearest* nearest) {
  // A tree takes as long as some points without one for each hundred of its simplices.
  constexpr size_t kWorthTree = 16;
  Owned<BoundaryTree<D>> tree(env.memory);
  if (count >= kWorthTree && count * kWorthTree >= env.map.boundary_facet_count) tree.make(env);
  auto body = [&](size_t begin, size_t end) noexcept {
    for (size_t i = begin; i < end; ++i) {
      const SignedDistance<D> found = find_signed_distance(env, points[i], tree.get());
      distances[i] = found.distance;
      if (nearest != nullptr) nearest[i] = report_boundary(env, points[i], found);
    }
  };
  share_out(parallel, count, body);
}

DSW_INSTANTIATE(signed_distances);
template void find_inside(const Environment<2>&, const Parallel&, size_t, PointArray, const dsw_volume_id*, double,
                          double*, dsw_volume_id*);
template void find_inside(const Environment<3>&, const Parallel&, size_t, PointArray, const dsw_volume_id*, double,
                          double*, dsw_volume_id*);
DSW_INSTANTIATE(nearest_to_point);
DSW_INSTANTIATE(nearest_to_points);
DSW_INSTANTIATE(nearest_to_segments);

}  // namespace dsw
