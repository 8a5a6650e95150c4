#include "ways.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { kRelaxations = 250 };

/* Parts of the whole length: how much of it belongs to an end; how long a branch is at least. */
static const double kEndPart = 0.03, kBranchPart = 0.1;

double distance(const double *a, const double *b) {
  double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
  return sqrt(x * x + y * y + z * z);
}

static void normalise(double *v) {
  double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  for (int k = 0; k < 3; ++k) {
    v[k] = length > 0 ? v[k] / length : 0;
  }
}

void count_hops(demo_graph *g) {
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

uint32_t find_ways(const demo_graph *g, uint32_t start, int off_wall, double *cost, uint32_t *comes_from) {
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

static int falls(const void *a, const void *b) {
  const double *x = (const double *)a, *y = (const double *)b;
  return x[0] > y[0] ? -1 : x[0] < y[0] ? 1 : x[1] < y[1] ? -1 : x[1] > y[1];
}

static uint32_t root_of(uint32_t *parent, uint32_t i) {
  while (parent[i] != i) {
    i = parent[i] = parent[parent[i]];
  }
  return i;
}

void find_ends(const demo_graph *g, const double *from, double length, char *is_end) {
  double *order = (double *)demo_allocate(2 * g->count, sizeof(double));
  uint32_t *parent = (uint32_t *)demo_allocate(g->count, sizeof(uint32_t));
  for (size_t i = 0; i < g->count; ++i) {
    order[2 * i] = from[i];
    order[2 * i + 1] = (double)i;
    parent[i] = kNoSlot;
    is_end[i] = 0;
  }
  qsort(order, g->count, 2 * sizeof(double), falls);
  is_end[(size_t)order[1]] = 1;
  for (size_t n = 0; n < g->count; ++n) {
    uint32_t i = (uint32_t)order[2 * n + 1];
    parent[i] = i; /* a root is the farthest slot of its part */
    for (size_t k = g->first[i]; k < g->first[i + 1]; ++k) {
      if (parent[g->link[k]] == kNoSlot) {
        continue;
      }
      uint32_t a = root_of(parent, i), b = root_of(parent, g->link[k]);
      uint32_t low = from[a] < from[b] ? a : b, high = low == a ? b : a;
      if (a != b && from[low] - from[i] > kBranchPart * length) {
        is_end[low] = 1;
      }
      parent[low] = high;
    }
  }
  free(parent);
  free(order);
}

size_t find_end_slots(const demo_graph *g, const double *from, double length, uint32_t end, char *seen,
                      uint32_t *slots) {
  size_t count = 0;
  slots[count++] = end;
  seen[end] = 1;
  for (size_t head = 0; head < count; ++head) {
    for (size_t k = g->first[slots[head]]; k < g->first[slots[head] + 1]; ++k) {
      uint32_t j = g->link[k];
      if (!seen[j] && from[j] > from[end] - kEndPart * length) {
        seen[j] = 1;
        slots[count++] = j;
      }
    }
  }
  return count;
}

void find_potential(const demo_graph *g, const double *from_inlet, double length, double zone, double *potential) {
  char *fixed = (char *)demo_allocate(2 * g->count, 1), *is_end = fixed + g->count;
  uint32_t *slots = (uint32_t *)demo_allocate(g->count, sizeof(uint32_t));
  find_ends(g, from_inlet, length, is_end);
  /* At the inlet the potential just rises with the way; its value does not matter where only directions are used. */
  for (size_t i = 0; i < g->count; ++i) {
    potential[i] = (from_inlet[i] - zone) / length;
    fixed[i] = potential[i] < 0;
  }
  for (uint32_t i = 0; i < g->count; ++i) {
    size_t count = is_end[i] && !fixed[i] ? find_end_slots(g, from_inlet, length, i, fixed, slots) : 0;
    for (size_t k = 0; k < count; ++k) {
      potential[slots[k]] = (from_inlet[i] - zone) / length;
    }
  }
  for (int round = 0; round < kRelaxations; ++round) {
    for (size_t n = 0; n < g->count; ++n) {
      size_t i = round % 2 ? g->count - 1 - n : n;
      double sum = 0, weights = 0;
      for (size_t k = g->first[i]; !fixed[i] && k < g->first[i + 1]; ++k) {
        double weight = 1 / distance(g->centre + 3 * i, g->centre + 3 * (size_t)g->link[k]);
        sum += weight * potential[g->link[k]];
        weights += weight;
      }
      if (weights > 0) {
        potential[i] += 1.9 * (sum / weights - potential[i]);
      }
    }
  }
  free(fixed);
  free(slots);
}

void find_directions(const demo_graph *g, const double *values, double sign, int rounds, double *direction) {
  double *smooth = (double *)demo_allocate(3 * g->count, sizeof(double));
  memset(direction, 0, 3 * g->count * sizeof(double));
  for (size_t i = 0; i < g->count; ++i) {
    for (size_t k = g->first[i]; k < g->first[i + 1]; ++k) {
      const double *a = g->centre + 3 * i, *b = g->centre + 3 * (size_t)g->link[k];
      double rise = sign * (values[g->link[k]] - values[i]) / (distance(a, b) * distance(a, b));
      for (size_t c = 0; c < 3; ++c) {
        direction[3 * i + c] += rise * (b[c] - a[c]);
      }
    }
    normalise(direction + 3 * i);
  }
  for (int round = 0; round < rounds; ++round) {
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
