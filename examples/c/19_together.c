/* Two strands side by side are carried to the right. One vertex at a time, the left strand runs into the right one. With
 * all vertices at once neither is in the other's way. Then the floor rises, and stops just before the strands.
 *
 *   4 .--------------.
 *     |   |  |  -->  |     the left strand is at x = 1, the right one at x = 1.25
 *   0 '--------------'     both go by 1                                          */
#include <dartsweep/dartsweep.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { kVertices = 3, kCorners = 8 };

/* The room: one hexahedron, in the order of VTK. Its outer boundary is a wall. */
static const double corners[kCorners][3] = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0},
                                            {0, 0, 4}, {4, 0, 4}, {4, 4, 4}, {0, 4, 4}};
static const int64_t room[kCorners] = {0, 1, 2, 3, 4, 5, 6, 7};

static void check(int good, const char *what) {
  if (!good) {
    fprintf(stderr, "%s: %s\n", what, dsw_last_error_message());
    exit(1);
  }
}

static void put_strand(double (*to)[3], double x) {
  int i;
  for (i = 0; i < kVertices; ++i) {
    to[i][0] = x;
    to[i][1] = 1 + i;
    to[i][2] = 1;
  }
}

static dsw_body_id make_strand(dsw_scene *scene, double x) {
  static const uint32_t edges[] = {0, 1, 1, 2};
  double positions[kVertices][3];
  dsw_body_desc desc;
  dsw_body_id strand;
  put_strand(positions, x);
  dsw_body_desc_init(&desc, sizeof desc);
  desc.positions = positions[0];
  desc.vertex_count = kVertices;
  desc.edges = edges;
  desc.edge_count = kVertices - 1;
  check(dsw_body_create(scene, &desc, &strand) == DSW_STATUS_OK, "making a strand");
  return strand;
}

int main(void) {
  double targets[2 * kVertices][3], next[kCorners][3];
  dsw_environment_desc desc;
  dsw_scene_desc with;
  dsw_environment *environment = NULL;
  dsw_scene *scene = NULL;
  dsw_body_id strands[2];
  dsw_move_report moved[2];
  dsw_deform_report risen;
  const dsw_wall_contact *contacts = NULL;
  size_t count = 0, i;

  dsw_environment_desc_init(&desc, sizeof desc);
  desc.points = corners[0];
  desc.point_count = kCorners;
  desc.uniform_cell_type = DSW_CELL_TYPE_HEXAHEDRON;
  desc.volume_count = 1;
  desc.connectivity = room;
  desc.connectivity_count = kCorners;
  check(dsw_environment_create(NULL, &desc, &environment, NULL) == DSW_STATUS_OK, "making the room");
  dsw_scene_desc_init(&with, sizeof with);
  with.features = DSW_FEATURE_BODY_CONTACTS | DSW_FEATURE_DEFORMING;
  check(dsw_scene_create(environment, &with, &scene) == DSW_STATUS_OK, "making a scene");
  strands[0] = make_strand(scene, 1);
  strands[1] = make_strand(scene, 1.25);

  put_strand(targets, 2);
  put_strand(targets + kVertices, 2.25);
  check(dsw_scene_move_together(scene, strands, 2, targets[0], 2 * kVertices, 0, NULL, moved) == DSW_STATUS_OK,
        "moving together");
  printf("together: %.17g of the way\n", moved[0].fraction);
  check(moved[0].fraction == 1 && moved[1].fraction == 1, "both strands arrive");

  put_strand(targets, 3);
  put_strand(targets + kVertices, 3.25);
  check(dsw_scene_move_bodies(scene, strands, 2, targets[0], 2 * kVertices, 0, NULL, moved) == DSW_STATUS_OK,
        "moving one vertex at a time");
  printf("one vertex at a time: %u vertices of the left strand stop\n", (unsigned)moved[0].vertices_stopped);
  check(moved[0].vertices_stopped > 0, "the right strand is in the way");

  /* The floor is to rise by 2. It meets the strands, which rest at a height of 1. */
  memcpy(next, corners, sizeof next);
  for (i = 0; i < 4; ++i) next[i][2] = 2;
  check(dsw_scene_deform(scene, next[0], kCorners, NULL, 0, NULL, 0, 0, NULL, &risen, NULL) == DSW_STATUS_OK,
        "raising the floor");
  check(dsw_environment_get_wall_contacts(environment, &contacts, &count) == DSW_STATUS_OK, "contacts of walls");
  printf("the floor stops at height %.17g, with %u contacts\n", next[0][2], (unsigned)count);
  check(risen.outcome == DSW_DEFORM_FRACTION && risen.fraction < 0.5 && risen.fraction > 0.4999999, "half of the way");
  check(count > 0 && contacts[0].time == 0.5 && next[0][2] < 1, "just below the strands");

  dsw_scene_destroy(scene);
  dsw_environment_destroy(environment);
  return 0;
}
