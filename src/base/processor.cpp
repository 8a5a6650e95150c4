#include "base/processor.h"

#include <cstdlib>
#include <cstring>

#include "base/compiler.h"

namespace dsw {

bool supports(Instructions instructions) noexcept {
  if (instructions == Instructions::kPortable) return true;
#if DSW_X86_64
  if (!DSW_CPU_HAS("avx2")) return false;
  return instructions == Instructions::kAvx2 ||
         (DSW_CPU_HAS("avx512f") && DSW_CPU_HAS("avx512dq") && DSW_CPU_HAS("avx512vl"));
#else
  return false;
#endif
}

const NamedInstructions& named_instructions() noexcept {
  static const NamedInstructions named = [] {
    const char* const name = std::getenv("DARTSWEEP_KERNEL");
    for (uint32_t i = 0; name != nullptr && i < kInstructionSets; ++i) {
      const auto instructions = static_cast<Instructions>(i);
      if (std::strcmp(name, kInstructionNames[i]) == 0 && supports(instructions)) {
        return NamedInstructions{true, instructions, nullptr};
      }
    }
    const bool names_none = name == nullptr || *name == 0 || std::strcmp(name, "fastest") == 0;
    return NamedInstructions{false, Instructions::kPortable, names_none ? nullptr : name};
  }();
  return named;
}

Instructions most_instructions() noexcept {
  static const Instructions most = [] {
    if (named_instructions().is_named) return named_instructions().instructions;
    return supports(Instructions::kAvx512) ? Instructions::kAvx512
           : supports(Instructions::kAvx2) ? Instructions::kAvx2
                                           : Instructions::kPortable;
  }();
  return most;
}

const Kernels& kernels_of(Instructions instructions) noexcept {
  static const Kernels tables[kInstructionSets] = {Kernels(Instructions::kPortable), Kernels(Instructions::kAvx2),
                                                   Kernels(Instructions::kAvx512)};
  return tables[static_cast<uint32_t>(instructions)];
}

bool has_avx2_and_fma() noexcept {
#if DSW_X86_64
  return has_avx2() && DSW_CPU_HAS("fma");
#else
  return false;
#endif
}

}  // namespace dsw
