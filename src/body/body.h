#pragma once
// A body: vertices joined by edges and triangles, a manifold where it is a surface. Its topology and where its vertices
// are; knows nothing of what is free.

#include <cstdint>

#include "base/slot_pool.h"
#include "body/box_grid.h"
#include "body/rigid_shape.h"
#include "corridor/clearance.h"
#include "corridor/corridors.h"
#include "corridor/touched_lines.h"

namespace dsw {

constexpr uint32_t kNone = 0xffffffffu;

/** What of a body is free [JCD10] 4.1; vertices always are, where they are and on their way. */
enum class SweepLevel : uint32_t { kPoints, kEdges, kEdgesSwept, kFaces };
inline bool covers_edges(SweepLevel level) { return level >= SweepLevel::kEdges; }
inline bool sweeps_edges(SweepLevel level) { return level >= SweepLevel::kEdgesSwept; }  // on their way, too
inline bool covers_faces(SweepLevel level) { return level == SweepLevel::kFaces; }

/** Two to a cache line in space. */
template <int D>
struct BodyVertex {
  double position[D] = {};
  Cell cell;                    // contains the position under the shift, passable; invalid in a free slot
  uint32_t first_edge = kNone;  // start of the list through BodyEdge::next
};
static_assert(sizeof(BodyVertex<3>) == 32 && sizeof(BodyVertex<2>) == 24);

struct BodyEdge {
  uint32_t ends[2] = {kNone, kNone};  // kNone in a free slot
  uint32_t next[2] = {kNone, kNone};  // the next edge at ends[k]
  uint32_t faces[2] = {kNone, kNone};

  uint32_t side_of(uint32_t vertex) const { return ends[0] == vertex ? 0 : 1; }
  uint32_t other(uint32_t vertex) const { return ends[0] == vertex ? ends[1] : ends[0]; }
};

struct BodyFace {
  uint32_t corners[3] = {kNone, kNone, kNone};  // kNone in a free slot

  uint32_t place_of(uint32_t vertex) const { return corners[0] == vertex ? 0 : corners[1] == vertex ? 1 : 2; }
  uint32_t after(uint32_t vertex) const { return corners[(place_of(vertex) + 1) % 3]; }
  uint32_t before(uint32_t vertex) const { return corners[(place_of(vertex) + 2) % 3]; }
};

/** What of the sweeps of a body's edges may be left out; see DSW_BODY_... */
struct Skipping {
  bool corridors = false, no_corridors = false, by_environment = false, by_clearance = false;
  bool back_edges = false, by_similar_motion = false;  // at EDGES
  bool leaves_back_edges = false;                      // with back_edges: they are not tested where they arrive
  double motion_share = 0.1;
};

/** Which bodies see each other: each one's category must be in the other's mask. */
struct ContactFilter {
  uint32_t category = 1, mask = 0xffffffffu;
  bool self = false;  // whether the body sees itself

  bool sees(const ContactFilter& other) const { return (category & other.mask) != 0 && (other.category & mask) != 0; }
};

/** Where the parts of a body are, to find those that are near. All are noted, whatever the level. */
template <int D>
struct BodyBoxes {
  BoxGrid<D> vertices, loners, edges, faces;  // loners: vertices without edges
  Box<D> bounds;                              // of all; may be too large
  // Vertices that have moved since they were noted, and by vertex whether it is one of them; see fresh_boxes.
  Array<uint32_t> stale;  // the first stale_count
  Array<bool> is_stale;
  size_t stale_count = 0;

  explicit BodyBoxes(const Memory* memory)
      : vertices(memory), loners(memory), edges(memory), faces(memory), stale(memory), is_stale(memory) {}
  uint64_t memory_bytes() const {
    return vertices.memory_bytes() + loners.memory_bytes() + edges.memory_bytes() + faces.memory_bytes() +
           array_bytes(stale) + array_bytes(is_stale);
  }
};

template <int D>
struct Body {
  Array<BodyVertex<D>> vertices;
  Array<BodyEdge> edges;
  Array<BodyFace> faces;
  SlotPool vertex_slots, edge_slots, face_slots;
  Array<uint32_t> inserted;  // vertices that a response has inserted
  // By edge, if they are kept: the facets passed from ends[0] to ends[1], see corridor/corridor.h. A forecast.
  mutable Corridors<D> corridors;
  // By edge and end, once an edge has touched something: what it touched. A forecast.
  mutable Array<TouchedLines> touched;
  Array<Clearance<D>> clearances;  // by vertex, if they are kept
  int64_t clearance_credit = 0;    // what measuring them may cost, see sweep/clearance.h
  // What restore_forecasts needs of the call that began last.
  uint64_t call = 0;  // its number
  size_t kept_touched = 0;
  Array<Clearance<D>> kept_clearances;
  int64_t kept_credit = 0;
  // One, if bodies meet each other; else none. Moves note in it when it is asked: read it through fresh_boxes.
  mutable Array<BodyBoxes<D>> boxes;
  Array<RigidShape<D>> shape;  // one, if walls move the body as a whole; else none
  ContactFilter filter;
  double radius = 0;
  Array<double> lengths;    // by edge, if they are kept: when the radius was set; see proximity/joined.h
  Array<uint8_t> untested;  // by edge, if back edges are left: 1: it may not be free where it is; see scene/untested.h
  SweepLevel level = SweepLevel::kEdgesSwept;
  bool hides_edges = false;  // while a call sees its vertices alone; see scene/untested.h
  Skipping skipping;

  explicit Body(const Memory* memory)
      : vertices(memory),
        edges(memory),
        faces(memory),
        vertex_slots(memory),
        edge_slots(memory),
        face_slots(memory),
        inserted(memory),
        corridors(memory),
        touched(memory),
        clearances(memory),
        kept_clearances(memory),
        boxes(memory),
        shape(memory),
        lengths(memory),
        untested(memory) {}

  bool is_rigid() const { return !shape.empty(); }
  bool keeps_lengths() const { return radius > 0 && filter.self; }
  bool keeps_corridors() const { return skipping.corridors || (sweeps_edges(level) && !skipping.no_corridors); }
  bool has_vertex(uint32_t v) const { return v < vertices.size() && vertices[v].cell.valid(); }
  bool has_edge(uint32_t e) const { return e < edges.size() && edges[e].ends[0] != kNone; }
  bool has_face(uint32_t f) const { return f < faces.size() && faces[f].corners[0] != kNone; }
  const double* position(uint32_t v) const { return vertices[v].position; }
  bool is_untested(uint32_t e) const { return !untested.empty() && untested[e] == 1; }
  uint64_t memory_bytes() const {
    uint64_t of_parts = corridors.memory_bytes();
    for (const BodyBoxes<D>& each : boxes) of_parts += sizeof each + each.memory_bytes();
    for (const RigidShape<D>& each : shape) of_parts += sizeof each + each.memory_bytes();
    return of_parts + array_bytes(touched) + array_bytes(clearances) + array_bytes(kept_clearances) +
           array_bytes(vertices) + array_bytes(edges) + array_bytes(faces) + array_bytes(inserted) +
           array_bytes(lengths) + array_bytes(untested) + vertex_slots.memory_bytes() + edge_slots.memory_bytes() +
           face_slots.memory_bytes();
  }
};

/** Calls visit(edge) for the edges at a vertex; stops when it returns false. */
template <int D, class Visit>
void for_each_edge(const Body<D>& body, uint32_t vertex, Visit visit) {
  for (uint32_t e = body.vertices[vertex].first_edge; e != kNone;) {
    const BodyEdge& edge = body.edges[e];
    const uint32_t next = edge.next[edge.side_of(vertex)];
    if (!visit(e)) return;
    e = next;
  }
}

/** Calls visit(face) for the faces at a vertex, each once; stops when it returns false. */
template <int D, class Visit>
void for_each_face(const Body<D>& body, uint32_t vertex, Visit visit) {
  for_each_edge(body, vertex, [&](uint32_t e) {
    const BodyEdge edge = body.edges[e];
    for (const uint32_t f : edge.faces) {
      if (f != kNone && body.faces[f].after(vertex) == edge.other(vertex) && !visit(f)) return false;
    }
    return true;
  });
}

/** The edge between two vertices, or kNone. O(edges at a). */
template <int D>
uint32_t find_edge(const Body<D>& body, uint32_t a, uint32_t b) noexcept;
/** The face with these corners in any order, or kNone. */
template <int D>
uint32_t find_face(const Body<D>& body, uint32_t a, uint32_t b, uint32_t c) noexcept;

/** Why a face can't be added. */
enum class FaceDefect { kFine, kRepeated, kThirdFace, kTurned };
/** Corners are distinct living vertices. */
template <int D>
FaceDefect face_defect(const Body<D>& body, uint32_t a, uint32_t b, uint32_t c) noexcept;
/** Whether a triangle would touch those at one of its corners in the vertex alone. */
template <int D>
bool starts_fan(const Body<D>& body, uint32_t a, uint32_t b, uint32_t c) noexcept;
/** Whether the triangles at a vertex form at most one fan. */
template <int D>
bool is_one_fan(const Body<D>& body, uint32_t vertex) noexcept;

/** Whether every edge has two faces and every vertex has edges. */
bool is_closed_surface(const Body<3>& body) noexcept;
/** Whether the volume that the faces of a closed surface hold is positive, in doubles. */
bool is_turned_outwards(const Body<3>& body) noexcept;

/** Makes room for so many more: the functions below then neither throw nor fail. */
template <int D>
void reserve(Body<D>& body, size_t more_vertices, size_t more_edges, size_t more_faces);
/** Makes room for removing parts: the functions below then do not fail. `reserve` makes it, too. Throws std::bad_alloc. */
template <int D>
void reserve_removals(Body<D>& body) {
  for (SlotPool* slots : {&body.vertex_slots, &body.edge_slots, &body.face_slots}) slots->reserve(0);
}
/** Gives back room after a body has been made. Throws std::bad_alloc. */
template <int D>
void shrink_to_fit(Body<D>& body);
/** Gives every edge room for its corridor, after the level has been raised. */
template <int D>
void keep_corridors(Body<D>& body, size_t edges);
/** A call begins that may change what is remembered from move to move. Throws std::bad_alloc. */
template <int D>
void keep_forecasts(Body<D>& body);
/** The call has failed: what is remembered is what it was. The body has the parts that it had. */
template <int D>
void restore_forecasts(Body<D>& body) noexcept;
/** Lets edges have the lengths that they have now, if lengths are kept. */
template <int D>
void measure_lengths(Body<D>& body);
/** Starts to keep boxes. Throws std::bad_alloc before it changes anything. */
template <int D>
void keep_boxes(Body<D>& body);

template <int D>
void note_stale_ones(const Body<D>& body) noexcept;
/** The boxes, which are kept, with all vertices noted where they are. Writes if some have moved since then: before a
 * body is read by several threads, one calls it. */
template <int D>
const BodyBoxes<D>& fresh_boxes(const Body<D>& body) noexcept {
  if (body.boxes[0].stale_count != 0) note_stale_ones(body);
  return body.boxes[0];
}

/** Lets the bounds of kept boxes fit again. */
template <int D>
void tighten_bounds(Body<D>& body) noexcept;

/** Leaves the boxes of a vertex that has moved to note_stale_ones, if boxes are kept. */
template <int D>
void mark_stale(Body<D>& body, uint32_t vertex) noexcept;
/** Moves a vertex. */
template <int D>
void put_vertex(Body<D>& body, uint32_t vertex, const double* position, Cell cell) noexcept {
  BodyVertex<D>& moved = body.vertices[vertex];
  for (int k = 0; k < D; ++k) moved.position[k] = position[k];
  moved.cell = cell;
  if (!body.boxes.empty()) mark_stale(body, vertex);
}
/** Moves all vertices to where they were. */
template <int D>
void put_vertices(Body<D>& body, const BodyVertex<D>* from) noexcept;
template <int D>
uint32_t add_vertex(Body<D>& body, const double* position, Cell cell) noexcept;
template <int D>
uint32_t add_edge(Body<D>& body, uint32_t a, uint32_t b) noexcept;
/** With the edges that are missing: room for three. */
template <int D>
uint32_t add_face(Body<D>& body, uint32_t a, uint32_t b, uint32_t c) noexcept;

template <int D>
void remove_face(Body<D>& body, uint32_t face) noexcept;
/** With its faces. */
template <int D>
void remove_edge(Body<D>& body, uint32_t edge) noexcept;
/** With its edges and faces. */
template <int D>
void remove_vertex(Body<D>& body, uint32_t vertex) noexcept;

/** Puts `middle`, a vertex without edges, on an edge: the edge keeps ends[0], a new one goes on to ends[1], every face
 * at it is cut in two (and keeps the part at ends[0]). Room: 1 + its faces edges, its faces. Returns the new edge. */
template <int D>
uint32_t split_edge(Body<D>& body, uint32_t edge, uint32_t middle) noexcept;

/** Whether merging `vertex` into the other end of `edge` leaves a manifold (link condition) without repeated edges. */
template <int D>
bool can_collapse(const Body<D>& body, uint32_t edge, uint32_t vertex) noexcept;
/** Merges `vertex` into the other end of `edge`. Edges and faces of `vertex` now end there; the faces at `edge` are
 * gone. */
template <int D>
void collapse_edge(Body<D>& body, uint32_t edge, uint32_t vertex) noexcept;

}  // namespace dsw
