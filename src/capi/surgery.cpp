#include "dartsweep/surgery.h"

#include <cmath>

#include "capi/convert.h"
#include "cutting/cut.h"
#include "cutting/start.h"
#include "scene/edits.h"
#include "topology/operations.h"

namespace capi = dsw::capi;
using dsw::fail;

namespace {

dsw::Blade read_blade(const dsw_cut_desc& d) {
  if (d.rows < 2 || d.columns < 2) {
    fail(DSW_STATUS_OUT_OF_RANGE, "desc->rows is %u and desc->columns is %u, must be 2 at least", d.rows, d.columns);
  }
  if (uint64_t{d.rows} * d.columns > dsw::kVertexMask) {
    fail(DSW_STATUS_TOO_LARGE, "desc->rows is %u and desc->columns is %u, together must be below 2^28 points", d.rows,
         d.columns);
  }
  const size_t count = size_t{d.rows} * d.columns;
  const dsw::Blade blade{capi::to_points(d.points, count, d.point_stride_bytes, "desc->points"), d.rows, d.columns};
  dsw::check_finite(blade.points, count, 3, {"desc->points", true});
  return blade;
}

dsw::CutSettings read_settings(const dsw_cut_desc& d) {
  capi::check_flags(d.flags, DSW_CUT_UNSEW, "desc->flags");
  if (!(d.snap >= 0 && d.snap <= 0.25)) {
    fail(DSW_STATUS_OUT_OF_RANGE, "desc->snap is %g, must be above 0 and at most 0.25, or 0", d.snap);
  }
  dsw::CutSettings settings;
  settings.unsew = (d.flags & DSW_CUT_UNSEW) != 0;
  if (d.snap != 0) settings.snap = d.snap;
  return settings;
}

/** What the host can ask for after a cut, with room for all of it. */
struct Results {
  dsw::Array<dsw_volume_change> changes;
  dsw::Array<dsw_cut_vertex> vertices;
  dsw::Array<dsw_cut_face> faces;
  dsw::Array<dsw_volume_id> whole;

  Results(const dsw::Memory* memory, const dsw::CutRecord& record, const dsw::Edit& edit)
      : changes(dsw::Allocator<dsw_volume_change>(memory)),
        vertices(dsw::Allocator<dsw_cut_vertex>(memory)),
        faces(dsw::Allocator<dsw_cut_face>(memory)),
        whole(dsw::Allocator<dsw_volume_id>(memory)) {
    changes.reserve(edit.most_changes());
    vertices.reserve(record.vertices.size());
    faces.reserve(record.faces.size());
    whole.reserve(record.whole.size());
  }

  /** After the edit is finished: ids are new. */
  void fill(const dsw::Map<3>& map, const dsw::CutRecord& record, dsw::Edit& edit) {
    for (const dsw::VolumeChange& c : edit.changes()) {
      changes.push_back({{c.before.index, c.before.generation}, {c.after.index, c.after.generation}});
    }
    for (const dsw::NewVertex& v : record.vertices) {
      vertices.push_back({capi::vertex_id(map, v.vertex),
                          {capi::vertex_id(map, v.a), capi::vertex_id(map, v.b)},
                          {1 - v.share, v.share}});
    }
    for (const dsw::CutFace& f : record.faces) faces.push_back({face_id(map, f.front), face_id(map, f.back)});
    for (const dsw::Cell c : record.whole) whole.push_back(volume_id(map, c));
  }

  /** What a tear gives. */
  void move_faces_to(dsw_environment& handle) noexcept {
    handle.changes.swap(changes);
    handle.cut_faces.swap(faces);
  }
  void move_to(dsw_environment& handle) noexcept {
    move_faces_to(handle);
    handle.cut_vertices.swap(vertices);
    handle.whole_volumes.swap(whole);
  }
};

template <class T>
void hand_out(const dsw::Array<T>& array, const T** items, size_t* count, const char* name) {
  capi::require(items, name);
  capi::require(count, "count");
  *items = array.data();
  *count = array.size();
}

}  // namespace

void dsw_cut_desc_init(dsw_cut_desc* desc, size_t size) { capi::init_struct(desc, size, dsw_cut_desc{}); }

dsw_status dsw_environment_cut(dsw_environment* environment, const dsw_cut_desc* desc, dsw_cut_report* report) {
  return capi::guard("dsw_environment_cut", [&] {
    dsw_environment& handle = capi::check_handle(environment, "environment");
    dsw_scene* const scene = capi::only_scene(handle);
    capi::require(desc, "desc");
    const dsw_cut_desc d = capi::read_struct(desc, "desc");
    const dsw::CutSettings settings = read_settings(d);
    const dsw::Blade blade = read_blade(d);
    dsw::Environment<3>& env = handle.engine;
    capi::check_hint(env.map, d.start, "desc->start");
    uint32_t visited = 0;
    const bool anywhere = d.start.index == 0 && d.start.generation == 0;
    const dsw::Cell start = find_start(env, blade, anywhere ? dsw::Cell{} : env.map.cell(d.start.index), &visited);
    dsw::Cut cut(env, blade, settings, start);
    std::optional<dsw::Edit> edit;
    cut.prepare(edit);
    const dsw::CutRecord& record = cut.record();
    Results results(env.memory, record, *edit);
    carry_out_prepared(*edit, scene == nullptr ? nullptr : &scene->engine);
    results.fill(env.map, record, *edit);
    results.move_to(handle);
    if (report == nullptr) return;
    *report = {record.distance,
               record.met,
               record.split,
               static_cast<uint32_t>(handle.whole_volumes.size()),
               record.changed,
               record.met + visited,
               static_cast<uint32_t>(handle.cut_vertices.size()),
               static_cast<uint32_t>(handle.cut_faces.size()),
               0};
  });
}

dsw_status dsw_environment_tear_faces(dsw_environment* environment, const dsw_face_id* faces, const double* loads,
                                      size_t count, double threshold, size_t* torn) {
  return capi::guard("dsw_environment_tear_faces", [&] {
    dsw_environment& handle = capi::check_handle(environment, "environment");
    dsw_scene* const scene = capi::only_scene(handle);
    capi::require_array(faces, count, "faces");
    capi::require_array(loads, count, "loads");
    if (std::isnan(threshold)) fail(DSW_STATUS_NON_FINITE, "threshold is not a number");
    dsw::Environment<3>& env = handle.engine;
    dsw::Edit edit(env);
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
    Results results(env.memory, record, edit);
    carry_out_prepared(edit, scene == nullptr ? nullptr : &scene->engine);
    results.fill(env.map, record, edit);
    results.move_faces_to(handle);
    if (torn != nullptr) *torn = record.faces.size();
  });
}

dsw_status dsw_environment_get_cut_vertices(const dsw_environment* environment, const dsw_cut_vertex** vertices,
                                            size_t* count) {
  return capi::guard("dsw_environment_get_cut_vertices", [&] {
    hand_out(capi::check_handle(environment, "environment").cut_vertices, vertices, count, "vertices");
  });
}

dsw_status dsw_environment_get_cut_faces(const dsw_environment* environment, const dsw_cut_face** faces,
                                         size_t* count) {
  return capi::guard("dsw_environment_get_cut_faces", [&] {
    hand_out(capi::check_handle(environment, "environment").cut_faces, faces, count, "faces");
  });
}

dsw_status dsw_environment_get_whole_volumes(const dsw_environment* environment, const dsw_volume_id** volumes,
                                             size_t* count) {
  return capi::guard("dsw_environment_get_whole_volumes", [&] {
    hand_out(capi::check_handle(environment, "environment").whole_volumes, volumes, count, "volumes");
  });
}
