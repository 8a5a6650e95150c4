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

/** A lattice of cubes, each of six tetrahedra round a diagonal. */
static dsw_environment *make_tetrahedra(dsw_context *context) {
  static const int ways[6][2] = {{1, 3}, {3, 2}, {2, 6}, {6, 4}, {4, 5}, {5, 1}}; /* of corners, a bit for each axis */
  enum { POINTS = SIDE + 1 };
  static double points[POINTS * POINTS * POINTS * 3];
  static int64_t tetrahedra[SIDE * SIDE * SIDE * 6 * 4];
  dsw_environment_desc desc;
  dsw_environment *environment = NULL;
  size_t i, n = 0;
  for (i = 0; i < POINTS * POINTS * POINTS; ++i) {
    points[3 * i] = (double)(i % POINTS);
    points[3 * i + 1] = (double)(i / POINTS % POINTS);
    points[3 * i + 2] = (double)(i / (POINTS * POINTS));
  }
  for (i = 0; i < SIDE * SIDE * SIDE * 6; ++i) {
    const size_t cube = i / 6, x = cube % SIDE, y = cube / SIDE % SIDE, z = cube / (SIDE * SIDE);
    const int corners[4] = {0, ways[i % 6][0], ways[i % 6][1], 7};
    size_t k;
    for (k = 0; k < 4; ++k) {
      const size_t cx = x + (size_t)(corners[k] & 1), cy = y + (size_t)(corners[k] >> 1 & 1),
                   cz = z + (size_t)(corners[k] >> 2);
      tetrahedra[n++] = (int64_t)(cx + POINTS * (cy + POINTS * cz));
    }
  }
  dsw_environment_desc_init(&desc, sizeof desc);
  desc.points = points;
  desc.point_count = POINTS * POINTS * POINTS;
  desc.volume_count = SIDE * SIDE * SIDE * 6;
  desc.connectivity = tetrahedra;
  desc.connectivity_count = n;
  desc.uniform_cell_type = DSW_CELL_TYPE_TETRA;
  CHECK_OK(dsw_environment_create(context, &desc, &environment, NULL));
  return environment;
}

/** Casts across a lattice, every other one on its points. @return flights, CASTS of them, to be freed. */
static dsw_flight *flights_in(dsw_environment *environment, uint32_t volumes) {
  dsw_flight *const flights = calloc(CASTS, sizeof *flights);
  double *const ends = malloc(2 * CASTS * 3 * sizeof *ends);
  uint64_t state = 1;
  size_t i;
  for (i = 0; i < 60; ++i) {
    const uint32_t cell = (uint32_t)(random_number(&state) * volumes);
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

static dsw_flight *flights_of(dsw_context *context, int of_tetrahedra) {
  return of_tetrahedra ? flights_in(make_tetrahedra(context), SIDE * SIDE * SIDE * 6)
                       : flights_in(make_environment(context, SIDE, SIDE, SIDE), SIDE * SIDE * SIDE);
}

static void kernels_give_the_same_bits(int of_tetrahedra) {
  static const uint32_t kernels[] = {DSW_KERNEL_FASTEST, DSW_KERNEL_AVX2, DSW_KERNEL_AVX512};
  dsw_flight *expected;
  size_t i, hits = 0;
  dsw_context *context = NULL;
  dsw_context_desc d;
  dsw_context_desc_init(&d, sizeof d);
  CHECK(d.kernel == DSW_KERNEL_FASTEST && d.reserved == 0);
  d.kernel = DSW_KERNEL_PORTABLE;
  CHECK_OK(dsw_context_create(&d, &context));
  expected = flights_of(context, of_tetrahedra);
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
    flights = flights_of(context, of_tetrahedra);
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
  kernels_give_the_same_bits(0);
  kernels_give_the_same_bits(1);
  unknown_kernels_are_refused();
  shorter_descriptions_have_no_kernel();
  return check_result();
}
