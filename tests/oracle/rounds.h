// Scenes in rounds until there is enough of something.
#pragma once

#include "rng.h"

namespace dsw::oracle {

/// Calls one(turn, seed) for each turn in its turn until done() has reached `wanted`.
template <class Turns, class Done, class One>
void run_rounds(const Turns& turns, Rng rng, uint64_t wanted, Done done, One one) {
  while (done() < wanted) {
    const uint64_t before = done();
    for (const auto& turn : turns) {
      const uint64_t seed = rng.next() >> 1;
      if (done() < wanted) one(turn, seed);
    }
    if (done() == before) return;  // a defect that keeps every scene from being made
  }
}

}  // namespace dsw::oracle
