#include "sweeps.h"

#include <cmath>

namespace dsw::oracle {

/// A triangle round a place of something impassable, so that its sides may be free.
void Sweeps::round_obstacle(Sweep& s) {
  Vec site;
  std::array<Vec, 2> span;  // two directions of the triangle's plane
  const bool exactly = places_.round_obstacle(site, span);
  // Corners so that the site has positive weights.
  const double w[3] = {rng_.range(0.2, 1), rng_.range(0.2, 1), rng_.range(0.2, 1)};
  const double scale = exactly && arena_.lattice() ? std::ldexp(1, std::ilogb(arena_.size()) - 6) : 0;
  for (size_t k = 0; k < 3; ++k) {
    double a = span[0][k], b = span[1][k], c = -(w[0] * a + w[1] * b) / w[2];
    if (scale > 0) {
      a = scale * std::round(a / scale);
      b = scale * std::round(b / scale);
      c = -a - b;
    }
    s.from[k] = site[k] + a;
    s.to[k] = site[k] + b;
    s.fixed[k] = site[k] + c;
  }
  if (rng_.chance(0.5)) std::swap(s.to, s.fixed);
}

/// One or more ends on the vertices or edges of what is impassable.
void Sweeps::anchored(Sweep& s) {
  s.fixed = places_.anchor();
  s.from = rng_.chance(0.3) ? places_.anchor() : rng_.chance(0.5) ? places_.near(s.fixed, 0.3) : places_.start();
  s.to = rng_.chance(0.4) ? places_.anchor() : rng_.chance(0.5) ? places_.near(s.from, 0.3) : places_.target(s.from);
  if (rng_.chance(0.2)) std::swap(s.from, s.fixed);
}

/// p, p' and q in a row, or falling together.
void Sweeps::in_line(Sweep& s) {
  s.from = places_.start();
  switch (rng_.below(5)) {
    case 0:
      s.to = s.from;
      s.fixed = places_.target(s.from);
      return;
    case 1:
      s.fixed = s.from;
      s.to = places_.target(s.from);
      return;
    case 2:
      s.fixed = places_.target(s.from);
      s.to = s.fixed;
      return;
    case 3: {  // along an axis
      s.to = s.fixed = s.from;
      const size_t k = places_.any_axis();
      s.to[k] = places_.site()[k];
      s.fixed[k] = places_.site()[k];
      return;
    }
    default: {
      static const double by[] = {-1, -0.5, 0.25, 0.5, 1.5, 2};
      s.fixed = places_.target(s.from);
      s.to = between(s.from, s.fixed, by[rng_.below(6)]);
      return;
    }
  }
}

Sweep Sweeps::next() {
  static const double steps[] = {1e-6, 0.01, 0.1, 0.3, 1, 4};
  Sweep s;
  const uint32_t kind = rng_.below(20);
  const int most = rng_.chance(0.1) ? 1 : 12;  // some may start as they fall
  for (int tries = 0; tries < most; ++tries) {
    if (kind < 5) {
      s.from = places_.start();
      s.fixed = rng_.chance(0.5) ? places_.near(s.from, 0.2) : places_.start();
      s.to = places_.near(s.from, steps[rng_.below(6)]);
    } else if (kind < 9) {
      s.from = places_.site();
      s.fixed = places_.site();
      s.to = rng_.chance(0.5) ? places_.site() : places_.target(s.from);
    } else if (kind < 11) {
      in_line(s);
    } else if (kind < 14) {
      anchored(s);
    } else {
      round_obstacle(s);
    }
    for (Vec* p : {&s.from, &s.to, &s.fixed}) {
      for (double& x : *p) x = std::isfinite(x) ? x : 0;
    }
    if (!arena_.passable(arena_.locate(s.from)) || arena_.exact.blocked(s.from, s.fixed)) continue;
    // What is to be met inside only needs three free sides.
    if (kind < 14 || tries + 2 > most ||
        (!arena_.exact.blocked(s.from, s.to) && !arena_.exact.blocked(s.to, s.fixed))) {
      break;
    }
  }
  s.truth = arena_.exact.sweep(s.from, s.to, s.fixed);
  return s;
}

}  // namespace dsw::oracle
