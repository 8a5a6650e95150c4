#include "environment/curve.h"

#include <algorithm>
#include <utility>

#include "base/dimensions.h"

namespace dsw {

/** A digit for each axis, from the lowest to the highest. Each chunk of keys counts its digits, and writes its keys to the
 * places that are kept for it. */
template <int D>
void sort_along_curve(Array<uint64_t>& keys, const Parallel& parallel) {
  constexpr size_t kDigits = size_t{1} << kCurveBits, kFew = size_t{1} << 18, kChunks = 16;
  const size_t chunk_size =
      keys.size() < kFew ? std::max<size_t>(keys.size(), 1) : (keys.size() + kChunks - 1) / kChunks;
  const size_t chunks = (keys.size() + chunk_size - 1) / chunk_size;
  const Parallel& shared = chunks > 1 ? parallel : kOneThread;
  Array<uint64_t> other(keys.size(), 0, keys.get_allocator());
  Array<uint32_t> counts(chunks * kDigits, 0, Allocator<uint32_t>(keys.get_allocator()));
  for (uint32_t digit = 0; digit < static_cast<uint32_t>(D); ++digit) {
    const uint32_t shift = kCurveItemBits + kCurveBits * digit;
    const auto digit_of = [shift](uint64_t key) { return key >> shift & (kDigits - 1); };
    const auto keys_of = [&](size_t chunk, auto visit) {
      const size_t end = std::min(keys.size(), (chunk + 1) * chunk_size);
      for (size_t i = chunk * chunk_size; i < end; ++i) visit(keys[i]);
    };
    auto count = [&](size_t begin, size_t end) noexcept {
      for (size_t chunk = begin; chunk < end; ++chunk) {
        uint32_t* const of_chunk = &counts[chunk * kDigits];
        std::fill_n(of_chunk, kDigits, 0u);
        keys_of(chunk, [&](uint64_t key) { ++of_chunk[digit_of(key)]; });
      }
    };
    parallel_chunks(shared, chunks, 1, count);
    uint32_t sum = 0;
    for (size_t value = 0; value < kDigits; ++value) {
      for (size_t chunk = 0; chunk < chunks; ++chunk) {
        uint32_t& first = counts[chunk * kDigits + value];
        sum += std::exchange(first, sum);
      }
    }
    auto place = [&](size_t begin, size_t end) noexcept {
      for (size_t chunk = begin; chunk < end; ++chunk) {
        uint32_t* const of_chunk = &counts[chunk * kDigits];
        keys_of(chunk, [&](uint64_t key) { other[of_chunk[digit_of(key)]++] = key; });
      }
    };
    parallel_chunks(shared, chunks, 1, place);
    keys.swap(other);
  }
}

DSW_INSTANTIATE(sort_along_curve);

}  // namespace dsw
