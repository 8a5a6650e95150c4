/* The two scenes of the plane. */
#ifndef DARTSWEEP_PLANE_CITY_H
#define DARTSWEEP_PLANE_CITY_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct scene_figures {
  size_t steps;
  size_t free_steps; /* after which every edge was free, by casts */
  size_t contacts;
  size_t inserted; /* vertices */
} scene_figures;

/* Writes city.svg: a snake-like chain on its way through a city. */
scene_figures draw_city(const char *directory);
/* Writes rope.svg: a rope that falls on obstacles, once for each response [JCD10] figure 5. */
scene_figures draw_rope(const char *directory);

#ifdef __cplusplus
}
#endif

#endif
