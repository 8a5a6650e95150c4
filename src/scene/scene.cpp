#include "scene/scene.h"

#include "base/dimensions.h"
#include "response/body_move.h"
#include "response/turning_move.h"
#include "scene/deformation.h"
#include "scene/live_register.h"
#include "together/together_move.h"
#include "together/turning_together.h"

namespace dsw {

template <int D>
Scene<D>::Scene(const Environment<D>& environment, const Memory* source, const Parallel& sharing, SceneFeatures wanted)
    : env(environment), memory(source), parallel(sharing), features(wanted) {
  if (features.live) live.make(source);
  if (features.crossings) crossing_first.push_back(0);
}

template <int D>
Scene<D>::~Scene() = default;

template <int D>
uint64_t Scene<D>::memory_bytes() const {
  uint64_t of_bodies = array_bytes(bodies) + (mover.get() != nullptr ? sizeof(BodyMove<D>) : 0) +
                       (turning.get() != nullptr ? sizeof(TurningMove<D>) : 0) +
                       (turning_together.get() != nullptr ? sizeof(TurningTogether<D>) : 0) +
                       (together.get() != nullptr ? sizeof(TogetherMove<D>) : 0) + body_slots.memory_bytes() +
                       body_boxes.memory_bytes() + array_bytes(offending);
  for (const BodyRecord<D>& each : bodies) of_bodies += each.memory_bytes();
  if (deformation.get() != nullptr) of_bodies += deformation.get()->memory_bytes();
  if (live.get() != nullptr) of_bodies += live.get()->memory_bytes();
  return sizeof(*this) + array_bytes(particles) + slots.memory_bytes() + array_bytes(stamps) +
         array_bytes(chunk_statistics) + array_bytes(crossings) + array_bytes(crossing_first) + array_bytes(occupants) +
         array_bytes(occupant_bodies) + array_bytes(exits) + array_bytes(body_cuts) + of_bodies;
}

template <int D>
void note_particle(Scene<D>& scene, uint32_t slot) noexcept {
  if (scene.features.live) scene.live.get()->particles.put(slot, scene.particles[slot].cell);
}

template struct Scene<2>;
template struct Scene<3>;
DSW_INSTANTIATE(note_particle);

}  // namespace dsw
