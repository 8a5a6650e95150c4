// Point sets that are hard for signs: every family of ties and near-ties at every scale that doubles have.
#pragma once

#include <cstdint>

#include "../../effort.h"

namespace dsw {

// splitmix64: the same stream everywhere, unlike the distributions of <random>.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed_of(seed)) {}

  std::uint64_t next() {
    state_ += 0x9e3779b97f4a7c15u;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  int below(int n) { return static_cast<int>(next() % static_cast<std::uint64_t>(n)); }
  int between(int low, int high) { return low + below(high - low + 1); }
  // In [-1, 1).
  double uniform() { return static_cast<double>(next() >> 11) * 0x1p-52 - 1; }

 private:
  std::uint64_t state_;
};

// How many cases of each family a test looks at.
inline std::uint64_t case_count() { return static_cast<std::uint64_t>(effort_of(40000)); }

constexpr int kMaxPoints = 8;

// Up to 8 points and the pointers to them. What the points mean (start, target, simplices) is up to the test.
template <int D>
struct PointSet {
  double x[kMaxPoints][D];
  const double* at[kMaxPoints];

  PointSet() {
    for (int i = 0; i < kMaxPoints; ++i) at[i] = x[i];
  }
  PointSet(const PointSet&) = delete;
  PointSet& operator=(const PointSet&) = delete;
};

enum class Shape { kUniform, kLattice, kCoplanar, kNudged, kShared, kMixed, kConcurrent, kSliver, kCount };
enum class Scale { kOne, kHundred, kThreeHundred, kDenormal, kOffset, kFlatAxis, kPerAxis, kTenths, kCount };

// Fills the first `count` points with a family; all finite.
template <int D>
void draw(Random& random, Shape shape, Scale scale, int count, PointSet<D>& points);

// A random family.
template <int D>
void draw(Random& random, int count, PointSet<D>& points);

}  // namespace dsw
