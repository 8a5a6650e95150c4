// What tests of the walk keep and compare of casts.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "walk/cast.h"

namespace dsw::testing_walk {

struct Crossing {
  uint32_t from, simplex, to;
  bool operator==(const Crossing& o) const { return from == o.from && simplex == o.simplex && to == o.to; }
};

/** A CrossingFn that appends to a vector of crossings. */
inline void note(void* user, Cell from, uint32_t simplex, Cell to) {
  static_cast<std::vector<Crossing>*>(user)->push_back({from.unit, simplex, to.unit});
}

inline void expect_same(const CastResult& a, const CastResult& b) {
  EXPECT_EQ(a.end, b.end);
  EXPECT_EQ(a.cell, b.cell);
  EXPECT_EQ(a.facet, b.facet);
  EXPECT_EQ(a.simplex, b.simplex);
  EXPECT_EQ(a.previous, b.previous);
  EXPECT_EQ(a.volumes_visited, b.volumes_visited);
  EXPECT_EQ(a.first_facet, b.first_facet);
}

}  // namespace dsw::testing_walk
