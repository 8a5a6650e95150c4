#pragma once
// The bodies that one may meet, and whether something that stands still is apart from them.

#include <algorithm>

#include "base/search.h"
#include "body/body.h"
#include "predicates/sweep_events.h"

namespace dsw {

template <int D>
struct Partner {
  const Body<D>* body;
  uint32_t index, generation;  // how the host names it
};

/** What a body may meet on its way. It may stand in its own list: whether it sees itself its filter says. */
template <int D>
struct Partners {
  Array<Partner<D>> all;
  Box<D> reach = Box<D>::everything();  // the body does not leave it: all that is met there is in the list
  bool has_thick = false;               // one of them has a radius

  void add(const Partner<D>& partner) {
    all.push_back(partner);
    has_thick = has_thick || partner.body->radius > 0;
  }
  void clear() noexcept {
    all.clear();
    has_thick = false;
  }
  template <class IsGone>
  void remove(IsGone is_gone) {
    all.erase(std::remove_if(all.begin(), all.end(), is_gone), all.end());
    has_thick = dsw::any_of(all.begin(), all.end(), [](const Partner<D>& each) { return each.body->radius > 0; });
  }
  explicit Partners(const Memory* memory) : all(memory) {}
};

// Parts of a body meet those of another that its level covers; of its own those with no vertex in common.

/** Vertices that no edge stands for. */
template <int D>
inline const BoxGrid<D>& single_vertices(const Body<D>& body, SweepLevel level) {
  return covers_edges(level) ? fresh_boxes(body).loners : fresh_boxes(body).vertices;
}

/** A place between vertices of a body, or beside them: kNone. */
struct Corner {
  const double* at;
  uint32_t vertex;
};

/** Whether a segment of a body, of which both ends may be one, touches none of the partners. `replaced` is an edge of
 * the body that the segment is to take the place of, with others: this edge and the faces at it are not looked at. */
template <int D>
bool is_segment_apart(const Partners<D>& partners, const Body<D>& body, const Corner& a, const Corner& b,
                      uint32_t replaced = kNone) noexcept;
/** Whether the inside of a triangle in space does; that of its edges is known. */
bool is_triangle_apart(const Partners<3>& partners, const Body<3>& body, const Corner* corners) noexcept;
/** Whether the inside of a tetrahedron does, in the plane that of a triangle; that of its boundary is known. `own`: D
 * vertices of the body that are corners of the solid. */
template <int D>
bool is_solid_apart(const Partners<D>& partners, const Body<D>& body, const SolidMotion<D>& swept,
                    const uint32_t* own) noexcept;
/** Whether no partner touches what an edge and the faces at it sweep when the edge is bent to pass through `point`, and
 * what they are then. Of its own parts the body meets those with no vertex in common with the part that sweeps. */
template <int D>
bool is_bend_apart(const Partners<D>& partners, const Body<D>& body, uint32_t edge, const double* point) noexcept;

/** Looks at all that a level covers of a body; calls blocked(a, b) with two vertices of each part that is not apart
 * until it returns false. Whether all of it is apart. O(size of the body + what is near). */
template <int D, class Blocked>
bool is_body_apart(const Partners<D>& partners, const Body<D>& body, SweepLevel level, Blocked blocked) {
  const auto corner = [&](uint32_t v) { return Corner{body.position(v), v}; };
  bool apart = true;
  const auto decide = [&](bool is_apart, uint32_t a, uint32_t b) {
    apart = apart && is_apart;
    return is_apart || blocked(a, b);
  };
  for (uint32_t v = 0; v < body.vertices.size(); ++v) {
    const bool single = body.has_vertex(v) && (!covers_edges(level) || body.vertices[v].first_edge == kNone);
    if (single && !decide(is_segment_apart(partners, body, corner(v), corner(v)), v, v)) return false;
  }
  for (uint32_t e = 0; covers_edges(level) && e < body.edges.size(); ++e) {
    if (!body.has_edge(e)) continue;
    const uint32_t a = body.edges[e].ends[0], b = body.edges[e].ends[1];
    if (!decide(is_segment_apart(partners, body, corner(a), corner(b)), a, b)) return false;
  }
  if constexpr (D == 3) {
    for (uint32_t f = 0; covers_faces(level) && f < body.faces.size(); ++f) {
      if (!body.has_face(f)) continue;
      const uint32_t* const c = body.faces[f].corners;
      const Corner corners[3] = {corner(c[0]), corner(c[1]), corner(c[2])};
      if (!decide(is_triangle_apart(partners, body, corners), c[0], c[1])) return false;
    }
  }
  return apart;
}

}  // namespace dsw
