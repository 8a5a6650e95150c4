/* A closed surface falls on a spike. Its edges pass the spike on all sides; only its bottom face meets it. The
 * environment is a cube of side 2 split into six pyramids, that below is impassable: a spike with its tip at (1, 1, 1). */
#include <dartsweep/dartsweep.h>
#include <stdio.h>
#include <stdlib.h>

static void check(int good, const char *what) {
  if (!good) {
    fprintf(stderr, "%s: %s\n", what, dsw_last_error_message());
    exit(1);
  }
}

static dsw_environment *create_spike(void) {
  static const double points[] = {0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0, 0, 0, 2, 2, 0, 2, 2, 2, 2, 0, 2, 2, 1, 1, 1};
  /* A pyramid: its base counter-clockwise seen from the tip, then the tip. */
  static const int64_t cells[] = {0, 1, 2, 3, 8, 4, 7, 6, 5, 8, 0, 4, 5, 1, 8,
                                  1, 5, 6, 2, 8, 2, 6, 7, 3, 8, 3, 7, 4, 0, 8};
  dsw_environment *environment = NULL;
  dsw_environment_desc desc;
  dsw_volume_id spike;
  dsw_environment_desc_init(&desc, sizeof desc);
  desc.uniform_cell_type = DSW_CELL_TYPE_PYRAMID;
  desc.points = points;
  desc.point_count = 9;
  desc.connectivity = cells;
  desc.connectivity_count = 30;
  desc.volume_count = 6;
  check(dsw_environment_create(NULL, &desc, &environment, NULL) == DSW_STATUS_OK, "creating");
  check(dsw_environment_get_volume_id(environment, 0, &spike) == DSW_STATUS_OK, "finding the spike");
  check(dsw_environment_mark_volumes(environment, &spike, 1, DSW_MARK_IMPASSABLE, 0, NULL) == DSW_STATUS_OK, "marking");
  return environment;
}

/* A tetrahedron, its bottom face at z = 1.25. */
static dsw_body_id create_body(dsw_scene *scene, dsw_level level) {
  static const double positions[] = {0.5, 0.625, 1.25, 1.5, 0.625, 1.25, 1, 1.625, 1.25, 1, 1, 1.75};
  static const uint32_t offsets[] = {0, 3, 6, 9, 12}, corners[] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
  dsw_body_desc desc;
  dsw_body_id body;
  dsw_body_desc_init(&desc, sizeof desc);
  desc.level = level;
  desc.positions = positions;
  desc.vertex_count = 4;
  desc.face_offsets = offsets;
  desc.face_corners = corners; /* edges follow from them */
  desc.face_count = 4;
  desc.face_corner_count = 12;
  check(dsw_body_create(scene, &desc, &body) == DSW_STATUS_OK, "creating a body");
  return body;
}

/* Every vertex down by `way`. */
static dsw_move_report fall(dsw_scene *scene, dsw_body_id body, double way, double *p) {
  dsw_move_report report;
  size_t count = 0, i;
  check(dsw_body_get_positions(scene, body, p, 4, 0, NULL, &count) == DSW_STATUS_OK, "reading positions");
  for (i = 0; i < count; ++i) p[3 * i + 2] -= way;
  check(dsw_body_move(scene, body, p, count, 0, NULL, &report) == DSW_STATUS_OK, "moving");
  check(dsw_body_get_positions(scene, body, p, 4, 0, NULL, &count) == DSW_STATUS_OK, "reading positions");
  return report;
}

int main(void) {
  dsw_environment *environment = create_spike();
  dsw_scene *scene = NULL;
  dsw_body_id body;
  dsw_move_report report;
  dsw_rigid_motion motion = {{0, 0, 0, 1}, {0, 0, 0}, {0, 0, -0.3}};
  const dsw_body_contact *contact = NULL;
  const uint32_t *offending = NULL;
  size_t count = 0;
  double p[12];
  int step;
  check(dsw_scene_create(environment, NULL, &scene) == DSW_STATUS_OK, "creating a scene");

  /* Swept edges see nothing: the body ends with the spike in it, and cannot be raised to FACES any more. */
  body = create_body(scene, DSW_LEVEL_EDGES_SWEPT);
  report = fall(scene, body, 0.45, p);
  printf("edges swept: %u contacts, bottom at %g %g %g\n", (unsigned)report.contact_count, p[2], p[5], p[8]);
  check(report.contact_count == 0, "the edges pass the spike");
  check(dsw_body_set_level(scene, body, DSW_LEVEL_FACES) == DSW_STATUS_OCCUPIED, "raising the level");
  printf("  faces now: %s\n", dsw_last_error_message());
  check(dsw_scene_get_offending_edges(scene, &offending, &count) == DSW_STATUS_OK && count == 1, "which face it is");
  check(dsw_body_destroy(scene, body) == DSW_STATUS_OK, "removing the body");

  /* Faces see it: a face touches a vertex. The vertices move one after the other, so the body tilts. */
  body = create_body(scene, DSW_LEVEL_FACES);
  report = fall(scene, body, 0.45, p);
  check(dsw_body_get_contacts(scene, body, &contact, &count) == DSW_STATUS_OK && count > 0, "reading contacts");
  printf("faces: %u contacts, bottom at %g %g %g\n", (unsigned)report.contact_count, p[2], p[5], p[8]);
  printf("  the first: vertex %u at time %g, its face touches (%g, %g, %g), normal (%.3f, %.3f, %.3f)\n",
         (unsigned)contact->vertex.index, contact->time, contact->point[0], contact->point[1], contact->point[2],
         contact->contact.normal[0], contact->contact.normal[1], contact->contact.normal[2]);
  check(contact->contact.kind == DSW_CONTACT_VERTEX && contact->contact.obstacle.kind == DSW_CELL_VERTEX &&
            contact->face.generation != 0,
        "a face on the tip");
  check(contact->contact.marked_kind == DSW_CELL_VOLUME && contact->contact.normal[2] > 0.9 && contact->point[2] == 1,
        "of the spike");
  check(dsw_body_destroy(scene, body) == DSW_STATUS_OK, "removing the body");

  /* A rigid body keeps its shape: it falls until a fraction of 1/1000 is too much. */
  body = create_body(scene, DSW_LEVEL_FACES);
  for (step = 0; step < 50; ++step) {
    check(dsw_body_move_rigid(scene, body, &motion, NULL, &report) == DSW_STATUS_OK, "falling");
    if (report.fraction < 1e-3) break;
  }
  check(dsw_body_get_positions(scene, body, p, 4, 0, NULL, &count) == DSW_STATUS_OK, "reading positions");
  printf("rigid: after %d moves at rest, bottom at %.6f %.6f %.6f\n", step, p[2], p[5], p[8]);
  check(p[2] == p[5] && p[5] == p[8] && p[2] >= 1 && p[2] < 1.002, "it lies on the tip");

  check(dsw_scene_destroy(scene) == DSW_STATUS_OK, "destroying the scene");
  check(dsw_environment_destroy(environment) == DSW_STATUS_OK, "destroying");
  return 0;
}
