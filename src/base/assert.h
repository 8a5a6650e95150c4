#pragma once
// DSW_ASSERT states our own invariants. It never checks input: bad input gets a status in every build.

#include <cstdio>
#include <cstdlib>

#if defined(DSW_VALIDATE)
#define DSW_ASSERT(condition)                                                                \
  do {                                                                                       \
    if (!(condition)) {                                                                      \
      std::fprintf(stderr, "%s:%d: invariant broken: %s\n", __FILE__, __LINE__, #condition); \
      std::abort();                                                                          \
    }                                                                                        \
  } while (false)
#else
#define DSW_ASSERT(condition) static_cast<void>(0)
#endif
