#include "dartsweep/body.h"

#include <algorithm>

#include "capi/body_access.h"
#include "capi/recorded.h"
#include "scene/distances.h"

namespace capi = dsw::capi;
using dsw::fail;

namespace {

void check_thickness(const dsw::Skipping& skipping, double radius, const char* name) {
  if (radius > 0 && skipping.leaves_back_edges)
    fail(DSW_STATUS_UNSUPPORTED, "%s is %g, must be 0 with DSW_BODY_LEAVE_BACK_EDGES", name, radius);
}

template <int D>
dsw::BodyDescription to_description(const dsw::Scene<D>& scene, const dsw_body_desc& d) {
  const dsw::SweepLevel level = capi::to_body_level<D>(d.level, "desc->level");
  dsw::BodyDescription out = capi::to_description(scene, {level, d.flags, d.motion_share, d.category, d.mask});
  if (d.reserved != 0) fail(DSW_STATUS_UNSUPPORTED, "desc->reserved is %u, must be 0", d.reserved);
  if (d.vertex_count == 0) fail(DSW_STATUS_WRONG_SIZE, "desc->vertex_count is 0, must be at least 1");
  out.positions = dsw::to_points(D, d.positions, d.vertex_count, d.stride_bytes, "desc->positions");
  out.vertex_count = d.vertex_count;
  capi::check_hints(scene.env.map, d.hints, d.vertex_count, "desc->hints");
  out.hints = d.hints;
  dsw::require_array(d.edges, d.edge_count, "desc->edges");
  out.edges = d.edges;
  out.edge_count = d.edge_count;
  if (D == 2 && d.face_count != 0) {
    fail(DSW_STATUS_UNSUPPORTED, "desc->face_count is %zu: bodies in the plane have no faces", d.face_count);
  }
  dsw::require_array(d.face_offsets, d.face_count, "desc->face_offsets");
  dsw::require_array(d.face_corners, d.face_corner_count, "desc->face_corners");
  if (d.face_count != 0 && (d.face_offsets[0] != 0 || d.face_offsets[d.face_count] != d.face_corner_count)) {
    fail(DSW_STATUS_WRONG_SIZE, "desc->face_offsets go from %u to %u, must go from 0 to face_corner_count, %zu",
         d.face_offsets[0], d.face_offsets[d.face_count], d.face_corner_count);
  }
  out.face_offsets = d.face_offsets;
  out.face_corners = d.face_corners;
  out.face_count = d.face_count;
  out.face_corner_count = d.face_corner_count;
  out.radius = capi::to_length(d.radius, "desc->radius");
  check_thickness(out.skipping, out.radius, "desc->radius");
  return out;
}

}  // namespace

dsw_status dsw_body_create(dsw_scene* scene, const dsw_body_desc* desc, dsw_body_id* body) {
  return capi::guarded_visit(__func__, scene, [&](auto& s) {
    dsw::require(body, "body");
    const dsw_body_desc d = capi::read_required(desc, "desc");
    const dsw::BodyDescription description = to_description(s, d);
    capi::Recorded call(scene, capi::row_of<dsw_body_create>, &d);
    *body = create_body(s, description);
    call.done(*body);
  });
}

dsw_status dsw_scene_get_offending_edges(const dsw_scene* scene, const uint32_t** vertices, size_t* count) {
  return capi::guarded_visit(__func__, scene, [&](const auto& s) {
    capi::hand_out(s.offending.data(), s.offending.size() / 2, vertices, count, "vertices");
  });
}

dsw_status dsw_scene_get_occupant_bodies(const dsw_scene* scene, const dsw_body_id** bodies, size_t* count) {
  return capi::guarded_visit(__func__, scene,
                             [&](const auto& s) { capi::hand_out(s.occupant_bodies, bodies, count, "bodies"); });
}

dsw_status dsw_body_destroy(dsw_scene* scene, dsw_body_id body) {
  return capi::guarded_body(__func__, static_cast<const dsw_scene*>(scene), body, [&](const auto& of) {
    capi::Recorded call(scene, capi::row_of<dsw_body_destroy>, body);
    destroy_body(of.scene, body.index);
    call.done();
  });
}

dsw_status dsw_scene_get_body_count(const dsw_scene* scene, size_t* count) {
  return capi::guarded_visit(__func__, scene,
                             [&](const auto& s) { capi::give(count, "count", s.body_slots.alive_count()); });
}

dsw_status dsw_scene_get_body_ids(const dsw_scene* scene, dsw_body_id* bodies, size_t capacity, size_t* count) {
  return capi::guarded_visit(__func__, scene,
                             [&](const auto& s) { capi::copy_ids(s.body_slots, bodies, capacity, count); });
}

dsw_status dsw_body_get_counts(const dsw_scene* scene, dsw_body_id body, dsw_body_counts* counts) {
  return capi::guarded_body(__func__, scene, body, [&](const auto& of) {
    const auto& b = of.body;
    dsw_body_counts c{};
    c.vertex_count = static_cast<uint32_t>(b.vertex_slots.alive_count());
    c.edge_count = static_cast<uint32_t>(b.edge_slots.alive_count());
    c.face_count = static_cast<uint32_t>(b.face_slots.alive_count());
    c.vertex_slots = static_cast<uint32_t>(b.vertices.size());
    c.edge_slots = static_cast<uint32_t>(b.edges.size());
    c.face_slots = static_cast<uint32_t>(b.faces.size());
    capi::give_struct(counts, "counts", c);
  });
}

dsw_status dsw_body_get_level(const dsw_scene* scene, dsw_body_id body, dsw_level* level) {
  return capi::guarded_body(__func__, scene, body,
                            [&](const auto& of) { capi::give(level, "level", capi::to_public(of.body.level)); });
}

dsw_status dsw_body_set_level(dsw_scene* scene, dsw_body_id body, dsw_level level) {
  return capi::guarded_body(__func__, scene, body, [&](const auto& of) {
    const dsw::SweepLevel wanted = capi::to_body_level<capi::kDimension<decltype(of)>>(level, "level");
    capi::Recorded call(scene, capi::row_of<dsw_body_set_level>, body, level);
    set_level(of.scene, of.body, wanted);
    call.done();
  });
}

dsw_status dsw_body_get_filter(const dsw_scene* scene, dsw_body_id body, uint32_t* category, uint32_t* mask) {
  return capi::guarded_body(__func__, scene, body, [&](const auto& of) {
    dsw::require(category, "category");
    dsw::require(mask, "mask");
    capi::check_enabled(of.scene.features.contacts, "DSW_FEATURE_BODY_CONTACTS");
    *category = of.body.filter.category;
    *mask = of.body.filter.mask;
  });
}

dsw_status dsw_body_set_filter(dsw_scene* scene, dsw_body_id body, uint32_t category, uint32_t mask) {
  return capi::guarded_body(__func__, scene, body, [&](const auto& of) {
    capi::check_enabled(of.scene.features.contacts, "DSW_FEATURE_BODY_CONTACTS");
    capi::Recorded call(scene, capi::row_of<dsw_body_set_filter>, body, category, mask);
    set_filter(of.scene, of.body, capi::to_filter(category, mask, of.body.filter.self));
    call.done();
  });
}

dsw_status dsw_body_get_radius(const dsw_scene* scene, dsw_body_id body, double* radius) {
  return capi::guarded_body(__func__, scene, body,
                            [&](const auto& of) { capi::give(radius, "radius", of.body.radius); });
}

dsw_status dsw_body_set_radius(dsw_scene* scene, dsw_body_id body, double radius) {
  return capi::guarded_body(__func__, scene, body, [&](const auto& of) {
    const double wanted = capi::to_length(radius, "radius");
    check_thickness(of.body.skipping, wanted, "radius");
    capi::Recorded call(scene, capi::row_of<dsw_body_set_radius>, body, radius);
    set_radius(of.scene, of.record, wanted);
    call.done();
  });
}

dsw_status dsw_body_find_least_gap(dsw_scene* scene, dsw_body_id body, double limit, double* gap) {
  return capi::guarded_body(__func__, scene, body, [&](const auto& of) {
    const double most = capi::to_length(limit, "limit");
    const dsw::FreeBodies<capi::kDimension<decltype(of)>> free(of.scene);
    capi::give(gap, "gap", find_least_gap(of.scene, of.body, most));
  });
}

dsw_status dsw_body_get_positions(const dsw_scene* scene, dsw_body_id body, double* positions, size_t capacity,
                                  size_t stride_bytes, dsw_volume_id* volumes, size_t* count) {
  return capi::guarded_body(__func__, scene, body, [&](const auto& of) {
    constexpr int D = capi::kDimension<decltype(of)>;
    const auto& b = of.body;
    const size_t step = dsw::to_step(of.kDimension, positions, b.vertices.size(), stride_bytes, "positions");
    capi::check_capacity(b.vertices.size(), capacity, positions, count);
    for (size_t i = 0; i < b.vertices.size(); ++i) {
      std::copy_n(b.vertices[i].position, D, positions + i * step);
      if (volumes != nullptr) volumes[i] = volume_id(of.scene.env.map, b.vertices[i].cell);
    }
  });
}

dsw_status dsw_body_get_vertex_ids(const dsw_scene* scene, dsw_body_id body, dsw_body_vertex_id* vertices,
                                   size_t capacity, size_t* count) {
  return capi::guarded_body(__func__, scene, body,
                            [&](const auto& of) { capi::copy_ids(of.body.vertex_slots, vertices, capacity, count); });
}

dsw_status dsw_body_get_edge_ids(const dsw_scene* scene, dsw_body_id body, dsw_body_edge_id* edges, size_t capacity,
                                 size_t* count) {
  return capi::guarded_body(__func__, scene, body,
                            [&](const auto& of) { capi::copy_ids(of.body.edge_slots, edges, capacity, count); });
}

dsw_status dsw_body_get_untested_edges(const dsw_scene* scene, dsw_body_id body, dsw_body_edge_id* edges,
                                       size_t capacity, size_t* count) {
  return capi::guarded_body(__func__, scene, body, [&](const auto& of) {
    const auto& b = of.body;
    const auto is_listed = [&](uint32_t e) { return b.has_edge(e) && b.is_untested(e); };
    size_t listed = 0;
    for (uint32_t e = 0; e < b.untested.size(); ++e) listed += is_listed(e) ? 1 : 0;
    capi::check_capacity(listed, capacity, edges, count);
    for (uint32_t e = 0; e < b.untested.size(); ++e) {
      if (is_listed(e)) *edges++ = {e, b.edge_slots.generation(e)};
    }
  });
}

dsw_status dsw_body_get_face_ids(const dsw_scene* scene, dsw_body_id body, dsw_body_face_id* faces, size_t capacity,
                                 size_t* count) {
  return capi::guarded_body(__func__, scene, body,
                            [&](const auto& of) { capi::copy_ids(of.body.face_slots, faces, capacity, count); });
}

dsw_status dsw_body_get_vertex_id(const dsw_scene* scene, dsw_body_id body, uint32_t index,
                                  dsw_body_vertex_id* vertex) {
  return capi::guarded_body(__func__, scene, body, [&](const auto& of) {
    const auto& b = of.body;
    if (index >= b.vertices.size() || !b.vertex_slots.alive(index, b.vertex_slots.generation(index))) {
      fail(DSW_STATUS_OUT_OF_RANGE, "index is %u, which names no vertex; there are %zu slots", index,
           b.vertices.size());
    }
    capi::give(vertex, "vertex", vertex_id(b, index));
  });
}

dsw_status dsw_body_get_edge_indices(const dsw_scene* scene, dsw_body_id body, uint32_t* vertices, size_t capacity,
                                     size_t* count) {
  return capi::guarded_body(__func__, scene, body, [&](const auto& of) {
    const auto& b = of.body;
    capi::check_capacity(b.edges.size(), capacity, vertices, count);
    for (size_t e = 0; e < b.edges.size(); ++e) std::copy_n(b.edges[e].ends, 2, vertices + 2 * e);
  });
}

dsw_status dsw_body_get_face_indices(const dsw_scene* scene, dsw_body_id body, uint32_t* vertices, size_t capacity,
                                     size_t* count) {
  return capi::guarded_body(__func__, scene, body, [&](const auto& of) {
    const auto& b = of.body;
    capi::check_capacity(b.faces.size(), capacity, vertices, count);
    for (size_t f = 0; f < b.faces.size(); ++f) std::copy_n(b.faces[f].corners, 3, vertices + 3 * f);
  });
}

dsw_status dsw_body_get_edge_ends(const dsw_scene* scene, dsw_body_id body, dsw_body_edge_id edge,
                                  dsw_body_vertex_id* vertices) {
  return capi::guarded_body(__func__, scene, body, [&](const auto& of) {
    const auto& b = of.body;
    dsw::require(vertices, "vertices");
    const uint32_t e = capi::to_engine(b, edge, "edge");
    for (int k = 0; k < 2; ++k) vertices[k] = vertex_id(b, b.edges[e].ends[k]);
  });
}

dsw_status dsw_body_get_face_corners(const dsw_scene* scene, dsw_body_id body, dsw_body_face_id face,
                                     dsw_body_vertex_id* vertices) {
  return capi::guarded_body(__func__, scene, body, [&](const auto& of) {
    const auto& b = of.body;
    dsw::require(vertices, "vertices");
    const uint32_t f = capi::to_engine(b, face, "face");
    for (int k = 0; k < 3; ++k) vertices[k] = vertex_id(b, b.faces[f].corners[k]);
  });
}
