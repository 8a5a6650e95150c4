// Swept edges for the oracle, in either dimension.
#pragma once

#include "arena.h"
#include "places.h"

namespace dsw::oracle {

/// Triangles with a bias to what is exactly on something, and to what holds a small obstacle.
class Sweeps {
 public:
  Sweeps(Arena& arena, Places& places, Rng& rng) : arena_(arena), places_(places), rng_(rng) {}
  Sweep next();

 private:
  void round_obstacle(Sweep& s);
  void anchored(Sweep& s);
  void in_line(Sweep& s);

  Arena& arena_;
  Places& places_;
  Rng& rng_;
};

}  // namespace dsw::oracle
