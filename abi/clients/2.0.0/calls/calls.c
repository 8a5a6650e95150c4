/* usage: calls            prints all lines
 *        calls EXPECTED   and compares them with a file: the first line that differs is a failure */
#include "calls.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const dsw_volume_id no_volume = {0, 0};

static FILE *expected = NULL;
static int line_number = 0, failures = 0;

static void compare(const char *line) {
  char wanted[1024] = "";
  ++line_number;
  if (expected == NULL || failures != 0) return;
  if (fgets(wanted, sizeof wanted, expected) == NULL) wanted[0] = 0;
  wanted[strcspn(wanted, "\r\n")] = 0;
  if (strcmp(line, wanted) == 0) return;
  ++failures;
  fprintf(stderr, "line %d\n  is  %s\n  was %s\n", line_number, line, wanted);
}

void say(const char *format, ...) {
  char line[1024];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(line, sizeof line, format, arguments);
  va_end(arguments);
  puts(line);
  compare(line);
}

dsw_status tried(const char *call, dsw_status status) {
  const char *const message = dsw_last_error_message();
  say("%s: %s%s", call, dsw_status_string(status),
      status != DSW_STATUS_OK && (message == NULL || message[0] == 0) ? ", without a message" : "");
  return status;
}

void say_numbers(const char *name, const double *numbers, size_t count) {
  char line[512];
  size_t i, at = (size_t)snprintf(line, sizeof line, "%s", name);
  for (i = 0; i < count && at < sizeof line; ++i) {
    const double number = fabs(numbers[i]) < 5e-7 ? 0 : numbers[i];
    at += (size_t)snprintf(line + at, sizeof line - at, isinf(number) ? " infinity" : " %.5g", number);
  }
  say("%s", line);
}

void say_contact(const dsw_contact *contact) {
  say("  contact of kind %d: obstacle %d, wall of volume %u, front %u, behind %u, marked %d, tag %u", (int)contact->kind,
      (int)contact->obstacle.kind, contact->wall.volume, contact->front.index, contact->behind.index,
      (int)contact->marked_kind, contact->tag);
  say_numbers("  normal", contact->normal, 3);
}

void say_flight(const char *name, const dsw_flight *flight) {
  say("%s: outcome %d in volume %u", name, (int)flight->outcome, flight->volume.index);
  say_numbers("  time", &flight->time, 1);
  say_numbers("  position", flight->position, 3);
  if (flight->outcome == DSW_OUTCOME_CONTACT) say_contact(&flight->contact);
}

void say_environment(const dsw_environment *environment) {
  dsw_environment_info info;
  memset(&info, 0, sizeof info);
  info.struct_size = sizeof info;
  TRY(dsw_environment_get_info(environment, &info));
  say("  %u dimensions, %u vertices, %u volumes, %u faces, %u outside, %u parts, %u scenes, %s memory", info.dimension,
      info.vertex_count, info.volume_count, info.face_count, info.boundary_face_count, info.part_count,
      info.scene_count, info.memory_bytes > 0 ? "some" : "no");
  say_numbers("  lower", info.lower, 3);
  say_numbers("  upper", info.upper, 3);
  TRY(dsw_environment_check(environment, NULL));
}

static void put_cells(int64_t *cells, int32_t *regions, uint32_t *tags, const uint32_t *n) {
  static const uint32_t corners[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                         {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  uint32_t v, c;
  for (v = 0; v < n[0] * n[1] * n[2]; ++v) {
    const uint32_t at[3] = {v % n[0], v / n[0] % n[1], v / n[0] / n[1]};
    for (c = 0; c < 8; ++c) {
      cells[8 * v + c] = (at[0] + corners[c][0]) + (n[0] + 1) * ((at[1] + corners[c][1]) + (n[1] + 1) * (int64_t)(at[2] + corners[c][2]));
    }
    regions[v] = (int32_t)at[0];
    tags[v] = 100 + v;
  }
}

enum { MOST_POINTS = 125, MOST_VOLUMES = 64 };

static dsw_environment *make_any_block(dsw_context *context, const uint32_t *n, uint32_t flags, int has_labels) {
  static double points[3 * MOST_POINTS];
  static int64_t cells[8 * MOST_VOLUMES];
  static int32_t regions[MOST_VOLUMES];
  static uint32_t tags[MOST_VOLUMES];
  const uint32_t count = (n[0] + 1) * (n[1] + 1) * (n[2] + 1);
  dsw_environment *environment = NULL;
  dsw_environment_desc desc;
  uint32_t i;
  for (i = 0; i < count; ++i) {
    points[3 * i] = i % (n[0] + 1);
    points[3 * i + 1] = i / (n[0] + 1) % (n[1] + 1);
    points[3 * i + 2] = i / (n[0] + 1) / (n[1] + 1);
  }
  put_cells(cells, regions, tags, n);
  dsw_environment_desc_init(&desc, sizeof desc);
  desc.flags = flags;
  desc.points = points;
  desc.point_count = count;
  desc.uniform_cell_type = DSW_CELL_TYPE_HEXAHEDRON;
  desc.volume_count = n[0] * n[1] * n[2];
  desc.connectivity = cells;
  desc.connectivity_count = 8 * desc.volume_count;
  if (has_labels) desc.regions = regions, desc.tags = tags;
  if (dsw_environment_create(context, &desc, &environment, NULL) != DSW_STATUS_OK) say("no block");
  return environment;
}

dsw_environment *make_block(dsw_context *context, uint32_t x, uint32_t y, uint32_t z, uint32_t flags) {
  const uint32_t n[3] = {x, y, z};
  return make_any_block(context, n, flags, 1);
}

dsw_environment *make_block_without_labels(uint32_t x, uint32_t y, uint32_t z) {
  const uint32_t n[3] = {x, y, z};
  return make_any_block(NULL, n, 0, 0);
}

dsw_scene *make_scene(dsw_environment *environment, uint32_t features) {
  dsw_scene *scene = NULL;
  dsw_scene_desc desc;
  dsw_scene_desc_init(&desc, sizeof desc);
  desc.features = features;
  if (dsw_scene_create(environment, &desc, &scene) != DSW_STATUS_OK) say("no scene");
  return scene;
}

dsw_volume_id volume_at(const dsw_environment *environment, uint32_t index) {
  dsw_volume_id volume = {0, 0};
  if (dsw_environment_get_volume_id(environment, index, &volume) != DSW_STATUS_OK) say("no volume %u", index);
  return volume;
}

dsw_vertex_id vertex_at(const dsw_environment *environment, uint32_t index) {
  dsw_vertex_id vertex = {0, 0};
  if (dsw_environment_get_vertex_id(environment, index, &vertex) != DSW_STATUS_OK) say("no vertex %u", index);
  return vertex;
}

dsw_cell volume_cell(dsw_volume_id volume) {
  const dsw_cell cell = {DSW_CELL_VOLUME, volume.index, volume.generation, 0};
  return cell;
}

dsw_cell face_cell(dsw_face_id face) {
  const dsw_cell cell = {DSW_CELL_FACE, face.volume, face.generation, face.local};
  return cell;
}

dsw_face_id face_between(const dsw_environment *environment, dsw_volume_id a, dsw_volume_id b) {
  dsw_face_id face = {0, 0, 0};
  uint32_t local;
  for (local = 0; local < 6; ++local) {
    dsw_volume_id other = {0, 0};
    if (dsw_environment_get_neighbour(environment, a, local, &other, NULL) != DSW_STATUS_OK) continue;
    if (other.generation != b.generation || other.index != b.index) continue;
    if (dsw_environment_get_face_id(environment, a, local, &face) == DSW_STATUS_OK) return face;
  }
  say("no face between");
  return face;
}

dsw_body_id make_wire(dsw_scene *scene, const double *ends, dsw_level level, uint32_t flags) {
  static const uint32_t edge[2] = {0, 1};
  dsw_body_id body = {0, 0};
  dsw_body_desc desc;
  dsw_body_desc_init(&desc, sizeof desc);
  desc.flags = flags;
  desc.level = level;
  desc.positions = ends;
  desc.vertex_count = 2;
  desc.edges = edge;
  desc.edge_count = 1;
  if (dsw_body_create(scene, &desc, &body) != DSW_STATUS_OK) say("no wire");
  return body;
}

int main(int argument_count, char **arguments) {
  if (argument_count == 2) {
    expected = fopen(arguments[1], "r");
    if (expected == NULL) return fprintf(stderr, "%s cannot be read\n", arguments[1]), 2;
  }
  call_defaults();
  call_context();
  call_environment();
  call_queries();
  call_particles();
  call_bodies();
  call_moves();
  call_deformations();
  call_topology();
  call_surgery();
  call_records();
  call_lifetimes();
  call_plane();
  say("end");
  if (expected != NULL) fclose(expected);
  return failures != 0;
}
