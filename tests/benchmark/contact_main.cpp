// Runs the parts that only ask the library and writes their figures.
#include "contact_parts.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <exception>

int main(int argc, char** argv) {
  using namespace dsw::bench;
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  ContactOptions options;
  std::string json = "contact.json";
  std::vector<std::string> parts = {"contact", "response", "beating"};
  CLI::App app("What contacts cost.");
  app.add_flag("--quick", options.quick, "Fewer moves");
  app.add_option("--json", json, "File to write");
  app.add_option("--mesh", options.mesh, "Mesh converted by examples/demo/read_mesh.py");
  app.add_option("--vessel", options.vessel, "Mesh converted by read_mesh.py, for the vessel that beats");
  app.add_option("--line", options.line, "Its centreline");
  app.add_option("--moves", options.moves, "Folder that keeps recorded moves: made again, not recorded again");
  app.add_option("--counted", options.counted, "Only the moves that valgrind is to count")
      ->check(CLI::IsMember({"catheter", "self"}));
  app.add_option("--part", parts, "Parts to run; all if not given")
      ->check(CLI::IsMember({"contact", "response", "beating"}));
  CLI11_PARSE(app, argc, argv);

  Report report;
  try {
    for (const std::string& part : parts) {
      std::printf("%s\n", part.c_str());
      if (part == "contact") run_contact(options, report);
      if (part == "beating" && options.counted.empty()) run_beating(options, report);
      if (part == "response" && options.counted.empty()) run_response(report);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return report.write(json) ? 0 : 1;
}
