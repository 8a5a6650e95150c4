// The parts of the benchmark. Each adds its figures to the report.
#ifndef DARTSWEEP_TESTS_BENCHMARK_PARTS_H
#define DARTSWEEP_TESTS_BENCHMARK_PARTS_H

#include "agreement.h"
#include "report.h"

#include <string>

namespace dsw::bench {

struct Options {
  bool quick = false;
  bool is_long = false;  // also what takes 20 GB
  std::string vessel;    // file of read_mesh.py, or empty
  std::string data;      // folder with surfaces and centrelines, or empty
  std::string scene;     // file that gets what figure 10 shows, as JSON, or empty
};

void run_hex(const Options& options, Report& report, Agreement& agreement);
void run_kernels(const Options& options, Report& report);
void run_threads(const Options& options, Report& report);
void run_tet(const Options& options, Report& report, Agreement& agreement);
void run_vessel(const Options& options, Report& report, Agreement& agreement);
void run_coarsen(const Options& options, Report& report, Agreement& agreement);
void run_change(const Options& options, Report& report);
void run_cut(const Options& options, Report& report);
void run_obstacles(const Options& options, Report& report);
void run_self(const Options& options, Report& report);
void run_together(const Options& options, Report& report);
void run_work(const Options& options, Report& report);
void run_figure5(const Options& options, Report& report);
void run_knot(Report& report);
void run_remesh(const Options& options, Report& report);
void run_plane(const Options& options, Report& report);
void run_plane_rays(const Options& options, Report& report);
void run_locate(const Options& options, Report& report);
void run_near(const Options& options, Report& report);
void run_near_rows(const Options& options, Report& report);
void run_create(const Options& options, Report& report);
void run_scale(const Options& options, Report& report);
void run_fig12(const Options& options, Report& report);
void run_catheter(const Options& options, Report& report);
void run_deform(const Options& options, Report& report, Agreement& agreement);
void run_fig11(const Options& options, Report& report, Agreement& agreement);

}  // namespace dsw::bench

#endif
