#include "dartsweep/trace.h"

#include <cmath>

#include "capi/convert.h"
#include "snapshot/trace.h"

namespace capi = dsw::capi;
using dsw::fail;

struct dsw_trace {
  static constexpr const char* kName = "trace";
  static constexpr uint64_t kMagic = 0x6473775f74726331u;
  uint64_t magic = kMagic;
  dsw_context* context;  // may be null
  dsw::Trace engine;

  explicit dsw_trace(dsw_context* owner) : context(owner), engine(capi::memory_of(owner)) {}
};

namespace {

dsw::Trace& engine_of(dsw_trace* trace) { return capi::check_handle(trace).engine; }

void check_length(double normal_length) {
  if (!std::isfinite(normal_length)) fail(DSW_STATUS_NON_FINITE, "normal_length is %g, must be finite", normal_length);
}

}  // namespace

dsw_status dsw_trace_create(dsw_context* context, dsw_trace** trace) {
  return capi::guard(__func__, [&] {
    capi::check_context(context);
    dsw::require(trace, "trace");
    *trace = capi::create_object<dsw_trace>(capi::memory_of(context), context);
    capi::retain(context);
  });
}

dsw_status dsw_trace_destroy(dsw_trace* trace) {
  return capi::guard(__func__, [&] {
    if (trace == nullptr) return;
    dsw_context* const context = capi::check_handle(trace).context;
    capi::destroy_object(capi::memory_of(context), trace);
    capi::release(context);
  });
}

dsw_status dsw_trace_clear(dsw_trace* trace) {
  return capi::guard(__func__, [&] { clear(engine_of(trace)); });
}

dsw_status dsw_trace_add_volumes(dsw_trace* trace, const dsw_environment* environment, const dsw_volume_id* volumes,
                                 size_t count, uint32_t label) {
  return capi::guard(__func__, [&] {
    dsw::Trace& engine = engine_of(trace);
    capi::visit(capi::check_handle(environment), [&](const auto& env) {
      capi::Converted cells(env, volumes, count, "volumes");
      add_cells(engine, env, cells.data(), count, label);
    });
  });
}

dsw_status dsw_trace_add_impassable(dsw_trace* trace, const dsw_environment* environment, int with_boundary,
                                    uint32_t label) {
  return capi::guard(__func__, [&] {
    dsw::Trace& engine = engine_of(trace);
    capi::visit(capi::check_handle(environment),
                [&](const auto& env) { add_impassable(engine, env, with_boundary != 0, label); });
  });
}

dsw_status dsw_trace_add_walk(dsw_trace* trace, const dsw_environment* environment, dsw_volume_id start,
                              const double* from, const double* to, const dsw_cast_options* options,
                              double normal_length, uint32_t label) {
  return capi::guard(__func__, [&] {
    dsw::Trace& engine = engine_of(trace);
    capi::visit(capi::check_handle(environment), [&](const auto& env) {
      dsw::to_finite_point(env.kDimension, from, "from");
      dsw::to_finite_point(env.kDimension, to, "to");
      check_length(normal_length);
      capi::check_hint(env.map, start, "start");
      add_walk(engine, env, start, from, to, capi::to_options(options), normal_length, label);
    });
  });
}

dsw_status dsw_trace_add_contact(dsw_trace* trace, const dsw_flight* flight, double normal_length, uint32_t label) {
  return capi::guard(__func__, [&] {
    dsw::Trace& engine = engine_of(trace);
    dsw::require(flight, "flight");
    check_length(normal_length);
    if (flight->outcome == DSW_OUTCOME_CONTACT) {
      dsw::to_finite_point(3, flight->position, "flight->position");
      dsw::to_finite_point(3, flight->contact.normal, "flight->normal");
    }
    add_contact(engine, *flight, normal_length, label);
  });
}

dsw_status dsw_trace_get_data(const dsw_trace* trace, dsw_trace_data* data) {
  return capi::guard(__func__, [&] {
    const dsw::Trace& engine = capi::check_handle(trace).engine;
    dsw_trace_data d{};
    d.points = engine.points.data();
    d.point_count = engine.point_count();
    d.vertices = engine.vertices.data();
    d.vertex_labels = engine.vertex_labels.data();
    d.vertex_count = engine.vertex_labels.size();
    d.segments = engine.segments.data();
    d.segment_labels = engine.segment_labels.data();
    d.segment_count = engine.segment_labels.size();
    d.triangles = engine.triangles.data();
    d.triangle_labels = engine.triangle_labels.data();
    d.triangle_count = engine.triangle_labels.size();
    capi::give_struct(data, "data", d);
  });
}
