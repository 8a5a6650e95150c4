// Hexahedra that need not be convex, eight casts at a time, a lane for each: the signs of box.inl bit for bit.

/** Of boxes that need not be convex: BoxExits, a facet at a time. */
struct WarpedBoxExits {
  uint8_t pierced[kAbreast], second[kAbreast], candidates[kAbreast];
  uint32_t sure;  // boxes for which the filter settled all that matters

  /** `from`: where the casts start. */
  void look(const double* points, const Abreast& boxes, const double* const (&from)[kAbreast]) noexcept;
};

__attribute__((noinline)) inline void WarpedBoxExits::look(const double* points, const Abreast& boxes,
                                                           const double* const (&from)[kAbreast]) noexcept {
  const VerticesAbreast<8> v(points, boxes, {8, 9, 10, 11, 12, 13, 14, 15}, ~0u);
  const Points p = load_points([&](uint32_t lane) { return from[lane]; });
  const Points q = load_points([&](uint32_t lane) { return boxes.q[lane]; });
  const Points back = {q.x - p.x, q.y - p.y, q.z - p.z};
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
    pierced_sets.add(1 << f, lines.pierced);
    second_sets.add(1 << f, lines.second);
    candidate_sets.add(1 << f, out1 | out2);
    open |= (out1 | out2) & ~lines.settled;
    any |= out1 | out2;
  }
  sure = ~(v.extents.out_of_range() | not_greater(least, bound) | (any & (reach.out_of_range() | open)));
  pierced_sets.store(pierced);
  second_sets.store(second);
  candidate_sets.store(candidates);
}
