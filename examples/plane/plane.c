/* Scenes of the plane, drawn: dartsweep_plane DIRECTORY */
#include <stdio.h>

#include "bends.h"
#include "city.h"
#include "corridor.h"

static int print(const char *name, scene_figures figures) {
  printf("plane.%s.steps %lu\nplane.%s.exactly_free_steps %lu\nplane.%s.contacts %lu\nplane.%s.inserted %lu\n", name,
         (unsigned long)figures.steps, name, (unsigned long)figures.free_steps, name, (unsigned long)figures.contacts,
         name, (unsigned long)figures.inserted);
  return figures.free_steps == figures.steps && figures.contacts != 0;
}

int main(int argument_count, char **arguments) {
  const char *const directory = argument_count == 2 ? arguments[1] : ".";
  int good;
  if (argument_count > 2) {
    fprintf(stderr, "usage: %s [DIRECTORY]\n", arguments[0]);
    return 2;
  }
  good = print("city", draw_city(directory));
  good = print("rope", draw_rope(directory)) && good;
  good = draw_edges(directory) && good;
  good = draw_bends(directory) && good;
  return good ? 0 : 1;
}
