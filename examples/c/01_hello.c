/* Hello: one cube, one segment, one contact. */
#include <dartsweep/dartsweep.h>
#include <stdio.h>

static const double kPoints[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};
static const int64_t kCube[] = {0, 1, 2, 3, 4, 5, 6, 7};

static dsw_status create_cube(dsw_environment **environment) {
  dsw_environment_desc desc;
  dsw_environment_desc_init(&desc, sizeof desc); /* hexahedra, 64-bit indices */
  desc.points = kPoints;
  desc.point_count = 8;
  desc.connectivity = kCube;
  desc.connectivity_count = 8;
  desc.volume_count = 1;
  return dsw_environment_create(NULL, &desc, environment, NULL);
}

int main(void) {
  const double from[3] = {0.5, 0.5, 0.5}, to[3] = {0.5, 0.5, 2.5};
  const dsw_volume_id anywhere = {0, 0};
  dsw_environment *cube = NULL;
  dsw_flight flight;
  if (create_cube(&cube) || dsw_environment_cast(cube, anywhere, from, to, NULL, &flight)) {
    fprintf(stderr, "%s\n", dsw_last_error_message());
    return 1;
  }
  printf("the wall is met at z = %g after %g of the way\n", flight.position[2], flight.time);
  return dsw_environment_destroy(cube) != DSW_STATUS_OK || flight.outcome != DSW_OUTCOME_CONTACT || flight.time != 0.25;
}
