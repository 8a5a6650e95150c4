#include <cmath>

#include "capi/convert.h"
#include "cutting/opening.h"
#include "dartsweep/surgery.h"
#include "scene/edits.h"

namespace capi = dsw::capi;
using dsw::fail;

namespace {

dsw::OpenSettings read_settings(const dsw_open_desc& d) {
  capi::check_flags(d.flags, 0, "desc->flags");
  if (!std::isfinite(d.width)) fail(DSW_STATUS_NON_FINITE, "desc->width is not finite");
  if (!(d.width > 0)) fail(DSW_STATUS_OUT_OF_RANGE, "desc->width is %g, must be above 0", d.width);
  return {d.width, d.region, d.tag};
}

void read_faces(const dsw::Map<3>& map, const dsw_open_desc& d, dsw::Crack& crack) {
  capi::require_array(d.faces, d.face_count, "desc->faces");
  for (size_t i = 0; i < d.face_count; ++i) {
    const dsw::HalfFacet front = capi::to_half_facet(map, d.faces[i].front, {"desc->faces", true}, i);
    crack.add(front, capi::to_half_facet(map, d.faces[i].back, {"desc->faces", true}, i), i);
  }
}

/** What the host can ask for afterwards, with room for all of it. */
struct Results {
  dsw::Array<dsw_volume_change> changes;
  dsw::Array<dsw_cut_vertex> vertices;
  dsw::Array<dsw_cut_face> faces;

  /** Before the edit is finished: vertices that come apart may go then. */
  Results(const dsw::Map<3>& map, const dsw::Memory* memory, const dsw::OpenRecord& record, const dsw::Edit& edit)
      : changes(dsw::Allocator<dsw_volume_change>(memory)),
        vertices(dsw::Allocator<dsw_cut_vertex>(memory)),
        faces(dsw::Allocator<dsw_cut_face>(memory)) {
    changes.reserve(edit.most_changes());
    faces.reserve(record.faces.size());
    for (const dsw::NewVertex& v : record.vertices) {
      vertices.push_back(
          {{v.vertex, 0}, {capi::vertex_id(map, v.a), capi::vertex_id(map, v.b)}, {1 - v.share, v.share}});
    }
  }
  /** After the edit is finished: ids are new. */
  void fill(const dsw::Map<3>& map, const dsw::OpenRecord& record, dsw::Edit& edit) {
    for (const dsw::VolumeChange& c : edit.changes()) {
      changes.push_back({{c.before.index, c.before.generation}, {c.after.index, c.after.generation}});
    }
    for (dsw_cut_vertex& v : vertices) v.vertex = capi::vertex_id(map, v.vertex.index);
    for (const dsw::CutFace& f : record.faces) faces.push_back({face_id(map, f.front), face_id(map, f.back)});
  }
  void move_to(dsw_environment& handle) noexcept {
    handle.changes.swap(changes);
    handle.cut_vertices.swap(vertices);
    handle.cut_faces.swap(faces);
  }
};

}  // namespace

void dsw_open_desc_init(dsw_open_desc* desc, size_t size) { capi::init_struct(desc, size, dsw_open_desc{}); }

dsw_status dsw_environment_open(dsw_environment* environment, const dsw_open_desc* desc, dsw_open_report* report) {
  return capi::guard("dsw_environment_open", [&] {
    dsw_environment& handle = capi::check_handle(environment, "environment");
    dsw_scene* const scene = capi::only_scene(handle);
    capi::require(desc, "desc");
    const dsw_open_desc d = capi::read_struct(desc, "desc");
    const dsw::OpenSettings settings = read_settings(d);
    dsw::Environment<3>& env = handle.engine;
    dsw::Crack crack(env, settings.region);
    read_faces(env.map, d, crack);
    crack.part();
    dsw::Opening opening(env, crack, settings);
    std::optional<dsw::Edit> edit;
    opening.prepare(edit);
    const dsw::OpenRecord& record = opening.record();
    Results results(env.map, env.memory, record, *edit);
    carry_out_prepared(*edit, scene == nullptr ? nullptr : &scene->engine);
    results.fill(env.map, record, *edit);
    results.move_to(handle);
    if (report == nullptr) return;
    *report = {record.smallest,
               record.largest,
               static_cast<uint32_t>(record.vertices.size() / 2),
               record.shortened,
               static_cast<uint32_t>(record.faces.size()),
               record.changed};
  });
}
