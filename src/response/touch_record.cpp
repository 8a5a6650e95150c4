#include "response/touch_record.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/describe.h"
#include "contact/normals.h"

namespace dsw {

namespace {

// A line across both parts meets them inside, by a share that rounding does not count beside. Its length is a volume over an area.
// The volume of three vectors errs by less than 2^-49 of the product of their sums of components.
constexpr double kInside = 0x1p-20, kVolumeError = 0x1p-49, kLeastSquare = 0x1p-400, kMostSquare = 0x1p400;

double sum_of(const Vec& a) noexcept { return (std::fabs(a.x()) + std::fabs(a.y())) + std::fabs(a.z()); }

/** @param way from one part to the other, @param normal of both, across a and b: whether it is at most so long. */
bool is_short(const Vec& way, const Vec& normal, const Vec& a, const Vec& b, double length) noexcept {
  const double square = dot(normal, normal);
  if (!(square >= kLeastSquare && square <= kMostSquare)) return false;
  return std::fabs(dot(way, normal)) + kVolumeError * ((sum_of(way) * sum_of(a)) * sum_of(b)) <=
         0.5 * length * std::sqrt(square);
}
/** Whether a share of a square is inside of 0 and 1. */
bool is_inside(double part, double square) noexcept {
  const double least = kInside * square;
  return part >= least && square - part >= least;
}

bool is_near_face(const Vec& point, const Vec* face, double length) noexcept {
  const Vec a = face[1] - face[0], b = face[2] - face[0], way = point - face[0], normal = a.cross(b);
  const double square = dot(normal, normal), along_a = dot(way.cross(b), normal), along_b = dot(a.cross(way), normal);
  return is_short(way, normal, a, b, length) && is_inside(along_a, square) && is_inside(along_b, square) &&
         is_inside(along_a + along_b, square);
}
bool is_near_edge(const Vec* first, const Vec* second, double length) noexcept {
  const Vec a = first[1] - first[0], b = second[1] - second[0], way = second[0] - first[0], normal = a.cross(b);
  const double square = dot(normal, normal);
  return is_short(way, normal, a, b, length) && is_inside(dot(way.cross(b), normal), square) &&
         is_inside(dot(way.cross(a), normal), square);
}

}  // namespace

template <int D>
bool is_surely_near(const Body<D>& body, const RigidTouch<D>& touch, double length) noexcept {
  if constexpr (D != 3) return false;
  Vec own[3], other[3];
  uint32_t count = 0;
  for (const uint32_t v : SimplexCorners<D>(body, touch.part)) own[count++] = to_vec<D>(body.position(v));
  for (uint32_t i = 0; i < touch.count; ++i) other[i] = to_vec<D>(touch.points[i]);
  if (count == 2 && touch.count == 2) return is_near_edge(own, other, length);
  if (count == 1 && touch.count == 3) return is_near_face(own[0], other, length);
  return count == 3 && touch.count == 1 && is_near_face(other[0], own, length);
}

template <int D>
HullGap gap_of(const Body<D>& body, const RigidTouch<D>& touch, double cutoff, double tolerance) noexcept {
  ConvexHull part{}, other{{}, touch.count};
  for (const uint32_t v : SimplexCorners<D>(body, touch.part)) part.points[part.count++] = body.position(v);
  std::copy_n(touch.points, touch.count, other.points);
  return find_gap<D>(part, other, cutoff, tolerance);
}

template <int D>
void record_touch(const Environment<D>& env, const Body<D>& body, const RigidWay<D>& way, const RigidTouch<D>& touch,
                  const Partner<D>* other, MoveRecord& record) {
  const HullGap gap = gap_of(body, touch, std::numeric_limits<double>::infinity(), 0);
  const uint32_t v = SimplexCorners<D>(body, touch.part).vertices[0];
  const double* const to = way.place(way.pieces(), v);
  TooNear<D> near;
  near.part = touch.part;
  std::copy_n(gap.weights, 3, near.shares);
  std::copy_n(gap.other_weights, 3, near.weights);
  near.normal = gap.normal;
  if (is_zero(near.normal)) near.normal = against(Vec::Zero(), difference<D>(to, body.position(v)));
  near.partner = touch.partner;
  near.other = touch.other;
  std::copy_n(touch.vertices, 3, near.vertices);
  near.count = touch.count;
  near.facet = touch.facet;
  near.cell = touch.cell;
  record.add(describe(env, body, v, to, near),
             other == nullptr ? dsw_contact_partner{} : name_partner(*other, touch.other));
}

#define DSW_TOUCH_RECORD(D)                                                                                   \
  template HullGap gap_of(const Body<D>&, const RigidTouch<D>&, double, double) noexcept;                     \
  template bool is_surely_near(const Body<D>&, const RigidTouch<D>&, double) noexcept;                        \
  template void record_touch(const Environment<D>&, const Body<D>&, const RigidWay<D>&, const RigidTouch<D>&, \
                             const Partner<D>*, MoveRecord&)
DSW_TOUCH_RECORD(2);
DSW_TOUCH_RECORD(3);
#undef DSW_TOUCH_RECORD

}  // namespace dsw
