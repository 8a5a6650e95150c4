// The search is that of Gilbert, Johnson and Keerthi (1988) on the differences of points of the two hulls. It gives
// directions. Where these leave open what is asked, all directions that can be the right one are tried with more digits
// (hull_directions.cpp).

#include "predicates/hull_gap.h"

#include <initializer_list>
#include <limits>
#include <utility>

#include "base/dimensions.h"
#include "predicates/double_double.h"
#include "predicates/hull_pair.h"

namespace dsw {
namespace {

// Not those of exact numbers.
using dsw::difference;
using dsw::dot;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kSmall = 0x1p-16;  // of the size: of hulls that are nearer to each other doubles tell too little

/** Corners whose hull has a point that is nearest to the origin, with its weights. */
struct Simplex {
  HullCorner corners[4];
  double weights[4] = {1, 0, 0, 0};
  uint32_t count = 0;
  Vec nearest = Vec::Zero();

  /** How far the point with these weights is from the origin. That point is in the hull, whatever rounding did to the
   * weights. */
  double reached() const noexcept {
    Vec sum = Vec::Zero();
    for (uint32_t i = 0; i < count; ++i) sum += weights[i] * corners[i].at;
    return length(sum);
  }
  void keep(std::initializer_list<uint32_t> which, std::initializer_list<double> w) noexcept {
    HullCorner kept[4];
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

/** Where the origin lies. In doubt: rounding could have brought it inside. */
enum class Origin { kOutside, kInside, kInDoubt };

Origin reduce_tetrahedron(Simplex& s) noexcept {
  constexpr uint32_t kFaces[4][4] = {{0, 1, 2, 3}, {0, 1, 3, 2}, {0, 2, 3, 1}, {1, 2, 3, 0}};
  constexpr double kDoubt = 0x1p-40;  // of the size
  Simplex best;
  double least = kInfinity;
  bool is_in_doubt = false;
  for (const auto& f : kFaces) {
    const Vec& a = s.corners[f[0]].at;
    const Vec normal = Vec(s.corners[f[1]].at - a).cross(Vec(s.corners[f[2]].at - a));
    // The origin lies beyond a face if the fourth corner lies on the other side of that. A flat one has no inside.
    const double height = dot(normal, a), fourth = dot(normal, Vec(s.corners[f[3]].at - a));
    is_in_doubt = is_in_doubt || !(std::fabs(height) > kDoubt * length(normal));
    if (fourth != 0 && !(height * fourth > 0)) continue;
    Simplex each = s;
    reduce_triangle(each, f[0], f[1], f[2]);
    const double size = dot(each.nearest, each.nearest);
    if (size < least) least = size, best = each;
  }
  if (least == kInfinity) return is_in_doubt ? Origin::kInDoubt : Origin::kInside;
  s = best;
  return Origin::kOutside;
}

Origin reduce(Simplex& s) noexcept {
  if (s.count == 2) reduce_edge(s, 0, 1);
  if (s.count == 3) reduce_triangle(s, 0, 1, 2);
  return s.count < 4 ? Origin::kOutside : reduce_tetrahedron(s);
}

/** A bound in units, as a length that is not more. A product may be a denormal number that is rounded up. A unit is at least 2^-1000,
 * so the quotient of one is exact. */
double in_units(double bound, double unit) noexcept {
  const double length = bound * unit;
  return length / unit > bound ? std::nextafter(length, 0.0) : length;
}

/** A hull with what its first point has passed on the way to `to`. */
template <int D>
class GrownHull {
 public:
  GrownHull(const ConvexHull& start, const double* to) noexcept
      : hull_(start), to_(to), scale_(scale_to_one(largest_coordinate<D>(start.points[0], to), 200)) {
    std::copy_n(to, D, place_);
    hull_.points[hull_.count++] = place_;
  }
  GrownHull(const GrownHull&) = delete;
  GrownHull& operator=(const GrownHull&) = delete;

  /** The rest is what a double-double knows of the place and its rounding loses. */
  void end_at(double time) noexcept {
    const double* const from = hull_.points[0];
    point_at<D>(from, to_, time, place_);
    for (int k = 0; k < D; ++k) {
      const double start = scale_ * from[k];
      const dd::Number way = dd::multiply(dd::sum(scale_ * to_[k], -start), {time, 0});
      const double rest = dd::add(dd::add(way, {start, 0}), {-scale_ * place_[k], 0}).high / scale_;
      rest_[k] = std::isfinite(rest) ? rest : 0;
    }
  }

  HullPair<D> beside(const ConvexHull& other) const noexcept { return {hull_, other, rest_}; }

 private:
  ConvexHull hull_;
  const double* to_;
  double scale_;  // for products that do not over- or underflow
  double place_[D], rest_[D] = {};
};

}  // namespace

template <int D>
HullPair<D>::HullPair(const ConvexHull& a, const ConvexHull& b, const double* rest, double within) noexcept
    : hull_a_(a), hull_b_(b), rest_(rest) {
  const double* const origin = b.points[0];
  double size = 0;
  const auto read = [&](const ConvexHull& hull, const double* beside, double most, Vec* out) {
    for (uint32_t i = 0; i < hull.count; ++i) {
      out[i] = difference<D>(hull.points[i], origin);
      if (beside != nullptr && i + 1 == hull.count) out[i] += to_vec<D>(beside);
      const double far = largest(out[i]);
      if (far > most && std::isfinite(far)) {
        const int shift = std::ilogb(far) - std::ilogb(most);
        for (int k = 0; k < D; ++k) out[i][k] = std::ldexp(out[i][k], -shift);
      }
      size = std::max(size, largest(out[i]));
    }
  };
  read(a, rest, within, a_);
  read(b, nullptr, std::numeric_limits<double>::infinity(), b_);
  is_finite_ = std::isfinite(size);
  if (!is_finite_ || size == 0) return;
  int exponent;
  std::frexp(size, &exponent);
  exponent = std::min(std::max(exponent, -1000), 1000);
  unit_ = std::ldexp(1.0, exponent);
  const double scale = std::ldexp(1.0, -exponent);
  Vec most_a = Vec::Zero(), most_b = Vec::Zero();
  for (uint32_t i = 0; i < a.count; ++i) {
    a_[i] *= scale;
    most_a = larger_of(most_a, a_[i].magnitudes());
  }
  for (uint32_t i = 0; i < b.count; ++i) {
    b_[i] *= scale;
    most_b = larger_of(most_b, b_[i].magnitudes());
  }
  most_ = most_a + most_b;
}

template <int D>
HullCorner HullPair<D>::support(const Vec& direction) const noexcept {
  uint32_t i = 0, k = 0;
  double least = dot(direction, a_[0]), most = dot(direction, b_[0]);
  for (uint32_t n = 1; n < hull_a_.count; ++n) {
    const double x = dot(direction, a_[n]);
    if (x < least) least = x, i = n;
  }
  for (uint32_t n = 1; n < hull_b_.count; ++n) {
    const double x = dot(direction, b_[n]);
    if (x > most) most = x, k = n;
  }
  return corner(i, k);
}

/** Let u be 2^-53. A difference, a product and two sums lose at most 4 u of the sum of magnitudes, one more with a rest, and less than
 * 2^-1000 among denormal numbers. 2^-50 of that sum is more than both hulls lose, of which one has a rest at most. The length of the
 * direction loses 3 u, and the quotient 1 u. */
template <int D>
double HullPair<D>::bound_in(const Vec& direction) const noexcept {
  const double size = largest(direction);
  if (!(size > 0) || !std::isfinite(size)) return 0;
  const Vec d = direction / size;
  double least = kInfinity, most = -kInfinity;
  for (uint32_t n = 0; n < hull_a_.count; ++n) least = std::min(least, dot(d, a_[n]));
  for (uint32_t n = 0; n < hull_b_.count; ++n) most = std::max(most, dot(d, b_[n]));
  const double lost = 0x1p-50 * dot(d.magnitudes(), most_) + 0x1p-1000;
  const double beyond = least - most - lost;
  if (!(beyond > 0)) return 0;
  return (beyond * (1 - 0x1p-50)) / (std::sqrt(dot(d, d)) * (1 + 0x1p-50));
}

namespace {

constexpr double kHidden = 0x1p-31;  // of the distance

/** What a search in doubles finds: in units. */
struct Found {
  Simplex simplex;
  HullDirection best;
  double distance = 0;
  bool is_decided = false;  // nothing more is asked
};

template <int D>
Found search(const HullPair<D>& pair, double enough, double least) noexcept {
  constexpr int kMostSteps = 32;
  constexpr double kDecided = 0x1p-47;  // of the size; coordinates are at most 1
  Found found;
  auto& [simplex, best, distance, is_decided] = found;
  simplex.corners[0] = pair.corner(0, 0);
  simplex.nearest = simplex.corners[0].at;
  simplex.count = 1;
  distance = length(simplex.nearest);
  for (int step = 0; step < kMostSteps && distance > 0; ++step) {
    const double bound = pair.bound_in(simplex.nearest);
    if (bound > best.bound) best = {bound, simplex.nearest};
    is_decided = best.bound >= enough || (distance < least && simplex.reached() + kDecided < least);
    if (is_decided || distance - best.bound <= std::min(kDecided, kHidden / 2 * distance)) break;
    Simplex more = simplex;
    more.corners[more.count++] = pair.support(simplex.nearest);
    const Origin origin = reduce(more);
    is_decided = origin == Origin::kInside;
    const double nearer = origin == Origin::kOutside ? length(more.nearest) : 0;
    if (!(nearer < distance)) break;
    distance = nearer;
    if (distance > 0) simplex = more;
  }
  return found;
}

/** Where points of the first hull are so far away that a number as long as theirs has no digits for the rest, these are drawn nearer. */
template <int D>
void look_nearby(const HullPair<D>& pair, double enough, HullGap& gap) noexcept {
  constexpr double kFar = 0x1p24;
  const ConvexHull &a = pair.hull_a(), &b = pair.hull_b();
  const auto size_of = [&](const double* point) { return largest(difference<D>(point, b.points[0])); };
  double size = size_of(a.points[0]);
  for (uint32_t i = 1; i < a.count; ++i) size = std::min(size, size_of(a.points[i]));
  for (uint32_t i = 1; i < b.count; ++i) size = std::max(size, size_of(b.points[i]));
  const double within = kFar * std::max(size, enough);
  // What denormal numbers lose matters to shorter distances.
  if (!(within < pair.unit() / 2) || enough < 0x1p-1000) return;
  const HullPair<D> nearby(a, b, pair.rest(), within);
  if (!nearby.is_finite()) return;
  const HullDirection best = search(nearby, enough / nearby.unit(), enough / nearby.unit()).best;
  const double bound = in_units(best.bound, nearby.unit());
  if (!(bound >= enough)) return;
  gap.bound = bound;
  gap.distance = std::max(gap.distance, bound);
  gap.normal = unit(best.direction);
}

template <int D>
HullGap find_gap_of(const HullPair<D>& pair, double enough, double least) noexcept {
  constexpr double kUndecided = 0x1p-36;  // of the distance, if the bound is below `least`
  HullGap gap;
  if (!pair.is_finite()) return gap;
  const double wanted = std::min(enough, least);
  enough /= pair.unit();
  least /= pair.unit();
  auto [simplex, best, distance, is_decided] = search(pair, enough, least);
  // The distance lies between the bound and what is reached. From kSmall on the rounding of the latter does not matter.
  const double reached = simplex.reached(), open = reached - best.bound;
  const bool is_hidden = distance < kSmall || open > (best.bound < least ? kUndecided : kHidden) * reached;
  if (!is_decided && is_hidden) {
    const HullDirection better = look_everywhere(pair);
    if (better.bound > best.bound) best = better;
    distance = std::max(distance, best.bound);
  }
  for (uint32_t i = 0; i < simplex.count; ++i) {
    gap.weights[simplex.corners[i].a] += simplex.weights[i];
    gap.other_weights[simplex.corners[i].b] += simplex.weights[i];
  }
  gap.bound = in_units(best.bound, pair.unit());
  gap.distance = distance * pair.unit();
  gap.normal = unit(best.direction);
  if (gap.bound < wanted) look_nearby(pair, wanted, gap);
  return gap;
}

}  // namespace

template <int D>
HullGap find_gap(const ConvexHull& a, const ConvexHull& b, double enough, double least) noexcept {
  return find_gap_of(HullPair<D>(a, b), enough, least);
}

template <int D>
bool are_surely_apart(const ConvexHull& a, const ConvexHull& b) noexcept {
  constexpr int kMostSteps = 6;
  const HullPair<D> pair(a, b);
  if (!pair.is_finite()) return false;
  Simplex simplex;
  simplex.corners[0] = pair.corner(0, 0);
  simplex.nearest = simplex.corners[0].at;
  simplex.count = 1;
  double distance = length(simplex.nearest);
  for (int step = 0; step < kMostSteps && distance > 0; ++step) {
    if (pair.bound_in(simplex.nearest) > 0) return true;
    simplex.corners[simplex.count++] = pair.support(simplex.nearest);
    if (reduce(simplex) != Origin::kOutside) return false;
    const double nearer = length(simplex.nearest);
    if (!(nearer < distance)) return false;
    distance = nearer;
  }
  return false;
}

template <int D>
GapAtEnds find_gap_at_ends(const ConvexHull (&start)[2], const ConvexHull (&end)[2]) noexcept {
  const HullPair<D> first(start[0], start[1]), last(end[0], end[1]);
  if (!first.is_finite() || !last.is_finite()) return {};
  const GapAtEnds gap = look_at_ends(first, last);
  return {in_units(gap.start, first.unit()), in_units(gap.end, last.unit())};
}

template <int D>
double time_apart(const ConvexHull& a, const double* to, const ConvexHull& b, double distance, HullGap* at) noexcept {
  constexpr int kMostSteps = 200;
  constexpr double kDecided = 0x1p-48;
  GrownHull<D> moved(a, to);
  // The whole way. Where that is free nothing else is asked.
  const HullGap whole = find_gap_of(moved.beside(b), distance, distance);
  if (whole.bound >= distance) return 1;
  *at = find_gap<D>(a, b, kInfinity, distance);
  if (!(at->bound >= distance)) return 0;
  // The hull grows, so its distance falls. The next time is where a line between the distances at both ends has the
  // wanted one. If that moves the same end twice, the next time is a little beyond: the other end gets near, too.
  double low = 0, high = 1, over = at->bound - distance, under = distance - whole.distance, moved_by = 0, shrink = 1;
  int last = 0, repeated = 0;
  for (int step = 1; step < kMostSteps && high - low > kDecided * high; ++step) {
    const double between = high - low, beyond = 8 * moved_by + kDecided / 4 * high;
    double time = low + over / (over + under) * between;
    if (repeated == 1) time = last > 0 ? low + beyond : high - beyond;
    if (repeated > 1 || !(time > low && time < high)) {
      // The middle; of a way that is much too long that of the exponents.
      shrink *= 0.25 * shrink;
      time = low > high / 16 ? low + between / 2 : low > 0 ? std::sqrt(low) * std::sqrt(high) : high * shrink;
    }
    if (!(time > low && time < high)) break;
    moved.end_at(time);
    const HullGap gap = find_gap_of(moved.beside(b), kInfinity, distance);
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
      under = distance - std::min(gap.distance, distance);
    }
  }
  moved.end_at(low);
  const HullPair<D> pair = moved.beside(b);
  if (at->distance < kSmall * pair.unit()) find_points(pair, *at);
  return low;
}

template <int D>
bool are_far_apart_until(const ConvexHull& a, const double* to, double time, const ConvexHull& b,
                         double distance) noexcept {
  GrownHull<D> moved(a, to);
  moved.end_at(time);
  return find_gap_of(moved.beside(b), distance, distance).bound >= distance;
}

template class HullPair<2>;
template class HullPair<3>;
DSW_INSTANTIATE(find_gap);
DSW_INSTANTIATE(are_surely_apart);
DSW_INSTANTIATE(find_gap_at_ends);
DSW_INSTANTIATE(time_apart);
DSW_INSTANTIATE(are_far_apart_until);

}  // namespace dsw
