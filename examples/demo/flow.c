/* Shortest ways over the volumes of the lumen. Two volumes are neighbours when they share a face that is passable. */
#include "flow.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { kMostVertices = 256, kSmoothing = 8 };

/* Neighbours of slot i are link[first[i] .. first[i + 1] - 1]; hops is the number of volumes between i and a wall. */
typedef struct graph {
  size_t count, capacity;
  size_t *first;
  uint32_t *link;
  uint32_t *hops;
  const double *centre;
} graph;

static double distance(const double *a, const double *b) {
  double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
  return sqrt(x * x + y * y + z * z);
}

static void normalise(double *v) {
  double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  for (int k = 0; k < 3; ++k) {
    v[k] = length > 0 ? v[k] / length : 0;
  }
}

/* Mean of a volume's vertices: the library proves that it lies inside. */
static dsw_status find_centre(const dsw_environment *environment, dsw_volume_id volume, double *centre) {
  dsw_vertex_id vertices[kMostVertices];
  dsw_cell cell;
  size_t count = 0;
  cell.kind = DSW_CELL_VOLUME;
  cell.index = volume.index;
  cell.generation = volume.generation;
  cell.local = 0;
  dsw_status status = dsw_environment_copy_vertices(environment, cell, vertices, kMostVertices, &count);
  memset(centre, 0, 3 * sizeof(double));
  for (size_t i = 0; status == DSW_STATUS_OK && i < count; ++i) {
    double p[3];
    status = dsw_environment_get_position(environment, vertices[i], p);
    for (int k = 0; k < 3; ++k) {
      centre[k] += p[k] / (double)count;
    }
  }
  return status;
}

/* The passable neighbour behind face `local`, or a null id. */
static dsw_status find_neighbour(const dsw_environment *environment, dsw_volume_id volume, uint32_t local,
                                 dsw_volume_id *neighbour) {
  dsw_face_id face;
  dsw_volume_id sides[2];
  dsw_cell cell;
  int impassable = 0;
  dsw_status status = dsw_environment_get_volume_face(environment, volume, local, &face);
  if (status == DSW_STATUS_OK) {
    status = dsw_environment_get_face_volumes(environment, face, &sides[0], &sides[1]);
  }
  if (status == DSW_STATUS_OK) {
    cell.kind = DSW_CELL_FACE;
    cell.index = face.volume;
    cell.generation = face.generation;
    cell.local = face.local;
    status = dsw_environment_is_impassable(environment, cell, &impassable);
  }
  memset(neighbour, 0, sizeof *neighbour);
  if (status == DSW_STATUS_OK && !impassable) {
    *neighbour = sides[sides[0].index == volume.index ? 1 : 0];
  }
  return status;
}

/* Takes the volumes in reach of `start`, a slot each, with their centres and links. */
static dsw_status flood(const dsw_environment *environment, dsw_volume_id start, demo_flow *flow, graph *g) {
  dsw_status status = DSW_STATUS_OK;
  g->first[0] = 0;
  flow->count = 0;
  flow->volumes[flow->count] = start;
  flow->slot_of[start.index] = (uint32_t)flow->count++;
  for (size_t i = 0; status == DSW_STATUS_OK && i < flow->count; ++i) {
    uint32_t faces = 0;
    size_t walls = 0;
    status = find_centre(environment, flow->volumes[i], flow->centre + 3 * i);
    if (status == DSW_STATUS_OK) {
      status = dsw_environment_get_volume_counts(environment, flow->volumes[i], NULL, NULL, NULL, &faces);
    }
    g->first[i + 1] = g->first[i];
    for (uint32_t local = 0; status == DSW_STATUS_OK && local < faces; ++local) {
      dsw_volume_id neighbour;
      status = find_neighbour(environment, flow->volumes[i], local, &neighbour);
      if (neighbour.generation == 0) {
        ++walls;
        continue;
      }
      if (flow->slot_of[neighbour.index] == kNoSlot) {
        flow->volumes[flow->count] = neighbour;
        flow->slot_of[neighbour.index] = (uint32_t)flow->count++;
      }
      if (g->first[i + 1] == g->capacity) {
        uint32_t *larger = (uint32_t *)demo_allocate(2 * g->capacity, sizeof(uint32_t));
        memcpy(larger, g->link, g->capacity * sizeof(uint32_t));
        free(g->link);
        g->link = larger;
        g->capacity *= 2;
      }
      g->link[g->first[i + 1]++] = flow->slot_of[neighbour.index];
    }
    g->hops[i] = walls > 0 ? 0 : kNoSlot;
  }
  g->count = flow->count;
  return status;
}

static void count_hops(graph *g) {
  uint32_t *queue = (uint32_t *)demo_allocate(g->count, sizeof(uint32_t));
  size_t head = 0, tail = 0;
  for (size_t i = 0; i < g->count; ++i) {
    if (g->hops[i] == 0) {
      queue[tail++] = (uint32_t)i;
    }
  }
  for (; head < tail; ++head) {
    uint32_t i = queue[head];
    for (size_t k = g->first[i]; k < g->first[i + 1]; ++k) {
      if (g->hops[g->link[k]] == kNoSlot) {
        g->hops[g->link[k]] = g->hops[i] + 1;
        queue[tail++] = g->link[k];
      }
    }
  }
  free(queue);
}

static void sift_up(uint32_t *heap, uint32_t *where, const double *cost, size_t at) {
  uint32_t item = heap[at];
  while (at > 0 && cost[item] < cost[heap[(at - 1) / 2]]) {
    heap[at] = heap[(at - 1) / 2];
    where[heap[at]] = (uint32_t)at;
    at = (at - 1) / 2;
  }
  heap[at] = item;
  where[item] = (uint32_t)at;
}

static void sift_down(uint32_t *heap, uint32_t *where, const double *cost, size_t count, size_t at) {
  uint32_t item = heap[at];
  for (size_t child = 2 * at + 1; child < count; child = 2 * at + 1) {
    child += child + 1 < count && cost[heap[child + 1]] < cost[heap[child]];
    if (cost[heap[child]] >= cost[item]) {
      break;
    }
    heap[at] = heap[child];
    where[heap[at]] = (uint32_t)at;
    at = child;
  }
  heap[at] = item;
  where[item] = (uint32_t)at;
}

/* Dijkstra's algorithm. `off_wall` makes ways near the wall dear. Fills cost and, if not null, the slot each way
 * comes from. Returns the farthest slot. */
static uint32_t find_ways(const graph *g, uint32_t start, int off_wall, double *cost, uint32_t *comes_from) {
  uint32_t *heap = (uint32_t *)demo_allocate(g->count, sizeof(uint32_t));
  uint32_t *where = (uint32_t *)demo_allocate(g->count, sizeof(uint32_t));
  size_t waiting = 1;
  uint32_t last = start;
  for (size_t i = 0; i < g->count; ++i) {
    cost[i] = -1;
    where[i] = kNoSlot;
  }
  cost[start] = 0;
  heap[0] = start;
  where[start] = 0;
  if (comes_from != NULL) {
    comes_from[start] = kNoSlot;
  }
  while (waiting > 0) {
    uint32_t i = last = heap[0];
    heap[0] = heap[--waiting];
    if (waiting > 0) {
      sift_down(heap, where, cost, waiting, 0);
    }
    for (size_t k = g->first[i]; k < g->first[i + 1]; ++k) {
      uint32_t j = g->link[k];
      double way = distance(g->centre + 3 * (size_t)i, g->centre + 3 * (size_t)j);
      if (off_wall) {
        way /= (1.0 + g->hops[j]) * (1.0 + g->hops[j]);
      }
      if (cost[j] < 0 || cost[i] + way < cost[j]) {
        if (cost[j] < 0) {
          heap[waiting] = j;
          where[j] = (uint32_t)waiting++;
        }
        cost[j] = cost[i] + way;
        sift_up(heap, where, cost, where[j]);
        if (comes_from != NULL) {
          comes_from[j] = i;
        }
      }
    }
  }
  free(heap);
  free(where);
  return last;
}

/* Unit directions in which `cost` rises (sign 1) or falls (sign -1), smoothed over the neighbours. */
static void find_directions(const graph *g, const double *cost, double sign, double *direction) {
  double *smooth = (double *)demo_allocate(3 * g->count, sizeof(double));
  memset(direction, 0, 3 * g->count * sizeof(double));
  for (size_t i = 0; i < g->count; ++i) {
    for (size_t k = g->first[i]; k < g->first[i + 1]; ++k) {
      const double *a = g->centre + 3 * i, *b = g->centre + 3 * (size_t)g->link[k];
      double rise = sign * (cost[g->link[k]] - cost[i]) / (distance(a, b) * distance(a, b));
      for (size_t c = 0; c < 3; ++c) {
        direction[3 * i + c] += rise * (b[c] - a[c]);
      }
    }
    normalise(direction + 3 * i);
  }
  for (int round = 0; round < kSmoothing; ++round) {
    for (size_t i = 0; i < g->count; ++i) {
      memcpy(smooth + 3 * i, direction + 3 * i, 3 * sizeof(double));
      for (size_t k = g->first[i]; k < g->first[i + 1]; ++k) {
        for (size_t c = 0; c < 3; ++c) {
          smooth[3 * i + c] += direction[3 * (size_t)g->link[k] + c];
        }
      }
      normalise(smooth + 3 * i);
    }
    memcpy(direction, smooth, 3 * g->count * sizeof(double));
  }
  free(smooth);
}

/* The slot where the cloud starts: next to the inlet, or the roomier of the two ends farthest apart. */
static uint32_t find_start(const graph *g, const demo_mesh *mesh, double *cost) {
  uint32_t best = 0;
  if (mesh->has_inlet) {
    for (uint32_t i = 1; i < g->count; ++i) {
      if (distance(g->centre + 3 * (size_t)i, mesh->inlet) < distance(g->centre + 3 * (size_t)best, mesh->inlet)) {
        best = i;
      }
    }
    return best;
  }
  uint32_t ends[2];
  size_t room[2] = {0, 0};
  ends[0] = find_ways(g, 0, 0, cost, NULL);
  ends[1] = find_ways(g, ends[0], 0, cost, NULL);
  double length = cost[ends[1]];
  for (size_t i = 0; i < g->count; ++i) {
    room[0] += cost[i] < 0.1 * length;
    room[1] += cost[i] > 0.9 * length;
  }
  return ends[room[1] > room[0] ? 1 : 0];
}

static int by_cost(const void *a, const void *b) {
  const double *x = (const double *)a, *y = (const double *)b;
  return x[0] < y[0] ? -1 : x[0] > y[0] ? 1 : x[1] < y[1] ? -1 : x[1] > y[1];
}

/* Slots in the order of their way from the inlet: the order and the number of each are pairs of doubles. */
static void sort_slots(demo_flow *flow, graph *g) {
  double *order = (double *)demo_allocate(2 * g->count, sizeof(double));
  uint32_t *number = (uint32_t *)demo_allocate(g->count, sizeof(uint32_t));
  for (size_t i = 0; i < g->count; ++i) {
    order[2 * i] = flow->from_inlet[i];
    order[2 * i + 1] = (double)i;
  }
  qsort(order, g->count, 2 * sizeof(double), by_cost);
  for (size_t i = 0; i < g->count; ++i) {
    number[(size_t)order[2 * i + 1]] = (uint32_t)i;
  }
  dsw_volume_id *volumes = (dsw_volume_id *)demo_allocate(g->count, sizeof(dsw_volume_id));
  double *values = (double *)demo_allocate(10 * g->count, sizeof(double));
  for (size_t i = 0; i < g->count; ++i) {
    size_t to = number[i];
    volumes[to] = flow->volumes[i];
    flow->slot_of[volumes[to].index] = (uint32_t)to;
    memcpy(values + 3 * to, flow->centre + 3 * i, 3 * sizeof(double));
    memcpy(values + 3 * (g->count + to), flow->along + 3 * i, 3 * sizeof(double));
    memcpy(values + 3 * (2 * g->count + to), flow->guide + 3 * i, 3 * sizeof(double));
    values[9 * g->count + to] = flow->from_inlet[i];
  }
  memcpy(flow->volumes, volumes, g->count * sizeof(dsw_volume_id));
  memcpy(flow->centre, values, 3 * g->count * sizeof(double));
  memcpy(flow->along, values + 3 * g->count, 3 * g->count * sizeof(double));
  memcpy(flow->guide, values + 6 * g->count, 3 * g->count * sizeof(double));
  memcpy(flow->from_inlet, values + 9 * g->count, g->count * sizeof(double));
  for (size_t i = 0; i < flow->path_count; ++i) {
    flow->path[i] = number[flow->path[i]];
  }
  free(order);
  free(number);
  free(volumes);
  free(values);
}

static void find_flow(const demo_mesh *mesh, demo_flow *flow, graph *g) {
  double *cost = (double *)demo_allocate(g->count, sizeof(double)), sum = 0;
  uint32_t *towards = (uint32_t *)demo_allocate(g->count, sizeof(uint32_t));
  count_hops(g);
  uint32_t start = find_start(g, mesh, cost);
  uint32_t end = find_ways(g, start, 0, flow->from_inlet, NULL);
  flow->length = flow->from_inlet[end];
  find_directions(g, flow->from_inlet, 1, flow->along);
  find_ways(g, end, 1, cost, towards);
  find_directions(g, cost, -1, flow->guide);
  for (uint32_t at = start; at != kNoSlot; at = towards[at]) {
    flow->path[flow->path_count++] = at;
  }
  for (size_t i = 0; i < g->count; ++i) {
    for (size_t k = g->first[i]; k < g->first[i + 1]; ++k) {
      sum += distance(g->centre + 3 * i, g->centre + 3 * (size_t)g->link[k]);
    }
  }
  flow->step = g->first[g->count] > 0 ? sum / (double)g->first[g->count] : 0;
  sort_slots(flow, g);
  free(cost);
  free(towards);
}

dsw_status flow_create(const dsw_environment *environment, const demo_mesh *mesh, demo_flow *flow) {
  size_t n = mesh->cell_count, best = 0;
  dsw_status status = DSW_STATUS_OK;
  dsw_volume_id best_start = {0, 0};
  graph g;
  memset(flow, 0, sizeof *flow);
  flow->volumes = (dsw_volume_id *)demo_allocate(n, sizeof(dsw_volume_id));
  flow->slot_of = (uint32_t *)demo_allocate(n, sizeof(uint32_t));
  flow->centre = (double *)demo_allocate(3 * n, sizeof(double));
  flow->from_inlet = (double *)demo_allocate(n, sizeof(double));
  flow->along = (double *)demo_allocate(3 * n, sizeof(double));
  flow->guide = (double *)demo_allocate(3 * n, sizeof(double));
  flow->path = (uint32_t *)demo_allocate(n, sizeof(uint32_t));
  g.first = (size_t *)demo_allocate(n + 1, sizeof(size_t));
  g.hops = (uint32_t *)demo_allocate(n, sizeof(uint32_t));
  g.capacity = 6 * n;
  g.link = (uint32_t *)demo_allocate(g.capacity, sizeof(uint32_t));
  g.centre = flow->centre;
  memset(flow->slot_of, 0xff, n * sizeof(uint32_t));
  /* The largest part of the lumen; slots of smaller parts are taken back. */
  for (uint32_t i = 0; status == DSW_STATUS_OK && i < n; ++i) {
    dsw_volume_id volume;
    if ((mesh->lumen != 0 && mesh->regions[i] != mesh->lumen) || flow->slot_of[i] != kNoSlot) {
      continue;
    }
    status = dsw_environment_get_volume(environment, i, &volume);
    if (status == DSW_STATUS_OK) {
      status = flood(environment, volume, flow, &g);
    }
    if (flow->count > best) {
      best = flow->count;
      best_start = volume;
    }
  }
  memset(flow->slot_of, 0xff, n * sizeof(uint32_t));
  if (status == DSW_STATUS_OK && best > 0) {
    status = flood(environment, best_start, flow, &g);
  }
  if (status == DSW_STATUS_OK && best > 0) {
    find_flow(mesh, flow, &g);
  }
  free(g.first);
  free(g.hops);
  free(g.link);
  return status;
}

void flow_destroy(demo_flow *flow) {
  free(flow->volumes);
  free(flow->slot_of);
  free(flow->centre);
  free(flow->from_inlet);
  free(flow->along);
  free(flow->guide);
  free(flow->path);
  memset(flow, 0, sizeof *flow);
}
