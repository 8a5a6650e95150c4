#pragma once
// Bodies and their parts as a host names them.

#include "capi/convert.h"
#include "contact/describe.h"

namespace dsw::capi {

/** The scene and one of its bodies; throws what is wrong with either. */
struct BodyAccess {
  Scene<3>& scene;
  BodyRecord<3>& record;
  Body<3>& body;

  BodyAccess(dsw_scene* handle, dsw_body_id id)
      : scene(space(check_handle(handle, "scene"))),
        record(check_body(scene, id, {"body", false})),
        body(record.body) {}
  BodyAccess(const dsw_scene* handle, dsw_body_id id) : BodyAccess(const_cast<dsw_scene*>(handle), id) {}
};

/** What a host says of a new body besides its shape, see dsw_body_desc. */
struct BodyOptions {
  SweepLevel level;
  uint32_t flags;
  double motion_share;
  uint32_t category, mask;
};
/** A description without vertices. */
BodyDescription to_description(const Scene<3>& scene, const BodyOptions& options);

uint32_t to_vertex(const Body<3>& body, dsw_body_vertex_id id, const char* name);
uint32_t to_edge(const Body<3>& body, dsw_body_edge_id id, const char* name);
uint32_t to_face(const Body<3>& body, dsw_body_face_id id, const char* name);

/** Throws NOT_NAMED unless the scene was made with a feature. */
void check_named(bool named, const char* feature);

}  // namespace dsw::capi
