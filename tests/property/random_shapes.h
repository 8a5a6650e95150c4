// Shapes to carve with and loops to tie with: of every size, some through vertices or along faces, folded, or flat.
#pragma once

#include <cstdlib>
#include <vector>

#include "environment/environment.h"
#include "mesh.h"
#include "rng.h"

namespace dsw::oracle {

constexpr double kPi = 3.14159265358979323846;  // M_PI is not everywhere

struct ClosedSurface {
  std::vector<double> points;
  std::vector<uint32_t> triangles;
};

/// Around somewhere in the environment; `size` is that of all of it.
ClosedSurface some_surface(const Environment<3>& env, double size, Rng& rng);

/// Points of a loop, nearly round or not at all.
std::vector<double> some_loop(const Environment<3>& env, double size, Rng& rng);

}  // namespace dsw::oracle
