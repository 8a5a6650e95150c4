#include "dartsweep/snapshot.h"

#include "capi/handle.h"
#include "capi/scene_handle.h"
#include "snapshot/scene_snapshot.h"
#include "snapshot/snapshot.h"

namespace capi = dsw::capi;
using dsw::fail;

namespace {

/** Writes what is saved to the host's block, if that is large enough. */
template <class Saved>
void save_to(const Saved& saved, void* block, size_t capacity_bytes, size_t* size_bytes) {
  dsw::require(size_bytes, "size_bytes");
  if (capacity_bytes != 0) dsw::require(block, "block");
  const size_t needed = snapshot_bytes(saved);
  if (capacity_bytes != 0 && capacity_bytes < needed) {
    *size_bytes = needed;
    fail(DSW_STATUS_BUFFER_TOO_SMALL, "capacity_bytes is %zu, must be at least %zu", capacity_bytes, needed);
  }
  if (capacity_bytes != 0) save(saved, static_cast<uint8_t*>(block));
  *size_bytes = needed;
}

}  // namespace

dsw_status dsw_environment_save(const dsw_environment* environment, void* block, size_t capacity_bytes,
                                size_t* size_bytes) {
  return capi::guarded_visit(__func__, environment,
                             [&](const auto& env) { save_to(env, block, capacity_bytes, size_bytes); });
}

dsw_status dsw_environment_load(dsw_context* context, const void* block, size_t size_bytes,
                                dsw_environment** environment) {
  return capi::guard(__func__, [&] {
    capi::check_context(context);
    dsw::require(block, "block");
    dsw::require(environment, "environment");
    *environment = capi::load_environment(context, static_cast<const uint8_t*>(block), size_bytes);
  });
}

dsw_status dsw_scene_save(const dsw_scene* scene, void* block, size_t capacity_bytes, size_t* size_bytes) {
  return capi::guarded_visit(__func__, scene,
                             [&](const auto& engine) { save_to(engine, block, capacity_bytes, size_bytes); });
}

dsw_status dsw_scene_load(dsw_environment* environment, const void* block, size_t size_bytes, dsw_scene** scene) {
  return capi::guard(__func__, [&] {
    dsw_environment& home = capi::check_handle(environment);
    dsw::require(block, "block");
    dsw::require(scene, "scene");
    *scene = capi::load_scene(home, static_cast<const uint8_t*>(block), size_bytes);
  });
}
