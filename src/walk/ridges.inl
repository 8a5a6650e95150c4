// Flat convex cells with the target outside of two facets. On which side the line passes the ridge that both share
// tells which of them it pierces. kAbreast casts at a time, by line_side of predicates/filtered.h bit for bit.

/** By the set of two facets that share a ridge: the words of a cell's record that name the ridge's vertices, in the
 * order of the facet with the lower number. a == b for other sets. */
struct RidgesBySet {
  Ridge of[64];
};

template <uint32_t Facets>
constexpr RidgesBySet ridges_by_set(const RidgeTable<Facets>& ridges, uint32_t first_word) {
  RidgesBySet table{};
  for (uint32_t f = 0; f < Facets; ++f) {
    for (uint32_t g = f + 1; g < Facets; ++g) {
      const Ridge shared = ridges.of[f][g];
      if (shared.a == shared.b) continue;
      table.of[1u << f | 1u << g] = {static_cast<uint8_t>(shared.a + first_word),
                                     static_cast<uint8_t>(shared.b + first_word)};
    }
  }
  return table;
}
/** The ridges of cells with four, five and six facets. */
constexpr RidgesBySet kRidgesBySet[3] = {ridges_by_set(kTetrahedronRidges, 0),
                                         ridges_by_set(kPyramidRidges, kUnitWords<3>),
                                         ridges_by_set(kBoxRidges, kUnitWords<3>)};

/** Casts p -> q, and the ridges a -> b that they pass. */
struct RidgesAbreast {
  const double *p[kAbreast], *q[kAbreast], *a[kAbreast], *b[kAbreast];
  uint32_t positive, negative;  // the sign of line_side, a bit each. Neither: the filter left it open

  void look() noexcept;
};

DSW_NOINLINE inline void RidgesAbreast::look() noexcept {
  const auto load = [](const double* const(&points)[kAbreast]) {
    return load_points([&](uint32_t lane) { return points[lane]; });
  };
  const auto subtract = [](const PointsOf<Row>& x, const PointsOf<Row>& y) -> PointsOf<Row> {
    return {x.x - y.x, x.y - y.y, x.z - y.z};
  };
  const PointsOf<Row> from = load(p);
  const PointsOf<Row> way = subtract(load(q), from), tail = subtract(load(a), from), tip = subtract(load(b), from);
  Extents extents;
  extents.include(way), extents.include(tail), extents.include(tip);
  const Row det = dot(cross(way, tail), tip), bound = extents.bound();
  const uint32_t in_range = ~Row::bits(extents.out_of_range());
  positive = Row::bits(Row::greater(det, bound)) & in_range;
  negative = Row::bits(Row::greater(Row::all(0) - bound, det)) & in_range;
}
