#pragma once
// The bodies of a scene: their creation, changes and moves. Functions that throw do so before they change anything.

#include <tuple>

#include "base/points.h"
#include "response/body_move.h"

namespace dsw {

template <int D>
struct Scene;

/** A body with what its last move left. */
struct BodyRecord {
  /** What stopped a vertex in the move before, to tell lasting contacts from new ones. */
  struct Stop {
    uint64_t obstacle;  // or part of another body
    uint32_t vertex, generation;
    dsw_body_id body;

    bool operator<(const Stop& other) const {
      return std::tie(vertex, generation, obstacle, body.index, body.generation) <
             std::tie(other.vertex, other.generation, other.obstacle, other.body.index, other.body.generation);
    }
  };

  Body body;
  MoveRecord record;
  MoveRecord next;           // of a move under way
  Array<BodyVertex> before;  // to go back to, if another body's move fails
  Array<Stop> stops;         // sorted
  uint64_t followed = 0;     // up to which change of the topology its sequences are true, see gone_facets.h

  explicit BodyRecord(const Memory* memory)
      : body(memory),
        record(memory),
        next(memory),
        before(Allocator<BodyVertex>(memory)),
        stops(Allocator<Stop>(memory)) {}
  uint64_t memory_bytes() const {
    return body.memory_bytes() + array_bytes(record.contacts) + array_bytes(record.partners) +
           array_bytes(record.edits) + array_bytes(next.contacts) + array_bytes(next.partners) +
           array_bytes(next.edits) + array_bytes(before) + array_bytes(stops);
  }
};

/** See dsw_body_desc. */
struct BodyDescription {
  PointArray positions;
  size_t vertex_count = 0;
  const dsw_volume_id* hints = nullptr;
  const uint32_t* edges = nullptr;
  size_t edge_count = 0;
  const uint32_t* face_offsets = nullptr;
  const uint32_t* face_corners = nullptr;
  size_t face_count = 0, face_corner_count = 0;
  SweepLevel level = SweepLevel::kEdgesSwept;
  Skipping skipping;
  ContactFilter filter;
};

dsw_body_id create_body(Scene<3>& scene, const BodyDescription& description);
/** One that is not in the scene yet, its vertices in given cells; hints are not looked at. */
BodyRecord make_body(const Scene<3>& scene, const BodyDescription& description, const Cell* cells);
/** Puts one that is free into the scene. */
dsw_body_id enter_body(Scene<3>& scene, BodyRecord&& made);
/** Lets one that is not in a scene yet have all that the scene's bodies keep. Throws std::bad_alloc. */
void prepare_body(const Scene<3>& scene, BodyRecord& of);
/** Forgets sequences that name what has changed since; comes before each use of them. O(facets of the sequences). */
void follow_changes(const Scene<3>& scene, BodyRecord& of) noexcept;
void destroy_body(Scene<3>& scene, uint32_t slot) noexcept;
/** Throws unless the id is alive. `argument` names it in messages. */
BodyRecord& check_body(Scene<3>& scene, dsw_body_id id, ArgumentName argument, size_t index = 0);
void set_level(Scene<3>& scene, Body& body, SweepLevel level);
void set_filter(Scene<3>& scene, Body& body, const ContactFilter& filter);

/** Edits of a body; each is verified free or throws OCCUPIED. Indices are alive. */
uint32_t add_body_vertex(Scene<3>& scene, BodyRecord& of, const double* position, dsw_volume_id hint);
uint32_t add_body_edge(Scene<3>& scene, Body& body, uint32_t a, uint32_t b);
uint32_t add_body_face(Scene<3>& scene, Body& body, uint32_t a, uint32_t b, uint32_t c);
void split_body_edge(Scene<3>& scene, BodyRecord& of, uint32_t edge, double share, dsw_body_edit* edit);
void collapse_body_edge(Scene<3>& scene, BodyRecord& of, uint32_t edge, uint32_t vertex, dsw_body_edit* edit);

/** Targets are finite, one for each vertex slot; `order` names distinct living vertices. */
void move_body(Scene<3>& scene, BodyRecord& body, PointArray targets, MoveOrder order, const MoveSettings& settings);
/** `reach`: no part of the motion leads out of it. */
void move_body_together(Scene<3>& scene, BodyRecord& body, PlaceFn place, const void* user, MoveOrder order,
                        const Box& reach);
/** Bodies, distinct, with their targets one after the other. */
void move_bodies(Scene<3>& scene, BodyRecord* const* bodies, size_t count, PointArray targets,
                 const MoveSettings& settings);

/** Throws if a face cannot be added; `face` is its number for the message. */
void check_face(const Body& body, size_t face, uint32_t a, uint32_t b, uint32_t c);
/** Throws OCCUPIED, and fills scene.offending, unless a body is free at a level. */
void check_free(Scene<3>& scene, const Body& body, SweepLevel level);

}  // namespace dsw
