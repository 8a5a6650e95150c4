/* Falls through a unit cube and stops at its floor. */
#include <dartsweep/dartsweep.h>
#include <stdio.h>

int main(void) {
  const double points[24] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};
  const int64_t cube[8] = {0, 1, 2, 3, 4, 5, 6, 7};
  const double from[3] = {0.5, 0.25, 0.5}, to[3] = {0.5, 0.25, -0.5};
  const dsw_volume_id nowhere = {0, 0};
  dsw_environment_desc desc;
  dsw_environment *environment = NULL;
  dsw_flight flight;
  dsw_environment_desc_init(&desc, sizeof desc);
  desc.points = points;
  desc.point_count = 8;
  desc.uniform_cell_type = DSW_CELL_TYPE_HEXAHEDRON;
  desc.volume_count = 1;
  desc.connectivity = cube;
  desc.connectivity_count = 8;
  if (dsw_environment_create(NULL, &desc, &environment, NULL) != DSW_STATUS_OK ||
      dsw_environment_cast(environment, nowhere, from, to, NULL, &flight) != DSW_STATUS_OK) {
    fprintf(stderr, "%s\n", dsw_last_error_message());
    return 1;
  }
  printf("outcome %d at %g\n", (int)flight.outcome, flight.time);
  dsw_environment_destroy(environment);
  return flight.outcome == DSW_OUTCOME_CONTACT && flight.time == 0.5 ? 0 : 1;
}
