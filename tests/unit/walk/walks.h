// The walks that this processor has.
#pragma once

#include <vector>

#include "base/compiler.h"
#include "walk/walk.h"

namespace dsw::testing_walk {

struct NamedWalk {
  const char* name;
  Walk<3> walk;
};

/** The portable one first. */
inline std::vector<NamedWalk> walks() {
  std::vector<NamedWalk> all{{"portable", kPortableWalk}};
#if DSW_X86_64
  if (DSW_CPU_HAS("avx2")) all.push_back({"avx2", kAvx2Walk});
  if (DSW_CPU_HAS("avx512f") && DSW_CPU_HAS("avx512dq") && DSW_CPU_HAS("avx512vl")) {
    all.push_back({"avx512", kAvx512Walk});
  }
#endif
  return all;
}

}  // namespace dsw::testing_walk
