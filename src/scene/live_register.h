#pragma once
// Who is where, kept from change to change of the environment.

#include "scene/cell_particles.h"
#include "scene/gone_facets.h"

namespace dsw {

/** What a scene keeps beside the boxes of its bodies to find who is where the environment changes. */
template <int D>
struct LiveRegister {
  CellParticles particles;
  GoneFacets<D> gone;

  explicit LiveRegister(const Memory* memory) : particles(memory), gone(memory) {}
  uint64_t memory_bytes() const { return sizeof(*this) + particles.memory_bytes() + gone.memory_bytes(); }
};

}  // namespace dsw
