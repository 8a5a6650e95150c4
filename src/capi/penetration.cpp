// Bodies that are created where they are not free: the functions of body.h about penetrations.

#include <limits>

#include "capi/body_access.h"
#include "capi/recorded.h"
#include "scene/depenetration.h"
#include "scene/penetrations.h"

namespace capi = dsw::capi;
using dsw::fail;

dsw_status dsw_body_is_penetrating(const dsw_scene* scene, dsw_body_id body, uint32_t* penetrating) {
  return capi::guarded_body(__func__, scene, body, [&](const auto& of) {
    capi::give(penetrating, "penetrating", of.record.is_penetrating() ? 1u : 0u);
  });
}

dsw_status dsw_body_find_penetrations(dsw_scene* scene, dsw_body_id body, const dsw_penetration** penetrations,
                                      size_t* count) {
  const dsw_scene* const reads = scene;  // a body that penetrates something is accepted
  return capi::guarded_body(__func__, reads, body, [&](const auto& of) {
    dsw::require(penetrations, "penetrations");
    dsw::require(count, "count");
    const dsw::FreeBodies<capi::kDimension<decltype(of)>> free(of.scene);
    list_penetrations(of.scene, of.record);
    capi::hand_out(of.scene.penetrations, penetrations, count, "penetrations");
  });
}

dsw_status dsw_body_depenetrate(dsw_scene* scene, dsw_body_id body, dsw_volume_id inside, double max_distance,
                                uint32_t* freed, double* distance) {
  const dsw_scene* const reads = scene;
  return capi::guarded_body(__func__, reads, body, [&](const auto& of) {
    dsw::require(freed, "freed");
    const dsw::Cell side = capi::to_hint(of.scene.env.map, inside, "inside");
    if (side.valid() && is_closed(of.scene.env, side))
      fail(DSW_STATUS_IMPASSABLE, "inside {index %u, generation %u} is impassable", inside.index, inside.generation);
    const double given = capi::to_length(max_distance, "max_distance");
    const double limit = given > 0 ? given : std::numeric_limits<double>::infinity();
    capi::Recorded call(scene, capi::row_of<dsw_body_depenetrate>, body, inside, max_distance);
    const dsw::DepenetrationResult result = depenetrate(of.scene, of.record, side, limit);
    *freed = result.freed ? 1 : 0;
    if (distance != nullptr) *distance = result.distance;
    call.done(*freed, result.distance);
  });
}
