/* Scenes are made of the embedded vessel, of volumes, or of a surface. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../demo/mesh.h"
#include "state.h"

enum { kLattice = 22, kVesselVertices = 76 };

static const double kSpacing = 1.75, kWireRadius = 0.4, kLink = 1.2;

static char message[512];

const char *scene_message(void) { return message; }

int fail(const char *text) {
  sprintf(message, "%.500s", text);
  return 0;
}

int good(dsw_status status, const char *what) {
  if (status != DSW_STATUS_OK) {
    sprintf(message, "%.100s: %.60s: %.300s", what, dsw_status_string(status), dsw_last_error_message());
  }
  return status == DSW_STATUS_OK;
}

void scene_destroy(scene *s) {
  if (s == NULL) return;
  dsw_trace_destroy(s->trace);
  dsw_scene_destroy(s->scene);
  dsw_environment_destroy(s->environment);
  dsw_context_destroy(s->context);
  free(s->rest);
  free(s);
}

/* One thread, as in a browser; on another number of threads the bits are the same. */
static scene *create_empty(void) {
  dsw_context_desc desc;
  scene *s = (scene *)calloc(1, sizeof(scene));
  if (s == NULL) {
    fail("out of memory");
    return NULL;
  }
  dsw_context_desc_init(&desc, sizeof desc);
  desc.thread_count = 1;
  if (!good(dsw_context_create(&desc, &s->context), "creating a context")) {
    scene_destroy(s);
    return NULL;
  }
  return s;
}

static scene *finish(scene *s) {
  double clearance = 0;
  dsw_scene_desc desc;
  dsw_environment_info info;
  info.struct_size = sizeof info;
  dsw_scene_desc_init(&desc, sizeof desc);
  desc.features = DSW_FEATURE_DEFORMING | DSW_FEATURE_LIVE_CHANGES;
  dsw_near_options_init(&s->near_options, sizeof s->near_options);
  dsw_move_options_init(&s->move_options, sizeof s->move_options);
  s->near_options.flags = DSW_NEAR_JACOBIAN;
  s->move_options.flags = DSW_MOVE_KEEP_WALLS;
  s->move_options.vertex_response = s->move_options.edge_response = DSW_RESPONSE_SLIDE;
  if (!good(dsw_environment_get_info(s->environment, &info), "reading")) goto failed;
  memcpy(s->size.lower, info.lower, sizeof info.lower);
  memcpy(s->size.upper, info.upper, sizeof info.upper);
  s->size.volumes = info.volume_count;
  s->size.points = info.vertex_count;
  if (!find_entry(s, &clearance)) goto failed;
  if (!find_direction(s, 1.5 * clearance)) goto failed;
  s->size.wire_radius = s->is_vessel ? kWireRadius : 0.13 * clearance;
  s->size.link = s->is_vessel ? kLink : 0.33 * clearance;
  s->most_vertices = s->is_vessel ? kVesselVertices : kMostVertices;
  if (!good(dsw_scene_create(s->environment, &desc, &s->scene), "creating a scene") || !lend_points(s) ||
      !good(dsw_trace_create(s->context, &s->trace), "creating a trace") || !create_wire(s)) {
    goto failed;
  }
  return s;
failed:
  scene_destroy(s);
  return NULL;
}

scene *scene_create_vessel(void) {
  demo_mesh mesh;
  dsw_environment_desc desc;
  size_t faces = 0;
  int made;
  scene *s = create_empty();
  if (s == NULL) return NULL;
  if (mesh_make_vessel(kSpacing, &mesh) != 0) {
    fail("making the vessel");
    scene_destroy(s);
    return NULL;
  }
  dsw_environment_desc_init(&desc, sizeof desc);
  desc.points = mesh.points;
  desc.point_count = mesh.point_count;
  desc.uniform_cell_type = DSW_CELL_TYPE_TETRA;
  desc.volume_count = mesh.cell_count;
  desc.connectivity = mesh.connectivity;
  desc.connectivity_count = mesh.connectivity_count;
  desc.regions = mesh.regions;
  desc.flags = DSW_ENVIRONMENT_REORIENT;
  made = good(dsw_environment_create(s->context, &desc, &s->environment, NULL), "creating the vessel") &&
         good(dsw_environment_mark_between(s->environment, 1, 2, DSW_MARK_IMPASSABLE, &faces), "marking its wall");
  mesh_free(&mesh);
  if (!made) {
    scene_destroy(s);
    return NULL;
  }
  s->is_vessel = 1;
  return finish(s);
}

scene *scene_create_volumes(const double *points, size_t point_count, const uint8_t *types, size_t cell_count,
                            const int32_t *corners, size_t corner_count) {
  dsw_environment_desc desc;
  int32_t *offsets;
  size_t i;
  int made;
  scene *s = create_empty();
  if (s == NULL) return NULL;
  offsets = (int32_t *)malloc((cell_count + 1) * sizeof *offsets);
  if (offsets == NULL) {
    fail("out of memory");
    scene_destroy(s);
    return NULL;
  }
  offsets[0] = 0;
  for (i = 0; i < cell_count; ++i) {
    const uint8_t t = types[i];
    offsets[i + 1] = offsets[i] + (t == DSW_CELL_TYPE_TETRA        ? 4
                                   : t == DSW_CELL_TYPE_HEXAHEDRON ? 8
                                   : t == DSW_CELL_TYPE_WEDGE      ? 6
                                                                   : 5);
  }
  dsw_environment_desc_init(&desc, sizeof desc);
  desc.index_bytes = 4;
  desc.points = points;
  desc.point_count = point_count;
  desc.cell_types = types;
  desc.volume_count = cell_count;
  desc.offsets = offsets;
  desc.connectivity = corners;
  desc.connectivity_count = corner_count;
  desc.flags = DSW_ENVIRONMENT_REORIENT;
  made = good(dsw_environment_create(s->context, &desc, &s->environment, NULL), "the volumes cannot be used");
  free(offsets);
  if (!made) {
    scene_destroy(s);
    return NULL;
  }
  s->with_boundary = 1;
  return finish(s);
}

/* A lattice of cubes about a surface, all of them impassable. */
static int create_lattice(scene *s, const double *lower, const double *upper) {
  enum { kAlong = kLattice + 1, kCells = kLattice * kLattice * kLattice };
  double *points = (double *)malloc(3 * kAlong * kAlong * kAlong * sizeof *points);
  int32_t *cells = (int32_t *)malloc(8 * kCells * sizeof *cells);
  dsw_environment_desc desc;
  int i, k, made = 0;
  if (points == NULL || cells == NULL) {
    fail("out of memory");
    goto end;
  }
  for (i = 0; i < kAlong * kAlong * kAlong; ++i) {
    const int at[3] = {i % kAlong, i / kAlong % kAlong, i / kAlong / kAlong};
    for (k = 0; k < 3; ++k) points[3 * i + k] = lower[k] + (upper[k] - lower[k]) * at[k] / kLattice;
  }
  for (i = 0; i < kCells; ++i) {
    const int first = (i / kLattice / kLattice * kAlong + i / kLattice % kLattice) * kAlong + i % kLattice;
    for (k = 0; k < 8; ++k)
      cells[8 * i + k] = first + ((k + 1) / 2) % 2 + kAlong * ((k / 2) % 2) + kAlong * kAlong * (k / 4);
  }
  dsw_environment_desc_init(&desc, sizeof desc);
  desc.index_bytes = 4;
  desc.points = points;
  desc.point_count = (size_t)kAlong * kAlong * kAlong;
  desc.connectivity = cells;
  desc.connectivity_count = 8 * (size_t)kCells;
  desc.volume_count = kCells;
  made =
      good(dsw_environment_create(s->context, &desc, &s->environment, NULL), "making a lattice") &&
      good(dsw_environment_mark_region(s->environment, 0, DSW_MARK_IMPASSABLE, 0, NULL, NULL), "marking the lattice");
end:
  free(points);
  free(cells);
  return made;
}

scene *scene_create_surface(const double *points, size_t point_count, const uint32_t *triangles,
                            size_t triangle_count) {
  double lower[3], upper[3];
  dsw_carve_desc desc;
  dsw_change change;
  size_t i, k;
  scene *s = create_empty();
  if (s == NULL) return NULL;
  for (k = 0; k < 3; ++k) {
    lower[k] = upper[k] = points[k];
    for (i = 1; i < point_count; ++i) {
      lower[k] = points[3 * i + k] < lower[k] ? points[3 * i + k] : lower[k];
      upper[k] = points[3 * i + k] > upper[k] ? points[3 * i + k] : upper[k];
    }
  }
  for (k = 0; k < 3; ++k) {
    const double rim = 0.037 * (upper[k] - lower[k]);
    lower[k] -= rim;
    upper[k] += rim;
  }
  dsw_carve_desc_init(&desc, sizeof desc);
  desc.points = points;
  desc.point_count = point_count;
  desc.triangles = triangles;
  desc.triangle_count = triangle_count;
  change.struct_size = sizeof change;
  if (!create_lattice(s, lower, upper) ||
      !good(dsw_environment_carve(s->environment, &desc, &change), "the surface cannot be carved")) {
    scene_destroy(s);
    return NULL;
  }
  return finish(s);
}
