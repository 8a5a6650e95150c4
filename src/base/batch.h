#pragma once
// How batches are shared out: fixed chunks, so that results and counters do not depend on the number of threads.

#include "base/parallel.h"

namespace dsw {

constexpr size_t kChunk = 256;
/** Starting a thread costs as much as some thousand casts: without a pool of the host's, smaller batches stay here. */
constexpr size_t kWorthThreads = 2048;

constexpr size_t chunk_count(size_t count) { return (count + kChunk - 1) / kChunk; }

/** Calls body(begin, end) over 0 .. count-1; ranges begin at multiples of kChunk. */
template <class Body>
void share_out(const Parallel& parallel, size_t count, Body& body) {
  if (count <= kChunk || (parallel.run == nullptr && count < kWorthThreads)) {
    if (count != 0) body(size_t{0}, count);
  } else {
    parallel_chunks(parallel, count, kChunk, body);
  }
}

}  // namespace dsw
