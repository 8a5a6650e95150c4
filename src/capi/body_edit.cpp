// Changes of bodies while they live: the second half of body.h.

#include "capi/body_access.h"
#include "capi/recorded.h"
#include "dartsweep/body.h"

namespace capi = dsw::capi;
using dsw::fail;

dsw_status dsw_body_add_vertex(dsw_scene* scene, dsw_body_id body, const double* position, dsw_volume_id hint,
                               dsw_body_vertex_id* vertex) {
  return capi::guarded_body(__func__, scene, body, [&](const auto& of) {
    dsw::require(position, "position");
    dsw::require(vertex, "vertex");
    capi::Recorded call(scene, capi::row_of<dsw_body_add_vertex>, body, position, hint);
    *vertex = vertex_id(of.body, add_body_vertex(of.scene, of.record, position, hint));
    call.done(*vertex);
  });
}

dsw_status dsw_body_add_edge(dsw_scene* scene, dsw_body_id body, dsw_body_vertex_id a, dsw_body_vertex_id b,
                             dsw_body_edge_id* edge) {
  return capi::guarded_body(__func__, scene, body, [&](const auto& of) {
    dsw::require(edge, "edge");
    const uint32_t from = capi::to_engine(of.body, a, "a"), to = capi::to_engine(of.body, b, "b");
    capi::Recorded call(scene, capi::row_of<dsw_body_add_edge>, body, a, b);
    *edge = edge_id(of.body, add_body_edge(of.scene, of.body, from, to));
    call.done(*edge);
  });
}

dsw_status dsw_body_add_face(dsw_scene* scene, dsw_body_id body, dsw_body_vertex_id a, dsw_body_vertex_id b,
                             dsw_body_vertex_id c, dsw_body_face_id* face) {
  return capi::guarded_body(__func__, scene, body, [&](const auto& of) {
    dsw::require(face, "face");
    const uint32_t corners[3] = {capi::to_engine(of.body, a, "a"), capi::to_engine(of.body, b, "b"),
                                 capi::to_engine(of.body, c, "c")};
    if constexpr (capi::kDimension<decltype(of)> == 2) {
      fail(DSW_STATUS_UNSUPPORTED, "bodies in the plane have no faces; (%u, %u, %u) cannot be one", corners[0],
           corners[1], corners[2]);
    } else {
      capi::Recorded call(scene, capi::row_of<dsw_body_add_face>, body, a, b, c);
      *face = face_id(of.body, add_body_face(of.scene, of.body, corners[0], corners[1], corners[2]));
      call.done(*face);
    }
  });
}

dsw_status dsw_body_remove_face(dsw_scene* scene, dsw_body_id body, dsw_body_face_id face) {
  return capi::guarded_body(__func__, scene, body, [&](const auto& of) {
    const uint32_t f = capi::to_engine(of.body, face, "face");
    capi::Recorded call(scene, capi::row_of<dsw_body_remove_face>, body, face);
    dsw::reserve_removals(of.body);
    remove_face(of.body, f);
    call.done();
  });
}

dsw_status dsw_body_remove_edge(dsw_scene* scene, dsw_body_id body, dsw_body_edge_id edge) {
  return capi::guarded_body(__func__, scene, body, [&](const auto& of) {
    const uint32_t e = capi::to_engine(of.body, edge, "edge");
    capi::Recorded call(scene, capi::row_of<dsw_body_remove_edge>, body, edge);
    remove_body_edge(of.scene, of.body, e);
    call.done();
  });
}

dsw_status dsw_body_remove_vertex(dsw_scene* scene, dsw_body_id body, dsw_body_vertex_id vertex) {
  return capi::guarded_body(__func__, scene, body, [&](const auto& of) {
    const uint32_t v = capi::to_engine(of.body, vertex, "vertex");
    capi::Recorded call(scene, capi::row_of<dsw_body_remove_vertex>, body, vertex);
    remove_body_vertex(of.scene, of.body, v);
    call.done();
  });
}

dsw_status dsw_body_split_edge(dsw_scene* scene, dsw_body_id body, dsw_body_edge_id edge, double share,
                               dsw_body_edit* edit) {
  return capi::guarded_body(__func__, scene, body, [&](const auto& of) {
    const uint32_t e = capi::to_engine(of.body, edge, "edge");
    capi::check_edge_parameter(share);
    capi::Recorded call(scene, capi::row_of<dsw_body_split_edge>, body, edge, share);
    split_body_edge(of.scene, of.record, e, share, edit);
    call.done(of.body);
  });
}

dsw_status dsw_body_collapse_edge(dsw_scene* scene, dsw_body_id body, dsw_body_edge_id edge, dsw_body_vertex_id vertex,
                                  dsw_body_edit* edit) {
  return capi::guarded_body(__func__, scene, body, [&](const auto& of) {
    const uint32_t e = capi::to_engine(of.body, edge, "edge"), v = capi::to_engine(of.body, vertex, "vertex");
    if (of.body.edges[e].ends[0] != v && of.body.edges[e].ends[1] != v) {
      fail(DSW_STATUS_NOT_FOUND, "vertex %u is no end of edge %u", v, e);
    }
    capi::Recorded call(scene, capi::row_of<dsw_body_collapse_edge>, body, edge, vertex);
    collapse_body_edge(of.scene, of.record, e, v, edit);
    call.done(of.body);
  });
}
