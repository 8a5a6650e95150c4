#pragma once
// Sharing a batch out over threads. Work is cut by index into chunks whose size does not depend on the number of
// threads, and chunks never share state, so the results have the same bits for any number of threads.

#include <cstddef>

#include "dartsweep/context.h"

namespace dsw {

struct Parallel {
  void* user = nullptr;
  dsw_parallel_for_fn run = nullptr;  // null: threads of our own, started for the call
  unsigned thread_count = 0;          // of our own; 0: one per processor
};

/** Calls body(context, begin, end) for chunks that cover 0 .. count-1. `body` must not throw. Small batches stay on the
 * calling thread. */
void parallel_chunks(const Parallel& parallel, size_t count, size_t chunk_size, void* context,
                     void (*body)(void* context, size_t begin, size_t end) noexcept);

template <class Body>
void parallel_chunks(const Parallel& parallel, size_t count, size_t chunk_size, Body& body) {
  parallel_chunks(parallel, count, chunk_size, &body,
                  [](void* context, size_t begin, size_t end) noexcept { (*static_cast<Body*>(context))(begin, end); });
}

}  // namespace dsw
