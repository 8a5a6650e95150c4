#include "locate/classify.h"

#include <algorithm>

#include "base/dimensions.h"
#include "predicates/filtered.h"
#include "walk/cast.h"

namespace dsw {
namespace {

/** Sign of orient2d of three points projected along axis k. */
int projected(const double* a, const double* b, const double* p, int k) noexcept {
  const int i = (k + 1) % 3, j = (k + 2) % 3;
  const double pa[2] = {a[i], a[j]}, pb[2] = {b[i], b[j]}, pp[2] = {p[i], p[j]};
  const double* edge[2] = {pa, pb};
  return orient<2>(edge, pp);
}

template <int D>
bool on_segment(const double* a, const double* b, const double* p) noexcept {
  for (int k = 0; k < D; ++k) {
    if (p[k] < std::min(a[k], b[k]) || p[k] > std::max(a[k], b[k])) return false;
  }
  if constexpr (D == 2) {
    const double* edge[2] = {a, b};
    return orient<2>(edge, p) == 0;
  } else {
    return projected(a, b, p, 0) == 0 && projected(a, b, p, 1) == 0 && projected(a, b, p, 2) == 0;
  }
}

/** Whether a point lies in a closed, non-degenerate triangle: in its plane, and on no outer side in any projection. */
bool on_triangle(const double* const (&t)[3], const double* p) noexcept {
  if (orient<3>(t, p) != 0) return false;
  for (int k = 0; k < 3; ++k) {
    const int turn = projected(t[0], t[1], t[2], k);
    if (turn == 0) continue;
    for (int e = 0; e < 3; ++e) {
      if (projected(t[e], t[(e + 1) % 3], p, k) * turn < 0) return false;
    }
    return true;
  }
  return false;
}

bool on_simplex(const double* const (&side)[2], const double* p) noexcept { return on_segment<2>(side[0], side[1], p); }
bool on_simplex(const double* const (&triangle)[3], const double* p) noexcept { return on_triangle(triangle, p); }

/** The edge or facet of a cell on which a point lies that is no vertex; invalid if there is none. */
FeatureRef on_boundary(const Environment<2>& env, Cell c, const Shape& shape, const double* point) noexcept {
  const double* side[2];
  for (uint32_t s = 0; s < shape.simplex_count(); ++s) {
    simplex_points(env, c, shape, s, side);
    if (on_segment<2>(side[0], side[1], point)) return {1, c, s};
  }
  return {};
}
FeatureRef on_boundary(const Environment<3>& env, Cell c, const Shape& shape, const double* point) noexcept {
  for (uint32_t d = 0; d < shape.dart_count(); ++d) {
    const double* a = env.point(c, shape.dart_vertex(d));
    const double* b = env.point(c, shape.dart_vertex(shape.beta1(d)));
    if (shape.dart_beta2(d) > d && on_segment<3>(a, b, point)) return {1, c, shape.dart_edge(d)};
  }
  const double* triangle[3];
  for (uint32_t s = 0; s < shape.simplex_count(); ++s) {
    simplex_points(env, c, shape, s, triangle);
    if (on_triangle(triangle, point)) return {2, c, shape.simplex_facets(3)[s]};
  }
  return {};
}

}  // namespace

template <int D>
FeatureRef classify(const Environment<D>& env, const double* point, Cell c, bool* inside) noexcept {
  *inside = true;
  const Shape shape = env.map.shape(c);
  for (uint32_t i = 0; i < shape.vertex_count(); ++i) {
    if (std::equal(point, point + D, env.point(c, i))) return {0, c, i};
  }
  const FeatureRef on = on_boundary(env, c, shape, point);
  if (on.cell.valid()) return on;
  // On no boundary simplex: in the open cell or outside, which the shift can't change.
  *inside = contains(env, c, point);
  return {D, c, 0};
}

template <int D>
bool lies_on(const Environment<D>& env, const FeatureRef& feature, const double* point) noexcept {
  const Cell c = feature.cell;
  if (feature.dimension == 0) return std::equal(point, point + D, env.point(c, feature.local));
  const Shape shape = env.map.shape(c);
  if constexpr (D == 3) {
    for (uint32_t d = 0; feature.dimension == 1 && d < shape.dart_count(); ++d) {
      if (shape.dart_edge(d) != feature.local) continue;
      return on_segment<3>(env.point(c, shape.dart_vertex(d)), env.point(c, shape.dart_vertex(shape.beta1(d))), point);
    }
  }
  for (uint32_t s = shape.simplex_first(feature.local); s < shape.simplex_first(feature.local + 1); ++s) {
    const double* simplex[D];
    simplex_points(env, c, shape, s, simplex);
    if (on_simplex(simplex, point)) return true;
  }
  return false;
}

DSW_INSTANTIATE(classify);
DSW_INSTANTIATE(lies_on);

}  // namespace dsw
