/* Bodies: creation and what is refused, their parts, changes of their form, levels and filters. */
#include <string.h>

#include "calls.h"

static const double corners[12] = {0.25, 0.25, 0.25, 0.75, 0.25, 0.25, 0.75, 0.75, 0.25, 0.25, 0.75, 0.25};
static const uint32_t triangles[6] = {0, 1, 2, 0, 2, 3}, offsets[3] = {0, 3, 6}, edge[2] = {0, 1};

/* A square of two triangles. */
static dsw_body_desc square(void) {
  dsw_body_desc desc;
  dsw_body_desc_init(&desc, sizeof desc);
  desc.positions = corners;
  desc.vertex_count = 4;
  desc.face_offsets = offsets;
  desc.face_corners = triangles;
  desc.face_count = 2;
  desc.face_corner_count = 6;
  return desc;
}

static void refused(dsw_scene *scene) {
  static const double across[6] = {0.5, 0.5, 0.5, 9, 0.5, 0.5}, through[6] = {0.5, 0.5, 0.5, 2.5, 0.5, 0.5};
  static const uint32_t same[2] = {1, 1}, beyond[2] = {0, 4}, turned[6] = {0, 1, 2, 2, 0, 3};
  const uint32_t *offending = NULL;
  dsw_body_desc desc = square();
  dsw_body_id body = {0, 0};
  size_t count = 99;
  TRY(dsw_body_create(scene, NULL, &body));
  desc.edges = same, desc.edge_count = 1;
  TRY(dsw_body_create(scene, &desc, &body));
  desc.edges = beyond;
  TRY(dsw_body_create(scene, &desc, &body));
  desc = square(), desc.face_corners = turned;
  TRY(dsw_body_create(scene, &desc, &body));
  desc = square(), desc.flags = DSW_BODY_SKIP_BACK_EDGES;
  TRY(dsw_body_create(scene, &desc, &body));
  desc = square(), desc.level = (dsw_level)9;
  TRY(dsw_body_create(scene, &desc, &body));
  desc = square(), desc.flags = 0x40000000u;
  TRY(dsw_body_create(scene, &desc, &body));
  dsw_body_desc_init(&desc, sizeof desc);
  desc.positions = across, desc.vertex_count = 2, desc.edges = edge, desc.edge_count = 1;
  TRY(dsw_body_create(scene, &desc, &body));
  desc.positions = through;
  TRY(dsw_body_create(scene, &desc, &body));
  TRY(dsw_scene_get_offending_edges(scene, &offending, &count));
  say("  %u offending edges, from %u to %u", (unsigned)count, offending[0], offending[1]);
}

static void say_counts(const dsw_scene *scene, dsw_body_id body) {
  dsw_body_counts counts;
  memset(&counts, 0, sizeof counts);
  counts.struct_size = sizeof counts;
  TRY(dsw_body_get_counts(scene, body, &counts));
  say("  %u vertices, %u edges, %u faces", counts.vertex_count, counts.edge_count, counts.face_count);
}

static void parts(dsw_scene *scene, dsw_body_id body) {
  dsw_body_vertex_id vertices[4], three[3], vertex;
  dsw_body_edge_id edges[5];
  dsw_body_face_id faces[2];
  dsw_volume_id volumes[4];
  uint32_t indices[10];
  double positions[12];
  size_t count = 99, i;
  TRY(dsw_body_get_vertex_ids(scene, body, vertices, 3, &count));
  TRY(dsw_body_get_vertex_ids(scene, body, vertices, 4, &count));
  TRY(dsw_body_get_edge_ids(scene, body, edges, 5, &count));
  TRY(dsw_body_get_face_ids(scene, body, faces, 2, &count));
  TRY(dsw_body_get_edge_ends(scene, body, edges[0], three));
  TRY(dsw_body_get_face_corners(scene, body, faces[1], three));
  say("  corners %u %u %u", three[0].index, three[1].index, three[2].index);
  TRY(dsw_body_get_vertex_id(scene, body, 3, &vertex));
  TRY(dsw_body_get_vertex_id(scene, body, 4, &vertex));
  TRY(dsw_body_get_edge_indices(scene, body, indices, 5, &count));
  for (i = 0; i < count && i < 5; ++i) say("  edge %u %u", indices[2 * i], indices[2 * i + 1]);
  TRY(dsw_body_get_face_indices(scene, body, indices, 2, &count));
  for (i = 0; i < count && i < 2; ++i) say("  face %u %u %u", indices[3 * i], indices[3 * i + 1], indices[3 * i + 2]);
  TRY(dsw_body_get_positions(scene, body, positions, 4, 0, volumes, &count));
  say_numbers("  positions", positions, 12);
  say("  in volume %u", volumes[0].index);
  TRY(dsw_body_get_positions(scene, body, positions, 2, 0, NULL, &count));
}

static void changes(dsw_scene *scene, dsw_body_id body) {
  static const double apex[3] = {0.5, 0.5, 0.75};
  dsw_body_vertex_id vertices[4], top;
  dsw_body_edge_id new_edge, other, edges[7];
  dsw_body_face_id face, faces[3];
  dsw_body_edit edit;
  size_t count = 99;
  TRY(dsw_body_get_vertex_ids(scene, body, vertices, 4, &count));
  TRY(dsw_body_add_vertex(scene, body, apex, no_volume, &top));
  TRY(dsw_body_add_edge(scene, body, vertices[1], top, &new_edge));
  TRY(dsw_body_add_edge(scene, body, vertices[1], top, &new_edge));
  TRY(dsw_body_add_edge(scene, body, top, top, &other));
  TRY(dsw_body_add_face(scene, body, vertices[1], vertices[0], top, &face));
  TRY(dsw_body_add_face(scene, body, vertices[1], vertices[0], top, &face));
  TRY(dsw_body_add_face(scene, body, vertices[1], vertices[0], top, NULL));
  say_counts(scene, body);
  TRY(dsw_body_split_edge(scene, body, new_edge, 0.25, &edit));
  say("  inserted %u, reserved %u", edit.inserted, edit.reserved);
  say_numbers("  at", &edit.edge_parameter, 1);
  say_counts(scene, body);
  TRY(dsw_body_split_edge(scene, body, new_edge, 1, NULL));
  TRY(dsw_body_collapse_edge(scene, body, edit.edge, top, &edit));
  TRY(dsw_body_collapse_edge(scene, body, edit.edge, edit.vertex, &edit));
  say("  inserted %u", edit.inserted);
  say_counts(scene, body);
  TRY(dsw_body_get_face_ids(scene, body, faces, 3, &count));
  TRY(dsw_body_remove_face(scene, body, faces[2]));
  TRY(dsw_body_remove_face(scene, body, faces[2]));
  say_counts(scene, body);
  TRY(dsw_body_get_edge_ids(scene, body, edges, 7, &count));
  TRY(dsw_body_remove_edge(scene, body, edges[6]));
  TRY(dsw_body_remove_edge(scene, body, edit.edge));
  say_counts(scene, body);
  TRY(dsw_body_remove_vertex(scene, body, top));
  TRY(dsw_body_remove_vertex(scene, body, top));
  say_counts(scene, body);
}

static void settings(dsw_scene *scene, dsw_body_id body) {
  dsw_level level = (dsw_level)0;
  uint32_t category = 0, mask = 0;
  TRY(dsw_body_get_level(scene, body, &level));
  say("  level %d", (int)level);
  TRY(dsw_body_set_level(scene, body, DSW_LEVEL_FACES));
  TRY(dsw_body_set_level(scene, body, (dsw_level)5));
  TRY(dsw_body_get_filter(scene, body, &category, &mask));
  say("  category %u, mask %x", category, mask);
  TRY(dsw_body_set_filter(scene, body, 2, 4));
  TRY(dsw_body_get_filter(scene, body, &category, &mask));
  say("  category %u, mask %x", category, mask);
}

static void many(dsw_environment *environment, dsw_scene *scene, dsw_body_id body) {
  static const double wire[6] = {2.25, 0.5, 0.5, 2.75, 0.5, 0.5};
  const dsw_volume_id first = volume_at(environment, 0);
  const dsw_body_id *who = NULL;
  dsw_body_id ids[2];
  size_t count = 99;
  const dsw_body_id other = make_wire(scene, wire, DSW_LEVEL_EDGES, 0);
  TRY(dsw_scene_get_body_count(scene, &count));
  say("  %u bodies", (unsigned)count);
  TRY(dsw_scene_get_body_ids(scene, ids, 1, &count));
  TRY(dsw_scene_get_body_ids(scene, ids, 2, &count));
  say("  %s", ids[0].index == body.index && ids[1].index == other.index ? "in order" : "NOT in order");
  TRY(dsw_environment_mark_volumes(environment, &first, 1, DSW_MARK_IMPASSABLE, 0, NULL));
  TRY(dsw_scene_get_occupant_bodies(scene, &who, &count));
  say("  %u in the way", (unsigned)count);
  TRY(dsw_body_destroy(scene, other));
  TRY(dsw_body_destroy(scene, other));
  TRY(dsw_body_get_level(scene, other, NULL));
}

void call_bodies(void) {
  dsw_environment *const environment = make_block(NULL, 3, 1, 1, 0);
  const dsw_face_id wall = face_between(environment, volume_at(environment, 1), volume_at(environment, 2));
  dsw_scene *const scene = make_scene(environment, DSW_FEATURE_BODY_CONTACTS);
  dsw_scene *const bare = make_scene(environment, 0);
  dsw_body_desc desc = square();
  dsw_body_id body;
  uint32_t category;
  say("* bodies");
  TRY(dsw_environment_mark_faces(environment, &wall, 1, DSW_MARK_IMPASSABLE));
  TRY(dsw_scene_destroy(bare));
  TRY(dsw_environment_mark_faces(environment, &wall, 1, DSW_MARK_IMPASSABLE));
  refused(scene);
  TRY(dsw_body_create(scene, &desc, &body));
  say_counts(scene, body);
  parts(scene, body);
  settings(scene, body);
  changes(scene, body);
  many(environment, scene, body);
  TRY(dsw_scene_destroy(scene));
  {
    dsw_scene *const plain = make_scene(environment, 0);
    desc.category = 2;
    TRY(dsw_body_create(plain, &desc, &body));
    desc.category = 0;
    TRY(dsw_body_create(plain, &desc, &body));
    TRY(dsw_body_get_filter(plain, body, &category, &category));
    TRY(dsw_scene_destroy(plain));
  }
  TRY(dsw_environment_destroy(environment));
}
