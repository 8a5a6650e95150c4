/* Errors: a status for every mistake, a message that names it, nothing changed; and what is an outcome, not an error. */
#include <dartsweep/dartsweep.h>
#include <math.h>
#include <stdio.h>

static const double kPoints[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};
static const int64_t kGood[] = {0, 1, 2, 3, 1, 2, 3, 4};     /* two tetrahedra side by side */
static const int64_t kInverted[] = {0, 1, 2, 3, 2, 1, 3, 4}; /* the second inside out */
static const int64_t kAstray[] = {0, 1, 2, 3, 1, 2, 3, 9};   /* there is no point 9 */

static int failures = 0;

/* Prints what came back and notes it when something else was expected. */
static void expect(dsw_status expected, dsw_status status, const char *what) {
  const char *message = status == DSW_STATUS_OK ? "" : dsw_last_error_message();
  printf("%-26s %-32s %s\n", what, dsw_status_string(status), message);
  failures += status != expected || (status != DSW_STATUS_OK && message[0] == 0);
}

static dsw_status create(const int64_t *cells, uint32_t flags, dsw_environment **environment,
                         dsw_build_report *report) {
  dsw_environment_desc desc;
  dsw_environment_desc_init(&desc, sizeof desc);
  desc.uniform_cell_type = DSW_CELL_TYPE_TETRA;
  desc.points = kPoints;
  desc.point_count = 5;
  desc.connectivity = cells;
  desc.connectivity_count = 8;
  desc.volume_count = 2;
  desc.flags = flags;
  report->struct_size = sizeof *report;
  return dsw_environment_create(NULL, &desc, environment, report);
}

int main(void) {
  const dsw_volume_id none = {0, 0};
  const double inside[3] = {0.2, 0.2, 0.2}, outside[3] = {9, 9, 9}, far_away[3] = {1e300, 0, 0};
  double not_a_number[3] = {0, 0, 0}, before[3], after[3];
  dsw_environment *environment = NULL;
  dsw_build_report report;
  dsw_scene *scene = NULL;
  dsw_particle_id particle, gone;
  dsw_volume_id volume;
  dsw_location location;
  dsw_flight flight;
  dsw_cell cell;
  dsw_vertex_id corner[1];
  size_t count = 0;
  not_a_number[1] = sqrt(-1.0);

  /* A mesh that can't be used is refused as a whole; the report says which cells are at fault. */
  expect(DSW_STATUS_INDEX_OUT_OF_RANGE, create(kAstray, 0, &environment, &report), "an index astray");
  expect(DSW_STATUS_INVERTED_CELL, create(kInverted, 0, &environment, &report), "an inverted cell");
  failures += environment != NULL || report.offender_count != 1 || report.offenders[0] != 1;
  /* An inverted cell can be mirrored instead. */
  expect(DSW_STATUS_OK, create(kInverted, DSW_ENVIRONMENT_REORIENT, &environment, &report), "the same, mirrored");
  failures += report.reoriented_count != 1;
  expect(DSW_STATUS_OK, dsw_environment_destroy(environment), "destroying it");

  expect(DSW_STATUS_OK, create(kGood, 0, &environment, &report), "a good mesh");
  expect(DSW_STATUS_OK, dsw_scene_create(environment, NULL, &scene), "a scene");
  expect(DSW_STATUS_IN_USE, dsw_environment_destroy(environment), "destroying too early");
  expect(DSW_STATUS_OUTSIDE, dsw_particle_create(scene, outside, none, &particle), "a particle outside");
  expect(DSW_STATUS_NON_FINITE, dsw_particle_create(scene, not_a_number, none, &particle), "a particle at NaN");
  expect(DSW_STATUS_OK, dsw_particle_create(scene, inside, none, &particle), "a particle inside");

  /* A failed call changes nothing. */
  expect(DSW_STATUS_OK, dsw_particle_get_position(scene, particle, before, NULL), "where it is");
  expect(DSW_STATUS_NON_FINITE, dsw_particle_move(scene, particle, not_a_number, NULL, &flight), "a move to NaN");
  expect(DSW_STATUS_OK, dsw_particle_get_position(scene, particle, after, NULL), "where it is now");
  failures += before[0] != after[0] || before[1] != after[1] || before[2] != after[2];

  /* Physics is no error: a wall in the way and a place outside are answers. */
  expect(DSW_STATUS_OK, dsw_particle_move(scene, particle, far_away, NULL, &flight), "a move far away");
  failures += flight.outcome != DSW_OUTCOME_CONTACT || flight.position[0] > 1;
  expect(DSW_STATUS_OK, dsw_environment_locate(environment, outside, none, &volume, &location), "locating outside");
  failures += location != DSW_LOCATION_OUTSIDE || volume.generation != 0;

  /* A buffer that is too small tells the size it should have. */
  cell.kind = DSW_CELL_VOLUME;
  cell.index = flight.volume.index;
  cell.generation = flight.volume.generation;
  cell.local = 0;
  expect(DSW_STATUS_BUFFER_TOO_SMALL, dsw_environment_copy_vertices(environment, cell, corner, 1, &count),
         "one vertex only");
  failures += count != 4;

  /* An id outlives what it named and says so. */
  gone = particle;
  expect(DSW_STATUS_OK, dsw_particle_destroy(scene, particle), "removing the particle");
  expect(DSW_STATUS_STALE_ID, dsw_particle_get_position(scene, gone, after, NULL), "asking for it");
  expect(DSW_STATUS_NULL_ARGUMENT, dsw_particle_get_position(NULL, gone, after, NULL), "no scene at all");
  expect(DSW_STATUS_NOT_ENABLED, dsw_scene_reset_statistics(scene), "counters not asked for");

  expect(DSW_STATUS_OK, dsw_scene_destroy(scene), "destroying the scene");
  expect(DSW_STATUS_OK, dsw_environment_destroy(environment), "destroying the mesh");
  printf("%d of them answered otherwise than expected\n", failures);
  return failures != 0;
}
