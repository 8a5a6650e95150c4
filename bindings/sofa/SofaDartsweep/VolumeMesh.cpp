#include "SofaDartsweep/VolumeMesh.h"

#include <sofa/helper/logging/Messaging.h>

namespace sofadartsweep {
namespace {

// SOFA numbers a prism as one triangle and then the other, turned alike; the library, like VTK, wants the first
// triangle to look outwards. DSW_ENVIRONMENT_REORIENT mirrors the cells of either habit.
template <class Cells>
std::size_t add(VolumeMesh& mesh, const Cells& cells, dsw_cell_type type) {
  for (const auto& cell : cells) {
    mesh.corners.insert(mesh.corners.end(), cell.begin(), cell.end());
    mesh.offsets.push_back(static_cast<std::int64_t>(mesh.corners.size()));
    mesh.types.push_back(static_cast<std::uint8_t>(type));
  }
  return cells.size();
}

bool mark(const sofa::core::objectmodel::BaseComponent& owner, dsw_environment* environment, const Walls& walls) {
  std::vector<dsw_volume_id> volumes;
  for (std::size_t cell = 0; cell < walls.volumes.size(); ++cell) {
    if (!walls.volumes[cell]) continue;
    volumes.emplace_back();
    if (!succeeded(owner, "volume",
                   dsw_environment_get_volume_id(environment, static_cast<std::uint32_t>(cell), &volumes.back())))
      return false;
  }
  if (!volumes.empty() && !succeeded(owner, "impassable volumes",
                                     dsw_environment_mark_volumes(environment, volumes.data(), volumes.size(),
                                                                  DSW_MARK_IMPASSABLE, 0, nullptr)))
    return false;
  const std::size_t count = walls.face_offsets.size() - 1;
  if (count == 0) return true;
  std::vector<dsw_face_id> faces(count);
  std::size_t missing = 0;
  if (!succeeded(owner, "impassable faces",
                 dsw_environment_find_faces(environment, count, walls.face_offsets.data(), walls.face_corners.data(),
                                            faces.data(), &missing)))
    return false;
  if (missing > 0) {
    msg_error(&owner) << missing << " of " << count << " impassable faces are no faces of the volumes";
    return false;
  }
  return succeeded(owner, "impassable faces",
                   dsw_environment_mark_faces(environment, faces.data(), faces.size(), DSW_MARK_IMPASSABLE));
}

}  // namespace

void VolumeMesh::read(sofa::core::topology::BaseMeshTopology& topology) {
  *this = VolumeMesh();
  tetrahedra = add(*this, topology.getTetrahedra(), DSW_CELL_TYPE_TETRA);
  hexahedra = add(*this, topology.getHexahedra(), DSW_CELL_TYPE_HEXAHEDRON);
  prisms = add(*this, topology.getPrisms(), DSW_CELL_TYPE_WEDGE);
  pyramids = add(*this, topology.getPyramids(), DSW_CELL_TYPE_PYRAMID);
}

dsw_environment* create_environment(const sofa::core::objectmodel::BaseComponent& owner, dsw_context* context,
                                    const VolumeMesh& mesh, const Walls& walls, const std::vector<double>& points) {
  auto desc = defaults<dsw_environment_desc>(dsw_environment_desc_init);
  desc.flags = DSW_ENVIRONMENT_REORIENT;
  desc.points = points.data();
  desc.point_count = points.size() / 3;
  desc.cell_types = mesh.types.data();
  desc.volume_count = mesh.size();
  desc.offsets = mesh.offsets.data();
  desc.connectivity = mesh.corners.data();
  desc.connectivity_count = mesh.corners.size();
  if (!mesh.tags.empty()) desc.tags = mesh.tags.data();
  auto report = sized<dsw_build_report>();
  dsw_environment* environment = nullptr;
  const dsw_status status = dsw_environment_create(context, &desc, &environment, &report);
  if (!succeeded(owner, "volumes", status)) {
    for (std::uint32_t i = 0; i < report.offender_count && i < 8; ++i)
      msg_error(&owner) << "  cell " << report.offenders[i];
    return nullptr;
  }
  if (mark(owner, environment, walls)) return environment;
  dsw_environment_destroy(environment);
  return nullptr;
}

}  // namespace sofadartsweep
