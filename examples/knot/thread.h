// A thread that is tied into an overhand knot round a post: a polyline that meets itself, with constraints of distance as its physics.
#pragma once

#include <dartsweep/dartsweep.h>

#include <cstddef>
#include <functional>
#include <vector>

#include "apart.h"

namespace knot {

/// What is done where an edge touches: it gets new vertices and bends.
constexpr dsw_response kAdaptive = DSW_RESPONSE_ADAPTIVE_ONE;

/// The post is a column of cells from floor to ceiling round the third axis. Half of its width.
constexpr double kPostHalf = 0.5;

/// What has become of a thread.
struct Figures {
  std::size_t steps = 0;
  std::size_t free_steps = 0;  // after which all edges were free, and every two without a common vertex apart
  std::size_t inserted = 0, inserted_at_post = 0, removed = 0;  // vertices, by responses
  std::size_t split = 0, merged = 0;                            // edges and vertices, by the host
  std::size_t at_post = 0, at_itself = 0;                       // contacts
  std::size_t most_vertices = 0;                                // at any time
  std::size_t edges_cast = 0, pairs_checked = 0;
  double stretch = 0, longest_stretch = 0;  // of the thread at the end, and at any time, as a share of its length
  double seconds = 0;                       // of the moves alone
};

/// The thread at one moment, from its tail to its head.
struct View {
  std::size_t step;
  std::vector<Point> at;
  std::vector<bool> inserted;  // by a response
};

/// Ties the knot in so many steps; 2400 close it. `look` is called at the start and after each step. Throws std::runtime_error if a
/// call fails.
Figures tie(std::size_t steps, const std::function<void(const View&)>& look);

}  // namespace knot
