#pragma once
// Cells that go together, and what can fill their place: one cell, or tetrahedra that meet in one vertex.

#include "base/key_table.h"
#include "environment/environment.h"
#include "map/cell_queue.h"
#include "topology/edit.h"

namespace dsw {

constexpr uint32_t kMostRim = 128;  // facets round a patch

/** Positions in which what comes has to be valid; `next` may be null. Vertices of a patch are finite in both. */
struct Geometry {
  const double* now;
  const double* next;
};

/** The facets round some cells, seen from inside. */
using Rim = Array<HalfFacet>;

/** Cells and how their place is filled. */
struct Patch {
  enum class Filling { kNothing, kOneCell, kTetrahedra };
  Array<Cell> cells;
  Rim rim;
  Filling filling = Filling::kNothing;
  uint32_t apex = 0;  // kTetrahedra: the vertex of the rim that all of them have

  explicit Patch(const Memory* memory) : cells(memory), rim(memory) {}
};

/** A rim on paper. */
class RimSurface {
 public:
  /** Throws std::bad_alloc, as all that follows. */
  explicit RimSurface(const Environment<3>& env);

  /** False if it has too many facets or vertices. */
  bool read(const Rim& rim, uint32_t most_facets);
  /** Triangles that one cell in place of the patch would see from their wrong side, in all positions. */
  uint32_t count_wrong(const Geometry& geometry);
  /** Counts the triangles that a vertex of the rim sees from their wrong side, for the vertex with the fewest. Returns
   * `most` if these are not fewer, or if there are other facets than triangles. */
  uint32_t count_wrong_from_vertex(const Geometry& geometry, uint32_t most);
  /** Whether it closes one sphere. */
  bool is_sphere();
  /** Whether one cell in place of the patch would be valid. */
  bool is_valid_cell(const Geometry& geometry);
  /** The vertex from which all triangles are seen best from inside; kNoVertex if there is none from which all are
   * positive, or there would be more than so many. Only for rims of triangles. */
  uint32_t find_apex(const Geometry& geometry, size_t most_tetrahedra);

  static constexpr uint32_t kNoVertex = 0xffffffffu;

 private:
  bool is_triangulated() const;
  /** The vertex of the environment at a place. */
  uint32_t vertex(uint32_t place) const { return static_cast<uint32_t>(vertices_[place]); }
  bool has(uint32_t triangle, uint32_t place) const;
  double quality(const double* points, uint32_t apex, double worst) const;

  const Environment<3>& env_;
  KeyTable vertices_{env_.memory};              // of the environment; a place is a number in this table
  Array<uint8_t> triangles_{env_.memory};       // three places for each
  Array<uint16_t> loops_{env_.memory}, first_;  // of the facets
  Array<uint16_t> table_;
  Array<const double*> at_{env_.memory};
};

/** Writes what fills a patch into an edit; `pairs` counts facets between two new cells. No more cells come than go, and
 * each has the index of one that goes. Returns how many. */
uint32_t fill(Edit<3>& edit, const Patch& patch, uint32_t& pairs);

}  // namespace dsw
