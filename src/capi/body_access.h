#pragma once
// Bodies and their parts as a host names them.

#include "capi/convert.h"
#include "capi/scene_handle.h"
#include "contact/describe.h"

namespace dsw::capi {

/** A scene and one of its bodies. */
template <int D>
struct BodyAccess {
  static constexpr int kDimension = D;

  Scene<D>& scene;
  BodyRecord<D>& record;
  Body<D>& body;
};

/** Runs the body of the entry point named `function`, a template on BodyAccess, with a scene and one of its bodies,
 * whatever the dimension; fails with what is wrong with either. */
template <class Use>
dsw_status guarded_body(const char* function, dsw_scene* scene, dsw_body_id body, const Use& use) noexcept {
  return guarded_visit(function, scene, [&](auto& s) {
    auto& record = check_body(s, body, "body");
    use(BodyAccess<kDimension<decltype(s)>>{s, record, record.body});
  });
}
/** Does that for an entry point that reads, which accepts a body that penetrates something, too. */
template <class Use>
dsw_status guarded_body(const char* function, const dsw_scene* scene, dsw_body_id body, const Use& use) noexcept {
  return guarded_visit(function, const_cast<dsw_scene*>(scene), [&](auto& s) {
    auto& record = check_body_id(s, body, "body");
    use(BodyAccess<kDimension<decltype(s)>>{s, record, record.told()});
  });
}

/** What a host says of a new body besides its shape, see dsw_body_desc. */
struct BodyOptions {
  SweepLevel level;
  uint32_t flags;
  double motion_share;
  uint32_t category, mask;
};
/** Which bodies a body can meet; 0: all categories, or the default one. */
ContactFilter to_filter(uint32_t category, uint32_t mask, bool self);
/** A description without vertices. */
template <int D>
BodyDescription to_description(const Scene<D>& scene, const BodyOptions& options);

/** The level of a body: one in the plane has no faces, and so no level for them. */
template <int D>
SweepLevel to_body_level(const dsw_level& given, const char* name) {
  if (D == 2 && raw_value(given) == DSW_LEVEL_FACES) {
    fail(DSW_STATUS_UNSUPPORTED, "%s is DSW_LEVEL_FACES: bodies in the plane have no faces", name);
  }
  return to_level(given, D == 2 ? DSW_LEVEL_EDGES_SWEPT : DSW_LEVEL_FACES, name);
}

/** The slot of a part of a body; `part` is its name. Throws STALE_ID. */
uint32_t to_slot(const SlotPool& slots, uint32_t index, uint32_t generation, const char* name, const char* part);
template <int D>
uint32_t to_engine(const Body<D>& body, dsw_body_vertex_id id, const char* name) {
  return to_slot(body.vertex_slots, id.index, id.generation, name, "vertex");
}
template <int D>
uint32_t to_engine(const Body<D>& body, dsw_body_edge_id id, const char* name) {
  return to_slot(body.edge_slots, id.index, id.generation, name, "edge");
}
template <int D>
uint32_t to_engine(const Body<D>& body, dsw_body_face_id id, const char* name) {
  return to_slot(body.face_slots, id.index, id.generation, name, "face");
}

}  // namespace dsw::capi
