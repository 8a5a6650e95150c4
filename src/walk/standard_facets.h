#pragma once
// Facets of tetrahedra, pyramids and hexahedra as constants: for code that meets them too often to ask a shape.

#include "base/compiler.h"
#include "environment/environment.h"

namespace dsw {

/** The vertex that each facet of a tetrahedron has not. */
constexpr uint8_t kTetrahedronTips[4] = {2, 0, 1, 3};

/** The cell of a facet of a tetrahedron, and its place in the tables above. */
inline Cell tetrahedron_of(HalfFacet facet) noexcept { return {facet.word / kUnitWords<3>}; }
inline uint32_t local_in_tetrahedron(HalfFacet facet) noexcept {
  return facet.word % kUnitWords<3> - (kUnitWords<3> - 4);
}

/** A triangle repeats its last vertex. */
constexpr uint8_t kPyramidFacets[5][4] = {{0, 3, 2, 1}, {0, 1, 4, 4}, {1, 2, 4, 4}, {2, 3, 4, 4}, {3, 0, 4, 4}};

/** Whether cells of a form have facets of these. */
constexpr bool has_standard_facets(Form form) noexcept {
  return form == Form::kSimplex || form == Form::kPyramid || form == Form::kBox;
}

/** The vertices of a facet of such a cell, with its record w, counter-clockwise seen from outside; a triangle repeats
 * the last. */
inline void standard_corners(const uint32_t* w, uint32_t facet, uint32_t (&vertices)[4]) noexcept {
  const Form form = form_of(w[0]);
  for (uint32_t i = 0; i < 4; ++i) {
    vertices[i] = form == Form::kSimplex   ? w[kTetrahedronFacets[facet][i < 3 ? i : 2]] & kVertexMask
                  : form == Form::kPyramid ? w[kUnitWords<3> + kPyramidFacets[facet][i]]
                                           : w[kUnitWords<3> + kBoxFacets[facet][i]];
  }
}

/** Three vertices give the plane of a flat facet, so that vertices 0 and 6 of a box need not be read: what remains of a
 * facet are three neighbours on the ring 1 2 3 7 4 5. They may lie in a row; then no filter decides the facet. */
constexpr uint8_t kFlatFacets[3][6] = {{3, 2, 4, 7, 1, 5}, {4, 5, 1, 2, 3, 7}, {7, 1, 5, 3, 2, 4}};

/** The ridge that two facets share: its vertices in the order of the first facet; a == b if there is none. */
struct Ridge {
  uint8_t a = 0, b = 0;
};

template <uint32_t Facets>
struct RidgeTable {
  Ridge of[Facets][Facets];
};

template <uint32_t Facets, uint32_t Vertices>
constexpr RidgeTable<Facets> make_ridges(const uint8_t (&facets)[Facets][Vertices]) {
  RidgeTable<Facets> table{};
  for (uint32_t f = 0; f < Facets; ++f) {
    for (uint32_t g = 0; g < Facets; ++g) {
      for (uint32_t i = 0; i < Vertices * Vertices; ++i) {
        const uint8_t a = facets[f][i / Vertices], b = facets[f][(i / Vertices + 1) % Vertices];
        if (a != b && facets[g][i % Vertices] == b && facets[g][(i % Vertices + 1) % Vertices] == a)
          table.of[f][g] = {a, b};
      }
    }
  }
  return table;
}
constexpr RidgeTable<4> kTetrahedronRidges = make_ridges(kTetrahedronFacets);
constexpr RidgeTable<6> kBoxRidges = make_ridges(kBoxFacets);
constexpr RidgeTable<5> kPyramidRidges = make_ridges(kPyramidFacets);

/** The ridge that facets f and g of such a cell, with its record w, share, in the order of f. False: there is none. */
DSW_HOT bool shared_ridge(const Environment<3>& env, const uint32_t* w, uint32_t f, uint32_t g,
                          const double* (&ridge)[2]) noexcept {
  const Form form = form_of(w[0]);
  const Ridge shared = form == Form::kSimplex   ? kTetrahedronRidges.of[f][g]
                       : form == Form::kPyramid ? kPyramidRidges.of[f][g]
                                                : kBoxRidges.of[f][g];
  if (shared.a == shared.b) return false;
  w += form == Form::kSimplex ? 0 : kUnitWords<3>;
  ridge[0] = env.point(w[shared.a] & kVertexMask);
  ridge[1] = env.point(w[shared.b] & kVertexMask);
  return true;
}

/** Triangle `half` of facet f of a hexahedron, as its standard shape has it. */
inline void box_triangle(const Environment<3>& env, const uint32_t* w, uint32_t f, uint32_t half,
                         const double* (&triangle)[3]) noexcept {
  const uint32_t base = w[0] >> f & 1u;
  triangle[0] = env.point(w[kUnitWords<3> + kBoxFacets[f][base]]);
  triangle[1] = env.point(w[kUnitWords<3> + kBoxFacets[f][base + 1 + half]]);
  triangle[2] = env.point(w[kUnitWords<3> + kBoxFacets[f][(base + 2 + half) & 3u]]);
}

/** Points of simplex `simplex` of a cell, without its shape where that is a standard one. */
template <int D>
inline void boundary_points(const Environment<D>& env, Cell c, uint32_t simplex, const double* (&out)[D]) noexcept {
  if constexpr (D == 3) {
    const uint32_t* w = env.map.record(c);
    const Form form = form_of(w[0]);
    if (form == Form::kBox) return box_triangle(env, w, simplex / 2, simplex % 2, out);
    if (form == Form::kSimplex) {
      for (int i = 0; i < 3; ++i) out[i] = env.point(w[kTetrahedronFacets[simplex][i]] & kVertexMask);
      return;
    }
  }
  simplex_points(env, c, env.map.shape(c), simplex, out);
}

}  // namespace dsw
