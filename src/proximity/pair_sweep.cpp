// A vertex against faces, edges against edges and faces against vertices find every first touch, since what stands
// apart first touches with the boundary of one of both; in the plane a vertex against edges and edges against vertices.
// Vertices without edges are edges of no length.

#include "proximity/pair_sweep.h"

#include "base/dimensions.h"
#include "base/function_ref.h"
#include "base/search.h"
#include "predicates/swept_plane.h"

#include <algorithm>
#include <array>
#include <tuple>

namespace dsw {
namespace {

/** A vertex between two edges, or at the end of one, and the vertices next to it on a chain. */
class Chain {
 public:
  Chain(const Body<3>& body, uint32_t v) : body_(body) {
    count_ = find_edges(v, edges_);
    for (uint32_t k = 0; k < count_; ++k) {
      next_[k] = body.edges[edges_[k]].other(v);
      uint32_t beyond[2] = {};
      const uint32_t count = find_edges(next_[k], beyond);
      if (count == 0) count_ = 0;
      if (count_ == 0) break;
      const uint32_t edge = beyond[0] == edges_[k] ? beyond[1] : beyond[0];
      far_[k] = count == 2 ? body.edges[edge].other(next_[k]) : kNone;
    }
  }

  /** Whether its edges are seen to touch none of the edges at their ends, nor the vertex itself what it leaves: of p,
   * p', one end and the far end of an edge at either end no four lie in one plane. */
  bool passes(const double* p, const double* to, double bound) const noexcept {
    if (count_ == 0) return false;
    const auto is_off = [&](const SweptPlane& plane, uint32_t k) { return plane.side(body_.position(far_[k])) != 0; };
    const SweptPlane first({p, to, body_.position(next_[0])}, bound);
    if (count_ == 1) return far_[0] != kNone && is_off(first, 0);
    const SweptPlane second({p, to, body_.position(next_[1])}, bound);
    return first.side(second) != 0 && (far_[0] == kNone || is_off(first, 0)) && (far_[1] == kNone || is_off(second, 1));
  }
  /** Whether its edges keep to their boxes, which `all_keep` says, and no other edges come near. */
  bool is_alone(const NearEdges& near, const double* to, bool all_keep) const noexcept {
    for (uint32_t k = 0; k < count_; ++k) {
      if (!(all_keep || near.keeps(edges_[k], to)) || !near.is_alone(edges_[k])) return false;
    }
    return true;
  }

 private:
  /** One or two edges at a vertex; 0: there are none, or more. */
  uint32_t find_edges(uint32_t v, uint32_t* found) const noexcept {
    uint32_t count = 0;
    for (uint32_t e = body_.vertices[v].first_edge; e != kNone; e = body_.edges[e].next[body_.edges[e].side_of(v)]) {
      if (count == 2) return 0;
      found[count++] = e;
    }
    return count;
  }

  const Body<3>& body_;
  uint32_t count_ = 0, edges_[2] = {}, next_[2] = {}, far_[2] = {};
};

/** Calls visit(touch) for all that is touched, until it returns false. */
template <int D>
class StarTouches {
 public:
  using Visit = FunctionRef<bool(const PairContact<D>&)>;

  StarTouches(const Partners<D>& partners, const Body<D>& body, uint32_t v, const double* to, const NearEdges* near,
              Visit visit)
      : partners_(partners), body_(body), v_(v), p_(body.position(v)), to_(to), near_(near), visit_(visit) {}
  /** With a vertex that is merged into another. */
  StarTouches(const Partners<D>& partners, const Body<D>& body, uint32_t v, uint32_t into, Visit visit)
      : StarTouches(partners, body, v, body.position(into), nullptr, visit) {
    into_ = into;
  }

  /** Whether visit never returned false. */
  bool run() {
    for (const Partner<D>& partner : partners_.all) {
      self_ = partner.body == &body_;
      const bool seen = self_ ? body_.filter.self : body_.filter.sees(partner.body->filter);
      other_ = &partner;
      if (!seen) continue;
      if (self_ && into_ != kNone ? !merge() : !meet(*partner.body)) return false;
    }
    return true;
  }

 private:
  bool meet(const Body<D>& other) {
    if (!meet_with_vertex(other)) return false;
    if (!covers_edges(body_.level)) return true;
    if constexpr (D == 3) {
      if (self_ && near_ != nullptr && near_->active() && look_near()) return true;
    }
    bool go_on = true;
    for_each_edge(body_, v_, [&](uint32_t e) { return go_on = meet_with_edge(other, e); });
    if constexpr (D == 3) {
      if (!go_on || !covers_faces(body_.level)) return go_on;
      for_each_face(body_, v_, [&](uint32_t f) { return go_on = meet_with_face(other, f); });
    }
    return go_on;
  }

  /** Sets what is known of its own edges near it; whether that is all. */
  bool look_near() {
    all_keep_ = near_->all_keep(v_, to_);
    bound_ = all_keep_ ? near_->bound() : kNoBound;
    const Chain chain(body_, v_);
    passes_neighbours_ = chain.passes(p_, to_, bound_);
    return passes_neighbours_ && chain.is_alone(*near_, to_, all_keep_) && !covers_faces(body_.level);
  }

  // Meets the body's own parts when vertex v moves into another vertex k. The path of v lies on edge v k, which was
  // apart from all that has no vertex in common; that edge and the faces at it only shrink. The other edges v q sweep
  // triangles v k q: what has a vertex in common with that starts there, and enters it only if it ends inside, or
  // leaves it through a side that was apart from it. Faces sweep tetrahedra.
  bool merge() {
    if (!covers_edges(body_.level)) {
      return fresh_boxes(body_).vertices.visit(path_box(), [&](uint32_t w) {
        return w == v_ || w == into_ || report_path(body_, Simplex::kVertex, w, w, w);
      });
    }
    bool go_on = true;
    for_each_edge(body_, v_, [&](uint32_t e) {
      const uint32_t q = body_.edges[e].other(v_);
      return q == into_ || (go_on = merge_edge(e, q));
    });
    if constexpr (D == 3) {
      if (!go_on || !covers_faces(body_.level)) return go_on;
      for_each_face(body_, v_, [&](uint32_t f) {
        const BodyFace& face = body_.faces[f];
        const bool shrinks = face.after(v_) == into_ || face.before(v_) == into_;
        return shrinks || (go_on = meet_with_face(body_, f));
      });
    }
    return go_on;
  }

  bool merge_edge(uint32_t e, [[maybe_unused]] uint32_t q) {
    if constexpr (D == 2) {
      return meet_with_edge(body_, e);
    } else {
      PairContact<D> touch;
      touch.part = {Simplex::kEdge, e};
      const EdgeMotion m{p_, to_, body_.position(q)};
      Box<D> box;
      for (const double* each : {m.p, m.to, m.q}) box.add(each);
      const auto is_own = [&](uint32_t w) { return w == v_ || w == into_ || w == q; };
      const auto vertex = [&](uint32_t w) { return report_edge(touch, m, body_, Simplex::kVertex, w, w, w); };
      const auto edge = [&](uint32_t x) {
        const uint32_t a = body_.edges[x].ends[0], b = body_.edges[x].ends[1];
        if (is_own(a) || is_own(b)) return (is_own(a) && is_own(b)) || vertex(is_own(a) ? b : a);
        return report_edge(touch, m, body_, Simplex::kEdge, x, a, b);
      };
      return fresh_boxes(body_).loners.visit(box, vertex) && fresh_boxes(body_).edges.visit(box, edge);
    }
  }

  Box<D> path_box() const {
    Box<D> box;
    box.add(p_);
    box.add(to_);
    return box;
  }

  bool meet_with_vertex(const Body<D>& other) {
    if constexpr (D == 3) {
      // Its edges stand for it, which in the plane are no more than vertices meet.
      const bool stands = covers_edges(body_.level) && body_.vertices[v_].first_edge != kNone;
      if (covers_faces(other.level)) {
        const Box<D> box = path_box();
        const auto face = [&](uint32_t f) { return meet_face(other, f); };
        if (other.boxes[0].bounds.overlaps(box) && !fresh_boxes(other).faces.visit(box, face)) return false;
      }
      if (stands) return true;
    }
    const Box<D> box = path_box();
    if (!other.boxes[0].bounds.overlaps(box)) return true;
    const auto vertex = [&](uint32_t w) { return (self_ && w == v_) || report_path(other, Simplex::kVertex, w, w, w); };
    if (!single_vertices(other, other.level).visit(box, vertex)) return false;
    const auto edge = [&](uint32_t e) {
      const uint32_t a = other.edges[e].ends[0], b = other.edges[e].ends[1];
      if (!self_ || (a != v_ && b != v_)) return report_path(other, Simplex::kEdge, e, a, b);
      const uint32_t far = a == v_ ? b : a;  // of an edge of its own
      return report_path(other, Simplex::kVertex, far, far, far);
    };
    return !covers_edges(other.level) || fresh_boxes(other).edges.visit(box, edge);
  }

  bool meet_face(const Body<D>& other, uint32_t f) {
    const uint32_t* const c = other.faces[f].corners;
    if (self_ && dsw::find(c, c + 3, v_) != c + 3) return true;
    const double* const at[3] = {other.position(c[0]), other.position(c[1]), other.position(c[2])};
    PairContact<D> touch;
    touch.time = vertex_touch(p_, to_, at);
    return report(touch, Simplex::kFace, f);
  }

  bool meet_with_edge(const Body<D>& other, uint32_t e) {
    const uint32_t q = body_.edges[e].other(v_);
    PairContact<D> touch;
    touch.part = {Simplex::kEdge, e};
    if constexpr (D == 3) {
      return meet_segments(other, q, touch);
    } else {
      return meet_with_solid(other, {v_, q}, {p_, to_, body_.position(q)}, touch);
    }
  }

  bool meet_segments(const Body<D>& other, uint32_t q, PairContact<D>& touch) {
    const EdgeMotion m{p_, to_, body_.position(q)};
    const auto edge = [&](uint32_t x) {
      const uint32_t a = other.edges[x].ends[0], b = other.edges[x].ends[1];
      const bool at_v = self_ && (a == v_ || b == v_), at_q = self_ && (a == q || b == q);
      if (!at_v && !at_q) return report_edge(touch, m, other, Simplex::kEdge, x, a, b);
      if (at_v && at_q) return report_path(other, Simplex::kVertex, q, q, q);
      // They have one vertex in common: the other end of each meets the other one.
      const uint32_t far = a == (at_v ? v_ : q) ? b : a;
      if (!report_edge(touch, m, other, Simplex::kVertex, far, far, far)) return false;
      return at_v || report_path(other, Simplex::kEdge, x, a, b);
    };
    if (self_ && near_ != nullptr && (all_keep_ || near_->keeps(touch.part.index, to_)))
      return meet_near(touch.part.index, m, edge);
    Box<D> box;
    for (const double* each : {m.p, m.to, m.q}) box.add(each);
    if (!other.boxes[0].bounds.overlaps(box)) return true;
    const auto vertex = [&](uint32_t w) {
      return (self_ && (w == v_ || w == q)) || report_edge(touch, m, other, Simplex::kVertex, w, w, w);
    };
    if (!single_vertices(other, other.level).visit(box, vertex)) return false;
    if (!covers_edges(other.level)) return true;
    const SweptEdge swept(m);
    return fresh_boxes(other).edges.visit(box, [&](uint32_t x) {
      const uint32_t a = other.edges[x].ends[0], b = other.edges[x].ends[1];
      return swept.stays_beside(other.position(a), other.position(b)) || edge(x);
    });
  }

  /** Meets the body's own edges that have a vertex in common with edge e, and those that may come near. Most are seen
   * to stay beside what is swept. */
  template <class Meet>
  bool meet_near(uint32_t e, const EdgeMotion& m, Meet meet) {
    if (!passes_neighbours_ && !meet_neighbours(e, SweptPlane(m, bound_), meet)) return false;
    if (near_->is_alone(e)) return true;
    const SweptEdge swept(m, bound_);
    return near_->visit(e, [&](uint32_t x) {
      const double *const a = body_.position(body_.edges[x].ends[0]), *const b = body_.position(body_.edges[x].ends[1]);
      if (swept.stays_beside(a, b)) return true;
      const SweptPlane plane(m, bound_);
      const int side = plane.side(a);
      return (side != 0 && side == plane.side(b)) || meet(x);
    });
  }

  template <class Meet>
  bool meet_neighbours(uint32_t e, const SweptPlane& plane, Meet meet) {
    bool go_on = true, in_line = true;  // p, p' and q
    for (const uint32_t u : body_.edges[e].ends) {
      for_each_edge(body_, u, [&](uint32_t x) {
        if (x == e) return true;
        if (plane.side(body_.position(body_.edges[x].other(u))) == 0) return go_on = meet(x);
        in_line = false;
        return true;
      });
      if (!go_on) return false;
    }
    return !in_line || meet(e);
  }

  bool meet_with_face(const Body<D>& other, uint32_t f) {
    const uint32_t q = body_.faces[f].after(v_), r = body_.faces[f].before(v_);
    PairContact<D> touch;
    touch.part = {Simplex::kFace, f};
    return meet_with_solid(other, {v_, q, r}, {p_, to_, body_.position(q), body_.position(r)}, touch);
  }

  bool meet_with_solid(const Body<D>& other, const std::array<uint32_t, D>& own, const SolidMotion<D>& m,
                       PairContact<D>& touch) {
    Box<D> box;
    box.add(to_);
    for (const uint32_t each : own) box.add(body_.position(each));
    const auto vertex = [&](uint32_t w) {
      if (self_ && (w == into_ || dsw::find(own.begin(), own.end(), w) != own.end())) return true;
      touch.time = solid_touch<D>(m, other.position(w));
      return report(touch, Simplex::kVertex, w);
    };
    return !other.boxes[0].bounds.overlaps(box) || fresh_boxes(other).vertices.visit(box, vertex);
  }

  bool report_path(const Body<D>& other, Simplex::Kind part, uint32_t index, uint32_t a, uint32_t b) {
    PairContact<D> touch;
    return report(touch, path_touch<D>(p_, to_, other.position(a), other.position(b)), part, index);
  }
  bool report_edge(PairContact<D>& touch, const EdgeMotion& m, const Body<D>& other, Simplex::Kind part, uint32_t index,
                   uint32_t a, uint32_t b) {
    return report(touch, edge_touch(m, other.position(a), other.position(b)), part, index);
  }
  bool report(PairContact<D>& touch, const EdgeTouch& found, Simplex::Kind part, uint32_t index) {
    touch.time = found.time;
    touch.place = found.place;
    return report(touch, part, index);
  }
  bool report(PairContact<D>& touch, Simplex::Kind part, uint32_t index) {
    if (touch.time == kNever) return true;
    touch.other = *other_;
    touch.other_part = {part, index};
    return visit_(touch);
  }

  const Partners<D>& partners_;
  const Body<D>& body_;
  uint32_t v_;
  const double* p_;
  const double* to_;
  const NearEdges* near_;
  Visit visit_;
  const Partner<D>* other_ = nullptr;
  bool self_ = false;
  // Whether all edges of the body keep to their boxes; false unless a list of near edges is active.
  bool all_keep_ = false;
  double bound_ = kNoBound;
  bool passes_neighbours_ = false;  // its edges touch none of those that have a vertex in common with them
  uint32_t into_ = kNone;
};

template <int D>
bool for_each_touch(const Partners<D>& partners, const Body<D>& body, uint32_t v, const double* to,
                    const NearEdges* near, typename StarTouches<D>::Visit visit) {
  return StarTouches<D>(partners, body, v, to, near, visit).run();
}

template <int D>
bool comes_before(const PairContact<D>& a, const PairContact<D>& b) noexcept {
  const auto key = [](const PairContact<D>& c) {
    return std::make_tuple(c.time, c.part.kind, c.part.index, c.other.index, c.other_part.kind, c.other_part.index);
  };
  return key(a) < key(b);
}

}  // namespace

template <int D>
bool is_way_apart(const Partners<D>& partners, const Body<D>& body, uint32_t v, const double* to,
                  const NearEdges* near) noexcept {
  if (!partners.reach.contains(to)) return false;
  if (std::equal(to, to + D, body.position(v))) return true;  // what stands touches nothing
  return for_each_touch(partners, body, v, to, near, [](const PairContact<D>&) { return false; });
}

template <int D>
bool is_merge_apart(const Partners<D>& partners, const Body<D>& body, uint32_t v, uint32_t into) noexcept {
  if (!partners.reach.contains(body.position(into))) return false;
  const auto never = [](const PairContact<D>&) { return false; };
  return StarTouches<D>(partners, body, v, into, never).run();
}

template <int D>
bool find_first_pair(const Partners<D>& partners, const Body<D>& body, uint32_t v, const double* to,
                     PairContact<D>* first, const NearEdges* near) noexcept {
  *first = PairContact<D>();
  if (std::equal(to, to + D, body.position(v))) return false;
  for_each_touch(partners, body, v, to, near, [&](const PairContact<D>& touch) {
    if (comes_before(touch, *first)) *first = touch;
    return true;
  });
  return first->time != kNever;
}

DSW_INSTANTIATE(is_way_apart);
DSW_INSTANTIATE(is_merge_apart);
DSW_INSTANTIATE(find_first_pair);

}  // namespace dsw
