#include "body/body_boxes.h"

#include <algorithm>
#include <utility>

#include "base/dimensions.h"

namespace dsw {
namespace {

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

}  // namespace

template <int D>
void note_vertex(const Body<D>& body, uint32_t vertex) noexcept {
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
void mark_all_stale(Body<D>& body) noexcept {
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
void keep_boxes(Body<D>& body) {
  BodyBoxes<D> boxes(body.vertices.get_allocator().memory);
  reserve_boxes(body, boxes, 0, 0, 0);
  body.boxes.reserve(1);
  body.boxes.push_back(std::move(boxes));
  mark_all_stale(body);
  note_stale_ones(body);
}

template <int D>
void note_stale_ones(const Body<D>& body) noexcept {
  BodyBoxes<D>& boxes = body.boxes[0];
  for (size_t i = 0; i < boxes.stale_count; ++i) {
    const uint32_t v = boxes.stale[i];
    boxes.is_stale[v] = false;
    if (body.has_vertex(v)) note_vertex(body, v);
  }
  boxes.stale_count = 0;
}

template <int D>
void tighten_bounds(Body<D>& body) noexcept {
  Box<D> bounds;
  for (uint32_t v = 0; v < body.vertices.size(); ++v) {
    if (body.has_vertex(v)) bounds.add(body.position(v));
  }
  body.boxes[0].bounds = bounds;
}

DSW_INSTANTIATE(note_vertex);
DSW_INSTANTIATE(mark_stale);
DSW_INSTANTIATE(mark_all_stale);
DSW_INSTANTIATE(reserve_boxes);
DSW_INSTANTIATE(keep_boxes);
DSW_INSTANTIATE(note_stale_ones);
DSW_INSTANTIATE(tighten_bounds);

}  // namespace dsw
