// Polyhedra: the line of a cast against all triangles of the boundary side by side, by the shear of shear.h. A line
// that comes out of a cell pierces mostly one triangle outwards, whatever the cell's form; a plane is asked only for
// that one. What the filter leaves open is asked again triangle by triangle.

constexpr uint32_t kMostCorners = 16;    // two registers of one coordinate
constexpr uint32_t kMostTriangles = 28;  // what a sphere with as many vertices has; a bit each

/** Triangles of a cell that the line from p to q pierces outwards. */
struct LineExits {
  uint32_t pierced = 0;
  bool sure = false;               // false: the filter could not decide all of them
  uint32_t ahead = 0, passed = 0;  // of these, where it tells: pierced after q, or before
};

/** Where the vertices of a polyhedron stand behind its links, for every number of them; repeats the first one. */
struct VertexWords {
  uint8_t of[kMostCorners + 1][kMostCorners] = {};

  constexpr VertexWords() {
    for (uint32_t count = 0; count <= kMostCorners; ++count) {
      for (uint32_t v = 0; v < kMostCorners; ++v) {
        const uint32_t at = v < count ? v : 0;
        of[count][v] = static_cast<uint8_t>(item_word<3>(at));
      }
    }
  }
};
constexpr VertexWords kVertexWords;

/** Whether all vertices fit. */
inline bool has_line_exits(const Shape& shape) noexcept {
  return shape.vertex_count() <= kMostCorners && shape.simplex_count() <= kMostTriangles;
}

/** The line from a cell's vertex 0 for single precision. With u = 2^-24, m over the stored coordinates and C those of
 * vertex 0 on the plane: a point X = (A_i - s_i A_k) + C_i meets five roundings and three of its inputs, together less
 * than 8.1 u m + 2.1 u |C|; C itself is off by 9 M / 2^53 with M over p -> vertex 0 (shear.h). With |X| <= N = 2 m +
 * |C| that is e < 4.1 u N + 9 M / 2^53, and X_i Y_j - X_j Y_i with its three roundings is off by 4 N e + 2 e^2 + 4 u
 * N^2 < 20.4 u N^2 + 37 N M / 2^53 for e < N / 100. These sides are the weights, each at most 2 N^2, of a triangle's
 * vertices where the line pierces it. The sum of weights times z, how far vertices lie ahead of q along the axis k,
 * says whether q is passed before that. z = A_k + z_0 is at most Z = N + |z_0|, and off by 3 u Z + 2 M / 2^53. With
 * five roundings the sum is off by (3 * 20.4 + 6 * 3 + 6 * 5) u N^2 Z + (3 * 37 N Z + 12 N^2) M / 2^53, less than four
 * times the bound of a side and Z. */
struct NearLine {
  float slope_i, slope_j, i, j, z;  // of vertex 0
  float forward;                    // 1, or -1 where the line goes down the axis k
  double offset, reach;             // |C| and M

  DSW_HOT NearLine(const Shear& line, const LocalOrigin& vertex) noexcept {
    Shear shear = line;
    const Shear::Point c = shear(vertex.at);
    slope_i = static_cast<float>(line.slopes()[0]);
    slope_j = static_cast<float>(line.slopes()[1]);
    i = static_cast<float>(c.i);
    j = static_cast<float>(c.j);
    forward = line.turned() ? -1.0f : 1.0f;
    const double along = vertex.at[line.k()] - line.from()[line.k()];
    z = static_cast<float>((line.turned() ? -along : along) - line.largest());
    offset = std::max(std::fabs(c.i), std::fabs(c.j));
    reach = shear.largest();
  }

  /** Whether products stay normal, and e is small. */
  DSW_HOT bool is_in_range(double m) const noexcept {
    const double n = 2 * m + offset;
    return n > 1e-10 && n < 1e10 && reach * 0x1p-43 < n;
  }
  DSW_HOT double bound(double m) const noexcept {
    const double n = 2 * m + offset;
    return n * (0x1p-19 * n + 0x1p-47 * reach);
  }
  DSW_HOT double bound_ahead(double m) const noexcept {
    return 4 * bound(m) * (2 * m + offset + std::fabs(static_cast<double>(z)));
  }
};

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
    const auto two = [&](uint32_t v, uint32_t w) DSW_HOT_LAMBDA {
      const __m512d relative = _mm512_sub_pd(
          load_two(points + size_t{vertices[words[v]]} * 3, points + size_t{vertices[words[w]]} * 3), origin);
      most = _mm512_max_pd(most, _mm512_abs_pd(relative));
      return _mm512_sub_pd(_mm512_permutexvar_pd(across, relative),
                           _mm512_mul_pd(slope, _mm512_permutexvar_pd(along, relative)));
    };
    const auto eight = [&](uint32_t r) DSW_HOT_LAMBDA {
      __m512d pairs[4];
      DSW_UNROLL(4)
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
  sheared.load<Corners>(line, env.points, w + units_for<3>(shape.facet_count()) * kUnitWords<3>,
                        kVertexWords.of[shape.vertex_count()]);
  const Lanes bound = Lanes::all(Shear::bound(sheared.largest)), minus_bound = Lanes::all(0) - bound;
  const uint32_t count = shape.simplex_count();
  // Pairs of 16-bit numbers, three numbers a triangle. A permutation looks at the lowest bits of an index alone.
  const uint64_t pairs = (uint64_t{1} << (3 * count + 1) / 2) - 1;
  const uint16_t* const corners = shape.simplices();
  uint32_t pierced = 0, decided = 0;
  DSW_UNROLL(4)
  for (uint32_t first = 0; first < Triangles; first += 8) {
    const auto here = static_cast<__mmask16>(pairs >> 3 * first / 2 & 0xfffu);
    const __m512i words = _mm512_maskz_loadu_epi32(here, corners + 3 * first);
    const auto corner = [&](__m512i word, __m512i shift) DSW_HOT_LAMBDA {
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
    decided |= (in | out) << first;
  }
  const uint32_t all = (1u << count) - 1;
  return {pierced & all, (line.is_in_range(sheared.largest) ? decided & all : 0) == all, 0, 0};
}

/** For shapes that have_line_exits. */
DSW_NOINLINE inline LineExits line_exits(const Environment<3>& env, const uint32_t* w, const Shape& shape,
                                         const Shear& line) noexcept {
  if (shape.vertex_count() <= 10 && shape.simplex_count() <= 16) return line_exits_of<10, 16>(env, w, shape, line);
  return line_exits_of<kMostCorners, kMostTriangles>(env, w, shape, line);
}

/** Picks the corners of 16 triangles, three 16-bit numbers each: `pair` is the pair that a corner is in, and `shift`
 * how far it is shifted there. */
struct CornerPicks {
  alignas(64) int32_t pair[3][16] = {}, shift[3][16] = {};

  constexpr CornerPicks() {
    for (int corner = 0; corner < 3; ++corner) {
      for (int t = 0; t < 16; ++t) {
        pair[corner][t] = (3 * t + corner) / 2;
        shift[corner][t] = (3 * t + corner) % 2 * 16;
      }
    }
  }
};
constexpr CornerPicks kCornerPicks;

DSW_HOT __m512 side(__m512 ai, __m512 aj, __m512 bi, __m512 bj) noexcept {
  return _mm512_sub_ps(_mm512_mul_ps(ai, bj), _mm512_mul_ps(aj, bi));
}

/** Computes line_exits from local points. */
DSW_NOINLINE inline LineExits near_exits(const Environment<3>& env, const uint32_t* w, const Shape& shape,
                                         const Shear& line) noexcept {
  const uint32_t vertices = shape.vertex_count(), count = shape.simplex_count();
  const float* const local = local_points(env, w);
  const auto used = static_cast<__mmask16>((1u << vertices) - 2);  // vertex 0 is 0
  const auto row = [&](int axis) DSW_HOT_LAMBDA {
    return _mm512_maskz_loadu_ps(used, local + kOriginWords - 1 + static_cast<uint32_t>(axis) * (vertices - 1));
  };
  const __m512 x = row(line.i()), y = row(line.j()), z = row(line.k());
  const NearLine near(line, LocalOrigin(local));
  const __m512 most = _mm512_max_ps(_mm512_max_ps(_mm512_abs_ps(x), _mm512_abs_ps(y)), _mm512_abs_ps(z));
  const double m = static_cast<double>(_mm512_reduce_max_ps(most));
  const __m512 i =
      _mm512_add_ps(_mm512_sub_ps(x, _mm512_mul_ps(_mm512_set1_ps(near.slope_i), z)), _mm512_set1_ps(near.i));
  const __m512 j =
      _mm512_add_ps(_mm512_sub_ps(y, _mm512_mul_ps(_mm512_set1_ps(near.slope_j), z)), _mm512_set1_ps(near.j));
  const __m512 ahead = _mm512_add_ps(_mm512_mul_ps(_mm512_set1_ps(near.forward), z), _mm512_set1_ps(near.z));
  const auto side_bound = static_cast<float>(near.bound(m)), sum_bound = static_cast<float>(near.bound_ahead(m));
  const auto greater = [](__m512 a, float b) { return _mm512_cmp_ps_mask(a, _mm512_set1_ps(b), _CMP_GT_OQ); };
  const auto less = [](__m512 a, float b) { return _mm512_cmp_ps_mask(a, _mm512_set1_ps(b), _CMP_LT_OQ); };
  LineExits exits;
  const uint64_t pairs = (uint64_t{1} << (3 * count + 1) / 2) - 1;
  const uint16_t* const corners = shape.simplices();
  uint32_t decided = 0;
  for (uint32_t first = 0; first < count; first += 16) {
    const uint64_t here = pairs >> 3 * first / 2;
    const __m512i low = _mm512_maskz_loadu_epi32(static_cast<__mmask16>(here & 0xffffu), corners + 3 * first);
    const __m512i high = _mm512_maskz_loadu_epi32(static_cast<__mmask16>(here >> 16 & 0xffu), corners + 3 * first + 32);
    const auto pick = [&](int corner) DSW_HOT_LAMBDA {
      return _mm512_srlv_epi32(_mm512_permutex2var_epi32(low, _mm512_load_si512(kCornerPicks.pair[corner]), high),
                               _mm512_load_si512(kCornerPicks.shift[corner]));
    };
    const __m512i a = pick(0), b = pick(1), c = pick(2);
    const __m512 ai = _mm512_permutexvar_ps(a, i), aj = _mm512_permutexvar_ps(a, j), bi = _mm512_permutexvar_ps(b, i),
                 bj = _mm512_permutexvar_ps(b, j), ci = _mm512_permutexvar_ps(c, i), cj = _mm512_permutexvar_ps(c, j);
    const __m512 ab = side(ai, aj, bi, bj), bc = side(bi, bj, ci, cj), ca = side(ci, cj, ai, aj);
    const __m512 lowest = _mm512_min_ps(_mm512_min_ps(ab, bc), ca);
    const __m512 sum = _mm512_add_ps(_mm512_add_ps(_mm512_mul_ps(bc, _mm512_permutexvar_ps(a, ahead)),
                                                   _mm512_mul_ps(ca, _mm512_permutexvar_ps(b, ahead))),
                                     _mm512_mul_ps(ab, _mm512_permutexvar_ps(c, ahead)));
    const uint32_t in = greater(lowest, side_bound), out = less(lowest, -side_bound);
    exits.pierced |= in << first;
    exits.ahead |= (in & greater(sum, sum_bound)) << first;
    exits.passed |= (in & less(sum, -sum_bound)) << first;
    decided |= (in | out) << first;
  }
  const uint32_t all = (1u << count) - 1;
  exits.pierced &= all, exits.ahead &= all, exits.passed &= all;
  exits.sure = near.is_in_range(m) && (decided & all) == all;
  return exits;
}

#else

/** For shapes that have_line_exits. */
DSW_NOINLINE inline LineExits line_exits(const Environment<3>& env, const uint32_t* w, const Shape& shape,
                                         const Shear& line) noexcept {
  const uint32_t* const vertices = w + units_for<3>(shape.facet_count()) * kUnitWords<3>;
  const uint8_t* const words = kVertexWords.of[shape.vertex_count()];
  Shear shear = line;
  Shear::Point corners[kMostCorners];
  for (uint32_t v = 0; v < shape.vertex_count(); ++v) corners[v] = shear(env.point(vertices[words[v]]));
  const double bound = Shear::bound(shear.largest());
  LineExits exits{0, shear.is_in_range(shear.largest()), 0, 0};
  for (uint32_t s = 0; s < shape.simplex_count(); ++s) {
    const uint16_t* const local = shape.simplices() + 3 * s;
    const Shear::Point &a = corners[local[0]], &b = corners[local[1]], &c = corners[local[2]];
    const double lowest = std::min(std::min(Shear::side(a, b), Shear::side(b, c)), Shear::side(c, a));
    exits.pierced |= (lowest > bound ? 1u : 0u) << s;
    exits.sure &= std::fabs(lowest) > bound;
  }
  return exits;
}

/** Computes line_exits from local points. */
DSW_NOINLINE inline LineExits near_exits(const Environment<3>& env, const uint32_t* w, const Shape& shape,
                                         const Shear& line) noexcept {
  const uint32_t count = shape.vertex_count();
  const float* const local = local_points(env, w);
  const NearLine near(line, LocalOrigin(local));
  const auto row = [&](int axis) { return local + kOriginWords - 1 + static_cast<uint32_t>(axis) * (count - 1); };
  const float *const x = row(line.i()), *const y = row(line.j()), *const z = row(line.k());
  float i[kMostCorners] = {near.i}, j[kMostCorners] = {near.j}, ahead[kMostCorners] = {near.z}, most = 0;
  for (uint32_t v = 1; v < count; ++v) {
    most = std::max(most, std::max(std::max(std::fabs(x[v]), std::fabs(y[v])), std::fabs(z[v])));
    i[v] = (x[v] - near.slope_i * z[v]) + near.i;
    j[v] = (y[v] - near.slope_j * z[v]) + near.j;
    ahead[v] = near.forward * z[v] + near.z;
  }
  const double m = static_cast<double>(most);
  const auto bound = static_cast<float>(near.bound(m)), sum_bound = static_cast<float>(near.bound_ahead(m));
  LineExits exits;
  exits.sure = near.is_in_range(m);
  const auto side = [&](uint32_t a, uint32_t b) { return i[a] * j[b] - j[a] * i[b]; };
  for (uint32_t s = 0; s < shape.simplex_count(); ++s) {
    const uint16_t* const t = shape.simplices() + 3 * s;
    const float ab = side(t[0], t[1]), bc = side(t[1], t[2]), ca = side(t[2], t[0]);
    const float lowest = std::min(std::min(ab, bc), ca);
    const float sum = (bc * ahead[t[0]] + ca * ahead[t[1]]) + ab * ahead[t[2]];
    const uint32_t in = lowest > bound ? 1 : 0;
    exits.pierced |= in << s;
    exits.ahead |= (sum > sum_bound ? in : 0) << s;
    exits.passed |= (sum < -sum_bound ? in : 0) << s;
    exits.sure &= std::fabs(lowest) > bound;
  }
  return exits;
}

#endif
