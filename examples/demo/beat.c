#include "beat.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesh.h"
#include "output.h"
#include "run.h"

enum { kSamples = 160, kSmoothings = 40, kKeptSteps = 10, kPeriod = 50 };

static const double kPi = 3.14159265358979323846, kDepth = 0.7, kWaves = 2.5, kReach = 0.85;

/* The middle of the vessel: the way of the flow, at `count` places, smoothed. */
static size_t find_middle(const demo_flow *flow, double *middle) {
  const size_t most = kSamples, count = flow->path_count < most ? flow->path_count : most;
  for (size_t i = 0; i < count; ++i) {
    size_t slot = flow->path[i * (flow->path_count - 1) / (count > 1 ? count - 1 : 1)];
    memcpy(middle + 3 * i, flow->centre + 3 * slot, 3 * sizeof(double));
  }
  for (size_t round = 0; round < kSmoothings; ++round) {
    for (size_t i = 3; i + 3 < 3 * count; ++i) {
      middle[i] = 0.5 * middle[i] + 0.25 * (middle[i - 3] + middle[i + 3]);
    }
  }
  return count;
}

/* Points go towards a mean of the middle near them, so that neighbours go alike; far from it they stay. */
static void find_ways_inward(demo_beat *beat, const double *middle, size_t count) {
  double reach = 1.2 * beat->radius, *from_inlet = (double *)demo_allocate(2 * count, sizeof(double));
  double *square = from_inlet + count;
  from_inlet[0] = 0;
  for (size_t i = 1; i < count; ++i) {
    from_inlet[i] = from_inlet[i - 1] + distance(middle + 3 * (i - 1), middle + 3 * i);
  }
  beat->length = from_inlet[count - 1];
  for (size_t i = 0; i < beat->point_count; ++i) {
    const double *p = beat->rest + 3 * i;
    double nearest = 1e300, sum = 0, way[3] = {0, 0, 0}, along = 0;
    for (size_t j = 0; j < count; ++j) {
      double d = distance(p, middle + 3 * j);
      square[j] = d * d;
      nearest = square[j] < nearest ? square[j] : nearest;
    }
    for (size_t j = 0; j < count; ++j) {
      double weight = exp((nearest - square[j]) / (2 * reach * reach));
      sum += weight;
      along += weight * from_inlet[j];
      for (size_t k = 0; k < 3; ++k) {
        way[k] += weight * (middle[3 * j + k] - p[k]);
      }
    }
    double far = (way[0] * way[0] + way[1] * way[1] + way[2] * way[2]) / (4 * sum * sum * beat->radius * beat->radius);
    for (size_t k = 0; k < 3; ++k) {
      beat->inward[3 * i + k] = way[k] / sum * exp(-far);
    }
    beat->along[i] = along / sum;
  }
  free(from_inlet);
}

void beat_create(demo_beat *beat, dsw_environment *environment, const demo_flow *flow) {
  double middle[3 * kSamples];
  const double *points = NULL;
  dsw_scene_desc desc;
  dsw_scene *scene = NULL;
  memset(beat, 0, sizeof *beat);
  beat->figures.name = "beating";
  beat->environment = environment;
  beat->radius = flow->radius;
  require(dsw_environment_get_points(environment, &points, &beat->point_count), "reading points", kFailed);
  beat->rest = (double *)demo_allocate(13 * beat->point_count, sizeof(double));
  memcpy(beat->rest, points, 3 * beat->point_count * sizeof(double));
  beat->lent[0] = beat->rest + 3 * beat->point_count;
  beat->lent[1] = beat->lent[0] + 3 * beat->point_count;
  beat->inward = beat->lent[1] + 3 * beat->point_count;
  beat->along = beat->inward + 3 * beat->point_count;
  find_ways_inward(beat, middle, find_middle(flow, middle));
  dsw_scene_desc_init(&desc, sizeof desc);
  desc.features = DSW_FEATURE_DEFORMING;
  require(dsw_scene_create(environment, &desc, &scene), "creating a scene", kFailed);
  catheter_create(&beat->catheter, scene, flow, "beaten", DSW_RESPONSE_ADAPTIVE_ONE);
}

/* Waves run along the vessel; its ends keep their width. */
static void bend(const demo_beat *beat, size_t step, double *next) {
  double begins = step < kPeriod / 2 ? 2.0 * (double)step / (double)kPeriod : 1, end = 4 * beat->radius;
  for (size_t i = 0; i < beat->point_count; ++i) {
    double s = beat->along[i], left = (s < beat->length - s ? s : beat->length - s) / end;
    double wave = sin(kPi * (kWaves * s / beat->length - (double)step / (double)kPeriod));
    double depth = kDepth * begins * (left < 1 ? left : 1) * wave * wave;
    for (size_t k = 0; k < 3; ++k) {
      next[3 * i + k] = beat->rest[3 * i + k] + depth * beat->inward[3 * i + k];
    }
  }
}

void beat_run(demo_beat *beat, const demo_flow *flow, size_t steps, FILE *csv) {
  demo_catheter *c = &beat->catheter;
  for (size_t step = 0; step < steps; ++step) {
    double *next = beat->lent[step % 2]; /* the environment reads the other one */
    int keep = step + kKeptSteps >= steps;
    size_t pushed = beat->figures.pushed;
    bend(beat, step + 1, next);
    changes_deform(&beat->figures, c->scene, next, beat->point_count, keep ? &c->figures : NULL);
    beat->squeezed += beat->figures.pushed > pushed;
    changes_prove(&beat->figures, &c->figures, c->scene, c->body);
    catheter_read_places(c);
    catheter_step(c, flow, kReach * flow->length / (double)steps, 0, csv);
    changes_prove(&beat->figures, &c->figures, c->scene, c->body);
  }
  changes_add_body(&beat->figures, &c->figures, c->count);
  changes_end(&beat->figures, beat->environment);
}

int beat_write(const demo_beat *beat, const char *out, int with_boundary) {
  return write_trace(beat->environment, out, "beating.vtu", with_boundary) | catheter_write(&beat->catheter, out);
}

void beat_destroy(demo_beat *beat) {
  catheter_destroy(&beat->catheter);
  free(beat->rest);
}
