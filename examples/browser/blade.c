/* The wall is cut open beside the tip. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "state.h"

enum { kOpenSteps = 24 };

static const double kSnap = 0.25;

/* Where a cut is: its middle on the wall, and unit vectors along the wire, out of the wall, and from lip to lip. */
typedef struct place {
  double middle[3], along[3], normal[3], side[3];
} place;

static double dot(const double *a, const double *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/* At the wall's point nearest to the tip. */
static int find_place(scene *s, place *at) {
  const dsw_volume_id none = {0, 0};
  const double *tip = s->wire.at;
  double way[3], share, length;
  dsw_nearest nearest;
  int k;
  if (!good(dsw_environment_find_nearest(s->environment, tip, none, 12 * s->wire.radius, &nearest),
            "looking for the wall")) {
    return 0;
  }
  if (nearest.cell.kind == DSW_CELL_NONE) return fail("no wall is near the tip");
  for (k = 0; k < 3; ++k) way[k] = tip[k] - tip[3 + k];
  share = dot(way, nearest.normal);
  for (k = 0; k < 3; ++k) way[k] -= share * nearest.normal[k];
  length = sqrt(dot(way, way));
  if (length < 0.05 * s->wire.link) return fail("the wire points straight at the wall");
  for (k = 0; k < 3; ++k) {
    at->middle[k] = nearest.point[k];
    at->normal[k] = nearest.normal[k];
    at->along[k] = way[k] / length;
  }
  for (k = 0; k < 3; ++k) {
    at->side[k] = at->normal[(k + 1) % 3] * at->along[(k + 2) % 3] - at->normal[(k + 2) % 3] * at->along[(k + 1) % 3];
  }
  return 1;
}

/* 1 at 0, smoothly to 0 at `end` and beyond. */
static double fade(double x, double end) {
  const double left = 1 - x * x / (end * end);
  return left > 0 ? left * left : 0;
}

/* Lips go apart slowly, and what is near goes with them. */
static void start_opening(scene *s, const place *at) {
  const double r = s->wire.radius;
  size_t i, k;
  for (i = 0; i < s->point_count; ++i) {
    double way[3], side, share;
    for (k = 0; k < 3; ++k) way[k] = s->rest[3 * i + k] - at->middle[k];
    side = dot(way, at->side);
    share = fade(dot(way, at->along), 11 * r) * fade(dot(way, at->normal), 9 * r) * fade(side, 9 * r) * 2.6 * r /
            kOpenSteps;
    share = side > 0 ? share : (side < 0 ? -share : 0);
    for (k = 0; k < 3; ++k) s->opening[3 * i + k] = share * at->side[k];
  }
  s->opening_steps = kOpenSteps;
}

static int open_crack(scene *s, const dsw_change *cut) {
  const size_t count = cut->face_count;
  dsw_cut_face *faces = (dsw_cut_face *)malloc((count + 1) * sizeof *faces);
  dsw_open_crack_desc desc;
  dsw_change change;
  int opened;
  if (faces == NULL) return fail("out of memory");
  memcpy(faces, cut->faces, count * sizeof *faces); /* the next change ends the arrays of the last one */
  dsw_open_crack_desc_init(&desc, sizeof desc);
  desc.faces = faces;
  desc.face_count = count;
  desc.width = s->wire.radius;
  change.struct_size = sizeof change;
  opened = good(dsw_environment_open_crack(s->environment, &desc, &change), "opening the cut");
  free(faces);
  if (opened) follow_change(s, &change);
  return opened;
}

int scene_cut(scene *s) {
  double blade[2][3][3];
  dsw_cut_desc desc;
  dsw_change change;
  place at;
  int row, column, k;
  if (!find_place(s, &at)) return 0;
  for (row = 0; row < 2; ++row) { /* from inside through the wall, to both sides of the tip */
    for (column = 0; column < 3; ++column) {
      for (k = 0; k < 3; ++k) {
        blade[row][column][k] =
            at.middle[k] + s->wire.radius * ((row == 0 ? -8 : 8) * at.along[k] + (2 - 4 * column) * at.normal[k]);
      }
    }
  }
  dsw_cut_desc_init(&desc, sizeof desc);
  desc.points = &blade[0][0][0];
  desc.rows = 2;
  desc.columns = 3;
  desc.snap = kSnap; /* longer edges, so that what is near can go with the lips */
  change.struct_size = sizeof change;
  if (!good(dsw_environment_cut(s->environment, &desc, &change), "cutting")) return 0;
  wall_has_changed(s);
  follow_change(s, &change);
  if (change.face_count == 0) return fail("the blade has split nothing");
  if (!open_crack(s, &change)) return 0;
  start_opening(s, &at);
  return read_wire(s);
}
