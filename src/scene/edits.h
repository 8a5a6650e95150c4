#pragma once
// Changes of the topology while a scene lives in the environment: its particles and bodies follow.

#include "scene/scene.h"
#include "topology/edit.h"

namespace dsw {

/** Carries an edit out. `scene` is the only one that uses the environment, or null. Particles and vertices of bodies in
 * cells that go get those new cells that contain them. Throws OCCUPIED, and leaves in the scene who is in the way,
 * unless all of them are in passable cells then and all bodies are free; and what prepare() throws. Then nothing has
 * changed. O(what changes + particles and size of the bodies; what of them is near if the scene keeps that). */
template <int D>
void carry_out(Edit<D>& edit, Scene<D>* scene);
/** Carries out, as carry_out does, an edit that is already prepared. */
template <int D>
void carry_out_prepared(Edit<D>& edit, Scene<D>* scene);

/** What is done in the changed environment while the change can be taken back, as it is if this is false or throws. */
struct Meanwhile {
  bool (*run)(void* user);
  void* user;
};
/** Carries out an edit that is prepared, and runs `meanwhile` unless it is null. Returns whether the change stays. Ids
 * are still the old ones while it runs: the cells that come have the indices that they will have, and the generations
 * of those that had them. */
template <int D>
bool carry_out_prepared(Edit<D>& edit, Scene<D>& scene, const Meanwhile* meanwhile);

}  // namespace dsw
