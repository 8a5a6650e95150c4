#include <algorithm>
#include <thread>

#include "capi/describe.h"
#include "capi/handle.h"

namespace capi = dsw::capi;

namespace {

/** Null: those that are fastest. */
const dsw::Kernels* kernels_for(const dsw_context_desc& desc) {
  if (desc.reserved != 0) dsw::fail(DSW_STATUS_UNSUPPORTED, "desc->reserved is %u, must be 0", desc.reserved);
  if (desc.kernel == DSW_KERNEL_FASTEST) return nullptr;
  const uint32_t instructions = desc.kernel - DSW_KERNEL_PORTABLE;
  if (instructions >= dsw::kInstructionSets) {
    dsw::fail(DSW_STATUS_UNSUPPORTED, "desc->kernel is %u, which is no dsw_kernel", desc.kernel);
  }
  if (!dsw::supports(static_cast<dsw::Instructions>(instructions))) {
    dsw::fail(DSW_STATUS_UNSUPPORTED, "this processor has not what kernel %s needs",
              dsw::kInstructionNames[instructions]);
  }
  return &dsw::kernels_of(static_cast<dsw::Instructions>(instructions));
}

}  // namespace

dsw_status dsw_context_create(const dsw_context_desc* desc, dsw_context** context) {
  return capi::guard(__func__, [&] {
    dsw::require(context, "context");
    const dsw_context_desc d = capi::read_optional(desc, "desc");
    constexpr uint32_t kMostThreads = 256;
    if (d.thread_count > kMostThreads) {
      dsw::fail(DSW_STATUS_OUT_OF_RANGE, "desc->thread_count is %u, must be 0 .. %u", d.thread_count, kMostThreads);
    }
    if ((d.allocate == nullptr) != (d.release == nullptr)) {
      dsw::fail(DSW_STATUS_OUT_OF_RANGE, "desc->allocate and desc->release must be set both or none");
    }
    const dsw::Kernels* const kernels = kernels_for(d);
    const dsw::Memory memory{d.user, d.allocate, d.release};
    dsw_context* const made = capi::create_object<dsw_context>(&memory);
    made->memory = memory;
    made->parallel.user = d.user;
    made->parallel.run = d.parallel_for;
    made->parallel.thread_count = d.thread_count != 0
                                      ? d.thread_count
                                      : std::min(kMostThreads, std::max(1u, std::thread::hardware_concurrency()));
    made->kernels = kernels;
    made->log = d.log;
    made->user = d.user;
    if (const char* const name = dsw::named_instructions().refused) {
      capi::log_line(made, DSW_LOG_WARNING,
                     "DARTSWEEP_KERNEL is \"%s\", which names no kernel that this processor has: it is ignored", name);
    }
    *context = made;
  });
}

dsw_status dsw_context_destroy(dsw_context* context) {
  return capi::guard(__func__, [&] {
    if (context == nullptr) return;
    capi::check_handle(context);
    const uint32_t users = context->users.load(std::memory_order_acquire);
    if (users != 0) dsw::fail(DSW_STATUS_IN_USE, "context is still used by %u environments or traces", users);
    const dsw::Memory memory = context->memory;
    capi::destroy_object(&memory, context);
  });
}
