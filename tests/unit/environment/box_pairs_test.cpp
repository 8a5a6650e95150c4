#include "environment/box_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <vector>

#include "../../effort.h"

namespace dsw {
namespace {

template <int D>
ClosedBox<D> random_box(std::mt19937_64& random) {
  ClosedBox<D> box;
  double low[D], high[D];
  const double width = random() % 8 == 0 ? 8 : 1;
  for (int k = 0; k < D; ++k) {  // many boxes are flat, many meet at their sides
    low[k] = static_cast<double>(random() % 16);
    high[k] = low[k] + width * static_cast<double>(random() % 3);
  }
  box.add(low);
  box.add(high);
  return box;
}

template <int D>
bool makes_pair(const ClosedBox<D>& a, const ClosedBox<D>& b, double room) {
  int with_length = 0;
  for (int k = 0; k < D; ++k) {
    const double gap = std::max(a.lower[k] - b.upper[k], b.lower[k] - a.upper[k]);
    const double thin = std::min(a.upper[k] - a.lower[k], b.upper[k] - b.lower[k]);
    if (gap > room) return false;
    with_length += gap < room && (thin > 0 || room > 0) ? 1 : 0;
  }
  return with_length >= D - 1;
}

template <int D>
void expect_all_pairs_once(double room, size_t count, unsigned seed) {
  std::mt19937_64 random(seed_of(seed));
  std::vector<ClosedBox<D>> boxes;
  for (size_t i = 0; i < count; ++i) boxes.push_back(random_box<D>(random));
  std::set<std::pair<uint32_t, uint32_t>> expected, found;
  for (uint32_t i = 0; i < count; ++i) {
    for (uint32_t j = i + 1; j < count; ++j) {
      if (makes_pair(boxes[i], boxes[j], room)) expected.insert({i, j});
    }
  }
  const Memory memory;
  const auto box_of = [&](uint32_t i) -> const ClosedBox<D>& { return boxes[i]; };
  BoxPairs<D>(box_of, static_cast<uint32_t>(count), room, &memory).for_each([&](uint32_t i, uint32_t j) {
    EXPECT_LT(i, j);
    EXPECT_TRUE(found.insert({i, j}).second);
  });
  EXPECT_EQ(found, expected);
}

TEST(BoxPairsTest, AllPairsAreFoundOnce) {
  for (unsigned round = 0; round < static_cast<unsigned>(effort_of(20)); ++round) {
    for (const size_t count : {size_t{0}, size_t{1}, size_t{2}, size_t{4}, size_t{5}, size_t{17}, size_t{150}}) {
      expect_all_pairs_once<2>(round % 2 == 0 ? 0 : 0.5, count, 100 + round);
      expect_all_pairs_once<3>(round % 2 == 0 ? 0 : 0.5, count, 200 + round);
    }
  }
}

/** Widths of 0, of all doubles, and of one number for all: places along the curve are no numbers or all the same. */
TEST(BoxPairsTest, BoxesOfAnySizeAreFound) {
  const double widest = 1.7976931348623157e308, thinnest = 4.9406564584124654e-324;
  for (const double size : {0.0, thinnest, 1.0, widest}) {
    ClosedBox<3> boxes[6];
    for (int i = 0; i < 6; ++i) {
      const double low[3] = {-size, -size, 0}, high[3] = {size, size, 0};
      boxes[i].add(low);
      boxes[i].add(high);
    }
    const Memory memory;
    size_t count = 0;
    const auto box_of = [&](uint32_t i) -> const ClosedBox<3>& { return boxes[i]; };
    BoxPairs<3>(box_of, 6, 0, &memory).for_each([&](uint32_t, uint32_t) { ++count; });
    EXPECT_EQ(count, size > 0 ? 15u : 0u) << size;
  }
}

}  // namespace
}  // namespace dsw
