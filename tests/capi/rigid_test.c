/* Rigid bodies, DSW_BODY_RIGID: walls push them as a whole, or wait. In space and in the plane. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../effort.h"
#include "check.h"
#include "fixture.h"

/* 4 x 12 unit squares, or cubes in two layers, and the two arrays of their points. A floor lies at y = 1. */
enum { NX = 4, NY = 12, MOST_POINTS = (NX + 1) * (NY + 1) * 3, MOST_VERTICES = 16 };

static unsigned g_dimension;
static dsw_environment *g_env;
static dsw_scene *g_scene;
static double g_points[2][3 * MOST_POINTS];
static int g_next; /* the array that may be written */
static size_t g_point_count;

static void mark_row(uint32_t row) {
  uint32_t x, z;
  for (x = 0; x < NX; ++x) {
    for (z = 0; z < g_dimension - 1; ++z) {
      CHECK_OK(set_face_mark(g_env, x + NX * (row + NY * z), g_dimension == 2 ? 2 : FACE_Y1, DSW_MARK_IMPASSABLE));
    }
  }
}

static void begin(unsigned dimension, uint32_t features) {
  const double *points = NULL;
  g_dimension = dimension;
  g_env = dimension == 2 ? make_squares(NULL, NX, NY) : make_environment(NULL, NX, NY, 2);
  g_scene = make_scene(g_env, DSW_FEATURE_DEFORMING | features);
  CHECK_OK(dsw_environment_get_points(g_env, &points, &g_point_count));
  memcpy(g_points[0], points, dimension * g_point_count * sizeof(double));
  memcpy(g_points[1], points, dimension * g_point_count * sizeof(double));
  g_next = 0;
  mark_row(0);
}

static void end(void) { end_scene(g_scene); }

/* To the array that may be written, which becomes the other one. */
static dsw_deform_report deform(const dsw_deform_options *o) {
  dsw_deform_report report;
  memset(&report, 0x55, sizeof report);
  CHECK_OK(dsw_environment_deform(g_env, g_points[g_next], g_point_count, o, &report));
  if (report.outcome != DSW_DEFORM_REFUSED) {
    memcpy(g_points[1 - g_next], g_points[g_next], sizeof g_points[0]);
    g_next = 1 - g_next;
  }
  return report;
}

/* Height of the points at (x, row), in space of all layers. */
static void raise_point(uint32_t x, uint32_t row, double by) {
  uint32_t z;
  for (z = 0; z < (g_dimension == 2 ? 1 : 3); ++z) {
    g_points[g_next][g_dimension * (x + (NX + 1) * (row + (NY + 1) * z)) + 1] += by;
  }
}

static void raise_row(uint32_t row, double by) {
  uint32_t x;
  for (x = 0; x <= NX; ++x) raise_point(x, row, by);
}

/* A body whose vertices are joined by lines in their order; x and y of each. In space its z are given by turns. */
static dsw_body_id make(const double *xy, size_t count, dsw_level level, uint32_t flags) {
  double positions[3 * MOST_VERTICES];
  dsw_body_desc d;
  dsw_body_id body = {0, 0};
  size_t i;
  for (i = 0; i < count; ++i) {
    positions[g_dimension * i] = xy[2 * i];
    positions[g_dimension * i + 1] = xy[2 * i + 1];
    if (g_dimension == 3) positions[3 * i + 2] = i % 2 == 0 ? 0.97 : 1.06;
  }
  d = line_desc(positions, count, 0, level);
  d.flags = flags;
  CHECK_OK(dsw_body_create(g_scene, &d, &body));
  return body;
}

static size_t read(dsw_body_id body, double (*at)[3]) {
  double flat[3 * MOST_VERTICES];
  size_t count = 0, i;
  unsigned k;
  CHECK_OK(dsw_body_get_positions(g_scene, body, flat, MOST_VERTICES, 0, NULL, &count));
  for (i = 0; i < count; ++i) {
    at[i][2] = 0;
    for (k = 0; k < g_dimension; ++k) at[i][k] = flat[g_dimension * i + k];
  }
  return count;
}

static double distance(const double *a, const double *b) {
  return sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]));
}

/* The largest change of a distance between two vertices. */
static double change(double (*before)[3], double (*now)[3], size_t count) {
  double largest = 0;
  size_t a, b;
  for (a = 0; a < count; ++a) {
    for (b = 0; b < a; ++b) largest = fmax(largest, fabs(distance(now[a], now[b]) - distance(before[a], before[b])));
  }
  return largest;
}

static const double g_rod[6] = {1.2, 1.1, 2.0, 1.1, 2.8, 1.1}, kUnit = 2.220446049250313e-16;

/* One vertex of the wall rises below one end of a rod, or below its middle: the rod is lifted as it is. If something is above its other
   end, it turns. */
static void a_rod_is_lifted_or_turns(unsigned dimension) {
  static const double lid[6] = {1.15, 1.3, 1.2, 1.3, 1.25, 1.3};
  enum { BELOW_MIDDLE, BELOW_END, UNDER_A_LID };
  int where, rigid;
  for (where = BELOW_MIDDLE; where <= UNDER_A_LID; ++where) {
    for (rigid = 0; rigid < 2; ++rigid) {
      double before[MOST_VERTICES][3], now[MOST_VERTICES][3];
      dsw_deform_report report;
      const dsw_wall_contact *contacts = NULL;
      size_t count = 0;
      dsw_body_id body;
      begin(dimension, where == UNDER_A_LID ? DSW_FEATURE_BODY_CONTACTS : 0);
      body = make(g_rod, 3, DSW_LEVEL_EDGES_SWEPT, rigid ? DSW_BODY_RIGID : 0);
      if (where == UNDER_A_LID) make(lid, 3, DSW_LEVEL_EDGES_SWEPT, DSW_BODY_RIGID);
      read(body, before);
      raise_point(where == BELOW_MIDDLE ? 2 : 3, 1, 0.4);
      report = deform(NULL);
      CHECK(report.outcome == DSW_DEFORM_DONE && report.contact_count > 0 && report.pushed_count > 0);
      CHECK_OK(dsw_environment_get_wall_contacts(g_env, &contacts, &count));
      CHECK(contacts[0].response == DSW_WALL_PUSH && contacts[0].body.index == body.index);
      CHECK(read(body, now) == 3);
      if (!rigid) {
        CHECK((change(before, now, 3) > 0.01) == (dimension == 2 || where != BELOW_MIDDLE)); /* vertices, or edges */
        end();
        continue;
      }
      CHECK(change(before, now, 3) <= 8 * 3 * kUnit && report.pushed_count % 3 == 0);
      if (where == UNDER_A_LID) {
        CHECK(now[2][1] - now[0][1] > 0.05 && now[0][1] > 1 && now[0][1] < 1.3);
      } else {
        CHECK(now[2][1] == now[0][1] && now[1][1] == now[0][1] && now[1][1] > 1.3);
      }
      end();
    }
  }
}

/* The far end of an upright rod enters cells that nobody has met, several of them at once. */
static void a_long_rod_enters_new_cells(unsigned dimension) {
  static const double upright[4] = {2.1, 1.05, 2.2, 2.02};
  double before[MOST_VERTICES][3], now[MOST_VERTICES][3];
  dsw_deform_report report;
  dsw_body_id body;
  uint32_t row;
  int i;
  for (i = 0; i < 2; ++i) {
    dsw_deform_options o = deform_options_of(i == 0 ? DSW_DEFORM_SWEPT : DSW_DEFORM_END_STATE, DSW_WALL_PUSH);
    begin(dimension, 0);
    for (row = 3; row < NY; ++row) raise_row(row, 2 + 0.05 * (row - 2) - row); /* thin ones */
    CHECK(deform(NULL).outcome == DSW_DEFORM_DONE);
    body = make(upright, 2, DSW_LEVEL_EDGES_SWEPT, DSW_BODY_RIGID);
    read(body, before);
    raise_row(1, 0.4);
    report = deform(&o);
    CHECK(report.outcome == DSW_DEFORM_DONE && report.pushed_count > 0);
    read(body, now);
    CHECK(change(before, now, 2) <= 8 * 3 * kUnit && now[0][1] >= 1.4 && now[1][1] > 2.35);
    end();
  }
}

/* Between a floor and a ceiling there is no way: the wall waits, or all of them. */
static void what_is_squeezed_holds_the_walls(unsigned dimension) {
  int i;
  for (i = 0; i < 2; ++i) {
    dsw_deform_options o = deform_options_of(i == 0 ? DSW_DEFORM_SWEPT : DSW_DEFORM_END_STATE, DSW_WALL_PUSH);
    double before[MOST_VERTICES][3], now[MOST_VERTICES][3];
    dsw_deform_report report;
    dsw_body_id body;
    static const double frame[8] = {1.2, 1.1, 1.5, 1.9, 2.5, 1.85, 2.8, 1.15};
    begin(dimension, 0);
    mark_row(1);
    body = make(frame, 4, DSW_LEVEL_EDGES_SWEPT, DSW_BODY_RIGID);
    read(body, before);
    raise_row(1, 0.3);
    report = deform(&o);
    CHECK(report.outcome == (i == 0 ? DSW_DEFORM_HELD : DSW_DEFORM_FRACTION) && report.contact_count > 0);
    read(body, now);
    CHECK(change(before, now, 4) <= 8 * 3 * kUnit);
    end();
  }
}

/* A body in front is not passed: the wall waits, or in space the body turns aside. */
static void another_body_is_in_the_way(unsigned dimension) {
  static const double bent[6] = {1.2, 1.19, 2.0, 1.1, 2.8, 1.19}, above[6] = {1.3, 1.2, 2.1, 1.2, 2.9, 1.2};
  double before[MOST_VERTICES][3], now[MOST_VERTICES][3], other[MOST_VERTICES][3];
  dsw_body_id body, in_front;
  int meets;
  for (meets = 0; meets < 2; ++meets) {
    dsw_deform_report report;
    begin(dimension, meets ? DSW_FEATURE_BODY_CONTACTS : 0);
    body = make(bent, 3, DSW_LEVEL_EDGES_SWEPT, DSW_BODY_RIGID);
    in_front = make(above, 3, DSW_LEVEL_EDGES_SWEPT, DSW_BODY_RIGID);
    read(body, before);
    raise_point(2, 1, 0.15);
    report = deform(NULL);
    read(body, now);
    read(in_front, other);
    CHECK(change(before, now, 3) <= 8 * 3 * kUnit && other[1][1] == 1.2);
    CHECK(report.held_count == (meets && dimension == 2 ? 1u : 0u));
    if (meets && dimension == 2) {
      CHECK(memcmp(before, now, 3 * sizeof now[0]) == 0);
    } else {
      CHECK(now[0][1] > 1.2 && now[1][1] > 1.149 && report.outcome == DSW_DEFORM_DONE);
    }
    end();
  }
}

static double random_share(void) {
  static uint64_t state = 0;
  if (state == 0) state = seed_of(88172645463325252u);
  state ^= state << 13;
  state ^= state >> 7;
  state ^= state << 17;
  return (double)(state >> 11) / 9007199254740992.0;
}

/* Thousands of pushes, and rigid motions of the host's between them: distances keep to 8 units in the last place of the
   largest coordinate, once for all. */
static void ten_thousand_pushes_do_not_bend_it(unsigned dimension) {
  const uint32_t some = (uint32_t)effort_of(10000), wanted = some > 2500 ? some : 2500; /* fewer may not turn it */
  static const double tool[10] = {1.1, 1.5, 1.7, 1.3, 2.0, 1.9, 2.4, 1.4, 2.9, 1.6};
  double first[MOST_VERTICES][3], before[MOST_VERTICES][3], now[MOST_VERTICES][3], worst = 0, turned = 0;
  double heights[NX + 1] = {0};
  uint32_t pushes = 0, steps = 0, held = 0;
  dsw_body_id body;
  begin(dimension, 0);
  body = make(tool, 5, DSW_LEVEL_EDGES_SWEPT, DSW_BODY_RIGID);
  read(body, first);
  while (pushes < wanted && steps < 10 * wanted) {
    const uint32_t x = (uint32_t)(random_share() * (NX + 1));
    const double to = 0.7 * random_share();
    dsw_rigid_motion fall = {{0, 0, 0, 1}, {0, 0, 0}, {0, -0.3, 0}};
    dsw_deform_report report;
    dsw_deform_options o = deform_options_of(steps % 8 == 0 ? DSW_DEFORM_END_STATE : DSW_DEFORM_SWEPT, DSW_WALL_PUSH);
    ++steps;
    read(body, before);
    raise_point(x, 1, to - heights[x]);
    report = deform(&o);
    heights[x] = report.outcome == DSW_DEFORM_DONE ? to : g_points[g_next][g_dimension * (x + (NX + 1) * 1) + 1] - 1;
    held += report.outcome == DSW_DEFORM_DONE ? 0 : 1;
    pushes += report.pushed_count / 5;
    CHECK(read(body, now) == 5);
    worst = fmax(worst, change(first, now, 5));
    turned = fmax(turned, fabs((now[4][1] - now[0][1]) - (first[4][1] - first[0][1])));
    fall.translation[0] = 0.02 * (2 - now[2][0]); /* and back to the middle */
    CHECK_OK(dsw_body_move_rigid(g_scene, body, &fall, NULL, NULL));
    read(body, now);
    worst = fmax(worst, change(first, now, 5));
  }
  CHECK(pushes >= wanted && turned > 0.05);
  CHECK(held < steps / 2);
  CHECK(worst > 0 && worst <= 8 * 4 * kUnit);
  end();
}

/* END_STATE: a bump that has come through an edge between its vertices. */
static void edges_that_are_not_free(unsigned dimension) {
  static const dsw_wall_response responses[3] = {DSW_WALL_PUSH, DSW_WALL_INSERT, DSW_WALL_STOP};
  int i, rigid;
  for (i = 0; i < 3; ++i) {
    for (rigid = 0; rigid < 2; ++rigid) {
      static const double ends[4] = {1.2, 1.1, 2.7, 1.12};
      dsw_deform_options o = deform_options_of(DSW_DEFORM_END_STATE, responses[i]);
      double before[MOST_VERTICES][3], now[MOST_VERTICES][3];
      const dsw_wall_contact *contacts = NULL;
      const dsw_body_edit *edits = NULL;
      dsw_deform_report report;
      size_t count = 0, edit_count = 0;
      dsw_body_id body;
      begin(dimension, 0);
      body = make(ends, 2, DSW_LEVEL_EDGES, rigid ? DSW_BODY_RIGID : 0);
      read(body, before);
      raise_point(2, 1, 0.35);
      report = deform(&o);
      CHECK_OK(dsw_body_get_edits(g_scene, body, &edits, &edit_count));
      CHECK_OK(dsw_environment_get_wall_contacts(g_env, &contacts, &count));
      CHECK(count == report.contact_count);
      CHECK(read(body, now) == (!rigid && responses[i] == DSW_WALL_INSERT ? 3u : 2u));
      if (responses[i] == DSW_WALL_STOP || (!rigid && responses[i] == DSW_WALL_PUSH)) {
        CHECK(report.outcome == DSW_DEFORM_FRACTION && report.fraction == 0.25 && edit_count == 0);
        CHECK(memcmp(before, now, 2 * sizeof now[0]) == 0);
      } else {
        CHECK(report.outcome == DSW_DEFORM_DONE && count == 1 && contacts[0].edge.generation == 1);
        CHECK(fabs(contacts[0].point[0] - 2) < 0.1 && contacts[0].contact.normal[1] > 0.9);
        CHECK(contacts[0].response == (rigid ? DSW_WALL_PUSH : DSW_WALL_INSERT) && contacts[0].moving.generation == 0);
        CHECK(contacts[0].contact.wall.generation == 1 && report.pushed_count == (rigid ? 2u : 1u));
        if (rigid) {
          CHECK(edit_count == 0 && change(before, now, 2) <= 8 * 3 * kUnit);
          CHECK(now[0][1] + now[1][1] > 2.2);
        } else {
          CHECK(edit_count == 1 && edits[0].inserted == 1 && edits[0].vertex.index == 2 && now[2][1] >= 1.35);
          CHECK(now[2][1] < 1.36 && memcmp(before, now, 2 * sizeof now[0]) == 0);
          CHECK(edits[0].edge_parameter == contacts[0].edge_parameter);
        }
      }
      end();
    }
  }
}

/* A bend where a part would be too short is none. */
static void min_part_holds_there_too(unsigned dimension) {
  static const double ends[4] = {1.9, 1.1, 2.9, 1.1};
  dsw_deform_options o = deform_options_of(DSW_DEFORM_END_STATE, DSW_WALL_INSERT);
  int i;
  for (i = 0; i < 2; ++i) {
    dsw_deform_report report;
    dsw_body_id body;
    double now[MOST_VERTICES][3];
    begin(dimension, 0);
    body = make(ends, 2, DSW_LEVEL_EDGES, 0);
    o.min_part = i == 0 ? 0 : 0.01;
    raise_point(2, 1, 0.125);
    report = deform(&o);
    CHECK(report.outcome == (i == 0 ? DSW_DEFORM_FRACTION : DSW_DEFORM_DONE));
    CHECK(read(body, now) == (i == 0 ? 2u : 3u));
    end();
  }
}

/* Two bumps under one edge: two vertices. */
static void an_edge_is_bent_twice(unsigned dimension) {
  static const double ends[4] = {0.3, 1.1, 3.7, 1.1};
  dsw_deform_options o = deform_options_of(DSW_DEFORM_END_STATE, DSW_WALL_INSERT);
  dsw_deform_report report;
  dsw_body_id body;
  double now[MOST_VERTICES][3];
  o.min_part = 0.1; /* the first part is a fifth */
  begin(dimension, 0);
  body = make(ends, 2, DSW_LEVEL_EDGES, 0);
  raise_point(1, 1, 0.3);
  raise_point(3, 1, 0.3);
  report = deform(&o);
  CHECK(report.outcome == DSW_DEFORM_DONE && report.contact_count == 2);
  CHECK(read(body, now) == 4 && now[2][1] >= 1.3 && now[3][1] >= 1.3);
  end();
}

/* dsw_body_move moves vertices as it is told, and that is the shape then; no response inserts any. */
static void moves_set_the_shape(unsigned dimension) {
  double before[MOST_VERTICES][3], now[MOST_VERTICES][3], targets[9];
  dsw_move_options o = move_options();
  dsw_move_report report;
  dsw_body_id body;
  size_t i;
  unsigned k;
  begin(dimension, 0);
  body = make(g_rod, 3, DSW_LEVEL_EDGES_SWEPT, DSW_BODY_RIGID);
  read(body, before);
  before[1][1] = 1.3;
  for (i = 0; i < 3; ++i) {
    for (k = 0; k < dimension; ++k) targets[dimension * i + k] = before[i][k];
  }
  CHECK_OK(dsw_body_move(g_scene, body, targets, 3, 0, NULL, NULL));
  read(body, now);
  CHECK(memcmp(before, now, 3 * sizeof now[0]) == 0);
  raise_row(1, 0.4);
  CHECK(deform(NULL).outcome == DSW_DEFORM_DONE);
  read(body, now);
  CHECK(now[0][1] >= 1.4 && now[1][1] >= 1.4 && now[2][1] >= 1.4 && change(before, now, 3) <= 8 * 3 * kUnit);
  /* Ends below the floor's bump, edges on it. */
  raise_row(1, -0.4);
  CHECK(deform(NULL).outcome == DSW_DEFORM_DONE);
  raise_point(2, 1, 0.3);
  CHECK(deform(NULL).outcome == DSW_DEFORM_DONE);
  read(body, now);
  for (i = 0; i < 3; ++i) {
    for (k = 0; k < dimension; ++k) targets[dimension * i + k] = now[i][k] - (k == 1 && i != 1 ? 0.6 : 0);
  }
  o.edge_response = DSW_RESPONSE_ADAPTIVE_MANY;
  CHECK_OK(dsw_body_move(g_scene, body, targets, 3, 0, &o, &report));
  CHECK(report.edit_count == 0 && read(body, now) == 3);
  end();
}

/* What is loaded is pushed as what was saved, also when a vertex was added after the last push. */
static void snapshots_keep_the_shape(unsigned dimension, int is_split) {
  const size_t count = is_split ? 4 : 3;
  double now[2][MOST_VERTICES][3];
  unsigned char *block, *again;
  size_t size = 0, again_size = 0;
  int i;
  dsw_body_id body;
  dsw_scene *loaded = NULL;
  for (i = 0; i < 2; ++i) {
    uint32_t x;
    begin(dimension, 0);
    body = make(g_rod, 3, DSW_LEVEL_EDGES_SWEPT, DSW_BODY_RIGID);
    for (x = 0; x < 4; ++x) {
      raise_point(x, 1, 0.3 + 0.01 * x);
      CHECK(deform(NULL).outcome == DSW_DEFORM_DONE);
    }
    if (is_split) {
      const dsw_body_edge_id edge = {1, 1};
      CHECK_OK(dsw_body_split_edge(g_scene, body, edge, 0.5, NULL));
    }
    if (i == 1) {
      CHECK_OK(dsw_scene_save(g_scene, NULL, 0, &size));
      block = (unsigned char *)malloc(size);
      again = (unsigned char *)malloc(size);
      CHECK_OK(dsw_scene_save(g_scene, block, size, &size));
      CHECK_OK(dsw_scene_destroy(g_scene));
      CHECK_OK(dsw_scene_load(g_env, block, size, &loaded));
      g_scene = loaded;
      CHECK_OK(dsw_scene_save(g_scene, again, size, &again_size));
      CHECK(again_size == size && memcmp(block, again, size) == 0);
      free(block);
      free(again);
    }
    for (x = 4; x > 0; --x) {
      raise_point(x, 1, 0.2 + 0.02 * x);
      CHECK(deform(NULL).outcome == DSW_DEFORM_DONE);
    }
    CHECK(read(body, now[i]) == count);
    end();
  }
  CHECK(memcmp(now[0], now[1], count * sizeof now[0][0]) == 0);
}

/* With an argument the pushes alone, which take nearly all of the time. */
int main(int argc, char **argv) {
  unsigned dimension;
  (void)argv;
  for (dimension = 2; dimension <= 3; ++dimension) {
    if (argc > 1) {
      ten_thousand_pushes_do_not_bend_it(dimension);
      continue;
    }
    a_rod_is_lifted_or_turns(dimension);
    a_long_rod_enters_new_cells(dimension);
    what_is_squeezed_holds_the_walls(dimension);
    another_body_is_in_the_way(dimension);
    edges_that_are_not_free(dimension);
    min_part_holds_there_too(dimension);
    an_edge_is_bent_twice(dimension);
    moves_set_the_shape(dimension);
    snapshots_keep_the_shape(dimension, 0);
    snapshots_keep_the_shape(dimension, 1);
  }
  return check_result();
}
