#pragma once
// Which bodies of a scene can meet each other, if that is enabled [JCD10] 4.4.

#include "scene/bodies.h"

namespace dsw {

/** Notes where a body is, after it has been made or has moved, if that is kept. Room has been made. */
template <int D>
void note_body(Scene<D>& scene, uint32_t slot) noexcept;
/** Notes where a body is, as note_body does, with bounds that fit the body tightly again. */
template <int D>
void refresh_body(Scene<D>& scene, BodyRecord<D>& of) noexcept;

/** A box that a body does not leave when its vertices move to their targets; `slides`: or slide on what they meet. */
template <int D>
Box<D> reach_of(const Body<D>& body, PointArray targets, MoveOrder order, bool slides) noexcept;
/** One that its bounds lie in, with some room for rounding. */
template <int D>
Box<D> reach_of(const Body<D>& body) noexcept;

/** Bodies that may be met by one that stays within reach, or come too near, itself included if it sees itself. Throws std::bad_alloc. */
template <int D>
void find_partners(const Scene<D>& scene, const Body<D>& body, const Box<D>& reach, Partners<D>& partners);

/** Finds the bodies that a body at rest may meet within a limit. The body may not be in the scene yet. */
template <int D>
void find_partners_at_rest(const Scene<D>& scene, const Body<D>& body, double limit, Partners<D>& partners);

/** Throws OCCUPIED, and fills scene.offending, unless a body is apart from others, and from itself if it sees that. */
template <int D>
void check_apart(Scene<D>& scene, const Body<D>& body, SweepLevel level);

/** Moving bodies in islands: no body of one can meet a body of another. Each island's are in their order. */
template <int D>
struct Islands {
  Array<uint32_t> bodies;       // places in the batch, island by island
  Array<uint32_t> first;        // of each island in `bodies`; one more at the end
  Array<Partners<D>> partners;  // by place; empty unless bodies meet each other

  explicit Islands(const Memory* memory) : bodies(memory), first(memory), partners(memory) {}
  size_t count() const { return first.size() - 1; }
};

/** Finds the islands of bodies that go to targets. The targets of a body follow each other and begin at its
 * first_target. Throws std::bad_alloc. */
template <int D>
void find_islands(const Scene<D>& scene, BodyRecord<D>* const* moving, size_t count, PointArray targets,
                  const size_t* first_target, bool slides, Islands<D>& islands);

/** Finds the islands of bodies that do not leave boxes, one for each. Boxes are not read in scenes in which bodies don't meet. */
template <int D>
void find_islands(const Scene<D>& scene, BodyRecord<D>* const* moving, size_t count, const Box<D>* ways,
                  Islands<D>& islands);

}  // namespace dsw
