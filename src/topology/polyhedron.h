#pragma once
// A union of tetrahedra on paper: its boundary triangles, in a numbering that depends only on how they are joined.

#include "environment/environment.h"

namespace dsw {

constexpr uint32_t kMostFacets = 28;
constexpr uint32_t kMostVertices = kMostFacets / 2 + 2;  // of a sphere of triangles

/** Boundary triangle f joins the vertices vertices[triangles[3 f]] and the two after, counter-clockwise seen from
 * outside. Unions that are joined alike have the same `triangles`, so their cells can share a shape. */
struct Polyhedron {
  uint32_t facet_count = 0, vertex_count = 0;
  uint32_t facets[kMostFacets];      // what each comes from: a facet of a tetrahedron, seen from inside of the union
  uint32_t vertices[kMostVertices];  // of the environment
  uint8_t triangles[3 * kMostFacets];
};

/** Makes the union with these facets as its boundary, at most kMostFacets. False unless they close a sphere and the
 * cell would be valid, exactly. */
bool make_polyhedron(const Environment<3>& env, const uint32_t* facets, uint32_t count, Polyhedron& out) noexcept;

/** The corners of a tetrahedron's facet, counter-clockwise seen from outside. */
void corners_of(const Environment<3>& env, HalfFacet h, uint32_t (&out)[3]) noexcept;

}  // namespace dsw
