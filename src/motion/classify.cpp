#include "motion/classify.h"

#include <algorithm>

#include "motion/cast.h"
#include "predicates/filtered.h"

namespace dsw {
namespace {

/** Sign of orient2d of three points projected along axis k. */
int projected(const double* a, const double* b, const double* p, int k) noexcept {
  const int i = (k + 1) % 3, j = (k + 2) % 3;
  const double pa[2] = {a[i], a[j]}, pb[2] = {b[i], b[j]}, pp[2] = {p[i], p[j]};
  const double* edge[2] = {pa, pb};
  return orient<2>(edge, pp);
}

bool on_segment(const double* a, const double* b, const double* p) noexcept {
  for (int k = 0; k < 3; ++k) {
    if (projected(a, b, p, k) != 0) return false;
    if (p[k] < std::min(a[k], b[k]) || p[k] > std::max(a[k], b[k])) return false;
  }
  return true;
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

}  // namespace

FeatureRef classify(const Environment<3>& env, const double* point, Cell c, bool* inside) noexcept {
  *inside = true;
  const Shape shape = env.map.shape(c);
  for (uint32_t i = 0; i < shape.vertex_count(); ++i) {
    if (std::equal(point, point + 3, env.point(c, i))) return {0, c, i};
  }
  for (uint32_t d = 0; d < shape.dart_count(); ++d) {
    const double* a = env.point(c, shape.dart_vertex(d));
    const double* b = env.point(c, shape.dart_vertex(shape.beta1(d)));
    if (shape.dart_beta2(d) > d && on_segment(a, b, point)) return {1, c, shape.dart_edge(d)};
  }
  const double* triangle[3];
  for (uint32_t s = 0; s < shape.simplex_count(); ++s) {
    simplex_points(env, c, shape, s, triangle);
    if (on_triangle(triangle, point)) return {2, c, shape.simplex_facets(3)[s]};
  }
  // On no boundary triangle: in the open volume or outside, which the shift can't change.
  *inside = contains(env, c, point);
  return {3, c, 0};
}

}  // namespace dsw
