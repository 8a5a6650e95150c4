// One cast from its start to its end; see cast.h. Included once for each instruction set, in a namespace of its own,
// after the headers it needs: nothing that another translation unit might share is compiled for a machine it may not
// run on.

// Each needs the one before. kAbreast: casts that are looked at together.
// clang-format off
#if defined(DSW_ISA_AVX512)
constexpr uint32_t kAbreast = 8;
#elif defined(DSW_ISA_AVX2)
constexpr uint32_t kAbreast = 4;
#else
constexpr uint32_t kAbreast = 2;
#endif
#include "walk/lanes.inl"
#include "walk/box.inl"
#include "walk/simplex.inl"
#include "walk/pyramid.inl"
#include "walk/look.inl"
#include "walk/rows.inl"
#include "walk/abreast.inl"
#include "walk/boxes.inl"
#include "walk/ridges.inl"
#include "walk/sightlines.inl"
#include "walk/polyhedron.inl"
#include "walk/polygon.inl"
#include "walk/exit.inl"
// clang-format on

/** One bit of 64 for a cell. All visited cells' bits together say "never entered before" for certain; the opposite is
 * only a suspicion, which costs a comparison of times and nothing else. A line comes into a convex cell once, so those
 * are not noted. */
inline uint64_t visit_bit(Cell c) { return uint64_t{1} << ((c.unit * 0x9e3779b1u) >> 26); }

/** Tells what Map::convex tells, by word 0 of a record and the map's bit. */
inline bool is_convex(uint32_t word, uint32_t convex_bit) {
  return form_of(word) == Form::kSimplex || (word & convex_bit) != 0;
}

#include "walk/admits.inl"
#include "walk/line_walk.inl"

/** Where a cast is on its way. */
struct Flight {
  HalfFacet at;                     // the facet it leaves its cell through
  uint32_t simplex = 0;             // of that
  HalfFacet through;                // the facet crossed last, seen from the cell entered; invalid in the first cell
  bool may_have_been_here = false;  // in its cell, before it came through that facet
  bool is_far = false;              // from its target, and in a tetrahedron
  uint64_t visited = 0;             // bits of the cells it has been in that need not be convex
};

/** Casts side by side. One step of a cast is three waits (for a cell's record, for its vertices, for the sign of a
 * plane that nobody can predict); a pass over many casts for each of the three overlaps what one cast alone would sit
 * through. */
template <int D, class Tally>
class Walkers {
 public:
  Walkers(const Environment<D>& env, const CastRequest* requests, CastResult* results, Tally tally)
      : env_(env),
        map_(env.map),
        requests_(requests),
        results_(results),
        tally_(tally),
        has_polyhedra_(!env.map.shape_offsets.empty()),
        moving_(env.has_moved()),
        line_walk_(env, requests, results) {}

  void run(uint32_t count) noexcept {
    count = begin_all(count);
    count = leave_all<true>(count);
    while ((count != 0) | !line_walk_.empty()) {
      if (moving_) {
        for (uint32_t k = 0; k < count; ++k) prefetch_beyond(env_, flights_[active_[k]].at);
      }
      count = enter_all(count);
      if (!line_walk_.empty()) count = follow_lines(count);
      count = leave_all<false>(count);
    }
  }

 private:
  ExitFinder<D, Tally> finder(uint32_t i) noexcept { return {env_, requests_[i].from, requests_[i].to, tally_}; }
  template <bool First>
  DSW_HOT Entry entry(uint32_t i) const noexcept {
    if (First) {
      Entry start;
      start.is_cuboid = in_cuboid(i);
      return start;
    }
    const Flight& f = flights_[i];
    return {f.may_have_been_here, results_[i].previous, results_[i].simplex, f.through, in_cuboid(i)};
  }

  /** Copied whole: member by member GCC 12 makes a loop of each. */
  DSW_HOT void begin(uint32_t i) noexcept {
    static constexpr CastResult kFresh{};
    new (results_ + i) CastResult(kFresh);
    results_[i].cell = requests_[i].start;
    if (D == 3 && has_polyhedra_) new (lines_ + i) CastLine(finder(i).line());
  }

  /** Whether points have moved and the cell of a cast is a cuboid: convex and flat, though its record does not say so. */
  DSW_HOT bool in_cuboid(uint32_t i) const noexcept { return D == 3 && moving_ && in_cuboids_[i]; }

  /** Keeps the casts that may leave where they start. */
  DSW_HOT uint32_t begin_all(uint32_t count) noexcept {
    bool some_end = false;
    if (D == 3 && moving_) {
      for (uint32_t i = 0; i < count; ++i) in_cuboids_[i] = find_out_cuboid(env_, requests_[i].start);
    }
    DSW_UNROLL(1)
    for (uint32_t i = 0; i < count; ++i) {
      begin(i);
      some_end |= requests_[i].start == requests_[i].end;
    }
    std::iota(active_, active_ + kPacket, uint8_t{0});
    if (!some_end) return count;
    uint32_t kept = 0;
    for (uint32_t i = 0; i < count; ++i) {
      active_[kept] = static_cast<uint8_t>(i);
      kept += ends_in(i, requests_[i].start) ? 0 : 1;
    }
    return kept;
  }

  /** Whether a cast is known to end in a cell that it is in: it can't leave a convex one that holds its target. */
  DSW_HOT bool ends_in(uint32_t i, Cell cell) noexcept {
    return static_cast<uint32_t>(cell == requests_[i].end) & static_cast<uint32_t>(map_.convex(cell) || in_cuboid(i));
  }

  /** Finds out where casts leave their cells, and keeps those that do. First all cells are looked at, without a branch
   * on what is seen. What does not tell the exit by that is open, and decided at the end. */
  template <bool First>
  DSW_HOT uint32_t leave_all(uint32_t count) noexcept {
    if (count == 0) return 0;
    std::fill_n(active_ + count, kAbreast - 1, active_[count - 1]);  // lanes without a cast repeat the last
    kept_ = open_count_ = 0;
    for (uint32_t k = 0; k < count; k += kAbreast) {
      const uint32_t end = std::min(k + kAbreast, count);
      if (look_abreast<First>(k, end)) continue;
      for (uint32_t j = k; j < end; ++j) look<First>(active_[j]);
    }
    for (uint32_t k = 0; k < kept_; ++k) {
      const uint32_t i = active_[k];
      const Look look = looks_[i];
      if (look.kind() == LookKind::kPlanes) {
        leave_flat<First>(i, lowest_bit(look.facets()));
      } else {
        leave_box<First>(i);
      }
    }
    decide_all<First>();
    return kept_;
  }

  /** Looks at the cell of one cast. */
  template <bool First>
  DSW_HOT void look(uint32_t i) noexcept {
    looks_[i] = finder(i).look(results_[i].cell, entry<First>(i), lines_[i]);
    open_[open_count_] = static_cast<uint8_t>(i);
    open_count_ += looks_[i].may_leave() ? 1 : 0;
  }

  /** Looks at some casts together, if there are enough and the cells of all are of one form that can be. Counted casts
   * are looked at one by one: they make the same tests, in half the code. */
  template <bool First>
  DSW_HOT bool look_abreast(uint32_t first, uint32_t end) noexcept {
    if (D != 3 || Tally::kCounts) return false;
    const uint32_t word = map_.record(results_[active_[first]].cell)[0];
    const Form form = form_of(word);
    const bool flat = is_convex(word, map_.convex_bit) || in_cuboid(active_[first]);
    if (!pays_abreast(form, flat, end - first)) return false;
    const uint32_t kind = form == Form::kSimplex ? 7u << kFormShift : 7u << kFormShift | map_.convex_bit;
    Abreast cells;
    uint32_t different = 0;
    DSW_UNROLL(8)
    for (uint32_t j = 0; j < kAbreast; ++j) {
      const uint32_t i = active_[first + j];
      cells.records[j] = map_.record(results_[i].cell);
      cells.q[j] = requests_[i].to;
      different |= cells.records[j][0] ^ word;
      if (moving_ && form == Form::kBox) different |= in_cuboid(i) == flat ? 0 : kind;
    }
    if ((different & kind) != 0) return false;
    if (!flat) {
      look_warped<First>(first, end, cells);
      return true;
    }
    Sides sides;
    if (form == Form::kSimplex) {
      sides.look_at_tetrahedra(env_.points, cells);
    } else if (form == Form::kPyramid) {
      sides.look_at_pyramids(env_.points, cells);
    } else {
      sides.look_at_boxes(env_.points, cells);
    }
    note_sides<First>(first, end, sides);
    return true;
  }

  /** Keeps the casts with the target outside of one facet. The facet crossed last is not left out: it is decided that
   * the target is inside of that. */
  template <bool First>
  DSW_HOT void note_sides(uint32_t first, uint32_t end, const Sides& sides) noexcept {
    const uint32_t lanes = (1u << (end - first)) - 1, one = sides.one & lanes, several = sides.several & lanes;
    DSW_UNROLL(8)
    for (uint32_t j = 0; j < kAbreast; ++j) looks_[active_[first + j]] = Look::of_word(sides.looks[j]);
    const LaneBytes casts(active_ + first);
    casts.store(open_ + open_count_, several);
    casts.store(active_ + kept_, one);
    kept_ += count_lanes(one);
    open_count_ += count_lanes(several);
  }

  /** Looks at bent hexahedra, and keeps the casts that pierce one facet. */
  template <bool First>
  DSW_HOT void look_warped(uint32_t first, uint32_t end, const Abreast& cells) noexcept {
    const double* from[kAbreast];
    for (uint32_t j = 0; j < kAbreast; ++j) from[j] = requests_[active_[first + j]].from;
    WarpedBoxExits exits;
    exits.look(env_.points, cells, from);
    const uint32_t lanes = (1u << (end - first)) - 1, sure = exits.sure;
    const LaneBytes casts(active_ + first);
    DSW_UNROLL(8)
    for (uint32_t j = 0; j < kAbreast; ++j) looks_[active_[first + j]] = Look::of_word(exits.looks[j]);
    uint32_t been = 0;  // casts that may have been in their cell before: `decide` compares times
    for (uint32_t j = 0; !First && j < kAbreast; ++j) {
      been |= (flights_[active_[first + j]].may_have_been_here ? 1u : 0u) << j;
    }
    const uint32_t one = exits.one & ~been, open = (exits.one | exits.several) & ~one;
    casts.store(open_ + open_count_, open);  // before looks of single casts, which leave less room behind
    open_count_ += count_lanes(open);
    for (uint32_t rest = exits.several; rest != 0; rest &= rest - 1) {
      const uint32_t i = active_[first + lowest_bit(rest)];
      looks_[i] = looks_[i].with_several();
    }
    for (uint32_t rest = lanes & ~sure; rest != 0; rest &= rest - 1) {
      look<First>(active_[first + lowest_bit(rest)]);
    }
    casts.store(active_ + kept_, one);  // after the last read of active_[first...], where kept_ may point
    kept_ += count_lanes(one);
  }

  /** Decides about what is open: ridges side by side, all else one by one. */
  template <bool First>
  DSW_HOT void decide_all() noexcept {
    RidgesAbreast ridges;
    uint8_t casts[kAbreast];
    uint32_t count = 0;
    for (uint32_t k = 0; k < open_count_; ++k) {
      const uint32_t i = open_[k];
      if (leave_warped<First>(i)) continue;
      if (!add_ridge(i, count, ridges)) {
        decide<First>(i);
        continue;
      }
      casts[count++] = static_cast<uint8_t>(i);
      if (count == kAbreast) pass_ridges<First>(casts, std::exchange(count, 0), ridges);
    }
    if (count != 0) pass_ridges<First>(casts, count, ridges);
  }

  /** Lets a cast that was looked at alone leave a bent box whose one exit is known. False: `decide` has to be asked. */
  template <bool First>
  DSW_HOT bool leave_warped(uint32_t i) noexcept {
    const Look look = looks_[i];
    if (look.kind() != LookKind::kBox || !look.has_one_exit()) return false;
    if (!First && flights_[i].may_have_been_here) return false;
    active_[kept_++] = static_cast<uint8_t>(i);
    leave_box<First>(i);
    return true;
  }

  /** Adds the ridge that a cast passes. False unless just two facets have the target outside and share a ridge. */
  DSW_HOT bool add_ridge(uint32_t i, uint32_t lane, RidgesAbreast& ridges) const noexcept {
    if constexpr (D == 3 && !Tally::kCounts) {
      const Look look = looks_[i];
      if (look.kind() != LookKind::kPlanes || look.facets() >= kNotDecided) return false;
      const Ridge shared = kRidgesBySet[look.facet_count() - 4].of[look.facets()];
      if (shared.a == shared.b) return false;
      const uint32_t* const w = map_.record(results_[i].cell);
      const CastRequest& request = requests_[i];
      ridges.p[lane] = request.from;
      ridges.q[lane] = request.to;
      ridges.a[lane] = env_.point(w[shared.a] & kVertexMask);
      ridges.b[lane] = env_.point(w[shared.b] & kVertexMask);
      return true;
    }
    return false;
  }

  template <bool First>
  DSW_HOT void pass_ridges(const uint8_t* casts, uint32_t count, RidgesAbreast& ridges) noexcept {
    for (auto* const points : {ridges.p, ridges.q, ridges.a, ridges.b}) {
      std::fill(points + count, points + kAbreast, points[count - 1]);
    }
    ridges.look();
    for (uint32_t lane = 0; lane < count; ++lane) {
      const uint32_t i = casts[lane], facets = looks_[i].facets();
      if (DSW_UNLIKELY(((ridges.positive | ridges.negative) >> lane & 1u) == 0)) {
        decide<First>(i);
        continue;
      }
      const uint32_t both[2] = {lowest_bit(facets), highest_bit(facets)};
      active_[kept_++] = static_cast<uint8_t>(i);
      leave_flat<First>(i, both[ridges.negative >> lane & 1u]);
    }
  }

  /** Keeps an open cast if it leaves its cell. */
  template <bool First>
  DSW_HOT void decide(uint32_t i) noexcept {
    const Cell cell = results_[i].cell;
    if (DSW_UNLIKELY(!looks_[i].is_decided())) looks_[i] = finder(i).look(cell, entry<First>(i), lines_[i]);
    const uint32_t forecast = First ? requests_[i].forecast : kNoFacet;
    const Exit exit = finder(i).choose(cell, looks_[i], lines_[i], entry<First>(i), forecast);
    if (exit.facet == kStays) return;
    active_[kept_++] = static_cast<uint8_t>(i);
    if (looks_[i].kind() == LookKind::kPlanes) return leave_flat<First>(i, exit.facet);
    leave<First>(i, exit, map_.half_facet(cell, exit.facet), false);
    const HalfFacet beyond = map_.opposite(flights_[i].at);
    if (looks_[i].kind() == LookKind::kLines && beyond.valid()) prefetch_round(env_, beyond);
  }

  /** leave() of a box with one exit. */
  template <bool First>
  DSW_HOT void leave_box(uint32_t i) noexcept {
    const Exit exit = looks_[i].exit_of_box();
    leave<First>(i, exit, linked_facet<D>(results_[i].cell, 6, exit.facet), false);
  }

  /** leave() after a look of planes. */
  template <bool First>
  DSW_HOT void leave_flat(uint32_t i, uint32_t facet) noexcept {
    const Look look = looks_[i];
    leave<First>(i, look.exit_by(facet), look.half_facet<D>(results_[i].cell, facet), look.is_far());
  }

  /** Notes where a cast leaves its cell, and asks for what is beyond. */
  template <bool First>
  DSW_HOT void leave(uint32_t i, const Exit& exit, HalfFacet at, bool is_far) noexcept {
    const Cell cell = results_[i].cell;
    if (First) {
      new (flights_ + i) Flight;
      if (!map_.convex(cell)) flights_[i].visited = visit_bit(cell);
      results_[i].first_facet = exit.facet;
    }
    flights_[i].at = at;
    flights_[i].simplex = exit.simplex;
    flights_[i].is_far = is_far;
    const uint32_t beyond = map_.opposite(at).word;
    if (beyond == kNoFacet) return;
    prefetch_line(&map_.words[beyond - beyond % kUnitWords<D>]);
    if (D == 2) prefetch_line(&map_.words[beyond]);  // its record may lie in two lines
  }

  /** Keeps the casts that go on from the cells that they enter, but for those that follow their lines. */
  DSW_HOT uint32_t enter_all(uint32_t count) noexcept {
    uint32_t kept = 0;
    for (uint32_t k = 0; k < count; ++k) {
      const uint32_t i = active_[k];
      active_[kept] = static_cast<uint8_t>(i);
      if (!enter(i)) continue;
      if (follows_line(i)) {
        line_walk_.add(i, flights_[i].through);
      } else {
        ++kept;
      }
    }
    return kept;
  }

  DSW_HOT bool follows_line(uint32_t i) const noexcept {
    return D == 3 && flights_[i].is_far && (form_of(map_.record(results_[i].cell)[0]) == Form::kSimplex);
  }

  /** Lets casts follow their lines one cell on. Adds those that go on otherwise to the `count` active ones. */
  DSW_NOINLINE uint32_t follow_lines(uint32_t count) noexcept {
    const auto look = [&](uint32_t i, HalfFacet through) {
      active_[count++] = static_cast<uint8_t>(i);
      flights_[i].through = through;
    };
    const auto pass = [&](uint32_t i, HalfFacet at) {
      flights_[i].at = at;
      flights_[i].simplex = local_in_tetrahedron(at);
      active_[count] = static_cast<uint8_t>(i);
      count += enter(i) ? 1 : 0;
    };
    line_walk_.go(tally_, look, pass);
    return count;
  }

  /** The simplex that a cast passes as it leaves its cell. A look of planes names the first of a facet. */
  DSW_HOT uint32_t passed_simplex(uint32_t i) noexcept {
    const uint32_t simplex = flights_[i].simplex;
    return in_cuboid(i) ? finder(i).pierced_triangle(results_[i].cell, simplex / 2) : simplex;
  }

  /** Whether a cast may come in beyond its facet, and does not end there. */
  DSW_HOT bool enter(uint32_t i) noexcept {
    const CastRequest& request = requests_[i];
    Flight& f = flights_[i];
    CastResult& result = results_[i];
    const uint32_t link = map_.words[f.at.word];
    const HalfFacet o = {link & ~kMarkBit};
    const Cell next = o.valid() ? map_.cell_of(o) : Cell{};
    const uint32_t word = o.valid() ? map_.record(next)[0] : 0;
    bool is_closed = !o.valid() || (((link | word) & kMarkBit) != 0 && !request.through_walls);
    bool is_next_cuboid = false;
    if (DSW_UNLIKELY(moving_) && !is_closed) {
      const CheckedCells::Known known = known_moving(env_, next);
      is_closed = !CheckedCells::is_valid(known);
      is_next_cuboid = known == CheckedCells::Known::kCuboid;
    }
    if (is_closed) {
      result.end = CastEnd::kHit;
      result.facet = f.at;
      result.simplex = passed_simplex(i);
      return false;
    }
    if (result.volumes_visited == request.max_volumes) {  // volumes_visited is never 0, so 0 is no limit
      result.end = CastEnd::kWorkLimit;
      return false;
    }
    if (request.crossing != nullptr) request.crossing(request.crossing_user, result.cell, passed_simplex(i), next);
    result.previous = result.cell;
    result.cell = next;
    result.simplex = f.simplex;
    ++result.volumes_visited;
    f.through = o;
    if (moving_) in_cuboids_[i] = is_next_cuboid;
    if (!is_convex(word, map_.convex_bit) && !is_next_cuboid) {
      f.may_have_been_here = (f.visited & visit_bit(next)) != 0;
      f.visited |= visit_bit(next);
    } else {
      f.may_have_been_here = false;  // a line enters a convex cell once
      if (next == request.end) return false;
    }
    prefetch_vertex_beyond(env_, o);
    if (D == 3 && has_polyhedra_) prefetch_polyhedron(env_, next);
    return true;
  }

  const Environment<D>& env_;
  const Map<D>& map_;
  const CastRequest* requests_;
  CastResult* results_;
  Tally tally_;
  const bool has_polyhedra_;
  const bool moving_;  // points have
  union {              // constructs nothing
    Flight flights_[kPacket];
  };
  union {
    CastLine lines_[kPacket];  // where there are polyhedra
  };
  union {
    Look looks_[kPacket];
  };
  bool in_cuboids_[kPacket];  // where points have moved; see in_cuboid
  uint8_t active_[kPacket + kAbreast - 1];
  uint8_t open_[kPacket];  // a group writes kAbreast bytes from open_count_ on, which is at most its first cast's place
  uint32_t kept_ = 0, open_count_ = 0;
  LineWalk<D> line_walk_;
};

template <int D>
void walk_plain(const Environment<D>& env, const CastRequest* requests, uint32_t count, CastResult* results) noexcept {
  Walkers<D, CountNothing>(env, requests, results, {}).run(count);
}
#include "walk/outside.inl"
template <int D>
bool contains(const Environment<D>& env, Cell cell, const double* centre, const double* point) noexcept {
  CountNothing nothing;
  return ExitFinder<D, CountNothing>(env, centre, point, nothing).contains(cell);
}
template <int D>
bool sees_all(const Environment<D>& env, Cell cell, const double* point) noexcept {
  if constexpr (D == 3) {
    const uint32_t* const w = env.map.record(cell);
    if (form_of(w[0]) != Form::kBox) return false;
    const BoxExits exits = box_exits(env, w, point, point);
    return exits.sure && exits.candidates == 0;
  } else {
    return is_inside_all_sides(env, cell, point);
  }
}
template <int D>
constexpr Walk<D> kThisWalk = {walk_plain<D>, find_outside<D>, contains<D>, sees_all<D>, admits_with_centre<D>};
