#include "wire.h"

#include <math.h>
#include <string.h>

enum { kRounds = 24, kBentLinks = 7, kSpan = 4 };

/* In links: how far a vertex of the tip is beside the middle of its neighbours; the way of a vertex in a step. */
static const double kStiffness = 0.5, kTipBend = 0.11, kMostWay = 0.45;

static double dot(const double *a, const double *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static void unit_between(const double *from, const double *to, double *direction) {
  double length;
  int k;
  for (k = 0; k < 3; ++k) direction[k] = to[k] - from[k];
  length = sqrt(dot(direction, direction));
  for (k = 0; k < 3; ++k) direction[k] = length > 0 ? direction[k] / length : 0;
}

void wire_create(wire *w, const double *entry, const double *direction, double radius, double link, size_t count) {
  size_t i, k;
  memset(w, 0, sizeof *w);
  memcpy(w->entry, entry, sizeof w->entry);
  memcpy(w->direction, direction, sizeof w->direction);
  w->radius = radius;
  w->link = link;
  w->most = kMostWay * link;
  w->count = count;
  w->cosine = 1;
  for (i = 0; i < count; ++i) {
    for (k = 0; k < 3; ++k) w->at[3 * i + k] = entry[k] + link * (double)(count - 1 - i) * direction[k];
  }
}

/* Sine and cosine by the tangent of half the angle, which is about half the angle: every machine rounds that alike. */
void wire_turn(wire *w, double angle) {
  const double half = angle / 2, cosine = (1 - half * half) / (1 + half * half), sine = 2 * half / (1 + half * half);
  const double c = w->cosine * cosine - w->sine * sine, s = w->sine * cosine + w->cosine * sine,
               length = sqrt(c * c + s * s);
  w->cosine = c / length;
  w->sine = s / length;
}

double wire_stretch(const wire *w) {
  double length = 0, rest = w->link * (double)(w->count - 1);
  size_t i, k;
  for (i = 0; i + 1 < w->count; ++i) {
    double square = 0;
    for (k = 0; k < 3; ++k) {
      const double d = w->at[3 * i + k] - w->at[3 * i + 3 + k];
      square += d * d;
    }
    length += sqrt(square);
  }
  return length / rest - 1;
}

/* Where a vertex near the tip wants to be beside its neighbours: the hand's turn, carried along the wire without a twist. */
static void find_bend(const wire *w, double *bend) {
  double up[3], before[3], along[3], side[3];
  size_t i, k, least = 0;
  memcpy(before, w->direction, sizeof before);
  for (k = 1; k < 3; ++k) {
    if (fabs(before[k]) < fabs(before[least])) least = k;
  }
  for (k = 0; k < 3; ++k) up[k] = (k == least) - before[least] * before[k];
  memset(bend, 0, 3 * w->count * sizeof *bend);
  for (i = w->count - 1; i-- > 0;) {
    double length, share;
    unit_between(w->at + 3 * i + 3, w->at + 3 * i, along);
    share = dot(up, along) / (1 + dot(before, along) + 1e-9);
    for (k = 0; k < 3; ++k) up[k] -= share * (before[k] + along[k]);
    length = sqrt(dot(up, up));
    for (k = 0; k < 3; ++k) up[k] /= length > 0 ? length : 1;
    memcpy(before, along, sizeof before);
    side[0] = along[1] * up[2] - along[2] * up[1];
    side[1] = along[2] * up[0] - along[0] * up[2];
    side[2] = along[0] * up[1] - along[1] * up[0];
    if (i + 1 < w->count && i < kBentLinks) {
      for (k = 0; k < 3; ++k) bend[3 * i + 3 + k] = kTipBend * w->link * (w->cosine * up[k] + w->sine * side[k]);
    }
  }
}

/* Aims each vertex where it would be if the wire slid along itself. */
static void slide(wire *w, double push) {
  const size_t free = w->count - kHeld;
  size_t i, k;
  for (i = 0; i < free; ++i) {
    const size_t ahead = push > 0 ? (i > 0 ? i - 1 : 0) : i, behind = ahead + 1;
    double along[3];
    unit_between(w->at + 3 * behind, w->at + 3 * ahead, along);
    for (k = 0; k < 3; ++k) w->target[3 * i + k] = w->at[3 * i + k] + push * along[k];
  }
  for (i = free; i < w->count; ++i) {
    const double in = w->in + w->link * (double)(w->count - 1 - i);
    for (k = 0; k < 3; ++k) w->target[3 * i + k] = w->entry[k] + in * w->direction[k];
  }
}

/* A vertex and those `span` before and behind it. */
static void keep_bend(wire *w, size_t i, size_t span, const double *bend) {
  double *q = w->target + 3 * i, *tip = q - 3 * span, *hand = q + 3 * span;
  const int held = i + span >= w->count - kHeld;
  size_t k;
  for (k = 0; k < 3; ++k) {
    const double off = kStiffness * (0.5 * (tip[k] + hand[k]) - q[k] + (bend == NULL ? 0 : bend[3 * i + k]));
    tip[k] -= 0.25 * off;
    q[k] += 0.5 * off;
    if (!held) hand[k] -= 0.25 * off;
  }
}

static void keep_length(wire *w, size_t i) {
  double *q = w->target + 3 * i, way[3], length, change;
  const double part = i + 1 >= w->count - kHeld ? 1 : 0.5;
  size_t k;
  for (k = 0; k < 3; ++k) way[k] = q[3 + k] - q[k];
  length = sqrt(dot(way, way));
  change = length > 0 ? (length - w->link) / length : 0;
  for (k = 0; k < 3; ++k) {
    q[k] += part * change * way[k];
    if (part < 1) q[3 + k] -= part * change * way[k];
  }
}

/* An impulse along the normal of a row keeps its gap from closing; walls do not pull. */
static void keep_gap(wire *w, const wire_rows *rows, size_t row) {
  const size_t held = 3 * (w->count - kHeld);
  double after = rows->rows[row].gap, size = 0, change;
  size_t k;
  for (k = rows->offsets[row]; k < rows->offsets[row + 1]; ++k) {
    const size_t column = rows->columns[k];
    after += rows->values[k] * (w->target[column] - w->at[column]);
    size += column < held ? rows->values[k] * rows->values[k] : 0;
  }
  if (size == 0) return;
  change = -after / size;
  if (w->impulse[row] + change < 0) change = -w->impulse[row];
  w->impulse[row] += change;
  for (k = rows->offsets[row]; k < rows->offsets[row + 1]; ++k) {
    const size_t column = rows->columns[k];
    if (column < held) w->target[column] += change * rows->values[k];
  }
}

/* No vertex goes farther than what the rows know of. */
static void keep_near(wire *w, size_t i) {
  double way[3], length;
  size_t k;
  for (k = 0; k < 3; ++k) way[k] = w->target[3 * i + k] - w->at[3 * i + k];
  length = sqrt(dot(way, way));
  if (length <= w->most) return;
  for (k = 0; k < 3; ++k) w->target[3 * i + k] = w->at[3 * i + k] + w->most / length * way[k];
}

void wire_find_targets(wire *w, double push, const wire_rows *rows) {
  double bend[3 * kMostVertices];
  size_t i;
  int round;
  find_bend(w, bend);
  slide(w, push);
  memset(w->impulse, 0, rows->count * sizeof *w->impulse);
  for (round = 0; round < kRounds; ++round) {
    for (i = w->count - kHeld; i-- > kBentLinks + kSpan;) {
      if (i + kSpan < w->count) keep_bend(w, i, kSpan, NULL);
    }
    for (i = w->count - kHeld; i-- > 1;) keep_bend(w, i, 1, bend);
    for (i = w->count - kHeld; i-- > 0;) keep_length(w, i);
    for (i = 0; i < rows->count; ++i) keep_gap(w, rows, i);
  }
  for (i = 0; i + kHeld < w->count; ++i) keep_near(w, i);
}
