/* Exits: what leaves through them, what follows changes, and arguments that are refused, in space and in the plane.
   tests/property/exits_test.cpp compares moves with exact truth. */
#include <string.h>

#include "check.h"
#include "fixture.h"

enum { NX = 4, OUTLET = 7 };

static dsw_environment *g_env; /* 4 x 2 x 2 cubes, or 4 x 2 squares; the side x = 4 is an exit */
static dsw_scene *g_scene;
static unsigned g_dimension;

/* A point; the height counts in space alone. */
static double *put(double *at, double x, double y, double z) {
  at[0] = x;
  at[1] = y;
  if (g_dimension == 3) at[2] = z;
  return at + g_dimension;
}

static uint32_t outer_side(void) { return g_dimension == 3 ? FACE_X1 : 1; }

/* The faces of the side x = 4. */
static size_t outlet(dsw_face_id *faces) {
  const uint32_t cells = g_dimension == 3 ? 4 : 2;
  uint32_t i;
  for (i = 0; i < cells; ++i) faces[i] = face_at(NX * i + NX - 1, outer_side());
  return cells;
}

static void mark_outlet(uint32_t patch) {
  dsw_face_id faces[4];
  const size_t count = outlet(faces);
  CHECK_OK(dsw_environment_mark_exits(g_env, faces, count, patch));
}

static void begin(uint32_t features) {
  g_env = g_dimension == 3 ? make_environment(NULL, NX, 2, 2) : make_squares(NULL, NX, 2);
  mark_outlet(OUTLET);
  g_scene = make_scene(g_env, features);
}

static void end(void) { end_scene(g_scene); }

static uint32_t exit_of(dsw_face_id face) {
  uint32_t patch = 99;
  CHECK_OK(dsw_environment_get_exit(g_env, face, &patch));
  return patch;
}

static size_t exit_count(void) {
  size_t count = 99;
  const dsw_status status = dsw_environment_get_exit_faces(g_env, NULL, 0, &count);
  CHECK(status == DSW_STATUS_OK || status == DSW_STATUS_BUFFER_TOO_SMALL);
  return count;
}

static dsw_cast_options cast_flags(uint32_t flags) {
  dsw_cast_options o;
  dsw_cast_options_init(&o, sizeof o);
  o.flags = flags;
  return o;
}

static size_t left_particles(const dsw_exit **exits) {
  size_t count = 99;
  CHECK_OK(dsw_scene_get_exits(g_scene, exits, &count));
  return count;
}

static dsw_particle_id particle_at(double x) {
  double at[3];
  dsw_particle_id id;
  put(at, x, 0.5, 0.5);
  CHECK_OK(dsw_particle_create(g_scene, at, no_volume, &id));
  return id;
}

static void a_particle_waits_at_an_exit(void) {
  const dsw_cast_options brief = cast_flags(DSW_CAST_NO_DETAIL);
  const dsw_exit *exits;
  dsw_particle_id p;
  dsw_flight f;
  double out[3], back[3], at[3];
  begin(0);
  p = particle_at(0.5);
  put(out, 8.5, 0.5, 0.5);
  put(back, 1, 0.5, 0.5);
  CHECK(left_particles(&exits) == 0);
  CHECK_OK(dsw_particle_move(g_scene, p, out, NULL, &f));
  CHECK(f.outcome == DSW_OUTCOME_EXIT && f.time == 0.4375 && f.position[0] < 4 && f.position[0] > 3.999);
  CHECK(f.contact.kind == DSW_CONTACT_PLANE && f.contact.wall.volume == 3 && f.contact.wall.local == outer_side());
  CHECK(left_particles(&exits) == 1 && exits[0].patch == OUTLET && exits[0].time == 0.4375);
  CHECK(exits[0].point[0] == 4 && exits[0].point[1] == 0.5 && exits[0].point[2] == (g_dimension == 3 ? 0.5 : 0));
  CHECK(exits[0].face.volume == 3 && exits[0].face.generation == 1 && exits[0].face.local == outer_side());
  CHECK(exits[0].particle.index == p.index && exits[0].particle.generation == p.generation);
  CHECK(exits[0].vertex.generation == 0);
  /* It is a particle as before: it may come to the exit again, and go back. */
  CHECK_OK(dsw_particle_move(g_scene, p, out, &brief, &f));
  CHECK(f.outcome == DSW_OUTCOME_EXIT && f.contact.kind == DSW_CONTACT_NONE && left_particles(&exits) == 1);
  CHECK_OK(dsw_particle_move(g_scene, p, back, NULL, &f));
  CHECK(f.outcome == DSW_OUTCOME_REACHED && left_particles(&exits) == 0);
  CHECK_OK(dsw_particle_get_position(g_scene, p, at, NULL));
  CHECK(at[0] == 1);
  /* The other end is a wall. Casts know no exits. */
  put(out, -1, 0.5, 0.5);
  CHECK_OK(dsw_particle_move(g_scene, p, out, NULL, &f));
  CHECK(f.outcome == DSW_OUTCOME_CONTACT && left_particles(&exits) == 0);
  put(out, 8.5, 0.5, 0.5);
  CHECK_OK(dsw_environment_cast(g_env, no_volume, back, out, NULL, &f));
  CHECK(f.outcome == DSW_OUTCOME_CONTACT && exit_of(f.contact.wall) == OUTLET);
  mark_outlet(0);
  CHECK_OK(dsw_particle_move(g_scene, p, out, NULL, &f));
  CHECK(f.outcome == DSW_OUTCOME_CONTACT && left_particles(&exits) == 0);
  end();
}

static void particles_leave(uint32_t features) {
  const dsw_cast_options leave = cast_flags(DSW_CAST_LEAVE);
  const dsw_exit *exits;
  dsw_particle_id p[4], back;
  dsw_flight f[4];
  double to[12];
  size_t count = 99;
  int i;
  begin(features);
  for (i = 0; i < 4; ++i) p[i] = particle_at(0.5 + i);
  put(put(put(put(to, 8.5, 0.5, 0.5), -3, 0.5, 0.5), 2.75, 0.5, 0.5), 5.5, 0.5, 0.5);
  CHECK_OK(dsw_scene_move_particles(g_scene, p, 4, to, 0, &leave, f));
  CHECK(f[0].outcome == DSW_OUTCOME_EXIT && f[1].outcome == DSW_OUTCOME_CONTACT);
  CHECK(f[2].outcome == DSW_OUTCOME_REACHED && f[3].outcome == DSW_OUTCOME_EXIT && f[3].time == 0.25);
  CHECK(left_particles(&exits) == 2 && exits[0].particle.index == p[0].index && exits[1].particle.index == p[3].index);
  CHECK(exits[0].time == 0.4375 && exits[1].time == 0.25 && exits[1].patch == OUTLET);
  CHECK_OK(dsw_scene_get_particle_count(g_scene, &count));
  CHECK(count == 2);
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_particle_get_position(g_scene, p[0], to, NULL));
  CHECK_OK(dsw_particle_get_position(g_scene, p[1], to, NULL));
  /* What has left is in nobody's way, and its slot is used again. */
  CHECK_OK(set_volume_mark(g_env, 3, DSW_MARK_IMPASSABLE));
  CHECK_OK(set_volume_mark(g_env, 3, DSW_MARK_PASSABLE));
  back = particle_at(0.5);
  CHECK(back.index == p[3].index && back.generation == p[3].generation + 1);
  CHECK_OK(dsw_scene_move_particles(g_scene, NULL, 0, NULL, 0, &leave, NULL));
  CHECK(left_particles(&exits) == 0);
  end();
}

/* Five vertices along x, from 0.5 to 2.5. */
static dsw_body_id make_wire(double radius, uint32_t flags) {
  double at[15], *next = at;
  dsw_body_desc d;
  dsw_body_id id;
  int i;
  for (i = 0; i < 5; ++i) next = put(next, 0.5 + 0.5 * i, 1.25, 1.25);
  d = line_desc(at, 5, 0, DSW_LEVEL_EDGES_SWEPT);
  d.radius = radius;
  d.flags = flags;
  CHECK_OK(dsw_body_create(g_scene, &d, &id));
  return id;
}

static dsw_status push(dsw_body_id body, double by, uint32_t flags, dsw_response response, dsw_move_report *report) {
  static const uint32_t from_the_tip[5] = {4, 3, 2, 1, 0};
  double at[15];
  size_t count, i;
  dsw_move_options o = move_options();
  CHECK_OK(dsw_body_get_positions(g_scene, body, at, 5, 0, NULL, &count));
  for (i = 0; i < count; ++i) at[i * g_dimension] += by;
  o.flags = flags;
  o.vertex_response = o.edge_response = response;
  o.order = body_counts(g_scene, body).vertex_count == 5 ? from_the_tip : NULL;
  o.order_count = o.order == NULL ? 0 : 5;
  return dsw_body_move(g_scene, body, at, count, 0, &o, report);
}

static void a_wire_leaves(uint32_t features, dsw_response response) {
  const dsw_exit *exits;
  dsw_body_id wire, other;
  dsw_move_report r;
  dsw_body_counts c;
  double at[15];
  size_t count = 99;
  begin(features);
  wire = make_wire(0, 0);
  CHECK_OK(push(wire, 0.875, DSW_MOVE_LEAVE, response, &r));
  CHECK(r.vertices_stopped == 0 && body_counts(g_scene, wire).vertex_count == 5);
  CHECK_OK(dsw_body_get_exits(g_scene, wire, &exits, &count));
  CHECK(count == 0);
  CHECK_OK(push(wire, 2, DSW_MOVE_LEAVE, response, &r));
  CHECK_OK(dsw_body_get_exits(g_scene, wire, &exits, &count));
  /* From 1.375, 1.875, 2.375, 2.875 and 3.375 by 2: the last three come to the exit. */
  CHECK(r.contact_count >= count && count == 3 && r.vertices_stopped == 3);
  CHECK(exits[0].vertex.index == 4 && exits[0].time == 0.3125 && exits[0].patch == OUTLET && exits[0].point[0] == 4);
  CHECK(exits[1].vertex.index == 3 && exits[1].time == 0.5625 && exits[2].vertex.index == 2 && exits[2].time == 0.8125);
  CHECK(exits[0].particle.generation == 0 && exits[0].face.local == outer_side());
  CHECK(exits[0].face.volume == NX * (g_dimension == 3 ? 4 : 2) - 1);
  c = body_counts(g_scene, wire);
  CHECK(c.vertex_count == 2 && c.edge_count == 1);
  CHECK_OK(dsw_body_get_positions(g_scene, wire, at, 5, 0, NULL, &count));
  CHECK(at[0] == 3.375 && at[g_dimension] == 3.875 && at[2 * g_dimension] == 0);
  CHECK_OK(push(wire, 2, DSW_MOVE_LEAVE, response, &r));
  CHECK(body_counts(g_scene, wire).vertex_count == 0 && body_counts(g_scene, wire).edge_count == 0);
  /* One without the flag stops, or slides, and is whole. */
  other = make_wire(0, 0);
  CHECK_OK(push(other, 3, 0, response, &r));
  CHECK(r.contact_count > 0 && body_counts(g_scene, other).vertex_count == 5);
  CHECK_OK(dsw_body_get_exits(g_scene, other, &exits, &count));
  CHECK(count == 0);
  end();
}

static void many_bodies_leave_at_once(void) {
  dsw_body_id wires[2];
  dsw_move_options o = move_options();
  dsw_move_report r[2];
  const dsw_exit *exits;
  double at[30];
  size_t count = 99, i;
  begin(0);
  o.flags = DSW_MOVE_LEAVE;
  for (i = 0; i < 2; ++i) {
    wires[i] = make_wire(0, 0);
    CHECK_OK(dsw_body_get_positions(g_scene, wires[i], at + 5 * i * g_dimension, 5, 0, NULL, &count));
  }
  for (i = 0; i < 10; ++i) at[i * g_dimension] += i < 5 ? 1 : 9;
  CHECK_OK(dsw_scene_move_bodies(g_scene, wires, 2, at, 10, 0, &o, r));
  CHECK(body_counts(g_scene, wires[0]).vertex_count == 5 && r[0].vertices_stopped == 0);
  CHECK(r[1].vertices_stopped == 5 && body_counts(g_scene, wires[1]).vertex_count == 0);
  CHECK_OK(dsw_body_get_exits(g_scene, wires[1], &exits, &count));
  CHECK(count == 5);
  end();
}

static void a_thick_vertex_leaves_at_its_radius(void) {
  const dsw_exit *exits;
  dsw_body_id wire, whole;
  dsw_move_report r;
  size_t count = 99;
  begin(DSW_FEATURE_BODY_CONTACTS);
  wire = make_wire(0.125, 0);
  CHECK_OK(push(wire, 1.5, DSW_MOVE_LEAVE, DSW_RESPONSE_STOP, &r));
  CHECK_OK(dsw_body_get_exits(g_scene, wire, &exits, &count));
  CHECK(count == 1 && exits[0].vertex.index == 4 && exits[0].time > 0.916 && exits[0].time < 0.917);
  CHECK(body_counts(g_scene, wire).vertex_count == 4);
  CHECK_OK(dsw_body_destroy(g_scene, wire));
  whole = make_wire(0.125, DSW_BODY_SELF_CONTACTS);
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, push(whole, 1.5, DSW_MOVE_LEAVE, DSW_RESPONSE_STOP, &r));
  CHECK_MESSAGE("DSW_MOVE_LEAVE");
  CHECK_OK(push(whole, 1.5, 0, DSW_RESPONSE_STOP, &r));
  end();
}

/* A vertex in a corner between an exit, on the side that is 1 in the numbering of faces, and a wall: both are as near at
   once, and which of them is told depends on numbers. */
static void a_thick_vertex_leaves_beside_a_wall(void) {
  unsigned axis;
  for (axis = 0; axis < g_dimension; ++axis) {
    static const uint32_t space[3] = {FACE_X1, FACE_Y1, FACE_Z1}, plane[2] = {1, 2};
    const uint32_t local = g_dimension == 3 ? space[axis] : plane[axis];
    const dsw_face_id outlet_face = face_at(g_dimension == 3 ? 7 : 3, local);
    dsw_body_desc d;
    dsw_body_id body;
    dsw_move_report r;
    dsw_move_options o = move_options();
    double from[3], to[3];
    g_env = g_dimension == 3 ? make_environment(NULL, 2, 2, 2) : make_squares(NULL, 2, 2);
    CHECK_OK(dsw_environment_mark_exits(g_env, &outlet_face, 1, OUTLET));
    g_scene = make_scene(g_env, 0);
    put(from, 1.5, 1.5, 1.5);
    put(to, 2.5, 2.5, 2.5);
    d = body_desc(from, 1, NULL, 0, DSW_LEVEL_POINTS);
    d.radius = 0.125;
    o.flags = DSW_MOVE_LEAVE;
    CHECK_OK(dsw_body_create(g_scene, &d, &body));
    CHECK_OK(dsw_body_move(g_scene, body, to, 1, 0, &o, &r));
    CHECK(body_counts(g_scene, body).vertex_count == 0);
    end();
  }
}

/* The middle of an edge is put there by a response, and is noise when the edge has come to the exit. */
static void an_inserted_vertex_leaves(void) {
  dsw_body_id wire;
  dsw_move_options o = move_options();
  dsw_move_report r;
  dsw_body_vertex_id vertex;
  dsw_body_desc d;
  const dsw_exit *exits;
  double at[12];
  size_t count = 99, i;
  begin(0);
  put(put(at, 0.5, 0.5, 0.5), 0.5, 1.75, 0.5);
  d = line_desc(at, 2, 0, DSW_LEVEL_EDGES_SWEPT);
  CHECK_OK(dsw_body_create(g_scene, &d, &wire));
  o.edge_response = DSW_RESPONSE_ADAPTIVE_ONE;
  CHECK_OK(set_volume_mark(g_env, 1, DSW_MARK_IMPASSABLE));
  put(put(at, 0.5, 0.5, 0.5), 2.5, 1.25, 0.5);
  CHECK_OK(dsw_body_move(g_scene, wire, at, 2, 0, &o, &r));
  CHECK_OK(dsw_body_get_positions(g_scene, wire, at, 4, 0, NULL, &count));
  CHECK_OK(set_volume_mark(g_env, 1, DSW_MARK_PASSABLE));
  CHECK(count == 3);
  for (i = 0; i < count; ++i) at[i * g_dimension] = 8;
  o = move_options();
  o.flags = DSW_MOVE_LEAVE;
  o.noise_share = 0.5;
  CHECK_OK(dsw_body_move(g_scene, wire, at, count, 0, &o, &r));
  CHECK_OK(dsw_body_get_exits(g_scene, wire, &exits, &count));
  CHECK(count == 3 && r.edit_count == 0);
  CHECK(body_counts(g_scene, wire).vertex_count == 0 && body_counts(g_scene, wire).edge_count == 0);
  put(at, 0.5, 0.5, 0.5);
  CHECK_OK(dsw_body_add_vertex(g_scene, wire, at, no_volume, &vertex));
  CHECK(body_counts(g_scene, wire).vertex_count == 1);
  end();
}

/* A blade along x at y = `y` that reaches through the exit. */
static void cut_along(double y, uint32_t flags) {
  double points[12];
  dsw_cut_desc d;
  dsw_change change = empty_change();
  dsw_cut_desc_init(&d, sizeof d);
  d.flags = flags;
  d.points = points;
  d.rows = 2;
  d.columns = g_dimension - 1;
  if (g_dimension == 3) {
    put(put(put(put(points, 2.25, y, -1), 2.25, y, 3), 5, y, -1), 5, y, 3);
  } else {
    put(put(points, 2.25, y, 0), 5, y, 0);
  }
  CHECK_OK(dsw_environment_cut(g_env, &d, &change));
}

/* Exits are the outer faces whose vertices all have x = 4. Returns how many there are. */
static size_t exits_are_the_outlet(void) {
  const uint32_t last = info_of(g_env).volume_index_count;
  size_t found = 0;
  uint32_t i, local, faces, k;
  for (i = 0; i < last; ++i) {
    dsw_volume_id volume;
    if (dsw_environment_get_volume_id(g_env, i, &volume) != DSW_STATUS_OK) continue;
    CHECK_OK(dsw_environment_get_volume_counts(g_env, volume, NULL, NULL, NULL, &faces));
    for (local = 0; local < faces; ++local) {
      const dsw_face_id id = {volume.index, volume.generation, local};
      const dsw_cell cell = {DSW_CELL_FACE, volume.index, volume.generation, local};
      dsw_vertex_id corners[16];
      dsw_volume_id beyond;
      size_t count;
      int at_outlet = 1;
      CHECK_OK(dsw_environment_get_face_volumes(g_env, id, NULL, &beyond));
      CHECK_OK(dsw_environment_copy_vertices(g_env, cell, corners, 16, &count));
      for (k = 0; k < count; ++k) {
        double at[3];
        CHECK_OK(dsw_environment_get_vertex_position(g_env, corners[k], at));
        at_outlet = at_outlet && at[0] == 4;
      }
      CHECK(exit_of(id) == (at_outlet && beyond.generation == 0 ? OUTLET : 0));
      found += exit_of(id) != 0 ? 1 : 0;
    }
  }
  CHECK(found == exit_count());
  return found;
}

static void exits_follow_changes(void) {
  dsw_face_id faces[64];
  dsw_volume_id gone = {3, 1};
  size_t count, before, i;
  begin(0);
  before = exits_are_the_outlet();
  CHECK(before == (g_dimension == 3 ? 4u : 2u));
  cut_along(0.5, 0);
  CHECK(exits_are_the_outlet() == before + (g_dimension == 3 ? 2u : 1u));
  cut_along(1.25, DSW_CUT_UNSEW);
  CHECK(exits_are_the_outlet() == before + (g_dimension == 3 ? 4u : 2u));
  CHECK_OK(dsw_environment_get_exit_faces(g_env, faces, 64, &count));
  CHECK(count == exit_count());
  for (i = 1; i < count; ++i) {
    CHECK(faces[i - 1].volume < faces[i].volume ||
          (faces[i - 1].volume == faces[i].volume && faces[i - 1].local < faces[i].local));
  }
  CHECK_FAILS(DSW_STATUS_BUFFER_TOO_SMALL, dsw_environment_get_exit_faces(g_env, faces, count - 1, &i));
  CHECK(i == count);
  /* A volume that goes takes its exits along; what lies open then is no exit. */
  gone.index = faces[0].volume;
  gone.generation = faces[0].generation;
  CHECK_OK(dsw_environment_remove_volumes(g_env, &gone, 1));
  CHECK(exits_are_the_outlet() == count - 1);
  end();
}

static void exits_are_saved(void) {
  size_t size, again_size, count;
  static unsigned char block[1 << 16], other[1 << 16];
  dsw_environment *saved, *loaded;
  begin(0);
  cut_along(0.5, 0);
  CHECK_OK(dsw_environment_save(g_env, block, sizeof block, &size));
  CHECK_OK(dsw_environment_load(NULL, block, size, &loaded));
  saved = g_env;
  g_env = loaded;
  count = exits_are_the_outlet();
  CHECK(count == (g_dimension == 3 ? 6u : 3u));
  CHECK_OK(dsw_environment_save(g_env, other, sizeof other, &again_size));
  CHECK(again_size == size && memcmp(block, other, size) == 0);
  CHECK_OK(dsw_environment_destroy(g_env));
  g_env = saved;
  /* Without exits the format is the one of before. */
  {
    dsw_face_id faces[8];
    CHECK_OK(dsw_environment_get_exit_faces(g_env, faces, 8, &count));
    CHECK_OK(dsw_environment_mark_exits(g_env, faces, count, 0));
  }
  CHECK(exit_count() == 0);
  CHECK_OK(dsw_environment_save(g_env, other, sizeof other, &again_size));
  CHECK(again_size < size && other[8] < block[8]);
  end();
}

static void bad_arguments_change_nothing(void) {
  dsw_face_id faces[2], other = face_at(0, outer_side());
  dsw_scene *second;
  const dsw_exit *exits;
  const dsw_cast_options leave = cast_flags(DSW_CAST_LEAVE);
  dsw_particle_id p;
  dsw_body_id body;
  dsw_flight f;
  dsw_move_report r;
  dsw_move_options o = move_options();
  dsw_rigid_motion motion = {{0, 0, 0, 1}, {0, 0, 0}, {0.25, 0, 0}};
  double from[3], to[3];
  uint32_t patch = 5;
  size_t count = 99;
  begin(0);
  faces[0] = face_at(0, g_dimension == 3 ? FACE_X0 : 3);
  faces[1] = other; /* between two volumes */
  CHECK_FAILS(DSW_STATUS_BAD_TOPOLOGY, dsw_environment_mark_exits(g_env, faces, 2, 1));
  CHECK_MESSAGE("faces[1]");
  CHECK(exit_of(faces[0]) == 0 && exit_of(other) == 0);
  faces[1] = face_at(0, 99);
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_mark_exits(g_env, faces, 2, 1));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_mark_exits(g_env, NULL, 1, 1));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_mark_exits(NULL, faces, 1, 1));
  CHECK_OK(dsw_environment_mark_exits(g_env, NULL, 0, 1));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_get_exit(g_env, faces[1], &patch));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_get_exit(g_env, faces[0], NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_get_exit(NULL, faces[0], &patch));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_get_exit_faces(NULL, faces, 2, &count));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_get_exits(g_scene, NULL, &count));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_get_exits(NULL, &exits, &count));
  CHECK(patch == 5 && count == 99);
  second = make_scene(g_env, 0);
  CHECK_FAILS(DSW_STATUS_SHARED, dsw_environment_mark_exits(g_env, faces, 1, 1));
  CHECK_OK(dsw_scene_destroy(second));
  /* An id may occur twice, and the patch may change. */
  faces[1] = faces[0];
  CHECK_OK(dsw_environment_mark_exits(g_env, faces, 2, 3));
  CHECK(exit_of(faces[0]) == 3 && exit_count() == (g_dimension == 3 ? 5u : 3u));
  CHECK_OK(dsw_environment_mark_exits(g_env, faces, 2, 4));
  CHECK(exit_of(faces[0]) == 4);
  CHECK_OK(dsw_environment_mark_exits(g_env, faces, 2, 0));
  CHECK(exit_of(faces[0]) == 0 && exits_are_the_outlet() == (g_dimension == 3 ? 4u : 2u));
  /* Only moves of particles, and of bodies one vertex after the other, have the flags. */
  put(from, 0.5, 0.5, 0.5);
  put(to, 1.5, 0.5, 0.5);
  p = particle_at(0.5);
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_environment_cast(g_env, no_volume, from, to, &leave, &f));
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_scene_cast_from_particles(g_scene, &p, 1, to, 0, &leave, &f));
  body = make_wire(0, 0);
  o.flags = DSW_MOVE_LEAVE;
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_body_move_rigid(g_scene, body, &motion, &o, &r));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_get_exits(g_scene, body, NULL, &count));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_body_get_exits(NULL, body, &exits, &count));
  CHECK_OK(dsw_body_destroy(g_scene, body));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_body_get_exits(g_scene, body, &exits, &count));
  end();
}

int main(void) {
  for (g_dimension = 2; g_dimension <= 3; ++g_dimension) {
    check_in(g_dimension == 3 ? "space" : "plane");
    a_particle_waits_at_an_exit();
    particles_leave(0);
    particles_leave(DSW_FEATURE_LIVE_CHANGES | DSW_FEATURE_CROSSINGS | DSW_FEATURE_STATISTICS);
    a_wire_leaves(0, DSW_RESPONSE_STOP);
    a_wire_leaves(DSW_FEATURE_BODY_CONTACTS, DSW_RESPONSE_SLIDE);
    a_wire_leaves(DSW_FEATURE_LIVE_CHANGES, DSW_RESPONSE_SLIDE);
    many_bodies_leave_at_once();
    a_thick_vertex_leaves_at_its_radius();
    a_thick_vertex_leaves_beside_a_wall();
    an_inserted_vertex_leaves();
    exits_follow_changes();
    exits_are_saved();
    bad_arguments_change_nothing();
  }
  return check_result();
}
