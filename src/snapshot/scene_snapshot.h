#pragma once
// What is in a scene as one block of bytes; README.md has the format. The environment is another block.

#include "scene/scene.h"

namespace dsw {

/** The version of the format, the oldest one that is read, and the oldest one whose states are as state_checksum makes
 * them. */
constexpr uint32_t kSceneFormat = 5, kOldestSceneFormat = 2, kOldestStateFormat = 4;

/** Size of the block that `save` writes in a format. Throws std::bad_alloc. */
template <int D>
size_t snapshot_bytes(const Scene<D>& scene, uint32_t format = kSceneFormat);

/** Writes snapshot_bytes(scene, format) bytes, of any alignment. Throws std::bad_alloc before the first is written. */
template <int D>
void save(const Scene<D>& scene, uint8_t* out, uint32_t format = kSceneFormat);

/** A checksum of all that results depend on, as far as a format has it: not of counters, and not of forecasts, which
 * only save work. Throws std::bad_alloc. */
template <int D>
uint64_t state_checksum(const Scene<D>& scene, uint32_t format = kSceneFormat);

/** The features of a saved scene. Throws as `load`. */
template <int D>
SceneFeatures saved_features(const uint8_t* block, size_t size);

/** Fills a new scene with these features. The block is not trusted: memory is bounded by a multiple of its size, and
 * all that is in it is looked at in the scene's environment. Throws Error with TRUNCATED, BAD_VERSION or CORRUPT, or
 * std::bad_alloc, and leaves the scene useless then. */
template <int D>
void load(Scene<D>& scene, const uint8_t* block, size_t size);

}  // namespace dsw
