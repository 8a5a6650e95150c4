/* The embedded vessel: a trunk that branches twice, with an aneurysm at one fork, inside a sleeve of tissue.
 *
 * A lattice of cubes, six tetrahedra each, is cut along two level sets of one smooth distance-like function: 0 is the
 * wall, kSleeve the outside. Lattice points near a level are moved onto it first, which keeps slivers out; an edge
 * that still crosses a level is split there. Every tetrahedron splits its edges in the same global order, so both
 * sides of a face are cut alike and no table of cases is needed. */
#include "mesh.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { kBranches = 7, kPieces = 20, kLumen = 1, kTissue = 2 };

/* Where a point lies; only an edge from below to above a level is cut by it. */
enum { kInside = 0, kOnWall = 1, kBetween = 2, kOnOutside = 3, kOutside = 4 };

static const double kLength = 90.0, kHalfWidth = 32.0, kHalfHeight = 17.0, kSleeve = 2.8, kBlend = 2.4, kSnap = 0.27;

/* A cubic Bezier curve and the radii at its ends, mm. */
typedef struct branch {
  double control[4][3], radius[2];
} branch;

static const branch kTree[kBranches] = {{{{-6, 0, 0}, {8, 4, 0}, {21, 1, 3}, {33, 0, 2}}, {4.4, 3.9}},
                                        {{{33, 0, 2}, {41, 2.5, 1}, {50, 13, -3}, {59, 12, -1}}, {3.5, 3.0}},
                                        {{{33, 0, 2}, {40, -2.5, 3}, {46, -14, 4}, {56, -12.5, 3}}, {3.3, 2.8}},
                                        {{{59, 12, -1}, {67, 11, 1}, {76, 24, 4}, {96, 22, 6}}, {2.6, 2.0}},
                                        {{{59, 12, -1}, {68, 13, -3}, {78, 4, -10}, {96, 7, -8}}, {2.4, 1.8}},
                                        {{{56, -12.5, 3}, {65, -11.5, 2}, {76, -2, 10}, {96, -7, 9}}, {2.4, 1.8}},
                                        {{{56, -12.5, 3}, {65, -13.5, 4}, {74, -27, -3}, {96, -21, -5}}, {2.5, 1.9}}};
static const double kAneurysm[4] = {40.5, 0.4, 7.6, 4.3};

typedef struct builder {
  double nodes[kBranches][kPieces + 1][4];
  double *points; /* 3 doubles each, lattice points first, then the cuts */
  unsigned char *place;
  size_t point_count, point_capacity;
  uint32_t *cut_keys; /* two ends and the new point of every edge that was cut, a hash table */
  size_t cut_capacity, cut_count;
  uint32_t *cells; /* five each: points and region */
  size_t cell_count, cell_capacity;
} builder;

/* malloc and copy: the old block is given back. */
static void *grown(void *old, size_t old_count, size_t count, size_t size) {
  void *memory = demo_allocate(count, size);
  if (old != NULL) {
    memcpy(memory, old, old_count * size);
  }
  free(old);
  return memory;
}

static void sample_tree(double nodes[kBranches][kPieces + 1][4]) {
  for (int i = 0; i < kBranches; ++i) {
    for (int j = 0; j <= kPieces; ++j) {
      double t = (double)j / (double)kPieces, s = 1 - t;
      double weight[4] = {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
      for (int k = 0; k < 3; ++k) {
        nodes[i][j][k] = 0;
        for (int c = 0; c < 4; ++c) {
          nodes[i][j][k] += weight[c] * kTree[i].control[c][k];
        }
      }
      nodes[i][j][3] = s * kTree[i].radius[0] + t * kTree[i].radius[1];
    }
  }
}

static double blended(double a, double b) {
  double h = kBlend - fabs(a - b);
  double least = a < b ? a : b;
  return h > 0 ? least - h * h / (4 * kBlend) : least;
}

/* About the distance to the wall of a branch, and the way from its middle line to p. */
static double nearest_of_branch(double nodes[kPieces + 1][4], const double *p, double *away) {
  double nearest = 1e9;
  for (int j = 0; j < kPieces; ++j) {
    const double *a = nodes[j], *c = nodes[j + 1];
    double d[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]}, e[3] = {p[0] - a[0], p[1] - a[1], p[2] - a[2]};
    double t = (d[0] * e[0] + d[1] * e[1] + d[2] * e[2]) / (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    t = t < 0 ? 0 : (t > 1 ? 1 : t);
    for (int k = 0; k < 3; ++k) {
      e[k] -= t * d[k];
    }
    double distance = sqrt(e[0] * e[0] + e[1] * e[1] + e[2] * e[2]) - (a[3] + t * (c[3] - a[3]));
    if (distance < nearest) {
      nearest = distance;
      memcpy(away, e, sizeof e);
    }
  }
  return nearest;
}

/* About the distance to the wall: negative in the lumen. */
static double level_at(builder *b, const double *p) {
  double level = 1e9;
  for (int i = 0; i < kBranches; ++i) {
    double away[3], nearest = nearest_of_branch(b->nodes[i], p, away);
    level = blended(level, nearest);
  }
  double e[3] = {p[0] - kAneurysm[0], p[1] - kAneurysm[1], p[2] - kAneurysm[2]};
  return blended(level, sqrt(e[0] * e[0] + e[1] * e[1] + e[2] * e[2]) - kAneurysm[3]);
}

/* Moves a lattice point onto `level` if it is near; the flat ends of the box stay flat. */
static int snap(builder *b, double *p, double value, double level, double spacing) {
  if (fabs(value - level) > kSnap * spacing) {
    return 0;
  }
  double q[3] = {p[0], p[1], p[2]}, moved = 0;
  int flat = p[0] == 0 || p[0] == kLength;
  for (int round = 0; round < 3; ++round) {
    double gradient[3], square = 0, here = level_at(b, q) - level;
    for (int k = 0; k < 3; ++k) {
      double at[3] = {q[0], q[1], q[2]};
      at[k] += 1e-4;
      gradient[k] = k == 0 && flat ? 0 : (level_at(b, at) - level - here) * 1e4;
      square += gradient[k] * gradient[k];
    }
    if (square < 0.1) {
      return 0;
    }
    for (int k = 0; k < 3; ++k) {
      q[k] -= here * gradient[k] / square;
    }
  }
  for (int k = 0; k < 3; ++k) {
    moved += (q[k] - p[k]) * (q[k] - p[k]);
  }
  if (moved > 0.1 * spacing * spacing) {
    return 0;
  }
  memcpy(p, q, sizeof q);
  return 1;
}

static uint32_t add_point(builder *b, const double *p, unsigned char place) {
  if (b->point_count == b->point_capacity) {
    b->point_capacity = 2 * b->point_capacity + 1024;
    b->points = (double *)grown(b->points, 3 * b->point_count, 3 * b->point_capacity, sizeof(double));
    b->place = (unsigned char *)grown(b->place, b->point_count, b->point_capacity, 1);
  }
  memcpy(b->points + 3 * b->point_count, p, 3 * sizeof(double));
  b->place[b->point_count] = place;
  return (uint32_t)b->point_count++;
}

/* The level that an edge crosses, or 0. */
static unsigned char crossed(unsigned char a, unsigned char c) {
  unsigned char low = a < c ? a : c, high = a < c ? c : a;
  return (unsigned char)(low < kOnWall && high > kOnWall         ? kOnWall
                         : low < kOnOutside && high > kOnOutside ? kOnOutside
                                                                 : 0);
}

/* Slot of an edge in the hash table: where it stands or where it belongs. */
static uint32_t *cut_slot(builder *b, uint32_t low, uint32_t high) {
  size_t slot = ((size_t)low * 2654435761u ^ (size_t)high * 40503u) % b->cut_capacity;
  while (b->cut_keys[3 * slot + 1] != 0 && (b->cut_keys[3 * slot] != low || b->cut_keys[3 * slot + 1] != high)) {
    slot = (slot + 1) % b->cut_capacity;
  }
  return b->cut_keys + 3 * slot;
}

static uint32_t cut_edge(builder *b, uint32_t low, uint32_t high, unsigned char at) {
  if (2 * b->cut_count >= b->cut_capacity) {
    uint32_t *old = b->cut_keys;
    size_t old_capacity = b->cut_capacity;
    b->cut_capacity = 2 * old_capacity + 4096;
    b->cut_keys = (uint32_t *)demo_allocate(3 * b->cut_capacity, sizeof(uint32_t));
    memset(b->cut_keys, 0, 3 * b->cut_capacity * sizeof(uint32_t));
    for (size_t i = 0; i < old_capacity; ++i) {
      if (old[3 * i + 1] != 0) {
        memcpy(cut_slot(b, old[3 * i], old[3 * i + 1]), old + 3 * i, 3 * sizeof(uint32_t));
      }
    }
    free(old);
  }
  uint32_t *slot = cut_slot(b, low, high);
  if (slot[1] == 0) {
    double level = at == kOnWall ? 0 : kSleeve, from[3], to[3], middle[3];
    memcpy(from, b->points + 3 * (size_t)low, sizeof from);
    memcpy(to, b->points + 3 * (size_t)high, sizeof to);
    int rises = b->place[low] < b->place[high];
    for (int round = 0; round < 24; ++round) {
      for (int k = 0; k < 3; ++k) {
        middle[k] = 0.5 * (from[k] + to[k]);
      }
      memcpy((level_at(b, middle) < level) == rises ? from : to, middle, sizeof middle);
    }
    uint32_t added = add_point(b, middle, at);
    slot[0] = low;
    slot[1] = high;
    slot[2] = added;
    ++b->cut_count;
  }
  return slot[2];
}

static void add_cell(builder *b, const uint32_t *corner) {
  int inside = 0, outside = 0, between = 0;
  double middle[3] = {0, 0, 0};
  for (int i = 0; i < 4; ++i) {
    inside += b->place[corner[i]] == kInside;
    between += b->place[corner[i]] == kBetween;
    outside += b->place[corner[i]] == kOutside;
    for (int k = 0; k < 3; ++k) {
      middle[k] += 0.25 * b->points[3 * (size_t)corner[i] + (size_t)k];
    }
  }
  double level = inside + between + outside == 0 ? level_at(b, middle) : 0;
  if (outside > 0 || level > kSleeve) {
    return;
  }
  if (b->cell_count == b->cell_capacity) {
    b->cell_capacity = 2 * b->cell_capacity + 4096;
    b->cells = (uint32_t *)grown(b->cells, 5 * b->cell_count, 5 * b->cell_capacity, sizeof(uint32_t));
  }
  memcpy(b->cells + 5 * b->cell_count, corner, 4 * sizeof(uint32_t));
  b->cells[5 * b->cell_count++ + 4] = inside > 0 || level < 0 ? kLumen : kTissue;
}

static void cut_cell(builder *b, const uint32_t *corner) {
  int first = -1, second = -1;
  uint32_t low = 0, high = 0;
  for (int i = 0; i < 4; ++i) {
    for (int j = i + 1; j < 4; ++j) {
      uint32_t l = corner[i] < corner[j] ? corner[i] : corner[j], h = corner[i] < corner[j] ? corner[j] : corner[i];
      if (crossed(b->place[l], b->place[h]) != 0 && (first < 0 || l < low || (l == low && h < high))) {
        first = i;
        second = j;
        low = l;
        high = h;
      }
    }
  }
  if (first < 0) {
    add_cell(b, corner);
    return;
  }
  uint32_t middle = cut_edge(b, low, high, crossed(b->place[low], b->place[high]));
  uint32_t half[4];
  memcpy(half, corner, sizeof half);
  half[first] = middle;
  cut_cell(b, half);
  memcpy(half, corner, sizeof half);
  half[second] = middle;
  cut_cell(b, half);
}

static void fill_lattice(builder *b, double spacing, size_t *n) {
  for (size_t z = 0; z <= n[2]; ++z) {
    for (size_t y = 0; y <= n[1]; ++y) {
      for (size_t x = 0; x <= n[0]; ++x) {
        double p[3] = {kLength * (double)x / (double)n[0], kHalfWidth * (2.0 * (double)y / (double)n[1] - 1),
                       kHalfHeight * (2.0 * (double)z / (double)n[2] - 1)};
        double value = level_at(b, p);
        unsigned char place = value < 0 ? kInside : value < kSleeve ? kBetween : kOutside;
        if (snap(b, p, value, 0, spacing)) {
          place = kOnWall;
        } else if (snap(b, p, value, kSleeve, spacing)) {
          place = kOnOutside;
        }
        add_point(b, p, place);
      }
    }
  }
}

static void cut_lattice(builder *b, const size_t *n) {
  /* The six tetrahedra of a cube: paths from corner 0 to corner 7, one axis after the other. */
  static const int kPaths[6][2] = {{1, 3}, {2, 3}, {2, 6}, {4, 6}, {4, 5}, {1, 5}};
  for (size_t z = 0; z < n[2]; ++z) {
    for (size_t y = 0; y < n[1]; ++y) {
      for (size_t x = 0; x < n[0]; ++x) {
        uint32_t corner[8], cell[4];
        int kept = 0;
        for (size_t i = 0; i < 8; ++i) {
          corner[i] = (uint32_t)(((z + (i >> 2)) * (n[1] + 1) + y + (i >> 1 & 1)) * (n[0] + 1) + x + (i & 1));
          kept |= b->place[corner[i]] < kOnOutside;
        }
        for (int i = 0; kept && i < 6; ++i) {
          cell[0] = corner[0];
          cell[1] = corner[kPaths[i][i & 1]];
          cell[2] = corner[kPaths[i][1 - (i & 1)]];
          cell[3] = corner[7];
          cut_cell(b, cell);
        }
      }
    }
  }
}

/* Copies what is used, renumbered in order of first use. */
static void copy_mesh(const builder *b, demo_mesh *mesh) {
  uint32_t *number = (uint32_t *)demo_allocate(b->point_count, sizeof(uint32_t));
  memset(number, 0xff, b->point_count * sizeof(uint32_t));
  mesh->cell_count = b->cell_count;
  mesh->connectivity_count = 4 * b->cell_count;
  mesh->points = (double *)demo_allocate(3 * b->point_count, sizeof(double));
  mesh->types = (uint8_t *)demo_allocate(b->cell_count, 1);
  mesh->offsets = (int64_t *)demo_allocate(b->cell_count + 1, sizeof(int64_t));
  mesh->connectivity = (int64_t *)demo_allocate(4 * b->cell_count, sizeof(int64_t));
  mesh->regions = (int32_t *)demo_allocate(b->cell_count, sizeof(int32_t));
  memset(mesh->types, 10, b->cell_count);
  for (size_t i = 0; i < b->cell_count; ++i) {
    mesh->offsets[i] = (int64_t)(4 * i);
    mesh->regions[i] = (int32_t)b->cells[5 * i + 4];
    for (size_t k = 0; k < 4; ++k) {
      uint32_t point = b->cells[5 * i + k];
      if (number[point] == 0xffffffffu) {
        memcpy(mesh->points + 3 * mesh->point_count, b->points + 3 * (size_t)point, 3 * sizeof(double));
        number[point] = (uint32_t)mesh->point_count++;
      }
      mesh->connectivity[4 * i + k] = (int64_t)number[point];
    }
  }
  mesh->offsets[b->cell_count] = (int64_t)(4 * b->cell_count);
  free(number);
}

int mesh_make_vessel(double spacing, demo_mesh *mesh) {
  memset(mesh, 0, sizeof *mesh);
  if (!(spacing >= 0.6 && spacing <= 2.5)) {
    fprintf(stderr, "demo: spacing of the embedded vessel is %g, must be within 0.6 .. 2.5\n", spacing);
    return 2;
  }
  builder b;
  size_t n[3] = {(size_t)(kLength / spacing + 0.5), (size_t)(2 * kHalfWidth / spacing + 0.5),
                 (size_t)(2 * kHalfHeight / spacing + 0.5)};
  memset(&b, 0, sizeof b);
  sample_tree(b.nodes);
  fill_lattice(&b, spacing, n);
  cut_lattice(&b, n);
  copy_mesh(&b, mesh);
  mesh->lumen = kLumen;
  mesh->has_inlet = 1; /* the trunk enters through the flat end at x = 0 */
  free(b.points);
  free(b.place);
  free(b.cut_keys);
  free(b.cells);
  return 0;
}

void mesh_find_ways_inward(const double *points, size_t count, double *ways) {
  double nodes[kBranches][kPieces + 1][4];
  sample_tree(nodes);
  for (size_t i = 0; i < count; ++i) {
    double sum = 0, *way = ways + 3 * i;
    memset(way, 0, 3 * sizeof *way);
    for (int j = 0; j < kBranches; ++j) {
      double away[3], level = nearest_of_branch(nodes[j], points + 3 * i, away);
      double depth = level < kSleeve ? (kSleeve - level) / kSleeve : 0, weight = depth * depth * depth;
      double share = depth < 1 ? depth : 1; /* of the way to the middle: all in the lumen, none at the outside */
      sum += weight;
      for (int k = 0; k < 3; ++k) {
        way[k] -= weight * share * away[k];
      }
    }
    for (int k = 0; k < 3 && sum > 0; ++k) {
      way[k] /= sum;
    }
  }
}
