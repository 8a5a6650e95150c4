/* What the page shows: a vessel, and a thick wire that is pushed, turned and pulled in it. The same calls give the same
 * bits in a browser and in a native program: nothing here is computed but by + - * / and square roots. */
#ifndef DARTSWEEP_BROWSER_SCENE_H
#define DARTSWEEP_BROWSER_SCENE_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct scene scene;

/* Where the wire touches. Only doubles, so that JavaScript reads an array of these as one of numbers. */
typedef struct scene_contact {
  double point[3];  /* of the wall */
  double normal[3]; /* unit, towards the wire */
  double impulse;   /* how hard the wall presses, in the lengths of the scene; 0 for a contact of a move */
  double kind;      /* of the wall's cell: 1 face, 2 edge, 3 vertex */
  double time;      /* of a contact of a move, its fraction of the way; -1 for a near row that presses */
} scene_contact;

/* Numbers about a scene. */
typedef struct scene_size {
  double volumes, points, wire_radius, link, lower[3], upper[3], entry[3], direction[3];
} scene_size;

/* Each returns null where it fails; scene_message tells why. */

/* The embedded vessel of the demo. */
scene *scene_create_vessel(void);

/* Cells of the types and in the order of VTK, of `corner_count` corners in all. Every way out is a wall. */
scene *scene_create_volumes(const double *points, size_t point_count, const uint8_t *types, size_t cell_count,
                            const int32_t *corners, size_t corner_count);

/* The inside of a closed surface, carved out of a lattice. */
scene *scene_create_surface(const double *points, size_t point_count, const uint32_t *triangles, size_t triangle_count);

void scene_destroy(scene *s);

/* Why the last call failed. */
const char *scene_message(void);

/* One step: the hand pushes the wire by `push`, back if below 0, and turns it by about `turn` radians; the wall beats or comes to
 * rest. Returns 1; 0 if a call of the library failed. */
int scene_step(scene *s, double push, double turn, int beat);

/* Opens the wall beside the tip. Returns 1; 0 if there is no wall near enough, or it could not be opened. */
int scene_cut(scene *s);

/* The wire's vertices, from the tip to the hand; valid until the next step. */
const double *scene_get_wire(const scene *s, size_t *count);

/* The contacts of the last step. */
const scene_contact *scene_get_contacts(const scene *s, size_t *count);

/* The wall as triangles of points that they share; valid until the next call. */
const double *scene_get_wall_points(scene *s, size_t *count);
const uint32_t *scene_get_wall_triangles(scene *s, size_t *count);

/* Changes when the wall looks different. */
uint32_t scene_get_wall_version(const scene *s);

const scene_size *scene_get_size(const scene *s);

#ifdef __cplusplus
}
#endif

#endif
