#ifndef DARTSWEEP_PLANE_CORRIDOR_H
#define DARTSWEEP_PLANE_CORRIDOR_H

#ifdef __cplusplus
extern "C" {
#endif

/* Draws an edge and its corridor, the turn of the corridor and a swept edge: corridor.svg, turn.svg and sweep.svg. Returns
   whether the edges of the first two are free and the third one meets something. */
int draw_edges(const char *directory);

#ifdef __cplusplus
}
#endif

#endif
