// Flat boxes eight casts at a time, a lane for each: the planes of box.inl bit for bit, but a cross product serves both facets
// at its edge, and what is left of the work for one cast are its loads.

struct FlatBoxes {
  const uint32_t* vertices[kAbreast];
  const double* q[kAbreast];
};

/** For each box the facets with its q outside, and whether the filter settled all six. */
struct FlatBoxSides {
  uint8_t outside[kAbreast];
  uint32_t settled;  // a bit for each box

  void look(const double* points, const FlatBoxes& boxes) noexcept;
};

/** Two points in the halves of a register. Masked, so that the last point of the host's array is not read past. */
inline __m512d load_two(const double* a, const double* b) noexcept {
  return _mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_maskz_loadu_pd(7, a)), _mm256_maskz_loadu_pd(7, b), 1);
}

/** The vertices 1 2 3 7 4 5 relative to q: three in a row, the ring closed, span a facet. */
struct RingPlanes {
  __m512d x[6], y[6], z[6], bound, minus_bound, least;
  __m256i outside;

  DSW_HOT void test(__m512d cx, __m512d cy, __m512d cz, uint32_t r, uint32_t facet) noexcept {
    const __m512d det = _mm512_add_pd(_mm512_add_pd(_mm512_mul_pd(cx, x[r]), _mm512_mul_pd(cy, y[r])),  //
                                      _mm512_mul_pd(cz, z[r]));
    const __mmask8 out =
        facet % 2 == 0 ? _mm512_cmp_pd_mask(det, bound, _CMP_GT_OQ) : _mm512_cmp_pd_mask(det, minus_bound, _CMP_LT_OQ);
    outside = _mm256_mask_or_epi32(outside, out, outside, _mm256_set1_epi32(1 << facet));
    least = _mm512_min_pd(least, _mm512_abs_pd(det));
  }

  /** The two facets at the edge from a to the next: with the vertex after, an even one; with the vertex before, an odd one. */
  DSW_HOT void test_beside(uint32_t a, uint32_t even, uint32_t odd) noexcept {
    const uint32_t b = a + 1;
    const __m512d cx = _mm512_sub_pd(_mm512_mul_pd(y[a], z[b]), _mm512_mul_pd(z[a], y[b]));
    const __m512d cy = _mm512_sub_pd(_mm512_mul_pd(z[a], x[b]), _mm512_mul_pd(x[a], z[b]));
    const __m512d cz = _mm512_sub_pd(_mm512_mul_pd(x[a], y[b]), _mm512_mul_pd(y[a], x[b]));
    test(cx, cy, cz, (a + 2) % 6, even);
    test(cx, cy, cz, (a + 5) % 6, odd);
  }
};

__attribute__((noinline)) inline void FlatBoxSides::look(const double* points, const FlatBoxes& boxes) noexcept {
  constexpr uint32_t kRing[6] = {1, 2, 3, 7, 4, 5};
  constexpr uint32_t kLanes[4][2] = {{0, 2}, {1, 3}, {4, 6}, {5, 7}};  // makes the order below that of the boxes
  __m512d pairs[4][6];
#pragma GCC unroll 4
  for (uint32_t j = 0; j < 4; ++j) {
    const uint32_t l = kLanes[j][0], m = kLanes[j][1];
    const __m512d q = load_two(boxes.q[l], boxes.q[m]);
#pragma GCC unroll 6
    for (uint32_t r = 0; r < 6; ++r) {
      const double* const a = points + size_t{boxes.vertices[l][kRing[r]]} * 3;
      const double* const b = points + size_t{boxes.vertices[m][kRing[r]]} * 3;
      pairs[j][r] = _mm512_sub_pd(load_two(a, b), q);
    }
  }
  RingPlanes ring;
  __m512d mx = _mm512_setzero_pd(), my = mx, mz = mx;
#pragma GCC unroll 6
  for (uint32_t r = 0; r < 6; ++r) {
    const __m512d xz0 = _mm512_unpacklo_pd(pairs[0][r], pairs[1][r]), y0 = _mm512_unpackhi_pd(pairs[0][r], pairs[1][r]);
    const __m512d xz4 = _mm512_unpacklo_pd(pairs[2][r], pairs[3][r]), y4 = _mm512_unpackhi_pd(pairs[2][r], pairs[3][r]);
    ring.x[r] = _mm512_shuffle_f64x2(xz0, xz4, 0x88);
    ring.y[r] = _mm512_shuffle_f64x2(y0, y4, 0x88);
    ring.z[r] = _mm512_shuffle_f64x2(xz0, xz4, 0xdd);
    mx = _mm512_max_pd(mx, _mm512_abs_pd(ring.x[r]));
    my = _mm512_max_pd(my, _mm512_abs_pd(ring.y[r]));
    mz = _mm512_max_pd(mz, _mm512_abs_pd(ring.z[r]));
  }
  ring.bound = _mm512_mul_pd(_mm512_mul_pd(_mm512_mul_pd(_mm512_set1_pd(kPlaneFilter3), mx), my), mz);
  ring.minus_bound = _mm512_sub_pd(_mm512_setzero_pd(), ring.bound);
  ring.least = _mm512_set1_pd(HUGE_VAL);
  ring.outside = _mm256_setzero_si256();
  ring.test_beside(0, 4, 1);
  ring.test_beside(2, 0, 3);
  ring.test_beside(4, 2, 5);
  const __m512d low = _mm512_min_pd(_mm512_min_pd(mx, my), mz), high = _mm512_max_pd(_mm512_max_pd(mx, my), mz);
  const __mmask8 in_range = _mm512_mask_cmp_pd_mask(_mm512_cmp_pd_mask(low, _mm512_set1_pd(kFilterMin), _CMP_GE_OQ),
                                                    high, _mm512_set1_pd(kFilterMax), _CMP_LE_OQ);
  settled = _mm512_mask_cmp_pd_mask(in_range, ring.least, ring.bound, _CMP_GT_OQ);
  _mm_storel_epi64(reinterpret_cast<__m128i*>(outside), _mm256_cvtepi32_epi8(ring.outside));
}
