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

  void pass(const double* points, const Triangle* triangles, size_t count) noexcept {
    switch (shear_.k_) {
      case 0:
        return shear_.turned_ ? pass_along<2, 1, 0>(points, triangles, count)
                              : pass_along<1, 2, 0>(points, triangles, count);
      case 1:
        return shear_.turned_ ? pass_along<0, 2, 1>(points, triangles, count)
                              : pass_along<2, 0, 1>(points, triangles, count);
      default:
        return shear_.turned_ ? pass_along<1, 0, 2>(points, triangles, count)
                              : pass_along<0, 1, 2>(points, triangles, count);
    }
  }

 private:
  struct Points {
    __m256d i, j, most;  // most: the largest component before the shear
  };

  template <int I, int J, int K>
  void pass_along(const double* points, const Triangle* triangles, size_t count) noexcept {
    __m256d largest = _mm256_set1_pd(shear_.largest_), lowest = _mm256_set1_pd(shear_.lowest_);
    for (size_t n = 0; n < count; n += 4) {
      const Triangle* const four = triangles + std::min(n, count - 4);  // the last four may have been in part before
      const Points a = read<I, J, K>(points, four, 0), b = read<I, J, K>(points, four, 1),
                   c = read<I, J, K>(points, four, 2);
      largest = _mm256_max_pd(largest, _mm256_max_pd(_mm256_max_pd(a.most, b.most), c.most));
      lowest = _mm256_min_pd(lowest, _mm256_min_pd(_mm256_min_pd(side(a, b), side(b, c)), side(c, a)));
    }
    double all[4];
    _mm256_storeu_pd(all, largest);
    shear_.largest_ = *std::max_element(all, all + 4);
    _mm256_storeu_pd(all, lowest);
    shear_.lowest_ = *std::min_element(all, all + 4);
  }

  static __m256d side(const Points& a, const Points& b) noexcept {
    return _mm256_sub_pd(_mm256_mul_pd(a.i, b.j), _mm256_mul_pd(a.j, b.i));
  }

  /** One corner of each triangle. Masked, so that the last point of the host's array is not read past. */
  template <int I, int J, int K>
  Points read(const double* points, const Triangle* four, int corner) const noexcept {
    const __m256i mask = _mm256_setr_epi64x(-1, -1, -1, 0);
    const auto load = [&](int n) { return _mm256_maskload_pd(points + size_t{four[n].corners[corner]} * 3, mask); };
    const __m256d p = load(0), q = load(1), r = load(2), s = load(3);
    const __m256d pq = _mm256_unpacklo_pd(p, q), rs = _mm256_unpacklo_pd(r, s);
    const __m256d x[3] = {
        _mm256_permute2f128_pd(pq, rs, 0x20),
        _mm256_permute2f128_pd(_mm256_unpackhi_pd(p, q), _mm256_unpackhi_pd(r, s), 0x20),
        _mm256_permute2f128_pd(pq, rs, 0x31),
    };
    const __m256d a = _mm256_sub_pd(x[I], origin_[I]), b = _mm256_sub_pd(x[J], origin_[J]),
                  c = _mm256_sub_pd(x[K], origin_[K]);
    return {_mm256_sub_pd(a, _mm256_mul_pd(slope_i_, c)), _mm256_sub_pd(b, _mm256_mul_pd(slope_j_, c)),
            _mm256_max_pd(_mm256_max_pd(absolute(a), absolute(b)), absolute(c))};
  }
  static __m256d absolute(__m256d x) noexcept { return _mm256_andnot_pd(_mm256_set1_pd(-0.0), x); }

  Shear& shear_;
  __m256d origin_[3], slope_i_, slope_j_;
};

void pass_triangles_avx2(Shear& shear, const double* points, const Triangle* triangles, size_t count) noexcept {
  if (count < 4) return pass_triangles(shear, points, triangles, count);
  ShearLanes(shear).pass(points, triangles, count);
}

}  // namespace dsw

#if defined(__clang__)
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif

#endif
