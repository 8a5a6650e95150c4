#include "conform/facet_split.h"

#include <algorithm>

#include "base/disjoint_sets.h"
#include "base/search.h"
#include "base/sort.h"
#include "environment/recut.h"
#include "predicates/turn.h"

namespace dsw {
namespace {

uint32_t find(VertexRange loop, uint32_t vertex) {
  return static_cast<uint32_t>(dsw::find(loop.begin(), loop.end(), vertex) - loop.begin());
}

}  // namespace

/** Positive to the left, seen from outside. */
int FacetSplit::turn(uint32_t a, uint32_t b, uint32_t c) const {
  if (a == c || b == c) return 0;
  return turn_sign<3>(env_.point(a), env_.point(b), env_.point(c), view_.axis) * view_.sense;
}

/** A ray along the first coordinate of the view meets an odd number of sides. */
LoopPlace FacetSplit::place(uint32_t vertex) const {
  const int height = (view_.axis + 2) % 3;
  const double level = env_.point(vertex)[height];
  bool is_inside = false;
  for (uint32_t k = 0; k < loop_.size(); ++k) {
    const uint32_t a = loop_[k], b = loop_.after(k);
    if (a == vertex) return LoopPlace::kCorner;
    const bool a_above = env_.point(a)[height] > level, b_above = env_.point(b)[height] > level;
    if (a_above == b_above) continue;
    const int side = turn_sign<3>(env_.point(a), env_.point(b), env_.point(vertex), view_.axis);
    if (side != 0 && (side > 0) == b_above) is_inside = !is_inside;
  }
  return is_inside ? LoopPlace::kInside : LoopPlace::kOutside;
}

/** Whether the way from a corner of the loop to v begins inside. */
bool FacetSplit::is_in_wedge(uint32_t corner, uint32_t v) const {
  const uint32_t k = find(loop_, corner), n = loop_.size();
  const uint32_t before = loop_[k == 0 ? n - 1 : k - 1], after = loop_.after(k);
  const bool left_of_next = turn(corner, after, v) > 0, left_of_last = turn(before, corner, v) > 0;
  return turn(before, corner, after) >= 0 ? left_of_next && left_of_last : left_of_next || left_of_last;
}

bool FacetSplit::crosses(uint32_t u, uint32_t v, uint32_t a, uint32_t b) const {
  return turn(u, v, a) * turn(u, v, b) < 0 && turn(a, b, u) * turn(a, b, v) < 0;
}

FacetSplit::Relation FacetSplit::relate(uint32_t u, uint32_t v) const {
  for (uint32_t k = 0; k < loop_.size(); ++k) {
    if (pair_of(loop_[k], loop_.after(k)) == pair_of(u, v)) return Relation::kSide;
    if (crosses(u, v, loop_[k], loop_.after(k))) return Relation::kCrosses;
  }
  const LoopPlace of_u = place(u), of_v = place(v);
  if (of_u == LoopPlace::kInside && of_v == LoopPlace::kInside) return Relation::kInside;
  const bool u_goes_in = of_u == LoopPlace::kInside || (of_u == LoopPlace::kCorner && is_in_wedge(u, v));
  const bool v_goes_in = of_v == LoopPlace::kInside || (of_v == LoopPlace::kCorner && is_in_wedge(v, u));
  if (u_goes_in != v_goes_in) return Relation::kCrosses;  // it leaves through a corner, or rounding decides
  return u_goes_in ? Relation::kInside : Relation::kApart;
}

/** Whether w lies on the segment from u to v, in the view. */
bool FacetSplit::is_between(uint32_t u, uint32_t w, uint32_t v) const {
  if (turn(u, v, w) != 0) return false;
  ClosedBox<3> box;
  box.add(env_.point(u));
  box.add(env_.point(v));
  const double* const p = env_.point(w);
  box.lower[view_.axis] = box.upper[view_.axis] = p[view_.axis];
  return box.meets(p, p);
}

/** Whether a segment between two points of the facet meets no side, no other segment and no other point. */
bool FacetSplit::is_free(uint32_t u, uint32_t v, const Array<uint32_t>& vertices) const {
  if (relate(u, v) != Relation::kInside) return false;
  for (const Segment& s : segments_) {
    if (s == pair_of(u, v) || crosses(u, v, s.from, s.to)) return false;
  }
  return dsw::none_of(vertices.begin(), vertices.end(),
                      [&](uint32_t w) { return w != u && w != v && is_between(u, w, v); });
}

/** Adds segments until all hang together with the loop: from a part that does not, to anything that it sees. */
bool FacetSplit::join_holes() {
  Array<uint32_t> vertices(loop_.begin(), loop_.end(), env_.memory);
  for (const Segment& s : segments_) {
    vertices.push_back(s.from);
    vertices.push_back(s.to);
  }
  dsw::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  const auto number = [&](uint32_t v) {
    return static_cast<uint32_t>(std::lower_bound(vertices.begin(), vertices.end(), v) - vertices.begin());
  };
  DisjointSets parts(static_cast<uint32_t>(vertices.size()), env_.memory);
  for (const uint32_t v : loop_) parts.join(number(loop_[0]), number(v));
  for (const Segment& s : segments_) parts.join(number(s.from), number(s.to));
  for (const uint32_t v : vertices) {
    const uint32_t home = number(loop_[0]);
    if (parts.root(number(v)) == parts.root(home)) continue;
    for (const uint32_t w : vertices) {
      if (parts.root(number(w)) == parts.root(number(v)) || !is_free(v, w, vertices)) continue;
      add(v, w);
      parts.join(number(v), number(w));
      if (parts.root(number(v)) == parts.root(home)) break;
    }
  }
  return dsw::all_of(vertices.begin(), vertices.end(),
                     [&](uint32_t v) { return parts.root(number(v)) == parts.root(number(loop_[0])); });
}

/** Round the loop on the left of a half: of those that leave its end, the first one clockwise from the way back. */
uint32_t FacetSplit::next(const Array<Segment>& halves, uint32_t half) const {
  const uint32_t u = halves[half].from, v = halves[half].to;
  const auto quarter = [&](uint32_t w) {  // clockwise from u: 1 less than half a turn, 2 half, 3 more, 4 all of it
    if (w == u) return 4;
    const int side = turn(v, u, w);
    return side < 0 ? 1 : side > 0 ? 3 : 2;
  };
  auto at = std::lower_bound(halves.begin(), halves.end(), Segment{v, 0});
  uint32_t best = static_cast<uint32_t>(at - halves.begin());
  for (; at != halves.end() && at->from == v; ++at) {
    const int of_best = quarter(halves[best].to), of_this = quarter(at->to);
    if (of_this < of_best || (of_this == of_best && turn(v, halves[best].to, at->to) > 0)) {
      best = static_cast<uint32_t>(at - halves.begin());
    }
  }
  return best;
}

bool FacetSplit::add_loop(const Array<uint32_t>& loop, const double* apex, Loops& out) const {
  Array<uint32_t> sorted(loop);
  dsw::sort(sorted.begin(), sorted.end());
  const VertexRange range{loop.data(), loop.data() + loop.size()};
  if (std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end()) {
    out.add(range);
    return true;
  }
  if (range.size() > kMostTriangulated) return false;
  Array<const double*> points{env_.memory};
  for (const uint32_t v : loop) points.push_back(env_.point(v));
  LoopPlaces places{env_.memory};
  if (!triangulate(points.data(), range.size(), apex, nullptr, places)) return false;
  for (size_t k = 0; k < places.size(); k += 3) {
    const uint32_t triangle[3] = {loop[places[k]], loop[places[k + 1]], loop[places[k + 2]]};
    out.add({triangle, triangle + 3});
  }
  return true;
}

bool FacetSplit::run(const double* apex, Loops& out) {
  dsw::sort(segments_.begin(), segments_.end());
  segments_.erase(std::unique(segments_.begin(), segments_.end()), segments_.end());
  if (!join_holes()) return false;
  Array<Segment> halves{env_.memory};
  for (uint32_t k = 0; k < loop_.size(); ++k) halves.push_back({loop_[k], loop_.after(k)});
  for (const Segment& s : segments_) {
    halves.push_back(s);
    halves.push_back({s.to, s.from});
  }
  dsw::sort(halves.begin(), halves.end());
  Array<uint8_t> done(halves.size(), 0, env_.memory);
  Array<uint32_t> loop{env_.memory};
  for (uint32_t start = 0; start < halves.size(); ++start) {
    loop.clear();
    for (uint32_t half = start; done[half] == 0; half = next(halves, half)) {
      done[half] = 1;
      loop.push_back(halves[half].from);
    }
    if (!loop.empty() && !add_loop(loop, apex, out)) return false;
  }
  return true;
}

}  // namespace dsw
