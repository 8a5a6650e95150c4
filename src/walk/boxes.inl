// Hexahedra eight casts at a time, a lane for each: the signs of box.inl bit for bit, but of the work for one cast only
// its loads are left. Flat ones share cross products too: each serves both facets at its edge.

struct Boxes {
  const uint32_t* records[kAbreast];
  const double* p[kAbreast];
  const double* q[kAbreast];
};

/** Two points in the halves of a register. Masked, so that the last point of the host's array is not read past. */
DSW_HOT __m512d load_two(const double* a, const double* b) noexcept {
  return _mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_maskz_loadu_pd(7, a)), _mm256_maskz_loadu_pd(7, b), 1);
}

constexpr uint32_t kLanePairs[4][2] = {{0, 2}, {1, 3}, {4, 6}, {5, 7}};  // makes the order below that of the boxes

/** Eight points out of registers with two each. */
DSW_HOT Points turn(__m512d v02, __m512d v13, __m512d v46, __m512d v57) noexcept {
  const __m512d xz0 = _mm512_unpacklo_pd(v02, v13), y0 = _mm512_unpackhi_pd(v02, v13);
  const __m512d xz4 = _mm512_unpacklo_pd(v46, v57), y4 = _mm512_unpackhi_pd(v46, v57);
  return {{_mm512_shuffle_f64x2(xz0, xz4, 0x88)},
          {_mm512_shuffle_f64x2(y0, y4, 0x88)},
          {_mm512_shuffle_f64x2(xz0, xz4, 0xdd)}};
}

/** Extent lane by lane. */
struct Extents {
  Lanes x, y, z;

  DSW_HOT Extents() noexcept : x(Lanes::all(0)), y(x), z(x) {}
  DSW_HOT void include(const Points& v) noexcept {
    x.v = _mm512_max_pd(x.v, _mm512_abs_pd(v.x.v));
    y.v = _mm512_max_pd(y.v, _mm512_abs_pd(v.y.v));
    z.v = _mm512_max_pd(z.v, _mm512_abs_pd(v.z.v));
  }
  DSW_HOT Lanes::Mask in_range() const noexcept {
    const __m512d least = _mm512_min_pd(_mm512_min_pd(x.v, y.v), z.v);
    const __m512d largest = _mm512_max_pd(_mm512_max_pd(x.v, y.v), z.v);
    return _mm512_mask_cmp_pd_mask(_mm512_cmp_pd_mask(least, _mm512_set1_pd(kFilterMin), _CMP_GE_OQ), largest,
                                   _mm512_set1_pd(kFilterMax), _CMP_LE_OQ);
  }
  DSW_HOT Lanes bound() const noexcept { return Lanes::all(kPlaneFilter3) * x * y * z; }
};

/** Some vertices of eight boxes, relative to their q. */
template <uint32_t Count>
struct BoxesVertices {
  Points at[Count];
  Extents extents;

  DSW_HOT BoxesVertices(const double* points, const Boxes& boxes, const uint32_t (&local)[Count]) noexcept {
    __m512d pairs[4][Count];
#pragma GCC unroll 4
    for (uint32_t j = 0; j < 4; ++j) {
      const uint32_t l = kLanePairs[j][0], m = kLanePairs[j][1];
      const __m512d q = load_two(boxes.q[l], boxes.q[m]);
#pragma GCC unroll 8
      for (uint32_t i = 0; i < Count; ++i) {
        const double* const a = points + size_t{boxes.records[l][kUnitWords<3> + local[i]]} * 3;
        const double* const b = points + size_t{boxes.records[m][kUnitWords<3> + local[i]]} * 3;
        pairs[j][i] = _mm512_sub_pd(load_two(a, b), q);
      }
    }
#pragma GCC unroll 8
    for (uint32_t i = 0; i < Count; ++i) {
      at[i] = turn(pairs[0][i], pairs[1][i], pairs[2][i], pairs[3][i]);
      extents.include(at[i]);
    }
  }
};

/** A set of facets for each box. */
struct FacetSets {
  __m256i bits;

  DSW_HOT FacetSets() noexcept : bits(_mm256_setzero_si256()) {}
  DSW_HOT void add(uint32_t facet, uint32_t boxes) noexcept {
    bits = _mm256_mask_or_epi32(bits, static_cast<__mmask8>(boxes), bits, _mm256_set1_epi32(1 << facet));
  }
  DSW_HOT void store(uint8_t (&sets)[kAbreast]) const noexcept {
    _mm_storel_epi64(reinterpret_cast<__m128i*>(sets), _mm256_cvtepi32_epi8(bits));
  }
};

/** Of flat boxes: the facets with q outside. */
struct FlatBoxSides {
  uint8_t outside[kAbreast];
  uint32_t settled;  // boxes for which the filter settled all six

  void look(const double* points, const Boxes& boxes) noexcept;
};

/** The vertices 1 2 3 7 4 5 relative to q: three in a row, the ring closed, span a facet. */
struct RingPlanes {
  BoxesVertices<6> ring;
  Lanes bound, minus_bound, least;
  FacetSets outside;

  DSW_HOT RingPlanes(const double* points, const Boxes& boxes) noexcept
      : ring(points, boxes, {1, 2, 3, 7, 4, 5}),
        bound(ring.extents.bound()),
        minus_bound(Lanes::all(0) - bound),
        least(Lanes::all(HUGE_VAL)) {}

  DSW_HOT void test(const Points& normal, uint32_t vertex, uint32_t facet) noexcept {
    const Lanes det = dot(normal, ring.at[vertex]);
    outside.add(facet, facet % 2 == 0 ? Lanes::greater(det, bound) : Lanes::greater(minus_bound, det));
    least.v = _mm512_min_pd(least.v, _mm512_abs_pd(det.v));
  }

  /** The two facets at the edge from a to the next: with the vertex after, an even one; before, an odd one. */
  DSW_HOT void test_beside(uint32_t a, uint32_t even, uint32_t odd) noexcept {
    const Points normal = cross(ring.at[a], ring.at[a + 1]);
    test(normal, (a + 2) % 6, even);
    test(normal, (a + 5) % 6, odd);
  }
};

__attribute__((noinline)) inline void FlatBoxSides::look(const double* points, const Boxes& boxes) noexcept {
  RingPlanes planes(points, boxes);
  planes.test_beside(0, 4, 1);
  planes.test_beside(2, 0, 3);
  planes.test_beside(4, 2, 5);
  settled = planes.ring.extents.in_range() & Lanes::greater(planes.least, planes.bound);
  planes.outside.store(outside);
}

/** Of boxes that need not be convex: BoxExits, a facet at a time. */
struct WarpedBoxExits {
  uint8_t pierced[kAbreast], second[kAbreast], candidates[kAbreast];
  uint32_t sure;  // boxes for which the filter settled all that matters

  void look(const double* points, const Boxes& boxes) noexcept;
};

__attribute__((noinline)) inline void WarpedBoxExits::look(const double* points, const Boxes& boxes) noexcept {
  const BoxesVertices<8> v(points, boxes, {0, 1, 2, 3, 4, 5, 6, 7});
  __m512d pairs[4];
#pragma GCC unroll 4
  for (uint32_t j = 0; j < 4; ++j) {
    const uint32_t l = kLanePairs[j][0], m = kLanePairs[j][1];
    pairs[j] = _mm512_sub_pd(load_two(boxes.q[l], boxes.q[m]), load_two(boxes.p[l], boxes.p[m]));
  }
  const Points back = turn(pairs[0], pairs[1], pairs[2], pairs[3]);
  Extents reach = v.extents;
  reach.include(back);
  const Lanes bound = v.extents.bound(), line_bound = reach.bound();
  const __m256i cuts = _mm256_setr_epi32(static_cast<int>(*boxes.records[0]), static_cast<int>(*boxes.records[1]),
                                         static_cast<int>(*boxes.records[2]), static_cast<int>(*boxes.records[3]),
                                         static_cast<int>(*boxes.records[4]), static_cast<int>(*boxes.records[5]),
                                         static_cast<int>(*boxes.records[6]), static_cast<int>(*boxes.records[7]));
  FacetSets pierced_sets, second_sets, candidate_sets;
  Lanes least = Lanes::all(HUGE_VAL);
  uint32_t open = 0, any = 0;
#pragma GCC unroll 6
  for (uint32_t f = 0; f < 6; ++f) {
    const uint8_t(&corners)[4] = kBoxFacets[f];
    const Quads quads = make_quads(v.at[corners[0]], v.at[corners[1]], v.at[corners[2]], v.at[corners[3]],
                                   _mm256_test_epi32_mask(cuts, _mm256_set1_epi32(1 << f)));
    least.v = _mm512_min_pd(least.v, _mm512_min_pd(_mm512_abs_pd(quads.first.v), _mm512_abs_pd(quads.second.v)));
    const uint32_t out1 = Lanes::greater(quads.first, bound), out2 = Lanes::greater(quads.second, bound);
    if ((out1 | out2) == 0) continue;  // a wrong guess costs less than line tests that nobody needs
    const Piercings lines = pierce(quads, out1, out2, back, line_bound);
    pierced_sets.add(f, lines.pierced);
    second_sets.add(f, lines.second);
    candidate_sets.add(f, out1 | out2);
    open |= (out1 | out2) & ~lines.settled;
    any |= out1 | out2;
  }
  sure = v.extents.in_range() & Lanes::greater(least, bound) & (~any | (reach.in_range() & ~open));
  pierced_sets.store(pierced);
  second_sets.store(second);
  candidate_sets.store(candidates);
}
