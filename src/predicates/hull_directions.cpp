// Where hulls are close to each other for their size, a double does not tell the direction between them. Here
// differences of points are exact but for rests, and what is reckoned from them has twice the digits.

#include <initializer_list>
#include <limits>

#include "base/dimensions.h"
#include "predicates/double_double.h"
#include "predicates/hull_pair.h"

namespace dsw {
namespace {

bool is_less(const dd::Number& a, const dd::Number& b) noexcept {
  return a.high != b.high ? a.high < b.high : a.low < b.low;
}

struct Long {
  dd::Number x, y, z;
};

Long minus(const Long& a, const Long& b) noexcept {
  return {dd::add(a.x, dd::negative(b.x)), dd::add(a.y, dd::negative(b.y)), dd::add(a.z, dd::negative(b.z))};
}
Long times(const Long& a, const dd::Number& s) noexcept {
  return {dd::multiply(a.x, s), dd::multiply(a.y, s), dd::multiply(a.z, s)};
}
dd::Number dot(const Long& a, const Long& b) noexcept {
  return dd::add(dd::add(dd::multiply(a.x, b.x), dd::multiply(a.y, b.y)), dd::multiply(a.z, b.z));
}
Long cross(const Long& a, const Long& b) noexcept {
  return {dd::minor_of(a.y, b.z, a.z, b.y), dd::minor_of(a.z, b.x, a.x, b.z), dd::minor_of(a.x, b.y, a.y, b.x)};
}
Vec rounded(const Long& a) noexcept { return {a.x.high, a.y.high, a.z.high}; }

/** In a power of two in which the largest coordinate is about 1. Zero and what is not finite stay so. */
Long scaled(const Long& a) noexcept {
  const double size = largest(rounded(a));
  if (!(size > 0) || !std::isfinite(size)) return a;
  int exponent;
  std::frexp(size, &exponent);
  const auto scale = [&](const dd::Number& n) {
    return dd::Number{std::ldexp(n.high, -exponent), std::ldexp(n.low, -exponent)};
  };
  return {scale(a.x), scale(a.y), scale(a.z)};
}

template <int D>
class Search {
 public:
  explicit Search(const HullPair<D>& pair) noexcept : most_(pair.most()) {
    const double* const origin = pair.hull_b().points[0];
    read(pair.hull_a(), pair.rest(), origin, 1 / pair.unit(), a_, count_a_);
    read(pair.hull_b(), nullptr, origin, 1 / pair.unit(), b_, count_b_);
  }

  /** The nearest points: of all pairs of features whose lines or planes are nearest to each other inside of both. */
  void find_points(HullGap& gap) noexcept {
    gap_ = &gap;
    const auto step_a = [&](uint32_t from, uint32_t to) {
      return Step{minus(a_[to], a_[from]), &trial_.weights[from], &trial_.weights[to]};
    };
    const auto step_b = [&](uint32_t from, uint32_t to) {
      return Step{minus(b_[from], b_[to]), &trial_.other_weights[from], &trial_.other_weights[to]};
    };
    for (uint32_t i = 0; i < count_a_; ++i) {
      for (uint32_t k = 0; k < count_b_; ++k) {
        const auto from_here = [&](std::initializer_list<Step> steps) {
          trial_ = HullGap();
          trial_.weights[i] = trial_.other_weights[k] = 1;
          consider(minus(a_[i], b_[k]), steps);
        };
        from_here({});
        for (uint32_t j = i + 1; j < count_a_; ++j) {
          from_here({step_a(i, j)});
          for (uint32_t l = k + 1; l < count_b_; ++l) from_here({step_a(i, j), step_b(k, l)});
          for (uint32_t m = j + 1; m < count_a_; ++m) from_here({step_a(i, j), step_a(i, m)});
        }
        for (uint32_t l = k + 1; l < count_b_; ++l) {
          from_here({step_b(k, l)});
          for (uint32_t m = l + 1; m < count_b_; ++m) from_here({step_b(k, l), step_b(k, m)});
        }
      }
    }
  }

  HullDirection run() noexcept {
    look_at_own(a_, count_a_);
    look_at_own(b_, count_b_);
    for (uint32_t i = 0; i < count_a_; ++i) {
      for (uint32_t k = 0; k < count_b_; ++k) {
        look(minus(a_[i], b_[k]));
        for (uint32_t l = k + 1; l < count_b_; ++l) look(across(b_[k], b_[l], a_[i]));
        for (uint32_t j = i + 1; j < count_a_; ++j) {
          const Long way = across(a_[i], a_[j], b_[k]);
          look({dd::negative(way.x), dd::negative(way.y), dd::negative(way.z)});
          for (uint32_t l = k + 1; D == 3 && l < count_b_; ++l) {
            look_along(cross(minus(a_[j], a_[i]), minus(b_[l], b_[k])));
          }
        }
      }
    }
    return best_;
  }
  /** The direction that run found, with all its digits; no direction if there is none. */
  const Long& best_way() const noexcept { return best_way_; }
  /** What one direction shows. */
  double bound_in(const Long& direction) noexcept {
    best_ = HullDirection();
    look(direction);
    return best_.bound;
  }

 private:
  static void read(const ConvexHull& hull, const double* rest, const double* origin, double scale, Long* out,
                   uint32_t& count) noexcept {
    count = hull.count;
    const auto difference = [&](uint32_t i, int k) {
      dd::Number d = dd::sum(hull.points[i][k], -origin[k]);
      if (rest != nullptr && i + 1 == count) d = dd::add(d, {rest[k], 0});
      return dd::Number{d.high * scale, d.low * scale};
    };
    for (uint32_t i = 0; i < count; ++i) {
      out[i] = {difference(i, 0), difference(i, 1), D == 3 ? difference(i, D - 1) : dd::Number{0, 0}};
    }
  }
  /** Normals of the faces of one hull; in the plane of its edges. */
  void look_at_own(const Long* points, uint32_t count) noexcept {
    for (uint32_t i = 0; i < count; ++i) {
      for (uint32_t k = i + 1; k < count; ++k) {
        const Long edge = minus(points[k], points[i]);
        if (D == 2) look_along({edge.y, dd::negative(edge.x), {0, 0}});
        for (uint32_t l = k + 1; D == 3 && l < count; ++l) look_along(cross(edge, minus(points[l], points[i])));
      }
    }
  }
  /** From an edge to a point, across the edge. */
  static Long across(const Long& from, const Long& to, const Long& point) noexcept {
    const Long edge = scaled(minus(to, from)), way = minus(point, from);
    return minus(times(way, dot(edge, edge)), times(edge, dot(way, edge)));
  }
  /** From a point of a hull along an edge to another one. As part of the difference of both hulls, so the second hull's
   * steps lead backwards. */
  struct Step {
    Long way;
    double* from;
    double* to;  // weights of the ends
  };
  void consider(const Long& start, std::initializer_list<Step> steps) noexcept;

  void look_along(const Long& direction) noexcept {
    look(direction);
    look({dd::negative(direction.x), dd::negative(direction.y), dd::negative(direction.z)});
  }

  /** Products and sums of a dot product lose less than 16 u^2 of the sum of magnitudes, u^2 being 2^-106, and among
   * denormal numbers less than 2^-900. What both hulls lose is less than 2^-100 of that sum. The length, the quotient
   * and the difference of high and low part lose less than 2^-49 of the result. */
  void look(const Long& any) noexcept {
    const Long d = scaled(any);
    const Vec rough = rounded(d);
    const double size = largest(rough);
    if (!(size > 0) || !std::isfinite(size)) return;
    dd::Number least = dot(d, a_[0]), most = dot(d, b_[0]);
    for (uint32_t i = 1; i < count_a_; ++i) {
      const dd::Number x = dot(d, a_[i]);
      if (is_less(x, least)) least = x;
    }
    for (uint32_t k = 1; k < count_b_; ++k) {
      const dd::Number x = dot(d, b_[k]);
      if (is_less(most, x)) most = x;
    }
    const dd::Number beyond = dd::add(least, dd::negative(most));
    const double lost = 0x1p-100 * dsw::dot(rough.magnitudes(), most_) + 0x1p-900;
    const double left = (beyond.high + beyond.low) - lost;
    const double bound = left * (1 - 0x1p-50) / (std::sqrt(dsw::dot(rough, rough)) * (1 + 0x1p-50));
    if (!(bound > best_.bound)) return;
    best_ = {bound, rough};
    best_way_ = d;
  }

  Vec most_;
  Long a_[ConvexHull::kMost], b_[ConvexHull::kMost];
  uint32_t count_a_ = 0, count_b_ = 0;
  HullDirection best_;
  Long best_way_{};
  HullGap trial_, *gap_ = nullptr;  // weights that are tried, and the best ones
  double least_ = std::numeric_limits<double>::infinity();
};

template <int D>
void Search<D>::consider(const Long& start, std::initializer_list<Step> steps) noexcept {
  const auto quotient = [](const dd::Number& p, const dd::Number& q) { return (p.high + p.low) / (q.high + q.low); };
  const Step* const s = steps.begin();
  Long way = start;
  for (size_t n = 0; n < steps.size(); ++n) {
    const Long& u = s[n].way;
    double share = 0;
    if (n + 1 == steps.size()) {
      share = quotient(dd::negative(dot(way, u)), dot(u, u));
    } else {  // with the next step to come
      const Long& v = s[n + 1].way;
      const dd::Number uu = dot(u, u), uv = dot(u, v), vv = dot(v, v);
      share = quotient(dd::minor_of(dot(way, v), uv, dot(way, u), vv), dd::minor_of(uu, vv, uv, uv));
    }
    if (!(share > 0 && share < 1)) return;
    const Long part = times(u, {share, 0});
    way = {dd::add(way.x, part.x), dd::add(way.y, part.y), dd::add(way.z, part.z)};
    *s[n].from -= share;
    *s[n].to += share;
    if (!(*s[n].from > 0)) return;
  }
  const double square = dsw::dot(rounded(way), rounded(way));
  if (!(square < least_)) return;
  least_ = square;
  std::copy_n(trial_.weights, ConvexHull::kMost, gap_->weights);
  std::copy_n(trial_.other_weights, ConvexHull::kMost, gap_->other_weights);
}

}  // namespace

template <int D>
HullDirection look_everywhere(const HullPair<D>& pair) noexcept {
  return Search<D>(pair).run();
}

template <int D>
GapAtEnds look_at_ends(const HullPair<D>& start, const HullPair<D>& end) noexcept {
  Search<D> search(start);
  GapAtEnds gap;
  gap.start = search.run().bound;
  if (gap.start > 0) gap.end = Search<D>(end).bound_in(search.best_way());
  return gap;
}

template <int D>
void find_points(const HullPair<D>& pair, HullGap& gap) noexcept {
  Search<D>(pair).find_points(gap);
}

DSW_INSTANTIATE(look_everywhere);
DSW_INSTANTIATE(look_at_ends);
DSW_INSTANTIATE(find_points);

}  // namespace dsw
