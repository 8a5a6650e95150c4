#include "environment/facet_matcher.h"

#include "base/dimensions.h"

namespace dsw {
namespace {

/** What tells a facet from the others with the same lowest vertex: its two neighbours round the loop, and of a quad the
 * vertex across. Loops of five and more are compared in full. */
struct Loop {
  uint32_t lowest, after, before;  // in the plane the two ends, and kEnd in place of the end that comes first
  uint32_t across;                 // kEnd of a triangle; of five and more their number before kEnd, which no vertex is
};

/** One facet seen for the first time, in the chain of its lowest vertex. */
struct Candidate {
  uint32_t next;  // in the chain
  uint32_t word;  // the half-facet
  uint32_t after, before, across;
};

constexpr uint32_t kEnd = 0xffffffffu;
constexpr uint32_t kLong = kEnd - 0xffffu;  // across of loops of five and more is above

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

Loop read_loop(const CellVertices<2>& vertices, const Shape& shape, uint32_t f) {
  const uint32_t a = vertices[f], b = vertices[f + 1 == shape.facet_count() ? 0 : f + 1];
  return {a < b ? a : b, a < b ? b : kEnd, a < b ? kEnd : a, kEnd};
}

Loop read_loop(const CellVertices<3>& vertices, const Shape& shape, uint32_t f) {
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

/** The first of a chain of candidates that has the loop of a facet of c, in the opposite or in the same direction; kEnd: there
 * is none. */
template <int D>
uint32_t find_in_chain(const Map<D>& map, const Array<Candidate>& candidates, uint32_t n, const Loop& loop, HalfFacet h,
                       Cell c, bool* same) noexcept {
  for (; n != kEnd; n = candidates[n].next) {
    const Candidate& candidate = candidates[n];
    if (candidate.across != loop.across) continue;
    const bool opposite = candidate.after == loop.before && candidate.before == loop.after;
    *same = candidate.after == loop.after && candidate.before == loop.before;
    if ((opposite || *same) && (loop.across <= kLong || loop.across == kEnd ||
                                same_cycle(map, h, c, {candidate.word}, loop.lowest, opposite))) {
      break;
    }
  }
  return n;
}

/** Half of all sides, and what outer boundaries have as a rule. */
template <int D>
size_t likely_facets(const Map<D>& map) noexcept {
  size_t sides = 0;
  for_each_cell(map, [&](Cell c) { sides += map.facets_of(c); });
  return sides / 2 + sides / 16 + 16;
}

}  // namespace

template <int D>
MatchDefect match_facets(Environment<D>& env, Offenders& offenders, size_t open_sides) {
  const bool has_links = open_sides != kAllSides;
  Map<D>& map = env.map;
  Array<uint32_t> chain(map.vertex_count, kEnd, env.memory);
  Array<Candidate> candidates{env.memory};
  candidates.reserve(has_links ? open_sides : likely_facets(map));
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
  CellVertices<D> vertices;
  for (uint32_t i = 0; i < map.cell_count; ++i) {
    const Cell c = map.cell(i);
    const Shape shape = map.shape(c);
    bool is_read = false;
    for (uint32_t f = 0; f < shape.facet_count(); ++f) {
      const HalfFacet h = map.half_facet(c, f);
      if (has_links && map.opposite(h).valid()) {
        ++linked;
        continue;
      }
      if (!is_read) vertices.read(map, c, shape);
      is_read = true;
      const Loop loop = read_loop(vertices, shape, f);
      bool same = false;
      const uint32_t n = find_in_chain(map, candidates, chain[loop.lowest], loop, h, c, &same);
      if (n == kEnd) {
        candidates.push_back({chain[loop.lowest], h.word, loop.after, loop.before, loop.across});
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

DSW_INSTANTIATE(match_facets);

}  // namespace dsw
