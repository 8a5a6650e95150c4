#include "cutting/blade.h"

#include "base/key_table.h"

namespace dsw {
namespace {

/** The point of segment a b that is nearest to the origin. */
Vec nearest_on_segment(const Vec& a, const Vec& b) {
  const Vec along = b - a;
  const double size = dot(along, along), share = size > 0 ? -dot(a, along) / size : 0;
  return a + std::min(std::max(share, 0.0), 1.0) * along;
}

}  // namespace

Blade::Blade(const Memory* memory, PointArray points, uint32_t point_count)
    : points_(points), point_count_(point_count), triangles_(Allocator<Triangle>(memory)) {}

Blade Blade::of_grid(const Memory* memory, PointArray points, uint32_t rows, uint32_t columns) {
  Blade blade(memory, points, rows * columns);
  blade.triangles_.reserve(size_t{2} * (rows - 1) * (columns - 1));
  for (uint32_t first = 0; first + columns < rows * columns; ++first) {
    if (first % columns + 1 == columns) continue;
    const uint32_t across = first + columns + 1;
    blade.add(first, first + 1, across);
    blade.add(first, across, across - 1);
  }
  blade.join(memory);
  return blade;
}

Blade Blade::of_triangles(const Memory* memory, PointArray points, uint32_t point_count, const uint32_t* corners,
                          uint32_t triangle_count) {
  Blade blade(memory, points, point_count);
  blade.triangles_.reserve(triangle_count);
  for (size_t t = 0; t < triangle_count; ++t) blade.add(corners[3 * t], corners[3 * t + 1], corners[3 * t + 2]);
  blade.join(memory);
  return blade;
}

Blade Blade::fan(const Memory* memory, PointArray points, uint32_t point_count) {
  Blade blade(memory, points, point_count);
  const uint32_t centre = point_count - 1;
  for (uint32_t i = 0; i < centre; ++i) blade.add(i, (i + 1) % centre, centre);
  blade.join(memory);
  return blade;
}

/** Sides are neighbours that join the same points in opposite directions; where there are several, those named first. */
void Blade::join(const Memory* memory) {
  KeyTable ways(memory);                                 // from one point to another
  Array<uint32_t> waiting{Allocator<uint32_t>(memory)};  // of each way, the first side without a neighbour, or kNone
  Array<uint32_t> next(3 * triangles_.size(), kNone, waiting.get_allocator());  // such side that is named later
  for (size_t side = 3 * triangles_.size(); side-- != 0;) {
    const uint32_t* const ends = triangles_[side / 3].corners;
    const uint32_t from = ends[side % 3], to = ends[(side + 1) % 3];
    const uint32_t way = ways.insert(uint64_t{from} << 32 | to), back = ways.insert(uint64_t{to} << 32 | from);
    waiting.resize(ways.size(), kNone);
    const uint32_t other = waiting[back];
    if (other == kNone) {
      next[side] = waiting[way];
      waiting[way] = static_cast<uint32_t>(side);
    } else {
      waiting[back] = next[other];
      triangles_[side / 3].neighbours[side % 3] = other / 3;
      triangles_[other / 3].neighbours[other % 3] = static_cast<uint32_t>(side / 3);
    }
  }
}

uint32_t Blade::find_rim() const {
  for (uint32_t t = 0; t < triangle_count(); ++t) {
    for (const uint32_t neighbour : triangles_[t].neighbours) {
      if (neighbour == kNone) return t;
    }
  }
  return kNone;
}

Vec to_triangle(const double* from, const double* const* corners) {
  Vec at[3];
  double scale = 0;
  for (int k = 0; k < 3; ++k) {
    at[k] = difference<3>(corners[k], from);
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
