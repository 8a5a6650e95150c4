#include "dartsweep/sweep.h"

#include "capi/convert.h"
#include "query/sweeps.h"

namespace capi = dsw::capi;
using dsw::fail;

namespace {

dsw_sweep_options default_sweep() noexcept {
  dsw_sweep_options o{};
  o.level = DSW_LEVEL_EDGES_SWEPT;
  return o;
}

dsw::SweepOptions to_options(const dsw_sweep_options* options) {
  if (options == nullptr) return {};
  const dsw_sweep_options o = capi::read_struct(options, "options");
  capi::check_flags(o.flags, DSW_SWEEP_START_KNOWN | DSW_SWEEP_START_FREE, "options->flags");
  return {capi::to_level(o.level, DSW_LEVEL_EDGES_SWEPT, "options->level"), o.max_volumes,
          (o.flags & DSW_SWEEP_START_KNOWN) != 0, (o.flags & DSW_SWEEP_START_FREE) != 0};
}

}  // namespace

void dsw_sweep_options_init(dsw_sweep_options* options, size_t size) {
  capi::init_struct(options, size, default_sweep());
}

dsw_status dsw_environment_sweep_edges(const dsw_environment* environment, size_t count, const dsw_volume_id* starts,
                                       const double* from, const double* to, const double* fixed, size_t stride_bytes,
                                       const dsw_sweep_options* options, dsw_sweep* sweeps) {
  return capi::guarded_visit(__func__, environment, [&](const auto& env) {
    constexpr int D = capi::kDimension<decltype(env)>;
    const dsw::PointArray first = capi::to_finite_points<D>(from, count, stride_bytes, "from");
    const dsw::PointArray last = capi::to_finite_points<D>(to, count, stride_bytes, "to");
    const dsw::PointArray stays = capi::to_finite_points<D>(fixed, count, stride_bytes, "fixed");
    capi::require_array(sweeps, count, "sweeps");
    const dsw::SweepOptions settings = to_options(options);
    capi::check_hints(env.map, starts, count, "starts");
    sweep_edges(env, environment->parallel, count, starts, first, last, stays, settings, sweeps);
  });
}
