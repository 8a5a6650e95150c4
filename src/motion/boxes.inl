// Hexahedra eight casts at a time, a lane for each, that are cut alike: for which of them the target lies inside of all triangles. That
// ends most casts; the others are looked at one by one, as box.inl does it.

constexpr uint32_t kBoxVertices = 8;

/** The vertices of eight hexahedra relative to their targets. */
struct EightBoxes {
  __m512d x[kBoxVertices], y[kBoxVertices], z[kBoxVertices], mx, my, mz;

  DSW_HOT EightBoxes(const double* points, const FlatBoxes& boxes) noexcept {
    constexpr uint32_t kLanes[4][2] = {{0, 2}, {1, 3}, {4, 6}, {5, 7}};  // makes the order below that of the boxes
    __m512d q[4];
#pragma GCC unroll 4
    for (uint32_t j = 0; j < 4; ++j) q[j] = load_two(boxes.q[kLanes[j][0]], boxes.q[kLanes[j][1]]);
    mx = my = mz = _mm512_setzero_pd();
#pragma GCC unroll 8
    for (uint32_t i = 0; i < kBoxVertices; ++i) {
      const auto at = [&](uint32_t lane) { return points + size_t{boxes.vertices[lane][i]} * 3; };
      __m512d pair[4];
#pragma GCC unroll 4
      for (uint32_t j = 0; j < 4; ++j) {
        pair[j] = _mm512_sub_pd(load_two(at(kLanes[j][0]), at(kLanes[j][1])), q[j]);
      }
      const __m512d xz0 = _mm512_unpacklo_pd(pair[0], pair[1]), y0 = _mm512_unpackhi_pd(pair[0], pair[1]);
      const __m512d xz4 = _mm512_unpacklo_pd(pair[2], pair[3]), y4 = _mm512_unpackhi_pd(pair[2], pair[3]);
      x[i] = _mm512_shuffle_f64x2(xz0, xz4, 0x88);
      y[i] = _mm512_shuffle_f64x2(y0, y4, 0x88);
      z[i] = _mm512_shuffle_f64x2(xz0, xz4, 0xdd);
      mx = _mm512_max_pd(mx, _mm512_abs_pd(x[i]));
      my = _mm512_max_pd(my, _mm512_abs_pd(y[i]));
      mz = _mm512_max_pd(mz, _mm512_abs_pd(z[i]));
    }
  }

  DSW_HOT __m512d dot(__m512d nx, __m512d ny, __m512d nz, uint32_t i) const noexcept {
    return _mm512_add_pd(_mm512_add_pd(_mm512_mul_pd(nx, x[i]), _mm512_mul_pd(ny, y[i])), _mm512_mul_pd(nz, z[i]));
  }
};

/** A bit for each box that certainly has its q inside. */
__attribute__((noinline)) inline uint32_t inside_boxes(const double* points, const FlatBoxes& boxes,
                                                       uint32_t cuts) noexcept {
  const EightBoxes v(points, boxes);
  __m512d first = _mm512_set1_pd(-HUGE_VAL), second = _mm512_set1_pd(HUGE_VAL);
  for (uint32_t f = 0; f < 6; ++f) {
    const uint32_t base = cuts >> f & 1u;  // the diagonal joins a and c
    const uint32_t a = kBoxFacets[f][base], b = kBoxFacets[f][base + 1], c = kBoxFacets[f][base + 2],
                   d = kBoxFacets[f][(base + 3) & 3u];
    const __m512d nx = _mm512_sub_pd(_mm512_mul_pd(v.y[a], v.z[c]), _mm512_mul_pd(v.z[a], v.y[c]));
    const __m512d ny = _mm512_sub_pd(_mm512_mul_pd(v.z[a], v.x[c]), _mm512_mul_pd(v.x[a], v.z[c]));
    const __m512d nz = _mm512_sub_pd(_mm512_mul_pd(v.x[a], v.y[c]), _mm512_mul_pd(v.y[a], v.x[c]));
    first = _mm512_max_pd(first, v.dot(nx, ny, nz, b));
    second = _mm512_min_pd(second, v.dot(nx, ny, nz, d));
  }
  const __m512d bound = _mm512_mul_pd(_mm512_mul_pd(_mm512_mul_pd(_mm512_set1_pd(kPlaneFilter3), v.mx), v.my), v.mz);
  const __m512d low = _mm512_min_pd(_mm512_min_pd(v.mx, v.my), v.mz),
                high = _mm512_max_pd(_mm512_max_pd(v.mx, v.my), v.mz);
  const __mmask8 in_range = _mm512_mask_cmp_pd_mask(_mm512_cmp_pd_mask(low, _mm512_set1_pd(kFilterMin), _CMP_GE_OQ),
                                                    high, _mm512_set1_pd(kFilterMax), _CMP_LE_OQ);
  const __mmask8 beside = _mm512_mask_cmp_pd_mask(in_range, second, bound, _CMP_GT_OQ);
  return _mm512_mask_cmp_pd_mask(beside, first, _mm512_sub_pd(_mm512_setzero_pd(), bound), _CMP_LT_OQ);
}
