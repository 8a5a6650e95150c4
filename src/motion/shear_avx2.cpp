// Four triangles side by side.

#include "motion/shear.h"

#if defined(__x86_64__)

#include <immintrin.h>

// The target holds for what is defined from here on, not for the headers above.
#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx2"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2")
#endif

namespace dsw {

class ShearLanes {
 public:
  explicit ShearLanes(Shear& shear) noexcept
      : shear_(shear), slope_i_(_mm256_set1_pd(shear.slope_i_)), slope_j_(_mm256_set1_pd(shear.slope_j_)) {
    for (int k = 0; k < 3; ++k) origin_[k] = _mm256_set1_pd(shear.p_[k]);
  }

  size_t pass(const TriangleRows& triangles) noexcept {
    switch (shear_.k_) {
      case 0:
        return shear_.turned_ ? pass_along<2, 1, 0>(triangles) : pass_along<1, 2, 0>(triangles);
      case 1:
        return shear_.turned_ ? pass_along<0, 2, 1>(triangles) : pass_along<2, 0, 1>(triangles);
      default:
        return shear_.turned_ ? pass_along<1, 0, 2>(triangles) : pass_along<0, 1, 2>(triangles);
    }
  }

 private:
  struct Points {
    __m256d i, j, most;  // most: the largest component before the shear
  };

  template <int I, int J, int K>
  size_t pass_along(const TriangleRows& triangles) noexcept {
    const size_t count = triangles.size();
    __m256d largest = _mm256_set1_pd(shear_.largest_), lowest = _mm256_set1_pd(shear_.lowest_);
    for (size_t next = 0; next < count; next += 4) {
      const size_t n = std::min(next, count - 4);  // the last four may have been passed in part
      const Points a = read<I, J, K>(triangles, 0, n), b = read<I, J, K>(triangles, 1, n),
                   c = read<I, J, K>(triangles, 2, n);
      const __m256d sides = _mm256_min_pd(_mm256_min_pd(side(a, b), side(b, c)), side(c, a));
      const int missed = _mm256_movemask_pd(_mm256_cmp_pd(sides, _mm256_setzero_pd(), _CMP_NGT_UQ));
      if (missed != 0) return n + static_cast<size_t>(__builtin_ctz(static_cast<unsigned>(missed)));
      largest = _mm256_max_pd(largest, _mm256_max_pd(_mm256_max_pd(a.most, b.most), c.most));
      lowest = _mm256_min_pd(lowest, sides);
    }
    double all[4];
    _mm256_storeu_pd(all, largest);
    shear_.largest_ = *std::max_element(all, all + 4);
    _mm256_storeu_pd(all, lowest);
    shear_.lowest_ = *std::min_element(all, all + 4);
    return count;
  }

  static __m256d side(const Points& a, const Points& b) noexcept {
    return _mm256_sub_pd(_mm256_mul_pd(a.i, b.j), _mm256_mul_pd(a.j, b.i));
  }

  /** One corner of each of four triangles. */
  template <int I, int J, int K>
  Points read(const TriangleRows& triangles, int corner, size_t n) const noexcept {
    const auto relative = [&](int axis) {
      return _mm256_sub_pd(_mm256_loadu_pd(triangles.row(corner, axis) + n), origin_[axis]);
    };
    const __m256d a = relative(I), b = relative(J), c = relative(K);
    return {_mm256_sub_pd(a, _mm256_mul_pd(slope_i_, c)), _mm256_sub_pd(b, _mm256_mul_pd(slope_j_, c)),
            _mm256_max_pd(_mm256_max_pd(absolute(a), absolute(b)), absolute(c))};
  }
  static __m256d absolute(__m256d x) noexcept { return _mm256_andnot_pd(_mm256_set1_pd(-0.0), x); }

  Shear& shear_;
  __m256d origin_[3], slope_i_, slope_j_;
};

size_t pass_triangles_avx2(Shear& shear, const TriangleRows& triangles) noexcept {
  return triangles.size() < 4 ? pass_triangles(shear, triangles) : ShearLanes(shear).pass(triangles);
}

}  // namespace dsw

#if defined(__clang__)
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif

#endif
