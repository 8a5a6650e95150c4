// Hexahedra that need not be convex, kAbreast casts at a time, a lane for each: the signs of box.inl bit for bit.

/** Of boxes that need not be convex: BoxExits, a facet at a time. */
struct WarpedBoxExits {
  FacetSet pierced[kAbreast], second[kAbreast], candidates[kAbreast];
  uint32_t sure;  // boxes for which the filter settled all that matters

  /** `from`: where the casts start. */
  void look(const double* points, const Abreast& boxes, const double* const (&from)[kAbreast]) noexcept;
};

__attribute__((noinline)) inline void WarpedBoxExits::look(const double* points, const Abreast& boxes,
                                                           const double* const (&from)[kAbreast]) noexcept {
  const VerticesAbreast<8> v(points, boxes, {8, 9, 10, 11, 12, 13, 14, 15}, ~0u);
  const PointsOf<Row> p = load_points([&](uint32_t lane) { return from[lane]; });
  const PointsOf<Row> q = load_points([&](uint32_t lane) { return boxes.q[lane]; });
  const PointsOf<Row> back = {q.x - p.x, q.y - p.y, q.z - p.z};
  Extents reach = v.extents;
  reach.include(back);
  const Row bound = v.extents.bound(), line_bound = reach.bound();
  const Words cuts([&](uint32_t lane) { return *boxes.records[lane]; });
  FacetSets pierced_sets, second_sets, candidate_sets;
  Row smallest = Row::all(HUGE_VAL);
  uint32_t open = 0, any = 0;
#pragma GCC unroll 6
  for (uint32_t f = 0; f < 6; ++f) {
    const uint8_t(&corners)[4] = kBoxFacets[f];
    const Quads<Row> quads =
        make_quads(v.at[corners[0]], v.at[corners[1]], v.at[corners[2]], v.at[corners[3]], cuts.have(1u << f));
    smallest = least(smallest, least(Row::absolute(quads.first), Row::absolute(quads.second)));
    const uint32_t out1 = Row::bits(Row::greater(quads.first, bound)),
                   out2 = Row::bits(Row::greater(quads.second, bound));
    if ((out1 | out2) == 0) continue;  // a wrong guess costs less than line tests that nobody needs
    const Piercings lines = pierce(quads, out1, out2, back, line_bound);
    pierced_sets.add(1 << f, mask_of(lines.pierced));
    second_sets.add(1 << f, mask_of(lines.second));
    candidate_sets.add(1 << f, mask_of(out1 | out2));
    open |= (out1 | out2) & ~lines.settled;
    any |= out1 | out2;
  }
  sure = ~(Row::bits(either(v.extents.out_of_range(), not_greater(smallest, bound))) |
           (any & (Row::bits(reach.out_of_range()) | open)));
  pierced_sets.store(pierced);
  second_sets.store(second);
  candidate_sets.store(candidates);
}
