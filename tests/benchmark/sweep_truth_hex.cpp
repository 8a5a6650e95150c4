#include "sweep_truth_hex.h"

#include <gmpxx.h>

#include <algorithm>
#include <cmath>

namespace dsw::bench {

namespace {

using Vector = std::array<mpq_class, 3>;

Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
mpq_class dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/** Whether an axis keeps triangle and box apart. */
bool separates(const Vector& axis, const std::array<Vector, 3>& triangle, const Vector& low) {
  mpq_class box_low = dot(axis, low), box_high = box_low;
  for (std::size_t k = 0; k < 3; ++k) (axis[k] < 0 ? box_low : box_high) += axis[k];
  const mpq_class at[3] = {dot(axis, triangle[0]), dot(axis, triangle[1]), dot(axis, triangle[2])};
  return *std::max_element(at, at + 3) < box_low || *std::min_element(at, at + 3) > box_high;
}

/** Separating axes: the box's, the triangle's normal, and what is across the edges of both. */
bool meets_unit_box(const std::array<Vector, 3>& triangle, const Vector& low) {
  const std::array<Vector, 3> units = {Vector{1, 0, 0}, Vector{0, 1, 0}, Vector{0, 0, 1}};
  const Vector edges[3] = {minus(triangle[1], triangle[0]), minus(triangle[2], triangle[1]),
                           minus(triangle[0], triangle[2])};
  if (separates(cross(edges[0], edges[1]), triangle, low)) return false;
  for (const Vector& unit : units) {
    if (separates(unit, triangle, low)) return false;
    for (const Vector& edge : edges) {
      if (separates(cross(unit, edge), triangle, low)) return false;
    }
  }
  return true;
}

}  // namespace

bool triangle_meets_obstacle(const scenes::HexGrid& grid, const double* a, const double* b, const double* c) {
  const std::array<Vector, 3> triangle = {Vector{a[0], a[1], a[2]}, Vector{b[0], b[1], b[2]}, Vector{c[0], c[1], c[2]}};
  std::int64_t low[3], high[3];
  for (std::size_t k = 0; k < 3; ++k) {
    low[k] = static_cast<std::int64_t>(std::floor(std::min({a[k], b[k], c[k]})));
    high[k] = static_cast<std::int64_t>(std::floor(std::max({a[k], b[k], c[k]})));
    if (low[k] < 0 || high[k] >= static_cast<std::int64_t>(grid.options.size[k])) return true;
  }
  for (std::int64_t z = low[2]; z <= high[2]; ++z) {
    for (std::int64_t y = low[1]; y <= high[1]; ++y) {
      for (std::int64_t x = low[0]; x <= high[0]; ++x) {
        const std::uint32_t cell = grid.cell(std::uint32_t(x), std::uint32_t(y), std::uint32_t(z));
        if (grid.obstacle[cell] != 0 && meets_unit_box(triangle, {double(x), double(y), double(z)})) return true;
      }
    }
  }
  return false;
}

}  // namespace dsw::bench
