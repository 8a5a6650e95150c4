// Cells of one form, one of each of kAbreast casts, a lane for each: the planes of simplex.inl, pyramid.inl and box.inl
// bit for bit, but of the work for one cast only its loads are left.

/** The cells, and the targets of the casts in them. */
struct Abreast {
  const uint32_t* records[kAbreast];
  const double* q[kAbreast];
};

/** Whether it pays to look at so many such cells, flat and convex or not, side by side. Lanes without one do
 * nothing. */
constexpr bool pays_abreast(Form form, bool flat, uint32_t count) {
  if (form == Form::kBox && !flat) return count == kAbreast;
  if (form == Form::kBox) return count >= (kAbreast == 8 ? 3 : 2);
  return flat && count >= std::min(kAbreast, 3u) && (form == Form::kSimplex || form == Form::kPyramid);
}

/** Extent lane by lane. */
struct Extents {
  Row x, y, z;

  DSW_HOT Extents() noexcept : x(Row::all(0)), y(x), z(x) {}
  DSW_HOT void include(const PointsOf<Row>& v) noexcept {
    x = largest(x, Row::absolute(v.x));
    y = largest(y, Row::absolute(v.y));
    z = largest(z, Row::absolute(v.z));
  }
  /** Lanes for which bound() need not hold. */
  DSW_HOT Row::Mask out_of_range() const noexcept {
    return either(Row::greater(Row::all(kFilterMin), least(least(x, y), z)),
                  Row::greater(largest(largest(x, y), z), Row::all(kFilterMax)));
  }
  DSW_HOT Row bound() const noexcept { return Row::all(kPlaneFilter3) * x * y * z; }
};

/** Some vertices of the cells, relative to q. `words`: which words of the records name them, in bits of `mask`. */
template <uint32_t Count>
struct VerticesAbreast {
  PointsOf<Row> at[Count];
  Extents extents;

  DSW_HOT VerticesAbreast(const double* points, const Abreast& cells, const uint32_t (&words)[Count],
                          uint32_t mask) noexcept {
    const PointsOf<Row> q = load_points([&](uint32_t lane) { return cells.q[lane]; });
    DSW_UNROLL(8)
    for (uint32_t i = 0; i < Count; ++i) {
      const PointsOf<Row> v =
          load_points([&](uint32_t lane) { return points + size_t{cells.records[lane][words[i]] & mask} * 3; });
      at[i] = {v.x - q.x, v.y - q.y, v.z - q.z};
      extents.include(at[i]);
    }
  }
};

/** The looks of cells that are convex with flat facets, side by side. */
struct Sides {
  uint32_t looks[kAbreast];  // words of Looks
  uint32_t one;              // a bit for each cell with q outside of exactly one facet
  uint32_t several;          // and for each with q outside of more, or of which the filter left a facet open

  void look_at_tetrahedra(const double* points, const Abreast& cells) noexcept;
  void look_at_pyramids(const double* points, const Abreast& cells) noexcept;
  void look_at_boxes(const double* points, const Abreast& cells) noexcept;
};

/** Planes of facets, as they are tested. */
template <uint32_t Count>
struct PlanesAbreast {
  VerticesAbreast<Count> v;
  Row bound, minus_bound, smallest;
  FacetSets outside;

  DSW_HOT PlanesAbreast(const double* points, const Abreast& cells, const uint32_t (&words)[Count],
                        uint32_t mask = ~0u) noexcept
      : v(points, cells, words, mask),
        bound(v.extents.bound()),
        minus_bound(Row::all(0) - bound),
        smallest(Row::all(HUGE_VAL)) {}

  DSW_HOT PointsOf<Row> across(uint32_t a, uint32_t b) const noexcept { return cross(v.at[a], v.at[b]); }
  /** q is outside of a facet where the determinant of two vectors, crossed, and a vertex is positive. */
  DSW_HOT void positive(uint32_t facet, const PointsOf<Row>& crossed, uint32_t vertex) noexcept {
    const Row det = dot(crossed, v.at[vertex]);
    outside.add(1 << facet, Row::greater(det, bound));
    smallest = least(smallest, Row::absolute(det));
  }
  /** Or negative. */
  DSW_HOT void negative(uint32_t facet, const PointsOf<Row>& crossed, uint32_t vertex) noexcept {
    const Row det = dot(crossed, v.at[vertex]);
    outside.add(1 << facet, Row::greater(minus_bound, det));
    smallest = least(smallest, Row::absolute(det));
  }
  DSW_HOT void store(uint32_t facet_count, Sides& sides) noexcept {
    outside.add(kNotDecided, either(v.extents.out_of_range(), not_greater(smallest, bound)));
    outside.store(Look::of_cell(facet_count), sides.looks, sides.one, sides.several);
  }
};

DSW_NOINLINE inline void Sides::look_at_tetrahedra(const double* points, const Abreast& cells) noexcept {
  PlanesAbreast<4> planes(points, cells, {0, 1, 2, 3}, kVertexMask);
  const PointsOf<Row> c01 = planes.across(0, 1), c23 = planes.across(2, 3);
  planes.negative(0, c01, 3);
  planes.negative(1, c23, 1);
  planes.positive(2, c23, 0);
  planes.positive(3, c01, 2);
  const PointsOf<Row>&v = planes.v.at[0], &w = planes.v.at[1];
  const auto longest = [](Row x, Row y, Row z) {
    return largest(largest(Row::absolute(x), Row::absolute(y)), Row::absolute(z));
  };
  planes.outside.add(Look::kFlag, Row::greater(longest(v.x, v.y, v.z),
                                               Row::all(kFarEdges) * longest(v.x - w.x, v.y - w.y, v.z - w.z)));
  planes.store(4, *this);
}

DSW_NOINLINE inline void Sides::look_at_pyramids(const double* points, const Abreast& cells) noexcept {
  PlanesAbreast<5> planes(points, cells, {8, 9, 10, 11, 12});
  planes.positive(0, planes.across(2, 3), 0);
  const PointsOf<Row> first = planes.across(0, 4), second = planes.across(4, 2);
  planes.positive(1, first, 1);
  planes.positive(2, second, 1);
  planes.negative(3, second, 3);
  planes.negative(4, first, 3);
  planes.store(5, *this);
}

/** The vertices 1 2 3 7 4 5: three in a row, the ring closed, span a facet. Each cross product serves both facets at
 * its edge: with the vertex after, an even one; before, an odd one. */
DSW_NOINLINE inline void Sides::look_at_boxes(const double* points, const Abreast& cells) noexcept {
  PlanesAbreast<6> planes(points, cells, {9, 10, 11, 15, 12, 13});
  const auto test_beside = [&](uint32_t a, uint32_t even, uint32_t odd) {
    const PointsOf<Row> crossed = planes.across(a, a + 1);
    planes.positive(even, crossed, (a + 2) % 6);
    planes.negative(odd, crossed, (a + 5) % 6);
  };
  test_beside(0, 4, 1);
  test_beside(2, 0, 3);
  test_beside(4, 2, 5);
  planes.store(6, *this);
}
