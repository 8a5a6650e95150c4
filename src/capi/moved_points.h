#pragma once
// Where a host wants the points of an environment next, and what came of it.

#include "capi/convert.h"
#include "capi/recorded.h"
#include "walls/settings.h"

namespace dsw::capi {

/** Throws unless `next` has the points that the environment may read next. */
template <int D>
void check_next(const Environment<D>& env, const double* next, size_t point_count, size_t point_room) {
  require(next, "next");
  if (point_count != env.map.vertex_count) {
    fail(DSW_STATUS_WRONG_SIZE, "point_count is %zu, the environment has %u vertices", point_count,
         env.map.vertex_count);
  }
  if (point_room != 0 && point_room < point_count) {
    fail(DSW_STATUS_WRONG_SIZE, "options->point_room is %zu, point_count is %zu", point_room, point_count);
  }
  if (next == env.points) fail(DSW_STATUS_IN_USE, "next is the array that the environment reads now");
}

/** The room of a host's points, as a recording keeps it. */
inline size_t recorded_room(const dsw_scene& scene, size_t room) {
  return scene.watch == nullptr ? room : static_cast<size_t>(std::min<uint64_t>(scene.watch->offered, SIZE_MAX));
}

inline dsw_deform_report to_report(const WallRecord& record, uint32_t remeshed) {
  return {record.fraction,
          record.outcome,
          record.steps,
          record.near,
          static_cast<uint32_t>(record.held.size()),
          static_cast<uint32_t>(record.contacts.size()),
          static_cast<uint32_t>(record.invalid.size()),
          record.pushed,
          remeshed};
}

}  // namespace dsw::capi
