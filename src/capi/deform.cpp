#include "dartsweep/deform.h"

#include "capi/convert.h"
#include "capi/moved_points.h"
#include "capi/recorded.h"
#include "scene/deformation.h"
#include "scene/surgery.h"
#include "topology/repair.h"

namespace capi = dsw::capi;
using dsw::fail;

namespace {

/** Throws where a scene was not made to deform its environment. */
template <int D>
dsw::Deformation<D>& deformation_of(const dsw::Scene<D>& scene) {
  capi::check_enabled(scene.features.deforming, "DSW_FEATURE_DEFORMING");
  return *scene.deformation.get();
}

/** The scene that deforms an environment. */
dsw_scene& deforming_scene(const dsw_environment* environment) {
  dsw_scene* const scene = capi::only_scene(capi::check_handle(environment));
  if (scene == nullptr) fail(DSW_STATUS_NOT_ENABLED, "the environment has no scene with DSW_FEATURE_DEFORMING");
  return *scene;
}

const dsw::WallRecord& record_of(const dsw_environment* environment) {
  return capi::visit(deforming_scene(environment),
                     [](const auto& engine) -> const dsw::WallRecord& { return deformation_of(engine).record; });
}

dsw::WallSettings read_settings(const dsw_deform_options& o) {
  capi::to_number(o.method, DSW_DEFORM_END_STATE, "options->method");
  capi::to_number(o.response, DSW_WALL_STOP, "options->response");
  capi::to_number(o.invalid, DSW_INVALID_REMESH, "options->invalid");
  dsw::WallSettings s;
  s.end_state = o.method == DSW_DEFORM_END_STATE;
  s.response = o.response;
  s.refuses_invalid = o.invalid == DSW_INVALID_REFUSE;
  if (s.end_state && s.response == DSW_WALL_HOLD) {
    fail(DSW_STATUS_UNSUPPORTED, "options->response is %u, must be PUSH, INSERT or STOP with END_STATE",
         capi::raw_value(o.response));
  }
  s.max_holds = capi::to_count(o.max_holds, UINT32_MAX, s.max_holds, "options->max_holds");
  s.most_halvings = capi::to_count(o.most_halvings, 10, s.most_halvings, "options->most_halvings");
  s.min_part = capi::to_min_part(o.min_part, s.min_part);
  s.point_room = o.point_room;
  return s;
}

}  // namespace

dsw_status dsw_environment_deform(dsw_environment* environment, double* next, size_t point_count,
                                  const dsw_deform_options* options, dsw_deform_report* report) {
  return capi::guard(__func__, [&] {
    dsw_scene& scene = deforming_scene(environment);
    capi::visit(scene, [&](auto& engine) {
      constexpr int D = capi::kDimension<decltype(engine)>;
      const dsw::Deformation<D>& of = deformation_of(engine);
      const dsw_deform_options o = capi::read_optional(options, "options", 0);
      const dsw::WallSettings settings = read_settings(o);
      capi::check_next(of.env, next, point_count, settings.point_room);
      [[maybe_unused]] const dsw::RepairSettings repair_settings =
          capi::to_repair_settings(o.remesh_radius, o.remesh_max_faces);
      if (D == 2 && o.invalid == DSW_INVALID_REMESH) {
        fail(DSW_STATUS_UNSUPPORTED, "options->invalid is DSW_INVALID_REMESH, must be HOLD or REFUSE in the plane");
      }
      dsw_deform_options written = o;
      written.point_room = capi::recorded_room(scene, o.point_room);
      capi::Recorded call(&scene, capi::row_of<dsw_environment_deform>, next, point_count, &written);
      uint32_t remeshed = 0;
      if constexpr (D == 3) {
        if (o.invalid == DSW_INVALID_REMESH)
          remeshed = repair_and_deform({of.env, &engine, environment->results}, next, settings, repair_settings);
      }
      if (o.invalid != DSW_INVALID_REMESH) deform(engine, next, settings);
      const dsw::WallRecord& record = of.record;
      const dsw_deform_report done = capi::to_report(record, remeshed);
      call.done(done, capi::items_of(record.held));
      if (report != nullptr) *report = done;
    });
  });
}

dsw_status dsw_environment_get_wall_contacts(const dsw_environment* environment, const dsw_wall_contact** contacts,
                                             size_t* count) {
  return capi::guard(__func__, [&] { capi::hand_out(record_of(environment).contacts, contacts, count, "contacts"); });
}

dsw_status dsw_environment_get_held_vertices(const dsw_environment* environment, const dsw_vertex_id** vertices,
                                             size_t* count) {
  return capi::guard(__func__, [&] { capi::hand_out(record_of(environment).held, vertices, count, "vertices"); });
}

dsw_status dsw_environment_get_invalid_volumes(const dsw_environment* environment, const dsw_volume_id** volumes,
                                               size_t* count) {
  return capi::guard(__func__, [&] { capi::hand_out(record_of(environment).invalid, volumes, count, "volumes"); });
}

dsw_status dsw_environment_is_valid(const dsw_environment* environment, dsw_volume_id volume, int* valid) {
  return capi::guarded_visit(__func__, environment, [&](const auto& env) {
    capi::give(valid, "valid", admits(env, capi::to_engine(env.map, volume, "volume")) ? 1 : 0);
  });
}

dsw_status dsw_environment_get_points(const dsw_environment* environment, const double** points, size_t* count) {
  return capi::guarded_visit(__func__, environment, [&](const auto& env) {
    capi::hand_out(env.points, env.map.vertex_count, points, count, "points");
  });
}
