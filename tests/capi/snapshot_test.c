#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "fixture.h"

static int g_plane;

static dsw_environment *plain_environment(void) {
  return g_plane ? make_squares(NULL, 3, 2) : make_environment(NULL, 3, 2, 2);
}

static dsw_environment *marked_environment(void) {
  dsw_environment *const env = plain_environment();
  const dsw_volume_id volume = volume_at(4);
  const dsw_face_id face = face_at(0, FACE_X1);
  const dsw_edge_id edge = edge_at(2, 3);
  const dsw_vertex_id vertex = vertex_at(g_plane ? 7 : 17);
  CHECK_OK(dsw_environment_mark_volumes(env, &volume, 1, DSW_MARK_IMPASSABLE, 0, NULL));
  CHECK_OK(dsw_environment_mark_faces(env, &face, 1, DSW_MARK_IMPASSABLE));
  if (!g_plane) CHECK_OK(dsw_environment_mark_edges(env, &edge, 1, DSW_MARK_IMPASSABLE));
  CHECK_OK(dsw_environment_mark_vertices(env, &vertex, 1, DSW_MARK_IMPASSABLE));
  return env;
}

static unsigned char *saved(const dsw_environment *env, size_t *size) {
  unsigned char *block;
  CHECK_OK(dsw_environment_save(env, NULL, 0, size));
  block = (unsigned char *)malloc(*size);
  CHECK_OK(dsw_environment_save(env, block, *size, size));
  return block;
}

static int is_marked(const dsw_environment *env, dsw_cell cell) {
  int marked = -1;
  CHECK_OK(dsw_environment_is_marked(env, cell, &marked));
  return marked;
}

static void what_was_saved_is_loaded(void) {
  dsw_environment *const env = marked_environment();
  dsw_environment *loaded = NULL;
  size_t size = 0, again = 0, count = 0;
  unsigned char *const block = saved(env, &size);
  unsigned char *second;
  const uint32_t vertex = g_plane ? 7 : 17;
  int32_t region = -1;
  uint32_t tag = 0;
  const double from[3] = {0.5, 0.5, 0.5}, to[3] = {2.5, 1.25, 1.75};
  dsw_flight a, b;
  memset(&a, 0, sizeof a);
  memset(&b, 0, sizeof b);
  CHECK_OK(dsw_environment_load(NULL, block, size, &loaded));
  CHECK(is_marked(loaded, cell_at(DSW_CELL_VOLUME, 4, 0)) && !is_marked(loaded, cell_at(DSW_CELL_VOLUME, 5, 0)));
  CHECK(is_marked(loaded, cell_at(DSW_CELL_FACE, 1, g_plane ? 3 : FACE_X0)));
  CHECK(g_plane || is_marked(loaded, cell_at(DSW_CELL_EDGE, 2, 3)));
  CHECK(is_marked(loaded, cell_at(DSW_CELL_VERTEX, vertex, 0)));
  CHECK(!is_marked(loaded, cell_at(DSW_CELL_VERTEX, vertex - 1, 0)));
  CHECK_OK(dsw_environment_get_mark_count(loaded, DSW_CELL_FACE, &count));
  CHECK(count == 1);
  CHECK_OK(dsw_environment_get_region(loaded, volume_at(5), &region));
  CHECK_OK(dsw_environment_get_tag(loaded, volume_at(5), &tag));
  CHECK(region == 2 && tag == 105);
  CHECK_OK(dsw_environment_cast(env, no_volume, from, to, NULL, &a));
  CHECK_OK(dsw_environment_cast(loaded, no_volume, from, to, NULL, &b));
  CHECK(memcmp(&a, &b, sizeof a) == 0);
  second = saved(loaded, &again);
  CHECK(again == size && memcmp(block, second, size) == 0);
  CHECK_OK(dsw_environment_destroy(loaded));
  CHECK_OK(dsw_environment_destroy(env));
  free(block);
  free(second);
}

static void a_small_buffer_gets_nothing(void) {
  dsw_environment *const env = marked_environment();
  unsigned char block[16];
  size_t size = 0;
  memset(block, 0x55, sizeof block);
  CHECK_FAILS(DSW_STATUS_BUFFER_TOO_SMALL, dsw_environment_save(env, block, sizeof block, &size));
  CHECK(size > sizeof block && block[0] == 0x55);
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_save(env, NULL, 16, &size));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_save(env, block, 16, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_save(NULL, block, 16, &size));
  CHECK_OK(dsw_environment_destroy(env));
}

static void a_damaged_block_is_refused(void) {
  dsw_environment *const env = marked_environment();
  dsw_environment *loaded = NULL;
  size_t size = 0, i;
  unsigned char *const block = saved(env, &size);
  for (i = 0; i < size; i += i < 128 ? 1 : 37) { /* every truncation ends in an error */
    const dsw_status status = dsw_environment_load(NULL, block, i, &loaded);
    CHECK(status == DSW_STATUS_TRUNCATED);
  }
  for (i = 0; i < size; i += i < 128 ? 1 : 13) { /* and every flipped byte */
    const int is_version = i >= 8 && i < 12, is_longer = i >= 16 && i < 24 && (block[i] & 0x40) == 0;
    dsw_status status;
    block[i] ^= 0x40;
    status = dsw_environment_load(NULL, block, size, &loaded);
    CHECK(status == (is_version ? DSW_STATUS_BAD_VERSION : is_longer ? DSW_STATUS_TRUNCATED : DSW_STATUS_CORRUPT));
    block[i] ^= 0x40;
  }
  CHECK(loaded == NULL);
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_load(NULL, block, size, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_environment_load(NULL, NULL, size, &loaded));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_environment_load((dsw_context *)(void *)env, block, size, &loaded));
  CHECK_OK(dsw_environment_load(NULL, block, size, &loaded));
  CHECK_OK(dsw_environment_destroy(loaded));
  CHECK_OK(dsw_environment_destroy(env));
  free(block);
}

static void a_context_is_used_and_kept(void) {
  host h;
  dsw_context *const context = make_context(&h);
  dsw_environment *const env = marked_environment();
  dsw_environment *loaded = NULL;
  size_t size = 0, refusals;
  unsigned char *const block = saved(env, &size);
  for (refusals = 0; refusals < 1000; ++refusals) { /* memory runs out at every point once */
    dsw_status status;
    h.refuse = h.calls + refusals + 1;
    status = dsw_environment_load(context, block, size, &loaded);
    if (status == DSW_STATUS_OK) break;
    CHECK(status == DSW_STATUS_OUT_OF_MEMORY && loaded == NULL && h.alive == 1);
  }
  h.refuse = 0;
  CHECK(refusals >= 3 && refusals < 1000 && loaded != NULL);
  CHECK_FAILS(DSW_STATUS_IN_USE, dsw_context_destroy(context));
  CHECK_OK(dsw_environment_destroy(loaded));
  end_context(context, &h);
  CHECK_OK(dsw_environment_destroy(env));
  free(block);
}

static void scenes_are_saved_and_loaded(void) {
  dsw_environment *const env = plain_environment();
  dsw_scene *const scene = make_scene(env, DSW_FEATURE_STATISTICS);
  static const double ends[2][6] = {{0.5, 0.5, 0.5, 2.5, 0.5, 0.5}, {0.5, 0.5, 2.5, 0.5}};
  static const double all_targets[2][6] = {{0.25, 0.5, -0.5, 2.5, 1.5, 0.5}, {0.25, -0.5, 2.5, 0.75}};
  const double place[3] = {1.5, 1.5, 1.5}, there[3] = {3.25, 1.25, 0.5}, *const targets = all_targets[g_plane];
  const dsw_body_id body = make_edge_body(scene, ends[g_plane], DSW_LEVEL_EDGES);
  dsw_flight flights[2];
  static unsigned char block[3][8192];
  unsigned char small[16];
  dsw_particle_id particle;
  dsw_scene *loaded = NULL;
  dsw_environment *none = NULL;
  const dsw_body_contact *contacts[2];
  dsw_statistics statistics;
  size_t size = 0, again = 0, now = 0, count[2], i;
  CHECK_OK(dsw_particle_create(scene, place, no_volume, &particle));
  CHECK_OK(dsw_body_move(scene, body, targets, 2, 0, NULL, NULL));
  CHECK_OK(dsw_scene_save(scene, NULL, 0, &size));
  CHECK_OK(dsw_scene_save(scene, block[0], sizeof block[0], &again));
  CHECK(again == size);
  CHECK_OK(dsw_scene_load(env, block[0], size, &loaded));
  CHECK(dsw_scene_get_environment(loaded) == env);
  CHECK_OK(dsw_scene_save(loaded, block[1], sizeof block[1], &again));
  CHECK(again == size && memcmp(block[0], block[1], size) == 0);
  statistics.struct_size = sizeof statistics;
  CHECK_OK(dsw_scene_get_statistics(loaded, &statistics));
  CHECK(statistics.casts > 0 && statistics.contacts == 1);
  for (i = 0; i < 2; ++i) {
    dsw_scene *const each = i == 0 ? scene : loaded;
    CHECK_OK(dsw_body_get_contacts(each, body, &contacts[i], &count[i]));
    CHECK(count[i] == 1 && contacts[i]->history == DSW_HISTORY_NEW);
    CHECK_OK(dsw_body_move(each, body, targets, 2, 0, NULL, NULL));
    CHECK_OK(dsw_body_get_contacts(each, body, &contacts[i], &count[i]));
    CHECK(count[i] == 1 && contacts[i]->history == DSW_HISTORY_LASTING);
    CHECK_OK(dsw_particle_move(each, particle, there, NULL, &flights[i]));
  }
  CHECK(memcmp(contacts[0], contacts[1], sizeof *contacts[0]) == 0);
  CHECK(memcmp(&flights[0], &flights[1], sizeof flights[0]) == 0);
  CHECK_OK(dsw_scene_save(scene, block[1], sizeof block[1], &now));
  CHECK_OK(dsw_scene_save(loaded, block[2], sizeof block[2], &again));
  CHECK(again == now && memcmp(block[1], block[2], now) == 0);
  /* Every way to be refused. */
  CHECK_OK(dsw_scene_save(scene, NULL, 0, &now));
  CHECK_FAILS(DSW_STATUS_BUFFER_TOO_SMALL, dsw_scene_save(scene, small, sizeof small, &again));
  CHECK(again == now);
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_save(NULL, block[1], size, &again));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_save(scene, NULL, 16, &again));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_save(scene, block[1], size, NULL));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_load(NULL, block[0], size, &loaded));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_load(env, NULL, size, &loaded));
  CHECK_FAILS(DSW_STATUS_NULL_ARGUMENT, dsw_scene_load(env, block[0], size, NULL));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_scene_load((dsw_environment *)(void *)scene, block[0], size, &loaded));
  CHECK_FAILS(DSW_STATUS_TRUNCATED, dsw_scene_load(env, block[0], size - 8, &loaded));
  CHECK_FAILS(DSW_STATUS_CORRUPT, dsw_environment_load(NULL, block[0], size, &none));
  block[0][8] += 1;
  CHECK_FAILS(DSW_STATUS_BAD_VERSION, dsw_scene_load(env, block[0], size, &loaded));
  block[0][8] -= 1;
  block[0][size - 1] ^= 1;
  CHECK_FAILS(DSW_STATUS_CORRUPT, dsw_scene_load(env, block[0], size, &loaded));
  CHECK_OK(dsw_scene_destroy(loaded));
  end_scene(scene);
}

static void a_scene_that_bends_stays_alone(void) {
  dsw_environment *const env = plain_environment();
  dsw_scene *scene = make_scene(env, DSW_FEATURE_DEFORMING), *loaded = NULL;
  static unsigned char block[4096];
  size_t size = 0;
  CHECK_OK(dsw_scene_save(scene, block, sizeof block, &size));
  CHECK_FAILS(DSW_STATUS_IN_USE, dsw_scene_load(env, block, size, &loaded));
  CHECK_OK(dsw_scene_destroy(scene));
  CHECK_OK(dsw_scene_load(env, block, size, &loaded));
  end_scene(loaded);
}

static uint64_t mixed(uint64_t sum, const unsigned char *bytes, size_t size) {
  size_t i;
  int k;
  for (i = 0; i < size; i += 8) {
    uint64_t word = 0;
    for (k = 8; k-- != 0;) word = word << 8 | bytes[i + (size_t)k];
    sum = (sum ^ word) * UINT64_C(0x9e3779b97f4a7c15);
    sum ^= sum >> 32;
  }
  return sum;
}

/* Whatever word of a snapshot is wrong behind a right checksum, a particle that is accepted aims at a face of its volume. */
static void a_particle_aims_at_a_face_that_is_there(void) {
  enum { kChecksum = 24, kBegin = 48 };
  dsw_environment *const env = plain_environment();
  dsw_scene *const scene = make_scene(env, 0);
  static unsigned char block[4096], damaged[4096];
  const double at[3] = {0.5, 0.5, 0.5}, to[3] = {0.5, -3, 0.5};
  dsw_particle_id particle;
  dsw_flight flight;
  dsw_cell cell, face;
  size_t size = 0, i, k, refused = 0;
  CHECK_OK(dsw_particle_create(scene, at, no_volume, &particle));
  CHECK_OK(dsw_particle_move(scene, particle, to, NULL, &flight));
  CHECK_OK(dsw_particle_get_state(scene, particle, &cell, &face));
  CHECK(face.kind == DSW_CELL_FACE);
  CHECK_OK(dsw_scene_save(scene, block, sizeof block, &size));
  for (i = kBegin; i + 4 <= size; i += 4) {
    dsw_scene *loaded = NULL;
    dsw_status status;
    uint64_t sum;
    memcpy(damaged, block, size);
    memset(damaged + i, 1, 3);
    damaged[i + 3] = 0;
    sum = mixed(mixed(0, damaged, kChecksum), damaged + kChecksum + 8, size - kChecksum - 8);
    for (k = 0; k < 8; ++k) damaged[kChecksum + k] = (unsigned char)(sum >> (8 * k));
    status = dsw_scene_load(env, damaged, size, &loaded);
    refused += status == DSW_STATUS_CORRUPT && strstr(dsw_last_error_message(), "aims at") != NULL ? 1 : 0;
    if (status != DSW_STATUS_OK) continue;
    if (dsw_particle_get_state(loaded, particle, &cell, &face) == DSW_STATUS_OK && face.kind != DSW_CELL_NONE) {
      uint32_t faces = 0;
      CHECK_OK(dsw_environment_get_volume_counts(env, volume_at(cell.index), NULL, NULL, NULL, &faces));
      CHECK(face.local < faces);
    }
    CHECK_OK(dsw_scene_destroy(loaded));
  }
  CHECK(refused == 1);
  end_scene(scene);
}

/* A scene goes into an environment of its own dimension. */
static void the_dimension_is_kept(void) {
  dsw_environment *const env[2] = {make_environment(NULL, 1, 1, 1), make_squares(NULL, 1, 1)};
  dsw_scene *scenes[2], *loaded = NULL;
  static unsigned char block[4096];
  size_t i, size = 0;
  for (i = 0; i < 2; ++i) {
    scenes[i] = make_scene(env[i], 0);
    CHECK_OK(dsw_scene_save(scenes[i], block, sizeof block, &size));
    CHECK_FAILS(DSW_STATUS_CORRUPT, dsw_scene_load(env[1 - i], block, size, &loaded));
    CHECK_MESSAGE("another dimension");
  }
  for (i = 0; i < 2; ++i) end_scene(scenes[i]);
}

int main(void) {
  for (g_plane = 0; g_plane < 2; ++g_plane) {
    check_in(g_plane ? "in the plane" : "in space");
    what_was_saved_is_loaded();
    a_small_buffer_gets_nothing();
    a_damaged_block_is_refused();
    a_context_is_used_and_kept();
    scenes_are_saved_and_loaded();
    a_scene_that_bends_stays_alone();
    a_particle_aims_at_a_face_that_is_there();
  }
  check_in("");
  the_dimension_is_kept();
  return check_result();
}
