#include "body/body.h"

#include "base/dimensions.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dsw {
namespace {

template <int D>
void link_edge(Body<D>& body, uint32_t e, uint32_t side) noexcept {
  BodyVertex<D>& vertex = body.vertices[body.edges[e].ends[side]];
  body.edges[e].next[side] = vertex.first_edge;
  vertex.first_edge = e;
}

template <int D>
void unlink_edge(Body<D>& body, uint32_t e, uint32_t side) noexcept {
  const uint32_t v = body.edges[e].ends[side];
  uint32_t* at = &body.vertices[v].first_edge;
  while (*at != e) {
    BodyEdge& edge = body.edges[*at];
    at = &edge.next[edge.side_of(v)];
  }
  *at = body.edges[e].next[side];
}

void attach_face(BodyEdge& edge, uint32_t face) noexcept { edge.faces[edge.faces[0] == kNone ? 0 : 1] = face; }

void replace_face(BodyEdge& edge, uint32_t from, uint32_t to) noexcept {
  edge.faces[edge.faces[0] == from ? 0 : 1] = to;
}

template <class T>
uint32_t acquire(SlotPool& slots, Array<T>& items, const T& item) noexcept {
  const uint32_t index = slots.acquire().index;
  if (index == items.size()) {
    items.push_back(item);
  } else {
    items[index] = item;
  }
  return index;
}

template <class T>
void reserve_slots(SlotPool& slots, Array<T>& items, size_t more) {
  slots.reserve(more);
  reserve_more(items, more);
}

/** Moves one end of an edge to another vertex. */
template <int D>
void move_end(Body<D>& body, uint32_t e, uint32_t from, uint32_t to) noexcept {
  const uint32_t side = body.edges[e].side_of(from);
  unlink_edge(body, e, side);
  body.edges[e].ends[side] = to;
  link_edge(body, e, side);
}

template <int D>
Box<D> box_of(const Body<D>& body, const uint32_t* vertices, int count) noexcept {
  Box<D> box;
  for (int i = 0; i < count; ++i) box.add(body.position(vertices[i]));
  return box;
}

template <int D>
double size_of(const Box<D>& box) noexcept {
  double size = 0;
  for (int k = 0; k < D; ++k) size = std::max(size, box.upper[k] - box.lower[k]);
  return size;
}

/** Notes where a vertex is and all that hangs on it, but for what hangs on one that is stale: that is noted with it. */
template <int D>
void note(const Body<D>& body, uint32_t vertex) noexcept {
  if (body.boxes.empty()) return;
  BodyBoxes<D>& boxes = body.boxes[0];
  double size = 0;
  for_each_edge(body, vertex, [&](uint32_t e) {
    const Box<D> box = box_of(body, body.edges[e].ends, 2);
    if (!boxes.is_stale[body.edges[e].other(vertex)]) boxes.edges.put(e, box);
    size = std::max(size, size_of(box));
    return true;
  });
  for_each_face(body, vertex, [&](uint32_t f) {
    const BodyFace& face = body.faces[f];
    if (boxes.is_stale[face.after(vertex)] || boxes.is_stale[face.before(vertex)]) return true;
    boxes.faces.put(f, box_of(body, face.corners, 3));
    return true;
  });
  const Box<D> box = box_of(body, &vertex, 1);
  boxes.vertices.put(vertex, box, size);
  if (body.vertices[vertex].first_edge == kNone) {
    boxes.loners.put(vertex, box);
  } else {
    boxes.loners.remove(vertex);
  }
  boxes.bounds.add(box);
}

/** Notes later where a vertex has gone. */
template <int D>
void mark_stale(Body<D>& body, uint32_t vertex) noexcept {
  if (body.boxes.empty()) return;
  BodyBoxes<D>& boxes = body.boxes[0];
  boxes.bounds.add(body.position(vertex));
  if (boxes.is_stale[vertex]) return;
  boxes.is_stale[vertex] = true;
  boxes.stale[boxes.stale_count++] = vertex;
}

template <int D>
void note_all(Body<D>& body) noexcept {
  if (body.boxes.empty()) return;
  body.boxes[0].bounds = Box<D>();
  for (uint32_t v = 0; v < body.vertices.size(); ++v) {
    if (body.has_vertex(v)) mark_stale(body, v);
  }
}

template <int D>
void reserve_boxes(Body<D>& body, BodyBoxes<D>& boxes, size_t more_vertices, size_t more_edges, size_t more_faces) {
  boxes.vertices.reserve(body.vertices.size() + more_vertices);
  boxes.loners.reserve(body.vertices.size() + more_vertices);
  boxes.edges.reserve(body.edges.size() + more_edges);
  boxes.faces.reserve(body.faces.size() + more_faces);
  const size_t vertices = std::max(boxes.is_stale.size(), body.vertices.size() + more_vertices);
  boxes.stale.resize(vertices);
  boxes.is_stale.resize(vertices);
}

template <int D>
void release_vertex(Body<D>& body, uint32_t vertex) noexcept {
  if (!body.boxes.empty()) {
    body.boxes[0].vertices.remove(vertex);
    body.boxes[0].loners.remove(vertex);
  }
  body.vertices[vertex] = BodyVertex<D>{};
  body.vertex_slots.release(vertex);
  const auto found = std::find(body.inserted.begin(), body.inserted.end(), vertex);
  if (found != body.inserted.end()) body.inserted.erase(found);
}

/** Drops an edge that has been joined with another: its face goes there. */
template <int D>
void join_edge(Body<D>& body, uint32_t gone, uint32_t kept) noexcept {
  for (const uint32_t f : body.edges[gone].faces) {
    if (f != kNone) attach_face(body.edges[kept], f);
  }
  body.edges[gone].faces[0] = body.edges[gone].faces[1] = kNone;
  remove_edge(body, gone);
}

}  // namespace

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
    if (std::find(face.corners, face.corners + 3, c) != face.corners + 3) return f;
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

template <int D>
void reserve(Body<D>& body, size_t more_vertices, size_t more_edges, size_t more_faces) {
  reserve_slots(body.vertex_slots, body.vertices, more_vertices);
  reserve_slots(body.edge_slots, body.edges, more_edges);
  reserve_slots(body.face_slots, body.faces, more_faces);
  if (body.skipping.by_clearance) body.clearances.resize(body.vertices.size() + more_vertices);
  if (body.keeps_sequences()) keep_sequences(body, body.edges.size() + more_edges);
  if (!body.boxes.empty()) reserve_boxes(body, body.boxes[0], more_vertices, more_edges, more_faces);
}

template <int D>
void keep_boxes(Body<D>& body) {
  BodyBoxes<D> boxes(body.vertices.get_allocator().memory);
  reserve_boxes(body, boxes, 0, 0, 0);
  body.boxes.reserve(1);
  body.boxes.push_back(std::move(boxes));
  note_all(body);
  note_stale_ones(body);
}

template <int D>
void note_stale_ones(const Body<D>& body) noexcept {
  BodyBoxes<D>& boxes = body.boxes[0];
  for (size_t i = 0; i < boxes.stale_count; ++i) {
    const uint32_t v = boxes.stale[i];
    boxes.is_stale[v] = false;
    if (body.has_vertex(v)) note(body, v);
  }
  boxes.stale_count = 0;
}

bool is_closed_surface(const Body<3>& body) noexcept {
  for (uint32_t v = 0; v < body.vertices.size(); ++v) {
    if (body.has_vertex(v) && body.vertices[v].first_edge == kNone) return false;
  }
  return std::none_of(body.edges.begin(), body.edges.end(), [](const BodyEdge& e) {
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
void tighten_bounds(Body<D>& body) noexcept {
  Box<D> bounds;
  for (uint32_t v = 0; v < body.vertices.size(); ++v) {
    if (body.has_vertex(v)) bounds.add(body.position(v));
  }
  body.boxes[0].bounds = bounds;
}

template <int D>
void put_vertex(Body<D>& body, uint32_t vertex, const double* position, Cell cell) noexcept {
  std::copy_n(position, D, body.vertices[vertex].position);
  body.vertices[vertex].cell = cell;
  mark_stale(body, vertex);
}

template <int D>
void put_vertices(Body<D>& body, const BodyVertex<D>* from) noexcept {
  std::copy_n(from, body.vertices.size(), body.vertices.begin());
  note_all(body);
}

template <int D>
void keep_sequences(Body<D>& body, size_t edges) {
  if (body.sequences.size() < edges) body.sequences.resize(edges, EdgeSequence<D>(body.edges.get_allocator()));
}

template <int D>
uint32_t add_vertex(Body<D>& body, const double* position, Cell cell) noexcept {
  BodyVertex<D> vertex;
  std::copy_n(position, D, vertex.position);
  vertex.cell = cell;
  const uint32_t v = acquire(body.vertex_slots, body.vertices, vertex);
  note(body, v);
  return v;
}

template <int D>
uint32_t add_edge(Body<D>& body, uint32_t a, uint32_t b) noexcept {
  BodyEdge edge;
  edge.ends[0] = a;
  edge.ends[1] = b;
  const uint32_t e = acquire(body.edge_slots, body.edges, edge);
  link_edge(body, e, 0);
  link_edge(body, e, 1);
  note(body, a);
  note(body, b);
  return e;
}

template <int D>
uint32_t add_face(Body<D>& body, uint32_t a, uint32_t b, uint32_t c) noexcept {
  BodyFace face;
  face.corners[0] = a;
  face.corners[1] = b;
  face.corners[2] = c;
  const uint32_t f = acquire(body.face_slots, body.faces, face);
  for (int k = 0; k < 3; ++k) {
    const uint32_t from = face.corners[k], to = face.corners[(k + 1) % 3], e = find_edge(body, from, to);
    attach_face(body.edges[e != kNone ? e : add_edge(body, from, to)], f);
  }
  note(body, a);
  return f;
}

template <int D>
void remove_face(Body<D>& body, uint32_t face) noexcept {
  BodyFace& gone = body.faces[face];
  for (int k = 0; k < 3; ++k) {
    replace_face(body.edges[find_edge(body, gone.corners[k], gone.corners[(k + 1) % 3])], face, kNone);
  }
  gone = BodyFace{};
  if (!body.boxes.empty()) body.boxes[0].faces.remove(face);
  body.face_slots.release(face);
}

template <int D>
void remove_edge(Body<D>& body, uint32_t edge) noexcept {
  for (int k = 0; k < 2; ++k) {
    if (body.edges[edge].faces[k] != kNone) remove_face(body, body.edges[edge].faces[k]);
  }
  unlink_edge(body, edge, 0);
  unlink_edge(body, edge, 1);
  if (!body.boxes.empty()) body.boxes[0].edges.remove(edge);
  for (const uint32_t v : body.edges[edge].ends) note(body, v);
  body.edges[edge] = BodyEdge{};
  body.edge_slots.release(edge);
}

template <int D>
void remove_vertex(Body<D>& body, uint32_t vertex) noexcept {
  while (body.vertices[vertex].first_edge != kNone) remove_edge(body, body.vertices[vertex].first_edge);
  release_vertex(body, vertex);
}

template <int D>
uint32_t split_edge(Body<D>& body, uint32_t edge, uint32_t middle) noexcept {
  const uint32_t from = body.edges[edge].ends[0], to = body.edges[edge].ends[1];
  const uint32_t faces[2] = {body.edges[edge].faces[0], body.edges[edge].faces[1]};
  unlink_edge(body, edge, 1);
  body.edges[edge].ends[1] = middle;
  link_edge(body, edge, 1);
  const uint32_t rest = add_edge(body, middle, to);
  for (const uint32_t f : faces) {
    if (f == kNone) continue;
    BodyFace& face = body.faces[f];
    const uint32_t place = face.place_of(to), far = face.after(from) == to ? face.after(to) : face.before(to);
    BodyFace second = face;
    second.corners[second.place_of(from)] = middle;
    face.corners[place] = middle;
    const uint32_t between = add_edge(body, middle, far), g = acquire(body.face_slots, body.faces, second);
    replace_face(body.edges[find_edge(body, to, far)], f, g);
    attach_face(body.edges[rest], g);
    attach_face(body.edges[between], f);
    attach_face(body.edges[between], g);
  }
  note(body, middle);
  return rest;
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

template <int D>
void collapse_edge(Body<D>& body, uint32_t edge, uint32_t vertex) noexcept {
  const uint32_t kept = body.edges[edge].other(vertex);
  remove_edge(body, edge);
  while (body.vertices[vertex].first_edge != kNone) {
    const uint32_t e = body.vertices[vertex].first_edge;
    const uint32_t far = body.edges[e].other(vertex), twin = find_edge(body, kept, far);
    for (const uint32_t f : body.edges[e].faces) {
      if (f == kNone) continue;
      BodyFace& face = body.faces[f];
      const uint32_t place = face.place_of(vertex);
      if (face.corners[place] == vertex) face.corners[place] = kept;
    }
    if (twin == kNone) {
      move_end(body, e, vertex, kept);
    } else {
      join_edge(body, e, twin);
    }
  }
  release_vertex(body, vertex);
  note(body, kept);
}

DSW_INSTANTIATE(find_edge);
DSW_INSTANTIATE(reserve);
DSW_INSTANTIATE(keep_sequences);
DSW_INSTANTIATE(keep_boxes);
DSW_INSTANTIATE(note_stale_ones);
DSW_INSTANTIATE(tighten_bounds);
DSW_INSTANTIATE(put_vertex);
DSW_INSTANTIATE(put_vertices);
DSW_INSTANTIATE(add_vertex);
DSW_INSTANTIATE(add_edge);
DSW_INSTANTIATE(remove_face);
DSW_INSTANTIATE(remove_edge);
DSW_INSTANTIATE(remove_vertex);
DSW_INSTANTIATE(split_edge);
DSW_INSTANTIATE(can_collapse);
DSW_INSTANTIATE(collapse_edge);
// Nothing of the plane gets faces.
template uint32_t find_face(const Body<3>& body, uint32_t a, uint32_t b, uint32_t c) noexcept;
template FaceDefect face_defect(const Body<3>& body, uint32_t a, uint32_t b, uint32_t c) noexcept;
template bool starts_fan(const Body<3>& body, uint32_t a, uint32_t b, uint32_t c) noexcept;
template bool is_one_fan(const Body<3>& body, uint32_t vertex) noexcept;
template uint32_t add_face(Body<3>& body, uint32_t a, uint32_t b, uint32_t c) noexcept;

}  // namespace dsw
