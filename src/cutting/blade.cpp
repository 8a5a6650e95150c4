#include "cutting/blade.h"

namespace dsw {
namespace {

/** The point of segment a b that is nearest to the origin. */
Vec nearest_on_segment(const Vec& a, const Vec& b) {
  const Vec along = b - a;
  const double size = dot(along, along), share = size > 0 ? -dot(a, along) / size : 0;
  return a + std::min(std::max(share, 0.0), 1.0) * along;
}

}  // namespace

Vec to_triangle(const double* from, const double* const* corners) {
  Vec at[3];
  double scale = 0;
  for (int k = 0; k < 3; ++k) {
    at[k] = difference(corners[k], from);
    scale = std::max({scale, std::fabs(at[k].x), std::fabs(at[k].y), std::fabs(at[k].z)});
  }
  if (!(scale > 0) || !std::isfinite(scale)) return at[0];
  for (Vec& v : at) v = {v.x / scale, v.y / scale, v.z / scale};  // no square over- or underflows
  Vec best = at[0];
  for (int k = 0; k < 3; ++k) {
    const Vec on_side = nearest_on_segment(at[k], at[(k + 1) % 3]);
    if (dot(on_side, on_side) < dot(best, best)) best = on_side;
  }
  const Vec normal = cross(at[1] - at[0], at[2] - at[0]);
  bool inside = !is_zero(normal);
  for (int k = 0; k < 3; ++k) inside = inside && dot(cross(at[k], at[(k + 1) % 3]), normal) >= 0;
  if (inside) {
    const Vec down = dot(at[0], normal) / dot(normal, normal) * normal;
    if (dot(down, down) < dot(best, best)) best = down;
  }
  return scale * best;
}

}  // namespace dsw
