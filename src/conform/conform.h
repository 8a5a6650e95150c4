#pragma once
// A mesh whose parts lie on each other, made to hang together: facets of the outer boundary are split where facets of other
// cells cover them, so that cells become polyhedra (in the plane polygons) and both sides have the same facets.

#include "conform/hanging_points.h"
#include "environment/builder.h"

namespace dsw {

template <int D>
class ConformedMesh {
 public:
  /** `env` was read, and its points are merged (read_mesh). Points within `room` of an edge or of the plane of a facet lie on
   * it; 0: exactly. Throws NOT_CONFORMING, with the first two cells in the report, where facets overlap and points to split
   * them at are missing; std::bad_alloc. */
  ConformedMesh(const Environment<D>& env, double room, BuildReport& report);

  /** Whether a cell is another one than it was. */
  bool has_changed() const { return !types_.empty(); }
  /** Makes the mesh of an empty environment, over the points of `input`, of which `from` was made. Throws as read_mesh. */
  void read(Environment<D>& env, const Environment<D>& from, const dsw_environment_desc& input,
            BuildReport& report) const;

 private:
  dsw_environment_desc description(const dsw_environment_desc& input) const;

  Array<uint8_t> types_, has_changed_;  // of each cell; types of VTK
  Array<int64_t> offsets_, connectivity_;
  Array<uint64_t> poor_fans_;  // as of HangingPoints
};

}  // namespace dsw
