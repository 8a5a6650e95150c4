#pragma once
// Cells of any type, and environments of them.

#include <array>
#include <cstdint>
#include <memory>
#include <random>
#include <vector>

#include "dartsweep/dartsweep.h"

namespace dsw {

using Vec3 = std::array<double, 3>;
using Loops = std::vector<std::vector<int64_t>>;

struct Destroy {
  void operator()(dsw_environment* environment) const { dsw_environment_destroy(environment); }
};
using Owner = std::unique_ptr<dsw_environment, Destroy>;

/** Cells of any type. */
struct Cells {
  unsigned dimension = 3;
  std::vector<double> points;
  std::vector<uint8_t> types;
  std::vector<int64_t> offsets{0}, connectivity;
  std::vector<int32_t> regions;
  std::vector<uint32_t> tags;
  double merge_distance = 0;

  int64_t add_point(const Vec3& p) {
    points.insert(points.end(), p.begin(), p.begin() + dimension);
    return static_cast<int64_t>(points.size() / dimension) - 1;
  }
  void add(dsw_cell_type type, const std::vector<int64_t>& corners) {
    types.push_back(static_cast<uint8_t>(type));
    connectivity.insert(connectivity.end(), corners.begin(), corners.end());
    offsets.push_back(static_cast<int64_t>(connectivity.size()));
    regions.push_back(static_cast<int32_t>(100 + types.size()));
    tags.push_back(static_cast<uint32_t>(7000 + types.size()));
  }
  void add(const Loops& faces) {
    std::vector<int64_t> stream{static_cast<int64_t>(faces.size())};
    for (const auto& face : faces) {
      stream.push_back(static_cast<int64_t>(face.size()));
      stream.insert(stream.end(), face.begin(), face.end());
    }
    add(DSW_CELL_TYPE_POLYHEDRON, stream);
  }
  dsw_environment_desc desc(uint32_t flags) const {
    dsw_environment_desc d;
    dsw_environment_desc_init(&d, sizeof d);
    d.dimension = dimension;
    d.flags = flags;
    d.points = points.data();
    d.point_count = points.size() / dimension;
    d.cell_types = types.data();
    d.volume_count = types.size();
    d.offsets = offsets.data();
    d.connectivity = connectivity.data();
    d.connectivity_count = connectivity.size();
    if (!regions.empty()) d.regions = regions.data();
    if (!tags.empty()) d.tags = tags.data();
    d.merge_distance = merge_distance;
    return d;
  }
  Owner create(uint32_t flags, dsw_build_report& report) const {
    const dsw_environment_desc d = desc(flags);
    report = {};
    report.struct_size = sizeof report;
    dsw_environment* made = nullptr;
    dsw_environment_create(nullptr, &d, &made, &report);
    return Owner(made);
  }
};

inline double uniform(std::mt19937_64& random, double low = 0, double high = 1) {
  return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
}

}  // namespace dsw
