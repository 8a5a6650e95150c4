// Tetrahedra of random points bend so far that some turn invalid: how many are repaired, by how far it bends and
// how far the repair may reach, and what it costs.
#include "parts.h"

#include "ours.h"
#include "timing.h"

#include "scenes/random.h"
#include "scenes/tets.h"

#include <cmath>
#include <cstdio>

namespace dsw::bench {

namespace {

/** A cube of n^3 cubes, each cut into six tetrahedra round its diagonal; inner points are shifted a little. */
scenes::VolumeMesh make_grid(std::int32_t n) {
  scenes::VolumeMesh mesh;
  mesh.points_per_cell = 4;
  scenes::Random random(7);
  const auto number = [&](const std::int32_t* at) { return at[0] + (n + 1) * (at[1] + (n + 1) * at[2]); };
  std::int32_t at[3];
  for (at[2] = 0; at[2] <= n; ++at[2]) {
    for (at[1] = 0; at[1] <= n; ++at[1]) {
      for (at[0] = 0; at[0] <= n; ++at[0]) {
        for (const std::int32_t x : at) {
          const double shift = random.uniform(-0.15, 0.15);
          mesh.points.push_back((x + (x == 0 || x == n ? 0 : shift)) / n);
        }
      }
    }
  }
  for (at[2] = 0; at[2] < n; ++at[2]) {
    for (at[1] = 0; at[1] < n; ++at[1]) {
      for (at[0] = 0; at[0] < n; ++at[0]) {
        for (int order = 0; order < 6; ++order) {
          // From one end of the diagonal to the other, axis by axis.
          const int axes[3] = {order / 2, (order / 2 + 1 + order % 2) % 3, (order / 2 + 2 - order % 2) % 3};
          std::int32_t corner[3] = {at[0], at[1], at[2]}, tet[4] = {number(corner), 0, 0, 0};
          for (int k = 0; k < 3; ++k) {
            ++corner[axes[k]];
            tet[k + 1] = number(corner);
          }
          if (order % 2 != 0) std::swap(tet[1], tet[2]);
          mesh.connectivity.insert(mesh.connectivity.end(), tet, tet + 4);
        }
      }
    }
  }
  return mesh;
}

/** Every vertex that none of the outer faces has. */
std::vector<char> inner_points(const scenes::VolumeMesh& mesh) {
  std::vector<char> inner(mesh.point_count(), 1);
  const auto neighbours = scenes::tet_neighbours(mesh);
  for (std::size_t c = 0; c < neighbours.size(); ++c) {
    for (std::size_t f = 0; f < 4; ++f) {
      if (neighbours[c][f] != scenes::kNone) continue;
      for (const std::uint32_t k : scenes::kTetFaces[f]) inner[static_cast<std::size_t>(mesh.cell(c)[k])] = 0;
    }
  }
  return inner;
}

/** Each inner point goes anywhere within so many edges. */
std::vector<double> shaken(const scenes::VolumeMesh& mesh, const std::vector<char>& inner, double by) {
  std::vector<double> points = mesh.points;
  scenes::Random random(3);
  const double reach = by * scenes::mean_edge(mesh);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double step = random.uniform(-reach, reach);
    if (inner[i / 3] != 0) points[i] += step;
  }
  return points;
}

/** A ball in the middle turns by an angle, what is round it less the farther out it is. */
std::vector<double> stirred(const scenes::VolumeMesh& mesh, const std::vector<char>& inner, double angle) {
  std::vector<double> points = mesh.points;
  for (std::size_t v = 0; v < mesh.point_count(); ++v) {
    double* const p = &points[3 * v];
    if (inner[v] == 0) continue;
    const double x = p[0] - 0.5, y = p[1] - 0.5, z = p[2] - 0.5, r = std::sqrt((x * x + y * y) + z * z);
    const double turn = angle * (r < 0.2 ? 1 : r > 0.4 ? 0 : (0.4 - r) / 0.2);
    p[0] = 0.5 + std::cos(turn) * x - std::sin(turn) * y;
    p[1] = 0.5 + std::sin(turn) * x + std::cos(turn) * y;
  }
  return points;
}

struct Result {
  dsw_change report{};
  double ns = 0;
};

/** Repairs what is invalid, after or before it is bent to `next`. */
Result repair(const scenes::VolumeMesh& mesh, std::vector<double> next, std::uint32_t radius, bool before) {
  World world(mesh, 1);
  std::vector<dsw_volume_id> invalid;
  {
    World bent(mesh, 1);
    std::vector<double> points = next;
    check(dsw_environment_deform(dsw_scene_get_environment(bent.scene(DSW_FEATURE_DEFORMING)), points.data(),
                                 points.size() / 3, nullptr, nullptr));
    for (std::uint32_t i = 0; i < mesh.cell_count(); ++i) {
      dsw_volume_id volume;
      int valid;
      check(dsw_environment_get_volume_id(bent.environment(), i, &volume));
      check(dsw_environment_is_valid(bent.environment(), volume, &valid));
      if (valid == 0) invalid.push_back(volume);
    }
  }
  dsw_remesh_desc desc;
  dsw_remesh_desc_init(&desc, sizeof desc);
  desc.volumes = invalid.data();
  desc.volume_count = invalid.size();
  desc.radius = radius;
  std::vector<double> read = next;
  if (before) {
    desc.next = next.data();
    desc.point_count = next.size() / 3;
  } else {
    check(dsw_environment_deform(dsw_scene_get_environment(world.scene(DSW_FEATURE_DEFORMING)), read.data(),
                                 read.size() / 3, nullptr, nullptr));
  }
  dsw_remesh_desc nothing = desc;
  nothing.volume_count = 0;
  check(dsw_environment_remesh(world.environment(), &nothing, nullptr));  // makes tables, once
  Result result;
  result.report.struct_size = sizeof result.report;
  result.ns = time_ns([&] { check(dsw_environment_remesh(world.environment(), &desc, &result.report)); });
  return result;
}

}  // namespace

void run_remesh(const Options& options, Report& report) {
  const scenes::VolumeMesh mesh = make_grid(options.quick ? 15 : 32);
  const std::vector<char> inner = inner_points(mesh);
  const auto measure = [&](const std::string& kind, double by, const std::vector<double>& next) {
    for (const bool before : {true, false}) {
      for (const std::uint32_t radius : {1u, 2u}) {
        const Result r = repair(mesh, next, radius, before);
        const double repaired = static_cast<double>(r.report.volumes_invalid - r.report.unrepaired_count),
                     share = repaired / std::max(1u, r.report.volumes_invalid),
                     us = 1e-3 * r.ns / std::max(1.0, repaired);
        char name[64];
        std::snprintf(name, sizeof name, "%s%g.%s.r%u", kind.c_str(), by, before ? "before" : "after", radius);
        report.set(std::string("remesh.share.") + name, share);
        report.set(std::string("remesh.us.") + name, us);
        std::printf(
            "  %-24s %6u invalid, %5.1f %% repaired in %u patches, %u -> %u volumes, most faces %u, %.1f us each\n",
            name, r.report.volumes_invalid, 100 * share, r.report.patch_count, r.report.volumes_removed,
            r.report.volumes_added, r.report.most_faces, us);
      }
    }
  };
  for (const double by : {0.2, 0.3, 0.5}) measure("shake", by, shaken(mesh, inner, by));
  for (const double by : {1.0, 2.0, 4.0}) measure("stir", by, stirred(mesh, inner, by));
}

}  // namespace dsw::bench
