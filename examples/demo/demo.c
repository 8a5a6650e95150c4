/* The main job, first form: a cloud of particles and a chain flow through the lumen of a vessel. Every move ends at
 * its target or at the first wall, exactly; at the end an independent pass proves that nothing went through. */
#include <dartsweep/dartsweep.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "mesh.h"
#include "output.h"
#include "run.h"

typedef struct demo_options {
  const char *mesh, *out;
  double spacing;
  long particles, steps, threads;
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
  fprintf(out, "  particles, steps            %12lu x %ld, and a chain of %d\n", (unsigned long)run->cloud,
          options->steps, (int)kChain);
  fprintf(out, "  -----------------------------------------------------------------\n");
  fprintf(out, "  casts                       %12.0f\n", (double)s.casts);
  fprintf(out, "  contacts                    %12.0f\n", (double)s.contacts);
  fprintf(out, "  chain: links cast, blocked  %12lu, %lu\n", (unsigned long)run->edge_casts,
          (unsigned long)run->edge_contacts);
  fprintf(out, "  cells visited per cast      %12.2f\n", (double)s.cells_visited / casts);
  fprintf(out, "  orientation tests per cast  %12.2f\n", (double)s.orientation_tests / casts);
  fprintf(out, "  exact fallbacks             %12.0f (%.4f %% of the tests)\n", (double)s.exact_fallbacks,
          s.orientation_tests > 0 ? 100.0 * (double)s.exact_fallbacks / (double)s.orientation_tests : 0.0);
  fprintf(out, "  us per particle move        %12.3f (%ld thread%s)\n", 1e6 * run->move_seconds / moves,
          options->threads, options->threads == 1 ? "" : "s");
  fprintf(out, "  verified free               %12s", proven ? "yes" : "no");
  if (proven) {
    fprintf(out, " (%.0f moves cast again, %lu places found again)\n", moves + (double)kChain * (double)options->steps,
            (unsigned long)run->count);
  } else {
    fprintf(out, " (%lu moves and %lu places are wrong)\n", (unsigned long)run->wrong_moves,
            (unsigned long)run->wrong_places);
  }
}

static int write_trace(const demo_run *run, const char *out, const char *name, int with_boundary) {
  dsw_trace *trace = NULL;
  dsw_trace_data data;
  data.struct_size = sizeof data;
  require(dsw_trace_create(NULL, &trace), "creating a trace", kFailed);
  require(dsw_trace_add_impassable(trace, run->environment, with_boundary, 0), "tracing the wall", kFailed);
  require(dsw_trace_get(trace, &data), "reading a trace", kFailed);
  int code = vtu_write(out, name, data.points, data.point_count, data.triangles, 3, data.triangle_count, NULL, 0);
  require(dsw_trace_destroy(trace), "destroying a trace", kFailed);
  return code;
}

static int write_files(const demo_run *run, const char *out, size_t wall) {
  uint32_t links[2 * (kChain - 1)];
  vtu_field cloud[2], touch[1];
  cloud[0].name = "contacts";
  cloud[0].values = run->contacts;
  cloud[0].components = 1;
  cloud[1].name = "last_contact_normal";
  cloud[1].values = run->last_normal;
  cloud[1].components = 3;
  touch[0].name = "normal";
  touch[0].values = run->touch_normal;
  touch[0].components = 3;
  for (uint32_t i = 0; i + 1 < kChain; ++i) {
    links[2 * i] = i;
    links[2 * i + 1] = i + 1;
  }
  int code = vtu_write(out, "demo.vtu", run->position, run->cloud, NULL, 0, 0, cloud, 2);
  code |= vtu_write(out, "chain.vtu", run->position + 3 * run->cloud, kChain, links, 2, kChain - 1, NULL, 0);
  code |= vtu_write(out, "contacts.vtu", run->touch, run->touch_count, NULL, 0, 0, touch, 1);
  code |= write_trace(run, out, "wall.vtu", wall == 0);
  code |= write_trace(run, out, "outer.vtu", 1);
  return code;
}

static int usage(const char *wrong) {
  fprintf(stderr,
          "demo: cannot use '%s'\n"
          "usage: dartsweep_demo [--mesh FILE] [--spacing MM] [--particles N] [--steps N] [--threads N] "
          "[--out FOLDER]\n",
          wrong);
  return kBadInput;
}

static int read_options(int argc, char **argv, demo_options *options) {
  options->mesh = NULL;
  options->out = NULL;
  options->spacing = 1.3;
  options->particles = 10000;
  options->steps = 300;
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
    } else if (is_number && strcmp(name, "--spacing") == 0) {
      options->spacing = number;
    } else if (is_count && strcmp(name, "--particles") == 0) {
      options->particles = (long)number;
    } else if (is_count && strcmp(name, "--steps") == 0) {
      options->steps = (long)number;
    } else if (is_count && number <= 256 && strcmp(name, "--threads") == 0) {
      options->threads = (long)number;
    } else {
      return usage(value == NULL ? name : is_number ? value : name);
    }
  }
  return 0;
}

int main(int argc, char **argv) {
  demo_options options;
  demo_mesh mesh;
  demo_run run;
  dsw_context *context = NULL;
  dsw_context_desc desc;
  int code = read_options(argc, argv, &options);
  if (code == 0) {
    code = options.mesh != NULL ? mesh_read(options.mesh, &mesh) : mesh_make_vessel(options.spacing, &mesh);
  }
  if (code != 0) {
    return code;
  }
  dsw_context_desc_init(&desc, sizeof desc);
  desc.thread_count = (uint32_t)options.threads;
  require(dsw_context_create(&desc, &context), "creating a context", kFailed);
  dsw_environment *environment = create_environment(context, &mesh);
  size_t wall = mark_wall(environment, &mesh);
  create_run(&run, environment, &mesh, (size_t)options.particles);
  drive(&run, (size_t)options.steps);
  print_table(stdout, &run, &mesh, &options, wall);
  if (options.out != NULL) {
    code = write_files(&run, options.out, wall);
  }
  if (run.wrong_moves + run.wrong_places > 0) {
    code = kFailed;
  }
  destroy_run(&run);
  require(dsw_environment_destroy(environment), "destroying the environment", kFailed);
  require(dsw_context_destroy(context), "destroying the context", kFailed);
  mesh_free(&mesh);
  return code;
}
