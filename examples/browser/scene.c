#include "scene.h"

#include <dartsweep/dartsweep.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../demo/mesh.h"
#include "wire.h"

enum {
  kMostContacts = 512,
  kBeatSteps = 70,
  kRampSteps = 30,
  kOpenSteps = 40,
  kHalvings = 2,
  kLattice = 22,
  kVesselVertices = 76
};

static const double kSpacing = 1.75, kWireRadius = 0.4, kLink = 1.2, kDepth = 0.42, kSnap = 0.25;

struct scene {
  dsw_context *context;
  dsw_environment *environment;
  dsw_scene *scene;
  dsw_body_id body;
  dsw_trace *trace;
  wire wire;
  scene_size size;
  /* Of the environment's vertices: places at rest; ways of the beat, and of a cut that opens, for each of its steps; positions, of
   * which the environment reads `now`. */
  double *rest, *ways, *opening, *lent[2];
  size_t point_count, point_room, most_vertices, slots; /* slots: of the body's vertices */
  int now, with_boundary, is_vessel, traced, opening_steps;
  double strength, phase,
      shift; /* of the beat: how much of it there is, how far it is, and how much of the ways was made */
  uint32_t wall_version;
  scene_contact contacts[kMostContacts];
  size_t contact_count;
  dsw_near_options near_options;
  dsw_move_options move_options;
};

static char message[512];

const char *scene_message(void) { return message; }

static int fail(const char *text) {
  sprintf(message, "%.500s", text);
  return 0;
}

/* Whether a call succeeded; if not, the message says which and why. */
static int good(dsw_status status, const char *what) {
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

/* ---- Where the wire comes in ---- */

static int is_better_entry(const scene *s, const double *centre, const dsw_nearest *nearest, int axis, double most,
                           double best) {
  return nearest->cell.kind != DSW_CELL_NONE && centre[axis] <= s->size.lower[axis] + most && nearest->distance > best;
}

/* The widest place at one end of the longest axis. */
static int find_entry(scene *s, double *clearance) {
  const double *lower = s->size.lower, *upper = s->size.upper;
  uint32_t count = 0, i;
  int axis = 0, k;
  dsw_environment_info info;
  info.struct_size = sizeof info;
  if (!good(dsw_environment_get_info(s->environment, &info), "reading")) return 0;
  count = info.volume_index_count;
  for (k = 1; k < 3; ++k) {
    if (upper[k] - lower[k] > upper[axis] - lower[axis]) axis = k;
  }
  *clearance = 0;
  for (i = 0; i < count; ++i) {
    dsw_volume_id volume;
    dsw_nearest nearest;
    double centre[3];
    if (dsw_environment_get_volume_id(s->environment, i, &volume) != DSW_STATUS_OK ||
        dsw_environment_get_centre(s->environment, volume, centre) != DSW_STATUS_OK ||
        centre[axis] > lower[axis] + 0.06 * (upper[axis] - lower[axis]) ||
        dsw_environment_find_nearest(s->environment, centre, volume, HUGE_VAL, &nearest) != DSW_STATUS_OK) {
      continue;
    }
    if (is_better_entry(s, centre, &nearest, axis, 0.06 * (upper[axis] - lower[axis]), *clearance)) {
      *clearance = nearest.distance;
      memcpy(s->size.entry, centre, sizeof centre);
    }
  }
  return *clearance > 0 ? 1 : fail("there is no room for a wire at the narrow end of the longest side");
}

/* Of the 26 directions of a lattice, the one in which it is widest at some distance. */
static int find_direction(scene *s, double far) {
  const dsw_volume_id none = {0, 0};
  double best = 0;
  int i, k;
  for (i = 0; i < 27; ++i) {
    const int step[3] = {i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1};
    const double length = sqrt((double)(step[0] * step[0] + step[1] * step[1] + step[2] * step[2]));
    double at[3];
    dsw_nearest nearest;
    dsw_flight flight;
    if (length == 0) continue;
    for (k = 0; k < 3; ++k) at[k] = s->size.entry[k] + far * step[k] / length;
    if (dsw_environment_cast(s->environment, none, s->size.entry, at, NULL, &flight) != DSW_STATUS_OK ||
        flight.outcome != DSW_OUTCOME_REACHED ||
        dsw_environment_find_nearest(s->environment, at, flight.volume, HUGE_VAL, &nearest) != DSW_STATUS_OK) {
      continue;
    }
    if (nearest.distance > best) {
      best = nearest.distance;
      for (k = 0; k < 3; ++k) s->size.direction[k] = step[k] / length;
    }
  }
  return best > 0 ? 1 : fail("there is no way for a wire from the place where it comes in");
}

static int create_wire(scene *s) {
  uint32_t edges[4] = {0, 1, 1, 2};
  dsw_body_desc desc;
  wire_create(&s->wire, s->size.entry, s->size.direction, s->size.wire_radius, s->size.link, 3);
  dsw_body_desc_init(&desc, sizeof desc);
  desc.level = DSW_LEVEL_EDGES_SWEPT;
  desc.positions = s->wire.at;
  desc.vertex_count = 3;
  desc.edges = edges;
  desc.edge_count = 2;
  desc.radius = s->size.wire_radius;
  s->near_options.margin = s->wire.most;
  s->slots = s->wire.count;
  return good(dsw_body_create(s->scene, &desc, &s->body), "putting the wire in");
}

/* ---- Points that move ---- */

/* The environment reads the host's points from now on, with room for those of cuts. */
static int lend_points(scene *s) {
  const double *points = NULL;
  dsw_deform_options options;
  size_t i;
  if (!good(dsw_environment_get_points(s->environment, &points, &s->point_count), "reading points")) return 0;
  s->point_room = 2 * s->point_count + 4096;
  s->rest = (double *)calloc(15 * s->point_room, sizeof(double));
  if (s->rest == NULL) return fail("out of memory");
  s->ways = s->rest + 3 * s->point_room;
  s->opening = s->ways + 3 * s->point_room;
  s->lent[0] = s->opening + 3 * s->point_room;
  s->lent[1] = s->lent[0] + 3 * s->point_room;
  memcpy(s->rest, points, 3 * s->point_count * sizeof(double));
  memcpy(s->lent[0], points, 3 * s->point_count * sizeof(double));
  if (s->is_vessel) {
    mesh_find_ways_inward(s->rest, s->point_count, s->ways);
  } else { /* all of a slice goes to one side */
    for (i = 0; i < s->point_count; ++i) s->ways[3 * i + 2] = 6 * s->size.wire_radius;
  }
  dsw_deform_options_init(&options, sizeof options);
  options.point_room = s->point_room;
  return good(dsw_environment_deform(s->environment, s->lent[0], s->point_count, &options, NULL), "lending points");
}

/* How much of its way a point makes: a wave runs along the longest side, and its ends rest. */
static double share_of_way(const scene *s, const double *rest) {
  const double length = s->size.upper[0] - s->size.lower[0], x = rest[0] - s->size.lower[0], end = 0.12 * length;
  const double left = x < length - x ? x : length - x, fade = left < end ? (left > 0 ? left / end : 0) : 1;
  double u = 2 * x / length - s->phase;
  u -= floor(u);
  return s->strength * fade * kDepth * 16 * u * u * (1 - u) * (1 - u);
}

/* The environment a step later. */
static int bend(scene *s, int on) {
  const int next = 1 - s->now, opens = s->opening_steps > 0;
  dsw_deform_options options;
  dsw_deform_report report;
  size_t i, k;
  s->strength += on ? 1.0 / kRampSteps : -1.0 / kRampSteps;
  s->strength = s->strength > 1 ? 1 : (s->strength < 0 ? 0 : s->strength);
  s->phase += 1.0 / kBeatSteps;
  for (i = 0; i < s->point_count; ++i) {
    const double share = share_of_way(s, s->rest + 3 * i);
    for (k = 0; k < 3; ++k) {
      s->rest[3 * i + k] += opens ? s->opening[3 * i + k] : 0;
      s->lent[next][3 * i + k] = s->rest[3 * i + k] + share * s->ways[3 * i + k];
    }
  }
  s->opening_steps -= opens;
  dsw_deform_options_init(&options, sizeof options);
  options.point_room = s->point_room;
  options.most_halvings = kHalvings;
  if (!good(dsw_environment_deform(s->environment, s->lent[next], s->point_count, &options, &report), "beating"))
    return 0;
  if (report.outcome != DSW_DEFORM_REFUSED) s->now = next;
  s->traced = 0;
  ++s->wall_version;
  return 1;
}

/* New vertices of a cut rest, and beat, as those that they come from. */
static void follow_change(scene *s, const dsw_change *change) {
  size_t i, k;
  for (i = 0; i < change->vertex_count; ++i) {
    const dsw_vertex_origin *origin = change->vertices + i;
    const size_t to = 3 * (size_t)origin->vertex.index;
    double share;
    for (k = 0; k < 3; ++k) {
      s->ways[to + k] = origin->weights[0] * s->ways[3 * (size_t)origin->from[0].index + k] +
                        origin->weights[1] * s->ways[3 * (size_t)origin->from[1].index + k];
      s->rest[to + k] = s->lent[s->now][to + k];
    }
    share = share_of_way(s, s->rest + to);
    for (k = 0; k < 3; ++k) s->rest[to + k] -= share * s->ways[to + k];
    if (origin->vertex.index >= s->point_count) s->point_count = (size_t)origin->vertex.index + 1;
  }
}

/* ---- Scenes ---- */

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

/* ---- Steps ---- */

/* The hand feeds a link in, or takes one out. It waits where the wire is squeezed or stretched. */
static int feed(scene *s, double *push) {
  wire *w = &s->wire;
  const dsw_volume_id none = {0, 0};
  const double stretch = wire_stretch(w), most = 0.35 * w->link;
  *push = *push > most ? most : (*push < -most ? -most : *push);
  if ((*push > 0 && (stretch < -0.02 || (w->count == s->most_vertices && w->in + *push >= w->link))) ||
      (*push < 0 && (stretch > 0.02 || (w->count == 3 && w->in + *push < 0)))) {
    *push = 0;
  }
  w->in += *push;
  if (w->in >= w->link) {
    dsw_body_vertex_id added, last;
    dsw_body_edge_id edge;
    if (!good(dsw_body_get_vertex_id(s->scene, s->body, (uint32_t)w->count - 1, &last), "feeding the wire") ||
        !good(dsw_body_add_vertex(s->scene, s->body, w->entry, none, &added), "feeding the wire")) {
      return 0;
    }
    if (dsw_body_add_edge(s->scene, s->body, last, added, &edge) != DSW_STATUS_OK) { /* later, when there is room */
      w->in -= *push;
      *push = 0;
      return good(dsw_body_remove_vertex(s->scene, s->body, added), "feeding the wire");
    }
    if (added.index != w->count) return fail("the wire's vertices are not in order");
    memcpy(w->at + 3 * w->count, w->entry, sizeof w->entry);
    ++w->count;
    s->slots = w->count > s->slots ? w->count : s->slots;
    w->in -= w->link;
  } else if (w->in < 0) {
    dsw_body_vertex_id last;
    if (!good(dsw_body_get_vertex_id(s->scene, s->body, (uint32_t)w->count - 1, &last), "taking the wire out") ||
        !good(dsw_body_remove_vertex(s->scene, s->body, last), "taking the wire out")) {
      return 0;
    }
    --w->count;
    w->in += w->link;
  }
  return 1;
}

static void keep_contact(scene *s, const double *point, const double *normal, double impulse, double kind,
                         double time) {
  scene_contact *c = s->contacts + s->contact_count;
  if (s->contact_count == kMostContacts) return;
  memcpy(c->point, point, sizeof c->point);
  memcpy(c->normal, normal, sizeof c->normal);
  c->impulse = impulse;
  c->kind = kind;
  c->time = time;
  ++s->contact_count;
}

/* Rows that press, and what the move has met nevertheless. */
static int keep_contacts(scene *s, const wire_rows *rows) {
  static const double kKinds[] = {0, 3, 2, 1, 0}; /* by dsw_cell_kind */
  const dsw_body_contact *contacts = NULL;
  size_t count = 0, i;
  s->contact_count = 0;
  for (i = 0; i < rows->count; ++i) {
    const dsw_near_row *row = rows->rows + i;
    if (s->wire.impulse[i] > 0) {
      keep_contact(s, row->obstacle_point, row->normal, s->wire.impulse[i], kKinds[row->obstacle.kind], -1);
    }
  }
  if (!good(dsw_body_get_contacts(s->scene, s->body, &contacts, &count), "reading contacts")) return 0;
  for (i = 0; i < count; ++i) {
    keep_contact(s, contacts[i].point, contacts[i].contact.normal, 0, contacts[i].contact.kind, contacts[i].time);
  }
  return 1;
}

static int read_wire(scene *s) {
  size_t count = 0;
  return good(dsw_body_get_positions(s->scene, s->body, s->wire.at, kMostVertices, 0, NULL, &count),
              "reading the wire");
}

int scene_step(scene *s, double push, double turn, int on) {
  wire *w = &s->wire;
  wire_rows rows;
  size_t entries = 0;
  if ((on || s->strength > 0 || s->opening_steps > 0) && (!bend(s, on) || !read_wire(s))) return 0;
  wire_turn(w, turn > 0.2 ? 0.2 : (turn < -0.2 ? -0.2 : turn));
  if (!feed(s, &push) || !good(dsw_body_find_near_rows(s->scene, s->body, &s->near_options, NULL), "finding rows") ||
      !good(dsw_body_get_near_offsets(s->scene, s->body, &rows.offsets, &entries), "reading rows") ||
      !good(dsw_body_get_near_columns(s->scene, s->body, &rows.columns, &entries), "reading rows") ||
      !good(dsw_body_get_near_values(s->scene, s->body, &rows.values, &entries), "reading rows") ||
      !good(dsw_body_get_near_rows(s->scene, s->body, &rows.rows, &rows.count), "reading rows")) {
    return 0;
  }
  rows.count = rows.count < kMostRows ? rows.count : kMostRows;
  wire_find_targets(w, push, &rows);
  return good(dsw_body_move(s->scene, s->body, w->target, s->slots, 0, &s->move_options, NULL), "moving the wire") &&
         keep_contacts(s, &rows) && read_wire(s);
}

/* Where a cut is: its middle on the wall, and unit vectors along the wire, out of the wall, and from lip to lip. */
typedef struct place {
  double middle[3], along[3], normal[3], side[3];
} place;

static double dot(const double *a, const double *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/* At the wall's point nearest to the tip. */
static int find_place(scene *s, place *at) {
  const dsw_volume_id none = {0, 0};
  const double *tip = s->wire.at;
  double way[3], share, length;
  dsw_nearest nearest;
  int k;
  if (!good(dsw_environment_find_nearest(s->environment, tip, none, 12 * s->wire.radius, &nearest),
            "looking for the wall")) {
    return 0;
  }
  if (nearest.cell.kind == DSW_CELL_NONE) return fail("no wall is near the tip");
  for (k = 0; k < 3; ++k) way[k] = tip[k] - tip[3 + k];
  share = dot(way, nearest.normal);
  for (k = 0; k < 3; ++k) way[k] -= share * nearest.normal[k];
  length = sqrt(dot(way, way));
  if (length < 0.05 * s->wire.link) return fail("the wire points straight at the wall");
  for (k = 0; k < 3; ++k) {
    at->middle[k] = nearest.point[k];
    at->normal[k] = nearest.normal[k];
    at->along[k] = way[k] / length;
  }
  for (k = 0; k < 3; ++k) {
    at->side[k] = at->normal[(k + 1) % 3] * at->along[(k + 2) % 3] - at->normal[(k + 2) % 3] * at->along[(k + 1) % 3];
  }
  return 1;
}

/* 1 at 0, smoothly to 0 at `end` and beyond. */
static double fade(double x, double end) {
  const double left = 1 - x * x / (end * end);
  return left > 0 ? left * left : 0;
}

/* Lips go apart slowly, and what is near goes with them. */
static void start_opening(scene *s, const place *at) {
  const double r = s->wire.radius;
  size_t i, k;
  for (i = 0; i < s->point_count; ++i) {
    double way[3], side, share;
    for (k = 0; k < 3; ++k) way[k] = s->rest[3 * i + k] - at->middle[k];
    side = dot(way, at->side);
    share = fade(dot(way, at->along), 11 * r) * fade(dot(way, at->normal), 9 * r) * fade(side, 9 * r) * 2.6 * r /
            kOpenSteps;
    share = side > 0 ? share : (side < 0 ? -share : 0);
    for (k = 0; k < 3; ++k) s->opening[3 * i + k] = share * at->side[k];
  }
  s->opening_steps = kOpenSteps;
}

static int open_crack(scene *s, const dsw_change *cut) {
  const size_t count = cut->face_count;
  dsw_cut_face *faces = (dsw_cut_face *)malloc((count + 1) * sizeof *faces);
  dsw_open_crack_desc desc;
  dsw_change change;
  int opened;
  if (faces == NULL) return fail("out of memory");
  memcpy(faces, cut->faces, count * sizeof *faces); /* the next change ends the arrays of the last one */
  dsw_open_crack_desc_init(&desc, sizeof desc);
  desc.faces = faces;
  desc.face_count = count;
  desc.width = s->wire.radius;
  change.struct_size = sizeof change;
  opened = good(dsw_environment_open_crack(s->environment, &desc, &change), "opening the cut");
  free(faces);
  if (opened) follow_change(s, &change);
  return opened;
}

int scene_cut(scene *s) {
  double blade[2][3][3];
  dsw_cut_desc desc;
  dsw_change change;
  place at;
  int row, column, k;
  if (!find_place(s, &at)) return 0;
  for (row = 0; row < 2; ++row) { /* from inside through the wall, to both sides of the tip */
    for (column = 0; column < 3; ++column) {
      for (k = 0; k < 3; ++k) {
        blade[row][column][k] =
            at.middle[k] + s->wire.radius * ((row == 0 ? -8 : 8) * at.along[k] + (2 - 4 * column) * at.normal[k]);
      }
    }
  }
  dsw_cut_desc_init(&desc, sizeof desc);
  desc.points = &blade[0][0][0];
  desc.rows = 2;
  desc.columns = 3;
  desc.snap = kSnap; /* longer edges, so that what is near can go with the lips */
  change.struct_size = sizeof change;
  if (!good(dsw_environment_cut(s->environment, &desc, &change), "cutting")) return 0;
  s->traced = 0;
  ++s->wall_version;
  follow_change(s, &change);
  if (change.face_count == 0) return fail("the blade has split nothing");
  if (!open_crack(s, &change)) return 0;
  start_opening(s, &at);
  return read_wire(s);
}

/* ---- What is there to see ---- */

const double *scene_get_wire(const scene *s, size_t *count) {
  *count = s->wire.count;
  return s->wire.at;
}

const scene_contact *scene_get_contacts(const scene *s, size_t *count) {
  *count = s->contact_count;
  return s->contacts;
}

static int trace_wall(scene *s, dsw_trace_data *data) {
  data->struct_size = sizeof *data;
  if (!s->traced &&
      (!good(dsw_trace_clear(s->trace), "drawing the wall") ||
       !good(dsw_trace_add_impassable(s->trace, s->environment, s->with_boundary, 0), "drawing the wall"))) {
    return 0;
  }
  s->traced = 1;
  return good(dsw_trace_get_data(s->trace, data), "drawing the wall");
}

const double *scene_get_wall_points(scene *s, size_t *count) {
  dsw_trace_data data;
  if (!trace_wall(s, &data)) return NULL;
  *count = data.point_count;
  return data.points;
}

const uint32_t *scene_get_wall_triangles(scene *s, size_t *count) {
  dsw_trace_data data;
  if (!trace_wall(s, &data)) return NULL;
  *count = data.triangle_count;
  return data.triangles;
}

uint32_t scene_get_wall_version(const scene *s) { return s->wall_version; }

const scene_size *scene_get_size(const scene *s) { return &s->size; }
