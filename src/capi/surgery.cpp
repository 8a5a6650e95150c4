#include "dartsweep/surgery.h"

#include <cmath>

#include "capi/cut_results.h"
#include "capi/recorded.h"
#include "cutting/start.h"
#include "scene/edits.h"
#include "topology/operations.h"

namespace capi = dsw::capi;
using dsw::fail;

namespace {

/** In the plane the chain is one point. */
template <int D>
dsw::PointArray read_points(const dsw_cut_desc& d) {
  if (d.rows < 2 || (D == 3 ? d.columns < 2 : d.columns != 1)) {
    const char* const columns = D == 3 ? "2 at least" : "1 in the plane";
    fail(DSW_STATUS_OUT_OF_RANGE, "desc->rows is %u and desc->columns is %u, must be 2 at least and %s", d.rows,
         d.columns, columns);
  }
  if (uint64_t{d.rows} * d.columns > dsw::kVertexMask) {
    fail(DSW_STATUS_TOO_LARGE, "desc->rows is %u and desc->columns is %u, together must be below 2^28 points", d.rows,
         d.columns);
  }
  const size_t count = size_t{d.rows} * d.columns;
  const dsw::PointArray points = capi::to_points<D>(d.points, count, d.point_stride_bytes, "desc->points");
  dsw::check_finite(points, count, D, {"desc->points", true});
  return points;
}

dsw::CutSettings read_settings(const dsw_cut_desc& d) {
  capi::check_flags(d.flags, DSW_CUT_UNSEW, "desc->flags");
  dsw::CutSettings settings;
  settings.unsew = (d.flags & DSW_CUT_UNSEW) != 0;
  settings.snap = capi::to_snap(d.snap);
  return settings;
}

}  // namespace

void dsw_cut_desc_init(dsw_cut_desc* desc, size_t size) { capi::init_struct(desc, size, dsw_cut_desc{}); }

dsw_status dsw_environment_cut(dsw_environment* environment, const dsw_cut_desc* desc, dsw_cut_report* report) {
  return capi::guarded_visit("dsw_environment_cut", environment, "environment", [&](auto& env) {
    constexpr int D = capi::kDimension<decltype(env)>;
    dsw_scene* const scene = capi::only_scene(*environment);
    capi::require(desc, "desc");
    const dsw_cut_desc d = capi::read_struct(desc, "desc");
    const dsw::CutSettings settings = read_settings(d);
    const dsw::PointArray points = read_points<D>(d);
    const auto blade = dsw::Blade<D>::of_grid(env.memory, points, d.rows, d.columns);
    capi::check_hint(env.map, d.start, "desc->start");
    capi::Recorded call(scene, capi::row_of<dsw_environment_cut>, &d);
    uint32_t visited = 0;
    const dsw::Cell hint = dsw::is_null(d.start) ? dsw::Cell{} : env.map.cell(d.start.index);
    const dsw::Cell start = find_start(env, blade, hint, &visited);
    dsw::Crossings<D> crossings(env, blade);
    if (start.valid()) crossings.flood(start);
    dsw::Cut<D> cut(env, blade, settings, crossings);
    std::optional<dsw::Edit<D>> edit;
    cut.prepare(edit);
    const dsw::CutRecord& record = cut.record();
    capi::CutResults results(*edit, record.faces, &record.vertices, &record.whole);
    carry_out_prepared(*edit, capi::engine_of<D>(scene));
    results.give_to(*environment);
    const dsw_cut_report done = capi::to_report(record, record.met + visited);
    call.done(done, capi::items_of(environment->changes));
    if (report != nullptr) *report = done;
  });
}

dsw_status dsw_environment_tear_faces(dsw_environment* environment, const dsw_face_id* faces, const double* loads,
                                      size_t count, double threshold, size_t* torn) {
  return capi::guarded_visit("dsw_environment_tear_faces", environment, "environment", [&](auto& env) {
    constexpr int D = capi::kDimension<decltype(env)>;
    dsw_scene* const scene = capi::only_scene(*environment);
    capi::require_array(faces, count, "faces");
    capi::require_array(loads, count, "loads");
    if (std::isnan(threshold)) fail(DSW_STATUS_NON_FINITE, "threshold is not a number");
    capi::Recorded call(scene, capi::row_of<dsw_environment_tear_faces>, faces, loads, count, threshold);
    dsw::Edit<D> edit(env);
    dsw::CutRecord record(env.memory);
    dsw::KeyTable seen(env.memory);
    for (size_t i = 0; i < count; ++i) {
      const dsw::HalfFacet h = capi::to_half_facet(env.map, faces[i], {"faces", true}, i), o = env.map.opposite(h);
      if (std::isnan(loads[i])) fail(DSW_STATUS_NON_FINITE, "loads[%zu] is not a number", i);
      if (!(loads[i] > threshold) || !o.valid()) continue;
      const uint32_t known = seen.size();
      if (seen.insert(std::min(h.word, o.word)) != known) continue;
      unsew(edit, h);
      record.faces.push_back({h, o});
    }
    edit.prepare();
    capi::CutResults results(edit, record.faces, nullptr, nullptr);
    carry_out_prepared(edit, capi::engine_of<D>(scene));
    results.give_to(*environment);
    call.done(capi::items_of(environment->changes));
    if (torn != nullptr) *torn = record.faces.size();
  });
}

dsw_status dsw_environment_get_cut_vertices(const dsw_environment* environment, const dsw_cut_vertex** vertices,
                                            size_t* count) {
  return capi::guard("dsw_environment_get_cut_vertices", [&] {
    capi::hand_out(capi::check_handle(environment, "environment").cut_vertices, vertices, count, "vertices");
  });
}

dsw_status dsw_environment_get_cut_faces(const dsw_environment* environment, const dsw_cut_face** faces,
                                         size_t* count) {
  return capi::guard("dsw_environment_get_cut_faces", [&] {
    capi::hand_out(capi::check_handle(environment, "environment").cut_faces, faces, count, "faces");
  });
}

dsw_status dsw_environment_get_whole_volumes(const dsw_environment* environment, const dsw_volume_id** volumes,
                                             size_t* count) {
  return capi::guard("dsw_environment_get_whole_volumes", [&] {
    capi::hand_out(capi::check_handle(environment, "environment").whole_volumes, volumes, count, "volumes");
  });
}
