#if !defined(_POSIX_C_SOURCE)
#define _POSIX_C_SOURCE 200112L
#endif
#include "run.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { kBar = 40, kContactSteps = 4 };

/* A number in [0,1) that depends on nothing but its arguments, so runs repeat bit for bit. */
static double chance(uint32_t particle, uint32_t step, uint32_t use) {
  uint32_t h = particle * 0x9e3779b1u ^ step * 0x85ebca77u ^ use * 0xc2b2ae3du;
  for (int round = 0; round < 3; ++round) {
    h = (h ^ h >> 16) * 0x7feb352du;
    h = (h ^ h >> 15) * 0x846ca68bu;
  }
  return (double)(h ^ h >> 16) / 4294967296.0;
}

static void show_progress(size_t done, size_t total) {
  static int shown = -1;
  int tty = isatty(2), percent = (int)(100 * done / total);
  if (percent == shown || (!tty && percent % 25 != 0)) {
    return;
  }
  shown = percent;
  char bar[kBar + 1];
  memset(bar, '.', kBar);
  memset(bar, '#', (size_t)(kBar * percent / 100));
  bar[kBar] = 0;
  fprintf(stderr, "%s[%s] %3d %%%s", tty ? "\r" : "", bar, percent, tty && done < total ? "" : "\n");
}

/* The cloud starts in the first tenth of the way, between the centres and the vertices of the volumes there. */
static void place_cloud(demo_run *run) {
  const demo_flow *flow = &run->flow;
  size_t near_inlet = 1;
  while (near_inlet < flow->count && flow->from_inlet[near_inlet] < 0.1 * flow->length) {
    ++near_inlet;
  }
  for (size_t i = 0; i < run->cloud; ++i) {
    size_t slot = i % near_inlet, count = 0;
    double corner[3], part = 0.7 * chance((uint32_t)i, 0, 1);
    dsw_vertex_id vertices[256];
    dsw_cell cell;
    cell.kind = DSW_CELL_VOLUME;
    cell.index = flow->volumes[slot].index;
    cell.generation = flow->volumes[slot].generation;
    cell.local = 0;
    require(dsw_environment_copy_vertices(run->environment, cell, vertices, 256, &count), "placing the cloud", kFailed);
    size_t pick = (size_t)(chance((uint32_t)i, 0, 2) * (double)count);
    require(dsw_environment_get_vertex_position(run->environment, vertices[pick], corner), "placing the cloud",
            kFailed);
    for (size_t k = 0; k < 3; ++k) {
      double centre = flow->centre[3 * slot + k];
      run->position[3 * i + k] = centre + part * (corner[k] - centre);
    }
    run->volume[i] = flow->volumes[slot];
  }
}

static void record(demo_run *run, size_t i, int last_steps) {
  const dsw_flight *flight = run->flight + i;
  if (flight->outcome == DSW_OUTCOME_CONTACT) {
    run->contacts[i] += 1;
    memcpy(run->last_normal + 3 * i, flight->contact.normal, sizeof flight->contact.normal);
    if (last_steps && run->touch_count < run->touch_capacity) {
      memcpy(run->touch + 3 * run->touch_count, flight->position, sizeof flight->position);
      memcpy(run->touch_normal + 3 * run->touch_count++, flight->contact.normal, sizeof flight->contact.normal);
    }
  }
  memcpy(run->moved + 3 * i, flight->position, sizeof flight->position);
}

/* Takes what goes into the wall out of a move, if the last one ended there. */
static void slide(demo_run *run, size_t i) {
  const double *normal = run->last_normal + 3 * i;
  double *q = run->target + 3 * i, into = 0;
  for (size_t k = 0; k < 3; ++k) {
    into += (q[k] - run->position[3 * i + k]) * normal[k];
  }
  for (size_t k = 0; k < 3 && into < 0 && run->flight[i].outcome == DSW_OUTCOME_CONTACT; ++k) {
    q[k] -= into * normal[k];
  }
}

/* Every particle goes with the flow at its own speed and wanders; one that has just met a wall goes along it. */
static void move_cloud(demo_run *run, uint32_t step, double reach) {
  double wander = 1.1 * reach < 0.5 * run->flow.radius ? 1.1 * reach : 0.5 * run->flow.radius;
  for (size_t i = 0; i < run->cloud; ++i) {
    const double *along = run->flow.along + 3 * (size_t)run->flow.slot_of[run->volume[i].index];
    double speed = reach * (0.15 + 0.85 * chance((uint32_t)i, 0, 3));
    for (size_t k = 0; k < 3; ++k) {
      double random = chance((uint32_t)i, step, (uint32_t)k + 4) - 0.5;
      run->target[3 * i + k] = run->position[3 * i + k] + speed * along[k] + 2 * wander * random;
    }
    slide(run, i);
  }
  double start = seconds_now();
  require(dsw_scene_move_particles(run->scene, run->ids, run->cloud, run->target, 0, NULL, run->flight),
          "moving the cloud", kFailed);
  run->move_seconds += seconds_now() - start;
}

/* Casts every move of this step again, without the particles: it must be free and end in the volume reported. */
static void prove_moves(demo_run *run) {
  require(dsw_environment_cast_segments(run->environment, run->cloud, run->volume, run->position, run->moved, 0, NULL,
                                        run->proof),
          "proving the moves", kFailed);
  for (size_t i = 0; i < run->cloud; ++i) {
    run->wrong_moves += run->proof[i].outcome != DSW_OUTCOME_REACHED ||
                        run->proof[i].volume.index != run->flight[i].volume.index ||
                        run->proof[i].volume.generation != run->flight[i].volume.generation;
    run->volume[i] = run->flight[i].volume;
  }
  memcpy(run->position, run->moved, 3 * run->cloud * sizeof(double));
}

/* Locates every particle anew, without a hint: in the lumen, in the volume that its particle says. */
static void prove_places(demo_run *run) {
  dsw_volume_id *found = (dsw_volume_id *)demo_allocate(run->cloud, sizeof(dsw_volume_id));
  dsw_location *locations = (dsw_location *)demo_allocate(run->cloud, sizeof(dsw_location));
  for (size_t i = 0; i < run->cloud; ++i) {
    require(dsw_particle_get_position(run->scene, run->ids[i], run->position + 3 * i, run->volume + i),
            "reading a particle", kFailed);
    run->wrong_moves += memcmp(run->position + 3 * i, run->moved + 3 * i, 3 * sizeof(double)) != 0;
  }
  require(dsw_environment_locate_points(run->environment, run->position, run->cloud, 0, NULL, found, locations),
          "proving the places", kFailed);
  for (size_t i = 0; i < run->cloud; ++i) {
    run->wrong_places += locations[i] != DSW_LOCATION_PASSABLE || found[i].index != run->volume[i].index ||
                         found[i].generation != run->volume[i].generation ||
                         run->flow.slot_of[found[i].index] == kNoSlot;
  }
  free(found);
  free(locations);
}

void create_run(demo_run *run, dsw_environment *environment, const demo_mesh *mesh, size_t cloud) {
  dsw_scene_desc desc;
  size_t n = cloud, offender = 0;
  memset(run, 0, sizeof *run);
  run->environment = environment;
  run->cloud = cloud;
  require(flow_create(environment, mesh, 0, &run->flow), "finding the way through the lumen", kFailed);
  if (run->flow.count < 2) {
    fprintf(stderr, "demo: the lumen has fewer than two volumes; nothing can flow\n");
    exit(kBadInput);
  }
  run->ids = (dsw_particle_id *)demo_allocate(n, sizeof(dsw_particle_id));
  run->volume = (dsw_volume_id *)demo_allocate(n, sizeof(dsw_volume_id));
  run->flight = (dsw_flight *)demo_allocate(n, sizeof(dsw_flight));
  memset(run->flight, 0, n * sizeof(dsw_flight));
  run->proof = (dsw_flight *)demo_allocate(n, sizeof(dsw_flight));
  run->touch_capacity = kContactSteps * cloud;
  run->position = (double *)demo_allocate(13 * n + 6 * run->touch_capacity, sizeof(double));
  memset(run->position, 0, (13 * n + 6 * run->touch_capacity) * sizeof(double));
  run->target = run->position + 3 * n;
  run->moved = run->target + 3 * n;
  run->last_normal = run->moved + 3 * n;
  run->contacts = run->last_normal + 3 * n;
  run->touch = run->contacts + n;
  run->touch_normal = run->touch + 3 * run->touch_capacity;
  place_cloud(run);
  dsw_scene_desc_init(&desc, sizeof desc);
  desc.features = DSW_FEATURE_STATISTICS;
  require(dsw_scene_create(environment, &desc, &run->scene), "creating the scene", kFailed);
  require(dsw_scene_create_particles(run->scene, run->position, n, 0, run->volume, run->ids, &offender),
          "creating the particles", kFailed);
  for (size_t i = 0; i < n; ++i) {
    require(dsw_particle_get_position(run->scene, run->ids[i], NULL, run->volume + i), "reading a particle", kFailed);
  }
}

void destroy_run(demo_run *run) {
  require(dsw_scene_destroy(run->scene), "destroying the scene", kFailed);
  flow_destroy(&run->flow);
  free(run->ids);
  free(run->volume);
  free(run->flight);
  free(run->proof);
  free(run->position);
}

void drive(demo_run *run, size_t steps) {
  double reach = 0.8 * run->flow.length / (double)steps;
  for (size_t step = 0; step < steps; ++step) {
    move_cloud(run, (uint32_t)step, reach);
    for (size_t i = 0; i < run->cloud; ++i) {
      record(run, i, step + kContactSteps >= steps);
    }
    prove_moves(run);
    show_progress(step + 1, steps);
  }
  prove_places(run);
}
