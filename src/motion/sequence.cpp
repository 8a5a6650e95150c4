#include "motion/sequence.h"

#include <algorithm>
#include <cmath>

#include "motion/standard_facets.h"

namespace dsw {
namespace {

// Line tests of many edges against one line, by a shear along the line onto the plane of two axes: with d = q - p, its longest
// component d_k and A' = A - (A_k / d_k) d, d.(A x B) = d_k (A'_i B'_j - A'_j B'_i).
// With u the unit roundoff and M over the components of all A: A is off by uM, the ratio of two components of d by 4u, A' by 9uM with
// |A'| <= 2M, and the two products and their difference by (72 + 16)uM^2.
constexpr double kBound = 128 * 1.1102230246251565e-16;
constexpr double kLeast = 1e-120, kMost = 1e120;  // of M: squares stay normal

class Shear {
 public:
  Shear(const double* p, const double* q) noexcept : p_(p) {
    double d[3];
    for (int k = 0; k < 3; ++k) d[k] = q[k] - p[k];
    k_ = std::fabs(d[1]) > std::fabs(d[0]) ? 1 : 0;
    if (std::fabs(d[2]) > std::fabs(d[k_])) k_ = 2;
    i_ = (k_ + 1) % 3;
    j_ = (k_ + 2) % 3;
    slope_i_ = d[i_] / d[k_];
    slope_j_ = d[j_] / d[k_];
    turn_ = d[k_] < 0 ? -1 : 1;
    largest_ = std::fabs(d[k_]);
  }

  struct Point {
    double i, j;
  };
  Point operator()(const double* x) noexcept {
    const double a = x[i_] - p_[i_], b = x[j_] - p_[j_], c = x[k_] - p_[k_];
    largest_ = std::max(largest_, std::max(std::max(std::fabs(a), std::fabs(b)), std::fabs(c)));
    return {a - slope_i_ * c, b - slope_j_ * c};
  }
  /** The line leaves a facet whose boundary goes from a to b, counter-clockwise seen from outside, if this is positive for all. */
  void pass(const Point& a, const Point& b) noexcept { lowest_ = std::min(lowest_, turn_ * (a.i * b.j - a.j * b.i)); }

  bool passed_all() const noexcept {
    // A line of no length has no slope.
    return !std::isnan(slope_i_) && largest_ > kLeast && largest_ < kMost && lowest_ > kBound * largest_ * largest_;
  }

 private:
  const double* p_;
  int i_, j_, k_;
  double slope_i_, slope_j_, turn_, largest_, lowest_ = 1e300;
};

}  // namespace

bool follows(const Environment<3>& env, const double* from, const double* to, Cell first, Cell last,
             const uint32_t* facets, size_t count) noexcept {
  const Map<3>& map = env.map;
  if (count == 0) return first == last && map.convex(first);
  if (facets[0] == kNoFacet || map.cell_of({facets[0]}) != first) return false;
  if (map.cell_of(map.opposite({facets[count - 1]})) != last) return false;
  Shear shear(from, to);
  uint32_t marks = map.record(last)[0];
  for (size_t n = 0; n < count; ++n) {
    const HalfFacet h{facets[n]};
    if (env.checked.active() && !admits(env, map.cell_of(h))) return false;
    const uint32_t* w = map.words.data() + size_t{h.word / kUnitWords} * kUnitWords;
    const uint32_t slot = h.word % kUnitWords;
    marks |= w[0] | w[slot];
    if (form_of(w[0]) == Form::kSimplex) {
      const uint8_t(&local)[3] = kTetrahedronFacets[slot - (kUnitWords - 4)];
      const Shear::Point a = shear(env.point(w[local[0]] & kVertexMask)),
                         b = shear(env.point(w[local[1]] & kVertexMask)),
                         c = shear(env.point(w[local[2]] & kVertexMask));
      shear.pass(a, b);
      shear.pass(b, c);
      shear.pass(c, a);
    } else if (form_of(w[0]) == Form::kBox && (w[0] & kConvexBit) != 0) {
      const uint8_t(&local)[4] = kBoxFacets[slot - (kUnitWords - 6)];
      const Shear::Point a = shear(env.point(w[kUnitWords + local[0]])), b = shear(env.point(w[kUnitWords + local[1]])),
                         c = shear(env.point(w[kUnitWords + local[2]])), d = shear(env.point(w[kUnitWords + local[3]]));
      shear.pass(a, b);
      shear.pass(b, c);
      shear.pass(c, d);
      shear.pass(d, a);
    } else {
      const Cell c = map.cell_of(h);
      if (!map.convex(c)) return false;
      const Shape shape = map.shape(c);
      const uint32_t facet = map.local_of(h, c);
      marks |= map.record(c)[0];
      for (uint32_t d = shape.facet_first(facet); d < shape.facet_first(facet + 1); ++d) {
        shear.pass(shear(env.point(c, shape.dart_vertex(d))), shear(env.point(c, shape.dart_vertex(shape.beta1(d)))));
      }
    }
  }
  return (marks & kMarkBit) == 0 && map.convex(last) && admits(env, last) && shear.passed_all();
}

bool share_strip(const Map<3>& map, SequenceView ab, SequenceView bc, SequenceView ca) noexcept {
  // Facet i of a sequence in the direction of the view.
  const auto at = [&](const SequenceView& s, size_t i) {
    return s.turned ? map.opposite({s.facets[s.count - 1 - i]}).word : s.facets[i];
  };
  const auto is_sum = [&](const SequenceView& whole, const SequenceView& first, const SequenceView& second) {
    if (whole.count != first.count + second.count) return false;
    for (size_t i = 0; i < whole.count; ++i) {
      if (at(whole, i) != (i < first.count ? at(first, i) : at(second, i - first.count))) return false;
    }
    return true;
  };
  const auto turn = [](SequenceView s) { return SequenceView{s.facets, s.count, !s.turned}; };
  return is_sum(turn(ca), ab, bc) || is_sum(turn(ab), bc, ca) || is_sum(turn(bc), ca, ab);
}

void SequenceWriter::finish(Array<uint32_t>& sequence) {
  if (passed_ == facets_.size()) {
    sequence.assign(facets_.begin(), facets_.end());
    return;
  }
  sequence.assign(1, kNoFacet);
  facets_.reserve(2 * passed_);
}

void SequenceWriter::write(void* user, Cell from, uint32_t simplex, Cell) noexcept {
  SequenceWriter& w = *static_cast<SequenceWriter*>(user);
  ++w.passed_;
  if (w.facets_.size() == w.facets_.capacity()) return;
  const Map<3>& map = w.env_->map;
  const uint32_t facet = map.form(from) == Form::kSimplex ? simplex : map.shape(from).simplex_facets(3)[simplex];
  w.facets_.push_back(map.half_facet(from, facet).word);
}

}  // namespace dsw
