// What [JCD10] states in its text, measured: figure 2, and sections 3.3, 4.2, 4.3, 4.4, 5.1 and 5.2.
//
// usage: paper_statements [--quick] [--mesh FILE]
//
// FILE is a vessel as for catheter_length; without it a vessel is made. Prints a line for each number: section, quantity, ours, paper.
// Exit code 2: the mesh can't be used; 1: a call failed, or a number is above its bound.
#include "statements.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <iostream>

#include "vessel.h"

namespace paper {

Tetrahedra::Tetrahedra(std::uint32_t given, Random* random) : side(given) {
  static constexpr int kOrders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {1, 0, 2}, {2, 1, 0}};
  const std::int64_t row = side + 1, steps[3] = {1, row, row * row};
  for (std::int64_t i = 0; i < row * row * row; ++i) {
    for (const std::int64_t step : steps) {
      const std::int64_t at = i / step % row;
      points.push_back(static_cast<double>(at) + (at == 0 || at == side ? 0 : random->between(-0.15, 0.15)));
    }
  }
  for (std::int64_t cube = 0; cube < std::int64_t{side} * side * side; ++cube) {
    const std::int64_t p = cube % side + steps[1] * (cube / side % side) + steps[2] * (cube / side / side);
    for (int i = 0; i < 6; ++i) {
      const std::int64_t a = p + steps[kOrders[i][0]], b = a + steps[kOrders[i][1]], c = b + steps[kOrders[i][2]];
      cells.insert(cells.end(), {p, i >= 3 ? b : a, i >= 3 ? a : b, c});
    }
  }
  dsw_environment_desc desc;
  dsw_environment_desc_init(&desc, sizeof desc);
  desc.points = points.data();
  desc.point_count = points.size() / 3;
  desc.uniform_cell_type = DSW_CELL_TYPE_TETRA;
  desc.volume_count = cells.size() / 4;
  desc.connectivity = cells.data();
  desc.connectivity_count = cells.size();
  dsw_environment* made = nullptr;
  physics::check(dsw_environment_create(nullptr, &desc, &made, nullptr), "making tetrahedra");
  environment.reset(made);
}

physics::Scene make_scene(dsw_environment* environment, std::uint32_t features) {
  dsw_scene_desc desc;
  dsw_scene_desc_init(&desc, sizeof desc);
  desc.features = features;
  dsw_scene* scene = nullptr;
  physics::check(dsw_scene_create(environment, &desc, &scene), "making a scene");
  return physics::Scene(scene);
}

dsw_status add_edge(dsw_scene* scene, const Point* ends, dsw_level level, std::uint32_t flags, dsw_body_id* body) {
  static constexpr std::uint32_t kEdge[2] = {0, 1};
  dsw_body_desc desc;
  dsw_body_desc_init(&desc, sizeof desc);
  desc.level = level;
  desc.flags = flags;
  desc.positions = ends[0].data();
  desc.vertex_count = 2;
  desc.edges = kEdge;
  desc.edge_count = 1;
  return dsw_body_create(scene, &desc, body);
}

double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Point to_point(const double* x) { return {x[0], x[1], x[2]}; }

double quantile(std::vector<double> numbers, double part) {
  if (numbers.empty()) {
    return 0;
  }
  std::sort(numbers.begin(), numbers.end());
  return numbers[static_cast<std::size_t>(part * static_cast<double>(numbers.size() - 1))];
}

namespace {

// A network of vessels in convex polyhedra: tetrahedra that are merged.
void network(const dsw_environment* vessel, Statements* out) {
  dsw_coarsen_report report = {};
  report.struct_size = sizeof report;
  dsw_environment* coarse = nullptr;
  physics::check(dsw_environment_coarsen(vessel, nullptr, &coarse, nullptr, 0, &report), "merging tetrahedra");
  const physics::Environment owner(coarse);
  dsw_build_report built = {};
  built.struct_size = sizeof built;
  physics::check(dsw_environment_check(coarse, &built), "checking polyhedra");
  const auto add = [&](const char* quantity, double ours, const char* paper) {
    out->push_back({"figure 2", quantity, ours, paper});
  };
  for (int i = 0; i < 2; ++i) {
    const double faces = report.face_count[i], bytes = static_cast<double>(report.memory_bytes[i]);
    add(i == 0 ? "tetrahedra" : "polyhedra", report.volume_count[i], "");
    if (i == 1) {
      add("polyhedra that are convex, exactly", built.convex_volume_count, "all");
    }
    add("polygons", faces, i == 0 ? "" : "about 15,000");
    add("MB", bytes / 1e6, i == 0 ? "" : "30");
    add("bytes a polygon", bytes / faces, i == 0 ? "" : "2,000");
  }
}

int run(const std::string& mesh, bool quick) {
  Statements found;
  insertion::Options options;
  options.mesh = mesh;
  options.spacing = quick ? 2.5 : 0.98;
  const insertion::Vessel vessel(options);
  network(vessel.environment(), &found);
  normals(vessel.environment(), quick ? 4000 : 40000, &found);
  depths(quick ? 20000 : 60000, &found);
  registration(&found);
  forecasts(&found);
  deformations(&found);
  walls_that_push(&found);
  local_changes(&found);
  std::printf("%-10s %-72s %12s  %s\n", "section", "quantity", "ours", "paper");
  int faults = 0;
  for (const Statement& each : found) {
    const bool is_right = each.ours <= each.most;
    std::printf("%-10s %-72s %12.6g  %s%s\n", each.section.c_str(), each.quantity.c_str(), each.ours,
                each.paper.c_str(), is_right ? "" : "  NOT SO");
    faults += is_right ? 0 : 1;
  }
  return faults == 0 ? 0 : 1;
}

}  // namespace
}  // namespace paper

int main(int argc, char** argv) {
  std::string mesh;
  bool quick = false;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--quick") == 0) {
      quick = true;
    } else if (std::strcmp(argv[i], "--mesh") == 0 && i + 1 < argc) {
      mesh = argv[++i];
    } else {
      std::cerr << "usage: paper_statements [--quick] [--mesh FILE]\n";
      return 2;
    }
  }
  try {
    return paper::run(mesh, quick);
  } catch (const insertion::BadInput& error) {
    std::cerr << "paper_statements: " << error.what() << '\n';
    return 2;
  } catch (const std::exception& error) {
    std::cerr << "paper_statements: " << error.what() << '\n';
    return 1;
  }
}
