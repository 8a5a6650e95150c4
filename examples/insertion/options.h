// What the program is asked to do.
#ifndef DARTSWEEP_INSERTION_OPTIONS_H
#define DARTSWEEP_INSERTION_OPTIONS_H

#include <string>

#include "catheter.h"

namespace insertion {

struct Options {
  std::string preset = "figure8";  // of which the defaults below are; the program's own preset is "rod"
  std::string mesh;                // empty: the generated vessel
  // All links are in after half of the steps, then the hand goes slowly: 5 radii of the lumen a second.
  bool slow = false;
  double spacing = 1.3;  // of the generated vessel
  std::string source;    // what to call the mesh; empty: the file's name
  std::string unit = "mm";
  std::string out;     // folder; empty: nothing is written
  std::string record;  // file; empty: the scene is not recorded
  std::size_t steps = 10000;
  double dt = 1e-3;
  std::size_t vertices = 20;
  double link = 0;         // 0: half of the route for all links, at most three radii of the lumen
  double speed = 0;        // 0: the tip comes to the end of the route in the last step, if nothing holds it up
  double friction = 0.04;  // of a coated catheter
  bool rod = false;        // physics of bindings/rod in place of springs
  physics::Integrator integrator = physics::Integrator::kImplicitEuler;
  dsw_level level = DSW_LEVEL_EDGES_SWEPT;
  bool inserts = true;     // edges that touch get new vertices where there is room; else they only slide
  int contact_memory = 0;  // steps, see physics::SoftBodyOptions
  std::size_t route = 0;   // to the farthest end, the next one ...
  std::size_t frames = 500;
  bool statistics = true;
  bool progress = false;  // the bar also where stderr is no terminal
};

// Returns -1 where the program is to go on, else its exit code: 0 after --help, 2 with a message for what can't be used.
int read_options(int argc, char** argv, Options* options);

}  // namespace insertion

#endif
