#include "capi/change.h"
#include "scene/surgery.h"
#include "topology/repair.h"

namespace capi = dsw::capi;
using dsw::fail;

dsw_status dsw_environment_remesh(dsw_environment* environment, const dsw_remesh_desc* desc, dsw_change* out) {
  return capi::guarded_change_of_space(__func__, environment, nullptr, out, [&](auto& change) {
    const dsw_remesh_desc d = capi::read_optional(desc, "desc", 0);
    const size_t points = d.next == nullptr ? 0 : change.map().vertex_count;
    if (d.point_count != points) {
      fail(DSW_STATUS_WRONG_SIZE, "desc->point_count is %zu, must be %zu", d.point_count, points);
    }
    dsw::require_array(d.volumes, d.volume_count, "desc->volumes");
    const dsw::RepairSettings settings = capi::to_repair_settings(d.radius, d.max_faces);
    change.record(capi::row_of<dsw_environment_remesh>, &d);
    dsw::Repair repair(change.env, d.next, settings);
    for (size_t i = 0; i < d.volume_count; ++i) {
      repair.want(capi::to_engine(change.map(), d.volumes[i], {"desc->volumes", true}, i));
    }
    if (d.volumes == nullptr) repair.want_all();
    repair_cells(change, repair);
    change.tell();
  });
}
