// Environments to make calls in: blocks of boxes or sheets of squares, each cut into cells of one type.

#include <algorithm>

#include "use.h"

namespace dsw_fuzz {
namespace {

constexpr uint8_t kFirstPlanarWorld = 160;

/** Cells of a box with corners in the order of a hexahedron, as positions in these; 8 is the middle. Polyhedra as face
 * streams. */
std::vector<std::vector<uint32_t>> cells_of_box(dsw_cell_type type) {
  switch (type) {
    case DSW_CELL_TYPE_TETRA:  // six round the diagonal
      return {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6}, {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}};
    case DSW_CELL_TYPE_WEDGE:
      return {{0, 3, 1, 4, 7, 5}, {1, 3, 2, 5, 7, 6}};
    case DSW_CELL_TYPE_PYRAMID:
      return {{3, 7, 4, 0, 8}, {5, 6, 2, 1, 8}, {4, 5, 1, 0, 8}, {2, 6, 7, 3, 8}, {1, 2, 3, 0, 8}, {7, 6, 5, 4, 8}};
    case DSW_CELL_TYPE_POLYHEDRON:
      return {{0, 4, 7, 3, 1, 2, 6, 5, 0, 1, 5, 4, 3, 7, 6, 2, 0, 3, 2, 1, 4, 5, 6, 7}};
    case DSW_CELL_TYPE_TRIANGLE:
      return {{0, 1, 2}, {0, 2, 3}};
    case DSW_CELL_TYPE_QUAD:
    case DSW_CELL_TYPE_POLYGON:
      return {{0, 1, 2, 3}};
    default:
      return {{0, 1, 2, 3, 4, 5, 6, 7}};
  }
}

}  // namespace

World world_of(uint8_t byte) {
  // Most of them small: what breaks in many cells mostly breaks in few, and sooner.
  constexpr uint32_t boxes[8][3] = {{1, 1, 1}, {2, 1, 1}, {1, 1, 2}, {1, 1, 1},
                                    {3, 1, 1}, {2, 2, 1}, {2, 2, 2}, {3, 3, 3}};
  constexpr dsw_cell_type types[8] = {DSW_CELL_TYPE_HEXAHEDRON, DSW_CELL_TYPE_TETRA,     DSW_CELL_TYPE_POLYHEDRON,
                                      DSW_CELL_TYPE_HEXAHEDRON, DSW_CELL_TYPE_WEDGE,     DSW_CELL_TYPE_HEXAHEDRON,
                                      DSW_CELL_TYPE_PYRAMID,    DSW_CELL_TYPE_HEXAHEDRON};
  constexpr dsw_cell_type planar_types[] = {DSW_CELL_TYPE_TRIANGLE, DSW_CELL_TYPE_QUAD, DSW_CELL_TYPE_POLYGON};
  constexpr uint32_t squares[8][2] = {{1, 1}, {2, 1}, {1, 2}, {2, 2}, {3, 1}, {3, 2}, {3, 3}, {5, 4}};
  if (byte >= kFirstPlanarWorld) {
    const auto& sheet = squares[byte % 8];
    return {{sheet[0], sheet[1], 0}, planar_types[byte / 8 % 3]};
  }
  const auto& size = boxes[byte % 8];
  return {{size[0], size[1], size[2]}, types[byte / 8 % 8]};
}

dsw_environment* make_world(const World& world, dsw_context* context) {
  const uint32_t nx = world.boxes[0], ny = world.boxes[1], nz = world.boxes[2];
  std::vector<double> points;
  for (uint32_t z = 0; z <= nz; ++z) {
    for (uint32_t y = 0; y <= ny; ++y) {
      for (uint32_t x = 0; x <= nx; ++x) {
        const double warp = (x * y * (world.is_planar() ? 1 : z)) % 3 == 1 ? 0.125 : 0;
        points.insert(points.end(), {x + warp, y - warp, double(z)});
      }
    }
  }
  const std::vector<std::vector<uint32_t>> of_box = cells_of_box(world.type);
  std::vector<int64_t> connectivity, offsets = {0};
  for (uint32_t z = 0; z < std::max(nz, 1u); ++z) {
    for (uint32_t y = 0; y < ny; ++y) {
      for (uint32_t x = 0; x < nx; ++x) {
        const int64_t first = x + (nx + 1) * (y + (ny + 1) * z), row = nx + 1, layer = row * (ny + 1);
        const int64_t middle = static_cast<int64_t>(points.size() / 3);
        const int64_t corners[] = {first,         first + 1,         first + 1 + row,         first + row,
                                   first + layer, first + 1 + layer, first + 1 + row + layer, first + row + layer,
                                   middle};
        if (world.type == DSW_CELL_TYPE_PYRAMID) points.insert(points.end(), {x + 0.5, y + 0.5, z + 0.5});
        for (const std::vector<uint32_t>& cell : of_box) {
          const bool stream = world.type == DSW_CELL_TYPE_POLYHEDRON;
          if (stream) connectivity.push_back(6);
          for (size_t i = 0; i < cell.size(); ++i) {
            if (stream && i % 4 == 0) connectivity.push_back(4);
            connectivity.push_back(corners[cell[i]]);
          }
          offsets.push_back(static_cast<int64_t>(connectivity.size()));
        }
      }
    }
  }
  const std::vector<uint8_t> types(offsets.size() - 1, static_cast<uint8_t>(world.type));
  dsw_environment_desc desc;
  dsw_environment_desc_init(&desc, sizeof desc);
  if (world.is_planar()) {
    desc.dimension = 2;
    desc.point_stride_bytes = 3 * sizeof(double);
  }
  desc.points = points.data();
  desc.point_count = points.size() / 3;
  desc.cell_types = types.data();
  desc.volume_count = types.size();
  desc.offsets = offsets.data();
  desc.connectivity = connectivity.data();
  desc.connectivity_count = connectivity.size();
  dsw_environment* environment = nullptr;
  require(dsw_environment_create(context, &desc, &environment, nullptr) == DSW_STATUS_OK, "a world");
  const dsw_volume_id wall = {static_cast<uint32_t>(types.size() / 2), 1};  // in the middle
  require(types.size() == 1 ||
              dsw_environment_mark_volumes(environment, &wall, 1, DSW_MARK_IMPASSABLE, 0, nullptr) == DSW_STATUS_OK,
          "a wall");
  return environment;
}

dsw_environment* make_home(bool is_planar) {
  return make_world(is_planar ? World{{3, 3, 0}, DSW_CELL_TYPE_QUAD} : World{{3, 3, 3}, DSW_CELL_TYPE_HEXAHEDRON});
}

}  // namespace dsw_fuzz
