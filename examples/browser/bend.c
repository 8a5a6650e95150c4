/* Points that move: the wall beats, and a cut opens. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../demo/mesh.h"
#include "state.h"

enum { kBeatSteps = 35, kRampSteps = 15, kHalvings = 2 };

static const double kDepth = 0.42;

/* The environment reads the host's points from now on, with room for those of cuts. */
int lend_points(scene *s) {
  const double *points = NULL;
  dsw_deform_options options;
  size_t i;
  if (!good(dsw_environment_get_points(s->environment, &points, &s->point_count), "reading points")) return 0;
  s->point_room = 2 * s->point_count + 4096;
  s->rest = (double *)calloc(15 * s->point_room, sizeof(double));
  if (s->rest == NULL) return fail("out of memory");
  s->ways = s->rest + 3 * s->point_room;
  s->opening = s->ways + 3 * s->point_room;
  s->lent[0] = s->opening + 3 * s->point_room;
  s->lent[1] = s->lent[0] + 3 * s->point_room;
  memcpy(s->rest, points, 3 * s->point_count * sizeof(double));
  memcpy(s->lent[0], points, 3 * s->point_count * sizeof(double));
  if (s->is_vessel) {
    mesh_find_ways_inward(s->rest, s->point_count, s->ways);
  } else { /* all of a slice goes to one side */
    for (i = 0; i < s->point_count; ++i) s->ways[3 * i + 2] = 6 * s->size.wire_radius;
  }
  dsw_deform_options_init(&options, sizeof options);
  options.point_room = s->point_room;
  return good(dsw_environment_deform(s->environment, s->lent[0], s->point_count, &options, NULL), "lending points");
}

/* How much of its way a point makes: a wave runs along the longest side, and its ends rest. */
static double share_of_way(const scene *s, const double *rest) {
  const double length = s->size.upper[0] - s->size.lower[0], x = rest[0] - s->size.lower[0], end = 0.12 * length;
  const double left = x < length - x ? x : length - x, fade = left < end ? (left > 0 ? left / end : 0) : 1;
  double u = 2 * x / length - s->phase;
  u -= floor(u);
  return s->strength * fade * kDepth * 16 * u * u * (1 - u) * (1 - u);
}

/* The environment a step later. */
int bend(scene *s, int on) {
  const int next = 1 - s->now, opens = s->opening_steps > 0;
  dsw_deform_options options;
  dsw_deform_report report;
  size_t i, k;
  s->strength += on ? 1.0 / kRampSteps : -1.0 / kRampSteps;
  s->strength = s->strength > 1 ? 1 : (s->strength < 0 ? 0 : s->strength);
  s->phase += 1.0 / kBeatSteps;
  for (i = 0; i < s->point_count; ++i) {
    const double share = share_of_way(s, s->rest + 3 * i);
    for (k = 0; k < 3; ++k) {
      s->rest[3 * i + k] += opens ? s->opening[3 * i + k] : 0;
      s->lent[next][3 * i + k] = s->rest[3 * i + k] + share * s->ways[3 * i + k];
    }
  }
  s->opening_steps -= opens;
  dsw_deform_options_init(&options, sizeof options);
  options.point_room = s->point_room;
  options.most_halvings = kHalvings;
  if (!good(dsw_environment_deform(s->environment, s->lent[next], s->point_count, &options, &report), "beating"))
    return 0;
  if (report.outcome != DSW_DEFORM_REFUSED) s->now = next;
  wall_has_changed(s);
  return 1;
}

/* New vertices of a cut rest, and beat, as those that they come from. */
void follow_change(scene *s, const dsw_change *change) {
  size_t i, k;
  for (i = 0; i < change->vertex_count; ++i) {
    const dsw_vertex_origin *origin = change->vertices + i;
    const size_t to = 3 * (size_t)origin->vertex.index;
    double share;
    for (k = 0; k < 3; ++k) {
      s->ways[to + k] = origin->weights[0] * s->ways[3 * (size_t)origin->from[0].index + k] +
                        origin->weights[1] * s->ways[3 * (size_t)origin->from[1].index + k];
      s->rest[to + k] = s->lent[s->now][to + k];
    }
    share = share_of_way(s, s->rest + to);
    for (k = 0; k < 3; ++k) s->rest[to + k] -= share * s->ways[to + k];
    if (origin->vertex.index >= s->point_count) s->point_count = (size_t)origin->vertex.index + 1;
  }
}
