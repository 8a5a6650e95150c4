#include "tissue.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "run.h"

enum { kLayers = 4, kRounds = 4000, kMostCorners = 4 };

/* Faces of the outer boundary: ids, their vertices one after the other, seen from outside, and where those of each begin. */
typedef struct hull {
  dsw_face_id *faces;
  uint32_t *corners, *first;
  size_t face_count;
  dsw_vertex_id *vertices; /* each once; corners are places here */
  double *points;
  size_t vertex_count;
} hull;

void mesh_make_organ(size_t across, demo_mesh *mesh) {
  static const int kPaths[6][2] = {{1, 3}, {2, 3}, {2, 6}, {4, 6}, {4, 5}, {1, 5}};
  const size_t row = across + 1, cubes = across * across * across;
  memset(mesh, 0, sizeof *mesh);
  mesh->point_count = row * row * row;
  mesh->cell_count = 6 * cubes;
  mesh->connectivity_count = 24 * cubes;
  mesh->points = (double *)demo_allocate(3 * mesh->point_count, sizeof(double));
  mesh->types = (uint8_t *)demo_allocate(mesh->cell_count, 1);
  mesh->offsets = (int64_t *)demo_allocate(mesh->cell_count + 1, sizeof(int64_t));
  mesh->connectivity = (int64_t *)demo_allocate(mesh->connectivity_count, sizeof(int64_t));
  mesh->regions = (int32_t *)demo_allocate(mesh->cell_count, sizeof(int32_t));
  memset(mesh->types, DSW_CELL_TYPE_TETRA, mesh->cell_count);
  /* A cube pulled in towards the ball inside of it, drawn out along x, thinner to one side. */
  for (size_t i = 0; i < mesh->point_count; ++i) {
    double *p = mesh->points + 3 * i, most = 0, length = 0;
    for (size_t k = 0, rest = i; k < 3; ++k, rest /= row) {
      p[k] = 2 * (double)(rest % row) / (double)across - 1;
      most = fabs(p[k]) > most ? fabs(p[k]) : most;
      length += p[k] * p[k];
    }
    double round = length > 0 ? 0.2 + 0.8 * most / sqrt(length) : 1;
    double thin = 1 - 0.3 * round * p[0];
    p[0] *= 3.2 * round;
    p[1] *= 2.3 * round * thin;
    p[2] *= 1.7 * round * thin;
  }
  for (size_t i = 0; i < mesh->cell_count; ++i) {
    size_t cube = i / 6, x = cube % across, y = cube / across % across, z = cube / across / across;
    const int *path = kPaths[i % 6];
    int corner[4] = {0, path[i & 1], path[1 - (i & 1)], 7};
    for (size_t k = 0; k < 4; ++k) {
      size_t c = (size_t)corner[k];
      mesh->connectivity[4 * i + k] = (int64_t)(x + (c & 1) + row * (y + (c >> 1 & 1) + row * (z + (c >> 2))));
    }
    mesh->offsets[i] = (int64_t)(4 * i);
    mesh->regions[i] = 1;
  }
  mesh->offsets[mesh->cell_count] = (int64_t)(4 * mesh->cell_count);
}

static void add_face(const dsw_environment *environment, dsw_face_id face, uint32_t *place, hull *h) {
  dsw_vertex_id vertices[kMostCorners];
  dsw_cell cell;
  size_t count = 0;
  cell.kind = DSW_CELL_FACE;
  cell.index = face.volume;
  cell.generation = face.generation;
  cell.local = face.local;
  require(dsw_environment_copy_vertices(environment, cell, vertices, kMostCorners, &count),
          "the tissue has faces that are no triangles or quadrangles", kBadInput);
  uint32_t *corners = h->corners + h->first[h->face_count];
  for (size_t k = 0; k < count; ++k) {
    uint32_t *at = place + vertices[k].index;
    if (*at == 0xffffffffu) {
      *at = (uint32_t)h->vertex_count;
      require(dsw_environment_get_vertex_position(environment, vertices[k], h->points + 3 * h->vertex_count),
              "reading tissue", kFailed);
      h->vertices[h->vertex_count++] = vertices[k];
    }
    corners[k] = *at;
  }
  h->faces[h->face_count++] = face;
  h->first[h->face_count] = h->first[h->face_count - 1] + (uint32_t)count;
}

static void find_hull(const dsw_environment *environment, const dsw_volume_id *volumes,
                      const dsw_environment_info *info, hull *h) {
  uint32_t *place = (uint32_t *)demo_allocate(info->vertex_count, sizeof(uint32_t));
  memset(place, 0xff, info->vertex_count * sizeof(uint32_t));
  memset(h, 0, sizeof *h);
  h->faces = (dsw_face_id *)demo_allocate(info->boundary_face_count, sizeof(dsw_face_id));
  h->corners = (uint32_t *)demo_allocate(kMostCorners * info->boundary_face_count, sizeof(uint32_t));
  h->first = (uint32_t *)demo_allocate(info->boundary_face_count + 1, sizeof(uint32_t));
  h->vertices = (dsw_vertex_id *)demo_allocate(info->vertex_count, sizeof(dsw_vertex_id));
  h->points = (double *)demo_allocate(3 * info->vertex_count, sizeof(double));
  h->first[0] = 0;
  for (uint32_t i = 0; i < info->volume_count; ++i) {
    uint32_t faces = 0;
    require(dsw_environment_get_volume_counts(environment, volumes[i], NULL, NULL, NULL, &faces), "reading tissue",
            kFailed);
    for (uint32_t f = 0; f < faces; ++f) {
      dsw_volume_id beyond;
      dsw_face_id face;
      require(dsw_environment_get_neighbour(environment, volumes[i], f, &beyond, NULL), "reading tissue", kFailed);
      if (beyond.generation == 0) {
        require(dsw_environment_get_face_id(environment, volumes[i], f, &face), "reading tissue", kFailed);
        add_face(environment, face, place, h);
      }
    }
  }
  free(place);
}

/* The deepest point behind all faces, roughly: steps away from the face whose plane is nearest, shorter and shorter. */
static void find_centre(const hull *h, double *centre) {
  double *planes = (double *)demo_allocate(4 * h->face_count, sizeof(double)), best = -1e300, at[3] = {0, 0, 0},
         size = 0;
  for (size_t i = 0; i < 3 * h->vertex_count; ++i) {
    at[i % 3] += h->points[i] / (double)h->vertex_count;
  }
  for (size_t i = 0; i < h->face_count; ++i) {
    const uint32_t *c = h->corners + h->first[i];
    const double *p = h->points + 3 * (size_t)c[0], *q = h->points + 3 * (size_t)c[1],
                 *r = h->points + 3 * (size_t)c[2];
    double a[3] = {q[0] - p[0], q[1] - p[1], q[2] - p[2]}, b[3] = {r[0] - p[0], r[1] - p[1], r[2] - p[2]};
    double n[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (size_t k = 0; k < 3; ++k) {
      planes[4 * i + k] = n[k] / length;
    }
    planes[4 * i + 3] = (n[0] * p[0] + n[1] * p[1] + n[2] * p[2]) / length;
    double far =
        sqrt((p[0] - at[0]) * (p[0] - at[0]) + (p[1] - at[1]) * (p[1] - at[1]) + (p[2] - at[2]) * (p[2] - at[2]));
    size = far > size ? far : size;
  }
  for (size_t round = 0; round < kRounds; ++round) {
    double least = 1e300, step = 0.1 * size / (1 + 0.02 * (double)round);
    const double *nearest = planes;
    for (const double *n = planes; n < planes + 4 * h->face_count; n += 4) {
      double depth = n[3] - n[0] * at[0] - n[1] * at[1] - n[2] * at[2];
      nearest = depth < least ? n : nearest;
      least = depth < least ? depth : least;
    }
    if (least > best) {
      best = least;
      memcpy(centre, at, sizeof at);
    }
    for (size_t k = 0; k < 3; ++k) {
      at[k] -= step * nearest[k];
    }
  }
  free(planes);
  if (best <= 0) {
    fprintf(stderr, "demo: the tissue cannot be used: there is no point from which all of its surface can be seen\n");
    exit(kBadInput);
  }
}

/* Wedges and hexahedra, layer by layer; points of a layer are those of the hull, scaled. */
static void add_layers(dsw_environment *environment, const hull *h, const double *centre, const double *scales) {
  size_t n = h->vertex_count, cells = kLayers * h->face_count, used = 0;
  double *points = (double *)demo_allocate(3 * kLayers * n, sizeof(double));
  int64_t *connectivity = (int64_t *)demo_allocate(2 * kMostCorners * cells, sizeof(int64_t));
  int64_t *offsets = (int64_t *)demo_allocate(cells + 1, sizeof(int64_t));
  uint8_t *types = (uint8_t *)demo_allocate(cells, 1);
  int32_t *regions = (int32_t *)demo_allocate(cells, sizeof(int32_t));
  dsw_volumes_desc desc;
  for (size_t i = 0; i < 3 * kLayers * n; ++i) {
    points[i] = centre[i % 3] + scales[i / (3 * n)] * (h->points[i % (3 * n)] - centre[i % 3]);
  }
  for (size_t i = 0; i < cells; ++i) {
    size_t face = i % h->face_count, layer = i / h->face_count, count = h->first[face + 1] - h->first[face];
    offsets[i] = (int64_t)used;
    types[i] = count == 3 ? DSW_CELL_TYPE_WEDGE : DSW_CELL_TYPE_HEXAHEDRON;
    regions[i] = kAirRegion;
    for (size_t k = 0; k < 2 * count; ++k) {
      /* VTK's wedge has its first triangle turned the other way. */
      size_t corner = count == 3 ? (3 - k % 3) % 3 : k % 4;
      connectivity[used++] = (int64_t)(h->corners[h->first[face] + corner] + (layer + k / count) * n);
    }
  }
  offsets[cells] = (int64_t)used;
  dsw_volumes_desc_init(&desc, sizeof desc);
  desc.vertices = h->vertices;
  desc.vertex_count = n;
  desc.points = points;
  desc.point_count = kLayers * n;
  desc.cell_types = types;
  desc.volume_count = cells;
  desc.offsets = offsets;
  desc.connectivity = connectivity;
  desc.connectivity_count = used;
  desc.regions = regions;
  desc.sew_to = h->faces;
  desc.sew_count = h->face_count;
  require(dsw_environment_add_volumes(environment, &desc, NULL, NULL), "putting the tissue in air", kBadInput);
  free(points);
  free(connectivity);
  free(offsets);
  free(types);
  free(regions);
}

void tissue_put_in_air(dsw_environment *environment, double most, double *first, double *centre) {
  double scales[kLayers];
  dsw_environment_info info;
  hull h;
  info.struct_size = sizeof info;
  require(dsw_environment_get_info(environment, &info), "reading tissue", kFailed);
  dsw_volume_id *volumes = (dsw_volume_id *)demo_allocate(info.volume_count, sizeof(dsw_volume_id));
  for (uint32_t i = 0; i < info.volume_count; ++i) {
    require(dsw_environment_get_volume_id(environment, i, volumes + i), "reading tissue", kFailed);
  }
  require(dsw_environment_mark_volumes(environment, volumes, info.volume_count, DSW_MARK_IMPASSABLE, 0, NULL),
          "marking the tissue", kFailed);
  find_hull(environment, volumes, &info, &h);
  find_centre(&h, centre);
  for (size_t i = 0; i < kLayers; ++i) { /* each layer thicker than the one before */
    double part = (double)(i + 1) / (double)kLayers;
    scales[i] = 1 + (most - 1) * part * part;
  }
  add_layers(environment, &h, centre, scales);
  free(volumes);
  free(h.faces);
  free(h.corners);
  free(h.first);
  free(h.vertices);
  free(h.points);
  *first = scales[0];
}
