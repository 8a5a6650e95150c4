#include "pressed.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace dsw::bench {

namespace {

/** A lattice of cubes, six tetrahedra each, bent. */
struct Block {
  std::array<int, 3> low, high;  // in cubes
  double size;                   // of a cube before it is bent
};

template <typename Keep, typename Bend>
scenes::VolumeMesh make_mesh(const Block& block, Keep&& keep, Bend&& bend) {
  constexpr std::array<std::array<std::size_t, 3>, 6> kOrders = {
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {1, 0, 2}, {2, 1, 0}}};
  scenes::VolumeMesh mesh;
  mesh.points_per_cell = 4;
  std::map<std::array<int, 3>, std::int32_t> numbers;
  const auto number = [&](const std::array<int, 3>& at) {
    const auto [found, is_new] = numbers.emplace(at, static_cast<std::int32_t>(mesh.point_count()));
    if (is_new) {
      const Point point = bend(Point(block.size * Point(at[0], at[1], at[2])));
      mesh.points.insert(mesh.points.end(), point.data(), point.data() + 3);
    }
    return found->second;
  };
  for (int x = block.low[0]; x < block.high[0]; ++x) {
    for (int y = block.low[1]; y < block.high[1]; ++y) {
      for (int z = block.low[2]; z < block.high[2]; ++z) {
        if (!keep(Point(block.size * Point(x + 0.5, y + 0.5, z + 0.5)))) continue;
        for (std::size_t i = 0; i < kOrders.size(); ++i) {
          std::array<int, 3> at = {x, y, z};
          std::int32_t corners[4] = {number(at)};
          for (std::size_t k = 0; k < 3; ++k) {
            ++at[kOrders[i][k]];
            corners[k + 1] = number(at);
          }
          if (i >= 3) std::swap(corners[1], corners[2]);
          mesh.connectivity.insert(mesh.connectivity.end(), corners, corners + 4);
        }
      }
    }
  }
  return mesh;
}

std::size_t steps_for(double length, double way) { return static_cast<std::size_t>(std::lround(length / way)); }

const auto kEverywhere = [](const Point&) { return true; };

/** The part of a way along a direction, if it goes there at all. */
Allowed part_along(const Point& direction, const Point& way) { return {direction, std::max(0.0, way.dot(direction))}; }

Points line(const Point& from, const Point& to, std::size_t edges) {
  Points points;
  for (std::size_t i = 0; i <= edges; ++i) {
    points.push_back(from + static_cast<double>(i) / static_cast<double>(edges) * (to - from));
  }
  return points;
}

/** Everyone by the same way, and a little aside. */
Points shifted(const Points& at, const Point& way, double aside, scenes::Random& random) {
  Points targets;
  for (const Point& point : at) {
    const double s = random.uniform(-1, 1), t = random.uniform(-1, 1);
    targets.push_back(point + way + Point(0, aside * s, aside * t));
  }
  return targets;
}

/** The last vertex goes a way, the others follow it as far as their edges pull them. */
Points pulled(const Points& at, const Point& way, double length) {
  Points targets = at;
  targets.back() += way;
  for (std::size_t i = at.size() - 1; i-- > 0;) {
    const Point off = at[i] - targets[i + 1];
    targets[i] = targets[i + 1] + length / std::max(off.norm(), length) * off;
  }
  return targets;
}

PressedScene corner(double way) {
  PressedScene scene;
  scene.name = "corner";
  scene.mesh = make_mesh({{0, 0, 0}, {20, 4, 4}, 0.25}, kEverywhere, [](const Point& p) { return p; });
  scene.start = {{0.4, 0.05, 0.04}};
  scene.steps = steps_for(3.6, way), scene.first = steps_for(0.3, way);
  scene.targets = [way](std::size_t, const Points& at, scenes::Random& random) {
    const double y = random.uniform(0.2, 1.5), z = random.uniform(0.2, 1.5);
    return Points{at[0] + way * Point(1, -y, -z)};
  };
  scene.allowed = [](const Point& from, const Point& to) { return part_along(Point::UnitX(), to - from); };
  return scene;
}

/** A groove whose bottom is the x axis. @param slope of its sides */
scenes::VolumeMesh groove(double slope) {
  return make_mesh({{0, -6, 0}, {40, 6, 6}, 0.25}, kEverywhere,
                   [slope](const Point& p) { return Point(p.x(), p.y(), p.z() + slope * std::abs(p.y())); });
}

constexpr double kSteep = 2.7474774194546216;  // walls 40 degrees apart

PressedScene along_wedge(double way) {
  PressedScene scene;
  scene.name = "along_wedge";
  scene.mesh = groove(kSteep);
  scene.start = {{0.4, 0.01, 0.1}};
  scene.steps = steps_for(7.5, way), scene.first = steps_for(0.6, way);
  scene.targets = [way](std::size_t, const Points& at, scenes::Random& random) {
    return Points{at[0] + way * Point(1, random.uniform(-1, 1), -random.uniform(0.2, 1.5))};
  };
  scene.allowed = [](const Point& from, const Point& to) { return part_along(Point::UnitX(), to - from); };
  return scene;
}

/** From one side down to the bottom, again and again. */
PressedScene into_wedge(double way) {
  const std::size_t fall = steps_for(1.8, way);
  PressedScene scene;
  scene.name = "into_wedge";
  scene.mesh = groove(kSteep);
  scene.start = {{5.1, 0.3, 0.3 * kSteep + 0.2}};
  scene.steps = 10 * fall, scene.first = 0;
  scene.targets = [fall, way](std::size_t step, const Points& at, scenes::Random& random) {
    if (step % fall == 0) {  // up again, freely
      const double side = step / fall % 2 == 0 ? 0.3 : -0.3;
      return Points{Point(5.1, side, std::abs(side) * kSteep + 0.2)};
    }
    return Points{at[0] + way * Point(random.uniform(-0.2, 0.2), random.uniform(-0.5, 0.5), -1)};
  };
  // Down the wall that it lies on, until the bottom.
  scene.allowed = [](const Point& from, const Point& to) {
    const Point down = Point(0, from.y() > 0 ? -1 : 1, -kSteep).normalized();
    Allowed allowed = part_along(down, to - from);
    allowed.length = std::min(allowed.length, std::hypot(from.y(), from.z()));
    return allowed;
  };
  return scene;
}

PressedScene chain_in_groove(double way) {
  PressedScene scene;
  scene.name = "chain_in_groove";
  scene.mesh = groove(1);
  scene.start = line({0.4, 0, 0.05}, {4.4, 0, 0.05}, 10);
  scene.steps = steps_for(4.5, way), scene.first = steps_for(0.3, way);
  scene.targets = [way](std::size_t, const Points& at, scenes::Random& random) {
    return shifted(at, way * Point(1, 0, -1), way, random);
  };
  scene.allowed = [](const Point& from, const Point& to) { return part_along(Point::UnitX(), to - from); };
  return scene;
}

/** Two vertices on both sides of a ridge along the y axis: the edge between them lies on it. */
PressedScene edge_on_ridge(double way) {
  PressedScene scene;
  scene.name = "edge_on_ridge";
  scene.mesh = make_mesh({{-12, 0, 0}, {12, 32, 8}, 0.25}, kEverywhere, [](const Point& p) {
    const double floor = std::max(0.0, 1 - std::abs(p.x()));
    return Point(p.x(), p.y(), floor + p.z() * (2 - floor) / 2);
  });
  scene.start = {{-1.6, 0.5, 1.05}, {1.5, 1.0, 1.05}};
  scene.steps = steps_for(4.8, way), scene.first = steps_for(0.15, way);
  const std::size_t turn = steps_for(0.6, way);
  scene.targets = [turn, way](std::size_t step, const Points& at, scenes::Random& random) {
    const double side = step / turn % 2 == 0 ? 0.7 : -0.7;
    Points targets;
    for (const Point& point : at) targets.push_back(point + way * Point(side, 1, -random.uniform(0.2, 1)));
    return targets;
  };
  scene.allowed = [](const Point& from, const Point& to) {
    Point level = to - from;
    level.z() = 0;
    return Allowed{level.normalized(), level.norm()};
  };
  return scene;
}

/** Up a ramp, along a floor and over the edge of a step. */
PressedScene rope_over_step(double way) {
  constexpr double kRamp = 2, kFlat = 3, kHeight = 0.5, kStep = 5;
  const auto floor_at = [](double x) { return kHeight * std::clamp((x - kRamp) / (kFlat - kRamp), 0.0, 1.0); };
  PressedScene scene;
  scene.name = "rope_over_step";
  scene.mesh = make_mesh(
      {{0, -2, -2}, {48, 2, 4}, 0.25}, [](const Point& p) { return p.z() > 0 || p.x() > kStep; },
      [floor_at](const Point& p) {
        const double floor = floor_at(p.x());
        return Point(p.x(), p.y(), p.z() < 0 ? floor + p.z() : floor + p.z() * (1 - floor));
      });
  scene.start = line({0.1, 0.02, 0.03}, {1.9, 0.02, 0.03}, 20);
  scene.steps = steps_for(9, way), scene.first = steps_for(0.15, way);
  scene.targets = [way](std::size_t, const Points& at, scenes::Random& random) {
    Points targets = pulled(at, way * Point(1, 0, 0), 0.09);
    for (Point& target : targets) target -= way * Point(0, 0, random.uniform(0.1, 0.4));
    return targets;
  };
  const Point up = Point(kFlat - kRamp, 0, floor_at(kFlat)).normalized();
  scene.allowed = [up](const Point& from, const Point& to) {
    const bool on_ramp = from.x() > kRamp && from.x() < kFlat;
    return part_along(on_ramp ? up : Point(1, 0, 0), to - from);
  };
  return scene;
}

/** Through a channel that turns back in half a circle, pressed on its inner wall. */
PressedScene through_bend(const std::string& name, std::size_t edges, double length, double roughness, double way) {
  constexpr double kCube = 0.3, kRadius = 1.5, kPi = 3.141592653589793, kTravel = 9;
  constexpr int kIn = 20, kArc = 16, kOut = 26;  // cubes
  const double enters = kCube * kIn, leaves = kCube * (kIn + kArc);
  scenes::Random random(5);
  PressedScene scene;
  scene.name = name;
  scene.mesh = make_mesh({{0, -2, -2}, {kIn + kArc + kOut, 2, 2}, kCube}, kEverywhere, [&](const Point& smooth) {
    const double x = random.uniform(-1, 1), y = random.uniform(-1, 1), z = random.uniform(-1, 1);
    const Point p = smooth + kCube * roughness * Point(x, y, z);
    if (p.x() <= enters) return p;
    if (p.x() >= leaves) return Point(enters - (p.x() - leaves), 2 * kRadius - p.y(), p.z());
    const double angle = kPi * (p.x() - enters) / (leaves - enters), radius = kRadius - p.y();
    return Point(enters + radius * std::sin(angle), kRadius - radius * std::cos(angle), p.z());
  });
  const auto along = [enters](const Point& at) {
    if (at.x() <= enters) return Point(at.y() < kRadius ? 1 : -1, 0, 0);
    return Point(kRadius - at.y(), at.x() - enters, 0).normalized();
  };
  const double end = enters - 0.1;
  scene.start = line({end - length * static_cast<double>(edges), 0.55, 0.02}, {end, 0.55, 0.02}, edges);
  scene.steps = steps_for(kTravel, way), scene.first = steps_for(0.15, way);
  scene.targets = [along, way](std::size_t, const Points& at, scenes::Random&) {
    Points targets;
    for (const Point& point : at) {
      const Point forward = along(point);
      targets.push_back(point + way * (forward + 0.4 * Point(-forward.y(), forward.x(), 0)));
    }
    return targets;
  };
  if (roughness > 0) return scene;
  scene.allowed = [along](const Point& from, const Point& to) { return part_along(along(from), to - from); };
  return scene;
}

}  // namespace

Allowed allowed_by(const Points& normals, const Point& way) {
  const auto is_free = [&](const Point& part) {
    return std::all_of(normals.begin(), normals.end(),
                       [&](const Point& normal) { return part.dot(normal) >= -1e-9 * way.norm(); });
  };
  Point best = Point::Zero();  // in a corner
  const auto try_part = [&](const Point& part) {
    if (is_free(part) && (part - way).squaredNorm() < (best - way).squaredNorm()) best = part;
  };
  try_part(way);
  for (const Point& a : normals) {
    try_part(way - way.dot(a) * a);
    for (const Point& b : normals) {
      const Point crease = a.cross(b);
      if (crease.norm() > 1e-6) try_part(way.dot(crease) / crease.squaredNorm() * crease);
    }
  }
  return {best.norm() > 0 ? Point(best.normalized()) : best, best.norm()};
}

std::vector<PressedScene> pressed_scenes(double way) {
  return {corner(way),
          along_wedge(way),
          into_wedge(way),
          chain_in_groove(way),
          edge_on_ridge(way),
          rope_over_step(way),
          through_bend("rope_through_bend", 20, 0.14, 0, way),
          through_bend("chain_through_bend", 6, 0.8, 0, way),
          through_bend("rope_through_rough_bend", 20, 0.14, 0.15, way)};
}

}  // namespace dsw::bench
