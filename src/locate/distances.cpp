#include "locate/distances.h"

#include <algorithm>

namespace dsw {

Vec nearest_on(const Vec& a, const Vec& b) {
  const Vec d = b - a;
  const double length = dot(d, d), t = -dot(a, d);
  if (!(t > 0)) return a;
  return t >= length ? b : Vec(a + t / length * d);
}

namespace {

/** `v` without its part along `d`. Done twice, because the first time leaves a rounding error of the size of v. */
Vec without(const Vec& v, const Vec& d, double length) {
  const Vec once = v - dot(v, d) / length * d;
  return once - dot(once, d) / length * d;
}

/** Nearest point of triangle abc to the origin, ab its longest edge. In coordinates x along ab and y along the height
 * over it the foot of the origin is found to a rounding error over the height, where barycentric coordinates lose it
 * twice. */
Vec nearest_over_longest(const Vec& a, const Vec& b, const Vec& c) {
  const Vec ab = b - a, ac = c - a;
  const double length = dot(ab, ab);
  const Vec height = without(ac, ab, length);
  const double square = dot(height, height);
  if (length > 0 && square > 0) {
    const double apex = dot(ac, ab) / length, y = -dot(a, height) / square, x = -dot(a, ab) / length;
    if (y > 0 && y < 1 && x > apex * y && x < apex * y + (1 - y)) return a + x * ab + y * height;
  }
  Vec best = nearest_on(a, b);
  for (const Vec& other : {nearest_on(b, c), nearest_on(c, a)}) {
    if (dot(other, other) < dot(best, best)) best = other;
  }
  return best;
}

}  // namespace

Vec nearest_on(const Vec& a, const Vec& b, const Vec& c) {
  const Vec ab = b - a, bc = c - b, ca = a - c;
  const double lab = dot(ab, ab), lbc = dot(bc, bc), lca = dot(ca, ca);
  if (lab >= lbc && lab >= lca) return nearest_over_longest(a, b, c);
  return lbc >= lca ? nearest_over_longest(b, c, a) : nearest_over_longest(c, a, b);
}

template <int D>
Distances<D>::Distances(const Environment<D>& env, const double* point) : env_(env), point_(point) {
  double largest = 0;
  for (int k = 0; k < D; ++k) {
    largest = std::max({largest, std::fabs(env.lower[k]), std::fabs(env.upper[k]), std::fabs(point[k])});
  }
  int exponent = 0;
  std::frexp(largest, &exponent);
  scale_ = exponent > 300 || exponent < -300 ? std::ldexp(1.0, std::clamp(-exponent, -1000, 1000)) : 1;
}

template <int D>
void Distances<D>::report(double distance, const Vec& from_point, NearestResult& result) const {
  result.distance = distance / scale_;
  double at[D];
  store<D>(from_point, at);
  for (int k = 0; k < D; ++k) {
    result.point[k] = point_[k] + at[k] / scale_;
    result.normal[k] = distance > 0 ? -at[k] / distance : 0;
  }
}

template class Distances<2>;
template class Distances<3>;

}  // namespace dsw
