#include "contact/describe_pair.h"

#include <algorithm>

#include "base/dimensions.h"
#include "contact/describe.h"
#include "contact/geometry.h"
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

/** The points of what is touched, one to three. */
template <int D>
struct Touched {
  const double* at[3] = {};

  explicit Touched(const PairContact<D>& met) {
    const Body<D>& other = *met.other.body;
    const uint32_t* const names = met.part == Simplex::kVertex ? &met.index
                                  : met.part == Simplex::kEdge ? other.edges[met.index].ends
                                                               : other.faces[met.index].corners;
    const int count = 1 + static_cast<int>(met.part);
    for (int k = 0; k < 3; ++k) at[k] = other.position(names[std::min(k, count - 1)]);
  }
};

/** Point, place along the edge and normal of an edge, or of a vertex alone, on an edge or a vertex in space. */
Vec describe_edge(const PairContact<3>& met, const EdgeMotion& m, const Touched<3>& touched,
                  dsw_body_contact& contact) {
  const double *const a = touched.at[0], *const b = touched.at[1];
  const Vec move = difference<3>(m.to, m.p), edge = difference<3>(m.q, contact.position), other = difference<3>(b, a);
  if (met.place == TouchPlace::kInside) {
    triangle_piercing_point(m, a, b, contact.point);
    return against(unit(unit(edge).cross(unit(other))), move);
  }
  if (met.place == TouchPlace::kVertex) {
    return back_across(move, other, are_collinear(m.p, m.to, a) && are_collinear(m.p, m.to, b));
  }
  std::copy_n(met.place == TouchPlace::kFirst ? a : b, 3, contact.point);
  return back_across(move, edge, are_collinear(m.p, m.to, m.q));
}

/** Finds the point and normal of an edge, or of a vertex alone, that touches an edge or a vertex in the plane. */
Vec describe_edge(const PairContact<2>& met, const EdgeMotion& m, const Touched<2>& touched,
                  dsw_body_contact& contact) {
  if (met.edge == kNone) return normal_on<2>(orient<2>(touched.at, m.p), touched.at, difference<2>(m.to, m.p));
  std::copy_n(touched.at[0], 2, contact.point);
  return swing_normal(m, contact.position, touched.at[0]);
}

}  // namespace

template <int D>
dsw_body_contact describe(const Environment<D>& env, const Body<D>& body, uint32_t v, const double* to,
                          const PairContact<D>& met) {
  dsw_body_contact contact{};
  const double* const from = body.position(v);
  std::copy_n(from, D, contact.from);
  std::copy_n(to, D, contact.to);
  contact.vertex = vertex_id(body, v);
  contact.contact.front = volume_id(env.map, body.vertices[v].cell);
  contact.time = met.time;
  point_at<D>(from, to, met.time, contact.position);
  std::copy_n(contact.position, D, contact.point);
  const Touched<D> touched(met);
  const Vec move = difference<D>(to, from);
  Vec normal;
  if (met.face != kNone) {
    const BodyFace& face = body.faces[met.face];
    const double *const q = body.position(face.after(v)), *const r = body.position(face.before(v));
    contact.face = face_id(body, met.face);
    std::copy_n(q, D, contact.fixed[0]);
    std::copy_n(r, D, contact.fixed[1]);
    std::copy_n(touched.at[0], D, contact.point);
    normal =
        against(unit(unit(difference<D>(q, contact.position)).cross(unit(difference<D>(r, contact.position)))), move);
  } else if (met.part == Simplex::kFace) {
    normal = normal_on<D>(orient<D>(touched.at, from), touched.at, move);
  } else {
    const double* q = from;
    if (met.edge != kNone) {
      contact.edge = edge_id(body, met.edge);
      q = body.position(body.edges[met.edge].other(v));
      std::copy_n(q, D, contact.fixed[0]);
    }
    normal = describe_edge(met, {from, to, q}, touched, contact);
    if (met.edge != kNone) contact.edge_parameter = share_along<D>(contact.position, q, contact.point);
  }
  store<D>(normal + Vec::Zero(), contact.contact.normal);  // never -0
  contact.contact.kind = contact_kind(met.part);
  return contact;
}

template <int D>
dsw_contact_partner partner_of(const PairContact<D>& met) noexcept {
  return name_partner(met.other, {met.part, met.index});
}

uint64_t part_key(const dsw_contact_partner& partner) noexcept {
  if (partner.vertex.generation != 0) return uint64_t{1} << 32 | partner.vertex.index;
  if (partner.edge.generation != 0) return uint64_t{2} << 32 | partner.edge.index;
  return uint64_t{3} << 32 | partner.face.index;
}

template dsw_body_contact describe(const Environment<2>& env, const Body<2>& body, uint32_t v, const double* to,
                                   const PairContact<2>& met);
template dsw_body_contact describe(const Environment<3>& env, const Body<3>& body, uint32_t v, const double* to,
                                   const PairContact<3>& met);
DSW_INSTANTIATE(partner_of);

}  // namespace dsw
