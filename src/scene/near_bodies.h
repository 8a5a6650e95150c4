#pragma once
// The bodies of a scene that can be where something changes.

#include "body/near.h"
#include "scene/scene.h"

namespace dsw {

/** Calls visit(slot, record) for the bodies of a scene. */
template <class AnyScene, class Visit>
void for_each_body(AnyScene& scene, const Visit& visit) {
  for (uint32_t slot = 0; slot < scene.bodies.size(); ++slot) {
    if (scene.body_slots.alive(slot, scene.body_slots.generation(slot))) visit(slot, scene.bodies[slot]);
  }
}

template <int D>
class NearBodies {
 public:
  struct Near {
    uint32_t slot;
    Places<D> places;  // those it can be in
  };

  /** If the scene keeps boxes, bodies near the places; else all of them. Throws std::bad_alloc. */
  NearBodies(const Scene<D>& scene, BoxGroups<D>& places);
  NearBodies(const NearBodies&) = delete;
  NearBodies& operator=(const NearBodies&) = delete;

  /** By slot. */
  const Near* begin() const { return bodies_.data(); }
  const Near* end() const { return bodies_.data() + bodies_.size(); }
  /** The places of a body that is among these. */
  const Places<D>& places_of(uint32_t slot) const;

 private:
  Array<Box<D>> boxes_;
  Array<Near> bodies_;
};

}  // namespace dsw
