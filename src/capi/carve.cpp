#include "dartsweep/carve.h"

#include "capi/cut_results.h"
#include "capi/recorded.h"
#include "cutting/inside.h"
#include "cutting/start.h"
#include "scene/edits.h"

namespace capi = dsw::capi;
using dsw::fail;

namespace {

void check_count(size_t count, size_t least, const char* name) {
  if (count < least) fail(DSW_STATUS_OUT_OF_RANGE, "desc->%s is %zu, must be %zu at least", name, count, least);
  if (count >= dsw::kVertexMask) fail(DSW_STATUS_TOO_LARGE, "desc->%s is %zu, must be below 2^28", name, count);
}

template <class Desc>
capi::Points points_of(const Desc& d) {
  return {capi::to_points(d.points, d.point_count, d.point_stride_bytes, "desc->points"), d.point_count};
}

template <class Desc>
dsw::PointArray read_points(const Desc& d) {
  const dsw::PointArray points = points_of(d).points;
  dsw::check_finite(points, d.point_count, 3, {"desc->points", true});
  return points;
}

dsw::Blade read_shape(const dsw::Memory* memory, const dsw_carve_desc& d) {
  check_count(d.point_count, 1, "point_count");
  check_count(d.triangle_count, 1, "triangle_count");
  capi::require(d.triangles, "desc->triangles");
  const dsw::PointArray points = read_points(d);
  for (size_t t = 0; t < d.triangle_count; ++t) {
    const uint32_t* const c = d.triangles + 3 * t;
    for (size_t k = 0; k < 3; ++k) {
      if (c[k] < d.point_count) continue;
      fail(DSW_STATUS_INDEX_OUT_OF_RANGE, "desc->triangles[%zu] is %u; there are %zu points", 3 * t + k, c[k],
           d.point_count);
    }
    if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) {
      fail(DSW_STATUS_BAD_TOPOLOGY, "triangle %zu of desc->triangles names a point twice", t);
    }
  }
  dsw::Blade shape = dsw::Blade::of_triangles(memory, points, static_cast<uint32_t>(d.point_count), d.triangles,
                                              static_cast<uint32_t>(d.triangle_count));
  const uint32_t rim = shape.find_rim();
  if (rim != dsw::Blade::kNone) {
    fail(DSW_STATUS_BAD_TOPOLOGY, "the surface is not closed: no triangle continues it at a side of triangle %u", rim);
  }
  return shape;
}

/** The points of a loop and their mean. */
dsw::Array<double> read_loop(const dsw::Memory* memory, const dsw_tie_desc& d) {
  check_count(d.point_count, 3, "point_count");
  const dsw::PointArray points = read_points(d);
  dsw::Array<double> loop{dsw::Allocator<double>(memory)};
  loop.resize(3 * d.point_count + 3);
  for (size_t i = 0; i < d.point_count; ++i) std::copy_n(points[i], 3, &loop[3 * i]);
  const auto point = [&](uint32_t i) { return points[i]; };
  dsw::mean_point<3>(static_cast<uint32_t>(d.point_count), point, &loop[3 * d.point_count]);
  return loop;
}

}  // namespace

void dsw_carve_desc_init(dsw_carve_desc* desc, size_t size) { capi::init_struct(desc, size, dsw_carve_desc{}); }
void dsw_tie_desc_init(dsw_tie_desc* desc, size_t size) { capi::init_struct(desc, size, dsw_tie_desc{}); }

dsw_status dsw_environment_carve(dsw_environment* environment, const dsw_carve_desc* desc, dsw_carve_report* report) {
  return capi::guard("dsw_environment_carve", [&] {
    dsw_environment& handle = capi::check_handle(environment, "environment");
    dsw_scene* const scene = capi::only_scene(handle);
    capi::require(desc, "desc");
    const dsw_carve_desc d = capi::read_struct(desc, "desc");
    capi::check_flags(d.flags, DSW_CARVE_WHOLE, "desc->flags");
    dsw::CutSettings settings;
    settings.snap = capi::to_snap(d.snap);
    settings.splits = (d.flags & DSW_CARVE_WHOLE) != 0 ? dsw::Splits::kNothing : dsw::Splits::kImpassable;
    dsw::Environment<3>& env = capi::space(handle);
    const dsw::Blade shape = read_shape(env.memory, d);
    capi::check_hint(env.map, d.start, "desc->start");
    capi::Recorded call(scene, capi::Call::kCarve,
                        capi::without(d, &dsw_carve_desc::points, &dsw_carve_desc::triangles), points_of(d),
                        capi::Items<uint32_t>{d.triangles, 3 * d.triangle_count});
    dsw::Crossings crossings(env, shape);
    dsw::Inside inside(env, shape, crossings);
    uint32_t visited = 0;
    if (dsw::is_null(d.start)) {
      inside.flood_all();
    } else {
      inside.flood_from(env.map.cell(d.start.index), &visited);
    }
    dsw::Cut cut(env, shape, settings, crossings, &inside);
    std::optional<dsw::Edit<3>> edit;
    cut.prepare(edit);
    dsw::Array<dsw::Cell> carved{dsw::Allocator<dsw::Cell>(env.memory)};
    inside.carve(*edit, carved);
    const dsw::CutRecord& record = cut.record();
    capi::CutResults results(*edit, record.faces, &record.vertices, &record.whole);
    dsw::Array<dsw_volume_id> ids{dsw::Allocator<dsw_volume_id>(env.memory)};
    ids.reserve(carved.size());
    carry_out_prepared(*edit, capi::engine_of(scene));
    results.give_to(handle);
    for (const dsw::Cell c : carved) ids.push_back(volume_id(env.map, c));
    handle.carved_volumes.swap(ids);
    const dsw_carve_report done{capi::to_report(record, visited + inside.cell_count()),
                                static_cast<uint32_t>(carved.size()), 0};
    call.done(done, capi::items_of(handle.changes));
    if (report != nullptr) *report = done;
  });
}

dsw_status dsw_environment_get_carved_volumes(const dsw_environment* environment, const dsw_volume_id** volumes,
                                              size_t* count) {
  return capi::guard("dsw_environment_get_carved_volumes", [&] {
    capi::hand_out(capi::check_handle(environment, "environment").carved_volumes, volumes, count, "volumes");
  });
}

dsw_status dsw_environment_tie(dsw_environment* environment, const dsw_tie_desc* desc, dsw_tie_report* report) {
  return capi::guard("dsw_environment_tie", [&] {
    dsw_environment& handle = capi::check_handle(environment, "environment");
    dsw_scene* const scene = capi::only_scene(handle);
    capi::require(desc, "desc");
    const dsw_tie_desc d = capi::read_struct(desc, "desc");
    capi::check_flags(d.flags, 0, "desc->flags");
    dsw::CutSettings settings;
    settings.snap = capi::to_snap(d.snap);
    settings.splits = dsw::Splits::kPassable;
    settings.unsew = settings.closes = true;
    dsw::Environment<3>& env = capi::space(handle);
    const dsw::Array<double> loop = read_loop(env.memory, d);
    const dsw::Blade disc = dsw::Blade::fan(env.memory, {loop.data(), 3}, static_cast<uint32_t>(d.point_count) + 1);
    capi::check_hint(env.map, d.start, "desc->start");
    capi::Recorded call(scene, capi::Call::kTie, capi::without(d, &dsw_tie_desc::points), points_of(d));
    dsw::Crossings crossings(env, disc);
    uint32_t visited = 0;
    if (dsw::is_null(d.start)) {
      find_all(env, disc, crossings);
    } else {
      const dsw::Cell start = find_start(env, disc, env.map.cell(d.start.index), &visited);
      if (start.valid()) crossings.flood(start);
    }
    dsw::Cut cut(env, disc, settings, crossings);
    std::optional<dsw::Edit<3>> edit;
    cut.prepare(edit);
    const bool is_closed = closes(env, crossings);
    const dsw::CutRecord& record = cut.record();
    capi::CutResults results(*edit, record.faces, &record.vertices, &record.whole);
    carry_out_prepared(*edit, capi::engine_of(scene));
    results.give_to(handle);
    const dsw_tie_report done{capi::to_report(record, visited + record.met), is_closed ? 1u : 0u, 0};
    call.done(done, capi::items_of(handle.changes));
    if (report != nullptr) *report = done;
  });
}
