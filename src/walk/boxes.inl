// Hexahedra that need not be convex, kAbreast casts at a time, a lane for each: the signs of box.inl bit for bit.

/** The BoxExits of boxes that need not be convex, side by side. */
struct WarpedBoxExits {
  uint32_t sure;             // a bit for each box for which the filter decided all that matters
  uint32_t one;              // a bit for each such box of which one facet is pierced outwards
  uint32_t several;          // a bit for each such box of which more facets are
  uint32_t looks[kAbreast];  // words of Looks, of these boxes; they say that at most one facet is pierced

  /** `from`: where the casts start. */
  void look(const double* points, const Abreast& boxes, const double* const (&from)[kAbreast]) noexcept;
};

DSW_NOINLINE inline void WarpedBoxExits::look(const double* points, const Abreast& boxes,
                                              const double* const (&from)[kAbreast]) noexcept {
  const VerticesAbreast<8> v(points, boxes, {8, 9, 10, 11, 12, 13, 14, 15}, ~0u);
  const PointsOf<Row> p = load_points([&](uint32_t lane) { return from[lane]; });
  const PointsOf<Row> q = load_points([&](uint32_t lane) { return boxes.q[lane]; });
  const PointsOf<Row> back = {q.x - p.x, q.y - p.y, q.z - p.z};
  Extents reach = v.extents;
  reach.include(back);
  const Row bound = v.extents.bound(), line_bound = reach.bound();
  const Words cuts([&](uint32_t lane) { return *boxes.records[lane]; });
  FacetSets exits;
  Row smallest = Row::all(HUGE_VAL);
  Row::Mask open = mask_of(0), any = open;
  DSW_UNROLL(6)
  for (uint32_t f = 0; f < 6; ++f) {
    const uint8_t(&corners)[4] = kBoxFacets[f];
    const Quads<Row> quads =
        make_quads(v.at[corners[0]], v.at[corners[1]], v.at[corners[2]], v.at[corners[3]], cuts.have(1u << f));
    smallest = least(smallest, least(Row::absolute(quads.first), Row::absolute(quads.second)));
    const Row::Mask out1 = Row::greater(quads.first, bound), out2 = Row::greater(quads.second, bound);
    const Row::Mask outside = Row::either(out1, out2);
    if (Row::bits(outside) == 0) continue;  // a wrong guess costs less than line tests that nobody needs
    const Piercings<Row> lines = pierce(quads, out1, out2, back, line_bound);
    exits.add(Look::of_box_facet(f, 0), Row::without(lines.pierced, lines.second));
    exits.add(Look::of_box_facet(f, 1), Row::both(lines.pierced, lines.second));
    open = Row::either(open, Row::without(outside, lines.decided));
    any = Row::either(any, outside);
  }
  sure = ~(Row::bits(Row::either(v.extents.out_of_range(), not_greater(smallest, bound))) |
           Row::bits(Row::both(any, Row::either(reach.out_of_range(), open))));
  sure &= (1u << kAbreast) - 1;
  exits.store(Look::of_box_cell(), looks, one, several);
  one &= sure;
  several &= sure;
}
