#pragma once
// A vertex, an edge or a face of a body, with its points.

#include "body/simplices.h"

namespace dsw {

template <int D>
struct Part {
  Simplex simplex;
  SimplexCorners<D> corners;
  const double* points[3];

  Part(const Body<D>& body, const Simplex& which) noexcept : simplex(which), corners(body, which), points{} {
    for (uint32_t i = 0; i < corners.count; ++i) points[i] = body.position(corners.vertices[i]);
  }
};

}  // namespace dsw
