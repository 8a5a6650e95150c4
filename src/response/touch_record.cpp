#include "response/touch_record.h"

#include <algorithm>
#include <limits>

#include "contact/describe.h"
#include "contact/normals.h"

namespace dsw {

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
  template void record_touch(const Environment<D>&, const Body<D>&, const RigidWay<D>&, const RigidTouch<D>&, \
                             const Partner<D>*, MoveRecord&)
DSW_TOUCH_RECORD(2);
DSW_TOUCH_RECORD(3);
#undef DSW_TOUCH_RECORD

}  // namespace dsw
