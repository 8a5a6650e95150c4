// Vertices are looked up, edges cast and faces swept by one of their edges, each once: when a body is created or its
// level raised, and when obstacles appear; then only what overlaps their boxes is looked at.

#include "sweep/body_probe.h"

#include "base/assert.h"
#include "base/error.h"
#include "environment/marking.h"

namespace dsw {
namespace {

/** Takes back the marks of the cells that a cast enters. */
template <int D>
struct Unmarking {
  Environment<D>& env;
  size_t count = 0;

  static void enter(void* user, Cell, uint32_t, Cell to) {
    auto& self = *static_cast<Unmarking<D>*>(user);
    self.count += set_cell_mark(self.env, to, false) ? 1u : 0u;
  }
};

}  // namespace

bool is_face_free(const Environment<3>& env, SweepFlood<3>& flood, const Body<3>& body, uint32_t face) {
  const uint32_t(&c)[3] = body.faces[face].corners;
  const EdgeMotion m{body.position(c[0]), body.position(c[1]), body.position(c[2])};
  const Cell start = body.vertices[c[0]].cell;
  if (flood.sweep(m, start, 0, true).end != SweepEnd::kFree) return false;
  // Over a fold of the environment the flood is in another part of it than the corners. Of corners in one line it goes
  // nowhere.
  const auto is_met = [&](uint32_t v) { return flood.cells().contains(body.vertices[v].cell); };
  return (is_met(c[1]) && is_met(c[2])) || swept_side(m, env.point(start, 0)).sign == 0;
}

template <int D>
BodyProbe<D>::BodyProbe(const Environment<D>& env, Obstacle kind) : env_(env), kind_(kind), flood_(env) {}

/** Each calls visit(index) for what is not free, until it returns false; whether it never did. */
template <int D>
template <class Visit>
bool BodyProbe<D>::visit_vertices(const Body<D>& body, const Places<D>& changed, Visit visit) {
  if (kind_ != Obstacle::kCells) return true;
  const auto look = [&](uint32_t v) {
    const double* const at = body.position(v);
    if (!body.has_vertex(v) || !changed.overlap(&at, 1) || !env_.map.marked(body.vertices[v].cell)) return true;
    return visit(v);
  };
  return visit_near(body, &BodyBoxes<D>::vertices, body.vertices.size(), changed, near_, looked_at, look);
}

template <int D>
template <class Visit>
bool BodyProbe<D>::visit_edges(const Body<D>& body, const Places<D>& changed, SweepLevel level, Visit visit) {
  if (kind_ == Obstacle::kMarkedEdges || !covers_edges(level)) return true;
  uint32_t edges[kPacket];
  packet_.clear();
  const auto run = [&] {
    packet_.run(env_, nullptr);
    bool go_on = true;
    for (uint32_t i = 0; i < packet_.count() && go_on; ++i) {
      if (!packet_.reached(i)) go_on = visit(edges[i]);
    }
    packet_.clear();
    return go_on;
  };
  const auto look = [&](uint32_t e) {
    if (!body.has_edge(e)) return true;
    const BodyVertex<D>&a = body.vertices[body.edges[e].ends[0]], &b = body.vertices[body.edges[e].ends[1]];
    const double* const ends[2] = {a.position, b.position};
    if (!changed.overlap(ends, 2)) return true;
    edges[packet_.count()] = e;
    packet_.add(env_, a.cell, a.position, b.position).end = b.cell;
    return !packet_.full() || run();
  };
  return visit_near(body, &BodyBoxes<D>::edges, body.edges.size(), changed, near_, looked_at, look) && run();
}

/** Vertices and edges of the body are free. */
template <int D>
template <class Visit>
bool BodyProbe<D>::visit_faces(const Body<D>& body, const Places<D>& changed, SweepLevel level, Visit visit) {
  if constexpr (D == 3) {
    if (!covers_faces(level)) return true;
    const auto look = [&](uint32_t f) {
      if (!body.has_face(f)) return true;
      const uint32_t* const c = body.faces[f].corners;
      const double* const corners[3] = {body.position(c[0]), body.position(c[1]), body.position(c[2])};
      return !changed.overlap(corners, 3) || is_face_free(env_, flood_, body, f) || visit(f);
    };
    return visit_near(body, &BodyBoxes<D>::faces, body.faces.size(), changed, near_, looked_at, look);
  }
  return true;
}

template <int D>
bool BodyProbe<D>::is_free(const Body<D>& body, const Places<D>& changed) {
  const auto stop = [](uint32_t) { return false; };
  return visit_vertices(body, changed, stop) && visit_edges(body, changed, body.level, stop) &&
         visit_faces(body, changed, body.level, stop);
}

template <int D>
void BodyProbe<D>::find_blocked(const Body<D>& body, SweepLevel level, Array<uint32_t>& pairs) {
  const auto add = [&](const uint32_t* vertices) {
    pairs.push_back(vertices[0]);
    pairs.push_back(vertices[1]);
    return true;
  };
  visit_edges(body, {}, level, [&](uint32_t e) { return add(body.edges[e].ends); });
  if (pairs.empty()) visit_faces(body, {}, level, [&](uint32_t f) { return add(body.faces[f].corners); });
}

template <int D>
size_t BodyProbe<D>::leave_out(Environment<D>& env, const Body<D>& body, const Places<D>& changed) {
  Unmarking<D> passed{env};
  visit_vertices(body, changed, [&](uint32_t v) {
    Unmarking<D>::enter(&passed, {}, 0, body.vertices[v].cell);
    return true;
  });
  visit_edges(body, changed, body.level, [&](uint32_t e) {
    // All on its way was passable before, so that every mark there is new; one flight through them finds them all.
    CastRequest request;
    request.from = body.position(body.edges[e].ends[0]);
    request.to = body.position(body.edges[e].ends[1]);
    request.start = body.vertices[body.edges[e].ends[0]].cell;
    request.through_walls = true;
    request.crossing = Unmarking<D>::enter;
    request.crossing_user = &passed;
    cast(env_, request, nullptr);
    return true;
  });
  if constexpr (D == 3) {
    visit_faces(body, changed, body.level, [&](uint32_t f) {
      do {
        const size_t before = passed.count;
        for (const SweepContact& contact : flood_.all()) {
          const HalfFacet behind = contact.facet.valid() ? env_.map.opposite(contact.facet) : HalfFacet{};
          if (behind.valid()) Unmarking<D>::enter(&passed, {}, 0, env_.map.cell_of(behind));
        }
        DSW_ASSERT(passed.count != before);
        if (passed.count == before)
          fail(DSW_STATUS_OCCUPIED, "face %u of a body meets something that was impassable before", f);
      } while (!is_face_free(env_, flood_, body, f));
      return true;
    });
  }
  return passed.count;
}

template class BodyProbe<2>;
template class BodyProbe<3>;

}  // namespace dsw
