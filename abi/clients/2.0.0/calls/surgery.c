/* Cuts, tears, cracks, carving, ligatures, pieces that come off, repairs. */
#include <string.h>

#include "calls.h"

static dsw_environment *env; /* 4 x 4 x 4 cubes */
static dsw_change change;

static void begin(void) {
  env = make_block(NULL, 4, 4, 4, 0);
  memset(&change, 0, sizeof change);
  change.struct_size = sizeof change;
}

static void end(void) {
  say_environment(env);
  TRY(dsw_environment_destroy(env));
}

static void say_change(void) {
  say("  closed %u, crossed %u, split %u, changed %u, parted %u, shortened %u, sewn %u, unsewn %u", change.is_closed,
      change.volumes_crossed, change.volumes_split, change.volumes_changed, change.vertices_parted,
      change.vertices_shortened, change.faces_sewn, change.faces_unsewn);
  say("  invalid %u, removed %u, added %u, patches %u, most faces %u", change.volumes_invalid, change.volumes_removed,
      change.volumes_added, change.patch_count, change.most_faces);
  say("  lists: volumes %u, vertices %u, faces %u, whole %u, carved %u, unrepaired %u, detached %u, of bodies %u %u",
      (unsigned)change.volume_count, (unsigned)change.vertex_count, (unsigned)change.face_count,
      (unsigned)change.whole_count, (unsigned)change.carved_count, (unsigned)change.unrepaired_count,
      (unsigned)change.detached_count, (unsigned)change.body_vertex_count, (unsigned)change.body_face_count);
  say_numbers("  distance", &change.distance, 1);
  say_numbers("  widths", &change.smallest_width, 1);
  say_numbers("  widths", &change.largest_width, 1);
}

/* In the plane of constant x, up to y. */
static double blade[12];
static dsw_cut_desc blade_at(double x, double y) {
  dsw_cut_desc desc;
  int i;
  for (i = 0; i < 4; ++i) blade[3 * i] = x, blade[3 * i + 1] = i % 2 == 0 ? -1 : y, blade[3 * i + 2] = i < 2 ? -1 : 5;
  dsw_cut_desc_init(&desc, sizeof desc);
  desc.points = blade;
  desc.rows = desc.columns = 2;
  return desc;
}

static void cuts(void) {
  dsw_cut_desc desc = blade_at(1.25, 5);
  TRY(dsw_environment_cut(env, &desc, &change));
  say_change();
  desc = blade_at(2.5, 2.5), desc.flags = DSW_CUT_UNSEW;
  TRY(dsw_environment_cut(env, &desc, &change));
  say_change();
  desc = blade_at(3.0099, 5);
  TRY(dsw_environment_cut(env, &desc, &change));
  say_change();
  desc = blade_at(3.0101, 5);
  TRY(dsw_environment_cut(env, &desc, &change));
  say_change();
  desc.snap = 0.26;
  TRY(dsw_environment_cut(env, &desc, &change));
  desc = blade_at(1, 5), desc.rows = 1;
  TRY(dsw_environment_cut(env, &desc, &change));
  TRY(dsw_environment_cut(env, NULL, &change));
}

static void tears(void) {
  const dsw_face_id faces[2] = {face_between(env, volume_at(env, 0), volume_at(env, 1)), face_between(env, volume_at(env, 1), volume_at(env, 2))};
  static const double loads[2] = {2, 1};
  TRY(dsw_environment_tear_faces(env, faces, loads, 2, 1, &change));
  say_change();
  TRY(dsw_environment_tear_faces(env, faces, NULL, 2, 1, &change));
}

static void cracks(void) {
  static dsw_cut_face faces[16];
  dsw_cut_desc cut = blade_at(2, 5);
  dsw_open_crack_desc desc;
  size_t count;
  cut.flags = DSW_CUT_UNSEW;
  TRY(dsw_environment_cut(env, &cut, &change));
  count = change.face_count < 16 ? change.face_count : 16;
  memcpy(faces, change.faces, count * sizeof *faces);
  dsw_open_crack_desc_init(&desc, sizeof desc);
  desc.faces = faces, desc.face_count = count, desc.region = 9, desc.tag = 77;
  desc.width = 0;
  TRY(dsw_environment_open_crack(env, &desc, &change));
  desc.width = 0.5;
  TRY(dsw_environment_open_crack(env, &desc, &change));
  say_change();
  TRY(dsw_environment_open_crack(env, &desc, &change));
}

static const uint32_t box[36] = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};

static void mark_all(void) {
  int32_t region;
  for (region = 0; region < 4; ++region) TRY(dsw_environment_mark_region(env, region, DSW_MARK_IMPASSABLE, 0, NULL, NULL));
}

static void carving(void) {
  static double points[24];
  dsw_carve_desc desc;
  size_t count = 99;
  int i;
  mark_all();
  for (i = 0; i < 24; ++i) points[i] = (i / 3 >> i % 3 & 1) != 0 ? 3.25 : 0.75;
  dsw_carve_desc_init(&desc, sizeof desc);
  desc.points = points, desc.point_count = 8, desc.triangles = box, desc.triangle_count = 11;
  TRY(dsw_environment_carve(env, &desc, &change));
  desc.triangle_count = 12, desc.flags = DSW_CARVE_WHOLE;
  TRY(dsw_environment_carve(env, &desc, &change));
  say_change();
  desc.flags = 0;
  TRY(dsw_environment_carve(env, &desc, &change));
  say_change();
  TRY(dsw_environment_get_mark_count(env, DSW_CELL_VOLUME, &count));
  say("  %u marked", (unsigned)count);
}

/* A tube of 2 x 2 cubes along x. */
static void ligature(void) {
  static const double turns[4][2] = {{-1.5, -1.5}, {1.5, -1.5}, {1.5, 1.5}, {-1.5, 1.5}};
  static double points[12];
  dsw_tie_desc desc;
  uint32_t i;
  mark_all();
  for (i = 0; i < 64; ++i) {
    const dsw_volume_id volume = volume_at(env, i);
    if ((i / 4 % 4 + 1) / 2 == 1 && (i / 16 + 1) / 2 == 1) dsw_environment_mark_volumes(env, &volume, 1, DSW_MARK_PASSABLE, 0, NULL);
  }
  for (i = 0; i < 4; ++i) points[3 * i] = 1.5, points[3 * i + 1] = 2 + turns[i][0], points[3 * i + 2] = 2 + turns[i][1];
  dsw_tie_desc_init(&desc, sizeof desc);
  desc.points = points, desc.point_count = 2;
  TRY(dsw_environment_tie(env, &desc, &change));
  desc.point_count = 4;
  TRY(dsw_environment_tie(env, &desc, &change));
  say_change();
}

static void piece(void) {
  const dsw_volume_id solid = volume_at(env, 1 + 4 * (1 + 4 * 1));
  dsw_scene *const scene = make_scene(env, 0);
  dsw_body_id body = {0, 0};
  dsw_body_counts counts;
  dsw_detach_desc desc;
  TRY(dsw_environment_mark_volumes(env, &solid, 1, DSW_MARK_IMPASSABLE, 0, NULL));
  dsw_detach_desc_init(&desc, sizeof desc);
  desc.volume = volume_at(env, 0);
  TRY(dsw_environment_detach(env, &desc, &body, &change));
  desc.volume = solid, desc.gap = 0.3;
  TRY(dsw_environment_detach(env, &desc, &body, &change));
  desc.gap = 0;
  TRY(dsw_environment_detach(env, &desc, &body, &change));
  say_change();
  memset(&counts, 0, sizeof counts);
  counts.struct_size = sizeof counts;
  TRY(dsw_body_get_counts(scene, body, &counts));
  say("  %u vertices, %u edges, %u faces", counts.vertex_count, counts.edge_count, counts.face_count);
  TRY(dsw_scene_destroy(scene));
}

/* The vertex in the middle passes the next one along y, so that volumes that meet it turn inside out. Only volumes of one
 * label are merged. */
static void repair_all(void) {
  static double next[3 * 125];
  dsw_scene *const scene = make_scene(env, DSW_FEATURE_DEFORMING);
  const double *points = NULL;
  dsw_remesh_desc desc;
  size_t count = 0;
  TRY(dsw_environment_get_points(env, &points, &count));
  memcpy(next, points, sizeof next);
  next[3 * 62 + 1] += 1.1;
  dsw_remesh_desc_init(&desc, sizeof desc);
  desc.next = next, desc.point_count = 124;
  TRY(dsw_environment_remesh(env, &desc, &change));
  desc.point_count = 125, desc.radius = 9;
  TRY(dsw_environment_remesh(env, &desc, &change));
  desc.radius = 0;
  TRY(dsw_environment_remesh(env, &desc, &change));
  say_change();
  TRY(dsw_environment_remesh(env, NULL, &change));
  say_change();
  TRY(dsw_scene_destroy(scene));
}

static void repair(void) {
  repair_all();
  TRY(dsw_environment_destroy(env));
  env = make_block_without_labels(4, 4, 4);
  repair_all();
}

void call_surgery(void) {
  static void (*const parts[])(void) = {cuts, tears, cracks, carving, ligature, piece, repair};
  size_t i;
  say("* surgery");
  for (i = 0; i < sizeof parts / sizeof *parts; ++i) {
    begin();
    parts[i]();
    end();
  }
}
