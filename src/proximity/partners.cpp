#include "proximity/partners.h"

#include "base/dimensions.h"
#include "base/search.h"
#include "predicates/touch.h"

namespace dsw {
namespace {

bool is_corner(const BodyFace& face, uint32_t v) {
  return face.corners[0] == v || face.corners[1] == v || face.corners[2] == v;
}

/** A segment that is compared with the parts of one body, which is the segment's own if `self`. */
template <int D>
class Segment {
 public:
  Segment(const Body<D>& other, bool self, const Corner& a, const Corner& b, uint32_t replaced)
      : other_(other), self_(self), a_(a), b_(b), replaced_(self ? replaced : kNone) {
    box_.add(a.at);
    box_.add(b.at);
  }

  bool is_apart() const noexcept {
    if (!other_.boxes[0].bounds.overlaps(box_)) return true;
    const auto past_vertex = [&](uint32_t v) { return is_own(v) || !touches(other_.position(v), other_.position(v)); };
    if (!single_vertices(other_, other_.level).visit(box_, past_vertex)) return false;
    const auto past_edge = [&](uint32_t e) { return e == replaced_ || is_past_edge(other_.edges[e]); };
    if (covers_edges(other_.level) && !fresh_boxes(other_).edges.visit(box_, past_edge)) return false;
    if constexpr (D == 3) {
      const auto past_face = [&](uint32_t f) { return is_replaced_face(f) || is_past_face(other_.faces[f]); };
      if (covers_faces(other_.level) && !fresh_boxes(other_).faces.visit(box_, past_face)) return false;
    }
    return true;
  }

 private:
  bool is_own(uint32_t v) const noexcept { return self_ && (v == a_.vertex || v == b_.vertex); }
  bool is_replaced_face(uint32_t f) const noexcept {
    return replaced_ != kNone && (other_.edges[replaced_].faces[0] == f || other_.edges[replaced_].faces[1] == f);
  }
  bool touches(const double* c, const double* d) const noexcept { return segments_touch<D>(a_.at, b_.at, c, d); }

  bool is_past_edge(const BodyEdge& edge) const noexcept {
    const uint32_t c = edge.ends[0], d = edge.ends[1];
    const bool own_c = is_own(c), own_d = is_own(d);
    if (!own_c && !own_d) return !touches(other_.position(c), other_.position(d));
    if (own_c && own_d) return !segments_touch<D>(a_.at, a_.at, b_.at, b_.at);  // its ends
    // They have one vertex in common: the other end of each is apart from the other one.
    const uint32_t common = own_c ? c : d, far = own_c ? d : c;
    if (touches(other_.position(far), other_.position(far))) return false;
    const Corner& own_far = a_.vertex == common ? b_ : a_;
    return own_far.vertex == common ||
           !segments_touch<D>(own_far.at, own_far.at, other_.position(c), other_.position(d));
  }

  bool is_past_face(const BodyFace& face) const noexcept {
    const double* const corners[3] = {other_.position(face.corners[0]), other_.position(face.corners[1]),
                                      other_.position(face.corners[2])};
    const bool has_a = self_ && is_corner(face, a_.vertex), has_b = self_ && is_corner(face, b_.vertex);
    if (has_a && has_b) return true;
    return !triangle_touches(corners, has_a ? b_.at : a_.at, has_b ? a_.at : b_.at);
  }

  const Body<D>& other_;
  bool self_;
  Corner a_, b_;
  uint32_t replaced_;
  Box<D> box_;
};

/** Calls visit(other, self) for each that is seen, until it returns false. */
template <int D, class Visit>
bool for_each_seen(const Partners<D>& partners, const Body<D>& body, Visit visit) {
  for (const Partner<D>& partner : partners.all) {
    const bool self = partner.body == &body;
    const bool seen = self ? body.filter.self : body.filter.sees(partner.body->filter);
    if (seen && !visit(*partner.body, self)) return false;
  }
  return true;
}

}  // namespace

template <int D>
bool is_segment_apart(const Partners<D>& partners, const Body<D>& body, const Corner& a, const Corner& b,
                      uint32_t replaced) noexcept {
  return for_each_seen(partners, body, [&](const Body<D>& other, bool self) {
    return Segment<D>(other, self, a, b, replaced).is_apart();
  });
}

bool is_triangle_apart(const Partners<3>& partners, const Body<3>& body, const Corner* corners) noexcept {
  const double* const at[3] = {corners[0].at, corners[1].at, corners[2].at};
  Box<3> box;
  for (const double* each : at) box.add(each);
  return for_each_seen(partners, body, [&](const Body<3>& other, bool self) {
    if (!other.boxes[0].bounds.overlaps(box)) return true;
    const auto is_own = [&](uint32_t v) {
      return self && (v == corners[0].vertex || v == corners[1].vertex || v == corners[2].vertex);
    };
    const auto past = [&](uint32_t c, uint32_t d) {
      const bool own_c = is_own(c), own_d = is_own(d);
      if (own_c && own_d) return true;
      return !triangle_touches(at, other.position(own_c ? d : c), other.position(own_d ? c : d));
    };
    const auto past_vertex = [&](uint32_t v) { return past(v, v); };
    if (!single_vertices(other, other.level).visit(box, past_vertex)) return false;
    const auto past_edge = [&](uint32_t e) { return past(other.edges[e].ends[0], other.edges[e].ends[1]); };
    return !covers_edges(other.level) || fresh_boxes(other).edges.visit(box, past_edge);
  });
}

template <int D>
bool is_solid_apart(const Partners<D>& partners, const Body<D>& body, const SolidMotion<D>& swept,
                    const uint32_t* own) noexcept {
  Box<D> box;
  for (const double* each : {swept.p, swept.to, swept.q}) box.add(each);
  if constexpr (D == 3) box.add(swept.r);
  return for_each_seen(partners, body, [&](const Body<D>& other, bool self) {
    return fresh_boxes(other).vertices.visit(box, [&](uint32_t v) {
      return (self && dsw::find(own, own + D, v) != own + D) || solid_touch<D>(swept, other.position(v)) == kNever;
    });
  });
}

// This compares the bend with the body's own parts. Think of the edge p q as split where it is, at m0, and of m0 as
// moved to m. A simplicial complex of which no two parts without a common vertex touch stays one when it is split. So m
// gets to its place if no part at m touches, on the way, a part that stays and has no vertex in common with it. Those
// at m sweep parts of the triangle p m q and, for each face p q r, of the tetrahedron p m q r. A part that stays and
// has a vertex in common with that enters it there: it leaves it through the side opposite of the vertex, which is
// tested with the whole of the part, or it ends inside, and then its other end is found there. So the tests are those
// of any segment, triangle and solid of the body. Those are for m where it is, whatever m0 was: rounding may have put m
// on the edge, beside it or in its line beyond an end. Below FACES the edge m r cuts a face that is not covered: it is
// compared where it is then, since nothing stood for it before.
template <int D>
bool is_bend_apart(const Partners<D>& partners, const Body<D>& body, uint32_t edge, const double* point) noexcept {
  if (!partners.reach.contains(point)) return false;
  const BodyEdge& bent = body.edges[edge];
  const Corner p{body.position(bent.ends[0]), bent.ends[0]}, q{body.position(bent.ends[1]), bent.ends[1]},
      m{point, kNone};
  const auto is_side_apart = [&](const Corner& a, const Corner& b) {
    return is_segment_apart(partners, body, a, b, edge);
  };
  if (!covers_edges(body.level)) return is_side_apart(m, m);
  // The edge itself is not looked at: its ends are.
  const auto meets_end = [&] {
    return segments_touch<D>(p.at, m.at, q.at, q.at) || segments_touch<D>(m.at, q.at, p.at, p.at);
  };
  if (body.filter.self && meets_end()) return false;
  if (!is_side_apart(p, m) || !is_side_apart(m, q)) return false;
  if constexpr (D == 2) {
    return is_solid_apart<D>(partners, body, {p.at, m.at, q.at}, bent.ends);
  } else {
    const auto is_face_apart = [&](const Corner& a, const Corner& b) {
      const Corner corners[3] = {a, m, b};
      return is_triangle_apart(partners, body, corners);
    };
    if (!is_face_apart(p, q)) return false;
    for (const uint32_t f : bent.faces) {
      if (f == kNone) continue;
      const BodyFace& face = body.faces[f];
      const uint32_t far = face.after(p.vertex) == q.vertex ? face.before(p.vertex) : face.after(p.vertex);
      const Corner r{body.position(far), far};
      if (!is_side_apart(m, r)) return false;
      if (!covers_faces(body.level)) continue;
      const uint32_t own[3] = {p.vertex, q.vertex, far};
      if (!is_face_apart(p, r) || !is_face_apart(q, r) ||
          !is_solid_apart<D>(partners, body, {p.at, m.at, q.at, r.at}, own)) {
        return false;
      }
    }
    return true;
  }
}

DSW_INSTANTIATE(is_segment_apart);
DSW_INSTANTIATE(is_solid_apart);
DSW_INSTANTIATE(is_bend_apart);

}  // namespace dsw
