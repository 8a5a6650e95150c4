#pragma once
// Sharing a batch out over threads. Work is cut by index into chunks whose size does not depend on the number of
// threads, and chunks never share state, so the results have the same bits for any number of threads.

#include <atomic>
#include <cstddef>
#include <new>

#include "dartsweep/context.h"

namespace dsw {

struct Parallel {
  void* user = nullptr;
  dsw_parallel_for_fn run = nullptr;  // null: threads of our own, started for the call
  unsigned thread_count = 0;          // of our own; 0: one per processor
};

constexpr Parallel kOneThread{nullptr, nullptr, 1};

/** Calls body(context, begin, end) for chunks that cover 0 .. count-1. `body` must not throw. Small batches stay on the
 * calling thread. */
void parallel_chunks(const Parallel& parallel, size_t count, size_t chunk_size, void* context,
                     void (*body)(void* context, size_t begin, size_t end) noexcept);

template <class Body>
void parallel_chunks(const Parallel& parallel, size_t count, size_t chunk_size, Body& body) {
  parallel_chunks(parallel, count, chunk_size, &body,
                  [](void* context, size_t begin, size_t end) noexcept { (*static_cast<Body*>(context))(begin, end); });
}

/** Calls body(begin, end), which may throw std::bad_alloc: then that is thrown once all chunks are done.
 * @param share shares out what never throws, such as parallel_chunks with its first three arguments. */
template <class Share, class Body>
void share_or_throw(Share share, Body body) {
  std::atomic<bool> out_of_memory{false};
  auto chunk = [&](size_t begin, size_t end) noexcept {
    try {
      body(begin, end);
    } catch (const std::bad_alloc&) {
      out_of_memory = true;
    }
  };
  share(chunk);
  if (out_of_memory) throw std::bad_alloc();
}

/** Calls body(begin, end), which may throw std::bad_alloc, for few chunks, as each sets up memory of its own. Their number does
 * not depend on the number of threads. */
template <class Body>
void parallel_few_chunks(const Parallel& parallel, size_t count, Body body) {
  constexpr size_t kChunks = 64;
  share_or_throw([&](auto& chunk) { parallel_chunks(parallel, count, (count + kChunks - 1) / kChunks, chunk); }, body);
}

}  // namespace dsw
