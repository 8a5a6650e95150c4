#pragma once
// An environment as one block of bytes, the same on every machine; README.md has the format.

#include <cstddef>
#include <cstdint>

#include "environment/environment.h"

namespace dsw {

/** Size of the block that `save` writes. */
template <int D>
size_t snapshot_bytes(const Environment<D>& env);

/** Writes snapshot_bytes(env) bytes, of any alignment. Throws std::bad_alloc before the first is written. */
template <int D>
void save(const Environment<D>& env, uint8_t* out);

/** Fills an empty environment. The block is not trusted: memory is bounded by a multiple of its size, and what is
 * accepted saves to the same bytes. Throws Error with TRUNCATED, BAD_VERSION or CORRUPT, or std::bad_alloc, and leaves
 * the environment useless then. */
template <int D>
void load(Environment<D>& env, const uint8_t* block, size_t size);

}  // namespace dsw
