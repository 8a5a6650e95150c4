#include "channel.h"

#include <algorithm>

namespace physics {

Environment make_channel(const Channel& channel) {
  const std::array<int, 3>& n = channel.cubes;
  std::vector<double> points;
  for (int z = 0; z <= n[2]; ++z) {
    for (int y = 0; y <= n[1]; ++y) {
      for (int x = 0; x <= n[0]; ++x) {
        const double along =
            channel.sliver == 0 ? channel.scale * x : channel.scale * (x / 2) + channel.sliver * (x % 2);
        const Vector3 corner(along, channel.scale * y, channel.scale * z);
        const Vector3 at = channel.place ? channel.place(corner) : corner;
        points.insert(points.end(), {at.x(), at.y(), at.z()});
      }
    }
  }
  const auto point = [&n](int x, int y, int z) { return std::int64_t{x + (n[0] + 1) * (y + (n[1] + 1) * z)}; };
  const bool plane = n[2] == 0;
  std::vector<std::int64_t> cells;
  for (int z = 0; z < std::max(n[2], 1); ++z) {
    for (int y = 0; y < n[1]; ++y) {
      for (int x = 0; x < n[0]; ++x) {
        for (int up = 0; up < (plane ? 1 : 2); ++up) {
          cells.insert(cells.end(), {point(x, y, z + up), point(x + 1, y, z + up), point(x + 1, y + 1, z + up),
                                     point(x, y + 1, z + up)});
        }
      }
    }
  }
  dsw_environment_desc desc;
  dsw_environment_desc_init(&desc, sizeof desc);
  desc.dimension = plane ? 2 : 3;
  desc.points = points.data();
  desc.point_stride_bytes = 3 * sizeof(double);
  desc.point_count = points.size() / 3;
  desc.connectivity = cells.data();
  desc.connectivity_count = cells.size();
  desc.volume_count = cells.size() / (plane ? 4 : 8);
  desc.uniform_cell_type = plane ? DSW_CELL_TYPE_QUAD : DSW_CELL_TYPE_HEXAHEDRON;
  desc.flags = DSW_ENVIRONMENT_LOCATE_TREE;
  dsw_environment* made = nullptr;
  check(dsw_environment_create(nullptr, &desc, &made, nullptr), "creating a channel");
  Environment environment(made);
  for (const std::array<int, 3>& at : channel.obstacles) {
    dsw_volume_id volume;
    const int index = at[0] + n[0] * (at[1] + n[1] * at[2]);
    check(dsw_environment_get_volume_id(made, static_cast<std::uint32_t>(index), &volume), "finding an obstacle");
    check(dsw_environment_mark_volumes(made, &volume, 1, DSW_MARK_IMPASSABLE, 0, nullptr), "marking an obstacle");
    check(dsw_environment_set_tag(made, volume, channel.tag), "tagging an obstacle");
  }
  return environment;
}

}  // namespace physics
