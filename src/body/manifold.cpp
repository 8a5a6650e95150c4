// What a body's topology is asked: its parts by their vertices, and whether it is, or stays, a manifold.

#include "body/body.h"

#include <algorithm>
#include <cmath>

#include "base/dimensions.h"
#include "base/search.h"

namespace dsw {

template <int D>
uint32_t find_edge(const Body<D>& body, uint32_t a, uint32_t b) noexcept {
  uint32_t found = kNone;
  for_each_edge(body, a, [&](uint32_t e) {
    if (body.edges[e].other(a) == b) found = e;
    return found == kNone;
  });
  return found;
}

template <int D>
uint32_t find_face(const Body<D>& body, uint32_t a, uint32_t b, uint32_t c) noexcept {
  const uint32_t e = find_edge(body, a, b);
  if (e == kNone) return kNone;
  for (const uint32_t f : body.edges[e].faces) {
    if (f == kNone) continue;
    const BodyFace& face = body.faces[f];
    if (dsw::find(face.corners, face.corners + 3, c) != face.corners + 3) return f;
  }
  return kNone;
}

template <int D>
FaceDefect face_defect(const Body<D>& body, uint32_t a, uint32_t b, uint32_t c) noexcept {
  if (find_face(body, a, b, c) != kNone) return FaceDefect::kRepeated;
  const uint32_t corners[3] = {a, b, c};
  for (int k = 0; k < 3; ++k) {
    const uint32_t from = corners[k], to = corners[(k + 1) % 3], e = find_edge(body, from, to);
    if (e == kNone) continue;
    const BodyEdge& edge = body.edges[e];
    if (edge.faces[0] != kNone && edge.faces[1] != kNone) return FaceDefect::kThirdFace;
    const uint32_t neighbour = edge.faces[0] != kNone ? edge.faces[0] : edge.faces[1];
    if (neighbour != kNone && body.faces[neighbour].after(from) == to) return FaceDefect::kTurned;
  }
  return FaceDefect::kFine;
}

template <int D>
bool starts_fan(const Body<D>& body, uint32_t a, uint32_t b, uint32_t c) noexcept {
  const uint32_t corners[3] = {a, b, c};
  const auto has_face = [&](uint32_t from, uint32_t to) {
    const uint32_t e = find_edge(body, from, to);
    return e != kNone && (body.edges[e].faces[0] != kNone || body.edges[e].faces[1] != kNone);
  };
  for (int k = 0; k < 3; ++k) {
    const uint32_t v = corners[k];
    bool bare = true;
    for_each_face(body, v, [&](uint32_t) { return bare = false; });
    if (!bare && !has_face(v, corners[(k + 1) % 3]) && !has_face(v, corners[(k + 2) % 3])) return true;
  }
  return false;
}

template <int D>
bool is_one_fan(const Body<D>& body, uint32_t vertex) noexcept {
  uint32_t count = 0, start = kNone;
  for_each_face(body, vertex, [&](uint32_t f) {
    // A fan that is open begins at the face whose first edge has no other face.
    const BodyEdge& edge = body.edges[find_edge(body, vertex, body.faces[f].after(vertex))];
    if (count++ == 0 || edge.faces[0] == kNone || edge.faces[1] == kNone) start = f;
    return true;
  });
  if (count == 0) return true;
  uint32_t reached = 0;
  for (uint32_t f = start; f != kNone;) {
    ++reached;
    const BodyEdge& edge = body.edges[find_edge(body, vertex, body.faces[f].before(vertex))];
    f = edge.faces[0] == f ? edge.faces[1] : edge.faces[0];
    if (f == start) break;
  }
  return reached == count;
}

bool is_closed_surface(const Body<3>& body) noexcept {
  for (uint32_t v = 0; v < body.vertices.size(); ++v) {
    if (body.has_vertex(v) && body.vertices[v].first_edge == kNone) return false;
  }
  return dsw::none_of(body.edges.begin(), body.edges.end(), [](const BodyEdge& e) {
    return e.ends[0] != kNone && (e.faces[0] == kNone || e.faces[1] == kNone);
  });
}

bool is_turned_outwards(const Body<3>& body) noexcept {
  // Relative to one of the vertices, halved so that no difference overflows, in units in which no product does.
  const auto place = [&](uint32_t v, int k) {
    return body.vertices[v].position[k] / 2 - body.vertices[0].position[k] / 2;
  };
  double largest = 0, volume = 0;
  for (uint32_t v = 0; v < body.vertices.size(); ++v) {
    for (int k = 0; k < 3; ++k) largest = std::max(largest, std::fabs(place(v, k)));
  }
  for (const BodyFace& f : body.faces) {
    if (f.corners[0] == kNone) continue;
    double at[3][3];
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) at[i][k] = place(f.corners[i], k) / largest;
    }
    volume += at[0][0] * (at[1][1] * at[2][2] - at[1][2] * at[2][1]) +
              at[0][1] * (at[1][2] * at[2][0] - at[1][0] * at[2][2]) +
              at[0][2] * (at[1][0] * at[2][1] - at[1][1] * at[2][0]);
  }
  return volume > 0;
}

template <int D>
bool can_collapse(const Body<D>& body, uint32_t edge, uint32_t vertex) noexcept {
  const BodyEdge& e = body.edges[edge];
  const uint32_t kept = e.other(vertex);
  // An edge without faces between two surfaces would join them in a vertex alone.
  const auto has_face = [&](uint32_t v) {
    bool any = false;
    for_each_face(body, v, [&](uint32_t) {
      any = true;
      return false;
    });
    return any;
  };
  if (e.faces[0] == kNone && e.faces[1] == kNone && has_face(vertex) && has_face(kept)) return false;
  bool fits = true;
  // A neighbour of both ends must be the far corner of a face at the edge: its two other edges become one.
  for_each_edge(body, vertex, [&](uint32_t other) {
    const uint32_t far = body.edges[other].other(vertex);
    const uint32_t twin = far == kept ? kNone : find_edge(body, kept, far);
    if (twin == kNone) return true;
    fits = find_face(body, vertex, kept, far) != kNone;
    return fits;
  });
  if (!fits) return false;
  // A closed surface must keep more than the two triangles it would fold onto.
  bool folds = false;
  for_each_face(body, vertex, [&](uint32_t f) {
    const BodyFace& face = body.faces[f];
    if (face.after(vertex) == kept || face.before(vertex) == kept) return true;
    folds = find_face(body, kept, face.after(vertex), face.before(vertex)) != kNone;
    return !folds;
  });
  if (folds) return false;
  // Two boundary vertices joined by an inner edge would pinch the surface.
  const auto on_rim = [&](uint32_t v) {
    bool rim = false;
    for_each_edge(body, v, [&](uint32_t x) {
      rim = (body.edges[x].faces[0] == kNone) != (body.edges[x].faces[1] == kNone);
      return !rim;
    });
    return rim;
  };
  const bool inner = e.faces[0] != kNone && e.faces[1] != kNone;
  return !(inner && on_rim(vertex) && on_rim(kept));
}

DSW_INSTANTIATE(find_edge);
DSW_INSTANTIATE(can_collapse);
// Nothing of the plane gets faces.
template uint32_t find_face(const Body<3>& body, uint32_t a, uint32_t b, uint32_t c) noexcept;
template FaceDefect face_defect(const Body<3>& body, uint32_t a, uint32_t b, uint32_t c) noexcept;
template bool starts_fan(const Body<3>& body, uint32_t a, uint32_t b, uint32_t c) noexcept;
template bool is_one_fan(const Body<3>& body, uint32_t vertex) noexcept;

}  // namespace dsw
