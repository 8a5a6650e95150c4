#include "fall_case.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

namespace dsw::bench {

namespace {

constexpr double kStep = 0.001;  // a fall of 0.2 m/s at 1 kHz for a hand 0.2 m long

double height(std::size_t step) {
  const std::size_t in_cycle = step % (2 * kFallSteps);
  return -kStep * static_cast<double>(in_cycle <= kFallSteps ? in_cycle : 2 * kFallSteps - in_cycle);
}

}  // namespace

const std::vector<Variant>& fall_variants() {
  static const std::vector<Variant> all = {
      {"points", DSW_LEVEL_POINTS, 0},
      {"edges", DSW_LEVEL_EDGES, 0},
      {"edges_environment", DSW_LEVEL_EDGES, DSW_BODY_SKIP_BY_ENVIRONMENT},
      {"edges_back_edge", DSW_LEVEL_EDGES, DSW_BODY_SKIP_BACK_EDGES},
      {"edges_hybrid", DSW_LEVEL_EDGES, DSW_BODY_SKIP_BY_ENVIRONMENT | DSW_BODY_SKIP_BACK_EDGES},
      {"edges_similar_motion", DSW_LEVEL_EDGES, DSW_BODY_SKIP_SIMILAR_MOTION},
      {"edges_paper_62", DSW_LEVEL_EDGES, DSW_BODY_SKIP_BACK_EDGES | DSW_BODY_LEAVE_BACK_EDGES},
      {"edges_paper_63", DSW_LEVEL_EDGES,
       DSW_BODY_SKIP_BY_ENVIRONMENT | DSW_BODY_SKIP_BACK_EDGES | DSW_BODY_LEAVE_BACK_EDGES},
      {"edges_clearance", DSW_LEVEL_EDGES, DSW_BODY_SKIP_BY_CLEARANCE},
      {"edges_sequences", DSW_LEVEL_EDGES, DSW_BODY_SEQUENCES},
      {"swept", DSW_LEVEL_EDGES_SWEPT, 0},
      {"swept_environment", DSW_LEVEL_EDGES_SWEPT, DSW_BODY_SKIP_BY_ENVIRONMENT},
      {"swept_clearance", DSW_LEVEL_EDGES_SWEPT, DSW_BODY_SKIP_BY_CLEARANCE},
      {"swept_sequences", DSW_LEVEL_EDGES_SWEPT, DSW_BODY_SEQUENCES},
      {"faces", DSW_LEVEL_FACES, 0},
      {"faces_sequences", DSW_LEVEL_FACES, DSW_BODY_SEQUENCES},
      {"faces_clearance", DSW_LEVEL_FACES, DSW_BODY_SKIP_BY_CLEARANCE},
  };
  return all;
}

std::string hand_path(const std::string& data) {
  const std::string path = data + "/surfaces/hand_12k.obj";
  if (std::filesystem::exists(path)) return path;
  std::printf("  no data: a generated surface instead of the hand\n");
  return "";
}

Fall make_fall(const std::string& path, double cube) {
  Fall fall;
  fall.surface = path.empty() ? make_surface() : read_surface(path);
  const auto& points = fall.surface.points;
  fall.shape.vertices = points.size() / 3;
  fall.shape.edges = surface_edges(fall.surface);
  for (const auto& face : fall.surface.faces) {
    fall.shape.corners.insert(fall.shape.corners.end(), face.begin(), face.end());
  }
  std::array<double, 3> low{}, high{};
  for (std::size_t k = 0; k < 3; ++k) {
    low[k] = high[k] = points[k];
    for (std::size_t i = k; i < points.size(); i += 3) {
      low[k] = std::min(low[k], points[i]);
      high[k] = std::max(high[k], points[i]);
    }
  }
  scenes::PyramidOptions options;
  options.edge = cube;
  for (std::size_t k = 0; k < 3; ++k) {
    options.low[k] = low[k] - 4.3 * cube;  // so that nothing is aligned with the cubes
    options.size[k] = static_cast<std::uint32_t>(std::ceil((high[k] - low[k]) / cube)) + 9;
  }
  fall.pyramids = scenes::make_pyramids(options);
  for (const auto& face : fall.surface.faces) {  // the surface starts free, and falls freely for some steps
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [least, most] =
          std::minmax({points[3 * face[0] + k], points[3 * face[1] + k], points[3 * face[2] + k]});
      low[k] = least;
      high[k] = most;
    }
    low[2] -= kStep * static_cast<double>(kFreeSteps);
    scenes::clear_box(fall.pyramids, low, high);
  }
  return fall;
}

void mark_obstacles(World& world, const Fall& fall) {
  std::vector<std::uint8_t> impassable;
  for (const std::uint8_t obstacle : fall.pyramids.obstacle) impassable.insert(impassable.end(), 6, obstacle);
  mark_cells(world, impassable);
}

std::vector<double> place(const Fall& fall, std::size_t step) {
  std::vector<double> at = fall.surface.points;
  for (std::size_t i = 2; i < at.size(); i += 3) at[i] += height(step);
  return at;
}

}  // namespace dsw::bench
