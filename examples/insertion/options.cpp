#include "options.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <map>

namespace insertion {
namespace {

constexpr int kBadInput = 2;
constexpr double kMost = 1e12;  // of lengths and speeds

// Defaults of a preset; what was given by hand stays.
void apply_preset(const CLI::App& app, Options* options) {
  const auto is_given = [&](const char* option) { return app.count(option) > 0; };
  if (options->preset == "figure8") return;
  options->vertices = is_given("--vertices") ? options->vertices : 201;
  options->inserts = is_given("--response") ? options->inserts : false;
  const bool for_springs = is_given("--integrator") || is_given("--contact-memory") || is_given("--response");
  options->rod = is_given("--physics") ? options->rod : !for_springs;
  if (options->preset == "haptic") {
    options->slow = true;
    options->statistics = is_given("--statistics") ? options->statistics : false;
    options->contact_memory = is_given("--contact-memory") ? options->contact_memory : 8;
  }
}

}  // namespace

int read_options(int argc, char** argv, Options* options) {
  using physics::Integrator;
  const std::map<std::string, Integrator> integrators = {{"symplectic_euler", Integrator::kSymplecticEuler},
                                                         {"implicit_euler", Integrator::kImplicitEuler},
                                                         {"xpbd", Integrator::kXpbd}};
  const std::map<std::string, dsw_level> levels = {{"edges", DSW_LEVEL_EDGES}, {"edges_swept", DSW_LEVEL_EDGES_SWEPT}};
  const std::map<std::string, bool> kinds = {{"springs", false}, {"rod", true}};
  const std::map<std::string, bool> responses = {{"insert", true}, {"slide", false}};
  const CLI::Validator number(  // ranges let NaN pass
      [](std::string& text) {
        return std::isnan(std::strtod(text.c_str(), nullptr)) ? "'" + text + "' is no number" : std::string();
      },
      "");
  options->preset = "rod";
  CLI::App app("Pushes a catheter through a network of vessels and proves after every step that it is free.",
               "dartsweep_insertion");
  app.add_option(
         "--preset", options->preset,
         "rod: 201 vertices; figure8: 20 vertices of springs, edges get new ones where they touch; haptic: the rod at "
         "the speed of a hand, no statistics")
      ->check(CLI::IsMember({"rod", "figure8", "haptic"}));
  app.add_option("--mesh", options->mesh, "arrays that examples/demo/read_mesh.py made of a mesh")
      ->check(CLI::ExistingFile);
  app.add_option("--spacing", options->spacing, "of the generated vessel, mm")
      ->check(number)
      ->check(CLI::Range(0.6, 2.5));
  app.add_option("--source", options->source, "what to call the mesh");
  app.add_option("--unit", options->unit, "unit of length of the mesh; it is only printed");
  app.add_option("--out", options->out, "folder for tables, frames and .vtu files")->check(CLI::ExistingDirectory);
  app.add_option("--record", options->record, "file for a recording of every call, which dartsweep_replay makes again");
  app.add_option("--steps", options->steps, "time steps")->check(CLI::Range(1, 10000000));
  app.add_option("--dt", options->dt, "length of a time step, s")->check(number)->check(CLI::Range(1e-6, 1.0));
  app.add_option("--vertices", options->vertices, "of the catheter when all of it is in")->check(CLI::Range(2, 5000));
  app.add_option("--link", options->link, "distance of two vertices, units of the mesh; 0: half of the way for all")
      ->check(number)
      ->check(CLI::Range(0.0, kMost));
  app.add_option("--speed", options->speed, "of the hand, units a second; 0: to the end of the way in all steps")
      ->check(number)
      ->check(CLI::Range(0.0, kMost));
  app.add_option("--friction", options->friction, "coefficient")->check(number)->check(CLI::Range(0.0, 100.0));
  app.add_option("--physics", options->rod, "springs or rod; the rod has its own integrator, and slides")
      ->transform(CLI::CheckedTransformer(kinds));
  app.add_option("--integrator", options->integrator, "symplectic_euler, implicit_euler or xpbd")
      ->transform(CLI::CheckedTransformer(integrators));
  app.add_option("--level", options->level, "edges or edges_swept")->transform(CLI::CheckedTransformer(levels));
  app.add_option("--response", options->inserts, "of edges that touch: insert a vertex where there is room, or slide")
      ->transform(CLI::CheckedTransformer(responses));
  app.add_option("--contact-memory", options->contact_memory,
                 "steps for which a contact that presses stays a constraint")
      ->check(CLI::Range(0, 100));
  app.add_option("--route", options->route, "0: to the farthest end of a branch, 1: to the next, ...");
  app.add_option("--frames", options->frames, "states that are written, evenly spaced")->check(CLI::Range(1, 100000));
  app.add_flag("--statistics,!--no-statistics", options->statistics, "count cells and orientation tests");
  app.add_flag("--progress", options->progress, "a progress bar also where stderr is no terminal");
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    std::cerr << "insertion: " << error.what() << "\nRun with --help for more.\n";
    return kBadInput;
  }
  apply_preset(app, options);
  return -1;
}

}  // namespace insertion
