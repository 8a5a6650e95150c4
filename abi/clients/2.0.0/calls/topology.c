/* Basic changes of the topology, what each returns and what is refused; coarsening. */
#include <string.h>

#include "calls.h"

static dsw_environment *env;

static void say_change(void) {
  dsw_change change;
  memset(&change, 0, sizeof change);
  change.struct_size = sizeof change;
  TRY(dsw_environment_get_change(env, &change));
  say("  %u volumes, %u vertices, %u faces in lists", (unsigned)change.volume_count, (unsigned)change.vertex_count,
      (unsigned)change.face_count);
}

static void say_volume(const char *name, dsw_volume_id volume) {
  dsw_cell_type type = DSW_CELL_TYPE_NONE;
  uint32_t vertices = 0, edges = 0, faces = 0, tag = 0;
  int32_t region = -1;
  TRY(dsw_environment_get_volume_counts(env, volume, &type, &vertices, &edges, &faces));
  TRY(dsw_environment_get_region(env, volume, &region));
  TRY(dsw_environment_get_tag(env, volume, &tag));
  say("  %s: type %d, %u vertices, %u edges, %u faces, region %d, tag %u", name, (int)type, vertices, edges, faces,
      (int)region, tag);
}

static void sewing(void) {
  const dsw_volume_id second = volume_at(env, 1);
  const dsw_face_id face = face_between(env, volume_at(env, 0), second);
  dsw_face_id back = {0, 0, 0};
  dsw_volume_id other;
  uint32_t local;
  for (local = 0; local < 5; ++local) {
    if (dsw_environment_get_neighbour(env, second, local, &other, NULL) != DSW_STATUS_OK) continue;
    if (other.index == 0 && other.generation != 0) break;
  }
  TRY(dsw_environment_sew_faces(env, &face, &face, 1));
  TRY(dsw_environment_unsew_face(env, face));
  TRY(dsw_environment_unsew_face(env, face));
  say_environment(env);
  TRY(dsw_environment_get_face_id(env, second, local, &back));
  TRY(dsw_environment_sew_faces(env, NULL, &back, 1));
  TRY(dsw_environment_sew_faces(env, &face, &back, 1));
  say_change();
  say_environment(env);
}

static void volumes(void) {
  const dsw_volume_id old = volume_at(env, 0);
  const dsw_face_id face = face_between(env, old, volume_at(env, 1));
  dsw_vertex_id loop[4], found[4];
  dsw_volume_id merged = {0, 0}, parts[2];
  dsw_face_id between;
  size_t count = 0;
  TRY(dsw_environment_copy_vertices(env, face_cell(face), found, 4, &count));
  memcpy(loop, found, sizeof loop);
  TRY(dsw_environment_merge_volumes(env, face, &merged));
  say_change();
  say_volume("merged", merged);
  TRY(dsw_environment_merge_volumes(env, face, &merged));
  TRY(dsw_environment_split_volume(env, old, loop, 4, parts, &between));
  TRY(dsw_environment_split_volume(env, merged, loop, 2, parts, &between));
  TRY(dsw_environment_split_volume(env, merged, loop, 4, parts, &between));
  say_change();
  say_volume("first", parts[0]);
  say_volume("second", parts[1]);
  say_environment(env);
}

static dsw_edge_id edge_between(uint32_t a, uint32_t b) {
  uint32_t ends[2];
  dsw_edge_id edge = {0, 0, 0};
  ends[0] = a, ends[1] = b;
  TRY(dsw_environment_find_edges(env, 1, ends, &edge, NULL));
  return edge;
}

/* Of 3 x 1 x 1 cubes, with 4 vertices along x. The face at x = 1 has the corners 1, 5, 13, 9. */
static void faces_and_edges(void) {
  const dsw_face_id face = face_between(env, volume_at(env, 0), volume_at(env, 1));
  dsw_face_id halves[2], whole;
  dsw_edge_id diagonal, parts[2], merged;
  dsw_vertex_id middle;
  double xyz[3];
  TRY(dsw_environment_split_face(env, face, vertex_at(env, 1), vertex_at(env, 5), halves, &diagonal));
  TRY(dsw_environment_split_face(env, face, vertex_at(env, 1), vertex_at(env, 13), halves, &diagonal));
  say_change();
  TRY(dsw_environment_merge_faces(env, edge_between(1, 5), &whole));
  TRY(dsw_environment_merge_faces(env, diagonal, &whole));
  TRY(dsw_environment_split_edge(env, edge_between(1, 5), 0, &middle, parts));
  TRY(dsw_environment_split_edge(env, edge_between(1, 5), 0.5, &middle, parts));
  say_change();
  TRY(dsw_environment_get_vertex_position(env, middle, xyz));
  say_numbers("  middle", xyz, 3);
  TRY(dsw_environment_merge_edges(env, parts[0], vertex_at(env, 2), &merged));
  TRY(dsw_environment_merge_edges(env, parts[0], middle, &merged));
  TRY(dsw_environment_get_vertex_position(env, middle, xyz));
  TRY(dsw_environment_collapse_edge(env, merged, vertex_at(env, 1)));
  TRY(dsw_environment_split_edge(env, merged, 0.5, &middle, parts));
  TRY(dsw_environment_collapse_edge(env, parts[0], middle));
  say_environment(env);
}

static void add_and_remove(void) {
  static const double points[12] = {4, 0, 0, 4, 1, 0, 4, 0, 1, 4, 1, 1};
  static const int64_t cells[8] = {0, 4, 5, 1, 2, 6, 7, 3};
  const int32_t region = 7;
  const uint32_t tag = 70;
  static const uint32_t corners[4] = {3, 7, 11, 15};
  dsw_vertex_id old[4], fresh[4];
  dsw_volume_id added = {0, 0}, all[4];
  dsw_volumes_desc desc;
  dsw_face_id wall = {0, 0, 0};
  dsw_volume_id other;
  uint32_t local, i;
  for (i = 0; i < 4; ++i) old[i] = vertex_at(env, corners[i]);
  for (local = 0; local < 6; ++local) {
    dsw_vertex_id found[4];
    size_t count = 0;
    dsw_face_id face;
    TRY(dsw_environment_get_face_id(env, volume_at(env, 2), local, &face));
    TRY(dsw_environment_copy_vertices(env, face_cell(face), found, 4, &count));
    if (found[0].index % 4 == 3 && found[1].index % 4 == 3 && found[2].index % 4 == 3) wall = face;
  }
  dsw_volumes_desc_init(&desc, sizeof desc);
  desc.vertices = old, desc.vertex_count = 4, desc.points = points, desc.point_count = 4;
  desc.volume_count = 1, desc.connectivity = cells, desc.connectivity_count = 8;
  desc.regions = &region, desc.tags = &tag, desc.sew_to = &wall, desc.sew_count = 1;
  TRY(dsw_environment_add_volumes(env, NULL, &added, fresh));
  desc.connectivity_count = 7;
  TRY(dsw_environment_add_volumes(env, &desc, &added, fresh));
  desc.connectivity_count = 8, desc.uniform_cell_type = DSW_CELL_TYPE_POLYHEDRON;
  TRY(dsw_environment_add_volumes(env, &desc, &added, fresh));
  desc.uniform_cell_type = DSW_CELL_TYPE_HEXAHEDRON;
  TRY(dsw_environment_add_volumes(env, &desc, &added, fresh));
  say_change();
  say_volume("added", added);
  TRY(dsw_environment_get_face_volumes(env, wall, &all[0], &other));
  say("  behind the wall %s", other.index == added.index && other.generation == added.generation ? "it lies" : "it does NOT lie");
  TRY(dsw_environment_remove_volumes(env, &added, 1));
  TRY(dsw_environment_remove_volumes(env, &added, 1));
  say_change();
  for (i = 0; i < 3; ++i) all[i] = volume_at(env, i);
  TRY(dsw_environment_remove_volumes(env, all, 3));
  say_environment(env);
}

static void occupied(void) {
  static const double place[3] = {0.5, 0.5, 0.5};
  const dsw_volume_id first = volume_at(env, 0);
  const dsw_particle_id *who = NULL;
  dsw_scene *const scene = make_scene(env, 0);
  dsw_scene *second;
  dsw_particle_id particle;
  size_t count = 99;
  TRY(dsw_particle_create(scene, place, no_volume, &particle));
  TRY(dsw_environment_remove_volumes(env, &first, 1));
  TRY(dsw_scene_get_occupants(scene, &who, &count));
  say("  %u occupants", (unsigned)count);
  second = make_scene(env, 0);
  TRY(dsw_environment_unsew_face(env, face_between(env, volume_at(env, 1), volume_at(env, 2))));
  TRY(dsw_scene_destroy(second));
  TRY(dsw_scene_destroy(scene));
}

/* Two cubes of six tetrahedra each. */
static dsw_environment *make_tetrahedra(void) {
  static const int orders[6][3] = {{1, 3, 6}, {3, 6, 1}, {6, 1, 3}, {1, 6, 3}, {3, 1, 6}, {6, 3, 1}};
  static const double points[36] = {0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 1, 0, 1, 1, 0, 2, 1, 0,
                                    0, 0, 1, 1, 0, 1, 2, 0, 1, 0, 1, 1, 1, 1, 1, 2, 1, 1};
  static int64_t cells[48];
  dsw_environment *environment = NULL;
  dsw_environment_desc desc;
  int i, n = 0;
  for (i = 0; i < 12; ++i) {
    const int p = i / 6, a = p + orders[i % 6][0], b = a + orders[i % 6][1], c = b + orders[i % 6][2], odd = i % 6 >= 3;
    cells[n++] = p, cells[n++] = odd ? b : a, cells[n++] = odd ? a : b, cells[n++] = c;
  }
  dsw_environment_desc_init(&desc, sizeof desc);
  desc.points = points, desc.point_count = 12, desc.uniform_cell_type = DSW_CELL_TYPE_TETRA;
  desc.volume_count = 12, desc.connectivity = cells, desc.connectivity_count = 48;
  TRY(dsw_environment_create(NULL, &desc, &environment, NULL));
  return environment;
}

static void coarsening(void) {
  dsw_environment *const fine = make_tetrahedra();
  dsw_environment *coarse = NULL;
  dsw_coarsen_options options;
  dsw_coarsen_report report;
  uint32_t map[12];
  memset(&report, 0, sizeof report);
  report.struct_size = sizeof report;
  TRY(dsw_environment_coarsen(fine, NULL, &coarse, map, 11, &report));
  TRY(dsw_environment_coarsen(fine, NULL, &coarse, map, 12, &report));
  say("  complete %u, volumes %u to %u, faces %u to %u", report.complete, report.volume_count[0], report.volume_count[1],
      report.face_count[0], report.face_count[1]);
  say_environment(coarse);
  TRY(dsw_environment_destroy(coarse));
  dsw_coarsen_options_init(&options, sizeof options);
  options.max_faces = 29;
  TRY(dsw_environment_coarsen(fine, &options, &coarse, NULL, 0, NULL));
  options.max_faces = 4;
  TRY(dsw_environment_coarsen(fine, &options, &coarse, NULL, 0, &report));
  say("  volumes %u to %u", report.volume_count[0], report.volume_count[1]);
  TRY(dsw_environment_destroy(coarse));
  TRY(dsw_environment_destroy(fine));
}

void call_topology(void) {
  static void (*const parts[])(void) = {sewing, volumes, faces_and_edges, add_and_remove, occupied};
  size_t i;
  say("* topology");
  for (i = 0; i < sizeof parts / sizeof *parts; ++i) {
    env = make_block(NULL, 3, 1, 1, 0);
    parts[i]();
    TRY(dsw_environment_destroy(env));
  }
  coarsening();
}
