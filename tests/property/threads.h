// Contexts of any number of threads, and a host's parallel-for that runs its tasks in any order.
#pragma once

#include "support.h"

#include <atomic>
#include <thread>

namespace dsw::oracle {

struct Shuffler {
  uint64_t seed = 1;
  int threads = 1;
  std::atomic<size_t> calls{0};
};

/// Runs the tasks in a random order, on several threads.
inline void shuffled_for(void* user, dsw_task_fn task, void* data, size_t count) {
  auto& self = *static_cast<Shuffler*>(user);
  ++self.calls;
  std::vector<size_t> order(count);
  std::iota(order.begin(), order.end(), size_t{0});
  Rng rng(self.seed + count);
  for (size_t i = count; i > 1; --i) std::swap(order[i - 1], order[rng.below(i)]);
  std::atomic<size_t> next{0};
  const auto work = [&]() {
    for (size_t i; (i = next++) < count;) task(data, order[i]);
  };
  std::vector<std::thread> pool;
  for (int i = 1; i < self.threads; ++i) pool.emplace_back(work);
  work();
  for (std::thread& t : pool) t.join();
}

inline ContextPtr context_with(uint32_t threads, Shuffler* shuffler) {
  dsw_context_desc desc = defaults(dsw_context_desc_init);
  desc.thread_count = threads;
  if (shuffler != nullptr) {
    desc.user = shuffler;
    desc.parallel_for = shuffled_for;
  }
  dsw_context* context = nullptr;
  EXPECT_EQ(dsw_context_create(&desc, &context), DSW_STATUS_OK);
  return ContextPtr(context);
}

}  // namespace dsw::oracle
