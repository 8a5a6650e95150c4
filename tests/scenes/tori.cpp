#include "scenes/tori.h"

#include <cmath>

namespace dsw::scenes {

namespace {

constexpr std::uint32_t kRound = 6, kTube = 3;

std::uint32_t vertex(std::uint32_t i, std::uint32_t j) { return i % kRound * kTube + j % kTube; }

/** Points of a regular polygon on the unit circle: the first has angle 0, `turn` is the second. */
template <std::size_t N>
std::array<std::array<double, 2>, N> polygon(std::array<double, 2> turn) {
  std::array<std::array<double, 2>, N> points{};
  points[0] = {1.0, 0.0};
  for (std::size_t i = 1; i < N; ++i) {
    points[i] = {points[i - 1][0] * turn[0] - points[i - 1][1] * turn[1],
                 points[i - 1][0] * turn[1] + points[i - 1][1] * turn[0]};
  }
  return points;
}

}  // namespace

std::array<std::array<std::uint32_t, 2>, kTorusEdges> torus_edges() {
  std::array<std::array<std::uint32_t, 2>, kTorusEdges> edges{};
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < kRound; ++i) {
    for (std::uint32_t j = 0; j < kTube; ++j) {
      edges[count++] = {vertex(i, j), vertex(i + 1, j)};
      edges[count++] = {vertex(i, j), vertex(i, j + 1)};
      edges[count++] = {vertex(i, j), vertex(i + 1, j + 1)};
    }
  }
  return edges;
}

std::array<std::array<std::uint32_t, 3>, kTorusFaces> torus_faces() {
  std::array<std::array<std::uint32_t, 3>, kTorusFaces> faces{};
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < kRound; ++i) {
    for (std::uint32_t j = 0; j < kTube; ++j) {
      faces[count++] = {vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)};
      faces[count++] = {vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)};
    }
  }
  return faces;
}

TorusMotion::TorusMotion(const HexGrid& grid, const TorusOptions& options) : Drift(grid, options) {
  const double height = std::sqrt(0.75);
  const auto round = polygon<kRound>({0.5, height});
  const auto tube = polygon<kTube>({-0.5, height});
  const auto torus = [&](const Frame& frame) {
    Corners corners;
    for (std::uint32_t i = 0; i < kRound; ++i) {
      for (std::uint32_t j = 0; j < kTube; ++j) {
        const double out = options.ring + options.tube * tube[j][0];
        const double at[3] = {out * round[i][0], out * round[i][1], options.tube * tube[j][1]};
        for (std::size_t k = 0; k < 3; ++k) {
          corners[vertex(i, j)][k] = at[0] * frame[0][k] + at[1] * frame[1][k] + at[2] * frame[2][k];
        }
      }
    }
    return corners;
  };
  place_all(torus, [this](const double* vertices) { return has_room(vertices); });
}

/** Whether every cell that the vertices' box meets is passable. */
bool TorusMotion::has_room(const double* vertices) const {
  std::array<double, 3> low{}, high{};
  for (std::size_t k = 0; k < 3; ++k) {
    low[k] = high[k] = vertices[k];
    for (std::size_t i = 1; i < kTorusVertices; ++i) {
      low[k] = std::fmin(low[k], vertices[3 * i + k]);
      high[k] = std::fmax(high[k], vertices[3 * i + k]);
    }
  }
  if (grid_.cell_at(low.data()) == kNone || grid_.cell_at(high.data()) == kNone) {
    return false;
  }
  for (auto z = static_cast<std::uint32_t>(low[2]); z <= static_cast<std::uint32_t>(high[2]); ++z) {
    for (auto y = static_cast<std::uint32_t>(low[1]); y <= static_cast<std::uint32_t>(high[1]); ++y) {
      for (auto x = static_cast<std::uint32_t>(low[0]); x <= static_cast<std::uint32_t>(high[0]); ++x) {
        if (grid_.obstacle[grid_.cell(x, y, z)] != 0) {
          return false;
        }
      }
    }
  }
  return true;
}

void TorusMotion::advance(const std::vector<std::uint8_t>& arrived) {
  for (std::size_t i = 0; i < body_count(); ++i) {
    if (arrived[i] != 0) {
      arrive(i);
    } else {
      press(i);
    }
  }
  aim();
}

}  // namespace dsw::scenes
