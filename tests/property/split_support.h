#pragma once
// Cells of any type, and what parts of them have to be: exact sums of sizes, labels, parents.

#include <gtest/gtest.h>
#include "../gmp_numbers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <map>
#include <memory>
#include <numeric>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "../effort.h"
#include "cells.h"

namespace dsw {

using Exact3 = std::array<mpq_class, 3>;

inline Exact3 exact(const double* p, unsigned dimension) {
  Exact3 q;
  for (unsigned k = 0; k < dimension; ++k) q[k] = p[k];
  return q;
}

inline mpq_class determinant(const Exact3& a, const Exact3& b, const Exact3& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/** Twice the area of a loop of the plane. */
inline mpq_class area(const std::vector<Exact3>& loop) {
  mpq_class sum = 0;
  for (size_t k = 0; k < loop.size(); ++k) {
    const Exact3 &p = loop[k], &q = loop[(k + 1) % loop.size()];
    sum += p[0] * q[1] - p[1] * q[0];
  }
  return sum;
}

inline dsw_volume_id volume_at(const dsw_environment* environment, uint32_t index) {
  dsw_volume_id id;
  EXPECT_EQ(dsw_environment_get_volume_id(environment, index, &id), DSW_STATUS_OK);
  return id;
}

inline std::vector<Exact3> corners_of(const dsw_environment* environment, const dsw_cell& cell, unsigned dimension) {
  std::vector<dsw_vertex_id> vertices(4096);
  size_t count = 0;
  EXPECT_EQ(dsw_environment_copy_vertices(environment, cell, vertices.data(), vertices.size(), &count), DSW_STATUS_OK)
      << dsw_last_error_message();
  std::vector<Exact3> corners;
  for (size_t k = 0; k < count; ++k) {
    double p[3];
    EXPECT_EQ(dsw_environment_get_vertex_position(environment, vertices[k], p), DSW_STATUS_OK);
    corners.push_back(exact(p, dimension));
  }
  return corners;
}

/** Six times the volume, or twice the area, of a part all of whose faces are flat. */
inline mpq_class size_of(const dsw_environment* environment, uint32_t index, unsigned dimension) {
  const dsw_volume_id volume = volume_at(environment, index);
  if (dimension == 2) {
    dsw_cell cell{};
    cell.kind = DSW_CELL_VOLUME;
    cell.index = volume.index;
    cell.generation = volume.generation;
    return area(corners_of(environment, cell, 2));
  }
  uint32_t faces = 0;
  EXPECT_EQ(dsw_environment_get_volume_counts(environment, volume, nullptr, nullptr, nullptr, &faces), DSW_STATUS_OK);
  mpq_class sum = 0;
  for (uint32_t f = 0; f < faces; ++f) {
    dsw_face_id face;
    dsw_volume_id near_side, far_side;
    EXPECT_EQ(dsw_environment_get_face_id(environment, volume, f, &face), DSW_STATUS_OK);
    EXPECT_EQ(dsw_environment_get_face_volumes(environment, face, &near_side, &far_side), DSW_STATUS_OK);
    dsw_cell cell{};
    cell.kind = DSW_CELL_FACE;
    cell.index = face.volume;
    cell.generation = face.generation;
    cell.local = face.local;
    const std::vector<Exact3> loop = corners_of(environment, cell, 3);
    mpq_class part = 0;
    for (size_t k = 1; k + 1 < loop.size(); ++k) part += determinant(loop[0], loop[k], loop[k + 1]);
    sum += near_side.index == volume.index ? part : mpq_class(-part);
  }
  return sum;
}

inline uint32_t volume_count(const dsw_environment* environment) {
  dsw_environment_info info;
  info.struct_size = sizeof info;
  EXPECT_EQ(dsw_environment_get_info(environment, &info), DSW_STATUS_OK);
  return info.volume_count;
}

inline uint32_t parent_of(const dsw_environment* environment, uint32_t index) {
  uint32_t parent = 0xdeadu;
  EXPECT_EQ(dsw_environment_get_parent(environment, volume_at(environment, index), &parent), DSW_STATUS_OK);
  return parent;
}

/** Parts have the labels of their parent, the first part its index, and together its size. */
inline void expect_parts(const dsw_environment* environment, const Cells& cells, const std::vector<mpq_class>& sizes) {
  ASSERT_NE(environment, nullptr) << dsw_last_error_message();
  ASSERT_EQ(dsw_environment_check(environment, nullptr), DSW_STATUS_OK) << dsw_last_error_message();
  std::vector<mpq_class> sums(sizes.size(), 0);
  for (uint32_t i = 0; i < volume_count(environment); ++i) {
    const uint32_t parent = parent_of(environment, i);
    ASSERT_LT(parent, cells.types.size());
    ASSERT_TRUE(i >= cells.types.size() || parent == i);
    int32_t region;
    uint32_t tag;
    ASSERT_EQ(dsw_environment_get_region(environment, volume_at(environment, i), &region), DSW_STATUS_OK);
    ASSERT_EQ(dsw_environment_get_tag(environment, volume_at(environment, i), &tag), DSW_STATUS_OK);
    EXPECT_EQ(region, cells.regions[parent]);
    EXPECT_EQ(tag, cells.tags[parent]);
    const mpq_class size = size_of(environment, i, cells.dimension);
    EXPECT_GT(size, 0);
    sums[parent] += size;
  }
  for (size_t i = 0; i < sizes.size(); ++i) EXPECT_EQ(sums[i], sizes[i]) << "cell " << i;
}

}  // namespace dsw
