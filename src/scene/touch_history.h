#pragma once
// What a body's vertices have touched from move to move [JCD10] 3.1: tells contacts that last, slide or bounce.

#include "base/slot_pool.h"
#include "response/settings.h"

namespace dsw {

/** Where a vertex was stopped last. */
struct LastTouch {
  double point[3], normal[3];
  uint64_t move;  // its number
  dsw_cell obstacle;
  dsw_body_id body;
  dsw_body_vertex_id vertex;
};

class TouchHistory {
 public:
  explicit TouchHistory(const Memory* memory) : earlier(memory), stops_(memory), later_(memory) {}

  /** Before a move: makes room for follow(). `last` is what the move before has left. Throws
   * std::bad_alloc. */
  void prepare(const MoveRecord& last);
  /** After it: fills in the history and the previous of its contacts, and remembers those of the
   * move before. O(vertices that have touched anything). */
  void follow(const MoveRecord& last, MoveRecord& next, const SlotPool& vertices) noexcept;

  uint64_t memory_bytes() const noexcept { return array_bytes(earlier) + array_bytes(stops_) + array_bytes(later_); }

  uint64_t moves = 0;        // that have been followed
  Array<LastTouch> earlier;  // before the last move, by index of the vertex; that one is in its record

 private:
  /** A contact of the move before, by its vertex. */
  struct Stop {
    dsw_body_vertex_id vertex;
    uint64_t obstacle;  // or part of another body
    dsw_body_id body;
    uint32_t contact;  // its place

    bool operator<(const Stop& other) const noexcept;
  };
  static Stop to_stop(const MoveRecord& record, uint32_t contact) noexcept;
  const Stop* find_last(const Stop& wanted, bool same_obstacle) const noexcept;

  Array<Stop> stops_;  // sorted
  Array<LastTouch> later_;
};

}  // namespace dsw
