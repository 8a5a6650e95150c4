// Six doubles side by side, one for each facet of a hexahedron: the same operations in the same order on every
// instruction set, so the bits are the same. Included once for each instruction set, inside a namespace of its own.
// (Operators are not friends defined in the class, because GCC compiles those for the wrong target.)

/** Largest |component| on every axis over the vectors that meet in the determinants of a cell. */
struct Extent {
  double x, y, z;

  /** Whether bound() holds. */
  bool in_range() const noexcept {
    const double least = std::min(std::min(x, y), z), largest = std::max(std::max(x, y), z);
    return (least >= kFilterMin) & (largest <= kFilterMax);
  }
  double bound() const noexcept { return kPlaneFilter3 * x * y * z; }
};

#if defined(DSW_ISA_AVX512)

/** One 512-bit register. For six facets the last two lanes are idle: they hold one point, so all signs there are 0. */
struct Lanes {
  using Mask = unsigned;
  __m512d v;

  static Lanes all(double a) noexcept { return {_mm512_set1_pd(a)}; }
  static Lanes absolute(Lanes a) noexcept { return {_mm512_abs_pd(a.v)}; }
  static Mask greater(Lanes a, Lanes b) noexcept { return _mm512_cmp_pd_mask(a.v, b.v, _CMP_GT_OQ); }
  static Mask spread(uint32_t bits) noexcept { return bits; }
  static uint32_t bits(Mask m) noexcept { return m; }
  static Mask both(Mask m, Mask n) noexcept { return m & n; }
  static Mask either(Mask m, Mask n) noexcept { return m | n; }
  static Mask without(Mask m, Mask n) noexcept { return m & ~n; }
  static Lanes select(Mask m, Lanes yes, Lanes no) noexcept {
    return {_mm512_mask_blend_pd(static_cast<__mmask8>(m), no.v, yes.v)};
  }
};

inline Lanes operator+(Lanes a, Lanes b) noexcept { return {_mm512_add_pd(a.v, b.v)}; }
inline Lanes operator-(Lanes a, Lanes b) noexcept { return {_mm512_sub_pd(a.v, b.v)}; }
inline Lanes operator*(Lanes a, Lanes b) noexcept { return {_mm512_mul_pd(a.v, b.v)}; }

/** Takes the larger extent of two points that stand side by side, component by component. */
inline Extent larger_extent(__m512d m) noexcept {
  const __m256d half = _mm256_max_pd(_mm512_castpd512_pd256(m), _mm512_extractf64x4_pd(m, 1));
  const __m128d xy = _mm256_castpd256_pd128(half);
  return {_mm_cvtsd_f64(xy), _mm_cvtsd_f64(_mm_unpackhi_pd(xy, xy)), _mm_cvtsd_f64(_mm256_extractf128_pd(half, 1))};
}

/** Loads two vertices relative to a point. Masked, so that the last point of the host's array is not read past. */
struct PairLoader {
  const double* points;
  const uint32_t* vertices;
  __m512d origin;

  PairLoader(const double* all, const uint32_t* indices, const double* q) noexcept
      : points(all), vertices(indices), origin(_mm512_broadcast_f64x4(_mm256_maskz_loadu_pd(7, q))) {}
  __m256d load(uint32_t i) const noexcept { return _mm256_maskz_loadu_pd(7, points + size_t{vertices[i]} * 3); }
  __m512d operator()(uint32_t i, uint32_t j) const noexcept {
    return _mm512_sub_pd(_mm512_insertf64x4(_mm512_castpd256_pd512(load(i)), load(j), 1), origin);
  }
};

/** The six vertices that kFlatFacets needs, relative to a point. */
struct FlatBoxVertices {
  Extent extent;
  __m512d xz, y, v57;  // x1 x3 z1 z3 x2 x4 z2 z4; y1 y3 . . y2 y4 . .; vertices 5 and 7

  FlatBoxVertices(const double* points, const uint32_t* vertices, const double* q) noexcept {
    const PairLoader both(points, vertices, q);
    const __m512d v12 = both(1, 2), v34 = both(3, 4);
    v57 = both(5, 7);
    extent = larger_extent(_mm512_max_pd(_mm512_max_pd(_mm512_abs_pd(v12), _mm512_abs_pd(v34)), _mm512_abs_pd(v57)));
    xz = _mm512_unpacklo_pd(v12, v34);
    y = _mm512_unpackhi_pd(v12, v34);
  }

  template <int K>
  Lanes corner(int k) const noexcept {
    constexpr int x[8] = {0, 0, 4, 1, 5, 8, 0, 12};  // where a vertex's x stands; y there or one place on, z two
    const auto at = [&](int f) {
      const int v = kFlatFacets[K][f];
      return x[v] + (k == 2 ? 2 : k == 1 && v >= 5 ? 1 : 0);
    };
    const __m512i index = _mm512_setr_epi64(at(0), at(1), at(2), at(3), at(4), at(5), 0, 0);
    return {_mm512_permutex2var_pd(k == 1 ? y : xz, index, v57)};
  }
};

/** The vertices of a hexahedron relative to a point, two in the halves of a register, then paired so that one
 * permutation of two registers takes any corner of all facets out of them. */
struct BoxVertices {
  Extent extent;
  __m512d xz[2], y[2];  // x0 x1 z0 z1 x4 x5 z4 z5 and the same of 2 3 6 7; y0 y1 . . y4 y5 . . likewise

  BoxVertices(const double* points, const uint32_t* vertices, const double* q) noexcept {
    const PairLoader both(points, vertices, q);
    const __m512d v04 = both(0, 4), v15 = both(1, 5), v26 = both(2, 6), v37 = both(3, 7);
    extent = larger_extent(_mm512_max_pd(_mm512_max_pd(_mm512_abs_pd(v04), _mm512_abs_pd(v15)),
                                         _mm512_max_pd(_mm512_abs_pd(v26), _mm512_abs_pd(v37))));
    xz[0] = _mm512_unpacklo_pd(v04, v15);
    xz[1] = _mm512_unpacklo_pd(v26, v37);
    y[0] = _mm512_unpackhi_pd(v04, v15);
    y[1] = _mm512_unpackhi_pd(v26, v37);
  }

  /** Loop position K of all facets on axis k. */
  template <int K>
  Lanes corner(int k) const noexcept {
    constexpr int x[8] = {0, 1, 8, 9, 4, 5, 12, 13};  // where a vertex's x and y stand; z two places on
    const int shift = k == 2 ? 2 : 0;
    const auto at = [&](int f) { return x[kBoxFacets[f][K]] + shift; };
    const __m512i index = _mm512_setr_epi64(at(0), at(1), at(2), at(3), at(4), at(5), 0, 0);
    const __m512d* const pair = k == 1 ? y : xz;
    return {_mm512_permutex2var_pd(pair[0], index, pair[1])};
  }
};

#else

#if defined(DSW_ISA_AVX2)

/** A 256-bit register for facets 0 to 3 and a 128-bit one for 4 and 5. */
struct Lanes {
  struct Mask {
    __m256d a;
    __m128d b;
  };
  __m256d a;
  __m128d b;

  static Lanes all(double x) noexcept { return {_mm256_set1_pd(x), _mm_set1_pd(x)}; }
  static Lanes absolute(Lanes x) noexcept {
    return {_mm256_andnot_pd(_mm256_set1_pd(-0.0), x.a), _mm_andnot_pd(_mm_set1_pd(-0.0), x.b)};
  }
  static Mask greater(Lanes x, Lanes y) noexcept {
    return {_mm256_cmp_pd(x.a, y.a, _CMP_GT_OQ), _mm_cmp_pd(x.b, y.b, _CMP_GT_OQ)};
  }
  static Mask spread(uint32_t bits) noexcept {
    const __m256i each = _mm256_and_si256(_mm256_set1_epi64x(bits), _mm256_setr_epi64x(1, 2, 4, 8));
    const __m128i last = _mm_and_si128(_mm_set1_epi64x(bits), _mm_set_epi64x(32, 16));
    return {_mm256_castsi256_pd(_mm256_cmpeq_epi64(each, _mm256_setr_epi64x(1, 2, 4, 8))),
            _mm_castsi128_pd(_mm_cmpeq_epi64(last, _mm_set_epi64x(32, 16)))};
  }
  static uint32_t bits(Mask m) noexcept {
    return static_cast<uint32_t>(_mm256_movemask_pd(m.a)) | static_cast<uint32_t>(_mm_movemask_pd(m.b)) << 4;
  }
  static Mask both(Mask m, Mask n) noexcept { return {_mm256_and_pd(m.a, n.a), _mm_and_pd(m.b, n.b)}; }
  static Mask either(Mask m, Mask n) noexcept { return {_mm256_or_pd(m.a, n.a), _mm_or_pd(m.b, n.b)}; }
  static Mask without(Mask m, Mask n) noexcept { return {_mm256_andnot_pd(n.a, m.a), _mm_andnot_pd(n.b, m.b)}; }
  static Lanes select(Mask m, Lanes yes, Lanes no) noexcept {
    return {_mm256_blendv_pd(no.a, yes.a, m.a), _mm_blendv_pd(no.b, yes.b, m.b)};
  }
};

inline Lanes operator+(Lanes x, Lanes y) noexcept { return {_mm256_add_pd(x.a, y.a), _mm_add_pd(x.b, y.b)}; }
inline Lanes operator-(Lanes x, Lanes y) noexcept { return {_mm256_sub_pd(x.a, y.a), _mm_sub_pd(x.b, y.b)}; }
inline Lanes operator*(Lanes x, Lanes y) noexcept { return {_mm256_mul_pd(x.a, y.a), _mm_mul_pd(x.b, y.b)}; }

#else

/** Three pairs, which any machine of today has. */
struct Lanes {
  using Pair = DoublePair;
  struct Mask {
    PairMask a, b, c;
  };
  Pair a, b, c;

  static Pair choose(PairMask m, Pair yes, Pair no) noexcept {
    return pair_of((bits_of(yes) & m) | (bits_of(no) & ~m));
  }
  static Lanes all(double x) noexcept { return {Pair{x, x}, Pair{x, x}, Pair{x, x}}; }
  static Mask greater(const Lanes& x, const Lanes& y) noexcept { return {x.a > y.a, x.b > y.b, x.c > y.c}; }
  static Lanes select(const Mask& m, const Lanes& yes, const Lanes& no) noexcept {
    return {choose(m.a, yes.a, no.a), choose(m.b, yes.b, no.b), choose(m.c, yes.c, no.c)};
  }
  static Lanes absolute(const Lanes& x) noexcept {
    const PairMask rest = {INT64_MAX, INT64_MAX};
    return {pair_of(bits_of(x.a) & rest), pair_of(bits_of(x.b) & rest), pair_of(bits_of(x.c) & rest)};
  }
  static Mask spread(uint32_t bits) noexcept {
    const auto lane = [&](uint32_t i) { return -static_cast<int64_t>(bits >> i & 1u); };
    return {PairMask{lane(0), lane(1)}, PairMask{lane(2), lane(3)}, PairMask{lane(4), lane(5)}};
  }
  static uint32_t bits(const Mask& m) noexcept {
    const auto pair = [](PairMask p) { return static_cast<uint32_t>((p[0] & 1) | (p[1] & 2)); };
    return pair(m.a) | pair(m.b) << 2 | pair(m.c) << 4;
  }
  static Mask both(const Mask& m, const Mask& n) noexcept { return {m.a & n.a, m.b & n.b, m.c & n.c}; }
  static Mask either(const Mask& m, const Mask& n) noexcept { return {m.a | n.a, m.b | n.b, m.c | n.c}; }
  static Mask without(const Mask& m, const Mask& n) noexcept { return {m.a & ~n.a, m.b & ~n.b, m.c & ~n.c}; }
};

inline Lanes operator+(const Lanes& x, const Lanes& y) noexcept { return {x.a + y.a, x.b + y.b, x.c + y.c}; }
inline Lanes operator-(const Lanes& x, const Lanes& y) noexcept { return {x.a - y.a, x.b - y.b, x.c - y.c}; }
inline Lanes operator*(const Lanes& x, const Lanes& y) noexcept { return {x.a * y.a, x.b * y.b, x.c * y.c}; }

#endif

/** One coordinate of six vertices, a lane each. */
inline Lanes gather(const double* const* p, const uint8_t (&at)[6], int k) noexcept {
#if defined(DSW_ISA_AVX2)
  return {_mm256_setr_pd(p[at[0]][k], p[at[1]][k], p[at[2]][k], p[at[3]][k]), _mm_setr_pd(p[at[4]][k], p[at[5]][k])};
#else
  return {Lanes::Pair{p[at[0]][k], p[at[1]][k]}, Lanes::Pair{p[at[2]][k], p[at[3]][k]},
          Lanes::Pair{p[at[4]][k], p[at[5]][k]}};
#endif
}

constexpr uint8_t kBoxCorners[4][6] = {{0, 1, 0, 3, 0, 4}, {4, 2, 1, 7, 3, 5}, {7, 6, 5, 6, 2, 6}, {3, 5, 4, 2, 1, 7}};

/** The vertices of a hexahedron relative to a point. */
template <bool Flat>
struct RelativeVertices {
  Extent extent;
  const double* p[8];
  const double* q;

  RelativeVertices(const double* points, const uint32_t* vertices, const double* origin) noexcept
      : extent{0, 0, 0}, q(origin) {
    for (uint32_t i = 0; i < 8; ++i) {
      if (Flat && (i == 0 || i == 6)) continue;
      p[i] = points + size_t{vertices[i]} * 3;
      extent = {std::max(extent.x, std::fabs(p[i][0] - q[0])), std::max(extent.y, std::fabs(p[i][1] - q[1])),
                std::max(extent.z, std::fabs(p[i][2] - q[2]))};
    }
  }

  template <int K>
  Lanes corner(int k) const noexcept {
    if constexpr (Flat) return gather(p, kFlatFacets[K], k) - Lanes::all(q[k]);
    return gather(p, kBoxCorners[K], k) - Lanes::all(q[k]);
  }
};
using BoxVertices = RelativeVertices<false>;
using FlatBoxVertices = RelativeVertices<true>;

#endif
