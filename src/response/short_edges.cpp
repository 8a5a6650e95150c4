#include "response/short_edges.h"

#include <algorithm>

#include "base/processor.h"

namespace dsw {

namespace {

template <int D>
uint32_t write_words(const Map<D>& map, const VertexWay* ways, const typename Course<D>::Vertex* turns, uint32_t count,
                     uint32_t* words, uint32_t* now, uint32_t* in_doubt, bool* has_others) {
  uint32_t others = 0, doubts = 0;
  for (uint32_t v = 0; v < count; ++v) {
    const Cell from = ways[v].from;
    const bool stays = from == ways[v].arrival && from.valid(), convex = stays && map.convex(from);
    words[v] = now[v] = (convex ? from.unit << TurnWord::kBits | TurnWord::kStays : 0) |
                        (turns[v].rank != kNone ? TurnWord::kMoves : 0) | (turns[v].doubtful ? 0 : TurnWord::kSure) |
                        (turns[v].inwards ? TurnWord::kInwards : 0);
    others |= stays != convex ? 1u : 0u;
    in_doubt[doubts] = v;
    doubts += turns[v].doubtful ? 1 : 0;
  }
  *has_others = others != 0;
  return doubts;
}

}  // namespace

uint32_t write_turn_words(const Map<3>& map, const VertexWay* ways, const Course<3>::Vertex* turns, uint32_t count,
                          uint32_t* words, uint32_t* now, uint32_t* in_doubt, bool* has_others) {
  return write_words<3>(map, ways, turns, count, words, now, in_doubt, has_others);
}

const WriteTurnWords kWriteTurnWords = DSW_WITH_AVX2(write_turn_words);

template <int D>
void ShortEdges<D>::start(bool looks) {
  const auto count = static_cast<uint32_t>(course_.motion.ways.size());
  looks = D == 3 && looks;
  words_.resize(count);
  now_.resize(looks ? count : 0);
  in_doubt_.resize(count);
  const auto write = [] {
    if constexpr (D == 3) {
      return kWriteTurnWords;
    } else {
      return write_words<2>;
    }
  }();
  const VertexWay* const ways = course_.motion.ways.data();
  const uint32_t doubts = write(env_.map, ways, course_.vertices.data(), count, words_.data(),
                                looks ? now_.data() : words_.data(), in_doubt_.data(), &has_others_);
  if (!looks) return;
  for (uint32_t i = 0; i < doubts; ++i) {
    if (!ways[in_doubt_[i]].arrival.valid()) doubt_neighbours(in_doubt_[i]);
  }
  asked_.assign(count, LastAsked{});
  answers_.clear();
  pair_count_ = question_count_ = answered_ = 0;  // a move that ran out of memory leaves some
}

/** Notes that neighbours which have their turns after a vertex that does not arrive will be in doubt. */
template <int D>
void ShortEdges<D>::doubt_neighbours(uint32_t v) {
  for_each_edge(*course_.motion.body, v, [&](uint32_t e) {
    const uint32_t w = course_.motion.body->edges[e].other(v);
    if (course_.vertices[w].rank > course_.vertices[v].rank) now_[w] &= ~TurnWord::kSure;
    return true;
  });
}

template <int D>
typename ShortEdges<D>::Seen ShortEdges<D>::find(const uint32_t* edges, uint32_t count) {
  Seen seen;
  gather(edges, count, seen);
  tell(edges, seen);
  return seen;
}

template <int D>
uint64_t ShortEdges<D>::find_arrivals(const uint32_t* edges, uint32_t count) {
  Seen seen;
  gather_arrivals(edges, count, seen);
  tell(edges, seen);
  return seen.second;
}

/** Answers what is asked of edges, and tells which of them are seen to be free. */
template <int D>
void ShortEdges<D>::tell(const uint32_t* edges, Seen& seen) {
  if (question_count_ != 0) answer();
  uint64_t first = seen.first, second = seen.second;
  const auto note = [&](uint32_t turns, uint32_t place) {
    first |= uint64_t{turns & kFirst} << place;
    second |= uint64_t{turns >> 1} << place;
  };
  uint16_t places[kMostPairs];
  uint32_t open = 0;
  for (uint32_t i = 0, count = pair_count_; i < count; ++i) {
    const Pair& pair = pairs_[i];
    const Answer& told = answers_[pair.question];
    note(told.facets / Answer::kReached * pair.turns, pair.place);
    if (D == 2 || told.facets - 1 >= Answer::kReached - 1) continue;
    ways_[open] = ways_of(pair, told, course_.motion.body->edges[edges[pair.place]]);
    places[open++] = pair.place;
  }
  pair_count_ = 0;
  if constexpr (D == 3) follow_ways(env_, ways_, open);
  for (uint32_t i = 0; i < open; ++i) note(ways_[i].leads, places[i]);
  seen.first = first;
  seen.second = second;
}

/** Sees the edges that stay in one cell, and gathers what has to be asked of the others. */
template <int D>
void ShortEdges<D>::gather(const uint32_t* edges, uint32_t count, Seen& seen) {
  const BodyEdge* const of = course_.motion.body->edges.data();
  const uint32_t* const words = now_.data();
  const bool in_a_row = count != 0 && edges[count - 1] - edges[0] == count - 1;
  const EdgeBits bits = kReadTurnWords(in_a_row ? of + edges[0] : of, in_a_row ? nullptr : edges, count, false, words);
  for (uint64_t rest = bits.stay & ~bits.shared; rest != 0; rest &= rest - 1) {
    const uint32_t i = lowest_bit(rest);
    const Ends ends = ends_of(of[edges[i]]);
    add(ends.first, words[ends.second] >> TurnWord::kBits, i, kFirst | kSecond);
  }
  seen = {bits.shared, bits.shared, bits.used & ~bits.odd, bits.either};
  for (uint64_t rest = bits.used & ~bits.stay; rest != 0; rest &= rest - 1) add_turns(edges, lowest_bit(rest), seen);
}

/** Sees the edges that arrive in one cell, and gathers what has to be asked of the others. */
template <int D>
void ShortEdges<D>::gather_arrivals(const uint32_t* edges, uint32_t count, Seen& seen) {
  const VertexWay* const ways = course_.motion.ways.data();
  for (uint32_t i = 0; i < count; ++i) {
    const Ends ends = ends_of(course_.motion.body->edges[edges[i]]);
    const Cell cell = ways[ends.second].arrival;
    DSW_ASSERT(cell.valid());
    if (!env_.map.convex(cell)) continue;
    if (cell == ways[ends.first].arrival) {
      seen.second |= uint64_t{1} << i;
    } else {
      add(ends.first, cell.unit, i, kSecond);
    }
  }
}

/** Gathers what is asked at each turn of an edge whose ends do not both stay in a convex cell. */
template <int D>
void ShortEdges<D>::add_turns(const uint32_t* edges, uint32_t place, Seen& seen) {
  const Ends ends = ends_of(course_.motion.body->edges[edges[place]]);
  const uint32_t v = ends.first;
  const VertexWay& way = course_.motion.ways[ends.second];
  const Cell target = course_.motion.ways[v].arrival;
  if (!target.valid()) return;
  const auto add_turn = [&](Cell cell, uint32_t turns, uint64_t& of_turn) {
    if (!cell.valid() || !env_.map.convex(cell)) return;
    if (cell == target) {
      of_turn |= uint64_t{1} << place;
      if (turns == (kFirst | kSecond)) seen.second |= uint64_t{1} << place;
    } else {
      add(v, cell.unit, place, turns);
    }
  };
  if (way.from == way.arrival) {
    add_turn(way.from, kFirst | kSecond, seen.first);
  } else {
    add_turn(way.from, kFirst, seen.first);
    add_turn(way.arrival, kSecond, seen.second);
  }
}

/** Adds an edge whose end v goes first. Where v does not move, its target is not read, and what is found is not used. The
 * edge's question is new if the cell is not one of the last two that were asked about for v. */
template <int D>
DSW_HOT void ShortEdges<D>::add(uint32_t v, uint32_t cell, uint32_t place, uint32_t turns) {
  Asked(&asked)[2] = asked_[v].of;
  if (asked[0].cell != cell) {
    std::swap(asked[0], asked[1]);
    if (asked[0].cell != cell) {
      const uint32_t i = question_count_++;
      asked[0] = {cell, answered_ + i};
      cells_[i] = {cell};
      arrivals_[i] = course_.motion.ways[v].arrival;
      points_[i] = course_.place(v, kNone);
    }
  }
  pairs_[pair_count_++] = {asked[0].question, static_cast<uint16_t>(place), static_cast<uint16_t>(turns)};
}

/** Answers all questions: goes from cell to cell while one facet alone has the target outside. */
template <int D>
void ShortEdges<D>::answer() {
  uint32_t count = question_count_;
  question_count_ = 0;
  answers_.resize(answered_ + count);
  Answer* const answers = answers_.data() + answered_;
  answered_ += count;
  uint8_t open[kMostPairs], facets[kMostPairs];
  for (uint32_t depth = 0; depth < kMostLooks && count != 0; ++depth) {
    find_outside(env_, cells_, points_, count, facets);
    uint32_t kept = 0;
    for (uint32_t i = 0; i < count; ++i) {
      const uint32_t question = depth == 0 ? i : open[i], outside = facets[i], rest = outside & (outside - 1);
      if (rest != 0) {
        if ((rest & (rest - 1)) == 0) answers[question] = {outside, cells_[i]};
        continue;
      }
      if (outside == 0) continue;
      const Cell next = open_neighbour(env_, cells_[i], lowest_bit(outside));
      if (next == arrivals_[i]) {
        answers[question].facets = Answer::kReached;
      } else if (next.valid()) {
        open[kept] = static_cast<uint8_t>(question);
        cells_[kept] = next;
        arrivals_[kept] = arrivals_[i];
        points_[kept++] = points_[i];
      }
    }
    count = kept;
  }
}

/** Gives the ways of an edge from the places of its second end to the target of its first one, from a cell that they come into. */
template <int D>
TwoWays ShortEdges<D>::ways_of(const Pair& pair, const Answer& at, const BodyEdge& edge) const {
  const auto [v, w] = ends_of(edge);
  const MovingBody<D>& motion = course_.motion;
  return {{motion.body->position(w), course_.place(w, kNone)},
          course_.place(v, kNone),
          at.cell,
          motion.ways[v].arrival,
          at.facets,
          pair.turns,
          0};
}

template class ShortEdges<2>;
template class ShortEdges<3>;

}  // namespace dsw
