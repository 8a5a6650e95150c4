#include "locate/distances.h"

#include <algorithm>

#include "base/dimensions.h"
#include "base/position.h"

namespace dsw {

Vec nearest_on(const Vec& a, const Vec& b) {
  const Vec d = b - a;
  const double length = dot(d, d), t = -dot(a, d);
  if (!(t > 0)) return a;
  return t >= length ? b : Vec(a + t / length * d);
}

Vec without(const Vec& v, const Vec& d, double length) {
  const Vec once = v - dot(v, d) / length * d;
  return once - dot(once, d) / length * d;
}

namespace {

/** Finds the foot of the origin on triangle a b c, whose longest edge is ab. In coordinates x along ab and y along the
 * height over ab the foot is found to a rounding error over the height, where barycentric coordinates lose it twice. */
bool foot_over_longest(const Vec& a, const Vec& b, const Vec& c, Vec& foot) {
  const Vec ab = b - a, ac = c - a;
  const double length = dot(ab, ab);
  const Vec height = without(ac, ab, length);
  const double square = dot(height, height);
  if (!(length > 0 && square > 0)) return false;
  const double apex = dot(ac, ab) / length, y = -dot(a, height) / square, x = -dot(a, ab) / length;
  if (!(y > 0 && y < 1 && x > apex * y && x < apex * y + (1 - y))) return false;
  foot = a + x * ab + y * height;
  return true;
}

/** Calls visit with the corners turned so that the first two are those of the longest edge. */
template <class Visit>
auto with_longest_first(const Vec& a, const Vec& b, const Vec& c, Visit visit) {
  const Vec ab = b - a, bc = c - b, ca = a - c;
  const double lab = dot(ab, ab), lbc = dot(bc, bc), lca = dot(ca, ca);
  if (lab >= lbc && lab >= lca) return visit(a, b, c);
  return lbc >= lca ? visit(b, c, a) : visit(c, a, b);
}

}  // namespace

bool foot_inside(const Vec& a, const Vec& b, const Vec& c, Vec& foot) {
  return with_longest_first(a, b, c,
                            [&](const Vec& d, const Vec& e, const Vec& f) { return foot_over_longest(d, e, f, foot); });
}

Vec nearest_on(const Vec& a, const Vec& b, const Vec& c) {
  return with_longest_first(a, b, c, [](const Vec& d, const Vec& e, const Vec& f) {
    Vec best;
    if (foot_over_longest(d, e, f, best)) return best;
    best = nearest_on(d, e);
    for (const Vec& other : {nearest_on(e, f), nearest_on(f, d)}) {
      if (dot(other, other) < dot(best, best)) best = other;
    }
    return best;
  });
}

template <int D>
double fitting_scale(const Environment<D>& env, std::initializer_list<const double*> points) {
  double largest = largest_coordinate<D>(env.lower, env.upper);
  for (const double* point : points) largest = std::max(largest, largest_coordinate<D>(point));
  return scale_to_one(largest, 300);
}

DSW_INSTANTIATE(fitting_scale);

}  // namespace dsw
