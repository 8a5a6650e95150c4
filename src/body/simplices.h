#pragma once
// The simplices of a body that its level covers: vertices, edges, faces. A caller need not ask for the level.

#include <algorithm>

#include "base/simplex.h"
#include "body/body.h"

namespace dsw {

/** The vertices of a simplex. */
template <int D>
struct SimplexCorners {
  uint32_t vertices[3];
  uint32_t count;

  SimplexCorners(const Body<D>& body, const Simplex& simplex) : vertices{simplex.index}, count(simplex.kind + 1) {
    if (simplex.kind == Simplex::kEdge) std::copy_n(body.edges[simplex.index].ends, 2, vertices);
    if (simplex.kind == Simplex::kFace) std::copy_n(body.faces[simplex.index].corners, 3, vertices);
  }
  const uint32_t* begin() const { return vertices; }
  const uint32_t* end() const { return vertices + count; }
};

/** Calls visit(simplex) for the edges, then the faces, that the level of a body covers. Stops when it returns false; whether it
 * never did. */
template <int D, class Visit>
bool for_each_edge_and_face(const Body<D>& body, Visit visit) {
  for (uint32_t e = 0; covers_edges(body.level) && e < body.edges.size(); ++e) {
    if (body.has_edge(e) && !visit(Simplex{Simplex::kEdge, e})) return false;
  }
  for (uint32_t f = 0; covers_faces(body.level) && f < body.faces.size(); ++f) {
    if (body.has_face(f) && !visit(Simplex{Simplex::kFace, f})) return false;
  }
  return true;
}

/** Calls visit(simplex) for all that the level of a body covers: vertices, then edges, then faces. Stops when it
 * returns false; whether it never did. */
template <int D, class Visit>
bool for_each_simplex(const Body<D>& body, Visit visit) {
  for (uint32_t v = 0; v < body.vertices.size(); ++v) {
    if (body.has_vertex(v) && !visit(Simplex{Simplex::kVertex, v})) return false;
  }
  return for_each_edge_and_face(body, visit);
}

/** Calls visit(simplex) for vertex v, then for the edges and faces at v that the body's level covers. Stops when visit
 * returns false; returns whether it never did. */
template <int D, class Visit>
bool for_each_simplex_at(const Body<D>& body, uint32_t v, Visit visit) {
  bool go_on = visit(Simplex{Simplex::kVertex, v});
  if (go_on && covers_edges(body.level)) {
    for_each_edge(body, v, [&](uint32_t e) { return go_on = visit(Simplex{Simplex::kEdge, e}); });
  }
  if (go_on && covers_faces(body.level)) {
    for_each_face(body, v, [&](uint32_t f) { return go_on = visit(Simplex{Simplex::kFace, f}); });
  }
  return go_on;
}

/** Whether a simplex of higher dimension covers this one. */
template <int D>
bool is_covered(const Body<D>& body, const Simplex& simplex) {
  switch (simplex.kind) {
    case Simplex::kVertex:
      return covers_edges(body.level) && body.vertices[simplex.index].first_edge != kNone;
    case Simplex::kEdge:
      return covers_faces(body.level) && body.edges[simplex.index].faces[0] != kNone;
    case Simplex::kFace:
      break;
  }
  return false;
}

/** Calls visit(simplex) for those simplices of for_each_simplex that no other simplex covers. */
template <int D, class Visit>
bool for_each_outer(const Body<D>& body, Visit visit) {
  return for_each_simplex(body, [&](const Simplex& each) { return is_covered(body, each) || visit(each); });
}

}  // namespace dsw
