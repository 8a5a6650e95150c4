/* Where the wire comes in. */
#include <math.h>
#include <string.h>

#include "state.h"

/* The widest place at one end of the longest axis. */
int find_entry(scene *s, double *clearance) {
  const double *lower = s->size.lower, *upper = s->size.upper;
  uint32_t count = 0, i;
  int axis = 0, k;
  double most;
  dsw_environment_info info;
  info.struct_size = sizeof info;
  if (!good(dsw_environment_get_info(s->environment, &info), "reading")) return 0;
  count = info.volume_index_count;
  for (k = 1; k < 3; ++k) {
    if (upper[k] - lower[k] > upper[axis] - lower[axis]) axis = k;
  }
  most = lower[axis] + (s->is_vessel ? 0.06 : 0.2) * (upper[axis] - lower[axis]);
  *clearance = 0;
  for (i = 0; i < count; ++i) {
    dsw_volume_id volume;
    dsw_nearest nearest;
    double centre[3];
    if (dsw_environment_get_volume_id(s->environment, i, &volume) != DSW_STATUS_OK ||
        dsw_environment_get_centre(s->environment, volume, centre) != DSW_STATUS_OK || centre[axis] > most ||
        dsw_environment_find_nearest(s->environment, centre, volume, HUGE_VAL, &nearest) != DSW_STATUS_OK) {
      continue;
    }
    if (nearest.cell.kind != DSW_CELL_NONE && nearest.distance > *clearance) {
      *clearance = nearest.distance;
      memcpy(s->size.entry, centre, sizeof centre);
    }
  }
  return *clearance > 0 ? 1 : fail("there is no room for a wire at the narrow end of the longest side");
}

/* Finds the one of the 26 directions of a lattice in which the vessel is widest at some distance. */
int find_direction(scene *s, double far) {
  const dsw_volume_id none = {0, 0};
  double best = 0;
  int i, k;
  for (i = 0; i < 27; ++i) {
    const int step[3] = {i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1};
    const double length = sqrt((double)(step[0] * step[0] + step[1] * step[1] + step[2] * step[2]));
    double at[3];
    dsw_nearest nearest;
    dsw_flight flight;
    if (length == 0) continue;
    for (k = 0; k < 3; ++k) at[k] = s->size.entry[k] + far * step[k] / length;
    if (dsw_environment_cast(s->environment, none, s->size.entry, at, NULL, &flight) != DSW_STATUS_OK ||
        flight.outcome != DSW_OUTCOME_REACHED ||
        dsw_environment_find_nearest(s->environment, at, flight.volume, HUGE_VAL, &nearest) != DSW_STATUS_OK) {
      continue;
    }
    if (nearest.distance > best) {
      best = nearest.distance;
      for (k = 0; k < 3; ++k) s->size.direction[k] = step[k] / length;
    }
  }
  return best > 0 ? 1 : fail("there is no way for a wire from the place where it comes in");
}

int create_wire(scene *s) {
  uint32_t edges[4] = {0, 1, 1, 2};
  dsw_body_desc desc;
  wire_create(&s->wire, s->size.entry, s->size.direction, s->size.wire_radius, s->size.link, 3);
  dsw_body_desc_init(&desc, sizeof desc);
  desc.level = DSW_LEVEL_EDGES_SWEPT;
  desc.positions = s->wire.at;
  desc.vertex_count = 3;
  desc.edges = edges;
  desc.edge_count = 2;
  desc.radius = s->size.wire_radius;
  s->near_options.margin = s->wire.most;
  s->slots = s->wire.count;
  return good(dsw_body_create(s->scene, &desc, &s->body), "putting the wire in");
}
