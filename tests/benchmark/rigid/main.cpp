// Rigid moves against exact arithmetic, their cost, and FCL beside them.
#include <CLI/CLI.hpp>

#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "parts.h"

int main(int argc, char** argv) {
  using namespace dsw::rigid;
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  Options options;
  bool is_long = false;
  std::string json = "rigid.json";
  std::vector<std::string> parts = {"moves", "slides", "thick", "cost", "free", "fcl"};
  CLI::App app("Rigid moves against exact arithmetic, what they cost, and FCL beside them.");
  app.add_flag("--long", is_long, "As many moves as the figures ask for: hours");
  auto* const moves = app.add_option("--moves", options.moves, "Moves against rational arithmetic");
  auto* const thick = app.add_option("--thick", options.thick, "Moves of thick bodies");
  auto* const bodies = app.add_option("--bodies", options.bodies, "Bodies whose moves are timed");
  auto* const fcl = app.add_option("--fcl", options.fcl, "Motions of each shape beside FCL");
  app.add_option("--seed", options.seed, "Of all of them");
  app.add_option("--print", options.print, "Faults of --moves to print at most");
  app.add_option("--only", options.only, "Looks at one of --moves, and prints it");
  app.add_option("--json", json, "File to write");
  app.add_option("--part", parts, "Parts to run; all if not given")
      ->check(CLI::IsMember({"moves", "slides", "thick", "cost", "free", "fcl"}));
  CLI11_PARSE(app, argc, argv);
  if (is_long) {
    if (moves->count() == 0) options.moves = 100000;
    if (thick->count() == 0) options.thick = 100000;
    if (bodies->count() == 0) options.bodies = 1000;
    if (fcl->count() == 0) options.fcl = 10000;
  }
  Report report;
  bool is_right = true;
  try {
    for (const std::string& part : parts) {
      std::printf("%s\n", part.c_str());
      if (part == "moves") is_right = run_moves(options, report) && is_right;
      if (part == "slides") is_right = run_slides(options, report) && is_right;
      if (part == "thick") is_right = run_thick(options, report) && is_right;
      if (part == "cost") run_cost(options, report);
      if (part == "free") run_free(options, report);
      if (part == "fcl") run_fcl(options, report);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "rigid: %s\n", error.what());
    return 2;
  }
  if (!report.write(json)) return 2;
  return is_right ? 0 : 1;
}
