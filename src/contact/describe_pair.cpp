#include "contact/describe_pair.h"

#include <algorithm>

#include "base/vec.h"
#include "contact/describe.h"
#include "predicates/filtered.h"
#include "predicates/plane_hit.h"
#include "predicates/touch.h"

namespace dsw {
namespace {

/** `chosen` turned against the motion; where there is none, against the motion itself. */
Vec against(const Vec& chosen, const Vec& move) {
  if (is_zero(chosen)) return -1.0 * unit(move);
  return (dot(chosen, move) > 0 ? -1.0 : 1.0) * chosen;
}

/** What a motion has across a line, turned round. Of one along the line, which is known exactly, that would be what rounding leaves: then it
 * is the motion itself. */
Vec back_across(const Vec& move, const Vec& line, bool is_along) {
  if (is_along) return against({}, move);
  const Vec along = unit(line), way = unit(move);
  return against(unit(way - dot(way, along) * along), move);
}

/** Of the face, towards where the vertex comes from. */
template <int D>
Vec face_normal(const double* const* corners, const double* p, const Vec& move) {
  double normal[3];
  unit_normal<D>(corners, normal);
  const int side = orient<D>(corners, p);
  if (side == 0) return against(to_vec<D>(normal), move);
  return (side < 0 ? -1.0 : 1.0) * to_vec<D>(normal);
}

/** Where segment a b pierces the swept triangle; not both of its ends are in that plane. */
template <int D>
void triangle_piercing_point(const EdgeMotion& m, const double* a, const double* b, double* point) {
  const double* const swept[3] = {m.p, m.to, m.q};
  if (orient<D>(swept, b) - orient<D>(swept, a) < 0) std::swap(a, b);
  point_at<D>(a, b, crossing_time<D>(a, b, swept), point);
}

/** The points of what is touched, one to three. */
template <int D>
struct Touched {
  const double* at[3] = {};

  explicit Touched(const PairContact<D>& met) {
    const Body<D>& other = *met.other.body;
    const uint32_t* const names = met.part == PartKind::kVertex ? &met.index
                                  : met.part == PartKind::kEdge ? other.edges[met.index].ends
                                                                : other.faces[met.index].corners;
    const int count = 1 + static_cast<int>(met.part);
    for (int k = 0; k < 3; ++k) at[k] = other.position(names[std::min(k, count - 1)]);
  }
};

/** Point, place along the edge and normal of an edge, or of a vertex alone, on an edge or a vertex. */
template <int D>
void describe_edge(const PairContact<D>& met, const EdgeMotion& m, const Touched<D>& touched, dsw_contact& contact) {
  const double *const a = touched.at[0], *const b = touched.at[1];
  const Vec move = difference<D>(m.to, m.p), edge = difference<D>(m.q, contact.position), other = difference<D>(b, a);
  Vec normal;
  if (met.place == TouchPlace::kInside) {
    triangle_piercing_point<D>(m, a, b, contact.point);
    normal = against(unit(cross(unit(edge), unit(other))), move);
  } else if (met.place == TouchPlace::kVertex) {
    normal = back_across(move, other, are_collinear(m.p, m.to, a) && are_collinear(m.p, m.to, b));
  } else {
    std::copy_n(met.place == TouchPlace::kFirst ? a : b, 3, contact.point);
    normal = back_across(move, edge, are_collinear(m.p, m.to, m.q));
  }
  if (met.edge != kNone) contact.along = share_along<D>(contact.position, m.q, contact.point);
  store<D>(normal + Vec{}, contact.normal);  // never -0
}

}  // namespace

template <int D>
dsw_contact describe(const Environment<D>& env, const Body<D>& body, uint32_t v, const double* to,
                     const PairContact<D>& met) {
  dsw_contact contact{};
  const double* const from = body.position(v);
  std::copy_n(from, 3, contact.from);
  std::copy_n(to, 3, contact.to);
  contact.vertex = vertex_id(body, v);
  contact.front = volume_id(env.map, body.vertices[v].cell);
  contact.time = met.time;
  point_at<D>(from, to, met.time, contact.position);
  std::copy_n(contact.position, 3, contact.point);
  const Touched<D> touched(met);
  const Vec move = difference<D>(to, from);
  if (met.face != kNone) {
    const BodyFace& face = body.faces[met.face];
    const double *const q = body.position(face.after(v)), *const r = body.position(face.before(v));
    contact.face = face_id(body, met.face);
    std::copy_n(q, 3, contact.fixed[0]);
    std::copy_n(r, 3, contact.fixed[1]);
    std::copy_n(touched.at[0], 3, contact.point);
    const Vec across = cross(unit(difference<D>(q, contact.position)), unit(difference<D>(r, contact.position)));
    store<D>(against(unit(across), move) + Vec{}, contact.normal);
  } else if (met.part == PartKind::kFace) {
    store<D>(face_normal<D>(touched.at, from, move) + Vec{}, contact.normal);
  } else {
    const double* q = from;
    if (met.edge != kNone) {
      contact.edge = edge_id(body, met.edge);
      q = body.position(body.edges[met.edge].other(v));
      std::copy_n(q, 3, contact.fixed[0]);
    }
    describe_edge(met, {from, to, q}, touched, contact);
  }
  contact.kind = met.part == PartKind::kVertex ? DSW_CONTACT_VERTEX
                 : met.part == PartKind::kEdge ? DSW_CONTACT_EDGE
                                               : DSW_CONTACT_PLANE;
  return contact;
}

template <int D>
dsw_contact_partner partner_of(const PairContact<D>& met) noexcept {
  dsw_contact_partner partner{};
  const Body<D>& other = *met.other.body;
  partner.body = {met.other.index, met.other.generation};
  if (met.part == PartKind::kVertex) partner.vertex = vertex_id(other, met.index);
  if (met.part == PartKind::kEdge) partner.edge = edge_id(other, met.index);
  if (met.part == PartKind::kFace) partner.face = face_id(other, met.index);
  return partner;
}

uint64_t part_key(const dsw_contact_partner& partner) noexcept {
  if (partner.vertex.generation != 0) return uint64_t{1} << 32 | partner.vertex.index;
  if (partner.edge.generation != 0) return uint64_t{2} << 32 | partner.edge.index;
  return uint64_t{3} << 32 | partner.face.index;
}

#define DSW_DESCRIBE_PAIR(D)                                                                                  \
  template dsw_contact describe(const Environment<D>& env, const Body<D>& body, uint32_t v, const double* to, \
                                const PairContact<D>& met);                                                   \
  template dsw_contact_partner partner_of(const PairContact<D>& met) noexcept
DSW_DESCRIBE_PAIR(3);
#undef DSW_DESCRIBE_PAIR

}  // namespace dsw
