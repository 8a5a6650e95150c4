// The walks that this processor has.
#pragma once

#include <vector>

#include "walk/walk.h"

namespace dsw::testing_walk {

struct NamedWalk {
  const char* name;
  Walk<3> walk;
};

/** The portable one first. */
inline std::vector<NamedWalk> walks() {
  std::vector<NamedWalk> all{{"portable", kPortableWalk}};
#if defined(__x86_64__)
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx2")) all.push_back({"avx2", kAvx2Walk});
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl")) {
    all.push_back({"avx512", kAvx512Walk});
  }
#endif
  return all;
}

}  // namespace dsw::testing_walk
