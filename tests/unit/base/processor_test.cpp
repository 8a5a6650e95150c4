// What is chosen for a processor, and what DARTSWEEP_KERNEL leaves of that; run once more for each name.

#include "base/processor.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

namespace dsw {
namespace {

TEST(Processor, RunsWhatEveryProcessorHas) { EXPECT_TRUE(supports(Instructions::kPortable)); }

TEST(Processor, HasTheInstructionsBeforeThoseThatItHas) {
  EXPECT_TRUE(supports(Instructions::kAvx2) || !supports(Instructions::kAvx512));
  EXPECT_TRUE(has_avx2() || !has_avx512());
  EXPECT_TRUE(has_avx2() || !has_avx2_and_fma());
}

TEST(Processor, UsesNoMoreThanTheVariableNames) {
  const char* const given = std::getenv("DARTSWEEP_KERNEL");
  const std::string name = given == nullptr ? "" : given;
  Instructions most = Instructions::kPortable, named = Instructions::kPortable;
  bool is_named = false;
  for (uint32_t i = 0; i < kInstructionSets; ++i) {
    const auto instructions = static_cast<Instructions>(i);
    if (!supports(instructions)) break;
    most = instructions;
    if (name == kInstructionNames[i]) is_named = true, named = instructions;
  }
  EXPECT_EQ(named_instructions().is_named, is_named);
  EXPECT_EQ(named_instructions().refused != nullptr, !is_named && !name.empty() && name != "fastest");
  EXPECT_EQ(most_instructions(), is_named ? named : most);
}

TEST(Processor, KernelsOfInstructionsAreTheSameForAllCells) {
  for (uint32_t i = 0; i < kInstructionSets; ++i) {
    for (uint32_t kind = 0; kind < Kernels::kKinds; ++kind) {
      EXPECT_EQ(static_cast<uint32_t>(kernels_of(static_cast<Instructions>(i)).of(kind)), i);
    }
  }
}

}  // namespace
}  // namespace dsw
