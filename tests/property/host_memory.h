// A host whose memory runs out where a test wants it to.
#pragma once

#include "../aligned_memory.h"
#include "body_support.h"

namespace dsw::oracle {

/// Refuses the call number `refuse`, counted from 1; 0: none.
struct Memory {
  size_t calls = 0, refuse = 0, alive = 0, bytes = 0, most = 0;  // most bytes so far
};

inline void* allocate(void* user, size_t size, size_t alignment) {
  auto& memory = *static_cast<Memory*>(user);
  if (++memory.calls == memory.refuse) return nullptr;
  ++memory.alive;
  memory.bytes += size;
  memory.most = std::max(memory.most, memory.bytes);
  return allocate_aligned(size, alignment);
}
inline void release(void* user, void* block, size_t size, size_t alignment) {
  --static_cast<Memory*>(user)->alive;
  static_cast<Memory*>(user)->bytes -= size;
  release_aligned(block, alignment);
}
inline void one_after_the_other(void*, dsw_task_fn task, void* data, size_t count) {
  for (size_t i = 0; i < count; ++i) task(data, i);
}

class MemoryTest : public BodyTest {
 protected:
  void SetUp() override {
    dsw_context_desc desc = defaults(dsw_context_desc_init);
    desc.user = &memory_;
    desc.allocate = allocate;
    desc.release = release;
    desc.parallel_for = one_after_the_other;
    dsw_context* context = nullptr;
    ASSERT_EQ(dsw_context_create(&desc, &context), DSW_STATUS_OK);
    context_.reset(context);
    place_ = place_of(hex_grid(axis(4, 1), axis(4, 1), axis(3, 1)), DSW_ENVIRONMENT_NO_LOCATE_TREE, context);
    ASSERT_PLACE(place_);
    scene_ = make_scene(place_.get());
  }
  void TearDown() override {
    scene_.reset();
    place_.environment.reset();
    context_.reset();
    EXPECT_EQ(memory_.alive, 0u);
  }

  /// Refuses one allocation later each time until `call` succeeds; `unchanged` holds after each failure.
  template <class Call, class Unchanged>
  size_t until_it_succeeds(Call call, Unchanged unchanged) {
    for (size_t refusals = 0; refusals < 2000; ++refusals) {
      memory_.refuse = memory_.calls + refusals + 1;
      const dsw_status status = call();
      memory_.refuse = 0;
      if (status == DSW_STATUS_OK) return refusals;
      EXPECT_EQ(status, DSW_STATUS_OUT_OF_MEMORY) << dsw_last_error_message();
      EXPECT_TRUE(unchanged()) << "after refusal " << refusals;
      if (HasFailure()) return refusals;
    }
    ADD_FAILURE() << "it never succeeds";
    return 0;
  }

  Memory memory_;
  ContextPtr context_;
};

}  // namespace dsw::oracle
