// Error against run time of the two ways to bend an environment.
#include "curves.h"
#include "deform_curves.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <exception>
#include <filesystem>

int main(int argc, char** argv) {
  dsw::curves::Options options;
  CLI::App app("Error against run time of deformations: end state or swept, in how many steps.");
  app.add_flag("--quick", options.quick, "Fewer particles and settings");
  app.add_option("--scale", options.scale, "Factor on the count of particles")->check(CLI::PositiveNumber);
  app.add_option("--out", options.out, "Folder for the tables")->required();
  app.add_option("--seed", options.seed, "Of scenes and particles");
  CLI11_PARSE(app, argc, argv);
  try {
    std::filesystem::create_directories(options.out);
    dsw::curves::deform_curves(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
