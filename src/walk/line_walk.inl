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
    if (plain_) {
      enter_all<true>(pass);
    } else {
      if (moving_) {
        for (uint32_t s = 0; s < count_; ++s) prefetch_beyond(env_, HalfFacet{at_[s]});
      }
      enter_all<false>(pass);
    }
    start(look);
    step(tally, look);
  }

 private:
  static constexpr uint32_t kInUnit = kUnitWords<3> - 1;

  /** The record of the tetrahedron that a cast is in. */
  const uint32_t* record(uint32_t slot) const noexcept { return map_.words.data() + (through_[slot] & ~kInUnit); }
  static uint32_t local(uint32_t facet) noexcept { return local_in_tetrahedron({facet}); }

  /** Casts that were added. */
  template <class Look>
  DSW_HOT void start(Look look) noexcept {
    const uint32_t old = count_;
    for (uint32_t n = 0; n < added_; ++n) {
      const uint32_t cast = added_casts_[n], s = count_++;
      const CastRequest& request = requests_[cast];
      plain_ &= request.crossing == nullptr && request.max_volumes == 0 && !request.end.valid();
      casts_[s] = static_cast<uint8_t>(cast);
      through_[s] = added_through_[n];
      visited_[s] = results_[cast].volumes_visited;
      at_[s] = links_[s] = kNoFacet;
      aim(s);
    }
    added_ = 0;
    // Lanes without a cast repeat the last one: no slot is read that has not been written.
    uint8_t missing[kPacket];
    uint32_t missing_count = 0;
    const uint32_t whole = (count_ + kAbreast - 1) / kAbreast * kAbreast;  // `step` reads whole groups
    const uint32_t end = written_ < whole ? whole : count_;
    for (uint32_t first = old; first < end; first += kAbreast) {
      written_ = std::max(written_, first + kAbreast);
      const auto slot = [&](uint32_t lane) { return std::min(first + lane, count_ - 1); };
      const uint32_t passing = sightlines_.start(
          first, env_.points, [&](uint32_t lane) { return requests_[casts_[slot(lane)]].from; },
          [&](uint32_t lane) { return requests_[casts_[slot(lane)]].to; },
          [&](uint32_t lane, uint32_t corner) {
            const uint32_t s = slot(lane);
            return record(s)[kTetrahedronFacets[local(through_[s])][corner]] & kVertexMask;
          });
      for (uint32_t s = first; s < std::min(first + kAbreast, count_); ++s) {
        missing[missing_count] = static_cast<uint8_t>(s);
        missing_count += passing >> (s - first) & 1u ? 0 : 1;
      }
    }
    while (missing_count-- > 0) give_back(missing[missing_count], look);
  }

  /** Asks for the vertex beyond the facet that a cast has come in through. */
  DSW_HOT void aim(uint32_t slot) noexcept {
    const uint32_t tip = record(slot)[kTetrahedronTips[local(through_[slot])]] & kVertexMask;
    prefetch_point(env_, tip);
    sightlines_.aim(slot, tip);
  }

  /** Looks at all cells, and asks for what is beyond the facets that casts leave through. All groups are read, then all
   * are tested, then all casts leave. No cast changes its slot in between. */
  template <class Tally, class Look>
  DSW_HOT void step(Tally& tally, Look look) noexcept {
    for (uint32_t s = count_; s % kAbreast != 0; ++s) sightlines_.aim(s, 0);
    Sightlines::Steps steps[kPacket / kAbreast];
    for (uint32_t first = 0; first < count_; first += kAbreast) sightlines_.read(first, env_.points);
    for (uint32_t first = 0; first < count_; first += kAbreast) steps[first / kAbreast] = sightlines_.step(first);
    for (uint32_t s = 0; s < count_; ++s) leave(s);
    uint8_t remaining[kPacket], decided[kPacket];
    uint32_t remaining_count = 0;
    for (uint32_t first = 0; first < count_; first += kAbreast) {
      const auto [leaves, stays] = steps[first / kAbreast];
      const uint32_t lanes = (1u << (std::min(first + kAbreast, count_) - first)) - 1;
      tally.tests(4 * bit_count((leaves | stays) & lanes));
      for (uint32_t rest = ~leaves & lanes; rest != 0; rest &= rest - 1) {
        const uint32_t lane = lowest_bit(rest);
        remaining[remaining_count] = static_cast<uint8_t>(first + lane);
        decided[remaining_count++] = stays >> lane & 1u;
      }
    }
    while (remaining_count-- > 0) {  // from the last slot, since the last cast moves to one that becomes free
      if (decided[remaining_count] != 0) {
        take_out(remaining[remaining_count]);
      } else {
        give_back(remaining[remaining_count], look);
      }
    }
  }

  /** Through the facet that has not the vertex that the last step has replaced. */
  DSW_HOT void leave(uint32_t slot) noexcept {
    const uint32_t at =
        (through_[slot] & ~kInUnit) + (kUnitWords<3> - 4) + facet_without(record(slot), sightlines_.gone(slot));
    const uint32_t link = map_.words[at], beyond = link & ~kMarkBit;
    at_[slot] = at;
    links_[slot] = link;
    prefetch_line(&map_.words[(beyond == kNoFacet ? at : beyond) & ~kInUnit]);
  }

  template <bool Plain, class Pass>
  DSW_HOT void enter_all(Pass pass) noexcept {
    for (uint32_t s = 0; s < count_;) {
      if (DSW_LIKELY(may_enter<Plain>(s))) {
        enter<Plain>(s++);
      } else {
        const HalfFacet at = {at_[s]};
        pass(take_out(s), at);
      }
    }
  }

  template <bool Plain>
  DSW_HOT bool may_enter(uint32_t slot) const noexcept {
    const uint32_t link = links_[slot];
    if (link >= kNoFacet) return false;  // nothing is beyond, or the facet is marked
    const bool is_open =
        map_.words[link & ~kInUnit] >> kFormShift == static_cast<uint32_t>(Form::kSimplex);  // unmarked
    if (Plain) return is_open;
    const CastRequest& request = requests_[casts_[slot]];
    const Cell next = tetrahedron_of({link});
    return is_open && visited_[slot] != request.max_volumes && next != request.end &&
           (!moving_ || CheckedCells::is_valid(known_moving(env_, next)));
  }

  template <bool Plain>
  DSW_HOT void enter(uint32_t slot) noexcept {
    const CastRequest& request = requests_[casts_[slot]];
    if (!Plain && request.crossing != nullptr) {
      request.crossing(request.crossing_user, tetrahedron_of({at_[slot]}), local(at_[slot]),
                       tetrahedron_of({links_[slot]}));
    }
    through_[slot] = links_[slot];
    ++visited_[slot];
    aim(slot);
  }

  template <class Look>
  DSW_HOT void give_back(uint32_t slot, Look look) noexcept {
    const HalfFacet through = {through_[slot]};
    look(take_out(slot), through);
  }

  /** Notes where a cast is, and moves the last one to its slot. @return the cast. */
  DSW_NOINLINE uint32_t take_out(uint32_t slot) noexcept {
    const uint32_t cast = casts_[slot];
    CastResult& result = results_[cast];
    if (result.volumes_visited != visited_[slot]) {
      const HalfFacet from = map_.opposite({through_[slot]});
      result.previous = tetrahedron_of(from);
      result.simplex = local(from.word);
      result.cell = tetrahedron_of({through_[slot]});
      result.volumes_visited = visited_[slot];
    }
    const uint32_t last = --count_;
    if (slot == last) return cast;
    casts_[slot] = casts_[last];
    for (uint32_t* const row : {through_, at_, links_, visited_}) row[slot] = row[last];
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
  uint32_t written_ = 0;  // slots below it have been written
  uint8_t added_casts_[kPacket];
  uint32_t added_through_[kPacket];
  uint8_t casts_[kPacket];
  uint32_t through_[kPacket];  // the facets that they came in through, seen from the cells they are in
  uint32_t at_[kPacket];       // those that they leave through
  uint32_t links_[kPacket];    // what the map says is beyond
  uint32_t visited_[kPacket];  // cells
  Sightlines sightlines_;
};
