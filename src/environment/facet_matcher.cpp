#include "environment/facet_matcher.h"

#include "base/dimensions.h"

namespace dsw {
namespace {

/** One facet seen for the first time, in the chain of its lowest vertex. Its two neighbours round the loop tell it from
 * the others there; loops of four and more are compared in full. */
struct Candidate {
  uint32_t next;           // in the chain
  uint32_t word;           // the half-facet
  uint32_t after, before;  // vertices next to the lowest one; in the plane the other vertex, and which of them is first
  uint32_t size;           // of the loop
};

struct Loop {
  uint32_t lowest, after, before, size;
};

constexpr uint32_t kEnd = 0xffffffffu;

template <int D>
Loop read_loop(const Map<D>& map, Cell c, const Shape& shape, uint32_t f) {
  if constexpr (D == 2) {
    const uint32_t a = map.vertex(c, f), b = map.vertex(c, f + 1 == shape.facet_count() ? 0 : f + 1);
    return {a < b ? a : b, a < b ? b : kEnd, a < b ? kEnd : a, 2};
  } else {
    const uint32_t first = shape.facet_first(f), size = shape.facet_size(f);
    const auto at = [&](uint32_t k) { return map.vertex(c, shape.dart_vertex(first + k)); };
    uint32_t lowest = 0, low = at(0);
    for (uint32_t k = 1; k < size; ++k) {
      const uint32_t v = at(k);
      if (v < low) {
        lowest = k;
        low = v;
      }
    }
    return {low, at(lowest + 1 == size ? 0 : lowest + 1), at(lowest == 0 ? size - 1 : lowest - 1), size};
  }
}

/** Whether two loops with the same lowest vertex are the same cycle, `reversed` or not. */
bool same_cycle(const Map<3>& map, HalfFacet a, Cell ca, HalfFacet b, uint32_t lowest, bool reversed) {
  const Cell cb = map.cell_of(b);
  const Shape sa = map.shape(ca), sb = map.shape(cb);
  const uint32_t fa = map.local_of(a, ca), fb = map.local_of(b, cb), size = sa.facet_size(fa);
  if (sb.facet_size(fb) != size) return false;
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

}  // namespace

template <int D>
void copy_links(Environment<D>& env, const LinkedBefore<D>& before) {
  Map<D>& map = env.map;
  const Map<D>& from = before.env.map;
  for (uint32_t i = 0; i < map.cell_count; ++i) {
    if (before.is_other[i] != 0) continue;
    const Cell c = map.cell(i), was = from.cell(i);
    for (uint32_t f = 0, count = from.facets_of(was); f < count; ++f) {
      const HalfFacet o = from.opposite(from.half_facet(was, f));
      if (!o.valid()) continue;
      const Cell beyond = from.cell_of(o);
      const uint32_t j = from.index(beyond);
      if (before.is_other[j] != 0) continue;
      map.words[map.half_facet(c, f).word] = map.half_facet(map.cell(j), from.local_of(o, beyond)).word;
    }
  }
}

template <int D>
MatchDefect match_facets(Environment<D>& env, Offenders& offenders, bool has_links) {
  Map<D>& map = env.map;
  Array<uint32_t> chain(map.vertex_count, kEnd, env.memory);
  Array<Candidate> candidates{env.memory};
  if (!has_links) candidates.reserve(size_t{map.cell_count} * (D + 1));
  MatchDefect defect = MatchDefect::kNone;
  const auto offend = [&](MatchDefect kind, uint32_t first, uint32_t second) {
    if (defect != MatchDefect::kNone) {
      if (kind == defect) offenders.add(second);
      return;
    }
    defect = kind;
    offenders.add(first);
    offenders.add(second);
  };
  uint32_t matched = 0, linked = 0;  // linked: sides that had a link
  for (uint32_t i = 0; i < map.cell_count; ++i) {
    const Cell c = map.cell(i);
    const Shape shape = map.shape(c);
    for (uint32_t f = 0; f < shape.facet_count(); ++f) {
      const HalfFacet h = map.half_facet(c, f);
      if (has_links && map.opposite(h).valid()) {
        ++linked;
        continue;
      }
      const Loop loop = read_loop(map, c, shape, f);
      uint32_t n = chain[loop.lowest];
      bool opposite = false, same = false;
      for (; n != kEnd; n = candidates[n].next) {
        const Candidate& candidate = candidates[n];
        if (candidate.size != loop.size) continue;
        opposite = candidate.after == loop.before && candidate.before == loop.after;
        same = candidate.after == loop.after && candidate.before == loop.before;
        if ((opposite || same) && (loop.size < 4 || same_cycle(map, h, c, {candidate.word}, loop.lowest, opposite)))
          break;
      }
      if (n == kEnd) {
        candidates.push_back({chain[loop.lowest], h.word, loop.after, loop.before, loop.size});
        chain[loop.lowest] = static_cast<uint32_t>(candidates.size() - 1);
        continue;
      }
      const HalfFacet o{candidates[n].word};
      if (map.opposite(o).valid()) {
        offend(MatchDefect::kThirdCell, map.index(map.cell_of(o)), i);
      } else if (same) {
        offend(MatchDefect::kSameSide, map.index(map.cell_of(o)), i);
      } else {
        map.words[h.word] = o.word;
        map.words[o.word] = h.word;
        ++matched;
      }
    }
  }
  map.facet_count = static_cast<uint32_t>(candidates.size());
  map.boundary_facet_count = map.facet_count - matched;
  map.facet_count += linked / 2;
  return defect;
}

DSW_INSTANTIATE(copy_links);
DSW_INSTANTIATE(match_facets);

}  // namespace dsw
