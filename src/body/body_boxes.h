#pragma once
// What changes of a body do to the boxes that it keeps; nothing if it keeps none. For those who change bodies.

#include "body/body.h"

namespace dsw {

/** Notes where a vertex is and all that hangs on it, but for what hangs on one that is stale: that is noted with it. */
template <int D>
void note_vertex(const Body<D>& body, uint32_t vertex) noexcept;
/** Leaves a vertex that has moved to note_stale_ones. */
template <int D>
void mark_stale(Body<D>& body, uint32_t vertex) noexcept;
template <int D>
void mark_all_stale(Body<D>& body) noexcept;
/** Throws std::bad_alloc. */
template <int D>
void reserve_boxes(Body<D>& body, BodyBoxes<D>& boxes, size_t more_vertices, size_t more_edges, size_t more_faces);

}  // namespace dsw
