#include "strip.h"

#include "check.h"

unsigned g_dimension;
dsw_environment *g_env;

void use_dimension(unsigned dimension) {
  g_dimension = dimension;
  check_in(dimension == 3 ? "in space" : "in the plane");
}

void begin(void) { g_env = g_dimension == 3 ? make_environment(NULL, 3, 1, 1) : make_squares(NULL, 3, 1); }

void end(uint32_t volumes, uint32_t boundary) {
  const dsw_environment_info info = info_of(g_env);
  CHECK(info.volume_count == volumes && info.boundary_face_count == boundary);
  CHECK_OK(dsw_environment_check(g_env, NULL));
  CHECK_OK(dsw_environment_destroy(g_env));
}

uint32_t corner_index(unsigned x, unsigned y, unsigned z) { return x + 4 * (y + 2 * z); }

dsw_vertex_id corner(unsigned x, unsigned y, unsigned z) { return vertex_at(corner_index(x, y, z)); }

dsw_face_id find_face(unsigned count, const uint32_t *corners) {
  size_t offsets[2] = {0, 0}, missing = 9;
  dsw_face_id face = {9, 9, 9};
  offsets[1] = count;
  CHECK_OK(dsw_environment_find_faces(g_env, 1, offsets, corners, &face, &missing));
  CHECK(missing == 0);
  return face;
}

dsw_face_id wall(unsigned x) {
  const uint32_t corners[4] = {corner_index(x, 0, 0), corner_index(x, 1, 0), corner_index(x, 1, 1),
                               corner_index(x, 0, 1)};
  return find_face(g_dimension == 3 ? 4 : 2, corners);
}

size_t change_count(void) { return change_of(g_env).volume_count; }
