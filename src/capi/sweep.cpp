#include "dartsweep/sweep.h"

#include "capi/convert.h"
#include "query/sweeps.h"

namespace capi = dsw::capi;
using dsw::fail;

namespace {

dsw::SweepOptions to_options(const dsw_sweep_options* options) {
  if (options == nullptr) return {};
  const dsw_sweep_options o = capi::read_struct(options, "options");
  dsw::check_flags(o.flags, DSW_SWEEP_START_KNOWN | DSW_SWEEP_START_FREE, "options->flags");
  return {capi::to_level(o.level, DSW_LEVEL_EDGES_SWEPT, "options->level"), o.max_volumes,
          (o.flags & DSW_SWEEP_START_KNOWN) != 0, (o.flags & DSW_SWEEP_START_FREE) != 0};
}

}  // namespace

dsw_status dsw_environment_sweep_edges(const dsw_environment* environment, size_t count, const dsw_volume_id* starts,
                                       const double* from, const double* to, const double* fixed, size_t stride_bytes,
                                       const dsw_sweep_options* options, dsw_sweep* sweeps) {
  return capi::guarded_visit(__func__, environment, [&](const auto& env) {
    const dsw::PointArray first = dsw::to_finite_points(env.kDimension, from, count, stride_bytes, "from");
    const dsw::PointArray last = dsw::to_finite_points(env.kDimension, to, count, stride_bytes, "to");
    const dsw::PointArray stays = dsw::to_finite_points(env.kDimension, fixed, count, stride_bytes, "fixed");
    dsw::require_array(sweeps, count, "sweeps");
    const dsw::SweepOptions settings = to_options(options);
    capi::check_hints(env.map, starts, count, "starts");
    sweep_edges(env, environment->parallel, count, starts, first, last, stays, settings, sweeps);
  });
}
