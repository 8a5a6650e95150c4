// Queries without a scene.
#pragma once

#include "ground.h"
#include "sum.h"

namespace dsw::portable {

/// How many results are in a sum.
struct Tally {
  Sum sum;
  uint64_t count = 0;
};

/// Casts, one by one, along a path, and in batches; locations of their ends.
void ask_casts(const Ground& ground, size_t count, Rng& rng, Tally& tally);
void ask_sweeps(const Ground& ground, size_t count, Rng& rng, Tally& tally);
/// What is nearest to points and segments.
void ask_nearest(const Ground& ground, size_t count, Rng& rng, Tally& tally);
/// Pairs of moving features, with ranks: on a small lattice, where times are often equal, and anywhere.
void ask_pairs(const dsw_context* context, uint32_t dimension, size_t count, Rng& rng, Tally& tally);
/// Coarser copies, and proofs of a partition.
void ask_for_all(const Ground& ground, Rng& rng, Tally& tally);

}  // namespace dsw::portable
