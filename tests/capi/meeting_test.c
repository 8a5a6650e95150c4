/* Bodies that meet each other: every function and every bad argument. */
#include <math.h>
#include <string.h>

#include "check.h"
#include "fixture.h"

static const double square[12] = {2, 1, 1, 2, 2, 1, 2, 2, 2, 2, 1, 2};
static const uint32_t square_offsets[2] = {0, 4}, square_corners[4] = {0, 1, 2, 3};

static dsw_body_desc square_desc(void) {
  return surface_desc(square, 4, square_offsets, square_corners, 1, DSW_LEVEL_FACES);
}

static void a_contact_names_the_other_body(void) {
  const double edge[6] = {0.5, 1.25, 1.5, 0.5, 1.25, 1.75}, to[6] = {2.5, 1.25, 1.5, 0.5, 1.25, 1.75};
  dsw_scene *scene = make_scene(make_environment(NULL, 4, 3, 3), DSW_FEATURE_BODY_CONTACTS);
  const dsw_body_desc d = square_desc();
  dsw_body_id wall = {0, 0}, polyline;
  const dsw_body_contact *contacts = NULL;
  const dsw_contact_partner *partners = NULL;
  size_t count = 99;
  dsw_move_report report;
  CHECK_OK(dsw_body_create(scene, &d, &wall));
  polyline = make_edge_body(scene, edge, DSW_LEVEL_EDGES);
  CHECK_OK(dsw_body_get_contact_partners(scene, polyline, &partners, &count));
  CHECK(count == 0);
  CHECK_OK(dsw_body_move(scene, polyline, to, 2, 0, NULL, &report));
  CHECK(report.contact_count == 1 && report.vertices_stopped == 1);
  CHECK_OK(dsw_body_get_contacts(scene, polyline, &contacts, &count));
  CHECK(count == 1 && contacts[0].time == 0.75 && contacts[0].contact.kind == DSW_CONTACT_PLANE);
  CHECK(contacts[0].contact.marked_kind == DSW_CELL_NONE && contacts[0].contact.normal[0] == -1);
  CHECK_OK(dsw_body_get_contact_partners(scene, polyline, &partners, &count));
  CHECK(count == 1 && partners[0].body.index == wall.index && partners[0].body.generation == wall.generation);
  CHECK(partners[0].face.generation == 1 && partners[0].edge.generation == 0 && partners[0].vertex.generation == 0);
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_get_contact_partners(NULL, polyline, &partners, &count));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_get_contact_partners(scene, polyline, NULL, &count));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_get_contact_partners(scene, polyline, &partners, NULL));
  CHECK_OK(dsw_body_destroy(scene, polyline));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_body_get_contact_partners(scene, polyline, &partners, &count));
  end_scene(scene);
}

static void filters_are_read_and_changed(void) {
  const double edge[6] = {1.5, 1.25, 1.5, 2.5, 1.25, 1.5};
  dsw_scene *scene = make_scene(make_environment(NULL, 4, 3, 3), DSW_FEATURE_BODY_CONTACTS);
  dsw_body_desc d = square_desc();
  dsw_body_id wall, polyline = {7, 7};
  uint32_t category = 99, mask = 99;
  const uint32_t *pairs = NULL;
  size_t count = 0;
  CHECK_OK(dsw_body_create(scene, &d, &wall));
  d = line_desc(edge, 2, 0, DSW_LEVEL_EDGES_SWEPT);
  CHECK_FAILS(DSW_STATUS_OCCUPIED, dsw_body_create(scene, &d, &polyline));
  CHECK(polyline.index == 7 && polyline.generation == 7);
  CHECK_OK(dsw_scene_get_offending_edges(scene, &pairs, &count));
  CHECK(count == 1 && pairs[0] == 0 && pairs[1] == 1);
  d.category = 4;
  d.mask = 6;
  CHECK_OK(dsw_body_create(scene, &d, &polyline));
  CHECK_OK(dsw_body_get_filter(scene, polyline, &category, &mask));
  CHECK(category == 4 && mask == 6);
  CHECK_FAILS(DSW_STATUS_OCCUPIED, dsw_body_set_filter(scene, polyline, 0, 0));
  CHECK_OK(dsw_body_get_filter(scene, polyline, &category, &mask));
  CHECK(category == 4 && mask == 6);
  CHECK_OK(dsw_body_set_filter(scene, polyline, 8, 2));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_get_filter(scene, polyline, NULL, &mask));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_get_filter(scene, polyline, &category, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_get_filter(NULL, polyline, &category, &mask));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_set_filter(NULL, polyline, 1, 1));
  CHECK_OK(dsw_body_destroy(scene, polyline));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_body_get_filter(scene, polyline, &category, &mask));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_body_set_filter(scene, polyline, 1, 1));
  end_scene(scene);
}

static void what_is_not_named_is_refused(void) {
  dsw_scene *scene = make_scene(make_environment(NULL, 4, 3, 3), 0);
  dsw_body_desc d = square_desc();
  dsw_body_id body;
  const dsw_contact_partner *partners = NULL;
  size_t count = 99;
  uint32_t bits = 99;
  d.flags = DSW_BODY_SELF_CONTACTS;
  CHECK_FAILS(DSW_STATUS_NOT_ENABLED, dsw_body_create(scene, &d, &body));
  d.flags = 0;
  d.category = 1;
  CHECK_FAILS(DSW_STATUS_NOT_ENABLED, dsw_body_create(scene, &d, &body));
  d.category = 0;
  d.mask = 1;
  CHECK_FAILS(DSW_STATUS_NOT_ENABLED, dsw_body_create(scene, &d, &body));
  CHECK_MESSAGE("DSW_FEATURE_BODY_CONTACTS");
  d.mask = 0;
  CHECK_OK(dsw_body_create(scene, &d, &body));
  CHECK_FAILS(DSW_STATUS_NOT_ENABLED, dsw_body_get_contact_partners(scene, body, &partners, &count));
  CHECK_FAILS(DSW_STATUS_NOT_ENABLED, dsw_body_get_filter(scene, body, &bits, &bits));
  CHECK_FAILS(DSW_STATUS_NOT_ENABLED, dsw_body_set_filter(scene, body, 1, 1));
  CHECK(count == 99 && bits == 99);
  end_scene(scene);
}

/* A line meets a square with an end and with an edge, and itself. */
static void bodies_of_the_plane_meet(void) {
  static const double corners[8] = {2, 1, 3, 1, 3, 2, 2, 2}, line[6] = {0.5, 0.5, 0.5, 1.5, 0.5, 2.5};
  static const double end_first[6] = {2.5, 1.5, 0.5, 1.5, 0.5, 2.5}, edge_first[6] = {3.5, 0.5, 0.5, 1.5, 0.5, 2.5};
  static const double folded[6] = {0.5, 3.5, 0.5, 1.5, 0.5, 2.5};
  static const double hook[6] = {0.5, 0.5, 0.5, 1.5, 1.5, 1.5}, closed[6] = {0.5, 0.5, 0.5, 1.5, 0.25, 0.75};
  static const double bar[4] = {0.5, 1.25, 1.5, 1.25}, onwards[4] = {2.75, 1.25, 3.75, 1.25};
  dsw_scene *scene = make_scene(make_squares(NULL, 4, 4), DSW_FEATURE_BODY_CONTACTS);
  dsw_body_desc d = line_desc(corners, 4, 1, DSW_LEVEL_EDGES);
  dsw_body_id block, polyline;
  dsw_move_report report;
  double now[4];
  const dsw_body_contact *contacts = NULL;
  const dsw_contact_partner *partners = NULL;
  size_t count = 0;
  CHECK_OK(dsw_body_create(scene, &d, &block));
  CHECK_FAILS(DSW_STATUS_OCCUPIED, dsw_body_create(scene, &d, &polyline));
  d = line_desc(bar, 2, 0, DSW_LEVEL_EDGES_SWEPT);
  CHECK_OK(dsw_body_create(scene, &d, &polyline));
  CHECK_OK(dsw_body_move(scene, polyline, onwards, 2, 0, NULL, &report));
  CHECK(report.vertices_stopped == 2 && report.contact_count == 2);
  CHECK_OK(dsw_body_get_contacts(scene, polyline, &contacts, &count));
  CHECK(count == 2 && contacts[0].vertex.index == 0 && contacts[0].contact.kind == DSW_CONTACT_EDGE);
  CHECK(contacts[0].contact.normal[0] == -1 && fabs(contacts[0].point[0] - 2) < 1e-14);
  CHECK(contacts[0].contact.obstacle.kind == DSW_CELL_NONE && contacts[0].contact.wall.generation == 0);
  CHECK_OK(dsw_body_get_contact_partners(scene, polyline, &partners, &count));
  CHECK(count == 2 && partners[0].body.index == block.index && partners[0].body.generation == block.generation);
  CHECK(partners[0].edge.generation == 1 && partners[0].vertex.generation == 0 && partners[0].face.generation == 0);
  CHECK_OK(dsw_body_get_positions(scene, polyline, now, 2, 0, NULL, &count));
  CHECK(now[0] < 2 && now[0] > 1.9 && now[2] < 2 && now[2] > 1.9);
  CHECK_OK(dsw_body_destroy(scene, polyline));
  d = line_desc(line, 3, 0, DSW_LEVEL_EDGES), d.flags = DSW_BODY_SELF_CONTACTS;
  CHECK_OK(dsw_body_create(scene, &d, &polyline));
  CHECK_OK(dsw_body_move(scene, polyline, end_first, 3, 0, NULL, NULL));
  CHECK_OK(dsw_body_get_contacts(scene, polyline, &contacts, &count));
  CHECK(count == 1 && contacts[0].contact.kind == DSW_CONTACT_EDGE && contacts[0].time == 0.75);
  CHECK(contacts[0].edge.generation == 0 && contacts[0].contact.normal[0] == -1 && contacts[0].contact.normal[2] == 0);
  CHECK_OK(dsw_body_get_contact_partners(scene, polyline, &partners, &count));
  CHECK(count == 1 && partners[0].body.index == block.index && partners[0].edge.index == 3);
  CHECK_OK(dsw_body_move(scene, polyline, line, 3, 0, NULL, NULL));
  CHECK_OK(dsw_body_move(scene, polyline, edge_first, 3, 0, NULL, NULL));
  CHECK_OK(dsw_body_get_contacts(scene, polyline, &contacts, &count));
  CHECK(count == 1 && contacts[0].contact.kind == DSW_CONTACT_VERTEX && contacts[0].edge.generation == 1);
  CHECK(contacts[0].point[0] == 2 && contacts[0].point[1] == 1 && contacts[0].fixed[0][1] == 1.5);
  CHECK_OK(dsw_body_get_contact_partners(scene, polyline, &partners, &count));
  CHECK(count == 1 && partners[0].vertex.index == 0 && partners[0].vertex.generation == 1);
  CHECK_OK(dsw_body_move(scene, polyline, line, 3, 0, NULL, NULL));
  CHECK_OK(dsw_body_move(scene, polyline, folded, 3, 0, NULL, &report));
  CHECK(report.vertices_stopped == 1 && report.contact_count == 1);
  CHECK_OK(dsw_body_get_contact_partners(scene, polyline, &partners, &count));
  CHECK(count == 1 && partners[0].body.index == polyline.index);
  CHECK_OK(dsw_body_move(scene, polyline, hook, 3, 0, NULL, NULL));
  CHECK_OK(dsw_body_move(scene, polyline, closed, 3, 0, NULL, &report));
  CHECK(report.vertices_stopped == 1 && report.contact_count == 1);
  CHECK_OK(dsw_body_get_contact_partners(scene, polyline, &partners, &count));
  CHECK(count == 1 && partners[0].body.index == polyline.index && partners[0].edge.index == 0);
  end_scene(scene);
}

/* A description of the time before filters. */
static void a_shorter_description_still_works(void) {
  dsw_scene *scene = make_scene(make_environment(NULL, 4, 3, 3), DSW_FEATURE_BODY_CONTACTS);
  dsw_body_desc d = square_desc();
  dsw_body_id body;
  uint32_t category = 0, mask = 0;
  d.struct_size = (uint32_t)((const char *)&d.category - (const char *)&d);
  d.category = d.mask = 0xffffffffu;
  CHECK_OK(dsw_body_create(scene, &d, &body));
  CHECK_OK(dsw_body_get_filter(scene, body, &category, &mask));
  CHECK(category == 1 && mask == 0xffffffffu);
  end_scene(scene);
}

int main(void) {
  a_contact_names_the_other_body();
  filters_are_read_and_changed();
  what_is_not_named_is_refused();
  bodies_of_the_plane_meet();
  a_shorter_description_still_works();
  return check_result();
}
