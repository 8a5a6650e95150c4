/* The main job: a cloud of particles flows and catheters are pushed through the lumen of a vessel; a closed surface
 * falls among pyramids. Every move ends at its target or at the first thing in the way, exactly; independent passes
 * prove that nothing went through. */
#include <dartsweep/dartsweep.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "catheter.h"
#include "fall.h"
#include "mesh.h"
#include "output.h"
#include "run.h"

enum { kCatheters = 3 };

typedef struct demo_options {
  const char *mesh, *out, *surface;
  double spacing;
  long particles, steps, fall_steps, threads;
} demo_options;

/* The wall: faces between the lumen and any other region, or those that the mesh names. */
static size_t mark_wall(dsw_environment *environment, const demo_mesh *mesh) {
  size_t marked = 0;
  if (mesh->lumen != 0) {
    int32_t least = 0x7fffffff, most = -0x7fffffff;
    for (size_t i = 0; i < mesh->cell_count; ++i) {
      least = mesh->regions[i] < least ? mesh->regions[i] : least;
      most = mesh->regions[i] > most ? mesh->regions[i] : most;
    }
    for (int32_t other = least; other <= most; ++other) {
      size_t faces = 0;
      if (other != mesh->lumen) {
        require(dsw_environment_mark_between(environment, mesh->lumen, other, DSW_MARK_IMPASSABLE, &faces),
                "marking the wall", kFailed);
      }
      marked += faces;
    }
  } else if (mesh->wall_count > 0) {
    size_t missing = 0;
    dsw_face_id *faces = (dsw_face_id *)demo_allocate(mesh->wall_count, sizeof(dsw_face_id));
    require(dsw_environment_find_faces(environment, mesh->wall_count, mesh->wall_offsets, mesh->wall_points, faces,
                                       &missing),
            "finding the faces of the wall", kBadInput);
    for (size_t i = 0; i < mesh->wall_count; ++i) {
      if (faces[i].generation != 0) {
        faces[marked++] = faces[i];
      }
    }
    require(dsw_environment_mark_faces(environment, faces, marked, DSW_MARK_IMPASSABLE), "marking the wall", kFailed);
    free(faces);
    if (missing > 0) {
      fprintf(stderr, "demo: %lu faces of the wall belong to no cell and were left out\n", (unsigned long)missing);
    }
  }
  return marked;
}

static dsw_environment *create_environment(dsw_context *context, const demo_mesh *mesh) {
  dsw_environment_desc desc;
  dsw_environment *environment = NULL;
  dsw_environment_desc_init(&desc, sizeof desc);
  desc.points = mesh->points;
  desc.point_count = mesh->point_count;
  desc.cell_types = mesh->types;
  desc.cell_count = mesh->cell_count;
  desc.offsets = mesh->offsets;
  desc.connectivity = mesh->connectivity;
  desc.connectivity_count = mesh->connectivity_count;
  desc.regions = mesh->regions;
  desc.flags = DSW_ENVIRONMENT_REORIENT | DSW_ENVIRONMENT_LOCATE_GRID;
  require(dsw_environment_create(context, &desc, &environment, NULL), "the mesh cannot be used", kBadInput);
  return environment;
}

static void print_table(FILE *out, const demo_run *run, const demo_mesh *mesh, const demo_options *options,
                        size_t wall) {
  dsw_environment_info info;
  dsw_statistics s;
  info.struct_size = sizeof info;
  s.struct_size = sizeof s;
  require(dsw_environment_get_info(run->environment, &info), "reading the environment", kFailed);
  require(dsw_scene_get_statistics(run->scene, &s), "reading the statistics", kFailed);
  double casts = s.casts > 0 ? (double)s.casts : 1, moves = (double)run->cloud * (double)options->steps;
  int proven = run->wrong_moves + run->wrong_places == 0;
  fprintf(out, "\n  environment                 %12lu volumes, %lu points\n", (unsigned long)info.volume_count,
          (unsigned long)info.vertex_count);
  fprintf(out, "  lumen                       %12lu volumes%s\n", (unsigned long)run->flow.count,
          mesh->lumen == 0 ? " (no region is named lumen: all in reach)" : "");
  fprintf(out, "  radius of the lumen, about  %12.3g\n", run->flow.radius);
  fprintf(out, "  wall                        %12lu faces%s\n",
          (unsigned long)(wall > 0 ? wall : info.boundary_face_count), wall > 0 ? "" : " (the outer boundary)");
  fprintf(out, "  memory of the environment   %12.1f bytes per volume\n",
          (double)info.memory_bytes / (double)info.volume_count);
  fprintf(out, "  particles, steps            %12lu x %ld\n", (unsigned long)run->cloud, options->steps);
  fprintf(out, "  -----------------------------------------------------------------\n");
  fprintf(out, "  casts                       %12.0f\n", (double)s.casts);
  fprintf(out, "  contacts                    %12.0f\n", (double)s.contacts);
  fprintf(out, "  cells visited per cast      %12.2f\n", (double)s.cells_visited / casts);
  fprintf(out, "  orientation tests per cast  %12.2f\n", (double)s.orientation_tests / casts);
  fprintf(out, "  exact fallbacks             %12.0f (%.4f %% of the tests)\n", (double)s.exact_fallbacks,
          s.orientation_tests > 0 ? 100.0 * (double)s.exact_fallbacks / (double)s.orientation_tests : 0.0);
  fprintf(out, "  us per particle move        %12.3f (%ld thread%s)\n", 1e6 * run->move_seconds / moves,
          options->threads, options->threads == 1 ? "" : "s");
  fprintf(out, "  verified free               %12s", proven ? "yes" : "no");
  if (proven) {
    fprintf(out, " (%.0f moves cast again, %lu places found again)\n", moves, (unsigned long)run->cloud);
  } else {
    fprintf(out, " (%lu moves and %lu places are wrong)\n", (unsigned long)run->wrong_moves,
            (unsigned long)run->wrong_places);
  }
}

static void print_row(FILE *out, const char *what, const body_figures *const *runs, size_t count, size_t offset) {
  fprintf(out, "  %-26s", what);
  for (size_t i = 0; i < count; ++i) {
    fprintf(out, "  %12lu", (unsigned long)*(const size_t *)((const char *)runs[i] + offset));
  }
  fputc('\n', out);
}

static void print_bodies(FILE *out, const demo_catheter *catheters, const demo_fall *fall) {
  const body_figures *runs[kCatheters + 1];
  dsw_statistics s;
  const size_t n = kCatheters + 1;
  s.struct_size = sizeof s;
  require(dsw_scene_get_statistics(fall->scene, &s), "reading the statistics", kFailed);
  for (size_t i = 0; i < n; ++i) {
    runs[i] = i < kCatheters ? &catheters[i].figures : &fall->figures;
  }
  fprintf(out, "\n  %-26s", "catheters and surface");
  for (size_t i = 0; i < n; ++i) {
    fprintf(out, "  %12s", runs[i]->name);
  }
  fprintf(out, "\n  vertices at the end       ");
  for (size_t i = 0; i < kCatheters; ++i) {
    fprintf(out, "  %12lu", (unsigned long)catheters[i].count);
  }
  fprintf(out, "  %12lu\n", (unsigned long)fall->surface->point_count);
  print_row(out, "steps", runs, n, offsetof(body_figures, steps));
  print_row(out, "vertices moved", runs, n, offsetof(body_figures, moved));
  print_row(out, "of these stopped", runs, n, offsetof(body_figures, stopped));
  print_row(out, "contacts of bodies", runs, n, offsetof(body_figures, contacts));
  print_row(out, "of these lasting", runs, n, offsetof(body_figures, lasting));
  print_row(out, "vertices inserted", runs, n, offsetof(body_figures, inserted));
  print_row(out, "vertices removed", runs, n, offsetof(body_figures, removed));
  fprintf(out, "  way of the tip, of %-7.4g", catheters[0].whole);
  for (size_t i = 0; i < kCatheters; ++i) {
    fprintf(out, "  %12.4g", catheters[i].reached);
  }
  fprintf(out, "\n  ms per step               ");
  for (size_t i = 0; i < n; ++i) {
    fprintf(out, "  %12.3f", 1e3 * runs[i]->seconds / (double)runs[i]->steps);
  }
  fprintf(out, "\n  ms of the slowest step    ");
  for (size_t i = 0; i < n; ++i) {
    fprintf(out, "  %12.3f", 1e3 * runs[i]->slowest);
  }
  fprintf(out, "\n  bodies verified free      ");
  for (size_t i = 0; i < n; ++i) {
    fprintf(out, "  %12s", runs[i]->wrong == 0 && (i < kCatheters || fall->still_free) ? "yes" : "no");
  }
  fprintf(out, "\n\n  pyramids                    %12lu, %lu of them impassable\n", (unsigned long)fall->cells,
          (unsigned long)fall->impassable);
  fprintf(out, "  cells visited in a step     %12.0f (by the surface's casts; at level FACES)\n",
          (double)s.cells_visited / (double)fall->figures.steps);
}

static int write_trace(const dsw_environment *environment, const char *out, const char *name, int with_boundary) {
  dsw_trace *trace = NULL;
  dsw_trace_data data;
  data.struct_size = sizeof data;
  require(dsw_trace_create(NULL, &trace), "creating a trace", kFailed);
  require(dsw_trace_add_impassable(trace, environment, with_boundary, 0), "tracing the wall", kFailed);
  require(dsw_trace_get(trace, &data), "reading a trace", kFailed);
  int code = vtu_write(out, name, data.points, data.point_count, data.triangles, 3, data.triangle_count, NULL, 0);
  require(dsw_trace_destroy(trace), "destroying a trace", kFailed);
  return code;
}

static vtu_field field(const char *name, const double *values, int components) {
  vtu_field f;
  f.name = name;
  f.values = values;
  f.components = components;
  return f;
}

/* Dots with a normal each. */
static int write_touches(const char *out, const char *name, const double *points, const double *normals, size_t count) {
  vtu_field normal = field("normal", normals, 3);
  return vtu_write(out, name, points, count, NULL, 0, 0, &normal, 1);
}

static int write_files(const demo_run *run, const demo_catheter *catheters, const demo_fall *fall, const char *out,
                       size_t wall) {
  uint32_t links[2 * kMostLinks];
  char name[64];
  vtu_field cloud[2], touched = field("contacts", fall->touched, 1);
  cloud[0] = field("contacts", run->contacts, 1);
  cloud[1] = field("last_contact_normal", run->last_normal, 3);
  for (uint32_t i = 0; i < 2 * kMostLinks; ++i) {
    links[i] = (i + 1) / 2;
  }
  int code = vtu_write(out, "demo.vtu", run->position, run->cloud, NULL, 0, 0, cloud, 2);
  code |= write_touches(out, "contacts.vtu", run->touch, run->touch_normal, run->touch_count);
  code |= write_trace(run->environment, out, "wall.vtu", wall == 0);
  code |= write_trace(run->environment, out, "outer.vtu", 1);
  for (size_t i = 0; i < kCatheters; ++i) {
    const demo_catheter *c = catheters + i;
    vtu_field inserted = field("inserted", c->inserted, 1);
    sprintf(name, "catheter_%s.vtu", c->figures.name);
    code |= vtu_write(out, name, c->at, c->count, links, 2, c->count - 1, &inserted, 1);
    sprintf(name, "catheter_%s_contacts.vtu", c->figures.name);
    code |= write_touches(out, name, c->figures.touch, c->figures.normal, c->figures.touch_count);
  }
  code |= vtu_write(out, "surface.vtu", fall->surface->points, fall->surface->point_count, fall->surface->corners, 3,
                    fall->surface->triangle_count, &touched, 1);
  code |=
      write_touches(out, "surface_contacts.vtu", fall->figures.touch, fall->figures.normal, fall->figures.touch_count);
  code |= write_trace(fall->environment, out, "obstacles.vtu", 0);
  return code;
}

static int usage(const char *wrong) {
  fprintf(stderr,
          "demo: cannot use '%s'\n"
          "usage: dartsweep_demo [--mesh FILE] [--spacing MM] [--particles N] [--steps N] [--surface FILE.obj] "
          "[--fall-steps N] [--threads N] [--out FOLDER]\n",
          wrong);
  return kBadInput;
}

static int read_options(int argc, char **argv, demo_options *options) {
  options->mesh = NULL;
  options->out = NULL;
  options->surface = NULL;
  options->spacing = 1.3;
  options->particles = 10000;
  options->steps = 300;
  options->fall_steps = 120;
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
    } else if (is_number && strcmp(name, "--spacing") == 0) {
      options->spacing = number;
    } else if (is_count && strcmp(name, "--particles") == 0) {
      options->particles = (long)number;
    } else if (is_count && strcmp(name, "--steps") == 0) {
      options->steps = (long)number;
    } else if (is_count && strcmp(name, "--fall-steps") == 0) {
      options->fall_steps = (long)number;
    } else if (is_count && number <= 256 && strcmp(name, "--threads") == 0) {
      options->threads = (long)number;
    } else {
      return usage(value == NULL ? name : is_number ? value : name);
    }
  }
  return 0;
}

/* The same catheter with three responses of its edges. */
static void run_catheters(demo_catheter *catheters, const demo_run *run, size_t steps, FILE *csv) {
  static const struct {
    const char *name;
    dsw_response response;
  } kRuns[kCatheters] = {
      {"static", DSW_RESPONSE_STOP}, {"adaptive", DSW_RESPONSE_ADAPTIVE_MANY}, {"slide", DSW_RESPONSE_SLIDE}};
  for (size_t i = 0; i < kCatheters; ++i) {
    catheter_run(catheters + i, run->environment, &run->flow, kRuns[i].name, kRuns[i].response, steps, csv);
  }
}

int main(int argc, char **argv) {
  static demo_catheter catheters[kCatheters];
  demo_options options;
  demo_mesh mesh;
  demo_surface surface;
  demo_run run;
  demo_fall fall;
  dsw_context *context = NULL;
  dsw_context_desc desc;
  FILE *csv = NULL;
  int code = read_options(argc, argv, &options);
  memset(&mesh, 0, sizeof mesh);
  memset(&surface, 0, sizeof surface);
  if (code == 0 && options.surface != NULL) {
    code = surface_read(options.surface, &surface);
  } else if (code == 0) {
    surface_make_ring(120, 100, &surface);
  }
  if (code == 0) {
    code = options.mesh != NULL ? mesh_read(options.mesh, &mesh) : mesh_make_vessel(options.spacing, &mesh);
  }
  if (code == 0 && options.out != NULL) {
    csv = open_steps(options.out);
    code = csv == NULL ? kBadInput : 0;
  }
  if (code != 0) {
    surface_free(&surface);
    mesh_free(&mesh);
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
  fall_create(&fall, context, &surface);
  fall_run(&fall, (size_t)options.fall_steps, csv);
  print_table(stdout, &run, &mesh, &options, wall);
  print_bodies(stdout, catheters, &fall);
  if (options.out != NULL) {
    code = write_files(&run, catheters, &fall, options.out, wall);
    code |= fclose(csv) != 0 ? kBadInput : 0;
  }
  int wrong = run.wrong_moves + run.wrong_places + fall.figures.wrong > 0 || !fall.still_free;
  for (size_t i = 0; i < kCatheters; ++i) {
    wrong |= catheters[i].figures.wrong > 0;
    catheter_destroy(catheters + i);
  }
  destroy_run(&run);
  fall_destroy(&fall);
  require(dsw_environment_destroy(environment), "destroying the environment", kFailed);
  require(dsw_context_destroy(context), "destroying the context", kFailed);
  surface_free(&surface);
  mesh_free(&mesh);
  return wrong ? kFailed : code;
}
