#include "environment/facet_matcher.h"

#include <atomic>
#include <optional>
#include <type_traits>
#include <utility>

#include "base/dimensions.h"

namespace dsw {
namespace {

/** What tells a facet from the others with the same lowest vertex: its two neighbours round the loop, and of a quad the
 * vertex across. Loops of five and more are compared in full. */
struct Loop {
  uint32_t lowest, after, before;  // in the plane the two ends, and kEnd in place of the end that comes first
  uint32_t across;                 // kEnd of a triangle; of five and more their number before kEnd, which no vertex is
};

constexpr uint32_t kEnd = 0xffffffffu;
constexpr uint32_t kLong = kEnd - 0xffffu;  // across of loops of five and more is above

/** How one loop follows another one with the same vertices. */
enum class Direction { kNone, kOpposite, kSame };

/** The vertices of a cell; of a large one they are looked up each time. */
template <int D>
class CellVertices {
 public:
  void read(const Map<D>& map, Cell c, const Shape& shape) {
    map_ = &map;
    cell_ = c;
    is_kept_ = shape.vertex_count() <= kMost;
    if (!is_kept_) return;
    uint32_t* out = kept_;
    map.for_each_vertex(c, [&out](uint32_t v) { *out++ = v; });
  }
  uint32_t operator[](uint32_t local) const { return is_kept_ ? kept_[local] : map_->vertex(cell_, local); }

 private:
  static constexpr uint32_t kMost = 64;
  const Map<D>* map_ = nullptr;
  Cell cell_;
  bool is_kept_ = false;
  uint32_t kept_[kMost];
};

/** A loop from the vertices of a cell, which `vertices` gives by their number in it. */
template <class Vertices>
Loop read_loop(std::integral_constant<int, 2>, const Vertices& vertices, const Shape& shape, uint32_t f) {
  const uint32_t a = vertices[f], b = vertices[f + 1 == shape.facet_count() ? 0 : f + 1];
  return {a < b ? a : b, a < b ? b : kEnd, a < b ? kEnd : a, kEnd};
}

template <class Vertices>
Loop read_loop(std::integral_constant<int, 3>, const Vertices& vertices, const Shape& shape, uint32_t f) {
  const uint16_t* const local = shape.dart_vertices() + shape.facet_first(f);
  const uint32_t size = shape.facet_size(f);
  uint32_t lowest = 0, low = vertices[local[0]];
  for (uint32_t k = 1; k < size; ++k) {
    const uint32_t v = vertices[local[k]];
    if (v < low) {
      lowest = k;
      low = v;
    }
  }
  const uint32_t after = vertices[local[lowest + 1 == size ? 0 : lowest + 1]];
  const uint32_t before = vertices[local[lowest == 0 ? size - 1 : lowest - 1]];
  return {low, after, before, size == 3 ? kEnd : size == 4 ? vertices[local[lowest ^ 2]] : kEnd - size};
}

/** The loop of a facet of a simplex of space. @param corners which of its vertices the facet has. */
Loop triangle_loop(const uint32_t* vertices, const uint16_t* corners) {
  const uint32_t a = vertices[corners[0]], b = vertices[corners[1]], c = vertices[corners[2]];
  if (a < b && a < c) return {a, b, c, kEnd};
  return b < c ? Loop{b, c, a, kEnd} : Loop{c, a, b, kEnd};
}

/** Whether two loops with as many vertices and the same lowest one are the same cycle, `reversed` or not. */
bool same_cycle(const Map<3>& map, HalfFacet a, Cell ca, HalfFacet b, uint32_t lowest, bool reversed) {
  const Cell cb = map.cell_of(b);
  const Shape sa = map.shape(ca), sb = map.shape(cb);
  const uint32_t fa = map.local_of(a, ca), fb = map.local_of(b, cb), size = sa.facet_size(fa);
  const auto at = [&](Cell c, const Shape& s, uint32_t f, uint32_t k) {
    return map.vertex(c, s.dart_vertex(s.facet_first(f) + k));
  };
  uint32_t ka = 0, kb = 0;
  while (at(ca, sa, fa, ka) != lowest) ++ka;
  while (at(cb, sb, fb, kb) != lowest) ++kb;
  for (uint32_t k = 2; k < size; ++k) {
    const uint32_t step = reversed ? size - k : k;
    if (at(ca, sa, fa, (ka + k) % size) != at(cb, sb, fb, (kb + step) % size)) return false;
  }
  return true;
}
bool same_cycle(const Map<2>&, HalfFacet, Cell, HalfFacet, uint32_t, bool) { return true; }

/**
 * Sides are linked in chains, one for every vertex: of the facets whose lowest vertex that is, one side each. While
 * facets are matched, links hold the chains, so nothing is needed beside them but where chains begin and a bit a word.
 *   side in a chain    kMarkBit and the next one in the chain, or kNoFacet
 *   first side         that matched side in the chain which has taken its place there
 *   side with a link   what it is linked to
 * Parts of the vertices can be matched side by side: both sides of a facet have the same lowest vertex.
 */
template <int D>
class Matching {
 public:
  explicit Matching(Environment<D>& env)
      : map_(env.map), heads_(map_.vertex_count, kNoFacet, env.memory), bits_(map_.words.size() / 32 + 1, env.memory) {}

  /** What was found for a part of the vertices. */
  struct Found {
    MatchDefect defect = MatchDefect::kNone;
    Offenders offenders;
    uint32_t facets = 0, matched = 0, linked = 0;  // linked: sides that had a link

    void offend(MatchDefect kind, uint32_t first, uint32_t second) {
      if (defect == MatchDefect::kNone) offenders.add(first);
      if (defect == MatchDefect::kNone || defect == kind) offenders.add(second);
      if (defect == MatchDefect::kNone) defect = kind;
    }
  };

  /** Matches the facets whose lowest vertex is one of begin .. end-1. `is_shared`: other parts are matched meanwhile. */
  Found match(uint32_t begin, uint32_t end, bool has_links, bool is_shared) noexcept {
    Found found;
    CellVertices<D> vertices;
    const auto offer = [&](Cell c, HalfFacet h, const Loop& loop) {
      if (loop.lowest >= begin && loop.lowest < end) add(c, h, loop, is_shared, found);
    };
    for (uint32_t i = 0; i < map_.cell_count; ++i) {
      const Cell c = map_.cell(i);
      if (D == 3 && map_.form(c) == Form::kSimplex && !has_links) {
        const uint32_t* const w = map_.record(c);
        const uint32_t corners[4] = {w[0] & kVertexMask, w[1], w[2], w[3]};
        for (uint32_t f = 0; f < 4; ++f) offer(c, map_.half_facet(c, f), triangle_loop(corners, simplex_ + 3 * f));
        continue;
      }
      const Shape shape = map_.shape(c);
      bool is_read = false;
      for (uint32_t f = 0; f < shape.facet_count(); ++f) {
        const HalfFacet h = map_.half_facet(c, f);
        if (has_links && map_.opposite(h).valid()) {
          ++found.linked;
          continue;
        }
        if (!is_read) vertices.read(map_, c, shape);
        is_read = true;
        offer(c, h, read_loop(std::integral_constant<int, D>(), vertices, shape, f));
      }
    }
    return found;
  }
  /** Links the sides of cells begin .. end-1, once all are matched, and those that match them. */
  void link(uint32_t begin, uint32_t end) noexcept {
    for (uint32_t i = begin; i < end; ++i) {
      const Cell c = map_.cell(i);
      for (uint32_t f = 0, facets = map_.facets_of(c); f < facets; ++f) {
        const uint32_t side = map_.half_facet(c, f).word;
        if (is_matched(side)) continue;
        uint32_t& word = map_.words[side];
        if ((word & kMarkBit) != 0) {
          word = kNoFacet;
        } else if (word != kNoFacet) {
          map_.words[word] = side;
        }
      }
    }
  }

 private:
  void add(Cell c, HalfFacet h, const Loop& loop, bool is_shared, Found& found) noexcept {
    uint32_t* place = &heads_[loop.lowest];
    Direction direction = Direction::kNone;
    uint32_t side = *place;
    while (side != kNoFacet && (direction = compare(loop, c, h, {side})) == Direction::kNone) {
      place = &map_.words[side];
      side = *place & ~kMarkBit;
    }
    if (side == kNoFacet) {
      map_.words[h.word] = kMarkBit | heads_[loop.lowest];
      heads_[loop.lowest] = h.word;
      ++found.facets;
      return;
    }
    if (is_matched(side)) {
      // Only the first defect names its first cell. While other parts write links no link is read: after a defect all is
      // matched again by one thread.
      const bool needs_first = found.defect == MatchDefect::kNone && !is_shared;
      found.offend(MatchDefect::kThirdCell, needs_first ? first_cell_of(side) : 0, map_.index(c));
    } else if (direction == Direction::kSame) {
      found.offend(MatchDefect::kSameSide, map_.index(map_.cell_of({side})), map_.index(c));
    } else {
      map_.words[h.word] = std::exchange(map_.words[side], h.word);
      *place = (*place & kMarkBit) | h.word;
      set_matched(h.word, is_shared);
      ++found.matched;
    }
  }
  /** How the loop of a side in a chain follows one with the same lowest vertex. */
  Direction compare(const Loop& loop, Cell c, HalfFacet h, HalfFacet side) const noexcept {
    Loop other;
    if (D == 3 && form_of(map_.words[side.word / kUnitWords<D> * kUnitWords<D>]) == Form::kSimplex) {
      const uint32_t* const w = &map_.words[side.word / kUnitWords<D> * kUnitWords<D>];
      const uint32_t corners[4] = {w[0] & kVertexMask, w[1], w[2], w[3]};
      other = triangle_loop(corners, simplex_ + 3 * (side.word % kUnitWords<3> - (kUnitWords<3> - 4)));
    } else {
      const Cell of = map_.cell_of(side);
      const Shape shape = map_.shape(of);
      other = read_loop(std::integral_constant<int, D>(), LookedUp{map_, of}, shape, map_.local_of(side, of));
    }
    if (other.across != loop.across) return Direction::kNone;
    const bool is_opposite = other.after == loop.before && other.before == loop.after;
    if (!is_opposite && (other.after != loop.after || other.before != loop.before)) return Direction::kNone;
    const bool is_long = loop.across > kLong && loop.across != kEnd;
    if (is_long && !same_cycle(map_, h, c, side, loop.lowest, is_opposite)) return Direction::kNone;
    return is_opposite ? Direction::kOpposite : Direction::kSame;
  }
  /** The cell of the first side of a facet, of which a side in a chain is the second. */
  uint32_t first_cell_of(uint32_t second) const noexcept {
    uint32_t index = 0;
    for_each_cell(map_, [&](Cell c) {
      for (uint32_t f = 0, facets = map_.facets_of(c); f < facets; ++f) {
        if (map_.words[map_.half_facet(c, f).word] == second) index = map_.index(c);
      }
    });
    return index;
  }

  bool is_matched(uint32_t side) const noexcept {
    return (bits_[side / 32].word.load(std::memory_order_relaxed) >> side % 32 & 1u) != 0;
  }
  void set_matched(uint32_t side, bool is_shared) noexcept {
    std::atomic<uint32_t>& word = bits_[side / 32].word;
    const uint32_t bit = 1u << side % 32;
    if (is_shared) {
      word.fetch_or(bit, std::memory_order_relaxed);
    } else {
      word.store(word.load(std::memory_order_relaxed) | bit, std::memory_order_relaxed);
    }
  }

  /** Vertices of a cell, each looked up. */
  struct LookedUp {
    const Map<D>& map;
    Cell cell;
    uint32_t operator[](uint32_t local) const { return map.vertex(cell, local); }
  };
  struct Bits {
    std::atomic<uint32_t> word{0};
    Bits() = default;
    Bits(const Bits& other) noexcept : word(other.word.load()) {}
    Bits& operator=(const Bits&) = delete;
  };

  Map<D>& map_;
  const uint16_t* simplex_ = standard_shape(Form::kSimplex, 0).dart_vertices();  // of space
  Array<uint32_t> heads_;                                                        // of chains
  Array<Bits> bits_;  // of a word: a side in a chain that is matched
};

/** How many parts the vertices of a mesh are matched in. Each part reads all cells. */
template <int D>
uint32_t part_count(const Map<D>& map, const Parallel& parallel) {
  constexpr uint32_t kMostParts = 8;
  if (!is_shared(map, parallel)) return 1;
  return parallel.run != nullptr ? kMostParts : parallel.thread_count < kMostParts ? parallel.thread_count : kMostParts;
}

/** Matches the facets of all vertices, in parts side by side. */
template <int D>
typename Matching<D>::Found match_parts(const Map<D>& map, const Parallel& parallel, uint32_t parts,
                                        Matching<D>& matching) {
  using Found = typename Matching<D>::Found;
  Array<Found> found(parts, map.words.get_allocator());
  const auto first_of = [&](uint64_t part) { return static_cast<uint32_t>(map.vertex_count * part / parts); };
  auto body = [&](size_t begin, size_t end) noexcept {
    for (size_t i = begin; i < end; ++i) found[i] = matching.match(first_of(i), first_of(i + 1), false, true);
  };
  parallel_chunks(parallel, parts, 1, body);
  Found all;
  for (const Found& each : found) {
    if (each.defect != MatchDefect::kNone) all.defect = each.defect;
    all.facets += each.facets;
    all.matched += each.matched;
  }
  return all;
}

/** Takes all links of sides away. */
template <int D>
void unlink(Map<D>& map) noexcept {
  for_each_cell(map, [&](Cell c) {
    for (uint32_t f = 0, facets = map.facets_of(c); f < facets; ++f) map.words[map.half_facet(c, f).word] = kNoFacet;
  });
}

}  // namespace

template <int D>
MatchDefect match_facets(Environment<D>& env, Offenders& offenders, size_t open_sides, const Parallel& parallel) {
  Map<D>& map = env.map;
  const bool has_links = open_sides != kAllSides;
  const uint32_t parts = has_links ? 1 : part_count(map, parallel);
  std::optional<Matching<D>> matching(std::in_place, env);
  typename Matching<D>::Found found;
  if (parts > 1) {
    found = match_parts(map, parallel, parts, *matching);
    if (found.defect != MatchDefect::kNone) {  // the first one in the order of cells is wanted
      matching.reset();
      unlink(map);
      return match_facets(env, offenders, open_sides, kOneThread);
    }
  } else {
    found = matching->match(0, map.vertex_count, has_links, false);
  }
  auto link = [&](size_t begin, size_t end) noexcept {
    matching->link(static_cast<uint32_t>(begin), static_cast<uint32_t>(end));
  };
  parallel_chunks(parts > 1 ? parallel : kOneThread, map.cell_count, kCellsAtOnce, link);
  map.facet_count = found.facets;
  map.boundary_facet_count = map.facet_count - found.matched;
  map.facet_count += found.linked / 2;
  offenders = found.offenders;
  return found.defect;
}

DSW_INSTANTIATE(match_facets);

}  // namespace dsw
