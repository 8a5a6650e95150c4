#pragma once
// Whose turn it was in a move of a body, and who may go on in a further pass.

#include "body/body.h"
#include "response/settings.h"

namespace dsw {

/** The turns of vertices in one move, counted from 1. A vertex has stopped where it was pressed against something; it
 * may go on if it has moved since, or a vertex that its edges join, or, of bodies that meet bodies, any vertex. */
template <int D>
class Turns {
 public:
  explicit Turns(const Memory* memory) : last_(memory), stopped_(memory), waiting_(memory) {}

  /** Throws std::bad_alloc. */
  void start(const Body<D>& body);
  /** The turn of a vertex that was at `before`. Vertices that its edits inserted have moved in it. Throws
   * std::bad_alloc.
   * @param may_go_on it has stopped, and not at a work limit. */
  void note(const Body<D>& body, uint32_t v, const double* before, bool may_go_on, const dsw_body_edit* edits = nullptr,
            size_t edit_count = 0);

  /** Starts a pass over the vertices that have stopped, in the opposite order of the pass before. False: none of them
   * may go on. */
  bool start_pass(const Body<D>& body, bool meets_bodies);
  /** The vertices of this pass. */
  const Array<uint32_t>& waiting() const { return waiting_; }
  bool may_go_on(const Body<D>& body, uint32_t v, bool meets_bodies) const;
  /** Vertex v has not had its turn in this pass, and may have one in the next. Throws std::bad_alloc. */
  void leave(uint32_t v) { stopped_.push_back(v); }

 private:
  struct Turn {
    uint32_t tried = 0, moved = 0;  // the last one in which it was to move, in which it did
  };

  uint32_t now_ = 0, last_move_ = 0;
  Array<Turn> last_;  // by vertex
  Array<uint32_t> stopped_, waiting_;
};

/** Leaves, of contacts of the same parts of the body with the same obstacle, the last one. Throws std::bad_alloc. */
void drop_repeated(MoveRecord& record);

}  // namespace dsw
