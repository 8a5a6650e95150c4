// Casts that go through tetrahedra along their lines, cell after cell, some side by side. Of a cell one vertex is read,
// and of its record the link that is passed.

constexpr uint32_t kLineFrom = 3;  // the cell from which on a cast follows its line

constexpr uint8_t kFacetByVertexBit[9] = {0, 1, 2, 0, 0, 0, 0, 0, 3};

/** The facet of a tetrahedron that has not one of its vertices. */
DSW_HOT uint32_t facet_without(const uint32_t* w, uint32_t vertex) noexcept {
#if defined(__x86_64__)
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
  void add_if(bool, uint32_t, HalfFacet) noexcept {}
  template <class Tally, class Look, class Pass>
  void run(Tally&, Look, Pass) noexcept {}
};

template <>
class LineWalk<3> {
 public:
  LineWalk(const Environment<3>& env, const CastRequest* requests, CastResult* results) noexcept
      : env_(env), map_(env.map), requests_(requests), results_(results) {}

  bool empty() const noexcept { return count_ == 0; }

  /** Adds a cast that has come into a tetrahedron through a facet of that, without a branch. */
  DSW_HOT void add_if(bool adds, uint32_t cast, HalfFacet through) noexcept {
    casts_[count_] = static_cast<uint8_t>(cast);
    through_[count_] = through.word;
    count_ += adds ? 1 : 0;
  }

  /** Until each of them has reached its target or goes on otherwise: look(cast, facet that it came in through) if the
   * filter left its cell open, pass(cast, facet that it leaves through) if what is beyond is anything but a tetrahedron
   * that it may go on in. */
  template <class Tally, class Look, class Pass>
  __attribute__((noinline)) void run(Tally& tally, Look look, Pass pass) noexcept {
    const bool moving = env_.checked.active();
    start(look);
    while (count_ != 0) {
      step();
      leave(tally, look);
      if (moving) {
        for (uint32_t s = 0; s < count_; ++s) prefetch_beyond(env_, HalfFacet{at_[s]});
      }
      enter(moving, pass);
    }
  }

 private:
  static constexpr uint32_t kFirstLink = kUnitWords<3> - 4;
  static constexpr uint32_t kInUnit = kUnitWords<3> - 1;

  /** Of the tetrahedron that a cast is in. */
  const uint32_t* record(uint32_t slot) const noexcept { return map_.words.data() + (through_[slot] & ~kInUnit); }
  static uint32_t local(uint32_t facet) noexcept { return (facet & kInUnit) - kFirstLink; }

  /** Lanes without a cast repeat the last. */
  template <class Value>
  DSW_HOT void fill_lanes(Value (&of)[kPacket]) noexcept {
    for (uint32_t s = count_; s % kAbreast != 0; ++s) of[s] = of[count_ - 1];
  }

  template <class Look>
  DSW_HOT void start(Look look) noexcept {
    uint32_t passing[kPacket / kAbreast];
    for (uint32_t s = 0; s < count_; ++s) visited_[s] = results_[casts_[s]].volumes_visited;
    fill_lanes(casts_);
    fill_lanes(through_);
    for (uint32_t first = 0; first < count_; first += kAbreast) {
      passing[first / kAbreast] = sightlines_.start(
          first, env_.points, [&](uint32_t lane) { return requests_[casts_[first + lane]].from; },
          [&](uint32_t lane) { return requests_[casts_[first + lane]].to; },
          [&](uint32_t lane, uint32_t corner) {
            const uint32_t s = first + lane;
            return record(s)[kTetrahedronFacets[local(through_[s])][corner]] & kVertexMask;
          });
    }
    for (uint32_t s = count_; s-- > 0;) {
      aim(s);
      if ((passing[s / kAbreast] >> s % kAbreast & 1u) == 0) give_back(s, look);
    }
  }

  /** Asks for the vertex beyond the facet that a cast has come in through. */
  DSW_HOT void aim(uint32_t slot) noexcept {
    tips_[slot] = record(slot)[kTetrahedronTips[local(through_[slot])]] & kVertexMask;
    __builtin_prefetch(env_.point(tips_[slot]));
  }

  DSW_HOT void step() noexcept {
    fill_lanes(tips_);
    for (uint32_t first = 0; first < count_; first += kAbreast) {
      sightlines_.step(first, [&](uint32_t lane) { return env_.point(tips_[first + lane]); });
    }
  }

  template <class Tally, class Look>
  DSW_HOT void leave(Tally& tally, Look look) noexcept {
    for (uint32_t s = 0; s < count_;) {
      const uint32_t seen = sightlines_.seen(s);
      if (__builtin_expect((seen & Sightlines::kLeaves) == 0, 0)) {
        if ((seen & Sightlines::kStays) == 0) {
          give_back(s, look);
        } else {
          tally.tests(4);
          take_out(s);
        }
        continue;
      }
      tally.tests(4);
      const uint32_t gone = sightlines_.exchange(s, seen / Sightlines::kCorner, tips_[s]);
      at_[s] = (through_[s] & ~kInUnit) + kFirstLink + facet_without(record(s), gone);
      links_[s] = map_.words[at_[s]];
      __builtin_prefetch(map_.words.data() + (links_[s] & ~(kMarkBit | kInUnit)));
      ++s;
    }
  }

  template <class Pass>
  DSW_HOT void enter(bool moving, Pass pass) noexcept {
    for (uint32_t s = 0; s < count_;) {
      if (__builtin_expect(!may_enter(s, moving), 0)) {
        const HalfFacet at = {at_[s]};
        pass(take_out(s), at);
        continue;
      }
      const CastRequest& request = requests_[casts_[s]];
      if (request.crossing != nullptr) {
        request.crossing(request.crossing_user, tetrahedron_of({at_[s]}), local(at_[s]), tetrahedron_of({links_[s]}));
      }
      through_[s] = links_[s];
      ++visited_[s];
      aim(s++);
    }
  }

  DSW_HOT bool may_enter(uint32_t slot, bool moving) const noexcept {
    const CastRequest& request = requests_[casts_[slot]];
    const uint32_t link = links_[slot];
    if (link >= kNoFacet) return false;  // nothing beyond, or marked
    const uint32_t word = map_.words[link & ~kInUnit];
    const Cell next = tetrahedron_of({link});
    return word >> kFormShift == static_cast<uint32_t>(Form::kSimplex) &&  // and not marked
           visited_[slot] != request.max_volumes && next != request.end && !(moving && !admits_moving(env_, next));
  }

  template <class Look>
  DSW_HOT void give_back(uint32_t slot, Look look) noexcept {
    const HalfFacet through = {through_[slot]};
    look(take_out(slot), through);
  }

  /** Notes where a cast is, and moves the last one to its slot. @return the cast. */
  __attribute__((noinline)) uint32_t take_out(uint32_t slot) noexcept {
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
    casts_[slot] = casts_[last];
    for (auto* const row : {through_, at_, links_, tips_, visited_}) row[slot] = row[last];
    sightlines_.move(last, slot);
    return cast;
  }

  const Environment<3>& env_;
  const Map<3>& map_;
  const CastRequest* requests_;
  CastResult* results_;
  uint32_t count_ = 0;
  uint8_t casts_[kPacket];
  uint32_t through_[kPacket];  // the facets that they came in through, seen from the cells they are in
  uint32_t at_[kPacket];       // those that they leave through
  uint32_t links_[kPacket];    // what the map says is beyond
  uint32_t tips_[kPacket];     // the vertices that the facets `through_` have not
  uint32_t visited_[kPacket];  // cells
  Sightlines sightlines_;
};
