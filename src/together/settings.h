#pragma once
// How bodies are moved of which all vertices move at once.

#include <cstdint>

namespace dsw {

/** Who stops at a contact; see dsw_together_stop. */
enum class TogetherStop : uint32_t { kAll, kIsland, kFeature };

/** What parts do that touch, with kFeature; see dsw_together_response. */
enum class TogetherResponse : uint32_t { kStop, kSlide, kCarry };

struct TogetherSettings {
  TogetherStop stop = TogetherStop::kAll;
  TogetherResponse response = TogetherResponse::kStop;
  uint32_t rounds = 64;           // most rounds of kFeature
  uint32_t kilo_products = 8192;  // most work for each vertex, in thousands of PairWork's products
};

}  // namespace dsw
