#include "places.h"

#include <cfloat>
#include <cmath>

namespace dsw::oracle {

Vec between(const Vec& a, const Vec& b, double by) {
  Vec p;
  for (size_t k = 0; k < 3; ++k) p[k] = a[k] + by * (b[k] - a[k]);
  return p;
}

bool finite(const Vec& p) { return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]); }

Vec Places::near(const Vec& from, double share) {
  Vec p = from;
  for (size_t k = 0; k < dimension_; ++k) p[k] = from[k] + rng_.range(-share, share) * size_;
  return p;
}

Vec Places::along_axis(const Vec& from, double share) {
  Vec p = from;
  p[any_axis()] += rng_.range(-share, share) * size_;
  return p;
}

bool Places::round_obstacle(Vec& place, std::array<Vec, 2>& span) {
  const double reach = rng_.chance(0.5) ? 0.1 : 0.3;
  for (Vec& d : span) d = near({0, 0, 0}, reach);
  const bool exactly = rng_.chance(0.2);
  place = site();
  return exactly;
}

Vec Places::target(const Vec& from) {
  const Vec q = any_target(from);
  return finite(q) ? q : site();
}

Vec Places::any_target(const Vec& from) {
  Vec q = from;
  switch (rng_.below(14)) {
    case 0:
      return from;
    case 1:
    case 2: {  // through a vertex
      const Vec v = rng_.chance(0.7) ? vertex() : site();
      return between(from, v, 1 + rng_.below(3));
    }
    case 3: {  // along an axis
      const size_t k = any_axis();
      q[k] = rng_.chance(0.5) ? site()[k] : from[k] + (rng_.chance(0.5) ? 3 : -3) * size_;
      return q;
    }
    case 4: {  // along an edge or a diagonal of the mesh
      const auto [a, b] = ends();
      const double k = rng_.between(-3, 3);
      for (size_t i = 0; i < dimension_; ++i) q[i] = from[i] + k * (b[i] - a[i]);
      return q;
    }
    case 5: {  // a tiny step
      for (size_t i = 0; i < dimension_; ++i) {
        if (rng_.chance(0.6)) q[i] = std::nextafter(q[i], rng_.chance(0.5) ? DBL_MAX : -DBL_MAX);
      }
      return q;
    }
    case 6: {
      if (!rng_.chance(0.15)) return site();
      static const double extremes[] = {1e300, -1e300, 1e-300, -1e-300, 0, -0.0, 1.7e308, DBL_TRUE_MIN};
      for (size_t i = 0; i < dimension_; ++i) {
        if (rng_.chance(0.6)) q[i] = extremes[rng_.below(8)];
      }
      return q;
    }
    case 7:  // far out
      return near(from, 10);
    case 8:  // a short step in any direction
      return near(from, 0.1);
    default:
      return site();
  }
}

}  // namespace dsw::oracle
