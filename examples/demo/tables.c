#include "tables.h"

#include <stddef.h>

void print_cloud(FILE *out, const demo_run *run, const demo_mesh *mesh, size_t steps, size_t threads, size_t wall) {
  dsw_environment_info info;
  dsw_statistics s;
  info.struct_size = sizeof info;
  s.struct_size = sizeof s;
  require(dsw_environment_get_info(run->environment, &info), "reading the environment", kFailed);
  require(dsw_scene_get_statistics(run->scene, &s), "reading the statistics", kFailed);
  double casts = s.casts > 0 ? (double)s.casts : 1, moves = (double)run->cloud * (double)steps;
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
  fprintf(out, "  particles, steps            %12lu x %lu\n", (unsigned long)run->cloud, (unsigned long)steps);
  fprintf(out, "  -----------------------------------------------------------------\n");
  fprintf(out, "  casts                       %12.0f\n", (double)s.casts);
  fprintf(out, "  contacts                    %12.0f\n", (double)s.contacts);
  fprintf(out, "  cells visited per cast      %12.2f\n", (double)s.volumes_visited / casts);
  fprintf(out, "  orientation tests per cast  %12.2f\n", (double)s.orientation_tests / casts);
  fprintf(out, "  exact fallbacks             %12.0f (%.4f %% of the tests)\n", (double)s.exact_fallbacks,
          s.orientation_tests > 0 ? 100.0 * (double)s.exact_fallbacks / (double)s.orientation_tests : 0.0);
  fprintf(out, "  us per particle move        %12.3f (%lu thread%s)\n", 1e6 * run->move_seconds / moves,
          (unsigned long)threads, threads == 1 ? "" : "s");
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

void print_bodies(FILE *out, const demo_catheter *catheters, const demo_fall *fall) {
  const body_figures *runs[kCatheters + 1];
  dsw_statistics s;
  const size_t n = kCatheters + 1;
  s.struct_size = sizeof s;
  require(dsw_scene_get_statistics(fall->scene, &s), "reading the statistics", kFailed);
  for (size_t i = 0; i < n; ++i) {
    runs[i] = i < kCatheters ? &catheters[i].figures : &fall->soft.figures;
  }
  fprintf(out, "\n  %-26s", "catheters and surface");
  for (size_t i = 0; i < n; ++i) {
    fprintf(out, "  %12s", runs[i]->name);
  }
  fprintf(out, "\n  vertices at the end       ");
  for (size_t i = 0; i < kCatheters; ++i) {
    fprintf(out, "  %12lu", (unsigned long)catheters[i].count);
  }
  fprintf(out, "  %12lu\n", (unsigned long)fall->soft.surface->point_count);
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
          (double)s.volumes_visited / (double)fall->soft.figures.steps);
}

static void print_words(FILE *out, const char *what, const char *const *words, size_t count) {
  fprintf(out, "  %-26s", what);
  for (size_t i = 0; i < count; ++i) {
    fprintf(out, "  %12s", words[i]);
  }
  fputc('\n', out);
}

static void print_values(FILE *out, const char *what, const double *values, size_t count, int digits) {
  fprintf(out, "  %-26s", what);
  for (size_t i = 0; i < count; ++i) {
    fprintf(out, "  %12.*f", digits, values[i]);
  }
  fputc('\n', out);
}

void print_changes(FILE *out, const change_figures *const *changes, size_t count) {
  static const struct {
    const char *what;
    int digits;
  } kRows[] = {{"volumes at the end", 0},  {"cuts or deformations", 0}, {"ms for each change", 3},
               {"ms of the slowest", 3},   {"contacts of walls", 0},    {"vertices pushed", 0},
               {"wall vertices held", 0},  {"vertices of bodies", 0},   {"moves of bodies", 0},
               {"ms for each move", 3},    {"contacts of bodies", 0},   {"of these with bodies", 0},
               {"proofs of being free", 0}};
  enum { kRowCount = sizeof kRows / sizeof kRows[0] };
  const char *names[kMostChanges], *proven[kMostChanges], *sound[kMostChanges];
  double values[kRowCount][kMostChanges];
  for (size_t i = 0; i < count; ++i) {
    const change_figures *c = changes[i];
    const double column[kRowCount] = {(double)c->volumes,
                                      (double)c->steps,
                                      1e3 * c->seconds / (double)c->steps,
                                      1e3 * c->slowest,
                                      (double)c->contacts,
                                      (double)c->pushed,
                                      (double)c->held,
                                      (double)c->body_vertices,
                                      (double)c->moves,
                                      1e3 * c->move_seconds / (double)c->moves,
                                      (double)c->body_contacts,
                                      (double)c->met,
                                      (double)c->proofs};
    for (size_t row = 0; row < kRowCount; ++row) {
      values[row][i] = column[row];
    }
    names[i] = c->name;
    proven[i] = c->wrong == 0 ? "yes" : "no";
    sound[i] = c->sound ? "yes" : "no";
  }
  fputc('\n', out);
  print_words(out, "environments that change", names, count);
  for (size_t row = 0; row < kRowCount; ++row) {
    print_values(out, kRows[row].what, values[row], count, kRows[row].digits);
  }
  print_words(out, "free after every step", proven, count);
  print_words(out, "all volumes valid", sound, count);
}

void print_scalpel(FILE *out, const demo_scalpel *scalpel) {
  fprintf(out, "\n  tissue                      %12lu volumes, %lu split by the scalpel, %lu of it taken out\n",
          (unsigned long)scalpel->tissue_volumes, (unsigned long)scalpel->split, (unsigned long)scalpel->opened);
  fprintf(out, "  floor of the cut            %12.4g below the surface; the probe touches at %.4g\n", scalpel->depth,
          scalpel->reached);
}
