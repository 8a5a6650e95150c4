// Any bytes as the snapshot of a scene in an environment of space or the plane. What is accepted must save to the same
// bytes, and move. A block with a wrong size or checksum is also tried with both set right, or the fuzzer would never
// get past them.

#include "use.h"

namespace {

/** Loads, compares, uses. Returns whether the block was accepted. */
bool run(bool is_planar, const uint8_t* data, size_t size) {
  if (size == 0) return false;  // where nothing is, data is null
  dsw_environment* const home = dsw_fuzz::make_home(is_planar);
  dsw_scene* scene = nullptr;
  const dsw_status status = dsw_scene_load(home, data, size, &scene);
  dsw_fuzz::require(status == DSW_STATUS_OK || status == DSW_STATUS_TRUNCATED || status == DSW_STATUS_CORRUPT ||
                        status == DSW_STATUS_BAD_VERSION,
                    "a block is loaded or refused");
  dsw_fuzz::require((status == DSW_STATUS_OK) == (scene != nullptr), "a scene exactly under OK");
  if (scene == nullptr) {
    dsw_environment_destroy(home);
    return false;
  }
  const std::vector<uint8_t> block = dsw_fuzz::save(scene);
  dsw_fuzz::require(block == std::vector<uint8_t>(data, data + size), "what loads saves as it was");
  dsw_fuzz::use_scene(scene);
  dsw_fuzz::require(dsw_scene_destroy(scene) == DSW_STATUS_OK, "the scene goes");
  dsw_fuzz::require(dsw_environment_destroy(home) == DSW_STATUS_OK, "its environment goes");
  return true;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  for (const bool is_planar : {false, true}) {
    dsw_fuzz::try_block(data, size, [=](const uint8_t* block, size_t length) { return run(is_planar, block, length); });
  }
  return 0;
}
