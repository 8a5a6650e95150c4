// Error against run time: every curve is a table of points, errors are against exact rationals.
#include "curves.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <exception>
#include <filesystem>

int main(int argc, char** argv) {
  using namespace dsw::curves;
  const struct {
    const char* name;
    void (*run)(const Options&);
  } groups[] = {{"time", time_curves},  {"levels", level_curves},      {"pairs", pair_curves},
                {"casts", cast_curves}, {"sampling", sampling_curves}, {"elimination", elimination_curve},
                {"slide", slide_curves}};
  std::vector<std::string> known = {"all"}, wanted;
  for (const auto& group : groups) known.push_back(group.name);
  Options options;
  CLI::App app("Error against run time of the dials of detection, and of peers.");
  app.add_option("--curve", wanted, "Groups of curves to measure; all if not given")->check(CLI::IsMember(known));
  app.add_flag("--quick", options.quick, "Fewer items and rounds");
  app.add_option("--scale", options.scale, "Factor on all counts")->check(CLI::PositiveNumber);
  app.add_option("--out", options.out, "Folder for the tables")->required();
  app.add_option("--seed", options.seed, "Of scenes and queries");
  CLI11_PARSE(app, argc, argv);
  const auto asked = [&](const std::string& name) {
    return wanted.empty() || std::find(wanted.begin(), wanted.end(), "all") != wanted.end() ||
           std::find(wanted.begin(), wanted.end(), name) != wanted.end();
  };
  try {
    std::filesystem::create_directories(options.out);
    for (const auto& group : groups) {
      if (asked(group.name)) group.run(options);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
