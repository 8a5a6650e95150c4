// Polyhedra: the line of a cast against all triangles of the boundary side by side, by the shear of shear.h. A line that comes out
// of a cell pierces mostly one triangle outwards, whatever the cell's form; a plane is asked only for that one. What the filter
// leaves open is asked again triangle by triangle.

constexpr uint32_t kMostCorners = 16;    // two registers of one coordinate
constexpr uint32_t kMostTriangles = 28;  // what a sphere with as many vertices has; a bit each

/** Triangles of a cell that the line from p to q pierces outwards. */
struct LineExits {
  uint32_t pierced = 0;
  bool sure = false;  // false: the filter could not settle all of them
};

/** Where the vertices of a polyhedron stand behind its links, for every number of them; repeats the first one. */
struct VertexWords {
  uint8_t of[kMostCorners + 1][kMostCorners] = {};

  constexpr VertexWords() {
    for (uint32_t count = 0; count <= kMostCorners; ++count) {
      for (uint32_t v = 0; v < kMostCorners; ++v) {
        const uint32_t at = v < count ? v : 0;
        of[count][v] = static_cast<uint8_t>(at / 7 * kUnitWords + 1 + at % 7);
      }
    }
  }
};
constexpr VertexWords kVertexWords;

/** Whether all vertices fit. */
inline bool has_line_exits(const Shape& shape) noexcept {
  return (shape.vertex_count() <= kMostCorners) & (shape.simplex_count() <= kMostTriangles);
}

#if defined(DSW_ISA_AVX512)

/** Where the coordinates i and j, and k, of two points in the halves of a register stand, by Shear::order. */
struct Axes {
  int64_t across[6][8] = {}, along[6][8] = {};

  constexpr Axes() {
    for (int order = 0; order < 6; ++order) {
      const int k = order / 2, turned = order % 2;
      for (int n = 0; n < 8; ++n) {
        across[order][n] = n / 4 * 4 + (k + 1 + (n % 2 == turned ? 0 : 1)) % 3;
        along[order][n] = n / 4 * 4 + k;
      }
    }
  }
};
constexpr Axes kAxes;

/** Up to 16 points on the plane that a line is sheared onto. */
struct ShearedPoints {
  __m512d i[2], j[2];
  double largest;

  template <uint32_t Count>
  DSW_HOT void load(const Shear& line, const double* points, const uint32_t* vertices, const uint8_t* words) noexcept {
    const __m512d origin = _mm512_broadcast_f64x4(_mm256_maskz_loadu_pd(7, line.from()));
    const __m512i across = _mm512_loadu_si512(kAxes.across[line.order()]);
    const __m512i along = _mm512_loadu_si512(kAxes.along[line.order()]);
    const __m512d slope = _mm512_broadcast_f64x2(_mm_loadu_pd(line.slopes()));
    __m512d most = _mm512_set1_pd(line.largest());
    const auto two = [&](uint32_t v, uint32_t w) __attribute__((always_inline)) {
      const __m512d relative = _mm512_sub_pd(
          load_two(points + size_t{vertices[words[v]]} * 3, points + size_t{vertices[words[w]]} * 3), origin);
      most = _mm512_max_pd(most, _mm512_abs_pd(relative));
      return _mm512_sub_pd(_mm512_permutexvar_pd(across, relative),
                           _mm512_mul_pd(slope, _mm512_permutexvar_pd(along, relative)));
    };
    const auto eight = [&](uint32_t r) __attribute__((always_inline)) {
      __m512d pairs[4];
#pragma GCC unroll 4
      for (uint32_t n = 0; n < 4; ++n) pairs[n] = two(8 * r + kLanePairs[n][0], 8 * r + kLanePairs[n][1]);
      i[r] = _mm512_shuffle_f64x2(_mm512_unpacklo_pd(pairs[0], pairs[1]), _mm512_unpacklo_pd(pairs[2], pairs[3]), 0x88);
      j[r] = _mm512_shuffle_f64x2(_mm512_unpackhi_pd(pairs[0], pairs[1]), _mm512_unpackhi_pd(pairs[2], pairs[3]), 0x88);
    };
    eight(0);
    if constexpr (Count <= 10) {
      const __m512d pair = two(8, 9);
      i[1] = _mm512_permutexvar_pd(_mm512_setr_epi64(0, 4, 0, 4, 0, 4, 0, 4), pair);
      j[1] = _mm512_permutexvar_pd(_mm512_setr_epi64(1, 5, 1, 5, 1, 5, 1, 5), pair);
    } else {
      eight(1);
    }
    largest = _mm512_reduce_max_pd(most);
  }
};

/** Eight of them. */
struct ShearedCorners {
  __m512d i, j;

  DSW_HOT ShearedCorners(const ShearedPoints& points, __m512i local) noexcept
      : i(_mm512_permutex2var_pd(points.i[0], local, points.i[1])),
        j(_mm512_permutex2var_pd(points.j[0], local, points.j[1])) {}
  DSW_HOT __m512d side(const ShearedCorners& b) const noexcept {
    return _mm512_sub_pd(_mm512_mul_pd(i, b.j), _mm512_mul_pd(j, b.i));
  }
};

template <uint32_t Corners, uint32_t Triangles>
DSW_HOT LineExits line_exits_of(const Environment<3>& env, const uint32_t* w, const Shape& shape,
                                const Shear& line) noexcept {
  ShearedPoints sheared;
  sheared.load<Corners>(line, env.points, w + (shape.facet_count() + 6) / 7 * kUnitWords,
                        kVertexWords.of[shape.vertex_count()]);
  const Lanes bound = Lanes::all(Shear::bound(sheared.largest)), minus_bound = Lanes::all(0) - bound;
  const uint32_t count = shape.simplex_count();
  // Pairs of 16-bit numbers, three numbers a triangle. A permutation looks at the lowest bits of an index alone.
  const uint64_t pairs = (uint64_t{1} << (3 * count + 1) / 2) - 1;
  const uint16_t* const corners = shape.simplices();
  uint32_t pierced = 0, settled = 0;
#pragma GCC unroll 4
  for (uint32_t first = 0; first < Triangles; first += 8) {
    const auto here = static_cast<__mmask16>(pairs >> 3 * first / 2 & 0xfffu);
    const __m512i words = _mm512_maskz_loadu_epi32(here, corners + 3 * first);
    const auto corner = [&](__m512i word, __m512i shift) __attribute__((always_inline)) {
      return ShearedCorners(sheared, _mm512_srlv_epi64(_mm512_permutexvar_epi32(word, words), shift));
    };
    const __m512i low_first = _mm512_setr_epi64(0, 16, 0, 16, 0, 16, 0, 16),
                  high_first = _mm512_setr_epi64(16, 0, 16, 0, 16, 0, 16, 0);
    const ShearedCorners a = corner(_mm512_setr_epi64(0, 1, 3, 4, 6, 7, 9, 10), low_first),
                         b = corner(_mm512_setr_epi64(0, 2, 3, 5, 6, 8, 9, 11), high_first),
                         c = corner(_mm512_setr_epi64(1, 2, 4, 5, 7, 8, 10, 11), low_first);
    const Lanes lowest = {_mm512_min_pd(_mm512_min_pd(a.side(b), b.side(c)), c.side(a))};
    const uint32_t in = Lanes::greater(lowest, bound), out = Lanes::greater(minus_bound, lowest);
    pierced |= in << first;
    settled |= (in | out) << first;
  }
  const uint32_t all = (1u << count) - 1;
  return {pierced & all, (line.is_in_range(sheared.largest) ? settled & all : 0) == all};
}

/** For shapes that have_line_exits. */
__attribute__((noinline)) inline LineExits line_exits(const Environment<3>& env, const uint32_t* w, const Shape& shape,
                                                      const Shear& line) noexcept {
  if ((shape.vertex_count() <= 10) & (shape.simplex_count() <= 16)) return line_exits_of<10, 16>(env, w, shape, line);
  return line_exits_of<kMostCorners, kMostTriangles>(env, w, shape, line);
}

#else

/** For shapes that have_line_exits. */
__attribute__((noinline)) inline LineExits line_exits(const Environment<3>& env, const uint32_t* w, const Shape& shape,
                                                      const Shear& line) noexcept {
  const uint32_t* const vertices = w + (shape.facet_count() + 6) / 7 * kUnitWords;
  const uint8_t* const words = kVertexWords.of[shape.vertex_count()];
  Shear shear = line;
  Shear::Point corners[kMostCorners];
  for (uint32_t v = 0; v < shape.vertex_count(); ++v) corners[v] = shear(env.point(vertices[words[v]]));
  const double bound = Shear::bound(shear.largest());
  LineExits exits{0, shear.is_in_range(shear.largest())};
  for (uint32_t s = 0; s < shape.simplex_count(); ++s) {
    const uint16_t* const local = shape.simplices() + 3 * s;
    const Shear::Point &a = corners[local[0]], &b = corners[local[1]], &c = corners[local[2]];
    const double lowest = std::min(std::min(Shear::side(a, b), Shear::side(b, c)), Shear::side(c, a));
    exits.pierced |= (lowest > bound ? 1u : 0u) << s;
    exits.sure &= std::fabs(lowest) > bound;
  }
  return exits;
}

#endif
