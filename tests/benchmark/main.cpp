// Runs the parts of the benchmark and writes their figures.
#include "parts.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <exception>

int main(int argc, char** argv) {
  using namespace dsw::bench;
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  Options options;
  std::string json = "benchmark.json";
  const std::vector<std::string> known = {"hex",    "threads",   "kernels",  "tet",      "vessel", "change",
                                          "create", "fig11",     "fig12",    "catheter", "deform", "coarsen",
                                          "cut",    "obstacles", "remesh",   "self",     "plane",  "figure5",
                                          "locate", "near",      "together", "work",     "scale"};
  std::vector<std::string> parts;
  CLI::App app("Dartsweep's benchmark: ours and peers on the same segments.");
  app.add_flag("--quick", options.quick, "Fewer steps and rounds");
  app.add_flag("--long", options.is_long, "Also 1e8 tetrahedra, in 20 GB");
  app.add_option("--json", json, "File to write");
  app.add_option("--vessel", options.vessel, "Mesh converted by read_mesh.py");
  app.add_option("--data", options.data, "Folder with surfaces and vessels");
  app.add_option("--scene", options.scene, "File to write: the scene of fig11");
  app.add_option("--part", parts, "Parts to run; all if not given")->check(CLI::IsMember(known));
  CLI11_PARSE(app, argc, argv);

  Report report;
  Agreement agreement;
  const auto wanted = [&](const std::string& part) {
    const bool chosen = parts.empty() || std::find(parts.begin(), parts.end(), part) != parts.end();
    if (chosen) std::printf("%s\n", part.c_str());
    return chosen;
  };
  try {
    if (wanted("create")) run_create(options, report);
    if (wanted("scale")) run_scale(options, report);
    if (wanted("locate")) run_locate(options, report);
    if (wanted("near")) run_near(options, report);
    if (wanted("near")) run_near_rows(options, report);
    if (wanted("change")) run_change(options, report);
    if (wanted("cut")) run_cut(options, report);
    if (wanted("obstacles")) run_obstacles(options, report);
    if (wanted("self")) {
      run_self(options, report);
      run_knot(report);
    }
    if (wanted("figure5")) run_figure5(options, report);
    if (wanted("work")) run_work(options, report);
    if (wanted("remesh")) run_remesh(options, report);
    if (wanted("plane")) run_plane(options, report);
    if (wanted("kernels")) run_kernels(options, report);
    if (wanted("threads")) run_threads(options, report);
    if (wanted("tet")) run_tet(options, report, agreement);
    if (wanted("vessel")) {
      if (options.vessel.empty()) {
        std::printf("  no data: walk.vessel.* is left out\n");
      } else {
        run_vessel(options, report, agreement);
      }
    }
    if (wanted("coarsen")) run_coarsen(options, report, agreement);
    if (wanted("hex")) run_hex(options, report, agreement);
    if (wanted("fig11")) run_fig11(options, report, agreement);
    if (wanted("fig12")) run_fig12(options, report);
    if (wanted("catheter")) run_catheter(options, report);
    if (wanted("together")) run_together(options, report);
    if (wanted("deform")) run_deform(options, report, agreement);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  agreement.write(report);
  return report.write(json) ? 0 : 1;
}
