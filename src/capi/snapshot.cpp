#include "dartsweep/snapshot.h"

#include "capi/handle.h"
#include "snapshot/snapshot.h"

namespace capi = dsw::capi;
using dsw::fail;

namespace {

/** Of points that move nobody knows, and an invalid cell could not be loaded again. */
void check_all_valid(const dsw::Environment<3>& env) {
  if (!env.checked.active()) return;
  for_each_cell(env.map, [&](dsw::Cell c) {
    if (!admits(env, c)) fail(DSW_STATUS_INVALID_CELL, "volume %u is not valid", env.map.index(c));
  });
}

}  // namespace

dsw_status dsw_environment_save(const dsw_environment* environment, void* block, size_t capacity_bytes,
                                size_t* size_bytes) {
  return capi::guard("dsw_environment_save", [&] {
    const dsw::Environment<3>& env = capi::check_handle(environment, "environment").engine;
    capi::require(size_bytes, "size_bytes");
    if (capacity_bytes != 0) capi::require(block, "block");
    const size_t needed = snapshot_bytes(env);
    if (capacity_bytes != 0 && capacity_bytes < needed) {
      *size_bytes = needed;
      fail(DSW_STATUS_BUFFER_TOO_SMALL, "capacity_bytes is %zu, must be at least %zu", capacity_bytes, needed);
    }
    if (capacity_bytes != 0) {
      check_all_valid(env);
      save(env, static_cast<uint8_t*>(block));
    }
    *size_bytes = needed;
  });
}

dsw_status dsw_environment_load(dsw_context* context, const void* block, size_t size_bytes,
                                dsw_environment** environment) {
  return capi::guard("dsw_environment_load", [&] {
    capi::check_context(context);
    capi::require(block, "block");
    capi::require(environment, "environment");
    capi::EnvironmentOwner owner(context);
    load(owner->engine, static_cast<const uint8_t*>(block), size_bytes);
    *environment = owner.take();
  });
}
