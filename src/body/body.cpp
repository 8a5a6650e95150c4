#include "body/body.h"

#include <algorithm>

#include "base/dimensions.h"
#include "base/search.h"
#include "base/vec.h"
#include "body/body_boxes.h"

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
void release_vertex(Body<D>& body, uint32_t vertex) noexcept {
  if (!body.boxes.empty()) {
    body.boxes[0].vertices.remove(vertex);
    body.boxes[0].loners.remove(vertex);
  }
  body.vertices[vertex] = BodyVertex<D>{};
  body.vertex_slots.release(vertex);
  const auto found = dsw::find(body.inserted.begin(), body.inserted.end(), vertex);
  if (found != body.inserted.end()) body.inserted.erase(found);
}

/** The length of an edge along the body is that which it has now. */
template <int D>
void measure(Body<D>& body, uint32_t e) noexcept {
  if (!body.keeps_lengths()) return;
  if (body.lengths.size() <= e) body.lengths.resize(e + 1);
  body.lengths[e] = length(difference<D>(body.position(body.edges[e].ends[1]), body.position(body.edges[e].ends[0])));
}

/** Divides the length of an edge between it and a second one, that goes on where it ends now. */
template <int D>
void divide_length(Body<D>& body, uint32_t e, uint32_t rest) noexcept {
  if (!body.keeps_lengths()) return;
  const double whole = body.lengths[e];
  measure(body, e);
  const double first = body.lengths[e], both = first + body.lengths[rest];
  body.lengths[e] = both > 0 ? whole * (first / both) : whole / 2;
  body.lengths[rest] = whole - body.lengths[e];
}

/** Drops an edge that has been joined with another: its face goes there. */
template <int D>
void join_edge(Body<D>& body, uint32_t gone, uint32_t kept) noexcept {
  for (const uint32_t f : body.edges[gone].faces) {
    if (f != kNone) attach_face(body.edges[kept], f);
  }
  body.edges[gone].faces[0] = body.edges[gone].faces[1] = kNone;
  if (body.keeps_lengths()) body.lengths[kept] = std::min(body.lengths[kept], body.lengths[gone]);
  remove_edge(body, gone);
}

}  // namespace

template <int D>
void reserve(Body<D>& body, size_t more_vertices, size_t more_edges, size_t more_faces) {
  reserve_slots(body.vertex_slots, body.vertices, more_vertices);
  reserve_slots(body.edge_slots, body.edges, more_edges);
  reserve_slots(body.face_slots, body.faces, more_faces);
  if (body.skipping.by_clearance) body.clearances.resize(body.vertices.size() + more_vertices);
  if (body.keeps_corridors()) keep_corridors(body, body.edges.size() + more_edges);
  if (body.keeps_lengths()) body.lengths.reserve(body.edges.size() + more_edges);
  if (body.skipping.leaves_back_edges) body.untested.reserve(body.edges.size() + more_edges);
  if (!body.boxes.empty()) reserve_boxes(body, body.boxes[0], more_vertices, more_edges, more_faces);
}

template <int D>
void shrink_to_fit(Body<D>& body) {
  for (SlotPool* slots : {&body.vertex_slots, &body.edge_slots, &body.face_slots}) slots->shrink_to_fit();
  body.edges.shrink_to_fit();  // faces may have found their edges
  body.untested.shrink_to_fit();
  if (!body.keeps_corridors()) return;
  body.corridors.resize(body.edges.size());
  body.corridors.shrink_to_fit();
}

template <int D>
void put_vertices(Body<D>& body, const BodyVertex<D>* from) noexcept {
  std::copy_n(from, body.vertices.size(), body.vertices.begin());
  mark_all_stale(body);
}

template <int D>
void keep_corridors(Body<D>& body, size_t edges) {
  if (body.corridors.size() < edges) body.corridors.resize(edges);
}

template <int D>
void keep_forecasts(Body<D>& body) {
  body.kept_clearances.assign(body.clearances.begin(), body.clearances.end());
  body.kept_credit = body.clearance_credit;
  body.kept_touched = body.touched.size();
  ++body.call;
}

template <int D>
void restore_forecasts(Body<D>& body) noexcept {
  for (size_t e = 0; e < body.corridors.size(); ++e) body.corridors[e].go_back(body.call);
  body.touched.erase(body.touched.begin() + static_cast<std::ptrdiff_t>(body.kept_touched), body.touched.end());
  for (TouchedLines& each : body.touched) each.go_back(body.call);
  std::copy(body.kept_clearances.begin(), body.kept_clearances.end(), body.clearances.begin());
  body.clearance_credit = body.kept_credit;
}

template <int D>
void measure_lengths(Body<D>& body) {
  body.lengths.clear();
  if (!body.keeps_lengths()) return;
  body.lengths.resize(body.edges.size());
  for (uint32_t e = 0; e < body.edges.size(); ++e) {
    if (body.has_edge(e)) measure(body, e);
  }
}

template <int D>
uint32_t add_vertex(Body<D>& body, const double* position, Cell cell) noexcept {
  BodyVertex<D> vertex;
  std::copy_n(position, D, vertex.position);
  vertex.cell = cell;
  const uint32_t v = acquire(body.vertex_slots, body.vertices, vertex);
  note_vertex(body, v);
  return v;
}

template <int D>
uint32_t add_edge(Body<D>& body, uint32_t a, uint32_t b) noexcept {
  BodyEdge edge;
  edge.ends[0] = a;
  edge.ends[1] = b;
  const uint32_t e = acquire(body.edge_slots, body.edges, edge);
  if (body.skipping.leaves_back_edges) {
    if (e == body.untested.size()) body.untested.push_back(0);
    body.untested[e] = 0;
  }
  link_edge(body, e, 0);
  link_edge(body, e, 1);
  measure(body, e);
  note_vertex(body, a);
  note_vertex(body, b);
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
  note_vertex(body, a);
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
  for (const uint32_t v : body.edges[edge].ends) note_vertex(body, v);
  body.edges[edge] = BodyEdge{};
  if (!body.untested.empty()) body.untested[edge] = 0;
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
  divide_length(body, edge, rest);
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
  note_vertex(body, middle);
  return rest;
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
  note_vertex(body, kept);
}

DSW_INSTANTIATE(reserve);
DSW_INSTANTIATE(shrink_to_fit);
DSW_INSTANTIATE(keep_corridors);
DSW_INSTANTIATE(keep_forecasts);
DSW_INSTANTIATE(restore_forecasts);
DSW_INSTANTIATE(measure_lengths);
DSW_INSTANTIATE(put_vertices);
DSW_INSTANTIATE(add_vertex);
DSW_INSTANTIATE(add_edge);
DSW_INSTANTIATE(remove_face);
DSW_INSTANTIATE(remove_edge);
DSW_INSTANTIATE(remove_vertex);
DSW_INSTANTIATE(split_edge);
DSW_INSTANTIATE(collapse_edge);
// Nothing of the plane gets faces.
template uint32_t add_face(Body<3>& body, uint32_t a, uint32_t b, uint32_t c) noexcept;

}  // namespace dsw
