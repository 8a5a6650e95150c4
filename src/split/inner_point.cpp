#include "split/inner_point.h"

#include <cmath>

namespace dsw {
namespace {

/** What is inside of a triangle, in a frame in which the boundary's box has the size 1. */
struct HalfSpace {
  double normal[3], distance;  // inwards; of the origin
  double room(const double* x) const { return normal[0] * x[0] + normal[1] * x[1] + normal[2] * x[2] + distance; }
};

struct Frame {
  double middle[3], scale = 0;

  Frame(const PartPoints<3>& at, const PartHull<3>& boundary) {
    double low[3], high[3];
    for (int k = 0; k < 3; ++k) low[k] = high[k] = at[boundary[0].v[0]][k] / 2;
    for (const PartSide<3>& s : boundary) {
      for (const uint32_t v : s.v) {
        for (int k = 0; k < 3; ++k) {
          low[k] = std::min(low[k], at[v][k] / 2);
          high[k] = std::max(high[k], at[v][k] / 2);
        }
      }
    }
    for (int k = 0; k < 3; ++k) {
      middle[k] = low[k] + high[k];
      scale = std::max(scale, high[k] - low[k]);
    }
  }
  void to_unit(const double* p, double* out) const {
    for (int k = 0; k < 3; ++k) out[k] = (p[k] / 2 - middle[k] / 2) / scale;
  }
  void from_unit(const double* x, double* out) const {
    for (int k = 0; k < 3; ++k) out[k] = middle[k] + 2 * (x[k] * scale);
  }
};

bool half_space(const PartPoints<3>& at, const Frame& frame, const PartSide<3>& s, HalfSpace& out) {
  double p[3][3];
  for (int k = 0; k < 3; ++k) frame.to_unit(at[s.v[k]], p[k]);
  double n[3];
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    n[k] = (p[2][i] - p[0][i]) * (p[1][j] - p[0][j]) - (p[2][j] - p[0][j]) * (p[1][i] - p[0][i]);
  }
  const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  if (!(length > 0)) return false;
  for (int k = 0; k < 3; ++k) out.normal[k] = n[k] / length;
  out.distance = -(out.normal[0] * p[0][0] + out.normal[1] * p[0][1] + out.normal[2] * p[0][2]);
  return true;
}

/** Steps over the planes that it is too near to, until it has the room. */
bool relax(const Array<HalfSpace>& spaces, double room, double* x) {
  constexpr int kSteps = 400;
  constexpr double kBeyond = 1.5;
  for (int step = 0; step < kSteps; ++step) {
    const HalfSpace* worst = nullptr;
    double least = room;
    for (const HalfSpace& space : spaces) {
      const double has = space.room(x);
      if (has < least) {
        least = has;
        worst = &space;
      }
    }
    if (worst == nullptr) return true;
    for (int k = 0; k < 3; ++k) x[k] += worst->normal[k] * kBeyond * (room - least);
  }
  return false;
}

}  // namespace

bool find_inner_point(const PartPoints<3>& at, const PartHull<3>& boundary, double* out) {
  const Frame frame(at, boundary);
  Array<HalfSpace> spaces(at.memory());
  double x[3] = {};
  for (const PartSide<3>& s : boundary) {
    HalfSpace space{};
    if (!half_space(at, frame, s, space)) return false;
    spaces.push_back(space);
  }
  constexpr double kMost = 0.25, kLeast = 0x1p-32;
  for (double room = kMost; room > kLeast; room /= 2) {
    if (!relax(spaces, room, x)) continue;
    frame.from_unit(x, out);
    const bool is_finite = std::isfinite(out[0]) && std::isfinite(out[1]) && std::isfinite(out[2]);
    if (is_finite && is_star_of<3>(at, boundary, out)) return true;
  }
  return false;
}

}  // namespace dsw
