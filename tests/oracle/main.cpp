// dartsweep_oracle [--casts N] [--plane N] [--plane-sweeps N] [--plane-deformations N] [--sweeps N] [--bodies N
// [--level L] [--scene-seed S]] [--back-edges N] [--wall-pushes N] [--seed S] [--quick] [--only SCENE] [--print N] [--stuck] [--json
// FILE]
// Casts, locates and particle moves, swept edges, and moves of bodies (N: of single vertices, at each level), in many
// small environments, each compared with exact arithmetic; --plane: casts and particle moves in the plane;
// --back-edges: moves of closed bodies with back-edge elimination; --plane-sweeps: swept edges and bodies there;
// --plane-deformations: with walls that move; --wall-pushes: how far walls push. Without any of these: casts. DSW_EFFORT scales what N says.
#include "../effort.h"
#include "back_edges.h"
#include "body_run.h"
#include "deform_run.h"
#include "plane_run.h"
#include "run.h"
#include "sweep_run.h"
#include "wall_pushes.h"

#include <cstdio>
#include <cstdlib>
#include <cstring>

static uint64_t count_of(const char* text) { return static_cast<uint64_t>(effort_of(std::atoi(text))); }

int main(int argc, char** argv) {
  dsw::oracle::RunOptions options;
  dsw::oracle::SweepRunOptions sweeps;
  sweeps.sweeps = 0;
  dsw::oracle::BodyRunOptions bodies;
  dsw::oracle::DeformRunOptions deformations;
  uint64_t plane_deformations = 0, back_edges = 0, wall_pushes = 0;
  dsw::oracle::PlaneRunOptions plane;
  const char* json = nullptr;
  int print_most = 20;
  bool casts_given = false, quick = false, show_stuck = false;
  for (int i = 1; i < argc; ++i) {
    const bool more = i + 1 < argc;
    if (std::strcmp(argv[i], "--casts") == 0 && more) {
      options.casts = count_of(argv[++i]);
      casts_given = true;
    } else if (std::strcmp(argv[i], "--plane") == 0 && more) {
      plane.casts = count_of(argv[++i]);
    } else if (std::strcmp(argv[i], "--plane-sweeps") == 0 && more) {
      plane.sweeps = count_of(argv[++i]);
    } else if (std::strcmp(argv[i], "--plane-deformations") == 0 && more) {
      plane_deformations = count_of(argv[++i]);
    } else if (std::strcmp(argv[i], "--sweeps") == 0 && more) {
      sweeps.sweeps = count_of(argv[++i]);
    } else if (std::strcmp(argv[i], "--bodies") == 0 && more) {
      bodies.steps = count_of(argv[++i]);
    } else if (std::strcmp(argv[i], "--back-edges") == 0 && more) {
      back_edges = count_of(argv[++i]);
    } else if (std::strcmp(argv[i], "--wall-pushes") == 0 && more) {
      wall_pushes = count_of(argv[++i]);
    } else if (std::strcmp(argv[i], "--deformations") == 0 && more) {
      deformations.steps = count_of(argv[++i]);
    } else if (std::strcmp(argv[i], "--scene-seed") == 0 && more) {
      bodies.scene_seed = deformations.scene_seed = plane.scene_seed = std::strtoull(argv[++i], nullptr, 10);
    } else if (std::strcmp(argv[i], "--level") == 0 && more) {
      bodies.level = plane.level = std::atoi(argv[++i]);
    } else if (std::strcmp(argv[i], "--seed") == 0 && more) {
      options.seed = plane.seed = sweeps.seed = bodies.seed = deformations.seed = std::strtoull(argv[++i], nullptr, 10);
    } else if (std::strcmp(argv[i], "--only") == 0 && more) {
      options.only = plane.only = sweeps.only = bodies.only = deformations.only = argv[++i];
    } else if (std::strcmp(argv[i], "--quick") == 0) {
      quick = true;
      if (!casts_given) options.casts = 120000;
    } else if (std::strcmp(argv[i], "--print") == 0 && more) {
      print_most = std::atoi(argv[++i]);
    } else if (std::strcmp(argv[i], "--stuck") == 0) {
      show_stuck = true;
    } else if (std::strcmp(argv[i], "--json") == 0 && more) {
      json = argv[++i];
    } else {
      std::fprintf(
          stderr,
          "usage: %s [--casts N] [--plane N] [--plane-sweeps N] [--sweeps N] [--bodies N [--level 1..4]] "
          "[--back-edges N] [--wall-pushes N] [--deformations N] [--plane-deformations N] [--scene-seed S] [--seed S] "
          "[--quick] [--only SCENE] "
          "[--print N] [--stuck] [--json FILE]\n",
          argv[0]);
      return 2;
    }
  }
  dsw::oracle::Report report(print_most);
  report.show_stuck = show_stuck;
  const bool with_casts = casts_given || quick ||
                          plane.casts + plane.sweeps + plane_deformations + sweeps.sweeps + bodies.steps +
                                  deformations.steps + back_edges + wall_pushes ==
                              0;
  if (with_casts) dsw::oracle::run(options, report);
  dsw::oracle::PlaneReport plane_report;
  if (plane.casts != 0) dsw::oracle::run_plane(plane, print_most, plane_report);
  if (plane.sweeps != 0) dsw::oracle::run_plane_sweeps(plane, print_most, plane_report);
  const bool with_plane = plane.casts + plane.sweeps != 0;
  dsw::oracle::SweepReport sweep_report(print_most);
  if (sweeps.sweeps != 0) dsw::oracle::run_sweeps(sweeps, sweep_report);
  dsw::oracle::BodyReport body_report(print_most);
  if (bodies.steps != 0) dsw::oracle::run_bodies(bodies, body_report);
  dsw::oracle::BackEdgeReport back_edge_report(print_most);
  if (back_edges != 0) dsw::oracle::run_back_edges(back_edges, bodies.seed, back_edge_report);
  dsw::oracle::DeformReport deform_report(print_most);
  if (deformations.steps != 0) dsw::oracle::run_deformations(deformations, deform_report);
  dsw::oracle::PushReport push_report(print_most);
  if (wall_pushes != 0) {
    dsw::oracle::DeformRunOptions pushes = deformations;
    pushes.steps = wall_pushes;
    dsw::oracle::run_wall_pushes(pushes, push_report);
  }
  dsw::oracle::DeformReport plane_deform_report(print_most);
  deformations.steps = plane_deformations;
  if (plane_deformations != 0) dsw::oracle::run_plane_deformations(deformations, plane_deform_report);
  std::string text = with_casts ? dsw::oracle::to_json(report) : "";
  const auto join = [&](const std::string& more) {  // one flat object
    text = text.empty() ? more : text.substr(0, text.rfind("\n}")) + "," + more.substr(1);
  };
  if (with_plane) join(dsw::oracle::to_json(plane_report));
  if (sweeps.sweeps != 0) join(dsw::oracle::to_json(sweep_report));
  if (bodies.steps != 0) join(dsw::oracle::to_json(body_report));
  if (back_edges != 0) join(dsw::oracle::to_json(back_edge_report));
  if (deform_report.steps != 0) join(dsw::oracle::to_json(deform_report));
  if (plane_deformations != 0) join(dsw::oracle::to_json(plane_deform_report, "plane."));
  if (wall_pushes != 0) join(dsw::oracle::to_json(push_report));
  std::fputs(text.c_str(), stdout);
  if (json != nullptr) {
    std::FILE* file = std::fopen(json, "w");
    if (file == nullptr || std::fputs(text.c_str(), file) < 0 || std::fclose(file) != 0) {
      std::fprintf(stderr, "cannot write %s\n", json);
      return 2;
    }
  }
  const bool casts_right = report.total.mismatches == 0 && report.total.lost == 0 && report.total.casts > 0;
  const bool plane_right = !with_plane || (plane_report.faults() == 0 && plane_report.contacts > 0);
  const bool sweeps_right = sweep_report.total.faults() == 0 && sweep_report.total.sweeps > 0;
  const bool bodies_right = body_report.faults() == 0 && body_report.bodies > 0;
  const bool right = plane_right && (back_edges == 0 || back_edge_report.right()) &&
                     (deform_report.right() || deform_report.steps == 0) && (push_report.right() || wall_pushes == 0) &&
                     (plane_deform_report.right() || plane_deformations == 0) && (casts_right || !with_casts) &&
                     (sweeps_right || sweeps.sweeps == 0) && (bodies_right || bodies.steps == 0);
  return right ? 0 : 1;
}
