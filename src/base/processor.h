#pragma once
// What this processor can run. Of a function with several forms one is chosen once; all give the same bits.

#include <atomic>
#include <cstdint>

#include "base/compiler.h"

namespace dsw {

/** Instructions that code may use: each of them, and those before. */
enum class Instructions : uint8_t { kPortable, kAvx2, kAvx512 };
constexpr uint32_t kInstructionSets = 3;

/** Their names in the environment variable DARTSWEEP_KERNEL. dsw_kernel counts the same from 1. */
constexpr const char* kInstructionNames[kInstructionSets] = {"portable", "avx2", "avx512"};

/** Whether this processor and its system run them. */
bool supports(Instructions instructions) noexcept;

/** What DARTSWEEP_KERNEL says: a name from above, if this processor has it. Read once. */
struct NamedInstructions {
  bool is_named;
  Instructions instructions;
  const char* refused;  // what it says if that is anything else; null if it says nothing
};
const NamedInstructions& named_instructions() noexcept;

/** The most that the processor runs and DARTSWEEP_KERNEL allows. */
Instructions most_instructions() noexcept;

inline bool has_avx2() noexcept { return most_instructions() >= Instructions::kAvx2; }
inline bool has_avx512() noexcept { return most_instructions() >= Instructions::kAvx512; }
bool has_avx2_and_fma() noexcept;

/** Gives name_avx2 where this processor has AVX2, else name; DSW_WITH_AVX512 gives name_avx512 where it has that. */
#if DSW_X86_64
#define DSW_WITH_AVX2(name) (::dsw::has_avx2() ? name##_avx2 : name)
#define DSW_WITH_AVX512(name) (::dsw::has_avx512() ? name##_avx512 : DSW_WITH_AVX2(name))
#else
#define DSW_WITH_AVX2(name) (name)
#define DSW_WITH_AVX512(name) (name)
#endif

/** The instructions that cells of each kind are walked through by. Any thread may read while one sets. */
class Kernels {
 public:
  static constexpr uint32_t kKinds =
      16;  // the four bits of a record's first word that hold a cell's form and whether it is flat

  explicit Kernels(Instructions instructions) noexcept {
    for (uint32_t kind = 0; kind < kKinds; ++kind) set(kind, instructions);
  }
  Instructions of(uint32_t kind) const noexcept { return of_[kind].load(std::memory_order_relaxed); }
  void set(uint32_t kind, Instructions instructions) noexcept {
    of_[kind].store(instructions, std::memory_order_relaxed);
  }

 private:
  std::atomic<Instructions> of_[kKinds];
};
/** Returns the table in which cells of every kind are walked through by `instructions`. */
const Kernels& kernels_of(Instructions instructions) noexcept;

}  // namespace dsw
