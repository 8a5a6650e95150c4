#ifndef DARTSWEEP_PLANE_BENDS_H
#define DARTSWEEP_PLANE_BENDS_H

#ifdef __cplusplus
extern "C" {
#endif

/* Draws what becomes of a floor that rises under a rod, for each way to bend an environment: bends.svg. Returns whether the rod
   has been pushed where it can be, and the floor has stopped where it can't. */
int draw_bends(const char *directory);

#ifdef __cplusplus
}
#endif

#endif
