// Calls whose work has no natural bound: moves among coordinates of all magnitudes, and volumes that fold.
#include "parts.h"

#include "timing.h"

#include "scenes.h"  // of the oracle

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <stdexcept>

namespace dsw::bench {

namespace {

using oracle::Rng;

void require(dsw_status status) {
  if (status != DSW_STATUS_OK) throw std::runtime_error(dsw_last_error_message());
}

struct Destroy {
  void operator()(dsw_environment* e) const { dsw_environment_destroy(e); }
  void operator()(dsw_scene* s) const { dsw_scene_destroy(s); }
};

/** An environment that bends, with walls in one of ten volumes, and its scene. */
struct Home {
  std::unique_ptr<dsw_environment, Destroy> environment;
  std::unique_ptr<dsw_scene, Destroy> scene;

  Home(const dsw_environment_desc& desc, Rng& rng, uint32_t features) {
    dsw_environment* made = nullptr;
    require(dsw_environment_create(nullptr, &desc, &made, nullptr));
    environment.reset(made);
    dsw_scene_desc of_scene;
    dsw_scene_desc_init(&of_scene, sizeof of_scene);
    of_scene.features = features;
    dsw_scene* world = nullptr;
    require(dsw_scene_create(made, &of_scene, &world));
    scene.reset(world);
    for (uint32_t i = 0; i < desc.volume_count; ++i) {
      const dsw_volume_id volume = {i, 1};
      if (rng.chance(0.1)) require(dsw_environment_mark_volumes(made, &volume, 1, DSW_MARK_IMPASSABLE, 0, nullptr));
    }
  }
  dsw_deform_report deform(std::vector<double>& next, const dsw_deform_options& options) {
    dsw_deform_report report;
    require(dsw_environment_deform(environment.get(), next.data(), next.size() / 3, &options, &report));
    return report;
  }
};

dsw_deform_options held() {
  dsw_deform_options options;
  dsw_deform_options_init(&options, sizeof options);
  options.response = DSW_WALL_HOLD;
  return options;
}

double some_magnitude(Rng& rng, double otherwise) {
  constexpr double kValues[] = {1e308, -1e308, 5e-324, -5e-324, 0, 1e-308, 1.7e308};
  return rng.chance(0.6) ? kValues[rng.below(7u)] : otherwise;
}

constexpr int kCells = 4;

oracle::Mesh small_tetrahedra(Rng& rng) {
  constexpr int kOrders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  const auto index = [](int x, int y, int z) { return x + (kCells + 1) * (y + (kCells + 1) * z); };
  oracle::Mesh mesh;
  for (int z = 0; z <= kCells; ++z) {
    for (int y = 0; y <= kCells; ++y) {
      for (int x = 0; x <= kCells; ++x) {
        mesh.points.push_back({x + rng.range(-0.2, 0.2), y + rng.range(-0.2, 0.2), z + rng.range(-0.2, 0.2)});
      }
    }
  }
  for (int i = 0; i < kCells * kCells * kCells; ++i) {
    for (int k = 0; k < 6; ++k) {
      int at[3] = {i % kCells, i / kCells % kCells, i / kCells / kCells};
      std::vector<int> corners = {index(at[0], at[1], at[2])};
      for (const int axis : kOrders[k]) {
        ++at[axis];
        corners.push_back(index(at[0], at[1], at[2]));
      }
      if (k >= 3) std::swap(corners[1], corners[2]);
      mesh.add_standard(DSW_CELL_TYPE_TETRA, corners);
    }
  }
  return mesh;
}

/** The closed surface of an octahedron, where it is free. */
dsw_body_id some_octahedron(const Home& home, Rng& rng) {
  constexpr uint32_t kCorners[] = {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};
  constexpr uint32_t kOffsets[] = {0, 3, 6, 9, 12, 15, 18, 21, 24};
  dsw_body_desc desc;
  dsw_body_desc_init(&desc, sizeof desc);
  desc.vertex_count = 6;
  desc.face_offsets = kOffsets;
  desc.face_corners = kCorners;
  desc.face_count = 8;
  desc.face_corner_count = 24;
  desc.level = DSW_LEVEL_FACES;
  desc.flags = DSW_BODY_SELF_CONTACTS;
  dsw_body_id body;
  do {
    std::array<double, 18> at;
    const double middle[3] = {rng.range(0.5, 3.5), rng.range(0.5, 3.5), rng.range(0.5, 3.5)};
    for (size_t i = 0; i < 18; ++i) {
      at[i] = middle[i % 3] + (i / 6 == i % 3 ? (i / 3 % 2 == 0 ? -0.4 : 0.4) : 0) + rng.range(-0.05, 0.05);
    }
    desc.positions = at.data();
  } while (dsw_body_create(home.scene.get(), &desc, &body) != DSW_STATUS_OK);
  return body;
}

/** @return seconds of the slowest of random moves of 6 vertices, where vertices of the environment and targets are at
 * 1e308 and 5e-324 */
double slowest_vast_move(size_t moves) {
  constexpr size_t kMovesOfOne = 10;
  Rng rng(3);
  double slowest = 0;
  for (size_t done = 0; done < moves; done += kMovesOfOne) {
    const oracle::Mesh mesh = small_tetrahedra(rng);
    std::vector<double> next;  // lent, so before the environment
    const oracle::DescArrays arrays(mesh, {});
    Home home(arrays.desc, rng, DSW_FEATURE_DEFORMING | DSW_FEATURE_BODY_CONTACTS);
    const dsw_body_id body = some_octahedron(home, rng);
    for (const oracle::Vec& p : mesh.points) {
      const bool goes = rng.chance(0.9);
      for (const double x : p) next.push_back(goes ? some_magnitude(rng, x) : x);
    }
    dsw_deform_options options = held();
    options.most_halvings = 2;
    home.deform(next, options);
    for (size_t i = 0; i < kMovesOfOne; ++i) {
      std::array<double, 18> to;
      size_t count = 0;
      require(dsw_body_get_positions(home.scene.get(), body, to.data(), 6, 0, nullptr, &count));
      for (double& x : to) x = rng.chance(0.5) ? some_magnitude(rng, x) : x + rng.range(-0.3, 0.3);
      dsw_together_options how;
      dsw_together_options_init(&how, sizeof how);
      how.stop = static_cast<dsw_together_stop>(rng.below(3u));
      slowest = std::max(slowest,
                         1e-9 * cpu_time_ns([&] {
                           require(dsw_scene_move_together(home.scene.get(), &body, 1, to.data(), 6, 0, &how, nullptr));
                         }));
    }
  }
  return slowest;
}

/** Polyhedra with bodies and particles in all of them fold over. */
void run_fold(Report& report) {
  constexpr int kSites = 150, kParticles = 200, kBodies = 8;
  constexpr double kSize = 4096;
  Rng rng(1);
  const oracle::Mesh mesh = oracle::voronoi(rng, 0, kSites);
  std::vector<double> next;
  const oracle::DescArrays arrays(mesh, {});
  Home home(arrays.desc, rng, DSW_FEATURE_DEFORMING);
  for (int i = 0; i < kBodies; ++i) {
    std::array<double, 18> at;
    const double middle = rng.range(0.2, 0.8) * kSize;
    for (size_t k = 0; k < 18; ++k) at[k] = middle + static_cast<double>(k / 3) * rng.range(-150, 150);
    constexpr uint32_t kEdges[] = {0, 1, 1, 2, 2, 3, 3, 4, 4, 5};
    dsw_body_desc desc;
    dsw_body_desc_init(&desc, sizeof desc);
    desc.positions = at.data();
    desc.vertex_count = 6;
    desc.edges = kEdges;
    desc.edge_count = 5;
    desc.level = DSW_LEVEL_EDGES;
    dsw_body_id body;
    dsw_body_create(home.scene.get(), &desc, &body);  // where it is free
  }
  for (int i = 0; i < kParticles; ++i) {
    const double at[3] = {rng.range(0, kSize), rng.range(0, kSize), rng.range(0, kSize)};
    dsw_particle_id particle;
    dsw_particle_create(home.scene.get(), at, {0, 0}, &particle);  // where there is a volume
  }
  const double cell = kSize / std::cbrt(static_cast<double>(mesh.cells.size()));
  for (const oracle::Vec& p : mesh.points) {
    for (const double x : p) next.push_back(x + 0.3 * cell * rng.range(-1, 1));
  }
  dsw_deform_report done{};
  report.set("work.fold_s", 1e-9 * cpu_time_ns([&] { done = home.deform(next, held()); }));
  report.set("work.fold_vertices", static_cast<double>(mesh.points.size()));
  report.set("work.fold_steps", done.steps);
  report.set("work.fold_is_limited", done.outcome == DSW_DEFORM_LIMITED ? 1 : 0);
}

}  // namespace

void run_work(const Options& options, Report& report) {
  report.set("work.vast_moves_slowest_s", slowest_vast_move(options.quick ? 100 : 1000));
  run_fold(report);
}

}  // namespace dsw::bench
