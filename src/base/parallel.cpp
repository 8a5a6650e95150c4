#include "base/parallel.h"

#include <algorithm>
#include <atomic>
#include <system_error>
#include <thread>
#include <vector>

#include "base/compiler.h"
#include "base/fp_mode.h"

namespace dsw {
namespace {

struct Job {
  size_t count, chunk_size;
  void* context;
  void (*body)(void*, size_t, size_t) noexcept;

  void run_chunk(size_t chunk) const noexcept {
    const FpMode mode;  // a thread of the host may have one of its own
    const size_t begin = chunk * chunk_size;
    body(context, begin, std::min(begin + chunk_size, count));
  }
};

void run_task(void* job, size_t chunk) { static_cast<const Job*>(job)->run_chunk(chunk); }

/** Threads live for one call: starting one costs about 20 us, which a batch worth sharing repays, and an idle library
 * holds no threads. A host with a pool of its own supplies parallel_for. */
void run_on_threads(const Job& job, size_t chunk_count, unsigned thread_count) {
  std::atomic<size_t> next{0};
  const auto work = [&]() noexcept {
    for (size_t chunk; (chunk = next.fetch_add(1, std::memory_order_relaxed)) < chunk_count;) job.run_chunk(chunk);
  };
  std::vector<std::thread> helpers;
  try {
    helpers.reserve(thread_count - 1);
    for (unsigned i = 1; i < thread_count; ++i) helpers.emplace_back(work);
  } catch (const std::exception&) {
    // No more threads to be had: those that started, and this one, do all the work.
  }
  work();
  for (std::thread& helper : helpers) helper.join();
}

}  // namespace

void parallel_chunks(const Parallel& parallel, size_t count, size_t chunk_size, void* context,
                     void (*body)(void*, size_t, size_t) noexcept) {
  if (count == 0) return;
  Job job{count, chunk_size, context, body};
  const size_t chunk_count = (count + chunk_size - 1) / chunk_size;
  if (parallel.run != nullptr) {
    parallel.run(parallel.user, run_task, &job, chunk_count);
    return;
  }
  const unsigned wanted =
      parallel.thread_count != 0 ? parallel.thread_count : std::max(1u, std::thread::hardware_concurrency());
  const unsigned threads = DSW_HAS_THREADS ? static_cast<unsigned>(std::min<size_t>(wanted, chunk_count)) : 1;
  if (threads == 1) {
    body(context, 0, count);
  } else {
    run_on_threads(job, chunk_count, threads);
  }
}

}  // namespace dsw
