/* How often tests repeat what they do. For C and C++. */
#ifndef DARTSWEEP_TESTS_SHARE_H
#define DARTSWEEP_TESTS_SHARE_H

#include <stdlib.h>

/* Sanitizers are slow, and other presets run the same code at full counts: DSW_SHARE asks for one in so many repeats,
   and for as much less that must be seen in them. */
static inline int share_of(int count) {
  const char *const text = getenv("DSW_SHARE");
  const int share = text == NULL ? 1 : atoi(text);
  return share > 1 ? count / share : count;
}

#endif
