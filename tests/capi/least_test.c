/* The library from which all is left out that can be: what is there works, what is not says so and how to have it. */
#include "check.h"
#include "dartsweep/dartsweep.h"

/* A function answers that it was left out, by which option, and writes nothing. */
#define CHECK_LEFT_OUT(call, option)         \
  do {                                       \
    CHECK_FAILS(DSW_STATUS_NOT_BUILT, call); \
    CHECK_MESSAGE(option);                   \
  } while (0)

static const double kPoints[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};
static const int64_t kCells[] = {0, 1, 2, 3, 4, 5, 6, 7};

static dsw_environment *create(uint32_t dimension, dsw_status expected) {
  dsw_environment *environment = NULL;
  dsw_environment_desc desc;
  dsw_environment_desc_init(&desc, sizeof desc);
  desc.dimension = dimension;
  desc.points = kPoints;
  desc.point_count = dimension == 2 ? 4 : 8;
  desc.connectivity = kCells;
  desc.connectivity_count = dimension == 2 ? 4 : 8;
  desc.volume_count = 1;
  desc.uniform_cell_type = dimension == 2 ? DSW_CELL_TYPE_QUAD : DSW_CELL_TYPE_HEXAHEDRON;
  check_status(expected, dsw_environment_create(NULL, &desc, &environment, NULL), "create", __FILE__, __LINE__);
  return environment;
}

static void what_is_there_works(void) {
  const double from[] = {0.5, 0.5, 0.5}, to[] = {0.5, 0.25, 2.5};
  dsw_environment *const environment = create(3, DSW_STATUS_OK);
  const dsw_volume_id nowhere = {0, 0};
  dsw_particle_id particle;
  dsw_scene_desc desc;
  dsw_flight flight;
  dsw_scene *scene;
  CHECK_OK(dsw_environment_cast(environment, nowhere, from, to, NULL, &flight));
  CHECK(flight.outcome == DSW_OUTCOME_CONTACT && flight.time == 0.25 && flight.contact.normal[2] == -1);
  dsw_scene_desc_init(&desc, sizeof desc);
  CHECK_OK(dsw_scene_create(environment, &desc, &scene));
  CHECK_OK(dsw_particle_create(scene, from, nowhere, &particle));
  CHECK_OK(dsw_particle_move(scene, particle, to, NULL, &flight));
  CHECK(flight.outcome == DSW_OUTCOME_CONTACT && flight.time == 0.25);
  CHECK_LEFT_OUT(dsw_body_create(scene, NULL, NULL), "DSW_WITH_BODIES");
  CHECK_LEFT_OUT(dsw_scene_move_together(scene, NULL, 0, NULL, 0, 0, NULL, NULL), "DSW_WITH_TOGETHER");
  CHECK_LEFT_OUT(dsw_scene_start_recording(scene, NULL), "DSW_WITH_RECORD");
  CHECK_OK(dsw_scene_destroy(scene));
  CHECK_OK(dsw_environment_destroy(environment));
}

static void what_is_not_says_so(void) {
  dsw_environment *const environment = create(3, DSW_STATUS_OK);
  const dsw_body_id body = {0, 0};
  size_t size = 7;
  CHECK(create(2, DSW_STATUS_NOT_BUILT) == NULL);
  CHECK_MESSAGE("DSW_WITH_PLANE");
  CHECK_LEFT_OUT(dsw_sweep_pairs(NULL, 3, 0, NULL, NULL, NULL, 0, 0, NULL), "DSW_WITH_PAIRS");
  CHECK_LEFT_OUT(dsw_environment_deform(environment, NULL, 0, NULL, NULL), "DSW_WITH_DEFORM");
  CHECK_LEFT_OUT(dsw_environment_cut(environment, NULL, NULL), "DSW_WITH_SURGERY");
  CHECK_LEFT_OUT(dsw_environment_carve(environment, NULL, NULL), "DSW_WITH_SURGERY");
  CHECK_LEFT_OUT(dsw_environment_coarsen(environment, NULL, NULL, NULL, 0, NULL), "DSW_WITH_COARSEN");
  CHECK_LEFT_OUT(dsw_body_find_near_rows(NULL, body, NULL, NULL), "DSW_WITH_NEAR");
  CHECK_LEFT_OUT(dsw_environment_save(environment, NULL, 0, &size), "DSW_WITH_SNAPSHOT");
  CHECK(size == 7);
  CHECK_OK(dsw_environment_destroy(environment));
}

int main(void) {
  what_is_there_works();
  what_is_not_says_so();
  return check_result();
}
