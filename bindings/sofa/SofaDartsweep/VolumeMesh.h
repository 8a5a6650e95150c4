// The volumes of a topology container, as the library takes them.
#pragma once

#include <sofa/core/topology/BaseMeshTopology.h>
#include <sofa/type/vector.h>

#include <cstdint>
#include <vector>

#include "SofaDartsweep/status.h"

namespace sofadartsweep {

/** Cells in the order tetrahedra, hexahedra, prisms, pyramids: the index of a cell is that of its volume. */
struct VolumeMesh {
  std::vector<std::uint8_t> types;
  std::vector<std::int64_t> offsets{0};
  std::vector<std::int64_t> corners;
  std::vector<std::uint32_t> tags;  ///< Empty, or one for each cell.
  std::size_t tetrahedra = 0, hexahedra = 0, prisms = 0, pyramids = 0;

  std::size_t size() const { return types.size(); }
  /** Reads the container. */
  void read(sofa::core::topology::BaseMeshTopology& topology);
};

/** What is marked as impassable beside the outer boundary. */
struct Walls {
  std::vector<std::uint8_t> volumes;         ///< One for each cell: whether it is impassable.
  std::vector<std::size_t> face_offsets{0};  ///< Patches: faces by their vertices.
  std::vector<std::uint32_t> face_corners;
};

/** Creates an environment from cells and `points`, with its marks. Returns null after a message. */
dsw_environment* create_environment(const sofa::core::objectmodel::BaseComponent& owner, dsw_context* context,
                                    const VolumeMesh& mesh, const Walls& walls, const std::vector<double>& points);

}  // namespace sofadartsweep
