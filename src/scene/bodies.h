#pragma once
// The bodies of a scene: their creation, changes and moves. Functions that throw do so before they change anything.

#include "base/points.h"
#include "response/settings.h"
#include "scene/near_rows.h"
#include "scene/touch_history.h"

namespace dsw {

template <int D>
class BodyMove;

template <int D>
struct Scene;

/** A body with what its last move left. */
template <int D>
struct BodyRecord {
  Body<D> body;
  MoveRecord record;
  MoveRecord next;              // of a move under way
  Array<BodyVertex<D>> before;  // to go back to, if another body's move fails
  TouchHistory touches;
  Array<NearRecord<D>> near;   // one, if near rows have been asked for; else none
  NearNotes<D> kept_near;      // what is near its parts; see NearNotes
  Array<Body<D>> penetrating;  // one, while it penetrates something: `body` has no parts then, so that nothing meets it
  uint64_t followed = 0;       // up to which change of the topology its corridors are true, see gone_facets.h

  explicit BodyRecord(const Memory* memory)
      : body(memory),
        record(memory),
        next(memory),
        before(memory),
        touches(memory),
        near(memory),
        kept_near(memory),
        penetrating(memory) {}
  bool is_penetrating() const { return !penetrating.empty(); }
  /** What a host reads. */
  Body<D>& told() { return is_penetrating() ? penetrating[0] : body; }
  const Body<D>& told() const { return is_penetrating() ? penetrating[0] : body; }
  uint64_t memory_bytes() const {
    uint64_t of_near = 0;
    for (const NearRecord<D>& each : near) of_near += each.memory_bytes();
    for (const Body<D>& each : penetrating) of_near += sizeof each + each.memory_bytes();
    return of_near + kept_near.memory_bytes() + body.memory_bytes() + array_bytes(record.contacts) +
           array_bytes(record.partners) + array_bytes(record.previous) + array_bytes(record.edits) +
           array_bytes(record.exits) + array_bytes(next.exits) + array_bytes(next.contacts) +
           array_bytes(next.partners) + array_bytes(next.previous) + array_bytes(next.edits) + array_bytes(before) +
           touches.memory_bytes();
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
  bool rigid = false;          // walls move it as a whole
  bool may_penetrate = false;  // it need not be free
  double radius = 0;
};

template <int D>
dsw_body_id create_body(Scene<D>& scene, const BodyDescription& description);
/** One that is not in the scene yet, its vertices in given cells; hints are not looked at. */
template <int D>
BodyRecord<D> make_body(const Scene<D>& scene, const BodyDescription& description, const Cell* cells);
/** Puts one that is free into the scene. */
template <int D>
dsw_body_id enter_body(Scene<D>& scene, BodyRecord<D>&& made);
/** Lets one that is not in a scene yet have all that the scene's bodies keep. Throws std::bad_alloc. */
template <int D>
void prepare_body(const Scene<D>& scene, BodyRecord<D>& of);
/** Forgets corridors that name what has changed since; comes before each use of them. O(facets of the corridors). */
template <int D>
void follow_changes(const Scene<D>& scene, BodyRecord<D>& of) noexcept;
template <int D>
void destroy_body(Scene<D>& scene, uint32_t slot) noexcept;
/** Throws unless the id is alive. `argument` names it in messages. */
template <int D>
BodyRecord<D>& check_body_id(Scene<D>& scene, dsw_body_id id, ArgumentName argument, size_t index = 0);
/** Throws unless the id is alive and the body does not penetrate anything. */
template <int D>
BodyRecord<D>& check_body(Scene<D>& scene, dsw_body_id id, ArgumentName argument, size_t index = 0);
template <int D>
void set_level(Scene<D>& scene, Body<D>& body, SweepLevel level);
template <int D>
void set_filter(Scene<D>& scene, Body<D>& body, const ContactFilter& filter);
template <int D>
uint32_t add_body_vertex(Scene<D>& scene, BodyRecord<D>& of, const double* position, dsw_volume_id hint);
template <int D>
uint32_t add_body_edge(Scene<D>& scene, Body<D>& body, uint32_t a, uint32_t b);
template <int D>
uint32_t add_body_face(Scene<D>& scene, Body<D>& body, uint32_t a, uint32_t b, uint32_t c);
template <int D>
void remove_body_edge(Scene<D>& scene, Body<D>& body, uint32_t edge);
template <int D>
void remove_body_vertex(Scene<D>& scene, Body<D>& body, uint32_t vertex);
template <int D>
void split_body_edge(Scene<D>& scene, BodyRecord<D>& of, uint32_t edge, double share, dsw_body_edit* edit);
template <int D>
void collapse_body_edge(Scene<D>& scene, BodyRecord<D>& of, uint32_t edge, uint32_t vertex, dsw_body_edit* edit);

/** Before a move that can fail after some vertices have moved: `before` is what put_vertices takes. Throws
 * std::bad_alloc. */
template <int D>
void begin_move(const Scene<D>& scene, BodyRecord<D>& of);
/** The engine of moves of single bodies. */
template <int D>
BodyMove<D>& mover_of(Scene<D>& scene);
/** What a move has left becomes what the host reads; `casts` and contacts are counted. */
template <int D>
void end_move(Scene<D>& scene, BodyRecord<D>& of, const CastCounters& casts) noexcept;

/** Targets are finite, one for each vertex slot; `order` names distinct living vertices. */
template <int D>
void move_body(Scene<D>& scene, BodyRecord<D>& body, PointArray targets, MoveOrder order, const MoveSettings& settings);
/** Bodies, distinct, with their targets one after the other. */
template <int D>
void move_bodies(Scene<D>& scene, BodyRecord<D>* const* bodies, size_t count, PointArray targets,
                 const MoveSettings& settings);

/** Throws if a face cannot be added; `face` is its number for the message. */
template <int D>
void check_face(const Body<D>& body, size_t face, uint32_t a, uint32_t b, uint32_t c);
/** Throws OCCUPIED, and fills scene.offending, unless a body is free at a level. */
template <int D>
void check_free(Scene<D>& scene, const Body<D>& body, SweepLevel level);

}  // namespace dsw
