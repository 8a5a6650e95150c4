/* The panels of figure 5 of [JCD10], 4.2, on one scene in space and in the plane: an edge swings down among pegs. Its
   end p falls from (15.5, 7.5) to (15.5, 0.75), the other end q stays at (0.5, 7.5). In the plane pegs are marked
   vertices, in space marked upright edges. */
#ifndef DARTSWEEP_TESTS_SCENES_FIGURE5_H
#define DARTSWEEP_TESTS_SCENES_FIGURE5_H

#include "dartsweep/dartsweep.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum figure5_panel {
  FIGURE5_VERTEX_STOP = 0, /* p rises and meets the upper boundary */
  FIGURE5_STATIC = 1,
  FIGURE5_ADAPTIVE_ONE = 2,
  FIGURE5_ADAPTIVE_MANY = 3,
  FIGURE5_HYBRID = 4,
  FIGURE5_SLIDE = 5,          /* ours */
  FIGURE5_ADAPTIVE_SLIDE = 6, /* ours */
  FIGURE5_PANELS = 7
} figure5_panel;

/* The pegs: the edge meets A, then the part from A to p meets B, and the part from B to p meets D, too near p for a
   vertex; C lies under the edge between q and A. */
enum { FIGURE5_A = 0, FIGURE5_B = 1, FIGURE5_C = 2, FIGURE5_D = 3, FIGURE5_PEGS = 4, FIGURE5_NO_PEG = 9 };

/* What has become of the edge. */
typedef struct figure5_answer {
  uint32_t inserted, contacts, stopped;
  uint32_t pegs[8];        /* those at which new vertices stand, in the order in which they were inserted */
  double end[2];           /* p */
  double first_contact[2]; /* where it touched first */
  double first_time;       /* when */
} figure5_answer;

/* How the edge is moved besides its responses. */
typedef struct figure5_options {
  dsw_search search;
  uint32_t bisection_depth;
  double min_part; /* 0.2: B may get a vertex in the whole edge, D none in the part from B to p */
} figure5_options;

figure5_options figure5_default_options(void);
dsw_response figure5_response(figure5_panel panel);

/* Makes the scene in 2 or 3 dimensions and the one move in it. 0 if a call failed. */
int figure5_run(uint32_t dimension, figure5_panel panel, const figure5_options *options, figure5_answer *answer);

/* Whether that is what the panel shows with default options: how many new vertices, where, in which order, where p ends
   and how many contacts there are. Places follow from the pegs by hand; distances up to 1e-6 for what is kept off
   walls. */
int figure5_is_expected(figure5_panel panel, const figure5_answer *answer);

#ifdef __cplusplus
}
#endif

#endif
