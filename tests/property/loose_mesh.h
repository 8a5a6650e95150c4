// Meshes whose parts have points of their own, and what is known of them without the engine.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "../effort.h"
#include "cells.h"

namespace dsw::loose {

/** A mesh in which no two cells have points in common. */
struct LooseMesh : Cells {
  using Cells::add;
  void add(dsw_cell_type type, const std::vector<Vec3>& corners) {
    types.push_back(static_cast<uint8_t>(type));
    for (const Vec3& corner : corners) connectivity.push_back(add_point(corner));
    offsets.push_back(static_cast<int64_t>(connectivity.size()));
  }
  void add_box(const Vec3& low, const Vec3& high) {
    std::vector<Vec3> corners;
    for (const double z : {low[2], high[2]}) {
      corners.push_back({low[0], low[1], z});
      corners.push_back({high[0], low[1], z});
      corners.push_back({high[0], high[1], z});
      corners.push_back({low[0], high[1], z});
    }
    if (dimension == 3) {
      add(DSW_CELL_TYPE_HEXAHEDRON, corners);
    } else {
      corners.resize(4);
      add(DSW_CELL_TYPE_QUAD, corners);
    }
  }
};

struct Box {
  Vec3 low, high;
  bool holds(const Vec3& p, unsigned dimension) const {
    for (unsigned k = 0; k < dimension; ++k) {
      if (p[k] < low[k] || p[k] > high[k]) return false;
    }
    return true;
  }
};

/** The boxes of a tree in which each box is 1, 1/2, 1/4 ... of one of side 1, halved at random. */
inline void refine(const Box& box, unsigned dimension, int levels, double share, std::mt19937_64& random,
                   std::vector<Box>& out) {
  if (levels == 0 || uniform(random) >= share) {
    out.push_back(box);
    return;
  }
  for (unsigned part = 0; part < 1u << dimension; ++part) {
    Box child = box;
    for (unsigned k = 0; k < dimension; ++k) {
      const double middle = (box.low[k] + box.high[k]) / 2;
      ((part >> k & 1) != 0 ? child.low[k] : child.high[k]) = middle;
    }
    refine(child, dimension, levels - 1, share, random, out);
  }
}

/** Casts between random places end where they were to, in a cell that holds the place. */
inline void expect_no_walls(const dsw_environment* environment, const std::vector<Box>& boxes, unsigned dimension,
                            double side, std::mt19937_64& random) {
  for (int i = 0; i < 200; ++i) {
    Vec3 from{}, to{};
    for (unsigned k = 0; k < dimension; ++k) {
      from[k] = uniform(random, 0, side);
      // Also along planes, edges and through corners of cells.
      to[k] = random() % 3 == 0 ? std::floor(uniform(random, 0, 4 * side)) / 4 : uniform(random, 0, side);
      if (random() % 5 == 0) from[k] = std::floor(from[k] * 4) / 4;
      from[k] = std::max(from[k], 0x1p-20);
      to[k] = std::max(to[k], 0x1p-20);
    }
    dsw_flight flight;
    ASSERT_EQ(dsw_environment_cast(environment, {0, 0}, from.data(), to.data(), nullptr, &flight), DSW_STATUS_OK)
        << dsw_last_error_message();
    ASSERT_EQ(flight.outcome, DSW_OUTCOME_REACHED) << "from " << from[0] << " " << from[1] << " " << from[2];
    ASSERT_TRUE(boxes[flight.volume.index].holds(to, dimension));
  }
}

}  // namespace dsw::loose
