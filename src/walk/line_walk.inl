// Casts that go through tetrahedra along their lines, cell after cell, some side by side. Of a cell one vertex is read,
// and of its record the link that is passed.

constexpr uint8_t kFacetByVertexBit[9] = {0, 1, 2, 0, 0, 0, 0, 0, 3};

/** The facet of a tetrahedron that has not one of its vertices. */
DSW_HOT uint32_t facet_without(const uint32_t* w, uint32_t vertex) noexcept {
#if DSW_X86_64
  const __m128i all = _mm_and_si128(_mm_loadu_si128(reinterpret_cast<const __m128i*>(w)),
                                    _mm_set1_epi32(static_cast<int>(kVertexMask)));
  const __m128i same = _mm_cmpeq_epi32(all, _mm_set1_epi32(static_cast<int>(vertex)));
  return kFacetByVertexBit[_mm_movemask_ps(_mm_castsi128_ps(same))];
#else
  const uint32_t first = w[0] & kVertexMask, second = w[1] & kVertexMask, third = w[2] & kVertexMask;
  return vertex == first ? 1 : vertex == second ? 2 : vertex == third ? 0 : 3;
#endif
}

/** The numbers of all slots. */
struct Slots {
  uint8_t of[kPacket]{};
  constexpr Slots() {
    for (uint32_t s = 0; s < kPacket; ++s) of[s] = static_cast<uint8_t>(s);
  }
};
constexpr Slots kSlots;

/** In the plane there are no such cells. */
template <int D>
class LineWalk {
 public:
  LineWalk(const Environment<D>&, const CastRequest*, CastResult*) noexcept {}
  bool empty() const noexcept { return true; }
  void add(uint32_t, HalfFacet) noexcept {}
  template <class Tally, class Look, class Pass>
  void go(Tally&, Look, Pass) noexcept {}
};

template <>
class LineWalk<3> {
 public:
  LineWalk(const Environment<3>& env, const CastRequest* requests, CastResult* results) noexcept
      : env_(env), map_(env.map), requests_(requests), results_(results), moving_(env.has_moved()), plain_(!moving_) {}

  bool empty() const noexcept { return count_ + added_ == 0; }

  /** Adds a cast that has come into a tetrahedron through a facet of that. */
  DSW_HOT void add(uint32_t cast, HalfFacet through) noexcept {
    added_casts_[added_] = static_cast<uint8_t>(cast);
    added_through_[added_++] = through.word;
  }

  /** Lets all casts go one cell on. look(cast, facet that it came in through): the filter left its cell open.
   * pass(cast, facet): it leaves through this facet, and may not go on by its line. */
  template <class Tally, class Look, class Pass>
  DSW_NOINLINE void go(Tally& tally, Look look, Pass pass) noexcept {
    if (moving_) {
      for (uint32_t s = 0; s < count_; ++s) prefetch_beyond(env_, HalfFacet{exit(s)});
    }
    ++passes_;
    const uint32_t old = count_;
    start(look);
    if (plain_) {
      step<true>(old, tally, look, pass);
    } else {
      step<false>(old, tally, look, pass);
    }
  }

 private:
  static constexpr uint32_t kInUnit = kUnitWords<3> - 1, kFacets = kUnitWords<3> - 4;
  static constexpr uint32_t kTogether = 8, kGroups = kTogether / kAbreast;     // casts and groups of a turn
  static constexpr uint32_t kRead = 2, kTest = kRead + 1, kLeave = kTest + 1;  // turns after they have entered

  /** The record of the tetrahedron that a cast is in. */
  const uint32_t* record(uint32_t slot) const noexcept { return map_.words.data() + (through_[slot] & ~kInUnit); }
  static uint32_t local(uint32_t facet) noexcept { return local_in_tetrahedron({facet}); }
  /** The facet that a cast leaves through: that which has not the vertex that the last step has replaced. */
  uint32_t exit(uint32_t slot) const noexcept {
    return (through_[slot] & ~kInUnit) + kFacets +
           facet_without(record(slot), sightlines_.gone(slot / kAbreast, slot % kAbreast));
  }

  /** Casts that were added. */
  template <class Look>
  DSW_HOT void start(Look look) noexcept {
    if (added_ == 0) return;
    const uint32_t old = count_;
    for (uint32_t n = 0; n < added_; ++n) {
      const uint32_t cast = added_casts_[n], s = count_++;
      const CastRequest& request = requests_[cast];
      plain_ &= request.crossing == nullptr && request.max_volumes == 0 && !request.end.valid();
      casts_[s] = static_cast<uint8_t>(cast);
      through_[s] = added_through_[n];
      entered_[s] = results_[cast].volumes_visited - passes_;
      links_[s] = kNoFacet;
      aim(s / kAbreast, s % kAbreast, map_.words.data(), env_.points, through_[s]);
    }
    added_ = 0;
    uint8_t missing[kPacket];
    uint32_t missing_count = 0;
    for (uint32_t group = old / kAbreast; group * kAbreast < count_; ++group) {
      const uint32_t first = group * kAbreast, begin = std::max(first, old) - first;
      // Lanes without a cast that starts repeat one that does.
      const auto slot = [&](uint32_t lane) { return std::min(std::max(first + lane, old), count_ - 1); };
      const uint32_t passing = sightlines_.start(
          group, begin, env_.points, [&](uint32_t lane) { return requests_[casts_[slot(lane)]].from; },
          [&](uint32_t lane) { return requests_[casts_[slot(lane)]].to; },
          [&](uint32_t lane, uint32_t corner) {
            const uint32_t s = slot(lane);
            return record(s)[kTetrahedronFacets[local(through_[s])][corner]] & kVertexMask;
          });
      for (uint32_t s = first + begin; s < std::min(first + kAbreast, count_); ++s) {
        missing[missing_count] = static_cast<uint8_t>(s);
        missing_count += passing >> (s - first) & 1u ? 0 : 1;
      }
    }
    while (missing_count-- > 0) give_back(missing[missing_count], look);
  }

  /** Asks for the vertex beyond the facet that a cast has come in through. */
  DSW_HOT void aim(uint32_t group, uint32_t lane, const uint32_t* words, const double* points,
                   uint32_t through) noexcept {
    const uint32_t tip = words[(through & ~kInUnit) + kTetrahedronTips[local(through)]] & kVertexMask;
    const double* const point = points + size_t{tip} * 3;
    prefetch_line(point);
    prefetch_line(point + 2);
    sightlines_.aim(group, lane, tip);
  }

  /** What a pass has found out about the casts of a turn, a bit each. */
  struct Turn {
    uint32_t blocked;  // may not enter
    Sightlines::Steps steps;
  };

  /** Lets casts below slot `old` enter, looks at all cells, and asks for what is beyond the facets that casts leave
   * through. The casts of a turn go through four stages, one turn behind the other, so that the memory and all parts of
   * a processor work at the same time. No cast changes its slot before all are done. */
  template <bool Plain, class Tally, class Look, class Pass>
  DSW_HOT void step(uint32_t old, Tally& tally, Look look, Pass pass) noexcept {
    for (uint32_t s = count_; s % kAbreast != 0; ++s) sightlines_.aim(s / kAbreast, s % kAbreast, 0);
    Turn turns[kPacket / kTogether];
    uint32_t stopped_at[kPacket];  // facets that casts may not pass, by slots
    const uint32_t group_count = (count_ + kAbreast - 1) / kAbreast;
    const uint32_t turn_count = (count_ + kTogether - 1) / kTogether;
    for (uint32_t n = 0; n < turn_count + kLeave; ++n) {
      if (n < turn_count) turns[n].blocked = enter<Plain>(n, old, stopped_at);
      if (n - kRead < turn_count) read(n - kRead, group_count);
      if (n - kTest < turn_count) turns[n - kTest].steps = test(n - kTest, group_count);
      if (n - kLeave < turn_count) leave(n - kLeave);
    }
    uint8_t remaining[kPacket + kAbreast];  // a group writes kAbreast bytes
    uint32_t remaining_count = 0;
    for (uint32_t first = 0; first < count_; first += kTogether) {
      const auto& [blocked, steps] = turns[first / kTogether];
      const uint32_t casts = (1u << (std::min(first + kTogether, count_) - first)) - 1;
      tally.tests(4 * bit_count((steps.leaves | steps.stays) & casts & ~blocked));
      const uint32_t remain = (~steps.leaves | blocked) & casts;
      if (remain == 0) continue;
      DSW_UNROLL(4)
      for (uint32_t lane = 0; lane < kTogether; lane += kAbreast) {
        const uint32_t lanes = remain >> lane & ((1u << kAbreast) - 1);
        LaneBytes(kSlots.of + first + lane).store(remaining + remaining_count, lanes);
        remaining_count += count_lanes(lanes);
      }
    }
    while (remaining_count-- > 0) {  // from the last slot, since the last cast moves to one that becomes free
      const uint32_t slot = remaining[remaining_count], bit = slot % kTogether;
      const auto& [blocked, steps] = turns[slot / kTogether];
      if ((blocked >> bit & 1u) != 0) {
        --entered_[slot];
        pass(take_out(slot), HalfFacet{stopped_at[slot]});
      } else if ((steps.stays >> bit & 1u) != 0) {
        take_out(slot);
      } else {
        give_back(slot, look);
      }
    }
  }

  // The stages are functions of their own: in one loop the compiler would have too few registers for all of them.

  /** The groups of a turn. */
  DSW_NOINLINE void read(uint32_t turn, uint32_t group_count) noexcept {
    const uint32_t begin = turn * kGroups, end = std::min(begin + kGroups, group_count);
    for (uint32_t g = begin; g < end; ++g) sightlines_.read(g, env_.points);
  }
  DSW_NOINLINE Sightlines::Steps test(uint32_t turn, uint32_t group_count) noexcept {
    const uint32_t begin = turn * kGroups, end = std::min(begin + kGroups, group_count);
    Sightlines::Steps all = {0, 0};
    for (uint32_t g = begin; g < end; ++g) {
      const auto [leaves, stays] = sightlines_.step(g);
      all.leaves |= leaves << (g - begin) * kAbreast;
      all.stays |= stays << (g - begin) * kAbreast;
    }
    return all;
  }

  /** Asks for what is beyond the facets that the casts of a turn leave through. What is asked for need not be there. */
  DSW_NOINLINE void leave(uint32_t turn) noexcept {
    const uint32_t* const words = map_.words.data();
    const auto begin = reinterpret_cast<uintptr_t>(words);
    for_each_in(turn, count_, [&](uint32_t s, uint32_t group, uint32_t lane) {
      const uint32_t unit = through_[s] & ~kInUnit;
      const uint32_t link = words[unit + kFacets + facet_without(words + unit, sightlines_.gone(group, lane))];
      links_[s] = link;
      prefetch_line(reinterpret_cast<const void*>(begin + sizeof *words * size_t{link & ~kMarkBit & ~kInUnit}));
    });
  }

  /** Lets the casts of a turn enter, but for those in slots from `old` on. @return those that may not. */
  template <bool Plain>
  DSW_NOINLINE uint32_t enter(uint32_t turn, uint32_t old, uint32_t* stopped_at) noexcept {
    const uint32_t* const words = map_.words.data();
    const double* const points = env_.points;
    uint32_t blocked = 0;
    for_each_in(turn, old, [&](uint32_t s, uint32_t group, uint32_t lane) {
      const uint32_t link = links_[s];
      if (DSW_LIKELY(may_enter<Plain>(s, words, link))) {
        if (!Plain) tell_crossing(s);
        through_[s] = link;
        aim(group, lane, words, points, link);
      } else {
        stopped_at[s] = exit(s);
        blocked |= 1u << s % kTogether;
      }
    });
    return blocked;
  }

  /** Calls visit(slot, group, lane) for the slots of a turn below `end`. */
  template <class Visit>
  static DSW_HOT void for_each_in(uint32_t turn, uint32_t end, Visit visit) noexcept {
    for (uint32_t g = turn * kGroups; g < (turn + 1) * kGroups; ++g) {
      const uint32_t first = g * kAbreast, lanes = std::min(std::max(end, first) - first, kAbreast);
      for (uint32_t lane = 0; lane < lanes; ++lane) visit(first + lane, g, lane);
    }
  }

  template <bool Plain>
  DSW_HOT bool may_enter(uint32_t slot, const uint32_t* words, uint32_t link) const noexcept {
    if (link >= kNoFacet) return false;  // nothing is beyond, or the facet is marked
    const bool is_open = words[link & ~kInUnit] >> kFormShift == static_cast<uint32_t>(Form::kSimplex);  // unmarked
    if (Plain) return is_open;
    const CastRequest& request = requests_[casts_[slot]];
    const Cell next = tetrahedron_of({link});
    return is_open && entered_[slot] + passes_ - 1 != request.max_volumes && next != request.end &&
           (!moving_ || CheckedCells::is_valid(known_moving(env_, next)));
  }

  /** Tells who wants to know that a cast enters. */
  DSW_HOT void tell_crossing(uint32_t slot) const noexcept {
    const CastRequest& request = requests_[casts_[slot]];
    if (request.crossing == nullptr) return;
    const uint32_t at = exit(slot);
    request.crossing(request.crossing_user, tetrahedron_of({at}), local(at), tetrahedron_of({links_[slot]}));
  }

  template <class Look>
  DSW_HOT void give_back(uint32_t slot, Look look) noexcept {
    const HalfFacet through = {through_[slot]};
    look(take_out(slot), through);
  }

  /** Notes where a cast is, and moves the last one to its slot. @return the cast. */
  DSW_NOINLINE uint32_t take_out(uint32_t slot) noexcept {
    const uint32_t cast = casts_[slot], visited = entered_[slot] + passes_;
    CastResult& result = results_[cast];
    if (result.volumes_visited != visited) {
      const HalfFacet from = map_.opposite({through_[slot]});
      result.previous = tetrahedron_of(from);
      result.simplex = local(from.word);
      result.cell = tetrahedron_of({through_[slot]});
      result.volumes_visited = visited;
    }
    const uint32_t last = --count_;
    if (slot == last) return cast;
    casts_[slot] = casts_[last];
    for (uint32_t* const row : {through_, links_, entered_}) row[slot] = row[last];
    sightlines_.move(last, slot);
    return cast;
  }

  const Environment<3>& env_;
  const Map<3>& map_;
  const CastRequest* requests_;
  CastResult* results_;
  const bool moving_;  // points have
  bool plain_;         // no cast has a limit, an end or a callback, and no points move
  uint32_t count_ = 0, added_ = 0;
  uint32_t passes_ = 0;  // in each a cast enters one cell, or is taken out
  uint8_t added_casts_[kPacket];
  uint32_t added_through_[kPacket];
  uint8_t casts_[kPacket];
  uint32_t through_[kPacket];  // the facets that they came in through, seen from the cells they are in
  uint32_t links_[kPacket];    // what the map says is beyond those that they leave through
  uint32_t entered_[kPacket];  // cells visited, less the passes
  Sightlines sightlines_;
};
