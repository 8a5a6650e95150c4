// Through which simplex of its boundary does a segment leave a cell? The boundary walk : only planes with the target
// outside are candidates; if there is none, the rest of the segment stays inside. Of several candidates exact line
// tests tell which is pierced. It needs no centre, and no convexity either: where a cell is not convex the segment can
// leave it more than once, and the earliest exit after the entry counts.

/** How the segment came into a cell. */
struct Entry {
  bool may_have_been_here = false;  // by this segment, before this entry
  Cell from;                        // the cell before
  uint32_t simplex = 0;             // of that cell, crossed last
  HalfFacet through;                // the facet crossed last, seen from the cell entered; invalid for the first cell
  bool is_cuboid = false;           // points have moved, and the cell entered is one

  /** The facet crossed has the target inside, since the segment came in through it: its bit, for a form whose links end
   * a unit. Nothing is asked about it. */
  uint32_t known_inside(uint32_t facet_count) const noexcept {
    return through.valid() ? 1u << (through.word % kUnitWords<3> - (kUnitWords<3> - facet_count)) : 0;
  }
};

/** The line of a cast, for polyhedra. Apart from what every cast has, which stays small so. */
struct CastLine {
  Shear shear;
  uint32_t pierced = 0, passed = 0;  // after a look of kLines, see LineExits
};

template <int D, class Tally>
class ExitFinder {
 public:
  ExitFinder(const Environment<D>& env, const double* p, const double* q, Tally& tally)
      : env_(env), map_(env.map), p_(p), q_(q), tally_(tally) {}

  /** From p to q. In the plane there are no cells that ask for it. */
  CastLine line() const noexcept {
    if constexpr (D == 3) return {{p_, q_}};
    return {};
  }

  /** The first half of finding the exit: all planes of a cell that has a kernel, without a branch on their signs.
   * `line`: from p to q; may be unwritten where no cell is of general shape. */
  DSW_HOT Look look(Cell c, const Entry& entry, CastLine& line) noexcept {
    const uint32_t* w = map_.record(c);
    const Form form = form_of(w[0]);
    if constexpr (D == 3) {
      if (form == Form::kSimplex) {
        const uint32_t known = entry.known_inside(4);
        tally_.tests(known == 0 ? 4 : 3);
        const uint32_t seen = look_at_tetrahedron(env_, w, q_, known, uncounted_);
        return Look::of_planes(seen & ~kFar, 4, (seen & kFar) != 0);
      }
      if (form == Form::kBox) {
        if ((w[0] & map_.convex_bit) == 0 && !entry.is_cuboid) return Look::of_box(box_exits(env_, w, p_, q_), tally_);
        const uint32_t known = entry.known_inside(6);
        tally_.tests(known == 0 ? 6 : 5);
        return Look::of_planes(outside_flat_box(env_, w, q_, known, uncounted_), 6);
      }
      if (form == Form::kPyramid && (w[0] & map_.convex_bit) != 0) {
        const uint32_t known = entry.known_inside(5);
        tally_.tests(known == 0 ? 5 : 4);
        return Look::of_planes(outside_flat_pyramid(env_, w, q_, known, uncounted_), 5);
      }
      if (form == Form::kGeneral) {
        const Shape shape = map_.general_shape(w[0]);
        if (has_line_exits(shape)) {
          const LineExits exits = look_along(w, shape, line.shear);
          line.pierced = exits.pierced;
          line.passed = exits.passed;
          tally_.tests(shape.edge_count() + bit_count(exits.ahead | exits.passed));
          return Look::of_lines(exits.sure && exits.pierced != 0 && exits.ahead == exits.pierced, exits.sure);
        }
      }
    }
    return Look::of_nothing();
  }

  /** The second half, with the same line: which facet it is. `forecast`: a facet to ask first, where that saves asking
   * the others. */
  DSW_HOT Exit choose(Cell c, const Look& look, const CastLine& line, const Entry& entry, uint32_t forecast) noexcept {
    if constexpr (D == 3) {
      if (look.kind() == LookKind::kPlanes) return exit_flat(c, look);
      if (look.kind() == LookKind::kBox) return exit_box(map_.record(c), look, entry);
      if (look.kind() == LookKind::kLines && look.is_sure() && line.pierced != 0) return exit_along(c, line, entry);
      if (map_.convex(c)) return apart().exit_many_flat(c, forecast);
    } else {
      if (map_.convex(c)) return exit_polygon(c, entry, forecast);
    }
    return apart().exit_many(c, entry);
  }

  /** Whether q lies in a cell, p being its centre. Where planes alone decide the centre is not asked: that of a sliver
   * can round to a point outside. */
  bool contains(Cell c) noexcept {
    const uint32_t* w = map_.record(c);
    if constexpr (D == 3) {
      if (form_of(w[0]) == Form::kSimplex) return (look_at_tetrahedron(env_, w, q_, 0, uncounted_) & ~kFar) == 0;
    }
    if (!map_.convex(c)) {
      CastLine along = line();
      const Look seen = look(c, Entry{}, along);
      return choose(c, seen, along, Entry{}, kNoFacet).facet == kStays;
    }
    const Shape shape = map_.shape(c);
    for (uint32_t f = 0; f < shape.facet_count(); ++f) {
      const double* points[D];
      points_of(c, shape.simplices() + D * shape.simplex_first(f), points);
      if (is_outside(points, q_)) return false;
    }
    return true;
  }

  /** The triangle of a cuboid's facet that the segment leaves through. */
  DSW_NOINLINE uint32_t pierced_triangle(Cell c, uint32_t facet) noexcept {
    const double* triangle[D];
    boundary_points(env_, c, 2 * facet, triangle);
    return 2 * facet + (passes_inside(triangle, 2) ? 0 : 1);  // ridge 2 is the facet's diagonal
  }

 private:
  /** Single precision first, where there is any. */
  DSW_HOT LineExits look_along(const uint32_t* w, const Shape& shape, const Shear& line) noexcept {
    if (!env_.local_points.empty()) {
      const LineExits exits = near_exits(env_, w, shape, line);
      if (DSW_LIKELY(exits.sure)) return exits;
    }
    return line_exits(env_, w, shape, line);
  }

  /** The planes of a kernel are counted before, their fallbacks are not tests of their own. */
  struct Uncounted {
    Tally& tally;
    void test() noexcept {}
    void exact() noexcept { tally.exact(); }
    void tie() noexcept { tally.tie(); }
  };

  /** A copy for what is not inlined: an object whose address is passed on lives in memory, this one in registers. */
  DSW_HOT ExitFinder apart() const noexcept { return *this; }

  void points_of(Cell c, const uint16_t* local, const double* (&out)[D]) const noexcept {
    for (int i = 0; i < D; ++i) out[i] = env_.point(c, local[i]);
  }

  /** Whether the segment passes ridge k of a simplex, ridges in order, on the side of the simplex. */
  bool passes_inside(const double* const (&points)[D], int k) noexcept {
    return ridge_side(p_, q_, points, k, tally_) > 0;
  }

  bool is_outside(const double* const (&points)[D], const double* x) noexcept {
    return plane_side<D>(points, x, tally_).sign > 0;
  }

  // Cells that are convex with flat facets: one plane a facet, and p is inside all of them.

  /** Tells of two facets that both have q outside whether the segment passes their common ridge on the side of f. 0:
   * the facets share no ridge. The cell is a tetrahedron, a pyramid or a box. */
  DSW_HOT int keeps(Cell c, uint32_t f, uint32_t g) noexcept {
    const double* ridge[2];
    if (!shared_ridge(env_, map_.record(c), f, g, ridge)) return 0;
    return line_side<3>(p_, q_, ridge, tally_).sign;
  }

  bool pierces_facet(Cell c, const Shape& shape, uint32_t f) noexcept {
    for (uint32_t d = shape.facet_first(f); d < shape.facet_first(f + 1); ++d) {
      const double* ridge[2] = {env_.point(c, shape.dart_vertex(d)), env_.point(c, shape.dart_vertex(shape.beta1(d)))};
      if (line_side<3>(p_, q_, ridge, tally_).sign < 0) return false;
    }
    return true;
  }

  DSW_HOT Exit exit_flat(Cell c, const Look& look) noexcept {
    return look.facets() == 0 ? Exit{} : exit_of_several(c, look);
  }

  DSW_HOT Exit exit_of_several(Cell c, const Look& look) noexcept {
    const uint32_t outside = look.facets();
    uint32_t f = lowest_bit(outside);
    for (uint32_t rest = outside & (outside - 1); rest != 0; rest &= rest - 1) {
      const uint32_t g = lowest_bit(rest);
      const int side = keeps(c, f, g);
      if (DSW_UNLIKELY(side == 0)) return apart().first_pierced(c, outside);
      f = side < 0 ? g : f;
    }
    return look.exit_by(f);
  }

  /** Facets without a common ridge can both have q outside (a cell that narrows): then each is asked in full. */
  DSW_COLD Exit first_pierced(Cell c, uint32_t outside) noexcept {
    const Shape shape = map_.shape(c);
    for (; outside != 0; outside &= outside - 1) {
      const uint32_t f = lowest_bit(outside);
      if (pierces_facet(c, shape, f)) return {f, shape.simplex_first(f)};
    }
    return {};
  }

  DSW_NOINLINE Exit exit_many_flat(Cell c, uint32_t forecast) noexcept {
    const Shape shape = map_.shape(c);
    const double* points[D];
    const auto leaves_through = [&](uint32_t f) {
      points_of(c, shape.simplices() + D * shape.simplex_first(f), points);
      return is_outside(points, q_) && pierces_facet(c, shape, f);
    };
    if (forecast < shape.facet_count() && leaves_through(forecast)) return {forecast, shape.simplex_first(forecast)};
    for (uint32_t f = 0; f < shape.facet_count(); ++f) {
      if (f != forecast && leaves_through(f)) return {f, shape.simplex_first(f)};
    }
    return {};
  }

  /** In the plane, where simplices are numbered as sides. */
  DSW_HOT Exit exit_polygon(Cell c, const Entry& entry, uint32_t forecast) noexcept {
    const uint32_t entered = entry.through.valid() ? map_.local_of(entry.through, c) : kNoFacet;
    const uint32_t side = ConvexPolygon<Tally>(env_, c, p_, q_, tally_).exit(entered, forecast);
    return {side, side};
  }

  // Cells that need not be convex: one plane a simplex. Of a hexahedron the lanes decide nearly all; what they leave
  // open is asked triangle by triangle.

  /** The earliest of the exits seen so far. */
  struct Earliest {
    Exit exit;
    const double* points[D] = {};
  };

  /** A simplex with q outside that the segment pierces outwards, after the entry: keeps it if it is the earliest. */
  void consider(uint32_t facet, uint32_t simplex, const double* const (&points)[D], const Entry& entry,
                Earliest& best) noexcept {
    if (entry.may_have_been_here) {
      const double* entered[D];
      boundary_points(env_, entry.from, entry.simplex, entered);
      if (compare_times<D>(p_, q_, points, entered, tally_).sign <= 0) return;
    }
    if (best.exit.facet != kStays && compare_times<D>(p_, q_, points, best.points, tally_).sign >= 0) return;
    best.exit = {facet, simplex};
    std::copy(points, points + D, best.points);
  }

  DSW_HOT Exit exit_box(const uint32_t* w, const Look& look, const Entry& entry) noexcept {
    if (DSW_UNLIKELY(!look.has_one_exit() || entry.may_have_been_here)) return apart().exit_box_in_full(w, look, entry);
    return look.facets() == 0 ? Exit{} : look.exit_of_box();
  }

  DSW_COLD Exit exit_box_in_full(const uint32_t* w, const Look& look, const Entry& entry) noexcept {
    const bool sure = look.facets() != kNotKnown;
    Earliest best;
    for (uint32_t i = 0; i < 12; ++i) {
      const uint32_t f = i / 2, half = i % 2;
      const double* triangle[3];
      box_triangle(env_, w, f, half, triangle);
      const bool pierced = sure ? (look.facets() >> f & 1u) != 0 && look.is_second(f) == half : pierces(triangle);
      if (pierced) consider(f, i, triangle, entry, best);
    }
    return best.exit;
  }

  /** Finds the exit among the triangles that the line pierces outwards. A segment in the cell can leave it nowhere
   * else, so if there is a single triangle, only the target is asked about it. */
  DSW_HOT Exit exit_along(Cell c, const CastLine& line, const Entry& entry) noexcept {
    const uint32_t pierced = line.pierced;
    if (DSW_UNLIKELY((pierced & (pierced - 1)) != 0)) return apart().earliest_of(c, pierced, entry);
    const Shape shape = map_.general_shape(map_.record(c)[0]);
    const uint32_t s = lowest_bit(pierced);
    if ((line.passed >> s & 1u) == 0) {
      const double* points[D];
      points_of(c, shape.simplices() + static_cast<uint32_t>(D) * s, points);
      if (!is_outside(points, q_)) return {};
    }
    return exit_through(c, shape, s);
  }

  /** A flat facet is named by its first simplex. */
  Exit exit_through(Cell c, const Shape& shape, uint32_t s) const noexcept {
    const uint32_t facet = shape.simplex_facets(D)[s];
    return {facet, map_.convex(c) ? shape.simplex_first(facet) : s};
  }

  DSW_NOINLINE Exit earliest_of(Cell c, uint32_t pierced, const Entry& entry) noexcept {
    Earliest best;
    const Shape shape = map_.shape(c);
    for (; pierced != 0; pierced &= pierced - 1) {
      const uint32_t s = lowest_bit(pierced);
      const double* points[D];
      points_of(c, shape.simplices() + static_cast<uint32_t>(D) * s, points);
      if (!is_outside(points, q_) || is_outside(points, p_)) continue;
      const Exit exit = exit_through(c, shape, s);
      consider(exit.facet, exit.simplex, points, entry, best);
    }
    return best.exit;
  }

  /** Whether the segment passes through a simplex from inside to outside. */
  bool pierces(const double* const (&points)[D]) noexcept {
    if (!is_outside(points, q_) || is_outside(points, p_)) return false;
    for (int k = 0; k < D; ++k) {
      if (!passes_inside(points, k)) return false;
    }
    return true;
  }

  DSW_NOINLINE Exit exit_many(Cell c, const Entry& entry) noexcept {
    Earliest best;
    const Shape shape = map_.shape(c);
    const uint16_t* facets = shape.simplex_facets(D);
    for (uint32_t s = 0; s < shape.simplex_count(); ++s) {
      const double* points[D];
      points_of(c, shape.simplices() + static_cast<uint32_t>(D) * s, points);
      if (pierces(points)) consider(facets[s], s, points, entry, best);
    }
    return best.exit;
  }

  const Environment<D>& env_;
  const Map<D>& map_;
  const double* p_;
  const double* q_;
  Tally& tally_;
  Uncounted uncounted_{tally_};
};
