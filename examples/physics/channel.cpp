#include "channel.h"

namespace physics {

Environment make_channel(const Channel& channel) {
  const std::array<int, 3>& n = channel.cubes;
  std::vector<double> points;
  for (int z = 0; z <= n[2]; ++z) {
    for (int y = 0; y <= n[1]; ++y) {
      for (int x = 0; x <= n[0]; ++x) {
        const double along =
            channel.sliver == 0 ? channel.scale * x : channel.scale * (x / 2) + channel.sliver * (x % 2);
        points.insert(points.end(), {along, channel.scale * y, channel.scale * z});
      }
    }
  }
  const auto point = [&n](int x, int y, int z) { return std::int64_t{x + (n[0] + 1) * (y + (n[1] + 1) * z)}; };
  std::vector<std::int64_t> cells;
  for (int z = 0; z < n[2]; ++z) {
    for (int y = 0; y < n[1]; ++y) {
      for (int x = 0; x < n[0]; ++x) {
        for (int up = 0; up < 2; ++up) {
          cells.insert(cells.end(), {point(x, y, z + up), point(x + 1, y, z + up), point(x + 1, y + 1, z + up),
                                     point(x, y + 1, z + up)});
        }
      }
    }
  }
  dsw_environment_desc desc;
  dsw_environment_desc_init(&desc, sizeof desc);
  desc.points = points.data();
  desc.point_count = points.size() / 3;
  desc.connectivity = cells.data();
  desc.connectivity_count = cells.size();
  desc.cell_count = cells.size() / 8;
  desc.flags = DSW_ENVIRONMENT_LOCATE_GRID;
  dsw_environment* made = nullptr;
  check(dsw_environment_create(nullptr, &desc, &made, nullptr), "creating a channel");
  Environment environment(made);
  for (const std::array<int, 3>& at : channel.obstacles) {
    dsw_volume_id volume;
    const int index = at[0] + n[0] * (at[1] + n[1] * at[2]);
    check(dsw_environment_get_volume(made, static_cast<std::uint32_t>(index), &volume), "finding an obstacle");
    check(dsw_environment_mark_volumes(made, &volume, 1, DSW_MARK_IMPASSABLE, 0, nullptr), "marking an obstacle");
    check(dsw_environment_set_tag(made, volume, channel.tag), "tagging an obstacle");
  }
  return environment;
}

}  // namespace physics
