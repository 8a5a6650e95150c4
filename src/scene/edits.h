#pragma once
// Changes of the topology while a scene lives in the environment: its particles and bodies follow.

#include "scene/scene.h"
#include "topology/edit.h"

namespace dsw {

/** Carries an edit out. `scene` is the only one that uses the environment, or null. Particles and vertices of bodies in cells that
 * go get those new cells that contain them. Throws OCCUPIED, and leaves in the scene who is in the way, unless all of them are in
 * passable cells then and all bodies are free; and what prepare() throws. Then nothing has changed.
 * O(what changes + particles and size of the bodies; what of them is near if the scene keeps that). */
void carry_out(Edit& edit, Scene<3>* scene);
/** The same with an edit that is prepared. */
void carry_out_prepared(Edit& edit, Scene<3>* scene);
/** The same together with what `also` does after the edit has been applied. If that throws, having changed nothing itself, the edit
 * is taken back. */
void carry_out_prepared(Edit& edit, Scene<3>& scene, void (*also)(void* user), void* user);

}  // namespace dsw
