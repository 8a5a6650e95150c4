/* The main job: a cloud of particles flows and catheters are pushed through the lumen of a vessel; a closed surface
 * falls among pyramids; an organ is cut, a vessel beats, a box bends. Every move ends at its target or at the first thing
 * in the way, exactly; independent passes prove that nothing went through. */
#include <dartsweep/dartsweep.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "beat.h"
#include "box.h"
#include "catheter.h"
#include "fall.h"
#include "lumen.h"
#include "mesh.h"
#include "output.h"
#include "run.h"
#include "scalpel.h"
#include "tables.h"
#include "tissue.h"

typedef struct demo_options {
  const char *mesh, *out, *surface, *tissue;
  double spacing;
  long particles, steps, fall_steps, box_steps, cut_steps, threads;
} demo_options;

static int write_files(const demo_run *run, const demo_catheter *catheters, const demo_fall *fall, const char *out,
                       size_t wall) {
  const demo_soft *soft = &fall->soft;
  vtu_field cloud[2], touched = field("contacts", soft->touched, 1);
  cloud[0] = field("contacts", run->contacts, 1);
  cloud[1] = field("last_contact_normal", run->last_normal, 3);
  int code = vtu_write(out, "demo.vtu", run->position, run->cloud, NULL, 0, 0, cloud, 2);
  code |= write_touches(out, "contacts.vtu", run->touch, run->touch_normal, run->touch_count);
  code |= write_trace(run->environment, out, "wall.vtu", wall == 0);
  code |= write_trace(run->environment, out, "outer.vtu", 1);
  for (size_t i = 0; i < kCatheters; ++i) {
    code |= catheter_write(catheters + i, out);
  }
  code |= vtu_write(out, "surface.vtu", soft->surface->points, soft->surface->point_count, soft->surface->corners, 3,
                    soft->surface->triangle_count, &touched, 1);
  code |=
      write_touches(out, "surface_contacts.vtu", soft->figures.touch, soft->figures.normal, soft->figures.touch_count);
  code |= write_trace(fall->environment, out, "obstacles.vtu", 0);
  return code;
}

static int usage(const char *wrong) {
  fprintf(stderr,
          "demo: cannot use '%s'\n"
          "usage: dartsweep_demo [--mesh FILE] [--spacing MM] [--particles N] [--steps N] [--surface FILE.obj] "
          "[--fall-steps N] [--tissue FILE] [--cut-steps N] "
          "[--box-steps N] [--threads N] [--out FOLDER]\n",
          wrong);
  return kBadInput;
}

static int read_options(int argc, char **argv, demo_options *options) {
  options->mesh = NULL;
  options->out = NULL;
  options->surface = NULL;
  options->tissue = NULL;
  options->spacing = 1.3;
  options->particles = 10000;
  options->steps = 300;
  options->fall_steps = 120;
  options->box_steps = 44;
  options->cut_steps = 12;
  options->threads = 1;
  for (int i = 1; i < argc; i += 2) {
    const char *name = argv[i], *value = i + 1 < argc ? argv[i + 1] : NULL;
    char *end = NULL;
    double number = value != NULL ? strtod(value, &end) : 0;
    int is_number = value != NULL && *value != 0 && *end == 0, is_count = is_number && number >= 1 && number <= 1e7;
    if (value != NULL && strcmp(name, "--mesh") == 0) {
      options->mesh = value;
    } else if (value != NULL && strcmp(name, "--out") == 0) {
      options->out = value;
    } else if (value != NULL && strcmp(name, "--surface") == 0) {
      options->surface = value;
    } else if (value != NULL && strcmp(name, "--tissue") == 0) {
      options->tissue = value;
    } else if (is_number && strcmp(name, "--spacing") == 0) {
      options->spacing = number;
    } else if (is_count && strcmp(name, "--particles") == 0) {
      options->particles = (long)number;
    } else if (is_count && strcmp(name, "--steps") == 0) {
      options->steps = (long)number;
    } else if (is_count && strcmp(name, "--fall-steps") == 0) {
      options->fall_steps = (long)number;
    } else if (is_count && strcmp(name, "--box-steps") == 0) {
      options->box_steps = (long)number;
    } else if (is_count && number >= 4 && number <= (double)kMostCuts && strcmp(name, "--cut-steps") == 0) {
      options->cut_steps = (long)number;
    } else if (is_count && number <= 256 && strcmp(name, "--threads") == 0) {
      options->threads = (long)number;
    } else {
      return usage(value == NULL ? name : is_number ? value : name);
    }
  }
  return 0;
}

/* Runs one catheter three times, each time with another response of its edges. */
static void run_catheters(demo_catheter *catheters, const demo_run *run, size_t steps, FILE *csv) {
  static const struct {
    const char *name;
    dsw_response response;
  } kRuns[kCatheters] = {
      {"static", DSW_RESPONSE_STOP}, {"adaptive", DSW_RESPONSE_ADAPTIVE_ONE}, {"slide", DSW_RESPONSE_SLIDE}};
  for (size_t i = 0; i < kCatheters; ++i) {
    catheter_run(catheters + i, run->environment, &run->flow, kRuns[i].name, kRuns[i].response, steps, csv);
  }
}

int main(int argc, char **argv) {
  static demo_catheter catheters[kCatheters];
  static demo_beat beat;
  static demo_scalpel scalpel;
  demo_options options;
  demo_mesh mesh, organ;
  demo_surface surface;
  demo_run run;
  demo_fall fall;
  demo_box box;
  dsw_context *context = NULL;
  dsw_context_desc desc;
  FILE *csv = NULL;
  int code = read_options(argc, argv, &options);
  memset(&mesh, 0, sizeof mesh);
  memset(&organ, 0, sizeof organ);
  memset(&surface, 0, sizeof surface);
  if (code == 0 && options.surface != NULL) {
    code = surface_read(options.surface, &surface);
  } else if (code == 0) {
    surface_make_ring(120, 100, &surface);
  }
  if (code == 0) {
    code = options.mesh != NULL ? mesh_read(options.mesh, &mesh) : mesh_make_vessel(options.spacing, &mesh);
  }
  if (code == 0 && options.tissue != NULL) {
    code = mesh_read(options.tissue, &organ);
  } else if (code == 0) {
    mesh_make_organ(18, &organ);
  }
  if (code == 0 && options.out != NULL) {
    csv = open_steps(options.out);
    code = csv == NULL ? kBadInput : 0;
  }
  if (code != 0) {
    surface_free(&surface);
    mesh_free(&mesh);
    mesh_free(&organ);
    return code;
  }
  dsw_context_desc_init(&desc, sizeof desc);
  desc.thread_count = (uint32_t)options.threads;
  require(dsw_context_create(&desc, &context), "creating a context", kFailed);
  dsw_environment *environment = create_environment(context, &mesh);
  size_t wall = mark_wall(environment, &mesh);
  create_run(&run, environment, &mesh, (size_t)options.particles);
  drive(&run, (size_t)options.steps);
  run_catheters(catheters, &run, (size_t)options.steps, csv);
  dsw_environment *beating = create_environment(context, &mesh);
  mark_wall(beating, &mesh);
  beat_create(&beat, beating, &run.flow);
  beat_run(&beat, &run.flow, (size_t)options.steps, csv);
  fall_create(&fall, context, &surface);
  fall_run(&fall, (size_t)options.fall_steps, csv);
  scalpel_create(&scalpel, context, &organ);
  scalpel_run(&scalpel, (size_t)options.cut_steps, csv);
  box_create(&box, context);
  box_run(&box, (size_t)options.box_steps, csv);
  print_cloud(stdout, &run, &mesh, (size_t)options.steps, (size_t)options.threads, wall);
  print_bodies(stdout, catheters, &fall);
  const change_figures *changes[] = {&scalpel.figures, &beat.figures, &box.figures};
  print_changes(stdout, changes, sizeof changes / sizeof changes[0]);
  print_scalpel(stdout, &scalpel);
  if (options.out != NULL) {
    code = write_files(&run, catheters, &fall, options.out, wall);
    code |=
        beat_write(&beat, options.out, wall == 0) | box_write(&box, options.out) | scalpel_write(&scalpel, options.out);
    code |= fclose(csv) != 0 ? kBadInput : 0;
  }
  int wrong = run.wrong_moves + run.wrong_places + fall.soft.figures.wrong > 0 || !fall.still_free;
  wrong |= scalpel.figures.wrong > 0 || !scalpel.figures.sound;
  wrong |= beat.figures.wrong + box.figures.wrong > 0 || !box.figures.sound;
  for (size_t i = 0; i < kCatheters; ++i) {
    wrong |= catheters[i].figures.wrong > 0;
    catheter_destroy(catheters + i);
  }
  destroy_run(&run);
  fall_destroy(&fall);
  beat_destroy(&beat);
  box_destroy(&box);
  scalpel_destroy(&scalpel);
  require(dsw_environment_destroy(beating), "destroying the environment", kFailed);
  require(dsw_environment_destroy(environment), "destroying the environment", kFailed);
  require(dsw_context_destroy(context), "destroying the context", kFailed);
  surface_free(&surface);
  mesh_free(&mesh);
  mesh_free(&organ);
  return wrong ? kFailed : code;
}
