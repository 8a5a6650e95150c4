// The search is that of Gilbert, Johnson and Keerthi (1988) on the differences of points of the two hulls. It gives
// directions. Where it leaves open whether hulls are far enough apart, all directions that can be the right one are
// tried: normals of faces, common normals of edges, ways from vertices across edges and to vertices.

#include "predicates/hull_gap.h"

#include <limits>

#include "base/dimensions.h"

namespace dsw {
namespace {

// Not those of exact numbers.
using dsw::difference;
using dsw::dot;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/** The difference of a point of each hull. */
struct Corner {
  Vec at;
  uint32_t a, b;
};

/** Two hulls as differences from a point of the second, in a power of two as unit: coordinates are at most 1. Each is
 * rounded once. */
template <int D>
class Pair {
 public:
  Pair(const ConvexHull& a, const ConvexHull& b) noexcept : count_a_(a.count), count_b_(b.count) {
    const double* const origin = b.points[0];
    double size = 0;
    const auto read = [&](const ConvexHull& hull, Vec* out) {
      for (uint32_t i = 0; i < hull.count; ++i) {
        out[i] = difference<D>(hull.points[i], origin);
        size = std::max(size, largest(out[i]));
      }
    };
    read(a, a_);
    read(b, b_);
    is_finite_ = std::isfinite(size);
    if (!is_finite_ || size == 0) return;
    int exponent;
    std::frexp(size, &exponent);
    exponent = std::min(std::max(exponent, -1000), 1000);
    unit_ = std::ldexp(1.0, exponent);
    const double scale = std::ldexp(1.0, -exponent);
    Vec most_a = Vec::Zero(), most_b = Vec::Zero();
    for (uint32_t i = 0; i < count_a_; ++i) {
      a_[i] *= scale;
      most_a = most_a.cwiseMax(a_[i].cwiseAbs());
    }
    for (uint32_t i = 0; i < count_b_; ++i) {
      b_[i] *= scale;
      most_b = most_b.cwiseMax(b_[i].cwiseAbs());
    }
    most_ = most_a + most_b;
  }

  bool is_finite() const noexcept { return is_finite_; }
  double unit() const noexcept { return unit_; }
  uint32_t count_a() const noexcept { return count_a_; }
  uint32_t count_b() const noexcept { return count_b_; }
  const Vec& a(uint32_t i) const noexcept { return a_[i]; }
  const Vec& b(uint32_t i) const noexcept { return b_[i]; }
  Corner corner(uint32_t i, uint32_t k) const noexcept { return {a_[i] - b_[k], i, k}; }

  /** The corner that lies least far in a direction. */
  Corner support(const Vec& direction) const noexcept {
    uint32_t i = 0, k = 0;
    double least = dot(direction, a_[0]), most = dot(direction, b_[0]);
    for (uint32_t n = 1; n < count_a_; ++n) {
      const double x = dot(direction, a_[n]);
      if (x < least) least = x, i = n;
    }
    for (uint32_t n = 1; n < count_b_; ++n) {
      const double x = dot(direction, b_[n]);
      if (x > most) most = x, k = n;
    }
    return corner(i, k);
  }

  /** A lower bound of how far the first hull lies beyond the second in a direction, in units. Let u be 2^-53. A
   * difference, a product and two sums lose at most 4 u of the sum of magnitudes, and less than 2^-1000 among denormal
   * numbers. 2^-50 of that sum is twice as much as both hulls lose. The length of the direction loses 3 u, and the
   * quotient 1 u. */
  double bound_in(const Vec& direction) const noexcept {
    const double size = largest(direction);
    if (!(size > 0) || !std::isfinite(size)) return 0;
    const Vec d = direction / size;
    double least = kInfinity, most = -kInfinity;
    for (uint32_t n = 0; n < count_a_; ++n) least = std::min(least, dot(d, a_[n]));
    for (uint32_t n = 0; n < count_b_; ++n) most = std::max(most, dot(d, b_[n]));
    const double lost = 0x1p-50 * dot(d.cwiseAbs(), most_) + 0x1p-1000;
    const double beyond = least - most - lost;
    if (!(beyond > 0)) return 0;
    return (beyond * (1 - 0x1p-50)) / (std::sqrt(dot(d, d)) * (1 + 0x1p-50));
  }

 private:
  uint32_t count_a_, count_b_;
  bool is_finite_ = false;
  double unit_ = 1;
  Vec a_[4], b_[4];
  Vec most_ = Vec::Zero();  // magnitudes: of the largest coordinates of both
};

/** Corners whose hull has a point that is nearest to the origin, with its weights. */
struct Simplex {
  Corner corners[4];
  double weights[4] = {1, 0, 0, 0};
  uint32_t count = 0;
  Vec nearest = Vec::Zero();

  void keep(std::initializer_list<uint32_t> which, std::initializer_list<double> w) noexcept {
    Corner kept[4];
    uint32_t n = 0;
    for (const uint32_t i : which) kept[n++] = corners[i];
    n = 0;
    for (const double weight : w) weights[n++] = weight;
    count = n;
    std::copy_n(kept, n, corners);
  }
};

void reduce_edge(Simplex& s, uint32_t i, uint32_t k) noexcept {
  const Vec &a = s.corners[i].at, &b = s.corners[k].at, ab = b - a;
  const double size = dot(ab, ab), along = -dot(a, ab);
  if (!(along > 0)) {
    s.nearest = a;
    return s.keep({i}, {1});
  }
  if (!(along < size)) {
    s.nearest = b;
    return s.keep({k}, {1});
  }
  const double t = along / size;
  Vec at = a + t * ab;
  at -= dot(at, ab) / size * ab;
  s.nearest = at;
  s.keep({i, k}, {1 - t, t});
}

/** By the regions of a triangle's plane: Ericson, Real-Time Collision Detection, 5.1.5. */
void reduce_triangle(Simplex& s, uint32_t i, uint32_t k, uint32_t l) noexcept {
  const Vec &a = s.corners[i].at, &b = s.corners[k].at, &c = s.corners[l].at, ab = b - a, ac = c - a;
  const double d1 = -dot(ab, a), d2 = -dot(ac, a), d3 = -dot(ab, b), d4 = -dot(ac, b), d5 = -dot(ab, c),
               d6 = -dot(ac, c);
  const double of_c = d1 * d4 - d3 * d2, of_b = d5 * d2 - d1 * d6, of_a = d3 * d6 - d5 * d4;
  if (of_a > 0 && of_b > 0 && of_c > 0) {
    const Vec normal = ab.cross(ac);
    const double size = dot(normal, normal), sum = of_a + of_b + of_c;
    if (size > 0) {
      s.nearest = dot(normal, a) / size * normal;
      return s.keep({i, k, l}, {of_a / sum, of_b / sum, of_c / sum});
    }
  }
  Simplex best;
  double least = kInfinity;
  for (const auto& [from, to] : {std::pair{i, k}, {k, l}, {i, l}}) {
    Simplex each = s;
    reduce_edge(each, from, to);
    const double size = dot(each.nearest, each.nearest);
    if (size < least) least = size, best = each;
  }
  s = best;
}

/** False: the origin lies inside. */
bool reduce_tetrahedron(Simplex& s) noexcept {
  constexpr uint32_t kFaces[4][4] = {{0, 1, 2, 3}, {0, 1, 3, 2}, {0, 2, 3, 1}, {1, 2, 3, 0}};
  Simplex best;
  double least = kInfinity;
  for (const auto& f : kFaces) {
    const Vec& a = s.corners[f[0]].at;
    const Vec normal = Vec(s.corners[f[1]].at - a).cross(Vec(s.corners[f[2]].at - a));
    // The origin lies beyond a face if the fourth corner lies on the other side of that. A flat one has no inside.
    const double fourth = dot(normal, Vec(s.corners[f[3]].at - a));
    if (fourth != 0 && !(dot(normal, a) * fourth > 0)) continue;
    Simplex each = s;
    reduce_triangle(each, f[0], f[1], f[2]);
    const double size = dot(each.nearest, each.nearest);
    if (size < least) least = size, best = each;
  }
  if (least == kInfinity) return false;
  s = best;
  return true;
}

bool reduce(Simplex& s) noexcept {
  if (s.count == 2) reduce_edge(s, 0, 1);
  if (s.count == 3) reduce_triangle(s, 0, 1, 2);
  return s.count < 4 || reduce_tetrahedron(s);
}

/** The best direction so far. */
struct Best {
  double bound = 0;
  Vec direction = Vec::Zero();
};

template <int D>
void look(const Pair<D>& pair, const Vec& direction, Best& best) noexcept {
  const double bound = pair.bound_in(direction);
  if (bound > best.bound) best = {bound, direction};
}

/** Both ways. */
template <int D>
void look_along(const Pair<D>& pair, const Vec& direction, Best& best) noexcept {
  look(pair, direction, best);
  look(pair, Vec(-direction), best);
}

/** From an edge to a point, across the edge. */
Vec across(const Vec& from, const Vec& to, const Vec& point) noexcept {
  const Vec u = unit(Vec(to - from));
  Vec way = point - from;
  way -= dot(way, u) * u;
  way -= dot(way, u) * u;
  return way;
}

template <int D>
void look_everywhere(const Pair<D>& pair, Best& best) noexcept {
  const uint32_t m = pair.count_a(), n = pair.count_b();
  const auto normals = [&](uint32_t count, const auto& point) {
    for (uint32_t i = 0; i + 2 < count; ++i) {
      for (uint32_t k = i + 1; k + 1 < count; ++k) {
        for (uint32_t l = k + 1; l < count; ++l) {
          look_along(pair, unit(Vec(point(k) - point(i))).cross(unit(Vec(point(l) - point(i)))), best);
        }
      }
    }
  };
  // In the plane edges have normals of their own.
  const auto edge_normals = [&](uint32_t count, const auto& point) {
    for (uint32_t i = 0; D == 2 && i < count; ++i) {
      for (uint32_t k = i + 1; k < count; ++k) look_along(pair, turned(Vec(point(k) - point(i))), best);
    }
  };
  const auto of_a = [&](uint32_t i) -> const Vec& { return pair.a(i); };
  const auto of_b = [&](uint32_t k) -> const Vec& { return pair.b(k); };
  normals(m, of_a);
  normals(n, of_b);
  edge_normals(m, of_a);
  edge_normals(n, of_b);
  for (uint32_t i = 0; i < m; ++i) {
    for (uint32_t k = 0; k < n; ++k) look(pair, Vec(pair.a(i) - pair.b(k)), best);
    for (uint32_t k = 0; k < n; ++k) {
      for (uint32_t l = k + 1; l < n; ++l) look(pair, across(pair.b(k), pair.b(l), pair.a(i)), best);
    }
  }
  for (uint32_t i = 0; i < m; ++i) {
    for (uint32_t j = i + 1; j < m; ++j) {
      const Vec edge = unit(Vec(pair.a(j) - pair.a(i)));
      for (uint32_t k = 0; k < n; ++k) look(pair, Vec(-across(pair.a(i), pair.a(j), pair.b(k))), best);
      for (uint32_t k = 0; k < n; ++k) {
        for (uint32_t l = k + 1; l < n; ++l) {
          look_along(pair, edge.cross(unit(Vec(pair.b(l) - pair.b(k)))), best);
        }
      }
    }
  }
}

}  // namespace

template <int D>
HullGap find_gap(const ConvexHull& a, const ConvexHull& b, double enough) noexcept {
  constexpr int kMostSteps = 32;
  constexpr double kNearly = 1 - 0x1p-40;
  constexpr double kSettled = 0x1p-47, kHidden = 0x1p-45;  // coordinates are at most 1
  const Pair<D> pair(a, b);
  HullGap gap;
  if (!pair.is_finite()) return gap;
  const double wanted = enough / pair.unit();
  Simplex simplex;
  simplex.corners[0] = pair.corner(0, 0);
  simplex.nearest = simplex.corners[0].at;
  simplex.count = 1;
  Best best;
  double distance = length(simplex.nearest);
  bool is_open = true;
  for (int step = 0; step < kMostSteps && distance > 0; ++step) {
    look(pair, simplex.nearest, best);
    is_open = best.bound < wanted;
    if (!is_open || (enough != kInfinity && distance < wanted * kNearly)) break;
    if (distance - best.bound <= kSettled) break;
    const Corner next = pair.support(simplex.nearest);
    Simplex more = simplex;
    more.corners[more.count++] = next;
    if (!reduce(more)) {
      distance = 0;
      break;
    }
    const double nearer = length(more.nearest);
    if (!(nearer < distance)) break;
    simplex = more;
    distance = nearer;
  }
  // Where rounding has hidden the direction.
  const bool is_near = enough != kInfinity && distance < wanted * kNearly;
  if (is_open && distance > 0 && !is_near && distance - best.bound > kHidden) look_everywhere(pair, best);
  for (uint32_t i = 0; i < simplex.count; ++i) {
    gap.weights[simplex.corners[i].a] += simplex.weights[i];
    gap.other_weights[simplex.corners[i].b] += simplex.weights[i];
  }
  gap.bound = best.bound * pair.unit();
  gap.distance = distance * pair.unit();
  gap.normal = unit(best.direction);
  return gap;
}

template <int D>
double time_apart(const ConvexHull& a, const double* to, const ConvexHull& b, double distance, HullGap* at) noexcept {
  constexpr int kMostSteps = 100;
  constexpr double kSettled = 0x1p-44;
  double place[D];
  ConvexHull moved = a;
  moved.points[moved.count++] = place;
  const auto look = [&](double time) {
    point_at<D>(a.points[0], to, time, place);
    return find_gap<D>(moved, b, kInfinity);
  };
  *at = look(0);
  if (!(at->bound >= distance)) return 0;
  const HullGap whole = look(1);
  if (whole.bound >= distance) {
    *at = whole;
    return 1;
  }
  // The hull grows, so its distance falls. The next time is where a line between the distances at both ends has the
  // wanted one. If that moves the same end twice, the next time is a little beyond: the other end gets near, too.
  double low = 0, high = 1, over = at->bound - distance, under = distance - whole.bound, moved_by = 0;
  int last = 0, repeated = 0;
  for (int step = 1; step < kMostSteps && high - low > kSettled * high; ++step) {
    const double between = high - low, beyond = 8 * moved_by + kSettled / 4 * high;
    double time = low + over / (over + under) * between;
    if (repeated == 1) time = last > 0 ? low + beyond : high - beyond;
    if (repeated > 1 || !(time > low && time < high)) time = low + between / 2;
    if (!(time > low && time < high)) break;
    const HullGap gap = look(time);
    const int side = gap.bound >= distance ? 1 : -1;
    repeated = side == last && repeated < 2 ? repeated + 1 : 0;
    last = side;
    moved_by = side > 0 ? time - low : high - time;
    if (side > 0) {
      low = time;
      over = gap.bound - distance;
      *at = gap;
    } else {
      high = time;
      under = distance - gap.bound;
    }
  }
  return low;
}

DSW_INSTANTIATE(find_gap);
DSW_INSTANTIATE(time_apart);

}  // namespace dsw
