// One cast from its start to its end; see cast.h. Included once for each instruction set, in a namespace of its own,
// after the headers it needs: nothing that another translation unit might share is compiled for a machine it may not
// run on.

// Each needs the one before.
// clang-format off
#include "walk/lanes.inl"
#include "walk/box.inl"
#include "walk/simplex.inl"
#include "walk/pyramid.inl"
#if defined(DSW_ISA_AVX512)
#define DSW_ABREAST 1
constexpr uint32_t kAbreast = 8;  // casts that are looked at together
#include "walk/abreast.inl"
#include "walk/boxes.inl"
#elif defined(DSW_ISA_AVX2)
#define DSW_ABREAST 1
constexpr uint32_t kAbreast = 4;
#include "walk/abreast.inl"
#else
constexpr uint32_t kAbreast = 1;
#endif
#include "walk/polyhedron.inl"
#include "walk/polygon.inl"
#include "walk/exit.inl"
// clang-format on

/** One bit of 64 for a cell. All visited cells' bits together say "never entered before" for certain; the opposite is
 * only a suspicion, which costs a comparison of times and nothing else. */
inline uint64_t visit_bit(Cell c) { return uint64_t{1} << ((c.unit * 0x9e3779b1u) >> 26); }

/** As find_out_validity, with the cell's centre. */
template <int D>
bool find_out_validity(const Environment<D>& env, Cell c, const double* apex) noexcept {
  if constexpr (D == 3) {
    const uint32_t* const w = env.map.record(c);
    if (form_of(w[0]) == Form::kBox && is_plainly_valid(env, w, apex)) {
      env.checked.note(env.map.index(c), CheckedCells::Known::kValid);
      return true;
    }
  }
  return dsw::find_out_validity(env, c);
}

/** As admits; gives the cell's centre, too. */
template <int D>
bool admits_with_centre(const Environment<D>& env, Cell c, double* apex) noexcept {
  centre(env, c, apex);
  if (!env.checked.active()) return true;
  const CheckedCells::Known known = env.checked.known(env.map.index(c));
  return known == CheckedCells::Known::kNothing ? find_out_validity(env, c, apex)
                                                : known == CheckedCells::Known::kValid;
}

/** A cast that has left its first cell, or is about to. */
struct Flight {
  Exit exit;
  HalfFacet at;   // the facet of `exit`
  uint32_t link;  // its link: the facet seen from beyond, with its mark
  Entry entry;
  uint64_t visited;
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
        moving_(env.checked.active()) {}

  void run(uint32_t count) noexcept {
    count = begin_all(count);
    count = look_all<true>(count);
    count = keep(count, [&](uint32_t i) { return leave_first(i); });
    for (;;) {
      if (moving_) prefetch_beyond(count);
      count = keep(count, [&](uint32_t i) { return enter(i); });
      if (count == 0) return;
      count = look_all<false>(count);
      count = keep(count, [&](uint32_t i) { return leave(i); });
    }
  }

 private:
  /** Of the first `count` active casts keeps those for which a step says so. */
  template <class Step>
  DSW_HOT uint32_t keep(uint32_t count, Step step) noexcept {
    uint32_t kept = 0;
    for (uint32_t k = 0; k < count; ++k) {
      const uint32_t i = active_[k];
      active_[kept] = static_cast<uint8_t>(i);
      kept += step(i) ? 1 : 0;
    }
    return kept;
  }

  Flight& flight(uint32_t i) noexcept { return flights_[i]; }
  ExitFinder<D, Tally> finder(uint32_t i) noexcept { return {env_, requests_[i].from, requests_[i].to, tally_}; }

  template <bool First>
  DSW_HOT Entry entry(uint32_t i) noexcept {
    return First ? Entry{} : flight(i).entry;
  }

  /** Copied whole: member by member GCC 12 makes a loop of each. */
  DSW_HOT void begin(uint32_t i) noexcept {
    static constexpr CastResult kFresh{};
    new (results_ + i) CastResult(kFresh);
    results_[i].cell = requests_[i].start;
    if (D == 3 && has_polyhedra_) new (lines_ + i) CastLine(finder(i).line());
  }

  /** Keeps the casts that may leave where they start. */
  DSW_HOT uint32_t begin_all(uint32_t count) noexcept {
    uint32_t kept = 0;
#pragma GCC unroll 1
    for (uint32_t i = 0; i < count; ++i) {
      begin(i);
      active_[kept] = static_cast<uint8_t>(i);
      kept += ends_in(i, requests_[i].start) ? 0 : 1;
    }
    return kept;
  }

  /** Whether a cast is known to end in a cell that it is in: it can't leave a convex one that holds its target. */
  DSW_HOT bool ends_in(uint32_t i, Cell cell) noexcept {
    return static_cast<uint32_t>(cell == requests_[i].end) & static_cast<uint32_t>(map_.convex(cell));
  }

  /** Keeps the casts that may leave their cells. */
  template <bool First>
  DSW_HOT uint32_t look_all(uint32_t count) noexcept {
    uint32_t kept = 0;
    for (uint32_t k = 0; k < count;) {
      const uint32_t end = std::min(k + kAbreast, count);
      if (!look_abreast<First>(k, end)) {
        for (uint32_t j = k; j < end; ++j) look<First>(active_[j]);
      }
      for (; k < end; ++k) {
        const uint32_t i = active_[k];
        active_[kept] = static_cast<uint8_t>(i);
        kept += looks_[i].may_leave() ? 1 : 0;
      }
    }
    return kept;
  }

  template <bool First>
  DSW_HOT void look(uint32_t i) noexcept {
    looks_[i] = finder(i).look(results_[i].cell, entry<First>(i), lines_[i]);
  }

  /** Looks at some casts together, if there are enough and the cells of all are of one form that can be. */
  template <bool First>
  DSW_HOT bool look_abreast(uint32_t first, uint32_t end) noexcept {
#if defined(DSW_ABREAST)
    if (D != 3) return false;
    const uint32_t word = map_.record(results_[active_[first]].cell)[0];
    const Form form = form_of(word);
    const bool flat = form == Form::kSimplex || (word & kConvexBit) != 0;
    if (!pays_abreast(form, flat, end - first)) return false;
    const uint32_t kind = form == Form::kSimplex ? 7u << kFormShift : 7u << kFormShift | kConvexBit;
    Abreast cells;
    uint32_t different = 0;
#pragma GCC unroll 1
    for (uint32_t j = 0; j < kAbreast; ++j) {
      const uint32_t i = active_[first + j < end ? first + j : first];  // lanes without a cast repeat the first
      cells.records[j] = map_.record(results_[i].cell);
      cells.p[j] = requests_[i].from;
      cells.q[j] = requests_[i].to;
      different |= cells.records[j][0] ^ word;
    }
    if ((different & kind) != 0) return false;
    Sides sides;
    if (form == Form::kSimplex) {
      sides.look_at_tetrahedra(env_.points, cells);
      note_sides<First, 4>(first, end, sides);
    } else if (form == Form::kPyramid) {
      sides.look_at_pyramids(env_.points, cells);
      note_sides<First, 5>(first, end, sides);
    } else if (flat) {
      sides.look_at_boxes(env_.points, cells);
      note_sides<First, 6>(first, end, sides);
    } else {
#if defined(DSW_ISA_AVX512)
      look_warped<First>(first, end, cells);
#endif
    }
    return true;
#else
    static_cast<void>(first), static_cast<void>(end);
    return false;
#endif
  }

#if defined(DSW_ABREAST)
  template <bool First, uint32_t Facets>
  DSW_HOT void note_sides(uint32_t first, uint32_t end, const Sides& sides) noexcept {
#pragma GCC unroll 1
    for (uint32_t j = 0; j < end - first; ++j) {
      const uint32_t i = active_[first + j];
      if (__builtin_expect((sides.settled >> j & 1u) == 0, 0)) {
        look<First>(i);
        continue;
      }
      const uint32_t known = entry<First>(i).known_inside(Facets);
      tally_.tests(known == 0 ? Facets : Facets - 1);
      looks_[i] = Look::of_planes(static_cast<uint32_t>(sides.outside[j]) & ~known, Facets);
    }
  }

#endif

#if defined(DSW_ISA_AVX512)
  template <bool First>
  DSW_HOT void look_warped(uint32_t first, uint32_t end, const Abreast& cells) noexcept {
    WarpedBoxExits exits;
    exits.look(env_.points, cells);
#pragma GCC unroll 1
    for (uint32_t j = 0; j < end - first; ++j) {
      const uint32_t i = active_[first + j];
      if (__builtin_expect((exits.sure >> j & 1u) == 0, 0)) {
        look<First>(i);
        continue;
      }
      looks_[i] = Look::of_box({exits.pierced[j], exits.second[j], exits.candidates[j], true}, tally_);
    }
  }
#endif

  DSW_HOT bool leave_first(uint32_t i) noexcept {
    const Exit exit = choose(i, {}, requests_[i].forecast);
    results_[i].first_facet = exit.facet;
    if (exit.facet == kStays) return false;
    new (flights_ + i) Flight{exit, {}, {}, {}, visit_bit(results_[i].cell)};
    aim(i);
    return true;
  }

  /** Whether it does, and where to. */
  DSW_HOT bool leave(uint32_t i) noexcept {
    flight(i).exit = choose(i, flight(i).entry, kNoFacet);
    if (flight(i).exit.facet == kStays) return false;
    aim(i);
    return true;
  }

  DSW_HOT Exit choose(uint32_t i, const Entry& entry, uint32_t forecast) noexcept {
    const Look& look = looks_[i];
    if (look.has_one_exit()) return look.only_exit();
    return finder(i).choose(results_[i].cell, look, lines_[i], entry, forecast);
  }

  /** Asks for what is beyond the exit. */
  DSW_HOT void aim(uint32_t i) noexcept {
    const HalfFacet at = looks_[i].half_facet(map_, results_[i].cell, flight(i).exit.facet);
    const uint32_t link = map_.words[at.word], beyond = link & ~kMarkBit;
    flight(i).at = at;
    flight(i).link = link;
    if (beyond == kNoFacet) return;
    __builtin_prefetch(&map_.words[beyond - beyond % kUnitWords<D>]);
    if (D == 2) __builtin_prefetch(&map_.words[beyond]);  // its record may lie in two lines
    if (looks_[i].kind == LookKind::kLines) prefetch_round(env_, {beyond});
  }

  /** As admits, where points move. */
  __attribute__((noinline)) bool admits_moving(Cell c) noexcept {
    const CheckedCells::Known known = env_.checked.known(map_.index(c));
    if (known != CheckedCells::Known::kNothing) return known == CheckedCells::Known::kValid;
    double apex[D];
    centre(env_, c, apex);
    return find_out_validity(env_, c, apex);
  }

  /** Asks for what is beyond the facets that casts leave through, where points move: nobody may have looked at it. */
  void prefetch_beyond(uint32_t count) noexcept {
    for (uint32_t k = 0; k < count; ++k) {
      const HalfFacet o = {flight(active_[k]).link & ~kMarkBit};
      if (o.valid()) prefetch_moving(env_, map_.cell_of(o));
    }
  }

  /** Whether it may come in there. */
  DSW_HOT bool enter(uint32_t i) noexcept {
    const CastRequest& request = requests_[i];
    Flight& f = flight(i);
    CastResult& result = results_[i];
    const HalfFacet o = {f.link & ~kMarkBit};
    const Cell next = o.valid() ? map_.cell_of(o) : Cell{};
    if (!o.valid() || (!request.through_walls && ((f.link & kMarkBit) != 0 || map_.marked(next))) ||
        __builtin_expect(moving_ && !admits_moving(next), 0)) {
      result.end = CastEnd::kHit;
      result.facet = f.at;
      result.simplex = f.exit.simplex;
      return false;
    }
    if (result.volumes_visited == request.max_volumes) {  // volumes_visited is never 0, so 0 is no limit
      result.end = CastEnd::kWorkLimit;
      result.simplex = f.entry.simplex;
      return false;
    }
    if (request.crossing != nullptr) request.crossing(request.crossing_user, result.cell, f.exit.simplex, next);
    const Cell before = result.cell;
    result.previous = before;
    result.cell = next;
    ++result.volumes_visited;
    if (ends_in(i, next)) return false;
    prefetch_vertices(env_, next);
    if (D == 3 && has_polyhedra_) prefetch_polyhedron(env_, next);
    f.entry = {(f.visited & visit_bit(next)) != 0, before, f.exit.simplex, o};
    f.visited |= visit_bit(next);
    return true;
  }

  const Environment<D>& env_;
  const Map<D>& map_;
  const CastRequest* requests_;
  CastResult* results_;
  Tally tally_;
  const bool has_polyhedra_;
  const bool moving_;  // points do
  union {              // constructs nothing
    Flight flights_[kPacket];
  };
  union {
    CastLine lines_[kPacket];  // where there are polyhedra
  };
  Look looks_[kPacket];
  uint8_t active_[kPacket];
};

template <int D>
void walk_plain(const Environment<D>& env, const CastRequest* requests, uint32_t count, CastResult* results) noexcept {
  Walkers<D, CountNothing>(env, requests, results, {}).run(count);
}
template <int D>
void walk_counted(const Environment<D>& env, const CastRequest* requests, uint32_t count, CastResult* results,
                  CastCounters* counters) noexcept {
  Walkers<D, CountAll>(env, requests, results, {counters}).run(count);
  counters->casts += count;
  for (uint32_t i = 0; i < count; ++i) counters->volumes_visited += results[i].volumes_visited;
}
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
Walk<D> this_walk() noexcept {
  return {walk_plain<D>, walk_counted<D>, contains<D>, sees_all<D>, admits_with_centre<D>};
}
