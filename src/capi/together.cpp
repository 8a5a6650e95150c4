#include "dartsweep/together.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "capi/body_access.h"
#include "capi/given_motion.h"
#include "capi/moved_bodies.h"
#include "capi/moved_points.h"
#include "capi/recorded.h"
#include "scene/deformation.h"
#include "scene/rigid_deform.h"
#include "scene/rigid_moves.h"
#include "scene/step_fraction.h"
#include "scene/together_deform.h"
#include "scene/together_moves.h"

namespace capi = dsw::capi;
using dsw::fail;

namespace {

constexpr uint32_t kMostRounds = 65536;

uint32_t to_kilo_products(uint32_t max_work) {
  return capi::to_count(max_work, UINT32_MAX, dsw::TogetherSettings().kilo_products, "options->max_work");
}

template <class Options>
dsw::TogetherSettings to_settings(const Options& o) {
  dsw::TogetherSettings s;
  s.stop = static_cast<dsw::TogetherStop>(capi::to_number(o.stop, DSW_TOGETHER_STOP_FEATURE, "options->stop"));
  s.response =
      static_cast<dsw::TogetherResponse>(capi::to_number(o.response, DSW_TOGETHER_RESPONSE_CARRY, "options->response"));
  if (s.response != dsw::TogetherResponse::kStop && s.stop != dsw::TogetherStop::kFeature) {
    fail(DSW_STATUS_UNSUPPORTED, "options->response is %u, must be STOP unless options->stop is FEATURE",
         capi::raw_value(o.response));
  }
  s.rounds = capi::to_count(o.max_rounds, kMostRounds, s.rounds, "options->max_rounds");
  s.kilo_products = to_kilo_products(o.max_work);
  return s;
}

/** Ends a call that has moved bodies. `results`: what else it has changed. */
template <int D, class... Results>
void give_reports(capi::Recorded& call, const dsw::Array<dsw::BodyRecord<D>*>& records, dsw_move_report* reports,
                  const Results&... results) {
  call.done(results..., capi::Moved<D>{records.data(), records.size()});
  for (size_t i = 0; reports != nullptr && i < records.size(); ++i) reports[i] = capi::to_report(records[i]->record);
}

template <int D>
void check_step(const double* from, const double* step, const char* name, size_t index) {
  for (int k = 0; k < D; ++k) {
    if (std::isfinite(step[k]) && std::isfinite(from[k] + step[k])) continue;
    fail(DSW_STATUS_NON_FINITE, "%s[%zu][%d] is %g and leads from %g: both must be finite, and their sum", name, index,
         k, step[k], from[k]);
  }
}

/** Steps of bodies, one after the other. Each leads to a finite place. */
template <int D>
dsw::PointArray check_steps(const dsw::Array<dsw::BodyRecord<D>*>& records, const double* steps, size_t count,
                            size_t stride_bytes) {
  size_t needed = 0, at = 0;
  for (const dsw::BodyRecord<D>* each : records) needed += each->body.vertices.size();
  if (count != needed) fail(DSW_STATUS_WRONG_SIZE, "step_count is %zu, there are %zu vertex slots", count, needed);
  const dsw::PointArray points = dsw::to_points(D, steps, count, stride_bytes, "steps");
  for (const dsw::BodyRecord<D>* each : records) {
    for (uint32_t v = 0; v < each->body.vertices.size(); ++v, ++at) {
      if (each->body.has_vertex(v)) check_step<D>(each->body.position(v), points[at], "steps", at);
    }
  }
  return points;
}

template <int D>
void check_environment_steps(const dsw::Environment<D>& env, const double* steps, size_t count) {
  const size_t needed = steps == nullptr ? 0 : env.map.vertex_count;
  if (count != needed) fail(DSW_STATUS_WRONG_SIZE, "point_count is %zu, must be %zu", count, needed);
  for (uint32_t v = 0; v < count; ++v) check_step<D>(env.point(v), steps + size_t{D} * v, "environment_steps", v);
}

}  // namespace

dsw_status dsw_scene_move_together(dsw_scene* scene, const dsw_body_id* bodies, size_t count, const double* targets,
                                   size_t target_count, size_t stride_bytes, const dsw_together_options* options,
                                   dsw_move_report* reports) {
  return capi::guarded_visit(__func__, scene, [&](auto& s) {
    constexpr int D = capi::kDimension<decltype(s)>;
    const dsw_together_options o = capi::read_optional(options, "options", 0);
    const dsw::TogetherSettings settings = to_settings(o);
    const dsw::Array<dsw::BodyRecord<D>*> records = capi::check_bodies<D>(s, bodies, count);
    const dsw::PointArray points = capi::check_all_targets(records, targets, target_count, stride_bytes);
    capi::Recorded call(scene, capi::row_of<dsw_scene_move_together>, bodies, count, targets, target_count,
                        stride_bytes, &o);
    move_together(s, records.data(), count, points, settings);
    give_reports(call, records, reports);
  });
}

namespace {

/** Motions that lead bodies to finite places. */
template <int D>
dsw::Array<dsw::RigidMove<D>> check_motions(const dsw::Scene<D>& scene, const dsw::Array<dsw::BodyRecord<D>*>& records,
                                            const dsw_rigid_motion* motions) {
  dsw::require_array(motions, records.size(), "motions");
  dsw::Array<dsw::RigidMove<D>> rigid(scene.memory);
  for (size_t i = 0; i < records.size(); ++i) {
    char name[40];
    std::snprintf(name, sizeof name, "motions[%zu].", i);
    rigid.push_back(capi::to_motion<D>(motions[i], name));
    if (stays_finite(records[i]->body, rigid[i])) continue;
    fail(DSW_STATUS_NON_FINITE, "motions[%zu] leads further than doubles go", i);
  }
  return rigid;
}

/** How rigid bodies can stop in an environment that moves. */
void check_rigid_stop(const dsw::TogetherSettings& settings, const dsw_scene_deform_options& o) {
  const bool slides = settings.response == dsw::TogetherResponse::kSlide;
  if (settings.stop == dsw::TogetherStop::kAll || (settings.stop == dsw::TogetherStop::kFeature && slides)) return;
  if (settings.stop == dsw::TogetherStop::kIsland) {
    fail(DSW_STATUS_UNSUPPORTED, "options->stop is ISLAND: all touch the same environment");
  }
  fail(DSW_STATUS_UNSUPPORTED,
       "options->response is %u, must be SLIDE where options->stop is FEATURE: rigid bodies go on as a whole",
       capi::raw_value(o.response));
}

}  // namespace

dsw_status dsw_scene_move_rigid(dsw_scene* scene, const dsw_body_id* bodies, size_t count,
                                const dsw_rigid_motion* motions, const dsw_together_options* options,
                                dsw_move_report* reports) {
  return capi::guarded_visit(__func__, scene, [&](auto& s) {
    constexpr int D = capi::kDimension<decltype(s)>;
    const dsw_together_options o = capi::read_optional(options, "options", 0);
    const dsw::TogetherSettings settings = to_settings(o);
    if (settings.stop == dsw::TogetherStop::kFeature) {
      fail(DSW_STATUS_UNSUPPORTED, "options->stop is FEATURE: rigid bodies stop as a whole");
    }
    const dsw::Array<dsw::BodyRecord<D>*> records = capi::check_bodies<D>(s, bodies, count);
    const dsw::Array<dsw::RigidMove<D>> rigid = check_motions(s, records, motions);
    capi::Recorded call(scene, capi::row_of<dsw_scene_move_rigid>, bodies, count, motions, &o);
    move_rigid_together(s, records.data(), rigid.data(), count, settings);
    give_reports(call, records, reports);
  });
}

dsw_status dsw_body_get_ways_left(const dsw_scene* scene, dsw_body_id body, const double** ways, size_t* count) {
  return capi::guarded_body(__func__, scene, body, [&](const auto& of) {
    constexpr size_t D = std::decay_t<decltype(of)>::kDimension;
    const dsw::Array<double>& left = of.record.record.ways_left;
    dsw::require(count, "count");
    capi::give(ways, "ways", left.empty() ? nullptr : left.data());
    capi::give(count, "count", left.size() / D);
  });
}

dsw_status dsw_scene_deform(dsw_scene* scene, double* next, size_t point_count, const dsw_body_id* bodies, size_t count,
                            const double* targets, size_t target_count, size_t stride_bytes,
                            const dsw_scene_deform_options* options, dsw_deform_report* report,
                            dsw_move_report* reports) {
  return capi::guarded_visit(__func__, scene, [&](auto& s) {
    constexpr int D = capi::kDimension<decltype(s)>;
    capi::check_enabled(s.features.deforming, "DSW_FEATURE_DEFORMING");
    const dsw_scene_deform_options o = capi::read_optional(options, "options", 0);
    const dsw::TogetherSettings settings = to_settings(o);
    if (settings.stop == dsw::TogetherStop::kIsland) {
      fail(DSW_STATUS_UNSUPPORTED, "options->stop is ISLAND: all touch the same environment");
    }
    capi::check_next(s.env, next, point_count, o.point_room);
    const dsw::Array<dsw::BodyRecord<D>*> records = capi::check_bodies<D>(s, bodies, count);
    const dsw::PointArray points = capi::check_all_targets(records, targets, target_count, stride_bytes);
    dsw_scene_deform_options written = o;
    written.point_room = capi::recorded_room(*scene, o.point_room);
    capi::Recorded call(scene, capi::row_of<dsw_scene_deform>, next, point_count, bodies, count, targets, target_count,
                        stride_bytes, &written);
    deform_together(s, next, o.point_room, records.data(), count, points, settings);
    const dsw::WallRecord& record = s.deformation.get()->record;
    const dsw_deform_report done = capi::to_report(record, 0);
    if (report != nullptr) *report = done;
    give_reports(call, records, reports, done);
  });
}

dsw_status dsw_scene_deform_rigid(dsw_scene* scene, double* next, size_t point_count, const dsw_body_id* bodies,
                                  size_t count, const dsw_rigid_motion* motions,
                                  const dsw_scene_deform_options* options, dsw_deform_report* report,
                                  dsw_move_report* reports) {
  return capi::guarded_visit(__func__, scene, [&](auto& s) {
    constexpr int D = capi::kDimension<decltype(s)>;
    capi::check_enabled(s.features.deforming, "DSW_FEATURE_DEFORMING");
    const dsw_scene_deform_options o = capi::read_optional(options, "options", 0);
    const dsw::TogetherSettings settings = to_settings(o);
    check_rigid_stop(settings, o);
    capi::check_next(s.env, next, point_count, o.point_room);
    const dsw::Array<dsw::BodyRecord<D>*> records = capi::check_bodies<D>(s, bodies, count);
    const dsw::Array<dsw::RigidMove<D>> rigid = check_motions(s, records, motions);
    dsw_scene_deform_options written = o;
    written.point_room = capi::recorded_room(*scene, o.point_room);
    capi::Recorded call(scene, capi::row_of<dsw_scene_deform_rigid>, next, point_count, bodies, count, motions,
                        &written);
    deform_rigid(s, next, o.point_room, records.data(), rigid.data(), count, settings);
    const dsw_deform_report done = capi::to_report(s.deformation.get()->record, 0);
    if (report != nullptr) *report = done;
    give_reports(call, records, reports, done);
  });
}

dsw_status dsw_scene_step_fraction(dsw_scene* scene, const dsw_body_id* bodies, size_t count, const double* steps,
                                   size_t step_count, size_t stride_bytes, const double* environment_steps,
                                   size_t point_count, const dsw_together_options* options, double* fraction,
                                   double* fractions, double* places, double* environment_places) {
  return capi::guarded_visit(__func__, scene, [&](auto& s) {
    constexpr int D = capi::kDimension<decltype(s)>;
    const dsw_together_options o = capi::read_optional(options, "options", 0);
    const dsw::TogetherSettings settings = to_settings(o);
    if (settings.stop == dsw::TogetherStop::kFeature) {
      fail(DSW_STATUS_UNSUPPORTED, "options->stop is FEATURE: a fraction is that of a whole island");
    }
    dsw::require(fraction, "fraction");
    const dsw::Array<dsw::BodyRecord<D>*> records = capi::check_bodies<D>(s, bodies, count);
    const dsw::PointArray points = check_steps(records, steps, step_count, stride_bytes);
    check_environment_steps(s.env, environment_steps, point_count);
    dsw::StepAnswer answer(s.memory);
    const dsw::FreeBodies<D> free(s);
    find_step_fraction(s, records.data(), count, {points, environment_steps}, settings, answer);
    *fraction = answer.fraction;
    if (fractions != nullptr) std::copy(answer.fractions.begin(), answer.fractions.end(), fractions);
    if (places != nullptr) std::copy(answer.places.begin(), answer.places.end(), places);
    if (environment_places != nullptr) {
      std::copy(answer.environment_places.begin(), answer.environment_places.end(), environment_places);
    }
  });
}
