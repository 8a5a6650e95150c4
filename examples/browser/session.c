/* The page's scene without a page: browser_session INPUT [OUTPUT]
 *
 * Each line of INPUT is "STEPS PUSH TURN BEAT CUT": so many steps, after a cut if CUT is 1. OUTPUT gets what the page's worker keeps of each
 * step: the numbers of vertices and contacts, then all vertices and contacts with all their bits. Exit code 1: a step failed. 2: bad
 * arguments. */
#include <stdio.h>
#include <stdlib.h>

#include "scene.h"

typedef struct totals {
  size_t steps, contacts, most_contacts, vertices, cuts, cuts_made;
  double tip[3];
} totals;

static void write_state(const scene *s, FILE *output, totals *t) {
  size_t vertices = 0, contacts = 0;
  const double *wire = scene_get_wire(s, &vertices);
  const scene_contact *contact = scene_get_contacts(s, &contacts);
  const uint32_t counts[2] = {(uint32_t)vertices, (uint32_t)contacts};
  int k;
  ++t->steps;
  t->contacts += contacts;
  t->most_contacts = contacts > t->most_contacts ? contacts : t->most_contacts;
  t->vertices = vertices;
  for (k = 0; k < 3; ++k) t->tip[k] = wire[k];
  if (output != NULL) {
    fwrite(counts, sizeof counts[0], 2, output);
    fwrite(wire, 3 * sizeof *wire, vertices, output);
    fwrite(contact, sizeof *contact, contacts, output);
  }
}

static int run(scene *s, FILE *input, FILE *output, totals *t) {
  unsigned long steps;
  double push, turn;
  int beat, cut, read;
  while ((read = fscanf(input, "%lu %lf %lf %d %d", &steps, &push, &turn, &beat, &cut)) == 5) {
    if (cut) {
      ++t->cuts;
      if (scene_cut(s)) {
        ++t->cuts_made;
      } else {
        printf("step %lu: no cut: %s\n", (unsigned long)t->steps, scene_message());
      }
    }
    for (; steps > 0; --steps) {
      if (!scene_step(s, push, turn, beat)) {
        fprintf(stderr, "session: step %lu: %s\n", (unsigned long)t->steps, scene_message());
        return 1;
      }
      write_state(s, output, t);
    }
  }
  if (read != EOF) fprintf(stderr, "session: a line is not STEPS PUSH TURN BEAT CUT\n");
  return read == EOF ? 0 : 2;
}

int main(int argc, char **argv) {
  totals t = {0};
  FILE *input = argc == 2 || argc == 3 ? fopen(argv[1], "r") : NULL;
  FILE *output = argc == 3 ? fopen(argv[2], "wb") : NULL;
  scene *s;
  int code;
  if (input == NULL || (argc == 3 && output == NULL)) {
    fprintf(stderr, "usage: browser_session INPUT [OUTPUT]; a file cannot be opened\n");
    return 2;
  }
  s = scene_create_vessel();
  if (s == NULL) {
    fprintf(stderr, "session: %s\n", scene_message());
    return 1;
  }
  code = run(s, input, output, &t);
  if (code == 0 && t.cuts_made < t.cuts) code = 1;
  printf("%lu steps, %lu vertices at the end, %lu contacts in all, %lu at most in a step, %lu of %lu cuts\n",
         (unsigned long)t.steps, (unsigned long)t.vertices, (unsigned long)t.contacts, (unsigned long)t.most_contacts,
         (unsigned long)t.cuts_made, (unsigned long)t.cuts);
  printf("the tip is at %.17g %.17g %.17g\n", t.tip[0], t.tip[1], t.tip[2]);
  if (output != NULL && fclose(output) != 0) code = 1;
  fclose(input);
  scene_destroy(s);
  return code;
}
