#pragma once
// What changes of a body do to the boxes that it keeps; nothing if it keeps none. For those who change bodies.

#include "body/body.h"

namespace dsw {

/** Updates the boxes of a vertex, its edges and its faces. Those with a stale vertex are updated with that vertex. */
template <int D>
void note_vertex(const Body<D>& body, uint32_t vertex) noexcept;
template <int D>
void mark_all_stale(Body<D>& body) noexcept;
/** Throws std::bad_alloc. */
template <int D>
void reserve_boxes(Body<D>& body, BodyBoxes<D>& boxes, size_t more_vertices, size_t more_edges, size_t more_faces);

}  // namespace dsw
