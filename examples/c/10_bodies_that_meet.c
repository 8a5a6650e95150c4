/* Two needles cross each other in a cube, one of them moves: it stops at the other, exactly, and says which one it has met. */
#include <dartsweep/dartsweep.h>
#include <stdio.h>
#include <stdlib.h>

static void check(int good, const char *what) {
  if (!good) {
    fprintf(stderr, "%s: %s\n", what, dsw_last_error_message());
    exit(1);
  }
}

static dsw_body_id create_needle(dsw_scene *scene, const double *ends) {
  const uint32_t edge[2] = {0, 1};
  dsw_body_desc desc;
  dsw_body_id body;
  dsw_body_desc_init(&desc, sizeof desc);
  desc.positions = ends;
  desc.vertex_count = 2;
  desc.edges = edge;
  desc.edge_count = 1;
  check(dsw_body_create(scene, &desc, &body) == DSW_STATUS_OK, "creating a needle");
  return body;
}

int main(void) {
  const double points[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};
  const int64_t cube[] = {0, 1, 2, 3, 4, 5, 6, 7};
  const double lying[6] = {0.1, 0.5, 0.4, 0.9, 0.5, 0.4};
  const double crossing[6] = {0.5, 0.1, 0.75, 0.5, 0.9, 0.75};
  const double targets[6] = {0.5, 0.1, 0.25, 0.5, 0.9, 0.25}; /* beyond the first needle */
  dsw_environment *environment = NULL;
  dsw_scene *scene = NULL;
  dsw_environment_desc desc;
  dsw_scene_desc scene_desc;
  dsw_body_id first, second;
  dsw_move_report report;
  const dsw_body_contact *contacts = NULL;
  const dsw_contact_partner *partners = NULL;
  double ends[6];
  size_t i, count = 0, partner_count = 0;
  dsw_environment_desc_init(&desc, sizeof desc);
  desc.points = points;
  desc.point_count = 8;
  desc.connectivity = cube;
  desc.connectivity_count = 8;
  desc.volume_count = 1;
  check(dsw_environment_create(NULL, &desc, &environment, NULL) == DSW_STATUS_OK, "creating");
  dsw_scene_desc_init(&scene_desc, sizeof scene_desc);
  scene_desc.features = DSW_FEATURE_BODY_CONTACTS;
  check(dsw_scene_create(environment, &scene_desc, &scene) == DSW_STATUS_OK, "creating a scene");
  first = create_needle(scene, lying);
  second = create_needle(scene, crossing);
  check(dsw_body_move(scene, second, targets, 2, 0, NULL, &report) == DSW_STATUS_OK, "moving");
  check(dsw_body_get_contacts(scene, second, &contacts, &count) == DSW_STATUS_OK &&
            dsw_body_get_contact_partners(scene, second, &partners, &partner_count) == DSW_STATUS_OK,
        "reading contacts");
  check(count > 0 && count == partner_count, "the needles meet");
  for (i = 0; i < count; ++i) {
    printf("vertex %u stops after %.4f of its way: body %u was met at %g %g %g, normal %g %g %g\n",
           (unsigned)contacts[i].vertex.index, contacts[i].time, (unsigned)partners[i].body.index, contacts[i].point[0],
           contacts[i].point[1], contacts[i].point[2], contacts[i].contact.normal[0], contacts[i].contact.normal[1],
           contacts[i].contact.normal[2]);
    check(partners[i].body.index == first.index, "it is the first needle");
  }
  check(dsw_body_get_positions(scene, second, ends, 2, 0, NULL, &count) == DSW_STATUS_OK, "reading");
  /* Its middle is over the first needle: the mean of its ends, which lie at equal distances. */
  check(ends[2] + ends[5] > 0.8, "it has not passed");
  check(dsw_scene_destroy(scene) == DSW_STATUS_OK, "destroying the scene");
  check(dsw_environment_destroy(environment) == DSW_STATUS_OK, "destroying");
  return 0;
}
