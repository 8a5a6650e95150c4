// Pairs of boxes beside a comparison of every two.
#include "together/box_sweep.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "scenes/random.h"

namespace dsw {
namespace {

using Pairs = std::vector<std::pair<uint32_t, uint32_t>>;

template <int D>
Array<Box<D>> random_boxes(scenes::Random& random, size_t count, double scale, int kind) {
  Array<Box<D>> boxes;
  for (size_t i = 0; i < count; ++i) {
    double low[D], high[D];
    const double most = kind == 2 && i % 10 == 0 ? 1 : 0.05;
    for (int k = 0; k < D; ++k) {
      const double x = kind == 1 ? static_cast<double>(random.index(6)) / 4 : random.uniform(-1, 1);
      low[k] = scale * (kind == 3 && k == 0 ? 0 : x);
      high[k] = low[k] + scale * (kind == 1 ? 0.25 * static_cast<double>(random.index(2)) : random.uniform(0, most));
    }
    boxes.push_back({});
    boxes.back().add(low);
    boxes.back().add(high);
  }
  return boxes;
}

template <int D>
void check(BoxSweep<D>& sweep, const Array<Box<D>>& a, const Array<Box<D>>& b) {
  Pairs own, own_found, between, found;
  for (uint32_t i = 0; i < a.size(); ++i) {
    for (uint32_t k = i + 1; k < a.size(); ++k) {
      if (a[i].overlaps(a[k])) own.emplace_back(i, k);
    }
    for (uint32_t k = 0; k < b.size(); ++k) {
      if (a[i].overlaps(b[k])) between.emplace_back(i, k);
    }
  }
  sweep.visit_own(a, [&](uint32_t i, uint32_t k) {
    if (a[i].overlaps(a[k])) own_found.emplace_back(std::min(i, k), std::max(i, k));
  });
  sweep.visit_between(a, b, [&](uint32_t i, uint32_t k) {
    if (a[i].overlaps(b[k])) found.emplace_back(i, k);
  });
  std::sort(own_found.begin(), own_found.end());
  std::sort(found.begin(), found.end());
  EXPECT_EQ(own_found, own);
  EXPECT_EQ(found, between);
}

template <int D>
void check_all() {
  BoxSweep<D> sweep(nullptr);
  scenes::Random random(52);
  for (const double scale : {1.0, 0x1p-1040, 1e308}) {
    for (int kind = 0; kind < 4; ++kind) {
      for (const size_t count : {size_t{0}, size_t{1}, size_t{7}, size_t{400}}) {
        SCOPED_TRACE(std::to_string(scale) + " " + std::to_string(kind) + " " + std::to_string(count));
        check(sweep, random_boxes<D>(random, count, scale, kind), random_boxes<D>(random, count / 2 + 1, scale, kind));
      }
    }
  }
}

TEST(BoxSweep, FindsEveryPairOnceInSpace) { check_all<3>(); }
TEST(BoxSweep, FindsEveryPairOnceInThePlane) { check_all<2>(); }

}  // namespace
}  // namespace dsw
