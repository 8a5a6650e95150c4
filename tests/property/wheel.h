// A wheel of the plane: a polygon of 20 corners at its hub, rings of triangles, quads and hexagons round it.
#ifndef DARTSWEEP_TESTS_PROPERTY_WHEEL_H
#define DARTSWEEP_TESTS_PROPERTY_WHEEL_H

#include <cstdint>
#include <vector>

#include "dartsweep/dartsweep.h"

namespace dsw::oracle {

struct Wheel {
  static constexpr int64_t kSpokes = 20;
  std::vector<double> points;  // rings of radius 1, 2 and 3
  std::vector<int64_t> corners, offsets{0};
  std::vector<uint8_t> types;
  std::vector<int32_t> regions;
  std::vector<uint32_t> tags;

  Wheel() {
    for (int ring = 1; ring <= 3; ++ring) {
      for (int64_t i = 0; i < kSpokes; ++i) {
        // A quarter turn has five spokes; half its tangent is a rational number.
        const double t = static_cast<double>(i % 5) / 5, x = (1 - t * t) / (1 + t * t), y = 2 * t / (1 + t * t);
        const double turned[4][2] = {{x, y}, {-y, x}, {-x, -y}, {y, -x}};
        points.push_back(ring * turned[i / 5][0]);
        points.push_back(ring * turned[i / 5][1]);
      }
    }
    std::vector<int64_t> hub;
    for (int64_t i = 0; i < kSpokes; ++i) hub.push_back(i);
    add(DSW_CELL_TYPE_POLYGON, hub);
    for (int64_t i = 0; i < kSpokes; ++i) {
      const int64_t a = i, b = at(1, i), c = at(1, i + 1), d = at(0, i + 1);
      if (i % 3 == 0) {
        add(DSW_CELL_TYPE_TRIANGLE, {a, b, c});
        add(DSW_CELL_TYPE_TRIANGLE, {a, c, d});
      } else {
        add(DSW_CELL_TYPE_QUAD, {a, b, c, d});
      }
    }
    for (int64_t i = 0; i < kSpokes; i += 2) {
      add(DSW_CELL_TYPE_POLYGON, {at(1, i), at(2, i), at(2, i + 1), at(2, i + 2), at(1, i + 2), at(1, i + 1)});
    }
  }

  dsw_environment_desc describe() const {
    dsw_environment_desc desc;
    dsw_environment_desc_init(&desc, sizeof desc);
    desc.dimension = 2;
    desc.points = points.data();
    desc.point_count = points.size() / 2;
    desc.cell_types = types.data();
    desc.volume_count = types.size();
    desc.offsets = offsets.data();
    desc.connectivity = corners.data();
    desc.connectivity_count = corners.size();
    desc.regions = regions.data();
    desc.tags = tags.data();
    desc.flags = DSW_ENVIRONMENT_LOCATE_TREE;
    return desc;
  }

 private:
  static int64_t at(int64_t ring, int64_t i) { return kSpokes * ring + i % kSpokes; }
  void add(uint8_t type, const std::vector<int64_t>& cell) {
    types.push_back(type);
    corners.insert(corners.end(), cell.begin(), cell.end());
    offsets.push_back(static_cast<int64_t>(corners.size()));
    regions.push_back(static_cast<int32_t>(types.size()) % 3 - 1);
    tags.push_back(static_cast<uint32_t>(types.size()) * 7);
  }
};

}  // namespace dsw::oracle

#endif
