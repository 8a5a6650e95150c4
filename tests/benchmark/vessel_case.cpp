#include "vessel_case.h"

#include "scenes/tets.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace dsw::bench {

namespace {

constexpr std::uint32_t kSide = 33;  // cubes of six tetrahedra each: 215,622
constexpr double kCube = 4.0;        // as fine as the phantom's tissue, scene units
constexpr double kRadius = 10.0;

std::array<double, 3> generated_centre(double x) {
  const double turn = 6.283185307179586 / (kSide * kCube);
  const double middle = 0.5 * kSide * kCube;
  return {x, middle + 30.0 * std::sin(1.5 * turn * x), middle + 30.0 * std::sin(turn * x)};
}

double distance(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/** Path 0 of a centreline file: path,name,index,x,y,z,r. */
std::vector<std::array<double, 3>> read_line(const std::string& file_name) {
  std::ifstream file(file_name);
  std::vector<std::array<double, 3>> points;
  std::string text;
  while (std::getline(file, text)) {
    if (text.rfind("0,", 0) != 0) continue;
    std::istringstream fields(text);
    std::string field;
    for (int i = 0; i < 3; ++i) std::getline(fields, field, ',');
    std::array<double, 3> point{};
    for (double& value : point) {
      std::getline(fields, field, ',');
      value = std::stod(field);
    }
    points.push_back(point);
  }
  if (points.size() < 2) throw std::runtime_error("cannot read " + file_name);
  return points;
}

std::vector<std::array<double, 3>> make_line() {
  std::vector<std::array<double, 3>> points;
  for (double x = kCube; x < (kSide - 1) * kCube; x += 0.25 * kCube) points.push_back(generated_centre(x));
  return points;
}

WallMesh marked_wall(const scenes::VolumeMesh& mesh, World& world) {
  check(dsw_environment_mark_between(world.environment(), 1, 2, DSW_MARK_IMPASSABLE, nullptr));
  return {mesh.points, scenes::region_walls(mesh, scenes::tet_neighbours(mesh)).all};
}

}  // namespace

scenes::VolumeMesh read_vessel(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::int64_t counts[2] = {};
  file.read(reinterpret_cast<char*>(counts), sizeof counts);
  if (!file || counts[0] < 4 || counts[1] < 1 || counts[0] > 100000000 || counts[1] > 100000000) {
    throw std::runtime_error("cannot read " + path);
  }
  scenes::VolumeMesh mesh;
  mesh.points_per_cell = 4;
  const auto read = [&](auto& values, std::int64_t count) {
    values.resize(static_cast<std::size_t>(count));
    file.read(reinterpret_cast<char*>(values.data()),
              static_cast<std::streamsize>(values.size() * sizeof(values.front())));
  };
  read(mesh.points, 3 * counts[0]);
  read(mesh.connectivity, 4 * counts[1]);
  read(mesh.regions, counts[1]);
  if (!file) throw std::runtime_error("cannot read " + path);
  return mesh;
}

scenes::VolumeMesh make_vessel() {
  scenes::VolumeMesh mesh;
  mesh.points_per_cell = 4;
  constexpr auto row = static_cast<std::int32_t>(kSide + 1), layer = row * row;
  for (std::uint32_t z = 0; z <= kSide; ++z) {
    for (std::uint32_t y = 0; y <= kSide; ++y) {
      for (std::uint32_t x = 0; x <= kSide; ++x) {
        mesh.points.insert(mesh.points.end(), {kCube * x, kCube * y, kCube * z});
      }
    }
  }
  // Six tetrahedra round the diagonal of each cube, one for each order of the axes.
  constexpr std::int32_t steps[3] = {1, row, layer};
  constexpr std::array<std::array<std::uint32_t, 3>, 6> orders = {
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {1, 0, 2}, {2, 1, 0}}};
  for (std::uint32_t cube = 0; cube < kSide * kSide * kSide; ++cube) {
    const std::uint32_t x = cube % kSide, y = cube / kSide % kSide, z = cube / (kSide * kSide);
    const auto p =
        static_cast<std::int32_t>(x) + row * static_cast<std::int32_t>(y) + layer * static_cast<std::int32_t>(z);
    for (std::size_t i = 0; i < orders.size(); ++i) {
      const std::int32_t a = p + steps[orders[i][0]], b = a + steps[orders[i][1]], c = b + steps[orders[i][2]];
      const bool odd = i >= 3;
      mesh.connectivity.insert(mesh.connectivity.end(), {p, odd ? b : a, odd ? a : b, c});
    }
    const std::array<double, 3> middle = {kCube * (x + 0.5), kCube * (y + 0.5), kCube * (z + 0.5)};
    const bool inside = distance(middle, generated_centre(middle[0])) < kRadius && x > 0 && x + 1 < kSide;
    mesh.regions.insert(mesh.regions.end(), 6, inside ? 1 : 2);
  }
  return mesh;
}

Line::Line(std::vector<std::array<double, 3>> points) : points_(std::move(points)), at_{0.0} {
  for (std::size_t i = 1; i < points_.size(); ++i) at_.push_back(at_.back() + distance(points_[i - 1], points_[i]));
}

std::array<double, 3> Line::point(double distance) const {
  const auto next = std::upper_bound(at_.begin() + 1, at_.end() - 1, distance);
  const auto i = static_cast<std::size_t>(next - at_.begin());
  const double share = (distance - at_[i - 1]) / (at_[i] - at_[i - 1]);
  std::array<double, 3> point{};
  for (std::size_t k = 0; k < 3; ++k) point[k] = points_[i - 1][k] + share * (points_[i][k] - points_[i - 1][k]);
  return point;
}

std::array<double, 3> Line::direction(double distance) const {
  const double reach = 0.5;
  const auto a = point(std::max(0.0, distance - reach)), b = point(std::min(length(), distance + reach));
  const double size = bench::distance(a, b);
  return {(b[0] - a[0]) / size, (b[1] - a[1]) / size, (b[2] - a[2]) / size};
}

VesselCase::VesselCase(const std::string& mesh_file, const std::string& line_file)
    : mesh(mesh_file.empty() ? make_vessel() : read_vessel(mesh_file)),
      world(mesh, 1),
      walls(marked_wall(mesh, world)),
      line(mesh_file.empty() ? make_line() : read_line(line_file)) {}

}  // namespace dsw::bench
