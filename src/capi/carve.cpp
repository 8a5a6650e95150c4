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

template <int D, class Desc>
dsw::PointArray read_points(const Desc& d) {
  const dsw::PointArray points = capi::to_points<D>(d.points, d.point_count, d.point_stride_bytes, "desc->points");
  dsw::check_finite(points, d.point_count, D, {"desc->points", true});
  return points;
}

/** Of triangles; in the plane of segments. */
template <int D>
dsw::Blade<D> read_shape(const dsw::Memory* memory, const dsw_carve_desc& d) {
  const char* const simplex = D == 3 ? "triangle" : "segment";
  check_count(d.point_count, 1, "point_count");
  check_count(d.triangle_count, 1, "triangle_count");
  capi::require(d.triangles, "desc->triangles");
  const dsw::PointArray points = read_points<D>(d);
  for (size_t s = 0; s < d.triangle_count; ++s) {
    const uint32_t* const c = d.triangles + D * s;
    for (size_t k = 0; k < D; ++k) {
      if (c[k] < d.point_count) continue;
      fail(DSW_STATUS_INDEX_OUT_OF_RANGE, "desc->triangles[%zu] is %u; there are %zu points", D * s + k, c[k],
           d.point_count);
    }
    if (c[0] == c[1] || (D == 3 && (c[1] == c[2] || c[2] == c[0]))) {
      fail(DSW_STATUS_BAD_TOPOLOGY, "%s %zu of desc->triangles names a point twice", simplex, s);
    }
  }
  auto shape = dsw::Blade<D>::of_simplices(memory, points, static_cast<uint32_t>(d.point_count), d.triangles,
                                           static_cast<uint32_t>(d.triangle_count));
  const uint32_t rim = shape.find_rim();
  if (rim != dsw::Blade<D>::kNone) {
    fail(DSW_STATUS_BAD_TOPOLOGY, "the surface is not closed: no %s continues it at a side of %s %u", simplex, simplex,
         rim);
  }
  return shape;
}

/** What a ligature spans, with the points that this takes: a loop's and their mean; in the plane those of a line. */
template <int D>
class Ligature {
 public:
  Ligature(const dsw::Memory* memory, const dsw_tie_desc& d) : points_(dsw::Allocator<double>(memory)) {
    check_count(d.point_count, D, "point_count");
    const dsw::PointArray points = read_points<D>(d);
    const auto count = static_cast<uint32_t>(d.point_count);
    if constexpr (D == 2) {
      blade_.emplace(dsw::Blade<2>::of_grid(memory, points, count, 1));
    } else {
      points_.resize(3 * d.point_count + 3);
      for (size_t i = 0; i < d.point_count; ++i) std::copy_n(points[i], 3, &points_[3 * i]);
      dsw::mean_point<3>(
          count, [&](uint32_t i) { return points[i]; }, &points_[3 * d.point_count]);
      blade_.emplace(dsw::Blade<3>::fan(memory, {points_.data(), 3}, count + 1));
    }
  }
  const dsw::Blade<D>& blade() const { return *blade_; }

 private:
  dsw::Array<double> points_;
  std::optional<dsw::Blade<D>> blade_;
};

}  // namespace

void dsw_carve_desc_init(dsw_carve_desc* desc, size_t size) { capi::init_struct(desc, size, dsw_carve_desc{}); }
void dsw_tie_desc_init(dsw_tie_desc* desc, size_t size) { capi::init_struct(desc, size, dsw_tie_desc{}); }

dsw_status dsw_environment_carve(dsw_environment* environment, const dsw_carve_desc* desc, dsw_carve_report* report) {
  return capi::guarded_visit("dsw_environment_carve", environment, "environment", [&](auto& env) {
    constexpr int D = capi::kDimension<decltype(env)>;
    dsw_scene* const scene = capi::only_scene(*environment);
    capi::require(desc, "desc");
    const dsw_carve_desc d = capi::read_struct(desc, "desc");
    capi::check_flags(d.flags, DSW_CARVE_WHOLE, "desc->flags");
    dsw::CutSettings settings;
    settings.snap = capi::to_snap(d.snap);
    settings.splits = (d.flags & DSW_CARVE_WHOLE) != 0 ? dsw::Splits::kNothing : dsw::Splits::kImpassable;
    const dsw::Blade<D> shape = read_shape<D>(env.memory, d);
    capi::check_hint(env.map, d.start, "desc->start");
    capi::Recorded call(scene, capi::row_of<dsw_environment_carve>, &d);
    dsw::Crossings<D> crossings(env, shape);
    dsw::Inside<D> inside(env, shape, crossings);
    uint32_t visited = 0;
    if (dsw::is_null(d.start)) {
      inside.flood_all();
    } else {
      inside.flood_from(env.map.cell(d.start.index), &visited);
    }
    dsw::Cut<D> cut(env, shape, settings, crossings, &inside);
    std::optional<dsw::Edit<D>> edit;
    cut.prepare(edit);
    dsw::Array<dsw::Cell> carved{dsw::Allocator<dsw::Cell>(env.memory)};
    inside.carve(*edit, carved);
    const dsw::CutRecord& record = cut.record();
    capi::CutResults results(*edit, record.faces, &record.vertices, &record.whole);
    dsw::Array<dsw_volume_id> ids{dsw::Allocator<dsw_volume_id>(env.memory)};
    ids.reserve(carved.size());
    carry_out_prepared(*edit, capi::engine_of<D>(scene));
    results.give_to(*environment);
    for (const dsw::Cell c : carved) ids.push_back(volume_id(env.map, c));
    environment->carved_volumes.swap(ids);
    const dsw_carve_report done{capi::to_report(record, visited + inside.cell_count()),
                                static_cast<uint32_t>(carved.size()), 0};
    call.done(done, capi::items_of(environment->changes));
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
  return capi::guarded_visit("dsw_environment_tie", environment, "environment", [&](auto& env) {
    constexpr int D = capi::kDimension<decltype(env)>;
    dsw_scene* const scene = capi::only_scene(*environment);
    capi::require(desc, "desc");
    const dsw_tie_desc d = capi::read_struct(desc, "desc");
    capi::check_flags(d.flags, 0, "desc->flags");
    dsw::CutSettings settings;
    settings.snap = capi::to_snap(d.snap);
    settings.splits = dsw::Splits::kPassable;
    settings.unsew = settings.closes = true;
    const Ligature<D> ligature(env.memory, d);
    const dsw::Blade<D>& disc = ligature.blade();
    capi::check_hint(env.map, d.start, "desc->start");
    capi::Recorded call(scene, capi::row_of<dsw_environment_tie>, &d);
    dsw::Crossings<D> crossings(env, disc);
    uint32_t visited = 0;
    if (dsw::is_null(d.start)) {
      find_all(env, disc, crossings);
    } else {
      const dsw::Cell start = find_start(env, disc, env.map.cell(d.start.index), &visited);
      if (start.valid()) crossings.flood(start);
    }
    dsw::Cut<D> cut(env, disc, settings, crossings);
    std::optional<dsw::Edit<D>> edit;
    cut.prepare(edit);
    const bool is_closed = closes(env, crossings);
    const dsw::CutRecord& record = cut.record();
    capi::CutResults results(*edit, record.faces, &record.vertices, &record.whole);
    carry_out_prepared(*edit, capi::engine_of<D>(scene));
    results.give_to(*environment);
    const dsw_tie_report done{capi::to_report(record, visited + record.met), is_closed ? 1u : 0u, 0};
    call.done(done, capi::items_of(environment->changes));
    if (report != nullptr) *report = done;
  });
}
