/* A triangle falls on another one. Their 6 pairs of a vertex and a triangle and their 9 pairs of edges are swept in one
 * call, without an environment. Ranks tell which pairs touch first, and which touch at the same time exactly.
 *
 *      p0----------p1        p0 falls on the lying triangle when the edge p0 p1
 *   .--|------.    |         falls on its long side
 *    \ v       \   v                                                            */
#include <dartsweep/dartsweep.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { kPairs = 15 };

typedef const double (*points)[3];

static const double lying[3][3] = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}};
static const double start[3][3] = {{0.5, 0.5, 1}, {3, 0.5, 1}, {0.5, 3, 2}}; /* p0, p1, p2 */
static const double end[3][3] = {{0.5, 0.5, -2}, {3, 0.5, -2}, {0.5, 3, 2}};

static void check(int good, const char *what) {
  if (!good) {
    fprintf(stderr, "%s: %s\n", what, dsw_last_error_message());
    exit(1);
  }
}

static void copy(double *to, size_t point, const double *from) { memcpy(to + 3 * point, from, 3 * sizeof *to); }

/* The points of all pairs: a vertex and a triangle, twice 3; an edge and an edge, 9. */
static void list_pairs(points one, points other, uint8_t *kinds, double *list) {
  size_t n = 0, i, k;
  for (i = 0; i < 6; ++i, ++n) {
    points vertices = i < 3 ? one : other, corners = i < 3 ? other : one;
    kinds[n] = DSW_PAIR_VERTEX_FACE;
    copy(list, 4 * n, vertices[i % 3]);
    for (k = 0; k < 3; ++k) copy(list, 4 * n + 1 + k, corners[k]);
  }
  for (i = 0; i < 9; ++i, ++n) {
    kinds[n] = DSW_PAIR_EDGE_EDGE;
    copy(list, 4 * n, one[i / 3]);
    copy(list, 4 * n + 1, one[(i / 3 + 1) % 3]);
    copy(list, 4 * n + 2, other[i % 3]);
    copy(list, 4 * n + 3, other[(i + 1) % 3]);
  }
}

int main(void) {
  uint8_t kinds[kPairs];
  double from[3 * 4 * kPairs], to[3 * 4 * kPairs];
  dsw_pair_touch touches[kPairs];
  size_t first = 0, i;
  list_pairs(start, lying, kinds, from);
  list_pairs(end, lying, kinds, to);
  check(dsw_sweep_pairs(NULL, 3, kPairs, kinds, from, to, 0, DSW_PAIRS_RANK, touches) == DSW_STATUS_OK, "sweeping");
  for (i = 0; i < kPairs; ++i) {
    if (touches[i].touches == 0 || touches[i].rank != 0) continue;
    printf("%s %u touches at %.17g\n",
           kinds[i] == DSW_PAIR_EDGE_EDGE ? "a pair of edges:" : "a vertex and a triangle:", (unsigned)i,
           touches[i].time);
    check(touches[i].time == 1.0 / 3, "a third of the way is gone");
    ++first;
  }
  check(first == 2 && touches[0].rank == 0, "p0 meets the triangle when p0 p1 meets its long side");
  return 0;
}
