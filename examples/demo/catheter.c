/* The catheter advances along itself, keeps the lengths of its links and resists bending; all of that makes targets
 * only. Where it really goes is the library's answer. New links are added at the inlet. */
#include "catheter.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "output.h"
#include "run.h"

enum { kRelaxations = 30, kKeptSteps = 8 };

static const double kReach = 0.85, kStiffness = 0.15, kSteering = 0.6, kNoise = 0.03, kMinPart = 0.1;

static void unit_towards(const double *a, const double *b, double *direction) {
  double length = distance(a, b);
  for (int k = 0; k < 3; ++k) {
    direction[k] = length > 0 ? (b[k] - a[k]) / length : 0;
  }
}

void catheter_read_places(demo_catheter *c) {
  double positions[3 * kMostLinks];
  size_t slots = 0;
  require(dsw_body_get_positions(c->scene, c->body, positions, kMostLinks, 0, NULL, &slots), "reading the catheter",
          kFailed);
  for (size_t i = 0; i < c->count; ++i) {
    memcpy(c->at + 3 * i, positions + 3 * (size_t)c->vertex[i].index, 3 * sizeof(double));
  }
}

/* The first link: from the middle of the inlet as far along the way as is free. */
static void create_body(demo_catheter *c, const demo_flow *flow) {
  static const uint32_t edge[2] = {0, 1};
  dsw_body_desc desc;
  double points[6];
  dsw_status status = DSW_STATUS_OCCUPIED;
  size_t far = 1;
  memcpy(c->entry, flow->centre + 3 * (size_t)flow->path[0], sizeof c->entry);
  memcpy(points, c->entry, sizeof c->entry);
  while (far + 1 < flow->path_count && distance(c->entry, flow->centre + 3 * (size_t)flow->path[far]) < c->link) {
    ++far;
  }
  dsw_body_desc_init(&desc, sizeof desc);
  desc.positions = points;
  desc.vertex_count = 2;
  desc.edges = edge;
  desc.edge_count = 1;
  for (; status == DSW_STATUS_OCCUPIED && far > 0; --far) {
    memcpy(points + 3, flow->centre + 3 * (size_t)flow->path[far], 3 * sizeof(double));
    status = dsw_body_create(c->scene, &desc, &c->body);
  }
  require(status, "creating the catheter", kFailed);
  require(dsw_body_get_vertex_ids(c->scene, c->body, c->vertex, kMostLinks, &c->count), "reading the catheter",
          kFailed);
  c->rest[0] = distance(points, points + 3);
}

static void make_room(demo_catheter *c, size_t at) {
  size_t tail = c->count++ - at;
  memmove(c->vertex + at + 1, c->vertex + at, tail * sizeof c->vertex[0]);
  memmove(c->inserted + at + 1, c->inserted + at, tail * sizeof c->inserted[0]);
  memmove(c->rest + at + 1, c->rest + at, tail * sizeof c->rest[0]);
}

static size_t place_of(const demo_catheter *c, uint32_t vertex) {
  size_t i = 0;
  while (i < c->count && c->vertex[i].index != vertex) {
    ++i;
  }
  return i;
}

/* Follows the vertices that responses inserted and removed. */
static void follow_edits(demo_catheter *c) {
  const dsw_body_edit *edits = NULL;
  size_t count = 0;
  require(dsw_body_get_edits(c->scene, c->body, &edits, &count), "reading edits", kFailed);
  for (size_t n = 0; n < count; ++n) {
    const dsw_body_edit *e = edits + n;
    if (e->inserted) {
      size_t a = place_of(c, e->ends[0].index), b = place_of(c, e->ends[1].index), first = a < b ? a : b;
      double share = a < b ? e->edge_parameter : 1 - e->edge_parameter, rest = c->rest[first];
      if (c->count == kMostLinks) {
        fprintf(stderr, "demo: the catheter has more than %d vertices\n", (int)kMostLinks);
        exit(kFailed);
      }
      make_room(c, first + 1);
      c->vertex[first + 1] = e->vertex;
      c->inserted[first + 1] = 1;
      c->rest[first] = share * rest;
      c->rest[first + 1] = (1 - share) * rest;
    } else {
      size_t gone = place_of(c, e->vertex.index), after = c->count - gone - 1;
      c->rest[gone - 1] += c->rest[gone];
      memmove(c->vertex + gone, c->vertex + gone + 1, after * sizeof c->vertex[0]);
      memmove(c->inserted + gone, c->inserted + gone + 1, after * sizeof c->inserted[0]);
      memmove(c->rest + gone, c->rest + gone + 1, after * sizeof c->rest[0]);
      --c->count;
    }
  }
}

/* One link more when the tail has gone so far in. */
static void feed(demo_catheter *c) {
  const dsw_volume_id none = {0, 0};
  dsw_body_vertex_id added;
  dsw_body_edge_id edge;
  if (distance(c->entry, c->at) < c->link || c->count + 1 >= kMostLinks) {
    return;
  }
  require(dsw_body_add_vertex(c->scene, c->body, c->entry, none, &added), "feeding the catheter", kFailed);
  dsw_status status = dsw_body_add_edge(c->scene, c->body, added, c->vertex[0], &edge);
  if (status == DSW_STATUS_OCCUPIED) { /* the tail is round a corner: later */
    require(dsw_body_remove_vertex(c->scene, c->body, added), "feeding the catheter", kFailed);
    return;
  }
  require(status, "feeding the catheter", kFailed);
  make_room(c, 0);
  c->vertex[0] = added;
  c->inserted[0] = 0;
  c->rest[0] = distance(c->entry, c->at);
  catheter_read_places(c);
}

/* Moves two points along their line so that their distance comes nearer to `length`; the tail (0) is in a hand. */
static void keep_distance(double *q, size_t a, size_t b, double length, double stiffness) {
  double now = distance(q + 3 * a, q + 3 * b), part = a == 0 ? 1 : 0.5;
  double change = now > 0 ? stiffness * (now - length) / now : 0;
  for (size_t k = 0; k < 3; ++k) {
    double d = change * (q[3 * b + k] - q[3 * a + k]);
    q[3 * b + k] -= part * d;
    q[3 * a + k] += (1 - part) * d;
  }
}

/* Where every vertex should be: along the catheter, the tip steered by the guide; then lengths and stiffness. */
static void find_targets(const demo_catheter *c, const double *guide, double reach, double *q) {
  size_t n = c->count;
  for (size_t i = 0; i < n; ++i) {
    double direction[3];
    size_t a = i + 1 < n ? i : i - 1;
    unit_towards(c->at + 3 * a, c->at + 3 * (a + 1), direction);
    for (size_t k = 0; k < 3; ++k) {
      double steered = i + 1 < n ? direction[k] : (1 - kSteering) * direction[k] + kSteering * guide[k];
      q[3 * i + k] = c->at[3 * i + k] + reach * steered;
    }
  }
  for (int round = 0; round < kRelaxations; ++round) {
    for (size_t i = 0; i + 2 < n; ++i) {
      double straight = c->rest[i] + c->rest[i + 1];
      if (distance(q + 3 * i, q + 3 * (i + 2)) < straight) {
        keep_distance(q, i, i + 2, straight, kStiffness);
      }
    }
    for (size_t i = 0; i + 1 < n; ++i) {
      keep_distance(q, i, i + 1, c->rest[i], 1);
    }
  }
}

/* Slot of the volume that the tip is in. */
static uint32_t slot_of_tip(const demo_catheter *c, const demo_flow *flow) {
  double positions[3 * kMostLinks];
  dsw_volume_id volumes[kMostLinks];
  size_t slots = 0;
  require(dsw_body_get_positions(c->scene, c->body, positions, kMostLinks, 0, volumes, &slots), "reading the catheter",
          kFailed);
  return flow->slot_of[volumes[c->vertex[c->count - 1].index].index];
}

void catheter_create(demo_catheter *c, dsw_scene *scene, const demo_flow *flow, const char *name,
                     dsw_response edge_response) {
  memset(c, 0, sizeof *c);
  figures_create(&c->figures, name);
  c->scene = scene;
  c->link = 3.0 * flow->radius > flow->length / 60 ? 3.0 * flow->radius : flow->length / 60;
  c->whole = flow->length;
  create_body(c, flow);
  catheter_read_places(c);
  dsw_move_options_init(&c->options, sizeof c->options);
  c->options.vertex_response = DSW_RESPONSE_SLIDE;
  c->options.edge_response = edge_response;
  c->options.min_part = kMinPart;
  c->options.noise_share = edge_response == DSW_RESPONSE_STOP ? 0 : kNoise;
}

void catheter_step(demo_catheter *c, const demo_flow *flow, double reach, int keep, FILE *csv) {
  double targets[3 * kMostLinks], q[3 * kMostLinks];
  dsw_body_counts counts;
  dsw_move_report report;
  counts.struct_size = sizeof counts;
  if (c->count > kMostLinks / 2) { /* so many obstacles that it had better stop */
    c->options.edge_response = DSW_RESPONSE_STOP;
  }
  find_targets(c, flow->guide + 3 * (size_t)slot_of_tip(c, flow), reach, q);
  memset(targets, 0, sizeof targets);
  for (size_t i = 0; i < c->count; ++i) {
    memcpy(targets + 3 * (size_t)c->vertex[i].index, q + 3 * i, 3 * sizeof(double));
  }
  require(dsw_body_get_counts(c->scene, c->body, &counts), "reading the catheter", kFailed);
  double start = seconds_now();
  require(dsw_body_move(c->scene, c->body, targets, counts.vertex_slots, 0, &c->options, &report),
          "moving the catheter", kFailed);
  figures_add(&c->figures, c->scene, c->body, &report, seconds_now() - start, keep, csv);
  follow_edits(c);
  prove_edges(&c->figures, c->scene, c->body);
  catheter_read_places(c);
  c->reached = flow->from_inlet[slot_of_tip(c, flow)];
  feed(c);
}

void catheter_run(demo_catheter *c, dsw_environment *environment, const demo_flow *flow, const char *name,
                  dsw_response edge_response, size_t steps, FILE *csv) {
  dsw_scene *scene = NULL;
  require(dsw_scene_create(environment, NULL, &scene), "creating a scene", kFailed);
  catheter_create(c, scene, flow, name, edge_response);
  for (size_t step = 0; step < steps; ++step) {
    catheter_step(c, flow, kReach * flow->length / (double)steps, step + kKeptSteps >= steps, csv);
  }
}

int catheter_write(const demo_catheter *c, const char *out) {
  uint32_t links[2 * kMostLinks];
  char name[64];
  vtu_field inserted = field("inserted", c->inserted, 1);
  for (uint32_t i = 0; i < 2 * kMostLinks; ++i) {
    links[i] = (i + 1) / 2;
  }
  sprintf(name, "catheter_%s.vtu", c->figures.name);
  int code = vtu_write(out, name, c->at, c->count, links, 2, c->count - 1, &inserted, 1);
  sprintf(name, "catheter_%s_contacts.vtu", c->figures.name);
  return code | write_touches(out, name, c->figures.touch, c->figures.normal, c->figures.touch_count);
}

void catheter_destroy(demo_catheter *c) {
  require(dsw_scene_destroy(c->scene), "destroying a scene", kFailed);
  figures_destroy(&c->figures);
}
