#include "engine.h"

#include "timing.h"

#include <cmath>
#include <cstdio>

namespace dsw::bench {

WallMesh::WallMesh(const std::vector<double>& mesh_points, std::vector<scenes::Wall> mesh_walls)
    : points(&mesh_points), walls(std::move(mesh_walls)) {
  for (std::uint32_t wall = 0; wall < walls.size(); ++wall) {
    for (std::uint32_t i = 0; i < walls[wall].triangle_count(); ++i) {
      triangles.push_back(walls[wall].triangle(i));
      triangle_wall.push_back(wall);
      for (const std::uint32_t vertex : triangles.back()) {
        for (std::size_t k = 0; k < 3; ++k) extent = std::max(extent, std::fabs(point(vertex)[k]));
      }
    }
  }
}

double time_casts(Engine& engine, const Segments& segments) {
  const std::size_t count = segments.count();
  engine.run(0, std::min(segments.batch, count));
  std::vector<double> times;
  for (std::size_t first = 0; first < count; first += segments.batch) {
    const std::size_t now = std::min(segments.batch, count - first);
    times.push_back(time_ns([&] { engine.run(first, now); }) / static_cast<double>(now));
  }
  return median(std::move(times));
}

std::unique_ptr<Engine> keep_fastest(std::vector<std::unique_ptr<Engine>> engines, const Segments& segments) {
  Segments few;
  const std::size_t wanted = std::max<std::size_t>(2 * segments.batch, 40000);
  const std::size_t count = std::min(segments.count(), (wanted + segments.batch - 1) / segments.batch * segments.batch);
  few.batch = segments.batch;
  few.from.assign(segments.from.begin(), segments.from.begin() + static_cast<std::ptrdiff_t>(3 * count));
  few.to.assign(segments.to.begin(), segments.to.begin() + static_cast<std::ptrdiff_t>(3 * count));
  std::vector<std::vector<double>> times(engines.size());
  for (auto& engine : engines) engine->prepare(few);
  for (int round = 0; round < 5; ++round) {
    for (std::size_t i = 0; i < engines.size(); ++i) times[i].push_back(time_casts(*engines[i], few));
  }
  // The least of few short runs: whatever disturbs them only adds.
  const auto least = [&](std::size_t i) { return *std::min_element(times[i].begin(), times[i].end()); };
  std::size_t best = 0;
  for (std::size_t i = 0; i < engines.size(); ++i) {
    std::printf("    %-36s %.1f ns\n", engines[i]->name().c_str(), least(i));
    if (least(i) < least(best)) best = i;
  }
  return std::move(engines[best]);
}

}  // namespace dsw::bench
