// Six doubles side by side, one for each facet of a hexahedron: the same operations in the same order on every instruction
// set, so the bits are the same. Included once for each instruction set, inside a namespace of its own. (Operators are
// not friends defined in the class, because GCC compiles those for the wrong target.)

#if defined(DSW_ISA_AVX512)

/** One 512-bit register; the last two lanes are idle. */
struct Lanes {
  using Mask = unsigned;
  __m512d v;

  static Lanes all(double a) noexcept { return {_mm512_set1_pd(a)}; }
  static Lanes absolute(Lanes a) noexcept { return {_mm512_abs_pd(a.v)}; }
  static Lanes larger(Lanes a, Lanes b) noexcept { return {_mm512_max_pd(a.v, b.v)}; }
  static Lanes smaller(Lanes a, Lanes b) noexcept { return {_mm512_min_pd(a.v, b.v)}; }
  static Mask greater(Lanes a, Lanes b) noexcept { return _mm512_cmp_pd_mask(a.v, b.v, _CMP_GT_OQ); }
  static Mask spread(uint32_t bits) noexcept { return bits; }
  static uint32_t bits(Mask m) noexcept { return m & 0x3fu; }
  static Lanes select(Mask m, Lanes yes, Lanes no) noexcept {
    return {_mm512_mask_blend_pd(static_cast<__mmask8>(m), no.v, yes.v)};
  }
};

inline Lanes operator+(Lanes a, Lanes b) noexcept { return {_mm512_add_pd(a.v, b.v)}; }
inline Lanes operator-(Lanes a, Lanes b) noexcept { return {_mm512_sub_pd(a.v, b.v)}; }
inline Lanes operator*(Lanes a, Lanes b) noexcept { return {_mm512_mul_pd(a.v, b.v)}; }

/** The vertices of a hexahedron relative to a point, eight lanes an axis. */
struct BoxVertices {
  __m512d axis[3];

  BoxVertices(const double* points, const uint32_t* vertices, const double* q) noexcept {
    const double* const p[8] = {points + size_t{vertices[0]} * 3, points + size_t{vertices[1]} * 3,
                                points + size_t{vertices[2]} * 3, points + size_t{vertices[3]} * 3,
                                points + size_t{vertices[4]} * 3, points + size_t{vertices[5]} * 3,
                                points + size_t{vertices[6]} * 3, points + size_t{vertices[7]} * 3};
    const auto xy = [&](int a, int b) {
      return _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_loadu_pd(p[a])), _mm_loadu_pd(p[b]), 1);
    };
    const auto z = [&](int a) { return _mm_loadh_pd(_mm_load_sd(p[a] + 2), p[a + 1] + 2); };
    const auto zz = [&](int a) { return _mm256_insertf128_pd(_mm256_castpd128_pd256(z(a)), z(a + 2), 1); };
    const __m512d even = _mm512_insertf64x4(_mm512_castpd256_pd512(xy(0, 2)), xy(4, 6), 1);
    const __m512d odd = _mm512_insertf64x4(_mm512_castpd256_pd512(xy(1, 3)), xy(5, 7), 1);
    axis[0] = _mm512_sub_pd(_mm512_unpacklo_pd(even, odd), _mm512_set1_pd(q[0]));
    axis[1] = _mm512_sub_pd(_mm512_unpackhi_pd(even, odd), _mm512_set1_pd(q[1]));
    axis[2] = _mm512_sub_pd(_mm512_insertf64x4(_mm512_castpd256_pd512(zz(0)), zz(4), 1), _mm512_set1_pd(q[2]));
  }

  /** Loop position k of all facets. */
  template <int K>
  Lanes corner(int k) const noexcept {
    const __m512i index = K == 0   ? _mm512_setr_epi64(0, 1, 0, 3, 0, 4, 0, 0)
                          : K == 1 ? _mm512_setr_epi64(4, 2, 1, 7, 3, 5, 0, 0)
                          : K == 2 ? _mm512_setr_epi64(7, 6, 5, 6, 2, 6, 0, 0)
                                   : _mm512_setr_epi64(3, 5, 4, 2, 1, 7, 0, 0);
    return {_mm512_permutexvar_pd(index, axis[k])};
  }
};

#else

/** Loads corner K of every facet for one axis: positions of kBoxFacets. */
template <int K, class Load>
inline auto load_corner(Load load) noexcept {
  if constexpr (K == 0) return load(0, 1, 0, 3, 0, 4);
  if constexpr (K == 1) return load(4, 2, 1, 7, 3, 5);
  if constexpr (K == 2) return load(7, 6, 5, 6, 2, 6);
  if constexpr (K == 3) return load(3, 5, 4, 2, 1, 7);
}

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
  static Lanes larger(Lanes x, Lanes y) noexcept { return {_mm256_max_pd(x.a, y.a), _mm_max_pd(x.b, y.b)}; }
  static Lanes smaller(Lanes x, Lanes y) noexcept { return {_mm256_min_pd(x.a, y.a), _mm_min_pd(x.b, y.b)}; }
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
  static Lanes select(Mask m, Lanes yes, Lanes no) noexcept {
    return {_mm256_blendv_pd(no.a, yes.a, m.a), _mm_blendv_pd(no.b, yes.b, m.b)};
  }
};

inline Lanes::Mask operator&(Lanes::Mask x, Lanes::Mask y) noexcept {
  return {_mm256_and_pd(x.a, y.a), _mm_and_pd(x.b, y.b)};
}
inline Lanes::Mask operator|(Lanes::Mask x, Lanes::Mask y) noexcept {
  return {_mm256_or_pd(x.a, y.a), _mm_or_pd(x.b, y.b)};
}
inline Lanes operator+(Lanes x, Lanes y) noexcept { return {_mm256_add_pd(x.a, y.a), _mm_add_pd(x.b, y.b)}; }
inline Lanes operator-(Lanes x, Lanes y) noexcept { return {_mm256_sub_pd(x.a, y.a), _mm_sub_pd(x.b, y.b)}; }
inline Lanes operator*(Lanes x, Lanes y) noexcept { return {_mm256_mul_pd(x.a, y.a), _mm_mul_pd(x.b, y.b)}; }

#else

/** Three pairs, which any machine of today has. */
struct Lanes {
  using Pair = double __attribute__((vector_size(16)));
  using PairMask = int64_t __attribute__((vector_size(16)));
  struct Mask {
    PairMask a, b, c;
  };
  Pair a, b, c;

  static Pair choose(PairMask m, Pair yes, Pair no) noexcept {
    return (Pair)(((PairMask)yes & m) | ((PairMask)no & ~m));
  }
  static Lanes all(double x) noexcept { return {Pair{x, x}, Pair{x, x}, Pair{x, x}}; }
  static Mask greater(const Lanes& x, const Lanes& y) noexcept { return {x.a > y.a, x.b > y.b, x.c > y.c}; }
  static Lanes select(const Mask& m, const Lanes& yes, const Lanes& no) noexcept {
    return {choose(m.a, yes.a, no.a), choose(m.b, yes.b, no.b), choose(m.c, yes.c, no.c)};
  }
  static Lanes absolute(const Lanes& x) noexcept {
    const PairMask rest = {INT64_MAX, INT64_MAX};
    return {(Pair)((PairMask)x.a & rest), (Pair)((PairMask)x.b & rest), (Pair)((PairMask)x.c & rest)};
  }
  static Lanes larger(const Lanes& x, const Lanes& y) noexcept { return select(greater(x, y), x, y); }
  static Lanes smaller(const Lanes& x, const Lanes& y) noexcept { return select(greater(y, x), x, y); }
  static Mask spread(uint32_t bits) noexcept {
    const auto lane = [&](uint32_t i) { return -static_cast<int64_t>(bits >> i & 1u); };
    return {PairMask{lane(0), lane(1)}, PairMask{lane(2), lane(3)}, PairMask{lane(4), lane(5)}};
  }
  static uint32_t bits(const Mask& m) noexcept {
    const auto pair = [](PairMask p) { return static_cast<uint32_t>((p[0] & 1) | (p[1] & 2)); };
    return pair(m.a) | pair(m.b) << 2 | pair(m.c) << 4;
  }
};

inline Lanes operator+(const Lanes& x, const Lanes& y) noexcept { return {x.a + y.a, x.b + y.b, x.c + y.c}; }
inline Lanes operator-(const Lanes& x, const Lanes& y) noexcept { return {x.a - y.a, x.b - y.b, x.c - y.c}; }
inline Lanes operator*(const Lanes& x, const Lanes& y) noexcept { return {x.a * y.a, x.b * y.b, x.c * y.c}; }
inline Lanes::Mask operator&(const Lanes::Mask& x, const Lanes::Mask& y) noexcept {
  return {x.a & y.a, x.b & y.b, x.c & y.c};
}
inline Lanes::Mask operator|(const Lanes::Mask& x, const Lanes::Mask& y) noexcept {
  return {x.a | y.a, x.b | y.b, x.c | y.c};
}

#endif

/** The vertices of a hexahedron relative to a point. */
struct BoxVertices {
  const double* p[8];
  const double* q;

  BoxVertices(const double* points, const uint32_t* vertices, const double* origin) noexcept : q(origin) {
    for (uint32_t i = 0; i < 8; ++i) p[i] = points + size_t{vertices[i]} * 3;
  }

  template <int K>
  Lanes corner(int k) const noexcept {
    return load_corner<K>([&](int a, int b, int c, int d, int e, int f) {
#if defined(DSW_ISA_AVX2)
      const Lanes raw{_mm256_setr_pd(p[a][k], p[b][k], p[c][k], p[d][k]), _mm_setr_pd(p[e][k], p[f][k])};
#else
      const Lanes raw{Lanes::Pair{p[a][k], p[b][k]}, Lanes::Pair{p[c][k], p[d][k]}, Lanes::Pair{p[e][k], p[f][k]}};
#endif
      return raw - Lanes::all(q[k]);
    });
  }
};

#endif
