#include "environment/validity.h"

#include "predicates/filtered.h"

namespace dsw {
namespace {

/** Exactly flat facets, and no vertex beyond a facet across any of its edges: with positive stars that cover every
 * direction once, locally convex is convex. Facets have to be convex too, which says more where two lie in one plane. */
bool is_flat_and_convex(const Environment<3>& env, Cell c, const Shape& shape, const double* apex) noexcept {
  const double* triangle[3];
  for (uint32_t f = 0; f < shape.facet_count(); ++f) {
    simplex_points(env, c, shape, shape.simplex_first(f), triangle);
    for (uint32_t d = shape.facet_first(f); d < shape.facet_first(f + 1); ++d) {
      if (shape.facet_size(f) > 3 && orient<3>(triangle, env.point(c, shape.dart_vertex(d))) != 0) return false;
      const uint32_t beyond = shape.beta0(shape.dart_beta2(d));
      if (orient<3>(triangle, env.point(c, shape.dart_vertex(beyond))) > 0) return false;
      if (shape.facet_size(f) == 3) continue;
      const uint32_t corner[3] = {shape.beta0(d), d, shape.beta1(d)};
      const double* turn[3];
      for (int k = 0; k < 3; ++k) turn[k] = env.point(c, shape.dart_vertex(corner[k]));
      if (orient<3>(turn, apex) > 0) return false;
    }
  }
  return true;
}

bool is_flat_and_convex(const Environment<2>& env, Cell c, const Shape& shape, const double*) noexcept {
  const uint32_t n = shape.vertex_count();
  for (uint32_t i = 0; i < n; ++i) {
    const double* edge[2] = {env.point(c, i), env.point(c, (i + 1) % n)};
    if (orient<2>(edge, env.point(c, (i + 2) % n)) > 0) return false;
  }
  return true;
}

/** How many boundary simplices the ray from `from` (strictly inside all of them) through `through` pierces, both shifted. */
template <int D>
uint32_t count_pierced(const Environment<D>& env, Cell c, const Shape& shape, const double* from,
                       const double* through) noexcept {
  NoTally none;
  uint32_t count = 0;
  for (uint32_t s = 0; s < shape.simplex_count(); ++s) {
    const double* points[D];
    simplex_points(env, c, shape, s, points);
    bool pierced = true;
    for (int k = 0; k < D && pierced; ++k) {
      if constexpr (D == 3) {
        const double* ridge[2] = {points[k], points[(k + 1) % 3]};
        pierced = line_side<3>(from, through, ridge, none).sign > 0;
      } else {
        pierced = line_side<2>(from, through, &points[k], none).sign == (k == 0 ? -1 : 1);
      }
    }
    count += pierced ? 1u : 0u;
  }
  return count;
}

}  // namespace

template <int D>
CellState check_cell(const Environment<D>& env, Cell c) noexcept {
  const Shape shape = env.map.shape(c);
  if (env.map.form(c) == Form::kSimplex) {
    const double* points[D];
    simplex_points(env, c, shape, 0, points);
    const int side = orient<D>(points, env.point(c, 2));  // facet 0 joins vertices 0 1 (3): vertex 2 is the apex
    return side < 0 ? CellState::kValidConvex : side > 0 ? CellState::kInverted : CellState::kInvalid;
  }
  double apex[D];
  centre(env, c, apex);
  uint32_t inside = 0, outside = 0;
  const double* points[D];
  for (uint32_t s = 0; s < shape.simplex_count(); ++s) {
    simplex_points(env, c, shape, s, points);
    const int side = orient<D>(points, apex);
    inside += side < 0 ? 1u : 0u;
    outside += side > 0 ? 1u : 0u;
  }
  if (outside == shape.simplex_count()) return CellState::kInverted;
  if (inside != shape.simplex_count()) return CellState::kInvalid;

  // Any direction will do, since the shift makes it generic; one off the edges needs no exact arithmetic.
  simplex_points(env, c, shape, 0, points);
  double through[D];
  for (int k = 0; k < D; ++k) {
    through[k] = (D == 3 ? 0.41 : 0.54) * points[0][k] + (D == 3 ? 0.34 : 0.46) * points[1][k];
    if (D == 3) through[k] += 0.25 * points[D - 1][k];
  }
  if (count_pierced(env, c, shape, apex, through) != 1 && count_pierced(env, c, shape, apex, points[0]) != 1) {
    return CellState::kInvalid;
  }
  return is_flat_and_convex(env, c, shape, apex) ? CellState::kValidConvex : CellState::kValid;
}

template CellState check_cell(const Environment<2>&, Cell) noexcept;
template CellState check_cell(const Environment<3>&, Cell) noexcept;

}  // namespace dsw
