#pragma once
// What is in a scene as one block of bytes; README.md has the format. The environment is another block.

#include "scene/scene.h"

namespace dsw {

/** Size of the block that `save` writes. Throws std::bad_alloc. */
size_t snapshot_bytes(const Scene<3>& scene);

/** Writes snapshot_bytes(scene) bytes, of any alignment. Throws std::bad_alloc before the first is written. */
void save(const Scene<3>& scene, uint8_t* out);

/** The features of a saved scene. Throws as `load`. */
SceneFeatures saved_features(const uint8_t* block, size_t size);

/** Fills a new scene with these features. The block is not trusted: memory is bounded by a multiple of its size, and all that is in it is
 * looked at in the scene's environment. Throws Error with TRUNCATED, BAD_VERSION or CORRUPT, or std::bad_alloc, and leaves the scene
 * useless then. */
void load(Scene<3>& scene, const uint8_t* block, size_t size);

}  // namespace dsw
