#include "environment/touching.h"

#include <algorithm>

#include "base/dimensions.h"
#include "base/search.h"
#include "predicates/turn.h"

namespace dsw {
namespace {

/** Whether each corner of one loop is at the place of a corner of another one. */
bool has_corners_of(const Environment<3>& env, VertexRange loop, VertexRange part) noexcept {
  return dsw::all_of(part.begin(), part.end(), [&](uint32_t v) {
    const double* const p = env.point(v);
    return dsw::any_of(loop.begin(), loop.end(), [&](uint32_t w) { return std::equal(p, p + 3, env.point(w)); });
  });
}

/** Whether two triangles lie in one plane and have an area in common. */
bool triangles_touch(const Environment<3>& env, const uint32_t* t, const uint32_t* s) noexcept {
  const double* const of_t[3] = {env.point(t[0]), env.point(t[1]), env.point(t[2])};
  const double* const of_s[3] = {env.point(s[0]), env.point(s[1]), env.point(s[2])};
  for (const double* const p : of_s) {
    const bool is_corner = p == of_t[0] || p == of_t[1] || p == of_t[2];
    if (!is_corner && orient<3>(of_t, p) != 0) return false;
  }
  return insides_meet(of_t, of_s, projection(of_t));
}

bool do_touch(const Environment<3>& env, const OuterFacets<3>& outer, uint32_t i, uint32_t j) noexcept {
  const VertexRange a = outer.loop(i), b = outer.loop(j);
  if (a.size() < b.size() ? has_corners_of(env, b, a) : has_corners_of(env, a, b)) return true;
  const VertexRange of_a = outer.simplices(i), of_b = outer.simplices(j);
  for (uint32_t t = 0; t < of_a.size(); t += 3) {
    for (uint32_t s = 0; s < of_b.size(); s += 3) {
      if (triangles_touch(env, of_a.first + t, of_b.first + s)) return true;
    }
  }
  return false;
}

bool do_touch(const Environment<2>& env, const OuterFacets<2>& outer, uint32_t i, uint32_t j) noexcept {
  const double *const a = env.point(outer.loop(i)[0]), *const b = env.point(outer.loop(i)[1]);
  const double *const c = env.point(outer.loop(j)[0]), *const d = env.point(outer.loop(j)[1]);
  if (turn_sign<2>(a, b, c) != 0 || turn_sign<2>(a, b, d) != 0) return false;
  const int along = a[0] != b[0] ? 0 : 1;
  return std::max(std::min(a[along], b[along]), std::min(c[along], d[along])) <
         std::min(std::max(a[along], b[along]), std::max(c[along], d[along]));
}

}  // namespace

template <int D>
bool facets_touch(const Environment<D>& env, const OuterFacets<D>& outer, uint32_t i, uint32_t j) noexcept {
  return do_touch(env, outer, i, j);
}

template <int D>
Touching find_touching(const Environment<D>& env) {
  const OuterFacets<D> outer(env);
  const auto touch = [&](uint32_t i, uint32_t j) {
    return outer.cell(i) != outer.cell(j) && facets_touch(env, outer, i, j);
  };
  Array<uint8_t> touches(outer.count(), 0, env.memory);
  outer.pairs().for_each([&](uint32_t i, uint32_t j) {
    if ((touches[i] & touches[j]) != 0 || !touch(i, j)) return;
    touches[i] = touches[j] = 1;
  });
  Touching found;
  found.count = static_cast<uint32_t>(std::count(touches.begin(), touches.end(), 1));
  if (found.count == 0) return found;
  const auto first = static_cast<uint32_t>(dsw::find(touches.begin(), touches.end(), 1) - touches.begin());
  uint32_t other = first + 1;
  while (touches[other] == 0 || !outer.box(first).overlaps(outer.box(other), D - 1) || !touch(first, other)) ++other;
  found.first = outer.facet(first);
  found.other = outer.facet(other);
  return found;
}

DSW_INSTANTIATE(facets_touch);
DSW_INSTANTIATE(find_touching);

}  // namespace dsw
