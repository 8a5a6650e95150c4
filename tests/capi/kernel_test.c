/* Kernels: what contexts take, and that each kernel gives the same bits. Run again with DARTSWEEP_KERNEL set. */
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "fixture.h"

enum { SIDE = 8, CASTS = 4000 };

static double random_number(uint64_t *state) {
  *state = *state * 6364136223846793005u + 1442695040888963407u;
  return (double)(*state >> 11) * 0x1p-53;
}

/** Casts across a lattice, every other one on its points. @return flights, CASTS of them, to be freed. */
static dsw_flight *flights_of(dsw_context *context) {
  dsw_environment *const environment = make_environment(context, SIDE, SIDE, SIDE);
  dsw_flight *const flights = calloc(CASTS, sizeof *flights);
  double *const ends = malloc(2 * CASTS * 3 * sizeof *ends);
  uint64_t state = 1;
  size_t i;
  for (i = 0; i < 60; ++i) {
    const uint32_t cell = (uint32_t)(random_number(&state) * SIDE * SIDE * SIDE);
    CHECK_OK(set_volume_mark(environment, cell, DSW_MARK_IMPASSABLE));
  }
  for (i = 0; i < 2 * CASTS * 3; ++i) {
    const double x = random_number(&state) * SIDE;
    ends[i] = i / 3 % 2 == 0 ? x : (double)(int)x;
  }
  CHECK_OK(dsw_environment_cast_segments(environment, CASTS, NULL, ends, ends + CASTS * 3, 0, NULL, flights));
  free(ends);
  CHECK_OK(dsw_environment_destroy(environment));
  return flights;
}

static void kernels_give_the_same_bits(void) {
  static const uint32_t kernels[] = {DSW_KERNEL_FASTEST, DSW_KERNEL_AVX2, DSW_KERNEL_AVX512};
  dsw_flight *expected;
  size_t i, hits = 0;
  dsw_context *context = NULL;
  dsw_context_desc d;
  dsw_context_desc_init(&d, sizeof d);
  CHECK(d.kernel == DSW_KERNEL_FASTEST && d.reserved == 0);
  d.kernel = DSW_KERNEL_PORTABLE;
  CHECK_OK(dsw_context_create(&d, &context));
  expected = flights_of(context);
  CHECK_OK(dsw_context_destroy(context));
  for (i = 0; i < CASTS; ++i) hits += expected[i].outcome == DSW_OUTCOME_CONTACT ? 1u : 0u;
  CHECK(hits > CASTS / 10 && hits < CASTS);
  for (i = 0; i < sizeof kernels / sizeof *kernels; ++i) {
    dsw_flight *flights;
    dsw_status status;
    d.kernel = kernels[i];
    status = dsw_context_create(&d, &context);
    if (status == DSW_STATUS_UNSUPPORTED && kernels[i] != DSW_KERNEL_FASTEST) {
      CHECK_MESSAGE("this processor has not what kernel avx");
      continue;
    }
    CHECK_OK(status);
    flights = flights_of(context);
    CHECK(memcmp(flights, expected, CASTS * sizeof *flights) == 0);
    free(flights);
    CHECK_OK(dsw_context_destroy(context));
  }
  free(expected);
}

static void unknown_kernels_are_refused(void) {
  dsw_context *context = NULL;
  dsw_context_desc d;
  dsw_context_desc_init(&d, sizeof d);
  d.kernel = 4;
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_context_create(&d, &context));
  CHECK_MESSAGE("desc->kernel is 4");
  d.kernel = DSW_KERNEL_FASTEST;
  d.reserved = 1;
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_context_create(&d, &context));
  CHECK_MESSAGE("desc->reserved is 1");
  CHECK(context == NULL);
}

/** A program built before kernels could be named gets the fastest. */
static void shorter_descriptions_have_no_kernel(void) {
  dsw_context *context = NULL;
  dsw_context_desc d;
  dsw_context_desc_init(&d, sizeof d);
  d.struct_size = (uint32_t)offsetof(dsw_context_desc, kernel);
  d.kernel = 99;
  CHECK_OK(dsw_context_create(&d, &context));
  CHECK_OK(dsw_context_destroy(context));
}

int main(void) {
  kernels_give_the_same_bits();
  unknown_kernels_are_refused();
  shorter_descriptions_have_no_kernel();
  return check_result();
}
