#include "response/short_edges.h"

#include <algorithm>

namespace dsw {

template <int D>
void ShortEdges<D>::start(bool looks) {
  looks_ = looks;
  has_others_ = false;
  const Array<VertexWay>& ways = course_.motion.ways;
  words_.resize(ways.size());
  for (size_t v = 0; v < ways.size(); ++v) {
    const Cell from = ways[v].from;
    const bool stays = from == ways[v].arrival && from.valid(), convex = stays && env_.map.convex(from);
    const typename Course<D>::Vertex& turn = course_.vertices[v];
    words_[v] = (convex ? from.unit << kBits | kStays : 0) | (turn.rank != kNone ? kMoves : 0) |
                (turn.doubtful ? 0 : kSure) | (turn.inwards ? kInwards : 0);
    has_others_ |= stays != convex;
  }
  if (!looks) return;
  looked_.assign(ways.size(), kNone);
  told_.resize(ways.size());
}

template <int D>
typename ShortEdges<D>::Seen ShortEdges<D>::find(const uint32_t* edges, uint32_t count) {
  Seen seen;
  const uint32_t pairs = gather(edges, count, seen);
  if (!looks_ || pairs == 0) return seen;
  ask(pairs);
  for (uint32_t i = 0; i < pairs; ++i) {
    const Pair& pair = pairs_[i];
    const uint32_t number = told_of_pairs_[i] ^ kAsked;
    const uint32_t told = number < kMostPairs ? answers_[number] : told_of_pairs_[i];
    uint32_t turns = told == course_.motion.ways[pair.vertex].arrival.unit ? pair.turns : 0u;
    if ((told ^ kSeveral) < kSeveral) {
      for (const uint32_t turn : {kFirst, kSecond}) {
        if ((pair.turns & turn) != 0 && leads(pair, told ^ kSeveral, edges, turn)) turns |= turn;
      }
    }
    seen.first |= uint64_t{turns & kFirst} << pair.place;
    seen.second |= uint64_t{turns >> 1} << pair.place;
  }
  return seen;
}

/** Sees the edges that stay in one cell, and gathers what has to be asked of the others. Returns how many pairs there are. */
template <int D>
uint32_t ShortEdges<D>::gather(const uint32_t* edges, uint32_t count, Seen& seen) {
  const BodyEdge* const of = course_.motion.body->edges.data();
  const typename Course<D>::Vertex* const vertices = course_.vertices.data();
  const VertexWay* const ways = course_.motion.ways.data();
  const uint32_t* const words = words_.data();
  uint32_t pairs = 0, others = 0;
  uint8_t moving[kMost];  // ends that change their cells
  uint64_t inside = 0, sure = 0;
  uint32_t stopped = 0;
  for (uint32_t i = 0; i < count; ++i) {
    const uint32_t(&ends)[2] = of[edges[i]].ends;
    const typename Course<D>::Vertex &a = vertices[ends[0]], &b = vertices[ends[1]];
    const uint32_t k = b.rank < a.rank ? 1 : 0;
    const uint32_t v = ends[k], word = words[ends[1 - k]], home = word >> kBits, arrival = ways[v].arrival.unit;
    const uint32_t same = home == arrival ? 1 : 0, known = word / kStays & 1, arrives = arrival != kNone ? 1 : 0;
    inside |= uint64_t{same & known} << i;
    pairs_[pairs] = {v, home, static_cast<uint8_t>(i), kFirst | kSecond};
    pairs += (same ^ 1) & known & arrives;
    moving[others] = static_cast<uint8_t>(i);
    others += (known ^ 1) & arrives;
    stopped |= arrives ^ 1;
    const uint32_t doubt = uint32_t{a.doubtful} | uint32_t{b.doubtful};
    sure |= uint64_t{(doubt ^ 1) & (std::max(a.rank, b.rank) != kNone ? 1u : 0u)} << i;
  }
  seen = {inside, inside, sure, stopped != 0};
  for (uint32_t i = 0; i < others; ++i) add_turns(edges, moving[i], pairs, seen);
  return pairs;
}

/** An edge whose second end does not stay in a convex cell is asked about at each turn. */
template <int D>
void ShortEdges<D>::add_turns(const uint32_t* edges, uint32_t place, uint32_t& pairs, Seen& seen) {
  const uint32_t(&ends)[2] = course_.motion.body->edges[edges[place]].ends;
  const uint32_t k = course_.vertices[ends[1]].rank < course_.vertices[ends[0]].rank ? 1 : 0;
  const uint32_t v = ends[k];
  const VertexWay& way = course_.motion.ways[ends[1 - k]];
  const Cell target = course_.motion.ways[v].arrival;
  const auto add = [&](Cell cell, uint32_t turn, uint64_t& of_turn) {
    if (!cell.valid() || !env_.map.convex(cell)) return;
    if (cell == target) {
      of_turn |= uint64_t{1} << place;
    } else {
      pairs_[pairs++] = {v, cell.unit, static_cast<uint8_t>(place), static_cast<uint8_t>(turn)};
    }
  };
  add(way.from, kFirst, seen.first);
  add(way.arrival, kSecond, seen.second);
}

/** Looks at the cells that were not looked at for the same vertex before. */
template <int D>
void ShortEdges<D>::ask(uint32_t pairs) {
  uint32_t asked = 0;
  for (uint32_t i = 0; i < pairs; ++i) {
    const auto [v, cell, place, turns] = pairs_[i];
    if (looked_[v] != cell) {
      looked_[v] = cell;
      told_[v] = kAsked | asked;
      questions_[asked++] = {v, {cell}};
    }
    told_of_pairs_[i] = told_[v];
  }
  answer(asked);
  for (uint32_t i = 0; i < asked; ++i) {
    uint32_t& told = told_[questions_[i].vertex];
    if (told == (kAsked | i)) told = answers_[i];
  }
}

/** Answers the questions: goes from cell to cell while one facet alone has the target outside. */
template <int D>
void ShortEdges<D>::answer(uint32_t count) {
  uint8_t open[kMostPairs], facets[kMostPairs];
  Cell cells[kMostPairs];
  const double* points[kMostPairs];
  for (uint32_t i = 0; i < count; ++i) {
    open[i] = static_cast<uint8_t>(i);
    cells[i] = questions_[i].cell;
    points[i] = course_.place(questions_[i].vertex, kNone);
  }
  for (uint32_t depth = 0; depth < kMostLooks && count != 0; ++depth) {
    find_outside(env_, cells, points, count, facets);
    uint32_t kept = 0;
    for (uint32_t i = 0; i < count; ++i) {
      const uint32_t question = open[i], outside = facets[i], rest = outside & (outside - 1);
      uint32_t& told = answers_[question];
      told = depth == 0 && rest != 0 && (rest & (rest - 1)) == 0 ? kSeveral | outside : kNone;
      if (outside == 0 || rest != 0) continue;
      const Cell next = open_neighbour(env_, cells[i], lowest_bit(outside));
      if (next == course_.motion.ways[questions_[question].vertex].arrival) told = next.unit;
      if (told != kNone || !next.valid()) continue;
      open[kept] = static_cast<uint8_t>(question);
      cells[kept] = next;
      points[kept++] = points[i];
    }
    count = kept;
  }
}

/** Whether an edge passes from the cell of its second end, at a turn, straight into that of the target of the first one. */
template <int D>
bool ShortEdges<D>::leads(const Pair& pair, uint32_t facets, const uint32_t* edges, uint32_t turn) const {
  const uint32_t w = course_.motion.body->edges[edges[pair.place]].other(pair.vertex);
  const double* const from = turn == kFirst ? course_.motion.body->position(w) : course_.place(w, kNone);
  return leads_into(env_, {pair.cell}, facets, from, course_.place(pair.vertex, kNone),
                    course_.motion.ways[pair.vertex].arrival);
}

template class ShortEdges<2>;
template class ShortEdges<3>;

}  // namespace dsw
