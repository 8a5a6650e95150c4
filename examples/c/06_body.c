/* A body: two vertices and the edge between them, pushed to the right against a pillar, and what each response makes
 * of it.
 *
 *   b ------> b'
 *   |               4 x 4 cubes in one layer, seen from above;
 *   |   +---+       the pillar is one of them, x from 2 to 3, y from 1 to 2, tag 106
 *   |   +---+
 *   a ------> a'                                                               */
#include <dartsweep/dartsweep.h>
#include <stdio.h>
#include <stdlib.h>

enum { kSide = 4, kPoints = 2 * (kSide + 1) * (kSide + 1), kCells = kSide * kSide, kMost = 8 };

static void check(int good, const char *what) {
  if (!good) {
    fprintf(stderr, "%s: %s\n", what, dsw_last_error_message());
    exit(1);
  }
}

static dsw_environment *create_layer(void) {
  static const int corners[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                    {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  static double points[kPoints][3];
  static int32_t cells[kCells][8];
  static uint32_t tags[kCells];
  dsw_environment *environment = NULL;
  dsw_environment_desc desc;
  int i, k;
  for (i = 0; i < kPoints; ++i) {
    points[i][0] = i % (kSide + 1);
    points[i][1] = i / (kSide + 1) % (kSide + 1);
    points[i][2] = i / (kSide + 1) / (kSide + 1);
  }
  for (i = 0; i < kCells; ++i) {
    tags[i] = 100 + (uint32_t)i;
    for (k = 0; k < 8; ++k) {
      const int x = i % kSide + corners[k][0], y = i / kSide + corners[k][1];
      cells[i][k] = (corners[k][2] * (kSide + 1) + y) * (kSide + 1) + x;
    }
  }
  dsw_environment_desc_init(&desc, sizeof desc);
  desc.index_bytes = 4;
  desc.points = &points[0][0];
  desc.point_count = kPoints;
  desc.connectivity = &cells[0][0];
  desc.connectivity_count = 8 * kCells;
  desc.volume_count = kCells;
  desc.tags = tags;
  check(dsw_environment_create(NULL, &desc, &environment, NULL) == DSW_STATUS_OK, "creating");
  return environment;
}

static dsw_body_id create_body(dsw_scene *scene) {
  static const double positions[2][3] = {{1.25, 0.25, 0.5}, {1.25, 3.75, 0.5}};
  static const uint32_t edge[2] = {0, 1};
  dsw_body_desc desc;
  dsw_body_id body;
  dsw_body_desc_init(&desc, sizeof desc);
  desc.positions = &positions[0][0];
  desc.vertex_count = 2;
  desc.edges = edge;
  desc.edge_count = 1;
  check(dsw_body_create(scene, &desc, &body) == DSW_STATUS_OK, "creating a body");
  return body;
}

/* Whether a vertex rests, slides or bounces: what it touched before tells. */
static const char *history_of(const dsw_body_contact *now, const dsw_previous_contact *past) {
  double way = 0;
  int k;
  for (k = 0; k < 3; ++k) way += (now->point[k] - past->point[k]) * (now->point[k] - past->point[k]);
  if (past->since == 0) return "first";
  if (past->since > 1) return "bouncing";
  return way < 1e-6 ? "resting" : "sliding";
}

static void print_contacts(const dsw_scene *scene, dsw_body_id body) {
  static const char *const kWhat[] = {"nothing", "a vertex", "an edge", "a face", "a volume"};
  const dsw_body_contact *c = NULL;
  const dsw_previous_contact *past = NULL;
  size_t count = 0, i;
  check(dsw_body_get_contacts(scene, body, &c, &count) == DSW_STATUS_OK, "reading contacts");
  check(dsw_body_get_previous_contacts(scene, body, &past, &count) == DSW_STATUS_OK, "reading what was before");
  for (i = 0; i < count; ++i) {
    printf("    vertex %u at time %.4f: %s touches %s, tag %u, at (%g, %g, %g), normal (%.3f, %.3f, %.3f), %s\n",
           (unsigned)c[i].vertex.index, c[i].time, c[i].edge.generation != 0 ? "its edge" : "it",
           kWhat[c[i].contact.obstacle.kind], (unsigned)c[i].contact.tag, c[i].point[0], c[i].point[1], c[i].point[2],
           c[i].contact.normal[0], c[i].contact.normal[1], c[i].contact.normal[2], history_of(&c[i], &past[i]));
    /* A sliding vertex may go as far as the outer boundary. */
    check(c[i].edge.generation == 0 || (c[i].contact.tag == 106 && c[i].contact.marked_kind == DSW_CELL_VOLUME),
          "edges touch the pillar");
  }
}

int main(void) {
  static const struct {
    const char *name;
    dsw_response response;
    uint32_t vertices; /* at the end */
  } kRuns[] = {
      {"static", DSW_RESPONSE_STOP, 2}, {"adaptive", DSW_RESPONSE_ADAPTIVE_ONE, 4}, {"slide", DSW_RESPONSE_SLIDE, 2}};
  dsw_environment *environment = create_layer();
  dsw_move_options options;
  dsw_volume_id pillar;
  size_t count = 0, i;
  int run, push;

  check(dsw_environment_get_volume_id(environment, 6, &pillar) == DSW_STATUS_OK, "finding the pillar");
  check(dsw_environment_mark_volumes(environment, &pillar, 1, DSW_MARK_IMPASSABLE, 0, NULL) == DSW_STATUS_OK,
        "marking");

  for (run = 0; run < 3; ++run) {
    dsw_scene *scene = NULL;
    dsw_body_id body;
    double p[3 * kMost];
    check(dsw_scene_create(environment, NULL, &scene) == DSW_STATUS_OK, "creating a scene");
    body = create_body(scene);
    dsw_move_options_init(&options, sizeof options);
    options.edge_response = kRuns[run].response;
    options.min_part = 0.125; /* a vertex may be inserted where both parts keep an eighth of the edge */
    printf("%s\n", kRuns[run].name);
    for (push = 1; push <= 2; ++push) {
      dsw_move_report report;
      /* The first push moves all to the right by 1.5, the second by another 0.5. Targets stand by vertex. */
      check(dsw_body_get_positions(scene, body, p, kMost, 0, NULL, &count) == DSW_STATUS_OK, "reading positions");
      for (i = 0; i < count; ++i) p[3 * i] += push == 1 ? 1.5 : 0.5;
      check(dsw_body_move(scene, body, p, count, 0, &options, &report) == DSW_STATUS_OK, "moving");
      printf("  push %d: %u of %u vertices stopped, %u inserted, %u contacts\n", push,
             (unsigned)report.vertices_stopped, (unsigned)report.vertices_moved, (unsigned)report.edit_count,
             (unsigned)report.contact_count);
      print_contacts(scene, body);
      check(report.contact_count > 0, "the pillar is met");
    }
    check(dsw_body_get_positions(scene, body, p, kMost, 0, NULL, &count) == DSW_STATUS_OK, "reading positions");
    printf("  it ends at");
    for (i = 0; i < count; ++i) printf(" (%.4f, %.4f)", p[3 * i], p[3 * i + 1]);
    printf("\n");
    check(count == kRuns[run].vertices, "how many vertices there are");
    check(dsw_scene_destroy(scene) == DSW_STATUS_OK, "destroying the scene"); /* and its bodies */
  }
  check(dsw_environment_destroy(environment) == DSW_STATUS_OK, "destroying");
  return 0;
}
