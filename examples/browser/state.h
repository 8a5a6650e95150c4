/* What the parts of a scene share. */
#ifndef DARTSWEEP_BROWSER_STATE_H
#define DARTSWEEP_BROWSER_STATE_H

#include <dartsweep/dartsweep.h>

#include "scene.h"
#include "wire.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { kMostContacts = 512 };

struct scene {
  dsw_context *context;
  dsw_environment *environment;
  dsw_scene *scene;
  dsw_body_id body;
  dsw_trace *trace;
  wire wire;
  scene_size size;
  /* These arrays belong to the environment's vertices: places at rest; ways of the beat, and of a cut that opens, for
   * each of its steps; positions, of which the environment reads `now`. */
  double *rest, *ways, *opening, *lent[2];
  size_t point_count, point_room, most_vertices, slots; /* slots: of the body's vertices */
  int now, with_boundary, is_vessel, traced, opening_steps, wall_moves;
  double strength, phase,
      shift; /* of the beat: how much of it there is, how far it is, and how much of the ways was made */
  uint32_t wall_version;
  scene_contact contacts[kMostContacts];
  size_t contact_count;
  dsw_near_options near_options;
  dsw_move_options move_options;
};

/* Sets the message; returns 0. */
int fail(const char *text);

/* Whether a call succeeded; if not, the message says which and why. */
int good(dsw_status status, const char *what);

/* An environment's widest place at one end of its longest side, and a direction from there; then the wire there. */
int find_entry(scene *s, double *clearance);
int find_direction(scene *s, double far);
int create_wire(scene *s);

/* Reads where the wire is. */
int read_wire(scene *s);

/* The environment reads the host's points from now on, with room for those of cuts. */
int lend_points(scene *s);

/* The environment a step later: it beats, and a cut opens. */
int bend(scene *s, int on);

/* New vertices of a cut rest, and beat, as those that they come from. */
void follow_change(scene *s, const dsw_change *change);

/* The wall looks different. */
void wall_has_changed(scene *s);

#ifdef __cplusplus
}
#endif

#endif
