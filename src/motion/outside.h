#pragma once
// On which planes of a cell is the target outside? One bit a plane. Simplices and hexahedra have kernels that evaluate all
// their determinants from the vertices relative to the target, with the cross products that facets share computed once
// and one filter bound for the whole cell; everything else asks plane by plane. Signs are those of predicates/.

#include <algorithm>
#include <cmath>

#include "motion/tally.h"
#include "predicates/filtered.h"

namespace dsw {

/** Vertices relative to the target, and the largest |component| on every axis. */
template <uint32_t N>
struct RelativeVertices {
  double x[N], y[N], z[N];
  double bound;  // of every determinant of three of them; negative: out of the filter's range

  void finish() noexcept {
    double mx = 0, my = 0, mz = 0;
    for (uint32_t i = 0; i < N; ++i) {
      mx = std::max(mx, std::fabs(x[i]));
      my = std::max(my, std::fabs(y[i]));
      mz = std::max(mz, std::fabs(z[i]));
    }
    const double low = std::min(std::min(mx, my), mz), high = std::max(std::max(mx, my), mz);
    bound = low >= kFilterMin && high <= kFilterMax ? kPlaneFilter3 * mx * my * mz : -1;
  }
};

struct Cross {
  double x, y, z;
};

template <uint32_t N>
inline Cross cross(const RelativeVertices<N>& v, uint32_t a, uint32_t b) noexcept {
  return {v.y[a] * v.z[b] - v.z[a] * v.y[b], v.z[a] * v.x[b] - v.x[a] * v.z[b], v.x[a] * v.y[b] - v.y[a] * v.x[b]};
}
template <uint32_t N>
inline double dot(const Cross& c, const RelativeVertices<N>& v, uint32_t i) noexcept {
  return (c.x * v.x[i] + c.y * v.y[i]) + c.z * v.z[i];
}

/** Turns determinants into bits. det[i] > 0 means inside (it is minus the plane test); those that the filter cannot settle
 * are asked for exactly. */
template <uint32_t N, class Exactly>
inline uint32_t settle_all(const double (&det)[N], double bound, Exactly exactly) noexcept {
  uint32_t outside = 0, unsure = 0;
  for (uint32_t i = 0; i < N; ++i) {
    outside |= (det[i] < -bound ? 1u : 0u) << i;
    unsure |= (det[i] > bound || det[i] < -bound ? 0u : 1u) << i;
  }
  if (bound < 0) {
    outside = 0;
    unsure = (1u << N) - 1;
  }
  while (unsure != 0) {
    const uint32_t i = static_cast<uint32_t>(__builtin_ctz(unsure));
    unsure &= unsure - 1;
    outside |= (exactly(i) ? 1u : 0u) << i;
  }
  return outside;
}

/** Tetrahedron, by facet. */
template <class Tally>
inline uint32_t outside_simplex(const Environment<3>& env, const uint32_t* w, const double* q, Tally& tally) noexcept {
  RelativeVertices<4> v;
  const double* points[4];
  for (uint32_t i = 0; i < 4; ++i) {
    points[i] = env.point(w[i] & kVertexMask);
    v.x[i] = points[i][0] - q[0];
    v.y[i] = points[i][1] - q[1];
    v.z[i] = points[i][2] - q[2];
  }
  v.finish();
  const Cross c01 = cross(v, 0, 1), c23 = cross(v, 2, 3);
  // Facets 0 1 3, 1 2 3, 2 0 3, 0 2 1, each as a determinant of its vertices in that order.
  const double det[4] = {dot(c01, v, 3), dot(c23, v, 1), -dot(c23, v, 0), -dot(c01, v, 2)};
  static constexpr uint8_t kFacets[4][3] = {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {0, 2, 1}};
  return settle_all(det, v.bound, [&](uint32_t i) {
    const double* facet[3] = {points[kFacets[i][0]], points[kFacets[i][1]], points[kFacets[i][2]]};
    return plane_side<3>(facet, q, tally).sign > 0;
  });
}

constexpr uint8_t kBoxFacets[6][4] = {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}};

inline void load_box(const Environment<3>& env, const uint32_t* w, const double* q, RelativeVertices<8>& v,
                     const double* (&points)[8]) noexcept {
  for (uint32_t i = 0; i < 8; ++i) {
    points[i] = env.point(w[kUnitWords + i]);
    v.x[i] = points[i][0] - q[0];
    v.y[i] = points[i][1] - q[1];
    v.z[i] = points[i][2] - q[2];
  }
  v.finish();
}

/** Convex hexahedron with flat facets, by facet: any three vertices of a facet give its plane, so three edges, each between
 * two facets, yield all six. */
template <class Tally>
inline uint32_t outside_flat_box(const Environment<3>& env, const uint32_t* w, const double* q, Tally& tally) noexcept {
  RelativeVertices<8> v;
  const double* points[8];
  load_box(env, w, q, v, points);
  const Cross c04 = cross(v, 0, 4), c12 = cross(v, 1, 2), c76 = cross(v, 7, 6);
  const double det[6] = {dot(c04, v, 3), dot(c12, v, 6), -dot(c04, v, 1), dot(c76, v, 2), -dot(c12, v, 0), -dot(c76, v, 4)};
  return settle_all(det, v.bound, [&](uint32_t i) {
    const double* facet[3] = {points[kBoxFacets[i][0]], points[kBoxFacets[i][1]], points[kBoxFacets[i][2]]};
    return plane_side<3>(facet, q, tally).sign > 0;
  });
}

/** Any hexahedron, by boundary triangle: the two of a facet share the cross product of their diagonal. */
template <class Tally>
inline uint32_t outside_box(const Environment<3>& env, const uint32_t* w, const double* q, Tally& tally) noexcept {
  RelativeVertices<8> v;
  const double* points[8];
  load_box(env, w, q, v, points);
  double det[12];
  const uint32_t cuts = w[0] & kShapeMask;
  for (uint32_t f = 0; f < 6; ++f) {
    const uint32_t base = (cuts >> f) & 1u;
    const uint32_t a = kBoxFacets[f][base], b = kBoxFacets[f][base + 1], c = kBoxFacets[f][base + 2],
                   d = kBoxFacets[f][(base + 3) & 3u];
    const Cross diagonal = cross(v, a, c);
    det[2 * f] = -dot(diagonal, v, b);
    det[2 * f + 1] = dot(diagonal, v, d);
  }
  return settle_all(det, v.bound, [&](uint32_t i) {
    const uint32_t f = i / 2, base = (cuts >> f) & 1u, second = i % 2;
    const double* facet[3] = {points[kBoxFacets[f][base]], points[kBoxFacets[f][base + 1 + second]],
                              points[kBoxFacets[f][(base + 2 + second) & 3u]]};
    return plane_side<3>(facet, q, tally).sign > 0;
  });
}

}  // namespace dsw
