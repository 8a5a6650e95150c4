#pragma once
// One move of a body: where its vertices go, in which order, and what is known of their ways if nobody meets anything.

#include "corridor/box_probe.h"
#include "motion/moving_body.h"
#include "response/settings.h"
#include "response/turn_words.h"

namespace dsw {

template <int D>
struct Course {
  /** Whether all of the cell is seen from the target, if it is not convex. */
  enum class Sight : uint8_t { kUnknown, kWhole, kPart };

  /** The turn of a vertex: small, since edges ask in no order. */
  struct Vertex {
    uint32_t rank = kNone;  // place in the order; kNone: stays
    bool doubtful = false;  // something is, or may be, met on the way
    Sight sight = Sight::kUnknown;
    bool inwards = false;  // against the normals of all faces at it
    bool meets = false;    // one of its own edges meets something on its way
  };
  static_assert(sizeof(Vertex) == 8);

  MovingBody<D> motion;
  Array<uint32_t> order;
  Array<Vertex> vertices;  // by index
  Array<bool> keeps;       // by edge, at FACES: it keeps to one corridor all through the move
  // Parts known to meet no obstacle: all of them, or those with a 1, by edge and by face.
  bool all_clear = false;
  Array<uint8_t> clear_edges, clear_faces;
  uint32_t* turn_words = nullptr;  // words_now() of ShortEdges, which put_in_doubt writes; null: nobody reads them

  explicit Course(const Memory* memory)
      : motion(memory), order(memory), vertices(memory), keeps(memory), clear_edges(memory), clear_faces(memory) {}
  /** Throws std::bad_alloc. */
  void start(Body<D>& moved, PointArray to, MoveOrder wanted);

  bool is_edge_clear(uint32_t e) const { return all_clear || (!clear_edges.empty() && clear_edges[e] != 0); }
  bool is_face_clear(uint32_t f) const { return all_clear || (!clear_faces.empty() && clear_faces[f] != 0); }
  bool moves(uint32_t v) const { return vertices[v].rank != kNone; }
  /** Where vertex v is when it is the turn of the vertex with `rank`; of kNone: at the end. */
  const double* place(uint32_t v, uint32_t rank) const {
    return vertices[v].rank < rank ? motion.targets[v] : motion.body->position(v);
  }
  Cell cell_at(uint32_t v, uint32_t rank) const {
    return vertices[v].rank < rank ? motion.ways[v].arrival : motion.ways[v].from;
  }
  /** Adds all places of a vertex on its way. */
  void include_way(uint32_t v, Bounds<D>& box) const {
    box.include(motion.body->position(v));
    if (moves(v)) box.include(motion.targets[v]);
  }
  void put_in_doubt(uint32_t v) {
    vertices[v].doubtful = true;
    if (D == 3 && turn_words != nullptr) turn_words[v] &= ~TurnWord::kSure;
  }
  void arrive(uint32_t v) const { motion.arrive(v, motion.targets[v]); }
};

}  // namespace dsw
