#pragma once
// Shapes: what cells of one form have in common. A shape lists the facets of a cell (faces in space, edges in the
// plane) with their darts, how the darts are linked inside the cell, and into which simplices the facets are cut. It
// knows no coordinates. Tetrahedra, pyramids, prisms and hexahedra share tables, one for every way to cut their quads;
// any other polyhedron has a table of its own, or shares one with cells that are joined alike.

#include <cstdint>

#include "base/memory.h"

namespace dsw {

/** Form of a cell, as stored in its record. A simplex is a tetrahedron in space and a triangle in the plane; box is a
 * hexahedron or a quadrilateral, general a polyhedron or a polygon. */
enum class Form : uint32_t {
  kSimplex = 0,
  kPyramid = 1,
  kPrism = 2,
  kBox = 3,
  kGeneral = 4,
  kContinuation = 5,
  kFree = 6
};

/** View of one shape table: counts, then arrays, all 16 bits wide. Darts are numbered facet by facet, along each facet
 * counter-clockwise seen from outside; dart d runs from dart_vertex(d) to that of beta1(d). */
class Shape {
 public:
  explicit Shape(const uint16_t* table) : t_(table) {}

  uint32_t vertex_count() const { return t_[0]; }
  uint32_t facet_count() const { return t_[1]; }
  uint32_t edge_count() const { return t_[2]; }
  uint32_t dart_count() const { return t_[3]; }
  uint32_t simplex_count() const { return t_[4]; }

  /** Darts of facet f are facet_first(f) .. facet_first(f + 1) - 1. */
  uint32_t facet_first(uint32_t f) const { return t_[kHeader + f]; }
  uint32_t facet_size(uint32_t f) const { return facet_first(f + 1) - facet_first(f); }
  /** Simplices of facet f are simplex_first(f) .. simplex_first(f + 1) - 1; D local vertices each. */
  uint32_t simplex_first(uint32_t f) const { return t_[kHeader + facet_count() + 1 + f]; }
  const uint16_t* dart_vertices() const { return t_ + kHeader + 2 * (facet_count() + 1); }
  uint32_t dart_vertex(uint32_t d) const { return dart_vertices()[d]; }
  uint32_t dart_facet(uint32_t d) const { return dart_vertices()[dart_count() + d]; }
  uint32_t dart_beta2(uint32_t d) const { return dart_vertices()[2 * dart_count() + d]; }
  uint32_t dart_edge(uint32_t d) const { return dart_vertices()[3 * dart_count() + d]; }
  /** Local vertices of all simplices, D each, oriented as their facet. */
  const uint16_t* simplices() const { return dart_vertices() + 4 * dart_count(); }
  /** Facet of every simplex. */
  const uint16_t* simplex_facets(int dimension) const {
    return simplices() + static_cast<uint32_t>(dimension) * simplex_count();
  }

  uint32_t beta1(uint32_t d) const {
    const uint32_t f = dart_facet(d);
    return d + 1 == facet_first(f + 1) ? facet_first(f) : d + 1;
  }
  uint32_t beta0(uint32_t d) const {
    const uint32_t f = dart_facet(d);
    return d == facet_first(f) ? facet_first(f + 1) - 1 : d - 1;
  }
  const uint16_t* table() const { return t_; }

  static constexpr uint32_t kHeader = 5;

 private:
  const uint16_t* t_;
};

/** Calls visit(local vertex) for the vertices of a facet, in its order: in the plane of a side both. */
template <int D, class Visit>
void for_each_facet_vertex(const Shape& shape, uint32_t facet, Visit visit) {
  if constexpr (D == 2) {
    visit(shape.simplices()[2 * facet]);
    visit(shape.simplices()[2 * facet + 1]);
  } else {
    for (uint32_t d = shape.facet_first(facet); d < shape.facet_first(facet + 1); ++d) visit(shape.dart_vertex(d));
  }
}

/** Loops of local vertices from which a table is made. */
struct FacetLoops {
  const uint16_t* vertices;  // all loops, one after the other
  const uint16_t* first;     // facet_count + 1
  uint32_t facet_count;
  uint32_t vertex_count;
};

/** Begins a table that no cell has; the two words after it lead to the next of its length. */
constexpr uint16_t kFreeShape = 0xffff;

/** Why loops do not make a shape. */
enum class ShapeDefect { kNone, kTooLarge, kShortFacet, kRepeatedVertex, kOpen, kNotSphere };

/** Appends the table of a polyhedron to `tables`; facet f is cut into a fan from the loop position base[f], or, without
 * `base`, from its first. With `triangles`, facets are cut into these instead: facet after facet, three local vertices
 * each, oriented as the facet. On a defect `tables` is as before. */
ShapeDefect append_polyhedron(const FacetLoops& loops, const uint16_t* base, Array<uint16_t>& tables,
                              const uint16_t* triangles = nullptr);

/** Cuts a facet of a polyhedron table into the given triangles: three local vertices each, oriented as the facet. */
void set_triangles(uint16_t* table, uint32_t facet, const uint16_t* triangles);

/** Table of a standard form in space; bit f of `cuts` says that quad facet number f (in the order of facets, triangles
 * not counted) is cut from its second loop vertex instead of its first. */
Shape standard_shape(Form form, uint32_t cuts);

/** Facets of a tetrahedron, and of a hexahedron, as their tables have them. */
constexpr uint8_t kTetrahedronFacets[4][3] = {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {0, 2, 1}};
constexpr uint8_t kBoxFacets[6][4] = {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4},
                                      {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}};

/** Table of a triangle (3) or a quadrilateral (4) in the plane. Facets are its edges: facet i is dart i, from vertex i
 * to the next; there is no beta2 inside a planar cell. */
Shape planar_shape(uint32_t vertex_count);

/** Appends the table of a polygon. */
ShapeDefect append_polygon(uint32_t vertex_count, Array<uint16_t>& tables);

/** Number of quad facets of a standard form. */
constexpr uint32_t quad_count(Form form) {
  return form == Form::kBox ? 6u : form == Form::kPrism ? 3u : form == Form::kPyramid ? 1u : 0u;
}

}  // namespace dsw
