#pragma once
// Records and shapes of polyhedra and polygons, while a mesh is made.

#include <vector>

#include "environment/environment.h"

namespace dsw {

/** A polyhedron by its facets; of a polygon the points alone, in their order. */
struct GeneralCell {
  std::vector<uint16_t> vertices,
      first;                     // facet f has the local vertices vertices[first[f]] .. vertices[first[f + 1] - 1]
  std::vector<uint32_t> points;  // of each local vertex

  void clear() {
    vertices.clear();
    first.assign(1, 0);
    points.clear();
  }
  uint32_t facet_count() const { return static_cast<uint32_t>(first.size() - 1); }
  void end_facet() { first.push_back(static_cast<uint16_t>(vertices.size())); }
};

template <int D>
class GeneralRecords {
 public:
  /** `poor_fans`: null, or bits: vertices from which facets with five and more are not cut if another one is there. */
  GeneralRecords(Map<D>& map, const Array<uint64_t>* poor_fans) : map_(map), poor_fans_(poor_fans) {}

  /** Writes the record of cell i, links empty, and its shape. The record has its place. False, and nothing is written: the
   * facets do not close a sphere, or a point is repeated. Throws std::bad_alloc. */
  bool write(uint32_t i, const GeneralCell& cell);

 private:
  static constexpr uint32_t kNoShape = 0xffffffffu;

  bool write_polyhedron(uint32_t i, const GeneralCell& cell);
  bool write_polygon(uint32_t i, const GeneralCell& cell);
  uint16_t base_of(const GeneralCell& cell, uint32_t facet) const;
  uint32_t polygon_shape(size_t corners);
  void write_record(uint32_t i, uint32_t number, const GeneralCell& cell);

  Map<D>& map_;
  const Array<uint64_t>* poor_fans_;
  std::vector<uint16_t> base_;
  std::vector<uint32_t> sorted_;
  std::vector<uint32_t> polygon_shapes_;  // by the number of corners
};

}  // namespace dsw
