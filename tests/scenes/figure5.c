#include "scenes/figure5.h"

#include <math.h>
#include <string.h>

enum { kAcross = 16, kUp = 8, kLayer = (kAcross + 1) * (kUp + 1), kCells = kAcross * kUp, kMost = 8 };

static const uint32_t kPegs[FIGURE5_PEGS][2] = {{8, 7}, {12, 5}, {4, 6}, {15, 2}};
static const double kFrom[2][3] = {{15.5, 7.5, 0.5}, {0.5, 7.5, 0.5}};
static const double kDown = 0.75, kUpTo = 9, kNear = 1e-6;

figure5_options figure5_default_options(void) {
  const figure5_options options = {DSW_SEARCH_EXACT, 0, 0.2};
  return options;
}

dsw_response figure5_response(figure5_panel panel) {
  static const dsw_response kResponses[FIGURE5_PANELS] = {
      DSW_RESPONSE_STOP,   DSW_RESPONSE_STOP,  DSW_RESPONSE_ADAPTIVE_ONE,  DSW_RESPONSE_ADAPTIVE_MANY,
      DSW_RESPONSE_HYBRID, DSW_RESPONSE_SLIDE, DSW_RESPONSE_ADAPTIVE_SLIDE};
  return kResponses[panel];
}

static dsw_status make_ground(uint32_t dimension, dsw_environment **environment) {
  static double points[3 * 2 * kLayer];
  static int64_t corners[8 * kCells];
  const size_t count = dimension == 3 ? 8 : 4;
  dsw_environment_desc d;
  size_t i;
  for (i = 0; i < 2 * (size_t)kLayer; ++i) {
    points[3 * i] = (double)(i % (kAcross + 1));
    points[3 * i + 1] = (double)(i % kLayer / (kAcross + 1));
    points[3 * i + 2] = (double)(i / kLayer);
  }
  for (i = 0; i < kCells; ++i) {
    const int64_t a = (int64_t)(i % kAcross + i / kAcross * (kAcross + 1));
    const int64_t square[4] = {a, a + 1, a + kAcross + 2, a + kAcross + 1};
    size_t k;
    for (k = 0; k < count; ++k) corners[count * i + k] = square[k % 4] + (k < 4 ? 0 : kLayer);
  }
  dsw_environment_desc_init(&d, sizeof d);
  d.dimension = dimension;
  d.points = points;
  d.point_count = dimension == 3 ? 2 * kLayer : kLayer;
  d.point_stride_bytes = 24;
  d.connectivity = corners;
  d.connectivity_count = count * kCells;
  d.volume_count = kCells;
  if (dimension == 2) d.uniform_cell_type = DSW_CELL_TYPE_QUAD;
  return dsw_environment_create(NULL, &d, environment, NULL);
}

static dsw_status mark_pegs(uint32_t dimension, dsw_environment *environment) {
  dsw_vertex_id pegs[FIGURE5_PEGS];
  dsw_edge_id marked_edges[FIGURE5_PEGS];
  uint32_t ends[2 * FIGURE5_PEGS], indices[FIGURE5_PEGS];
  size_t i;
  dsw_status status;
  for (i = 0; i < FIGURE5_PEGS; ++i) {
    indices[i] = kPegs[i][0] + (kAcross + 1) * kPegs[i][1];
    ends[2 * i] = indices[i];
    ends[2 * i + 1] = indices[i] + kLayer;
  }
  if (dimension == 2) {
    for (i = 0; i < FIGURE5_PEGS; ++i) {
      status = dsw_environment_get_vertex_id(environment, indices[i], &pegs[i]);
      if (status != DSW_STATUS_OK) return status;
    }
    return dsw_environment_mark_vertices(environment, pegs, FIGURE5_PEGS, DSW_MARK_IMPASSABLE);
  }
  status = dsw_environment_find_edges(environment, FIGURE5_PEGS, ends, marked_edges, NULL);
  return status != DSW_STATUS_OK
             ? status
             : dsw_environment_mark_edges(environment, marked_edges, FIGURE5_PEGS, DSW_MARK_IMPASSABLE);
}

static dsw_status make_edge(dsw_scene *scene, dsw_body_id *body) {
  static const uint32_t kEnds[2] = {0, 1};
  dsw_body_desc d;
  dsw_body_desc_init(&d, sizeof d);
  d.level = DSW_LEVEL_EDGES_SWEPT;
  d.positions = &kFrom[0][0];
  d.stride_bytes = 24;
  d.vertex_count = 2;
  d.edges = kEnds;
  d.edge_count = 1;
  return dsw_body_create(scene, &d, body);
}

static uint32_t peg_at(const double *place) {
  uint32_t i;
  for (i = 0; i < FIGURE5_PEGS; ++i) {
    if (fabs(place[0] - kPegs[i][0]) < kNear && fabs(place[1] - kPegs[i][1]) < kNear) return i;
  }
  return FIGURE5_NO_PEG;
}

static dsw_status move_edge(dsw_scene *scene, dsw_body_id body, figure5_panel panel, const figure5_options *options,
                            figure5_answer *answer) {
  static const uint32_t kMoves = 0;
  double targets[2][3], places[kMost][3];
  dsw_move_options o;
  dsw_move_report report;
  const dsw_body_contact *contacts = NULL;
  const dsw_body_edit *edits = NULL;
  size_t count = 0, i;
  dsw_status status;
  memcpy(targets, kFrom, sizeof targets);
  targets[0][1] = panel == FIGURE5_VERTEX_STOP ? kUpTo : kDown;
  dsw_move_options_init(&o, sizeof o);
  o.edge_response = figure5_response(panel);
  o.search = options->search;
  o.bisection_depth = options->bisection_depth;
  o.min_part = options->min_part;
  o.order = &kMoves;
  o.order_count = 1;
  status = dsw_body_move(scene, body, &targets[0][0], 2, 24, &o, &report);
  if (status != DSW_STATUS_OK) return status;
  answer->inserted = report.edit_count;
  answer->contacts = report.contact_count;
  answer->stopped = report.vertices_stopped;
  status = dsw_body_get_positions(scene, body, &places[0][0], kMost, 24, NULL, &count);
  if (status != DSW_STATUS_OK) return status;
  memcpy(answer->end, places[0], sizeof answer->end);
  status = dsw_body_get_contacts(scene, body, &contacts, &count);
  if (status != DSW_STATUS_OK) return status;
  if (count != 0) {
    memcpy(answer->first_contact, contacts[0].point, sizeof answer->first_contact);
    answer->first_time = contacts[0].time;
  }
  status = dsw_body_get_edits(scene, body, &edits, &count);
  for (i = 0; status == DSW_STATUS_OK && i < count && i < kMost; ++i) {
    const uint32_t at = edits[i].vertex.index;
    answer->pegs[i] = edits[i].inserted && at < kMost ? peg_at(places[at]) : FIGURE5_NO_PEG;
  }
  return status;
}

int figure5_run(uint32_t dimension, figure5_panel panel, const figure5_options *options, figure5_answer *answer) {
  dsw_environment *environment = NULL;
  dsw_scene *scene = NULL;
  dsw_body_id body = {0, 0};
  int done;
  memset(answer, 0, sizeof *answer);
  done = make_ground(dimension, &environment) == DSW_STATUS_OK && mark_pegs(dimension, environment) == DSW_STATUS_OK &&
         dsw_scene_create(environment, NULL, &scene) == DSW_STATUS_OK && make_edge(scene, &body) == DSW_STATUS_OK &&
         move_edge(scene, body, panel, options, answer) == DSW_STATUS_OK;
  if (scene != NULL) done = dsw_scene_destroy(scene) == DSW_STATUS_OK && done;
  if (environment != NULL) done = dsw_environment_destroy(environment) == DSW_STATUS_OK && done;
  return done;
}

int figure5_is_expected(figure5_panel panel, const figure5_answer *answer) {
  /* At A the edge is 1 in 15 steep, at D 1 in 1: along that it slides, by what is left of the way. */
  static const struct {
    uint32_t inserted, contacts, pegs[3];
    double end[2];
  } kExpected[FIGURE5_PANELS] = {
      {0, 1, {0}, {15.5, 8}},
      {0, 1, {0}, {15.5, 6.5}},
      {2, 3, {FIGURE5_A, FIGURE5_B}, {15.5, 1.5}},
      {3, 2, {FIGURE5_A, FIGURE5_B, FIGURE5_C}, {15.5, 1.5}},
      {1, 2, {FIGURE5_A}, {15.5, 3.25}},
      {0, 1, {0}, {15.5 + 15 * 5.75 / 226, 6.5 - 5.75 / 226}},
      {2, 3, {FIGURE5_A, FIGURE5_B}, {15.5 + 0.375, 1.5 - 0.375}},
  };
  uint32_t i;
  if (answer->inserted != kExpected[panel].inserted || answer->contacts != kExpected[panel].contacts) return 0;
  for (i = 0; i < answer->inserted; ++i) {
    if (answer->pegs[i] != kExpected[panel].pegs[i]) return 0;
  }
  return answer->stopped == 1 && fabs(answer->end[0] - kExpected[panel].end[0]) < kNear &&
         fabs(answer->end[1] - kExpected[panel].end[1]) < kNear;
}
