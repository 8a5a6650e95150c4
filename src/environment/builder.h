#pragma once
// Creation: from the arrays of a mesh to a validated environment, in one pass over the cells and expected linear time.

#include "environment/environment.h"

namespace dsw {

/** The host's arrays, read in place; the same members as dsw_environment_desc, whose sizes and pointers the caller has
 * checked for null. Cell types are VTK's numbers (in the plane: 5 triangle, 9 quadrilateral, 7 polygon). */
struct MeshInput {
  const double* points = nullptr;
  size_t point_count = 0, point_stride_bytes = 0;
  bool borrow_points = false, reorient = false;
  const uint8_t* cell_types = nullptr;
  uint32_t uniform_cell_type = 0;
  size_t cell_count = 0;
  uint32_t index_bytes = 8;
  const void* offsets = nullptr;
  const void* connectivity = nullptr;
  size_t connectivity_count = 0;
  const void* faces = nullptr;
  size_t faces_count = 0;
  const void* face_locations = nullptr;
  const int32_t* regions = nullptr;
  const uint32_t* tags = nullptr;
};

/** First offenders of one kind, ascending. */
struct Offenders {
  static constexpr uint32_t kMax = 8;
  uint32_t count = 0;
  uint32_t index[kMax] = {};
  void add(uint32_t i) {
    if (count < kMax && (count == 0 || index[count - 1] != i)) index[count++] = i;
  }
};

struct BuildReport {
  Offenders offenders;
  uint32_t reoriented_count = 0, unused_point_count = 0, convex_volume_count = 0;
};

/** Fills an empty environment; throws Error (and leaves the environment useless) on the first kind of defect found,
 * with the first offenders of that kind in the report. Order of checks: sizes, points finite, cells well-formed, facets
 * matched, cells valid. */
template <int D>
void build(Environment<D>& env, const MeshInput& input, BuildReport& report);

/** How many parts there are, connected through facets. Throws std::bad_alloc. */
template <int D>
uint32_t count_parts(const Environment<D>& env);

/** Counts the parts connected through facets and sets the box of used vertices; for build and for loading. */
template <int D>
void finish_topology(Environment<D>& env, BuildReport* report);

}  // namespace dsw
