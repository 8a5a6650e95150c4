#include "surface.h"

#include <cmath>
#include <fstream>
#include <set>
#include <sstream>
#include <stdexcept>

namespace dsw::bench {

Surface read_surface(const std::string& path) {
  std::ifstream file(path);
  Surface surface;
  std::string line;
  while (std::getline(file, line)) {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    if (kind == "v") {
      double xyz[3];
      words >> xyz[0] >> xyz[1] >> xyz[2];
      surface.points.insert(surface.points.end(), xyz, xyz + 3);
    } else if (kind == "f") {
      std::array<std::uint32_t, 3> face{};
      for (std::uint32_t& corner : face) {
        words >> corner;
        --corner;
        if (corner >= surface.points.size() / 3) throw std::runtime_error(path + ": a corner is no vertex");
      }
      surface.faces.push_back(face);
    }
    if (words.fail() && (kind == "v" || kind == "f")) throw std::runtime_error(path + ": " + line);
  }
  if (surface.faces.empty()) throw std::runtime_error("cannot read " + path);
  return surface;
}

Surface make_surface() {
  constexpr std::uint32_t kRound = 200, kTube = 60;
  constexpr double kTurn = 6.283185307179586;
  Surface surface;
  const auto vertex = [](std::uint32_t i, std::uint32_t j) { return i % kRound * kTube + j % kTube; };
  for (std::uint32_t i = 0; i < kRound; ++i) {
    for (std::uint32_t j = 0; j < kTube; ++j) {
      const double u = kTurn * i / kRound, v = kTurn * j / kTube;
      const double tube = 0.1 + 0.03 * std::sin(7 * u) * std::cos(2 * v), out = 0.35 + tube * std::cos(v);
      surface.points.insert(surface.points.end(), {out * std::cos(u), out * std::sin(u), tube * std::sin(v)});
      surface.faces.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
      surface.faces.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
    }
  }
  return surface;
}

std::vector<std::uint32_t> surface_edges(const Surface& surface) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const auto& face : surface.faces) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = face[k], b = face[(k + 1) % 3];
      edges.emplace(std::min(a, b), std::max(a, b));
    }
  }
  std::vector<std::uint32_t> all;
  for (const auto& [a, b] : edges) {
    all.push_back(a);
    all.push_back(b);
  }
  return all;
}

}  // namespace dsw::bench
