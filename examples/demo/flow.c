/* Shortest ways over the volumes of the lumen. Two volumes are neighbours when they share a face that is passable. */
#include "flow.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "ways.h"

enum { kMostVertices = 256, kSamples = 200 };

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
    status = dsw_environment_get_vertex_position(environment, vertices[i], p);
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
  dsw_status status = dsw_environment_get_face_id(environment, volume, local, &face);
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
static dsw_status flood(const dsw_environment *environment, dsw_volume_id start, demo_flow *flow, demo_graph *g) {
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

static int by_cost(const void *a, const void *b) {
  const double *x = (const double *)a, *y = (const double *)b;
  return x[0] < y[0] ? -1 : x[0] > y[0] ? 1 : x[1] < y[1] ? -1 : x[1] > y[1];
}

/* Slots in the order of their way from the inlet: the order and the number of each are pairs of doubles. */
static void sort_slots(demo_flow *flow, demo_graph *g) {
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

/* How far the wall is from the middle of a volume. */
static double find_room(const dsw_environment *environment, const demo_flow *flow, size_t slot, dsw_status *status) {
  dsw_nearest nearest;
  nearest.distance = 0;
  if (*status == DSW_STATUS_OK) {
    *status =
        dsw_environment_find_nearest(environment, flow->centre + 3 * slot, flow->volumes[slot], HUGE_VAL, &nearest);
  }
  return nearest.distance;
}

/* The slot where the cloud starts: next to the inlet, or the widest end of all branches. */
static uint32_t find_start(const dsw_environment *environment, const demo_mesh *mesh, const demo_flow *flow,
                           const demo_graph *g, dsw_status *status) {
  uint32_t best = 0, start;
  if (mesh->has_inlet) {
    for (uint32_t i = 1; i < g->count; ++i) {
      if (distance(g->centre + 3 * (size_t)i, mesh->inlet) < distance(g->centre + 3 * (size_t)best, mesh->inlet)) {
        best = i;
      }
    }
    return best;
  }
  double *from = (double *)demo_allocate(g->count, sizeof(double)), most = -1;
  char *is_end = (char *)demo_allocate(2 * g->count, 1), *seen = is_end + g->count;
  uint32_t *slots = (uint32_t *)demo_allocate(g->count, sizeof(uint32_t));
  /* From one end all the others are found; that one is found from the farthest of them. */
  start = find_ways(g, find_ways(g, 0, 0, from, NULL), 0, from, NULL);
  double length = from[start];
  for (int turn = 0; turn < 2; ++turn) {
    memset(seen, 0, g->count);
    find_ends(g, from, length, is_end);
    for (uint32_t i = 0; i < g->count; ++i) {
      size_t count = is_end[i] ? find_end_slots(g, from, length, i, seen, slots) : 0;
      for (size_t k = 0; k < count; k += 1 + count / kSamples) {
        double room = find_room(environment, flow, slots[k], status);
        if (room > most) {
          most = room;
          best = i;
        }
      }
    }
    find_ways(g, start, 0, from, NULL);
  }
  free(from);
  free(is_end);
  free(slots);
  return best;
}

/* Round the inlet ways lead to all sides; there the direction is the mean one of the lumen behind it. */
static void straighten_inlet(const demo_graph *g, demo_flow *flow, double zone) {
  double mean[3] = {0, 0, 0};
  for (size_t i = 0; i < g->count; ++i) {
    for (size_t k = 0; k < 3 && flow->from_inlet[i] > zone && flow->from_inlet[i] < 1.5 * zone; ++k) {
      mean[k] += flow->along[3 * i + k];
    }
  }
  double size = sqrt(mean[0] * mean[0] + mean[1] * mean[1] + mean[2] * mean[2]);
  for (size_t i = 0; i < g->count; ++i) {
    for (size_t k = 0; k < 3 && size > 0 && flow->from_inlet[i] <= zone; ++k) {
      flow->along[3 * i + k] = mean[k] / size;
    }
  }
}

/* The end of a branch that `rank` others are farther from the inlet than; the farthest if there are not so many. */
static uint32_t choose_end(const demo_graph *g, demo_flow *flow, uint32_t farthest, size_t rank) {
  char *is_end = (char *)demo_allocate(g->count, 1);
  double *order = (double *)demo_allocate(2 * g->count, sizeof(double));
  find_ends(g, flow->from_inlet, flow->length, is_end);
  flow->end_count = 0;
  for (size_t i = 0; i < g->count; ++i) {
    if (is_end[i]) {
      order[2 * flow->end_count] = -flow->from_inlet[i];
      order[2 * flow->end_count++ + 1] = (double)i;
    }
  }
  qsort(order, flow->end_count, 2 * sizeof(double), by_cost);
  uint32_t end = rank > 0 && rank < flow->end_count ? (uint32_t)order[2 * rank + 1] : farthest;
  free(is_end);
  free(order);
  return end;
}

static dsw_status find_flow(const dsw_environment *environment, const demo_mesh *mesh, size_t route, demo_flow *flow,
                            demo_graph *g) {
  dsw_status status = DSW_STATUS_OK;
  size_t samples = 0;
  double *cost = (double *)demo_allocate(g->count, sizeof(double));
  uint32_t *towards = (uint32_t *)demo_allocate(g->count, sizeof(uint32_t));
  count_hops(g);
  uint32_t start = find_start(environment, mesh, flow, g, &status);
  for (size_t i = 0; i < g->count; i += 1 + g->count / kSamples, ++samples) {
    flow->radius += find_room(environment, flow, i, &status);
  }
  flow->radius *= 3 / (double)samples; /* as in a tube, where the mean distance to the wall is a third of it */
  uint32_t end = find_ways(g, start, 0, flow->from_inlet, NULL);
  flow->length = flow->from_inlet[end];
  double zone = 4 * flow->radius < 0.06 * flow->length ? 4 * flow->radius : 0.06 * flow->length;
  find_potential(g, flow->from_inlet, flow->length, zone, cost);
  find_directions(g, cost, 1, 12, flow->along);
  straighten_inlet(g, flow, zone);
  find_ways(g, choose_end(g, flow, end, route), 1, cost, towards);
  find_directions(g, cost, -1, 2, flow->guide);
  for (uint32_t at = start; at != kNoSlot; at = towards[at]) {
    flow->path[flow->path_count++] = at;
  }
  sort_slots(flow, g);
  free(cost);
  free(towards);
  return status;
}

dsw_status flow_create(const dsw_environment *environment, const demo_mesh *mesh, size_t route, demo_flow *flow) {
  size_t n = mesh->cell_count, best = 0;
  dsw_status status = DSW_STATUS_OK;
  dsw_volume_id best_start = {0, 0};
  demo_graph g;
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
    status = dsw_environment_get_volume_id(environment, i, &volume);
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
    status = find_flow(environment, mesh, route, flow, &g);
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
