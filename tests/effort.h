/* How much random tests try, and what they draw. For C and C++.
   DSW_EFFORT=10 asks every random test for ten times as much, DSW_EFFORT=1/4 for a quarter (sanitizers are slow).
   DSW_SEED=1, 2, ... lets every random test draw other cases; 0 is what is drawn where the variable is not set. */
#ifndef DARTSWEEP_TESTS_EFFORT_H
#define DARTSWEEP_TESTS_EFFORT_H

#include <limits.h>
#include <stdint.h>
#include <stdlib.h>

/* So many repeats, or so many sights of something in them, at the effort asked for; at least 1 of 1 or more. */
static inline int effort_of(int count) {
  const char *const text = getenv("DSW_EFFORT");
  char *end;
  long times, share;
  double scaled;
  if (text == NULL) return count;
  times = strtol(text, &end, 10);
  share = *end == '/' ? strtol(end + 1, NULL, 10) : 1;
  if (times < 1 || share < 1) abort(); /* neither N nor N/M */
  scaled = ((double)count * (double)times + (double)share - 1) / (double)share;
  return scaled < INT_MAX ? (int)scaled : INT_MAX;
}

/* Where less effort leaves nothing out. */
static inline int at_least(int count) {
  const int asked = effort_of(count);
  return asked > count ? asked : count;
}

/* The seed to draw from where a test has this one. */
static inline uint64_t seed_of(uint64_t seed) {
  const char *const text = getenv("DSW_SEED");
  return text == NULL ? seed : seed + 1000003 * (uint64_t)strtoul(text, NULL, 10);
}

#endif
