/* Chains of edges in the plane. */
#ifndef DARTSWEEP_PLANE_CHAIN_H
#define DARTSWEEP_PLANE_CHAIN_H

#include <dartsweep/dartsweep.h>

#include "svg.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { kMostLinks = 512 };

/* A chain as it is now. */
typedef struct chain {
  dsw_scene *scene;
  dsw_body_id body;
  double positions[2 * kMostLinks];
  size_t vertex_count;
  uint32_t edges[2 * kMostLinks];
  size_t edge_count;
} chain;

/* A body of `count` vertices, each joined with the next. */
void chain_create(chain *chain, dsw_scene *scene, const double *positions, size_t count);
/* Moves it to targets, by vertex; then reads how it is, and how often it touched since the move began. */
dsw_move_report chain_move(chain *chain, const double *targets, const dsw_move_options *options);
/* Edges that a cast from end to end finds free: another way to know than the sweeps that moved them. */
size_t chain_count_free(const chain *chain);
void chain_draw(const chain *chain, const svg_view *view, const char *style);
void chain_draw_contacts(const chain *chain, const svg_view *view, const char *style);

#ifdef __cplusplus
}
#endif

#endif
