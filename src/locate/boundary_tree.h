#pragma once
// The simplices of the outer boundary in a tree of turned boxes, made for one batch of questions. Each box lies along the
// mean normal of what it holds. A piece of a smooth surface is thin in such a box, so few boxes are as near as the nearest
// simplex, also where the point is far from the surface. Bounds are in single precision, with room for rounding. They only
// say what need not be looked at.

#include <algorithm>
#include <cmath>

#include "base/memory.h"
#include "base/nearest_first.h"
#include "base/vec.h"
#include "environment/environment.h"

namespace dsw {

/** A simplex of the outer boundary, oriented outwards. */
template <int D>
struct OuterSimplex {
  uint32_t vertices[D];
  HalfFacet facet;
};

template <int D>
class BoundaryTree {
 public:
  /** O(n log n) in the simplices. Throws std::bad_alloc. */
  explicit BoundaryTree(const Environment<D>& env);

  /** Calls look(simplex), which returns the largest distance that is of interest from then on, for each simplex that comes within
   * that of a point, and for others. Near ones come first as a rule. False, and nothing is called: these numbers are beyond
   * single precision. */
  template <class Look>
  bool visit_near(const double* point, Look&& look) const noexcept {
    float at[3] = {};
    double farthest = 0;
    for (int k = 0; k < D; ++k) {
      const double place = (point[k] - middle_[k]) * scale_;
      farthest += std::fabs(place);
      at[k] = static_cast<float>(place);
    }
    if (!(scale_ > 0 && farthest < kFarthest)) return false;
    const auto slack = static_cast<float>(kRoom * (1 + farthest));
    visit_nearest_first<kMostLevels>(
        static_cast<uint32_t>(level_count_), HUGE_VALF,
        [&](uint32_t level, uint32_t group, float* distances) {
          measure(groups_[level_first_[level] + group], at, distances);
        },
        [&](uint32_t leaf, float limit) {
          const size_t first = size_t{leaf} * kLeaf, end = std::min(first + kLeaf, simplices_.size());
          for (size_t i = first; i < end; ++i)
            limit = static_cast<float>(look(simplices_[i]) * scale_ * (1 + kRoom)) + slack;
          return limit;
        });
    return true;
  }
  /** Calls look(simplex) for all. */
  template <class Look>
  void for_each(Look&& look) const {
    for (const OuterSimplex<D>& each : simplices_) look(each);
  }

 private:
  static constexpr uint32_t kWidth = kBoxesInGroup, kLeaf = 4, kMostLevels = 11;
  static constexpr double kRoom = 0x1p-17, kFarthest = 1000;

  /** Eight boxes; one that is not used has a negative half. */
  struct Group {
    float middle[3][kWidth], axes[3][3][kWidth], halves[3][kWidth];
  };

  /** How far boxes are, less what rounding can add. */
  static void measure(const Group& group, const float* at, float* distances) noexcept {
    float squares[kWidth] = {};
    for (int a = 0; a < 3; ++a) {
      for (uint32_t i = 0; i < kWidth; ++i) {
        const float x = at[0] - group.middle[0][i], y = at[1] - group.middle[1][i], z = at[2] - group.middle[2][i];
        const float along = std::fabs(x * group.axes[a][0][i] + y * group.axes[a][1][i] + z * group.axes[a][2][i]);
        const float gap = std::max(along - group.halves[a][i], 0.0f);
        squares[i] += gap * gap;
      }
    }
    for (uint32_t i = 0; i < kWidth; ++i) distances[i] = group.halves[0][i] < 0 ? HUGE_VALF : std::sqrt(squares[i]);
  }
  void gather(const Environment<D>& env);
  void arrange(const Environment<D>& env);
  void enclose(const Environment<D>& env, size_t first, size_t end, Group& group, uint32_t lane) const;

  Array<OuterSimplex<D>> simplices_;
  Array<Group> groups_;  // level by level; of leaves, of groups, and so on
  size_t level_first_[kMostLevels + 1] = {}, level_count_ = 0;
  double middle_[D] = {}, scale_ = 0;  // of the numbers in groups
};

}  // namespace dsw
