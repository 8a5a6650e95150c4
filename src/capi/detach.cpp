#include "dartsweep/detach.h"

#include "capi/body_access.h"
#include "capi/recorded.h"
#include "scene/detachment.h"

namespace capi = dsw::capi;
using dsw::fail;

namespace {

constexpr uint32_t kMostHalvings = 40;

dsw_detach_desc default_detachment() noexcept {
  dsw_detach_desc d{};
  d.level = DSW_LEVEL_EDGES_SWEPT;
  return d;
}

void check_numbers(const dsw_detach_desc& d) {
  if (!(d.gap >= 0 && d.gap <= 0.25)) {
    fail(DSW_STATUS_OUT_OF_RANGE, "desc->gap is %g, must be above 0 and at most 0.25, or 0", d.gap);
  }
  if (d.halvings > kMostHalvings) {
    fail(DSW_STATUS_OUT_OF_RANGE, "desc->halvings is %u, must be %u at most", d.halvings, kMostHalvings);
  }
}

/** What the host can ask for afterwards, with room for all of it. */
struct Results {
  dsw::Array<dsw_volume_id> volumes;
  dsw::Array<dsw_detached_vertex> vertices;
  dsw::Array<dsw_detached_face> faces;

  Results(const dsw::Memory* memory, const dsw::Detachment& of)
      : volumes(dsw::Allocator<dsw_volume_id>(memory)),
        vertices(dsw::Allocator<dsw_detached_vertex>(memory)),
        faces(dsw::Allocator<dsw_detached_face>(memory)) {
    volumes.reserve(of.piece().size());
    vertices.reserve(of.surface().vertices.size());
    faces.reserve(of.surface().triangles.size());
  }

  void fill(const dsw::Map<3>& map, const dsw::Detachment& of) noexcept {
    for (size_t i = 0; i < of.piece().size(); ++i) volumes.push_back(volume_id(map, of.piece()[i]));
    for (const dsw::SurfaceVertex& v : of.surface().vertices) {
      const double first = v.from[0] == v.from[1] ? 1 : 0.5;
      vertices.push_back({{capi::vertex_id(map, v.from[0]), capi::vertex_id(map, v.from[1])}, {first, 1 - first}});
    }
    for (const dsw::SurfaceTriangle& t : of.surface().triangles) {
      faces.push_back({face_id(map, canonical(map, t.facet)), volume_id(map, map.cell_of(t.facet))});
    }
  }
};

/** After the cracks were sewn. */
uint32_t count_unsewn(const dsw::Map<3>& map, const dsw::Piece& piece) {
  uint32_t count = 0;
  for (size_t i = 0; i < piece.size(); ++i) {
    for (uint32_t f = 0, facets = map.facets_of(piece[i]); f < facets; ++f) {
      count += map.opposite(map.half_facet(piece[i], f)).valid() ? 0u : 1u;
    }
  }
  return count;
}

}  // namespace

void dsw_detach_desc_init(dsw_detach_desc* desc, size_t size) { capi::init_struct(desc, size, default_detachment()); }

dsw_status dsw_scene_detach(dsw_scene* scene, const dsw_detach_desc* desc, dsw_body_id* body,
                            dsw_detach_report* report) {
  return capi::guard("dsw_scene_detach", [&] {
    dsw_scene& handle = capi::check_handle(scene, "scene");
    dsw_environment& home = *handle.environment;
    capi::only_scene(home);
    capi::require(desc, "desc");
    capi::require(body, "body");
    const dsw_detach_desc d = capi::read_struct(desc, "desc");
    check_numbers(d);
    const dsw::SweepLevel level = capi::to_level(d.level, DSW_LEVEL_FACES, "desc->level");
    const dsw::BodyDescription like =
        capi::to_description(capi::space(handle), {level, d.flags, d.motion_share, d.category, d.mask});
    dsw::Environment<3>& env = capi::space(home);
    const dsw::Cell start = capi::to_cell(env.map, d.volume, {"desc->volume", false});
    capi::Recorded call(scene, capi::row_of<dsw_scene_detach>, &d);
    dsw::Detachment detachment(env, capi::space(handle), start, d.max_volumes == 0 ? SIZE_MAX : d.max_volumes);
    Results results(env.memory, detachment);
    const double gap = d.gap == 0 ? 0.01 : d.gap;
    const uint32_t halvings = d.halvings == 0 ? 32 : d.halvings;
    *body = detachment.carry_out(like, gap, 2 * (2 * halvings + 1));
    results.fill(env.map, detachment);
    home.changes.clear();
    handle.detached_volumes.swap(results.volumes);
    handle.detached_vertices.swap(results.vertices);
    handle.detached_faces.swap(results.faces);
    const dsw_detach_report done{detachment.distance(),
                                 static_cast<uint32_t>(handle.detached_volumes.size()),
                                 static_cast<uint32_t>(handle.detached_vertices.size()),
                                 static_cast<uint32_t>(handle.detached_faces.size()),
                                 static_cast<uint32_t>(detachment.piece().cracks().size()),
                                 count_unsewn(env.map, detachment.piece()),
                                 0};
    call.done(*body, done);
    if (report != nullptr) *report = done;
  });
}

dsw_status dsw_scene_get_detached_volumes(const dsw_scene* scene, const dsw_volume_id** volumes, size_t* count) {
  return capi::guard("dsw_scene_get_detached_volumes", [&] {
    capi::hand_out(capi::check_handle(scene, "scene").detached_volumes, volumes, count, "volumes");
  });
}

dsw_status dsw_scene_get_detached_vertices(const dsw_scene* scene, const dsw_detached_vertex** vertices,
                                           size_t* count) {
  return capi::guard("dsw_scene_get_detached_vertices", [&] {
    capi::hand_out(capi::check_handle(scene, "scene").detached_vertices, vertices, count, "vertices");
  });
}

dsw_status dsw_scene_get_detached_faces(const dsw_scene* scene, const dsw_detached_face** faces, size_t* count) {
  return capi::guard("dsw_scene_get_detached_faces",
                     [&] { capi::hand_out(capi::check_handle(scene, "scene").detached_faces, faces, count, "faces"); });
}
