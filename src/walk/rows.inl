// One number of each of kAbreast casts, side by side. No gathers: points are loaded as they lie and turned in
// registers.

#if defined(DSW_ISA_AVX512)

using Row = Lanes;

inline Row least(Row a, Row b) noexcept { return {_mm512_min_pd(a.v, b.v)}; }
inline Row largest(Row a, Row b) noexcept { return {_mm512_max_pd(a.v, b.v)}; }
inline Row divide(Row a, Row b) noexcept { return {_mm512_div_pd(a.v, b.v)}; }
inline Row load_row(const double* from) noexcept { return {_mm512_loadu_pd(from)}; }
inline void store_row(double* to, Row row) noexcept { _mm512_storeu_pd(to, row.v); }
inline Row::Mask mask_of(uint32_t bits) noexcept { return bits; }
/** A mask as a row that can be stored, and back. */
inline Row row_of(Row::Mask m) noexcept { return {_mm512_castsi512_pd(_mm512_movm_epi64(static_cast<__mmask8>(m)))}; }
inline Row::Mask mask_in(Row row) noexcept { return _mm512_movepi64_mask(_mm512_castpd_si512(row.v)); }

/** A word of each lane. `at(lane)` is one. */
struct Words {
  __m256i words;

  template <class At>
  DSW_HOT explicit Words(At at) noexcept
      : words(_mm256_setr_epi32(static_cast<int>(at(0)), static_cast<int>(at(1)), static_cast<int>(at(2)),
                                static_cast<int>(at(3)), static_cast<int>(at(4)), static_cast<int>(at(5)),
                                static_cast<int>(at(6)), static_cast<int>(at(7)))) {}
  /** Lanes with this bit. */
  DSW_HOT Row::Mask have(uint32_t bit) const noexcept {
    return _mm256_test_epi32_mask(words, _mm256_set1_epi32(static_cast<int>(bit)));
  }
};

/** Two points in the halves of a register. Masked, so that the last point of the host's array is not read past. */
DSW_HOT __m512d load_two(const double* a, const double* b) noexcept {
  return _mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_maskz_loadu_pd(7, a)), _mm256_maskz_loadu_pd(7, b), 1);
}

constexpr uint32_t kLanePairs[4][2] = {{0, 2}, {1, 3}, {4, 6}, {5, 7}};  // makes the order below that of the lanes

/** Eight points out of registers with two each. */
DSW_HOT PointsOf<Row> turn(__m512d v02, __m512d v13, __m512d v46, __m512d v57) noexcept {
  const __m512d xz0 = _mm512_unpacklo_pd(v02, v13), y0 = _mm512_unpackhi_pd(v02, v13);
  const __m512d xz4 = _mm512_unpacklo_pd(v46, v57), y4 = _mm512_unpackhi_pd(v46, v57);
  return {{_mm512_shuffle_f64x2(xz0, xz4, 0x88)},
          {_mm512_shuffle_f64x2(y0, y4, 0x88)},
          {_mm512_shuffle_f64x2(xz0, xz4, 0xdd)}};
}

/** `at(lane)`: where the lane's point lies. */
template <class At>
DSW_HOT PointsOf<Row> load_points(At at) noexcept {
  return turn(load_two(at(0), at(2)), load_two(at(1), at(3)), load_two(at(4), at(6)), load_two(at(5), at(7)));
}

inline Row::Mask not_greater(Row a, Row b) noexcept { return _mm512_cmp_pd_mask(a.v, b.v, _CMP_NGT_UQ); }

/** A set of facets for each lane. */
struct FacetSets {
  __m256i sets;

  DSW_HOT FacetSets() noexcept : sets(_mm256_setzero_si256()) {}
  DSW_HOT void add(int facets, Row::Mask lanes) noexcept {
    sets = _mm256_mask_or_epi32(sets, static_cast<__mmask8>(lanes), sets, _mm256_set1_epi32(facets));
  }
  /** `to`: the word of each lane, with bits beside. `one`, `several`: lanes whose lowest byte has one bit, or more. */
  DSW_HOT void store(uint32_t beside, uint32_t (&to)[kAbreast], uint32_t& one, uint32_t& several) const noexcept {
    const __m256i bytes = _mm256_and_si256(sets, _mm256_set1_epi32(0xff));
    const uint32_t any = _mm256_test_epi32_mask(bytes, bytes);
    several = _mm256_test_epi32_mask(bytes, _mm256_add_epi32(bytes, _mm256_set1_epi32(-1)));
    one = any & ~several;
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to),
                        _mm256_or_si256(sets, _mm256_set1_epi32(static_cast<int>(beside))));
  }
};

/** A byte of each lane. */
struct LaneBytes {
  __m256i bytes;

  DSW_HOT explicit LaneBytes(const uint8_t* from) noexcept
      : bytes(_mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(from)))) {}
  /** Packs the bytes of some lanes. Writes kAbreast bytes, of which those behind are arbitrary. */
  DSW_HOT void store(uint8_t* to, uint32_t lanes) const noexcept {
    const __m256i some = _mm256_maskz_compress_epi32(static_cast<__mmask8>(lanes), bytes);
    _mm_storel_epi64(reinterpret_cast<__m128i*>(to), _mm256_cvtepi32_epi8(some));
  }
};

#elif defined(DSW_ISA_AVX2)

struct Row {
  using Mask = __m256d;
  __m256d v;

  static Row all(double x) noexcept { return {_mm256_set1_pd(x)}; }
  static Row absolute(Row a) noexcept { return {_mm256_andnot_pd(_mm256_set1_pd(-0.0), a.v)}; }
  static Mask greater(Row a, Row b) noexcept { return _mm256_cmp_pd(a.v, b.v, _CMP_GT_OQ); }
  static uint32_t bits(Mask m) noexcept { return static_cast<uint32_t>(_mm256_movemask_pd(m)); }
  static Mask both(Mask m, Mask n) noexcept { return _mm256_and_pd(m, n); }
  static Mask either(Mask m, Mask n) noexcept { return _mm256_or_pd(m, n); }
  static Mask without(Mask m, Mask n) noexcept { return _mm256_andnot_pd(n, m); }
  static Row select(Mask m, Row yes, Row no) noexcept { return {_mm256_blendv_pd(no.v, yes.v, m)}; }
};

inline Row operator+(Row a, Row b) noexcept { return {_mm256_add_pd(a.v, b.v)}; }
inline Row operator-(Row a, Row b) noexcept { return {_mm256_sub_pd(a.v, b.v)}; }
inline Row operator*(Row a, Row b) noexcept { return {_mm256_mul_pd(a.v, b.v)}; }
inline Row least(Row a, Row b) noexcept { return {_mm256_min_pd(a.v, b.v)}; }
inline Row largest(Row a, Row b) noexcept { return {_mm256_max_pd(a.v, b.v)}; }
inline Row divide(Row a, Row b) noexcept { return {_mm256_div_pd(a.v, b.v)}; }
inline Row load_row(const double* from) noexcept { return {_mm256_loadu_pd(from)}; }
inline void store_row(double* to, Row row) noexcept { _mm256_storeu_pd(to, row.v); }
inline Row::Mask mask_of(uint32_t bits) noexcept { return Lanes::spread(bits).a; }
inline Row row_of(Row::Mask m) noexcept { return {m}; }
inline Row::Mask mask_in(Row row) noexcept { return row.v; }

/** A word of each lane. `at(lane)` is one. */
struct Words {
  __m256i words;

  template <class At>
  DSW_HOT explicit Words(At at) noexcept : words(_mm256_setr_epi64x(at(0), at(1), at(2), at(3))) {}
  /** Lanes with this bit. */
  DSW_HOT Row::Mask have(uint32_t bit) const noexcept {
    const __m256i bits = _mm256_set1_epi64x(bit);
    return _mm256_castsi256_pd(_mm256_cmpeq_epi64(_mm256_and_si256(words, bits), bits));
  }
};

/** Two coordinates of one point, and two of another. */
DSW_HOT __m256d load_two(const double* a, const double* b) noexcept {
  return _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_loadu_pd(a)), _mm_loadu_pd(b), 1);
}

/** `at(lane)`: where the lane's point lies. */
template <class At>
DSW_HOT PointsOf<Row> load_points(At at) noexcept {
  const double *const p0 = at(0), *const p1 = at(1), *const p2 = at(2), *const p3 = at(3);
  const __m256d xy02 = load_two(p0, p2), xy13 = load_two(p1, p3);
  const __m128d z01 = _mm_loadh_pd(_mm_load_sd(p0 + 2), p1 + 2), z23 = _mm_loadh_pd(_mm_load_sd(p2 + 2), p3 + 2);
  return {{_mm256_unpacklo_pd(xy02, xy13)},
          {_mm256_unpackhi_pd(xy02, xy13)},
          {_mm256_insertf128_pd(_mm256_castpd128_pd256(z01), z23, 1)}};
}

inline Row::Mask not_greater(Row a, Row b) noexcept { return _mm256_cmp_pd(a.v, b.v, _CMP_NGT_UQ); }

/** A set of facets for each lane. */
struct FacetSets {
  __m256d sets;

  DSW_HOT FacetSets() noexcept : sets(_mm256_setzero_pd()) {}
  DSW_HOT void add(int facets, Row::Mask lanes) noexcept {
    sets = _mm256_or_pd(sets, _mm256_and_pd(lanes, _mm256_castsi256_pd(_mm256_set1_epi64x(facets))));
  }
  /** `to`: the word of each lane, with bits beside. `one`, `several`: lanes whose lowest byte has one bit, or more. */
  DSW_HOT void store(uint32_t beside, uint32_t (&to)[kAbreast], uint32_t& one, uint32_t& several) const noexcept {
    const __m256i all = _mm256_castpd_si256(sets), bytes = _mm256_and_si256(all, _mm256_set1_epi64x(0xff));
    const __m256i more = _mm256_and_si256(bytes, _mm256_add_epi64(bytes, _mm256_set1_epi64x(-1)));
    const uint32_t none = zeros(bytes), at_most_one = zeros(more);
    several = ~at_most_one & 15u;
    one = at_most_one & ~none;
    const __m256i words = _mm256_permutevar8x32_epi32(all, _mm256_setr_epi32(0, 2, 4, 6, 0, 2, 4, 6));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(to),
                     _mm_or_si128(_mm256_castsi256_si128(words), _mm_set1_epi32(static_cast<int>(beside))));
  }

 private:
  static DSW_HOT uint32_t zeros(__m256i v) noexcept {
    return Row::bits(_mm256_castsi256_pd(_mm256_cmpeq_epi64(v, _mm256_setzero_si256())));
  }
};

/** The lanes of a set of four in order, then arbitrary ones. */
struct LaneOrder {
  uint8_t of[16][4]{};
  constexpr LaneOrder() {
    for (uint32_t set = 0; set < 16; ++set) {
      uint32_t count = 0;
      for (uint8_t lane = 0; lane < 4; ++lane) {
        of[set][count] = lane;
        count += set >> lane & 1u;
      }
    }
  }
};
constexpr LaneOrder kLaneOrder;

/** A byte of each lane. */
struct LaneBytes {
  __m128i bytes;

  DSW_HOT explicit LaneBytes(const uint8_t* from) noexcept : bytes(load(from)) {}
  /** Packs the bytes of some lanes. Writes kAbreast bytes, of which those behind are arbitrary. */
  DSW_HOT void store(uint8_t* to, uint32_t lanes) const noexcept {
    const int some = _mm_cvtsi128_si32(_mm_shuffle_epi8(bytes, load(kLaneOrder.of[lanes])));
    std::memcpy(to, &some, sizeof some);
  }

 private:
  static DSW_HOT __m128i load(const uint8_t* from) noexcept {
    int four;
    std::memcpy(&four, from, sizeof four);
    return _mm_cvtsi32_si128(four);
  }
};

#else

/** A pair, which any machine of today has. */
struct Row {
  using Pair = DoublePair;
  using Mask = PairMask;
  Pair v;

  static Row all(double x) noexcept { return {Pair{x, x}}; }
  static Row absolute(Row a) noexcept { return {pair_of(bits_of(a.v) & Mask{INT64_MAX, INT64_MAX})}; }
  static Mask greater(Row a, Row b) noexcept { return a.v > b.v; }
  static uint32_t bits(Mask m) noexcept { return static_cast<uint32_t>((m[0] & 1) | (m[1] & 2)); }
  static Mask both(Mask m, Mask n) noexcept { return m & n; }
  static Mask either(Mask m, Mask n) noexcept { return m | n; }
  static Mask without(Mask m, Mask n) noexcept { return m & ~n; }
  static Row select(Mask m, Row yes, Row no) noexcept { return {Lanes::choose(m, yes.v, no.v)}; }
};

inline Row operator+(Row a, Row b) noexcept { return {a.v + b.v}; }
inline Row operator-(Row a, Row b) noexcept { return {a.v - b.v}; }
inline Row operator*(Row a, Row b) noexcept { return {a.v * b.v}; }
inline Row divide(Row a, Row b) noexcept { return {a.v / b.v}; }
inline Row least(Row a, Row b) noexcept { return Row::select(a.v < b.v, a, b); }
inline Row largest(Row a, Row b) noexcept { return Row::select(a.v > b.v, a, b); }
inline Row load_row(const double* from) noexcept { return {Row::Pair{from[0], from[1]}}; }
inline void store_row(double* to, Row row) noexcept {
  to[0] = row.v[0];
  to[1] = row.v[1];
}
inline Row::Mask mask_of(uint32_t bits) noexcept {
  return Row::Mask{-static_cast<int64_t>(bits & 1u), -static_cast<int64_t>(bits >> 1 & 1u)};
}
inline Row row_of(Row::Mask m) noexcept { return {pair_of(m)}; }
inline Row::Mask mask_in(Row row) noexcept { return bits_of(row.v); }

/** A word of each lane. `at(lane)` is one. */
struct Words {
  uint32_t first, second;

  template <class At>
  DSW_HOT explicit Words(At at) noexcept : first(at(0)), second(at(1)) {}
  /** Lanes with this bit. */
  DSW_HOT Row::Mask have(uint32_t bit) const noexcept {
    return mask_of(((first & bit) != 0 ? 1u : 0u) | ((second & bit) != 0 ? 2u : 0u));
  }
};

/** `at(lane)`: where the lane's point lies. */
template <class At>
DSW_HOT PointsOf<Row> load_points(At at) noexcept {
  const double *const a = at(0), *const b = at(1);
  return {{Row::Pair{a[0], b[0]}}, {Row::Pair{a[1], b[1]}}, {Row::Pair{a[2], b[2]}}};
}

inline Row::Mask not_greater(Row a, Row b) noexcept { return ~(a.v > b.v); }

/** A set of facets for each lane. */
struct FacetSets {
  Row::Mask sets{};

  DSW_HOT void add(int facets, Row::Mask lanes) noexcept { sets |= lanes & Row::Mask{facets, facets}; }
  /** `to`: the word of each lane, with bits beside. `one`, `several`: lanes whose lowest byte has one bit, or more. */
  DSW_HOT void store(uint32_t beside, uint32_t (&to)[kAbreast], uint32_t& one, uint32_t& several) const noexcept {
    one = several = 0;
    for (uint32_t lane = 0; lane < kAbreast; ++lane) {
      to[lane] = static_cast<uint32_t>(sets[lane]) | beside;
      const uint32_t byte = to[lane] & 0xffu, has_several = (byte & (byte - 1)) != 0 ? 1 : 0;
      several |= has_several << lane;
      one |= ((byte != 0 ? 1u : 0u) & ~has_several) << lane;
    }
  }
};

/** A byte of each lane. */
struct LaneBytes {
  uint8_t first, second;

  DSW_HOT explicit LaneBytes(const uint8_t* from) noexcept : first(from[0]), second(from[1]) {}
  /** Packs the bytes of some lanes. Writes kAbreast bytes, of which those behind are arbitrary. */
  DSW_HOT void store(uint8_t* to, uint32_t lanes) const noexcept {
    to[0] = (lanes & 1u) != 0 ? first : second;
    to[1] = second;
  }
};

#endif

inline Row::Mask both(Row::Mask m, Row::Mask n) noexcept { return Row::both(m, n); }
inline Row::Mask either(Row::Mask m, Row::Mask n) noexcept { return Row::either(m, n); }

/** How many lanes a mask has. */
DSW_HOT uint32_t count_lanes(uint32_t lanes) noexcept {
  if (kAbreast == 2) return (lanes & 1u) + (lanes >> 1);  // without an instruction for it a call
  return bit_count(lanes);
}
