// A burr goes through six units of unit cubes, in steps, before each of which its ball is carved: drill [--json FILE].
// The burr is a ball of 162 vertices at DSW_LEVEL_FACES. Cubes lie along the axes, and turned. Times are of the
// processor.
#include "dartsweep/dartsweep.h"

#include "report.h"

#include <time.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <exception>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using Point = std::array<double, 3>;

struct Ball {
  std::vector<Point> points;
  std::vector<std::uint32_t> corners;
};

/** A ball of radius 1: an icosahedron, its triangles cut in four so many times. */
Ball make_ball(int rounds) {
  const double g = (1 + std::sqrt(5.0)) / 2;
  Ball ball;
  ball.points = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                 {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  ball.corners = {0, 11, 5, 0, 5, 1, 0, 1, 7, 0, 7, 10, 0, 10, 11, 1, 5, 9, 5, 11, 4,  11, 10, 2,  10, 7, 6, 7, 1, 8,
                  3, 9,  4, 3, 4, 2, 3, 2, 6, 3, 6, 8,  3, 8,  9,  4, 9, 5, 2, 4,  11, 6,  2,  10, 8,  6, 7, 9, 8, 1};
  for (int round = 0; round < rounds; ++round) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto found = middles.emplace(std::minmax(a, b), static_cast<std::uint32_t>(ball.points.size()));
      if (found.second) {
        const Point p = ball.points[a], q = ball.points[b];
        ball.points.push_back({(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2});
      }
      return found.first->second;
    };
    std::vector<std::uint32_t> finer;
    for (std::size_t t = 0; t < ball.corners.size(); t += 3) {
      const std::uint32_t a = ball.corners[t], b = ball.corners[t + 1], c = ball.corners[t + 2];
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {a, ab, ca, b, bc, ab, c, ca, bc, ab, bc, ca});
    }
    ball.corners.swap(finer);
  }
  for (Point& p : ball.points) {
    const double length = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    for (double& x : p) x /= length;
  }
  return ball;
}

struct Drill {
  double radius, step, angle, finest;
};

double milliseconds() {
  timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

/** Turned about z and then about x. */
Point turned(double x, double y, double z, double angle) {
  const double c = std::cos(angle), s = std::sin(angle), v = s * x + c * y;
  return {c * x - s * y, c * v - s * z, s * v + c * z};
}

void check(dsw_status status, const char* what) {
  if (status != DSW_STATUS_OK) throw std::runtime_error(std::string(what) + ": " + dsw_last_error_message());
}

constexpr int kLong = 12, kWide = 8, kFirst = 3;  // cubes; those before the first one are passable

dsw_environment* make_block(double angle) {
  std::vector<Point> points;
  std::vector<std::int64_t> cells;
  std::vector<std::int32_t> regions;
  const auto at = [](int x, int y, int z) { return std::int64_t{x} + (kLong + 1) * (y + (kWide + 1) * z); };
  for (int z = 0; z <= kWide; ++z) {
    for (int y = 0; y <= kWide; ++y) {
      for (int x = 0; x <= kLong; ++x) {
        points.push_back(turned(x, y, z, angle));
        if (x == kLong || y == kWide || z == kWide) continue;
        for (int k = 0; k < 8; ++k) cells.push_back(at(x + (k + 1) / 2 % 2, y + k / 2 % 2, z + k / 4));
        regions.push_back(x < kFirst ? 0 : 1);
      }
    }
  }
  dsw_environment_desc desc;
  dsw_environment_desc_init(&desc, sizeof desc);
  desc.points = points[0].data();
  desc.point_count = points.size();
  desc.connectivity = cells.data();
  desc.connectivity_count = cells.size();
  desc.volume_count = regions.size();
  desc.regions = regions.data();
  dsw_environment* block = nullptr;
  check(dsw_environment_create(nullptr, &desc, &block, nullptr), "the block");
  check(dsw_environment_mark_region(block, 1, DSW_MARK_IMPASSABLE, 0, nullptr, nullptr), "marks");
  return block;
}

dsw_body_id make_burr(dsw_scene* scene, const Ball& ball, const std::vector<Point>& places) {
  std::vector<std::uint32_t> offsets;
  for (std::uint32_t k = 0; k <= ball.corners.size(); k += 3) offsets.push_back(k);
  dsw_body_desc desc;
  dsw_body_desc_init(&desc, sizeof desc);
  desc.positions = places[0].data();
  desc.vertex_count = places.size();
  desc.face_offsets = offsets.data();
  desc.face_corners = ball.corners.data();
  desc.face_count = offsets.size() - 1;
  desc.face_corner_count = ball.corners.size();
  desc.level = DSW_LEVEL_FACES;
  dsw_body_id burr;
  check(dsw_body_create(scene, &desc, &burr), "the burr");
  return burr;
}

struct Times {
  std::vector<double> carves, moves;
  bool arrived = true;
};

void go(const Drill& drill, const Ball& ball, Times& times) {
  dsw_environment* const block = make_block(drill.angle);
  dsw_scene_desc features;
  dsw_scene_desc_init(&features, sizeof features);
  features.features = DSW_FEATURE_LIVE_CHANGES;
  dsw_scene* scene = nullptr;
  check(dsw_scene_create(block, &features, &scene), "the scene");
  std::vector<Point> places(ball.points.size());
  const auto place = [&](double x) {
    const Point middle = turned(x, 4.14, 4.07, drill.angle);
    for (std::size_t i = 0; i < places.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k) places[i][k] = middle[k] + drill.radius * ball.points[i][k];
    }
  };
  double x = kFirst - drill.radius - 0.3;
  place(x);
  const dsw_body_id burr = make_burr(scene, ball, places);
  dsw_carve_desc shape;
  dsw_carve_desc_init(&shape, sizeof shape);
  shape.points = places[0].data();
  shape.point_count = places.size();
  shape.triangles = ball.corners.data();
  shape.triangle_count = ball.corners.size() / 3;
  shape.flags = DSW_CARVE_COVER;
  shape.finest = drill.finest;
  while (x < kFirst + 6 + drill.radius) {
    place(x += drill.step);
    dsw_move_report report;
    const double start = milliseconds();
    check(dsw_environment_carve(block, &shape, nullptr), "carving");
    const double carved = milliseconds();
    check(dsw_body_move(scene, burr, places[0].data(), places.size(), 0, nullptr, &report), "moving");
    times.moves.push_back(milliseconds() - carved);
    times.carves.push_back(carved - start);
    times.arrived = times.arrived && report.vertices_stopped == 0;
  }
  check(dsw_scene_destroy(scene), "the scene's end");
  check(dsw_environment_destroy(block), "the block's end");
}

double at_share(std::vector<double> times, double share) {
  std::sort(times.begin(), times.end());
  return times[static_cast<std::size_t>(share * static_cast<double>(times.size() - 1))];
}

}  // namespace

int main(int argc, char** argv) {
  try {
    dsw::bench::Report report;
    const Ball ball = make_ball(2);
    bool arrived = true;
    const auto run = [&](const char* suffix, const Drill& drill) {
      Times times;
      go(drill, ball, times);
      arrived = arrived && times.arrived;
      std::vector<double> calls = times.carves;
      calls.insert(calls.end(), times.moves.begin(), times.moves.end());
      const std::string end = suffix;
      report.set("drill.ms_p99" + end, at_share(calls, 0.99));
      report.set("drill.carve_ms_p50" + end, at_share(times.carves, 0.5));
      report.set("drill.carve_ms_p99" + end, at_share(times.carves, 0.99));
      report.set("drill.move_ms_p99" + end, at_share(times.moves, 0.99));
    };
    run("", {0.8, 0.05, 0, 0.25});
    run(".thin", {0.4, 0.05, 0, 0.25});
    run(".fine", {0.8, 0.05, 0, 0.125});
    run(".coarse", {0.8, 0.05, 0, 0.5});
    run(".turned", {0.8, 0.05, 0.3, 0.25});
    report.set("drill.stuck", arrived ? 0 : 1);
    if (argc == 3 && std::strcmp(argv[1], "--json") == 0 && !report.write(argv[2])) return 1;
    return arrived ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
