/* surgery.h in the plane: cracks that open into wedges, into the air beside a tissue, or into the outside. */
#include <math.h>
#include <string.h>

#include "check.h"
#include "fixture.h"

enum { kCells = 16 };

static dsw_environment *g_env; /* 4 x 4 squares, number x + 4 y */
static double g_path[6];
static dsw_cut_report g_report;
static dsw_cut_face g_faces[16];
static dsw_open_report g_opened;

static void begin(void) { g_env = make_squares(NULL, 4, 4); }

/* Upwards at x, from below everything; its front is on the right. */
static dsw_cut_desc path_at(double x, double y_end) {
  dsw_cut_desc d;
  g_path[0] = g_path[2] = x;
  g_path[1] = -1;
  g_path[3] = y_end;
  dsw_cut_desc_init(&d, sizeof d);
  d.points = g_path;
  d.rows = 2;
  d.columns = 1;
  d.start = volume_at(0);
  return d;
}

static dsw_environment_info info(void) {
  dsw_environment_info i;
  i.struct_size = sizeof i;
  CHECK_OK(dsw_environment_get_info(g_env, &i));
  return i;
}

static void end(uint32_t volumes, uint32_t boundary, uint32_t parts) {
  const dsw_environment_info i = info();
  CHECK(i.volume_count == volumes && i.boundary_face_count == boundary && i.part_count == parts);
  CHECK_OK(dsw_environment_check(g_env, NULL));
  CHECK_OK(dsw_environment_destroy(g_env));
}

/* Keeps the faces of the last cut. */
static size_t keep_faces(void) {
  const dsw_cut_face *faces = NULL;
  size_t count = 0;
  CHECK_OK(dsw_environment_get_cut_faces(g_env, &faces, &count));
  CHECK(count <= 16);
  if (count != 0) memcpy(g_faces, faces, count * sizeof *faces);
  return count;
}

static void cut(dsw_cut_desc d, uint32_t flags) {
  d.flags = flags;
  CHECK_OK(dsw_environment_cut(g_env, &d, &g_report));
}

static double fly(double x, double y, double to_x, double to_y) {
  double from[2], to[2];
  dsw_flight flight;
  from[0] = x, from[1] = y;
  to[0] = to_x, to[1] = to_y;
  CHECK_OK(dsw_environment_cast(g_env, no_volume, from, to, NULL, &flight));
  return flight.outcome == DSW_OUTCOME_REACHED ? 1 : flight.time;
}

static double x_of(dsw_vertex_id v) {
  double at[2] = {0, 0};
  CHECK_OK(dsw_environment_get_position(g_env, v, at));
  return at[0];
}

static dsw_open_desc open_faces(size_t count, double width) {
  dsw_open_desc d;
  dsw_open_desc_init(&d, sizeof d);
  d.faces = g_faces;
  d.face_count = count;
  d.width = width;
  d.region = 7;
  d.tag = 70;
  return d;
}

static void open_them(size_t count, double width) {
  const dsw_open_desc d = open_faces(count, width);
  CHECK_OK(dsw_environment_open(g_env, &d, &g_opened));
}

static void mark_lower_half(void) {
  dsw_volume_id tissue[8];
  uint32_t i;
  for (i = 0; i < 8; ++i) tissue[i] = volume_at(i);
  CHECK_OK(dsw_environment_mark_volumes(g_env, tissue, 8, DSW_MARK_IMPASSABLE, 0, NULL));
}

static void a_crack_right_through_opens(void) {
  const dsw_cut_vertex *vertices = NULL;
  const dsw_volume_change *changes = NULL;
  dsw_volume_id gap;
  dsw_cell_type type;
  uint32_t tag = 0;
  size_t i, count = 0;
  begin();
  cut(path_at(2, 5), DSW_CUT_UNSEW);
  open_them(keep_faces(), 0.5);
  CHECK(g_opened.vertices_parted == 5 && g_opened.faces_opened == 4 && g_opened.vertices_shortened == 0);
  CHECK(g_opened.smallest_width == 0.5 && g_opened.largest_width == 0.5 && g_opened.volumes_changed == 8);
  CHECK_OK(dsw_environment_get_cut_vertices(g_env, &vertices, &count));
  CHECK(count == 10);
  for (i = 0; i < count; ++i) CHECK(x_of(vertices[i].vertex) == 1.75 || x_of(vertices[i].vertex) == 2.25);
  CHECK(keep_faces() == 4);
  CHECK_OK(dsw_environment_get_volume_changes(g_env, &changes, &count));
  gap = changes[count - 1].after;
  CHECK(changes[count - 1].before.generation == 0);
  CHECK_OK(dsw_environment_get_volume_counts(g_env, gap, &type, NULL, NULL, NULL));
  CHECK(type == DSW_CELL_TYPE_QUAD);
  CHECK_OK(dsw_environment_get_tag(g_env, gap, &tag));
  CHECK(tag == 70);
  CHECK(fly(2, 0.1, 2, 3.9) == 1 && fly(0.5, 0.1, 3.5, 3.9) == 1);
  end(20, 18, 1);
}

/* The tip of a crack that ends inside stays one vertex. */
static void a_wedge(void) {
  begin();
  cut(path_at(1.25, 2.5), DSW_CUT_UNSEW);
  open_them(keep_faces(), 0.25);
  CHECK(g_opened.vertices_parted == 2 && g_opened.faces_opened == 2 && g_opened.smallest_width == 0.25);
  CHECK(fly(1.25, 0.1, 1.25, 1.9) == 1);
  end(20, 18, 1);
}

static void a_tissue_opens_into_the_air(void) {
  dsw_cell_type type = DSW_CELL_TYPE_NONE;
  const dsw_volume_change *changes = NULL;
  size_t i, k, count;
  begin();
  mark_lower_half();
  cut(path_at(2, 5), 0);
  count = keep_faces();
  for (i = k = 0; i < count; ++i) {
    if (g_faces[i].front.volume < 8) g_faces[k++] = g_faces[i];
  }
  CHECK(k == 2 && fly(2, 3.5, 2.0001, 0.25) < 0.5);
  open_them(k, 0.5);
  CHECK(g_opened.vertices_parted == 3 && g_opened.faces_opened == 2 && g_opened.smallest_width == 0.5);
  CHECK(fly(2, 3.5, 2, 0.25) == 1 && fly(2.2, 3.5, 1.8, 0.25) == 1);
  CHECK(fly(2, 1, 3, 1) < 0.26); /* the lips are walls */
  CHECK_OK(dsw_environment_get_volume_changes(g_env, &changes, &count));
  for (i = k = 0; i < count; ++i) {
    if (changes[i].before.generation == 0) continue;
    CHECK_OK(dsw_environment_get_volume_counts(g_env, changes[i].after, &type, NULL, NULL, NULL));
    k += type == DSW_CELL_TYPE_POLYGON ? 1 : 0;
  }
  CHECK(k == 1); /* the square of the air at which the gap ends has a side more */
  end(18, 17, 1);

  /* From the surface down to a tip inside. */
  begin();
  mark_lower_half();
  g_faces[0].front = g_faces[0].back = face_at(5, 1);
  open_them(1, 0.5);
  CHECK(g_opened.vertices_parted == 1 && g_opened.faces_opened == 1);
  CHECK(fly(2, 3.5, 2, 1.25) == 1);
  end(17, 16, 1);
}

static void as_far_as_it_goes(void) {
  begin();
  cut(path_at(2, 5), 0);
  open_them(keep_faces(), 40);
  CHECK(g_opened.vertices_parted == 5 && g_opened.vertices_shortened == 5);
  CHECK(g_opened.smallest_width > 1 && g_opened.largest_width < 4);
  end(20, 18, 1);
  begin();
  cut(path_at(2, 5), 0);
  open_them(keep_faces(), 1e300);
  CHECK(g_opened.vertices_parted == 0 && g_opened.faces_opened == 0 && g_opened.largest_width == 0);
  open_them(4, 1e-300);
  CHECK(g_opened.vertices_parted == 0 && g_opened.faces_opened == 0);
  open_them(0, 1);
  end(16, 16, 1);
}

static void bad_arguments(void) {
  dsw_open_desc o;
  begin();
  cut(path_at(2, 5), 0);
  CHECK(keep_faces() == 4);
  g_faces[4] = g_faces[3];
  o = open_faces(5, 0.5);
  CHECK_FAILS(DSW_STATUS_DUPLICATE_ID, dsw_environment_open(g_env, &o, NULL));
  g_faces[4].front = face_at(0, 1), g_faces[4].back = face_at(0, 2);
  CHECK_FAILS(DSW_STATUS_BAD_TOPOLOGY, dsw_environment_open(g_env, &o, NULL));
  g_faces[4].front = face_at(0, 3), g_faces[4].back = face_at(4, 3);
  CHECK_FAILS(DSW_STATUS_BAD_TOPOLOGY, dsw_environment_open(g_env, &o, NULL));
  CHECK_MESSAGE("same vertices");
  o.width = 0;
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, dsw_environment_open(g_env, &o, NULL));
  end(16, 16, 1);
}

/* Particles follow; one that a lip would pass, or that would be closed in, is in the way. */
static void particles(void) {
  static const double beside[2] = {2.1, 1.5}, left[2] = {1.1, 0.5};
  const dsw_particle_id *blocked = NULL;
  dsw_particle_id particle, other;
  dsw_volume_id volume = {0, 0};
  dsw_scene *scene, *second;
  size_t count = 0, i;
  begin();
  scene = make_scene(g_env, 0);
  CHECK_OK(dsw_particle_create(scene, beside, no_volume, &particle));
  CHECK_OK(dsw_particle_create(scene, left, no_volume, &other));
  cut(path_at(1.25, 5), 0);
  CHECK_OK(dsw_particle_get(scene, other, NULL, &volume));
  CHECK(volume.index >= kCells); /* behind the path */
  cut(path_at(2, 5), DSW_CUT_UNSEW);
  open_them(keep_faces(), 0.5);
  CHECK(g_opened.faces_opened == 4);
  CHECK_OK(dsw_particle_get(scene, particle, NULL, &volume));
  CHECK(volume.index >= kCells); /* in the gap */
  second = make_scene(g_env, 0);
  {
    const dsw_cut_desc d = path_at(3.5, 5);
    const dsw_open_desc o = open_faces(0, 0.5);
    CHECK_FAILS(DSW_STATUS_SHARED, dsw_environment_cut(g_env, &d, NULL));
    CHECK_FAILS(DSW_STATUS_SHARED, dsw_environment_open(g_env, &o, NULL));
  }
  CHECK_OK(dsw_scene_destroy(second));
  CHECK_OK(dsw_scene_destroy(scene));
  end(24, 20, 1);

  begin();
  scene = make_scene(g_env, 0);
  cut(path_at(2, 5), DSW_CUT_UNSEW);
  CHECK(keep_faces() == 4);
  for (i = 0; i < 4; ++i) CHECK_OK(dsw_environment_mark_faces(g_env, &g_faces[i].front, 1, DSW_MARK_IMPASSABLE));
  CHECK_OK(dsw_particle_create(scene, beside, no_volume, &particle));
  {
    const dsw_open_desc o = open_faces(4, 0.5);
    CHECK_FAILS(DSW_STATUS_OCCUPIED, dsw_environment_open(g_env, &o, NULL)); /* a wall would pass it */
  }
  CHECK_OK(dsw_scene_get_occupants(scene, &blocked, &count));
  CHECK(count == 1 && blocked[0].index == particle.index && info().volume_count == 16);
  open_them(4, 0.125);
  CHECK(g_opened.faces_opened == 4);
  CHECK_OK(dsw_scene_destroy(scene));
  end(20, 18, 1);
}

static void running_out_of_memory(void) {
  host h;
  dsw_context *context;
  dsw_cut_desc d = path_at(1.25, 5);
  dsw_open_desc o;
  dsw_status status = DSW_STATUS_OUT_OF_MEMORY;
  size_t n, refusals = 0;
  int opens;
  memset(&h, 0, sizeof h);
  context = make_context(&h);
  g_env = make_squares(context, 4, 4);
  for (opens = 0; opens < 2; ++opens) {
    if (opens) o = open_faces(keep_faces(), 0.25);
    for (n = 1; n < 40000; ++n) {
      h.refuse = h.calls + n;
      status = opens ? dsw_environment_open(g_env, &o, NULL) : dsw_environment_cut(g_env, &d, NULL);
      h.refuse = 0;
      if (status != DSW_STATUS_OUT_OF_MEMORY) break;
      ++refusals;
      CHECK(info().volume_count == (opens ? 20u : 16u));
    }
    CHECK(status == DSW_STATUS_OK);
  }
  CHECK(refusals > 100);
  end(24, 20, 1);
  CHECK_OK(dsw_context_destroy(context));
  CHECK(h.alive == 0 && h.broken == 0);
}

/* As large and as small as doubles allow. */
static void any_size(void) {
  static const double sizes[] = {1e-200, 1e-165, 1e155, 1e200};
  size_t i, k;
  for (i = 0; i < 4; ++i) {
    dsw_cut_desc d = path_at(1.5, 5);
    for (k = 0; k < 4; ++k) g_path[k] *= sizes[i];
    d.start = no_volume;
    g_env = make_scaled_squares(NULL, 4, 4, sizes[i]);
    cut(d, DSW_CUT_UNSEW);
    CHECK(g_report.volumes_split == 4 && keep_faces() == 4);
    open_them(4, 0.25 * sizes[i]);
    CHECK(g_opened.faces_opened == 4 && g_opened.vertices_shortened == 0);
    CHECK(fabs(g_opened.smallest_width / sizes[i] - 0.25) < 1e-12);
    CHECK_OK(dsw_environment_destroy(g_env));
  }
}

int main(void) {
  a_crack_right_through_opens();
  a_wedge();
  a_tissue_opens_into_the_air();
  as_far_as_it_goes();
  bad_arguments();
  particles();
  running_out_of_memory();
  any_size();
  return check_result();
}
