// Environments of meshes in the plane, and what is impassable in them.
#include "defaults.h"
#include "plane_scenes.h"

namespace dsw::oracle::plane {

EnvironmentPtr make_environment(const Turn& turn, const World& world, Rng& rng, dsw_context* context) {
  const size_t stride = rng.chance(0.5) ? 2 : 3;
  std::vector<double> points;
  for (const Vec& p : world.points) {
    points.insert(points.end(), p.begin(), p.end());
    points.resize(points.size() + stride - 2);
  }
  std::vector<uint8_t> types;
  std::vector<int64_t> offsets = {0}, connectivity;
  for (const std::vector<int>& cell : world.cells) {
    const int own = cell.size() == 3   ? DSW_CELL_TYPE_TRIANGLE
                    : cell.size() == 4 ? DSW_CELL_TYPE_QUAD
                                       : DSW_CELL_TYPE_POLYGON;
    types.push_back(static_cast<uint8_t>(!turn.coarse() && rng.chance(0.2) ? int{DSW_CELL_TYPE_POLYGON} : own));
    connectivity.insert(connectivity.end(), cell.begin(), cell.end());
    offsets.push_back(static_cast<int64_t>(connectivity.size()));
  }
  dsw_environment_desc desc = defaults(dsw_environment_desc_init);
  desc.dimension = 2;
  desc.points = points.data();
  desc.point_count = world.points.size();
  desc.point_stride_bytes = stride * sizeof(double);
  desc.cell_types = types.data();
  desc.volume_count = types.size();
  desc.offsets = offsets.data();
  desc.connectivity = connectivity.data();
  desc.connectivity_count = connectivity.size();
  desc.tags = world.tags.data();
  desc.flags = rng.chance(0.5) ? uint32_t{DSW_ENVIRONMENT_LOCATE_TREE} : 0;
  if (rng.chance(0.5)) desc.flags |= uint32_t{DSW_ENVIRONMENT_CHECK_BOUNDARY};
  dsw_environment* environment = nullptr;
  dsw_environment_create(context, &desc, &environment, nullptr);
  return EnvironmentPtr(environment);
}

std::string mark(World& world, dsw_environment* environment, const Shares& shares, Rng& rng,
                 std::vector<int>& vertices) {
  std::vector<dsw_volume_id> cells;
  for (uint32_t c = 0; c < world.cells.size(); ++c) {
    if (!rng.chance(shares.cells)) continue;
    cells.push_back({c, 1});
    world.cell_marked[c] = 1;
  }
  std::vector<dsw_face_id> sides;
  for (Side& side : world.sides) {
    if (!rng.chance(shares.sides)) continue;
    const int end = side.cell[1] >= 0 && rng.chance(0.5) ? 1 : 0;  // either name is accepted
    sides.push_back({static_cast<uint32_t>(side.cell[end]), 1, static_cast<uint32_t>(side.local[end])});
    side.marked = true;
  }
  std::vector<char> used(world.points.size(), 0);
  for (const Side& side : world.sides) used[static_cast<size_t>(side.a)] = used[static_cast<size_t>(side.b)] = 1;
  std::vector<dsw_vertex_id> ids;
  vertices.clear();
  for (uint32_t v = 0; v < used.size(); ++v) {
    if (used[v] == 0 || !rng.chance(shares.vertices)) continue;
    vertices.push_back(static_cast<int>(v));
    ids.push_back({v, 1});
  }
  const bool done =
      dsw_environment_mark_volumes(environment, cells.data(), cells.size(), DSW_MARK_IMPASSABLE, 0, nullptr) ==
          DSW_STATUS_OK &&
      dsw_environment_mark_faces(environment, sides.data(), sides.size(), DSW_MARK_IMPASSABLE) == DSW_STATUS_OK &&
      dsw_environment_mark_vertices(environment, ids.data(), ids.size(), DSW_MARK_IMPASSABLE) == DSW_STATUS_OK;
  return done ? "" : std::string("marking failed: ") + dsw_last_error_message();
}

}  // namespace dsw::oracle::plane
