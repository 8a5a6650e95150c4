// Any bytes as a snapshot. What is accepted must save to a block that loads to the same: same bytes, same casts. A
// block with a wrong size or checksum is also tried with both set right, or the fuzzer would never get past them.

#include "use.h"

namespace {

/** A few casts between corners of the box and points inside, the same for both environments. */
void compare_casts(const dsw_environment* a, const dsw_environment* b) {
  const dsw_environment_info info = dsw_fuzz::info_of(a);
  const double weights[] = {0.0, 0.25, 0.5, 0.875, 1.0};
  double ends[2][3];
  for (uint32_t n = 0; n < 20; ++n) {
    for (uint32_t k = 0; k < 3; ++k) {
      const double lower = info.lower[k], upper = info.upper[k];
      ends[0][k] = lower + weights[(n + k) % 5] * (upper - lower);
      ends[1][k] = lower + weights[(n * n + 2 * k) % 5] * (upper - lower);
    }
    const dsw_volume_id none = {0, 0};
    dsw_status status_a, status_b;
    const dsw_flight flight_a = dsw_fuzz::cast(a, none, ends[0], ends[1], &status_a);
    const dsw_flight flight_b = dsw_fuzz::cast(b, none, ends[0], ends[1], &status_b);
    dsw_fuzz::require(status_a == status_b && std::memcmp(&flight_a, &flight_b, sizeof flight_a) == 0,
                      "a copy answers with the same bits");
  }
}

/** Loads, compares, uses. Returns whether the block was accepted. */
bool run(const uint8_t* data, size_t size) {
  dsw_environment* environment = nullptr;
  const dsw_status status = dsw_environment_load(nullptr, data, size, &environment);
  dsw_fuzz::require(status != DSW_STATUS_INTERNAL, "loading has no internal error");
  dsw_fuzz::require((status == DSW_STATUS_OK) == (environment != nullptr), "an environment exactly under OK");
  if (status != DSW_STATUS_OK) return false;

  const std::vector<uint8_t> block = dsw_fuzz::save(environment);
  dsw_fuzz::require(block.size() == size && std::memcmp(block.data(), data, size) == 0, "what loads saves as it was");
  dsw_environment* copy = nullptr;
  dsw_fuzz::require(dsw_environment_load(nullptr, block.data(), block.size(), &copy) == DSW_STATUS_OK, "reload");
  compare_casts(environment, copy);
  dsw_environment_destroy(copy);

  const dsw_status check = dsw_environment_check(environment, nullptr);
  // If points move, cells may be invalid.
  dsw_fuzz::require(check == DSW_STATUS_OK || check == DSW_STATUS_BOUNDARY_CROSSES ||
                        check == DSW_STATUS_INVALID_CELL || check == DSW_STATUS_INVERTED_CELL,
                    "what was loaded is sound");
  const size_t life = size < 64 ? size : 64;
  dsw_fuzz::Bytes bytes(data + size - life, life);
  dsw_fuzz::use_environment(environment, check == DSW_STATUS_OK, &bytes);
  dsw_fuzz::require(dsw_environment_destroy(environment) == DSW_STATUS_OK, "the environment goes");
  return true;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  dsw_fuzz::try_block(data, size, run);
  return 0;
}
