#include "flood/edge_turn.h"

#include <algorithm>

#include "flood/facet_pass.h"
#include "walk/standard_facets.h"

namespace dsw {
namespace {

constexpr size_t kMostAtPivot = 64;  // facets

/** The vertices of a facet, in its order; a triangle repeats the last. */
struct Ring {
  uint32_t vertices[4];

  /** Of a cell with standard facets. */
  Ring(const Map<3>& map, Cell c, uint32_t facet) noexcept { standard_corners(map.record(c), facet, vertices); }

  bool has(uint32_t vertex) const noexcept { return std::find(vertices, vertices + 4, vertex) != vertices + 4; }
  bool has(const Pivot<3>& pivot) const noexcept { return has(pivot.vertices[0]) && has(pivot.vertices[1]); }
};

bool suits(const Map<3>& map, Cell c) noexcept { return has_standard_facets(map.form(c)) && map.convex(c); }

Ring ring_of(const Map<3>& map, HalfFacet h) noexcept {
  const Cell c = map.cell_of(h);
  return {map, c, map.local_of(h, c)};
}

/** Finds what the line misses of a facet: the first ridge that it passes on the wrong side, as far as rounded tests
 * tell. False: it certainly misses none. */
bool find_missed(const Environment<3>& env, const Ring& ring, const double* from, const double* to,
                 Pivot<3>& pivot) noexcept {
  const double* corners[4];
  for (int i = 0; i < 4; ++i) corners[i] = env.point(ring.vertices[i]);
  if (kPassesFacet(corners, from, to)) return false;
  const filter::Vec<3> way = filter::difference<3>(to, from);
  for (int k = 0; k < 4; ++k) {
    const int next = k == 3 ? 0 : k + 1;
    if (corners[k] == corners[next]) continue;
    pivot = {{ring.vertices[k], ring.vertices[next]}};
    const filter::Vec<3> a = filter::difference<3>(corners[k], from), b = filter::difference<3>(corners[next], from);
    if (!(filter::dot(filter::cross(a, b), way) > 0)) break;
  }
  return true;
}

/** The other facet of a cell at an edge of `entered`. */
HalfFacet other_at_edge(const Map<3>& map, Cell c, HalfFacet entered, const Pivot<3>& edge) noexcept {
  const uint32_t count = map.facets_of(c);
  for (uint32_t f = 0; f < count; ++f) {
    const HalfFacet h = map.half_facet(c, f);
    if (h != entered && Ring(map, c, f).has(edge)) return h;
  }
  return {};
}

}  // namespace

bool turn_round_edge(const Environment<3>& env, EdgeSequence<3>& sequence, const double* from, const double* to,
                     Pivot<3>& pivot) {
  const Map<3>& map = env.map;
  const Array<uint32_t>& old = sequence.facets;
  const auto suit = [&](uint32_t f) { return suits(map, map.cell_of({f})); };
  if (!std::all_of(old.begin(), old.end(), suit)) return false;
  size_t begin = 0;
  while (begin < old.size() && !find_missed(env, ring_of(map, {old[begin]}), from, to, pivot)) ++begin;
  if (begin == old.size()) return false;
  size_t end = begin + 1;
  while (end < old.size() && ring_of(map, {old[end]}).has(pivot)) ++end;

  const Cell last = map.cell_of(map.opposite({old[end - 1]}));
  uint32_t turned[kMostAtPivot];
  size_t count = 0;
  HalfFacet entered{old[begin]};
  for (Cell c = map.cell_of(entered); c != last; c = map.cell_of(entered)) {
    if (!suits(map, c) || is_closed(env, c) || count == kMostAtPivot) return false;
    const HalfFacet next = other_at_edge(map, c, entered, pivot);
    if (!next.valid() || map.facet_marked(next)) return false;
    turned[count++] = next.word;
    entered = map.opposite(next);
    if (!entered.valid()) return false;
  }
  sequence.replace(env, begin, end, turned, count);
  return true;
}

}  // namespace dsw
