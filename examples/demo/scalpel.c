#include "scalpel.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "output.h"
#include "run.h"
#include "tissue.h"

/* Rows of the blades for each step; a cut begins behind by one of so many parts of the blade, which is more than a volume. */
enum { kFine = 3, kBehind = 6, kAround = 16, kRows = 24, kPushes = 40 };

static const double kPi = 3.14159265358979323846;

/* Parts of the organ's size along its axes; kAbove: how far the blade comes out, a part of the air's first layer. */
static const double kLong = 0.45, kCurve = 0.03, kDeep = 0.24, kWide = 0.075, kAbove = 0.3, kSnap = 0.2, kAirOut = 9,
                    kProbe = 0.02, kProbeLong = 0.55;

static void to_world(const demo_scalpel *s, double x, double y, double z, double *p) {
  p[s->axis[0]] = x;
  p[s->axis[1]] = y;
  p[s->axis[2]] = z;
}

static void find_axes(demo_scalpel *s, const demo_mesh *organ) {
  double low[3], high[3];
  memcpy(low, organ->points, sizeof low);
  memcpy(high, organ->points, sizeof high);
  for (size_t i = 0; i < 3 * organ->point_count; ++i) {
    double x = organ->points[i];
    low[i % 3] = x < low[i % 3] ? x : low[i % 3];
    high[i % 3] = x > high[i % 3] ? x : high[i % 3];
  }
  for (int k = 0; k < 3; ++k) {
    s->axis[k] = k;
  }
  for (int turn = 0; turn < 3; ++turn) { /* three swaps sort three numbers */
    int k = turn % 2, a = s->axis[k], b = s->axis[k + 1];
    if (high[a] - low[a] < high[b] - low[b]) {
      s->axis[k] = b;
      s->axis[k + 1] = a;
    }
  }
  for (int k = 0; k < 3; ++k) {
    s->size[k] = high[s->axis[k]] - low[s->axis[k]];
  }
}

/* How high the organ is at a place; `layer`, if not null: how much higher the first layer of air there. */
static double find_top(const demo_scalpel *s, double x, double y, double *layer) {
  const dsw_volume_id anywhere = {0, 0};
  const int up = s->axis[2];
  double from[3], to[3], height = 0;
  dsw_flight flight;
  to_world(s, x, y, s->middle[2] + 0.7 * s->size[2], from);
  to_world(s, x, y, s->middle[2] - 0.7 * s->size[2], to);
  require(dsw_environment_cast(s->environment, anywhere, from, to, NULL, &flight), "looking for the surface", kFailed);
  if (flight.outcome != DSW_OUTCOME_CONTACT) {
    fprintf(stderr, "demo: the tissue cannot be used: its middle is not where the cut is to be\n");
    exit(kBadInput);
  }
  for (int k = 0; k < 3; ++k) {
    height += flight.contact.normal[k] * (flight.position[k] - s->centre[k]);
  }
  if (layer != NULL) {
    *layer = (s->first - 1) * height / flight.contact.normal[up];
  }
  return flight.position[up];
}

/* Where the blade is in the middle axis. */
static double blade_at(const demo_scalpel *s, double t) {
  return s->middle[1] + kCurve * s->size[1] * sin(2 * kPi * t);
}

/* How deep it is, as a part of the most: it sinks in, is drawn through and comes out. */
static double sunk(double t) { return t > 0 && t < 1 ? pow(sin(kPi * t), 0.6) : 0; }

/* The two sides of the cut meet at its floor. */
static void make_blades(demo_scalpel *s, size_t steps) {
  s->stations = steps + 1;
  for (size_t i = 0; i < s->stations; ++i) {
    double t = (double)i / (double)steps, x = s->middle[0] + kLong * (t - 0.5) * s->size[0], y = blade_at(s, t), layer;
    double floor = find_top(s, x, y, NULL) - sunk(t) * kDeep * s->size[2];
    for (int side = 0; side < 2; ++side) {
      double across = y + (side == 0 ? -kWide : kWide) * s->size[2] * sunk(t), top = find_top(s, x, across, &layer);
      to_world(s, x, across, top + kAbove * layer, s->blades[side] + 6 * i);
      to_world(s, x, y, floor, s->blades[side] + 6 * i + 3);
    }
  }
}

/* A rod with a round tip, which points down. */
static void make_probe(demo_scalpel *s, double x, double y, double tip) {
  demo_surface *p = &s->surface;
  double thick = kProbe * s->size[2], length = kProbeLong * s->size[2];
  p->point_count = kAround * kRows + 2;
  p->triangle_count = 2 * kAround * kRows;
  p->points = (double *)demo_allocate(3 * p->point_count, sizeof(double));
  p->corners = (uint32_t *)demo_allocate(3 * p->triangle_count, sizeof(uint32_t));
  to_world(s, x, y, tip, p->points);
  to_world(s, x, y, tip + length, p->points + 3);
  uint32_t *c = p->corners;
  for (uint32_t i = 0; i < kAround * kRows; ++i) {
    uint32_t row = i / kAround, right = row * kAround + (i + 1) % kAround + 2;
    double up = (double)(row + 1) / (double)(kRows + 1), angle = 2 * kPi * (double)(i % kAround) / (double)kAround;
    double z = length * up * up, radius = thick * sqrt(z < 4 * thick ? z / (4 * thick) : 1);
    to_world(s, x + radius * cos(angle), y + radius * sin(angle), tip + z, p->points + 3 * (i + 2));
    const uint32_t two[6] = {i + 2, right, row + 1 == kRows ? 1 : right + kAround, row == 0 ? 0 : i + 2 - kAround,
                             right, i + 2};
    memcpy(c, two, sizeof two);
    c += 6;
  }
}

void scalpel_create(demo_scalpel *s, dsw_context *context, const demo_mesh *organ) {
  dsw_environment_desc desc;
  memset(s, 0, sizeof *s);
  s->figures.name = "scalpel";
  figures_create(&s->probe_figures, "probe");
  find_axes(s, organ);
  dsw_environment_desc_init(&desc, sizeof desc);
  desc.points = organ->points;
  desc.point_count = organ->point_count;
  desc.cell_types = organ->types;
  desc.volume_count = organ->cell_count;
  desc.offsets = organ->offsets;
  desc.connectivity = organ->connectivity;
  desc.connectivity_count = organ->connectivity_count;
  desc.flags = DSW_ENVIRONMENT_REORIENT;
  require(dsw_environment_create(context, &desc, &s->environment, NULL), "the tissue cannot be used", kBadInput);
  s->tissue_volumes = organ->cell_count;
  tissue_put_in_air(s->environment, kAirOut, &s->first, s->centre);
  for (int k = 0; k < 3; ++k) {
    s->middle[k] = s->centre[s->axis[k]];
  }
  require(dsw_scene_create(s->environment, NULL, &s->scene), "creating a scene", kFailed);
}

/* A blade goes on to row `last`. What it does not cross completely stays whole until it has gone on, so a cut begins some rows behind. */
static void cut(demo_scalpel *s, const double *blade, size_t last) {
  size_t behind = kFine + s->stations / kBehind, first = last < behind ? 0 : last - behind;
  dsw_cut_desc desc;
  dsw_change report;
  report.struct_size = sizeof report;
  dsw_cut_desc_init(&desc, sizeof desc);
  desc.points = blade + 6 * first;
  desc.rows = (uint32_t)(last - first + 1);
  desc.columns = 2;
  desc.snap = kSnap;
  double start = seconds_now();
  require(dsw_environment_cut(s->environment, &desc, &report), "cutting", kFailed);
  changes_add(&s->figures, seconds_now() - start);
  s->split += report.volumes_split;
  s->distance = report.distance > s->distance ? report.distance : s->distance;
}

/* How far a point is to the right of a blade, which is seen from its first row to its last; `up`: how far up along it, from 0 to 1. */
static double side_of(const demo_scalpel *s, const double *blade, const double *p, double *up) {
  double at = (0.5 + (p[s->axis[0]] - s->middle[0]) / (kLong * s->size[0])) * (double)(s->stations - 1);
  size_t i = at < 0 ? 0 : at < (double)(s->stations - 2) ? (size_t)at : s->stations - 2;
  double top[3], floor[3];
  for (size_t k = 0; k < 3; ++k) {
    const double *row = blade + 6 * i + k;
    top[k] = row[0] + (at - (double)i) * (row[6] - row[0]);
    floor[k] = row[3] + (at - (double)i) * (row[9] - row[3]);
  }
  *up = (p[s->axis[2]] - floor[s->axis[2]]) / (top[s->axis[2]] - floor[s->axis[2]]);
  return p[s->axis[1]] - floor[s->axis[1]] - *up * (top[s->axis[1]] - floor[s->axis[1]]);
}

static int is_between(const demo_scalpel *s, const double *p) {
  double up[2], along = (p[s->axis[0]] - s->middle[0]) / (kLong * s->size[0]);
  return fabs(along) < 0.5 && side_of(s, s->blades[0], p, up) > 0 && side_of(s, s->blades[1], p, up + 1) < 0 &&
         up[0] > 0;
}

/* What lies between the blades is taken out: it becomes passable. */
static void open_cut(demo_scalpel *s) {
  dsw_environment_info info;
  info.struct_size = sizeof info;
  require(dsw_environment_get_info(s->environment, &info), "reading the tissue", kFailed);
  dsw_volume_id *volumes = (dsw_volume_id *)demo_allocate(info.volume_count, sizeof(dsw_volume_id));
  for (uint32_t i = 0; i < info.volume_index_count; ++i) {
    double centre[3];
    dsw_volume_id *volume = volumes + s->opened;
    if (dsw_environment_get_volume_id(s->environment, i, volume) == DSW_STATUS_OK) {
      require(dsw_environment_get_centre(s->environment, *volume, centre), "reading the tissue", kFailed);
      s->opened += (size_t)is_between(s, centre);
    }
  }
  double start = seconds_now();
  require(dsw_environment_mark_volumes(s->environment, volumes, s->opened, DSW_MARK_PASSABLE, 0, NULL),
          "opening the cut", kFailed);
  changes_add(&s->figures, seconds_now() - start);
  free(volumes);
}

static void create_probe(demo_scalpel *s) {
  double t = 0.5, x = s->middle[0], y = blade_at(s, t), top = find_top(s, x, y, NULL);
  make_probe(s, x, y, top + 0.25 * s->size[2]);
  require(soft_create_body(&s->surface, s->scene, &s->probe), "creating the probe", kFailed);
  s->start = top;
  s->depth = kDeep * s->size[2];
}

/* Down into the cut until it touches. */
static void push_probe(demo_scalpel *s, FILE *csv) {
  dsw_rigid_motion motion;
  dsw_move_report report;
  size_t n = s->surface.point_count;
  memset(&motion, 0, sizeof motion);
  motion.rotation[3] = 1;
  motion.translation[s->axis[2]] = -(kDeep + 0.4) * s->size[2] / (double)kPushes;
  report.fraction = 1;
  for (size_t push = 0; push < kPushes && report.fraction == 1; ++push) {
    double start = seconds_now();
    require(dsw_body_move_rigid(s->scene, s->probe, &motion, NULL, &report), "pushing the probe", kFailed);
    figures_add(&s->probe_figures, s->scene, s->probe, &report, seconds_now() - start, 1, csv);
    changes_prove(&s->figures, &s->probe_figures, s->scene, s->probe);
  }
  require(dsw_body_get_positions(s->scene, s->probe, s->surface.points, n, 0, NULL, &n), "reading the probe", kFailed);
  s->reached = s->start - s->surface.points[s->axis[2]];
}

void scalpel_run(demo_scalpel *s, size_t steps, FILE *csv) {
  make_blades(s, kFine * steps);
  create_probe(s);
  for (size_t i = 1; i <= steps; ++i) {
    cut(s, s->blades[0], kFine * i);
    cut(s, s->blades[1], kFine * i);
    changes_prove(&s->figures, &s->probe_figures, s->scene, s->probe);
  }
  open_cut(s);
  changes_prove(&s->figures, &s->probe_figures, s->scene, s->probe);
  push_probe(s, csv);
  changes_add_body(&s->figures, &s->probe_figures, s->surface.point_count);
  changes_end(&s->figures, s->environment);
}

int scalpel_write(const demo_scalpel *s, const char *out) {
  uint32_t edges[2 * kMostStations];
  for (uint32_t i = 0; i < 2 * s->stations; ++i) {
    edges[i] = i;
  }
  int code = write_trace(s->environment, out, "tissue.vtu", 0);
  code |= vtu_write(out, "scalpel.vtu", s->blades[0], 2 * s->stations, edges, 2, s->stations, NULL, 0);
  code |= vtu_write(out, "probe.vtu", s->surface.points, s->surface.point_count, s->surface.corners, 3,
                    s->surface.triangle_count, NULL, 0);
  return code | write_touches(out, "probe_contacts.vtu", s->probe_figures.touch, s->probe_figures.normal,
                              s->probe_figures.touch_count);
}

void scalpel_destroy(demo_scalpel *s) {
  require(dsw_scene_destroy(s->scene), "destroying a scene", kFailed);
  require(dsw_environment_destroy(s->environment), "destroying the tissue", kFailed);
  surface_free(&s->surface);
  figures_destroy(&s->probe_figures);
}
