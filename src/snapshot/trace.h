#pragma once
// Geometry for viewers, collected into plain arrays. Every function adds all it has or, when memory runs out, nothing.

#include "dartsweep/contact.h"
#include "environment/environment.h"
#include "query/segments.h"

namespace dsw {

/** Primitives are indices into points; each carries the label it was added with. */
struct Trace {
  Array<double> points;  // 3 each
  Array<uint32_t> vertices, vertex_labels;
  Array<uint32_t> segments, segment_labels;    // 2 indices each
  Array<uint32_t> triangles, triangle_labels;  // 3 indices each

  explicit Trace(const Memory* memory)
      : points(memory),
        vertices(memory),
        vertex_labels(memory),
        segments(memory),
        segment_labels(memory),
        triangles(memory),
        triangle_labels(memory) {}
  const Memory* memory() const { return points.get_allocator().memory; }
  size_t point_count() const { return points.size() / 3; }
};

/** Empties a trace; its memory stays. */
void clear(Trace& trace) noexcept;

/** Adds the boundary triangles of cells, counter-clockwise from outside; in the plane their sides, as they turn. */
template <int D>
void add_cells(Trace& trace, const Environment<D>& env, const Cell* cells, size_t count, uint32_t label);

/** Adds what is impassable and borders a passable cell: simplices of facets as add_cells has them, of the passable cell
 * (of the canonical one where both are); marked edges; marked vertices. */
template <int D>
void add_impassable(Trace& trace, const Environment<D>& env, bool with_boundary, uint32_t label);

/** Adds the walk of a segment, and its contact. Arguments have been checked; a walk that cannot start adds nothing. */
template <int D>
void add_walk(Trace& trace, const Environment<D>& env, dsw_volume_id start, const double* from, const double* to,
              const SegmentOptions& options, double normal_length, uint32_t label);

/** Adds a dot at a contact and a segment along its normal; nothing for a flight without. */
void add_contact(Trace& trace, const dsw_flight& flight, double normal_length, uint32_t label);

}  // namespace dsw
