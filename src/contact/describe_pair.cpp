// The touch of two bodies, one of which moves.

#include <algorithm>

#include "base/dimensions.h"
#include "contact/describe.h"
#include "contact/normals.h"
#include "predicates/filtered.h"
#include "predicates/plane_hit.h"
#include "predicates/touch.h"

namespace dsw {
namespace {

/** What a motion has across a line, turned round. Of one along the line, which is known exactly, that would be what
 * rounding leaves: then it is the motion itself. */
Vec back_across(const Vec& move, const Vec& line, bool is_along) {
  if (is_along) return against(Vec::Zero(), move);
  const Vec along = unit(line), way = unit(move);
  return against(unit(way - dot(way, along) * along), move);
}

/** Where segment a b pierces the swept triangle; not both of its ends are in that plane. */
void triangle_piercing_point(const EdgeMotion& m, const double* a, const double* b, double* point) {
  const double* const swept[3] = {m.p, m.to, m.q};
  if (orient<3>(swept, b) - orient<3>(swept, a) < 0) std::swap(a, b);
  point_at<3>(a, b, crossing_time<3>(a, b, swept), point);
}

/** The points of what is touched, one to three, the last one again up to three. */
template <int D>
void read_touched(const PairContact<D>& met, const double* (&at)[3]) {
  const SimplexCorners<D> corners(*met.other.body, met.other_part);
  for (uint32_t k = 0; k < 3; ++k) at[k] = met.other.body->position(corners.vertices[std::min(k, corners.count - 1)]);
}

/** Point, place along the edge and normal of an edge, or of a vertex alone, on an edge or a vertex in space. */
Vec touch_edge(const PairContact<3>& met, const EdgeMotion& m, const double* const* at, Touch& touch) {
  const double *const a = at[0], *const b = at[1];
  const Vec move = difference<3>(m.to, m.p), edge = difference<3>(m.q, touch.position), other = difference<3>(b, a);
  if (met.place == TouchPlace::kInside) {
    triangle_piercing_point(m, a, b, touch.point);
    return against(unit_across(edge, other), move);
  }
  if (met.place == TouchPlace::kVertex) {
    return back_across(move, other, are_collinear(m.p, m.to, a) && are_collinear(m.p, m.to, b));
  }
  std::copy_n(met.place == TouchPlace::kFirst ? a : b, 3, touch.point);
  return back_across(move, edge, are_collinear(m.p, m.to, m.q));
}

/** Finds the point and normal of an edge, or of a vertex alone, that touches an edge or a vertex in the plane. */
Vec touch_edge(const PairContact<2>& met, const EdgeMotion& m, const double* const* at, Touch& touch) {
  if (met.part.kind == Simplex::kVertex) return normal_on<2>(orient<2>(at, m.p), at, difference<2>(m.to, m.p));
  std::copy_n(at[0], 2, touch.point);
  return swing_normal(m, touch.position, at[0]);
}

}  // namespace

template <int D>
Touch touch_of(const Environment<D>& env, const Body<D>& body, uint32_t v, const double* to,
               const PairContact<D>& met) {
  Touch touch;
  const double* const from = body.position(v);
  touch.time = met.time;
  touch.part = met.part;
  point_at<D>(from, to, met.time, touch.position);
  std::copy_n(touch.position, D, touch.point);
  const double* at[3];
  read_touched(met, at);
  const Vec move = difference<D>(to, from);
  Vec normal;
  if (met.part.kind == Simplex::kFace) {
    const BodyFace& face = body.faces[met.part.index];
    const double *const q = body.position(face.after(v)), *const r = body.position(face.before(v));
    std::copy_n(at[0], D, touch.point);
    normal = against(unit_across(difference<D>(q, touch.position), difference<D>(r, touch.position)), move);
  } else if (met.other_part.kind == Simplex::kFace) {
    normal = normal_on<D>(orient<D>(at, from), at, move);
  } else {
    const bool is_edge = met.part.kind == Simplex::kEdge;
    const double* const q = is_edge ? body.position(body.edges[met.part.index].other(v)) : from;
    normal = touch_edge(met, {from, to, q}, at, touch);
    if (is_edge) touch.along = share_along<D>(touch.position, q, touch.point);
  }
  store<D>(normal + Vec::Zero(), touch.other.normal);  // never -0
  touch.other.front = volume_id(env.map, body.vertices[v].cell);
  touch.other.kind = contact_kind(met.other_part.kind);
  return touch;
}

template <int D>
Vec normal_on_way(const double* p, const double* to, const PairContact<D>& met) {
  const double* at[3];
  read_touched(met, at);
  if (met.other_part.kind == Simplex::kFace) return normal_on<D>(orient<D>(at, p), at, difference<D>(to, p));
  Touch touch;
  point_at<D>(p, to, met.time, touch.position);
  return touch_edge(met, {p, to, p}, at, touch);
}

DSW_INSTANTIATE(normal_on_way);
template Touch touch_of(const Environment<2>& env, const Body<2>& body, uint32_t v, const double* to,
                        const PairContact<2>& met);
template Touch touch_of(const Environment<3>& env, const Body<3>& body, uint32_t v, const double* to,
                        const PairContact<3>& met);

}  // namespace dsw
