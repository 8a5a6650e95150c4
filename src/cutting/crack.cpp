#include "cutting/crack.h"

#include "base/error.h"
#include "base/search.h"
#include "base/sort.h"
#include "base/vec.h"
#include "map/records.h"

namespace dsw {
namespace {

/** Out of the cell, in space twice as long as the facet is large. */
template <int D>
Vec facet_normal(const Environment<D>& env, HalfFacet h) {
  const FacetDraft facet = draft_of(env, h);
  if constexpr (D == 2) {
    return turned(unit(difference<D>(env.point(facet.loop[1]), env.point(facet.loop[0]))));
  } else {
    Vec sum;
    for (size_t t = 0; t < facet.triangles.size(); t += 3) {
      const double* const p = env.point(facet.triangles[t]);
      // Vectors get unit length first: the square of a very long or short edge is no double.
      const Vec a = unit(difference<D>(env.point(facet.triangles[t + 1]), p));
      sum += a.cross(unit(difference<D>(env.point(facet.triangles[t + 2]), p)));
    }
    return sum;
  }
}

}  // namespace

template <int D>
Crack<D>::Crack(Environment<D>& env, int32_t region) : env_(env), map_(env.map), region_(region) {
  make_ready(env.map);
}

template <int D>
void Crack<D>::add(HalfFacet a, HalfFacet b, size_t i) {
  const HalfFacet beyond = map_.opposite(a);
  if (beyond.valid()) {
    if (b != a && b != beyond)
      fail(DSW_STATUS_BAD_TOPOLOGY, "pair %zu: front and back are two faces, one is inside", i);
    b = beyond;
  } else {
    if (map_.opposite(b).valid()) {
      fail(DSW_STATUS_BAD_TOPOLOGY, "pair %zu: front and back are two faces, one is inside", i);
    }
    if (map_.cell_of(a) == map_.cell_of(b)) {
      fail(DSW_STATUS_BAD_TOPOLOGY, "pair %zu: both faces belong to volume %u", i, map_.index(map_.cell_of(a)));
    }
    if (!face_each_other(draft_of(env_, a), draft_of(env_, b))) {
      fail(DSW_STATUS_BAD_TOPOLOGY, "pair %zu: the faces do not have the same vertices in opposite order", i);
    }
  }
  for (const HalfFacet h : {a, b}) {
    const uint32_t known = sides_.size();
    if (sides_.insert(h.word) != known) fail(DSW_STATUS_DUPLICATE_ID, "pair %zu: a face occurs in two pairs", i);
  }
  pairs_.push_back({a, b});
}

/** Where a half-facet has a vertex: at the start of one of its darts; a side of the plane, that is one dart, also at
 * its end. */
template <int D>
uint64_t Crack<D>::key_at(HalfFacet h, uint32_t vertex) const {
  const Cell c = map_.cell_of(h);
  const Shape shape = map_.shape(c);
  uint32_t d = shape.facet_first(map_.local_of(h, c));
  if constexpr (D == 2) return map_.vertex(c, shape.dart_vertex(d)) == vertex ? start_key({c, d}) : end_key({c, d});
  while (map_.vertex(c, shape.dart_vertex(d)) != vertex) ++d;
  return start_key({c, d});
}

/** Passable cells beside a crack in what is impassable, and cells of earlier gaps. */
template <int D>
bool Crack<D>::is_space(Cell c, uint32_t pair) const {
  if (map_.marked(c)) return false;
  const Cell a = map_.cell_of(pairs_[pair].a), b = map_.cell_of(pairs_[pair].b);
  if (map_.marked(a) && map_.marked(b)) return true;
  return region_ != 0 && env_.region(c) == region_ && env_.region(a) != region_ && env_.region(b) != region_;
}

/** The cells round a ridge, from a facet of the crack to the next, which is returned; invalid at the boundary. */
template <int D>
HalfFacet Crack<D>::go_round(Dart d, Array<Dart>& passed) const {
  passed.clear();
  for (;;) {
    passed.push_back(d);
    const Dart e = across_ridge(map_, d);
    const HalfFacet h = half_facet(map_, e);
    if (is_in_crack(h)) return h;
    d = cross(map_, e);
    if (!d.cell.valid()) return {};
  }
}

/** Where the crack ends at a ridge with space round it: that cell of the space in which it would go on straight. */
template <int D>
void Crack<D>::find_mouth(Dart rim, uint32_t pair, const Array<Dart>& passed) {
  const double *const p = env_.point(dart_vertex(map_, rim)), *const q = env_.point(dart_target(map_, rim));
  double middle[D], inside[D] = {};
  point_at<D>(p, q, D == 3 ? 0.5 : 0, middle);
  const FacetDraft facet = draft_of(env_, pairs_[pair].a);
  for (const uint32_t v : facet.loop) {
    for (int k = 0; k < D; ++k) inside[k] += env_.point(v)[k] / static_cast<double>(facet.loop.size());
  }
  const Vec along = D == 3 ? unit(difference<D>(q, p)) : Vec::Zero();
  const auto across = [&](const Vec& v) { return unit(v - dot(v, along) * along); };
  const Vec ahead = across(difference<D>(middle, inside));
  Dart best;
  double most = -2;
  for (const Dart d : passed) {
    if (!is_space(d.cell, pair)) continue;
    double at[D];
    centre(env_, d.cell, at);
    const double straight = dot(across(difference<D>(at, middle)), ahead);
    if (straight <= most) continue;
    most = straight;
    best = d;
  }
  if (best.cell.valid()) mouths_.push_back({best, pair});
}

template <int D>
void Crack<D>::find_mouths() {
  Array<Dart> passed{env_.memory};
  const auto look = [&](uint32_t i, Dart d, HalfFacet end) {
    if (go_round(d, passed) == end) find_mouth(d, i, passed);
  };
  for (uint32_t i = 0; i < pairs_.size(); ++i) {
    const HalfFacet a = pairs_[i].a, b = pairs_[i].b;
    const Cell c = map_.cell_of(a);
    const uint32_t facet = map_.local_of(a, c);
    if constexpr (D == 2) {  // each dart of a side starts at one of its ends
      const Cell beyond = map_.cell_of(b);
      look(i, {c, facet}, b);
      look(i, {beyond, map_.local_of(b, beyond)}, a);
    } else {
      const Shape shape = map_.shape(c);
      for (uint32_t d = shape.facet_first(facet); d < shape.facet_first(facet + 1); ++d) look(i, {c, d}, b);
    }
  }
}

/** Finds a normal of the crack at a vertex; its side depends on which facet of a pair comes first. */
template <int D>
void Crack<D>::rough_normal(const Meeting& at, double* normal) const {
  Vec sum;
  for (size_t i = 0; i < at.count; ++i) {
    if (at.corners[i].side != 0) continue;
    const Vec n = facet_normal(env_, side(at.corners[i]));
    sum += (dot(n, sum) < 0 ? -1.0 : 1.0) * n;
  }
  store<3>(sum, normal);
}

/** A line through the space at a vertex, from mouth to mouth or from the only mouth to the outer boundary; at best
 * where the crack's plane goes on. Gives the facets that it crosses; false: there is none. */
template <int D>
bool Crack<D>::find_line(const Meeting& at, KeyTable& crossed) const {
  if (at.mouths.empty()) return true;
  if (at.mouths.size() > 2) return false;
  double normal[3];
  rough_normal(at, normal);
  return find_shortest_line(at, normal, crossed) || find_shortest_line(at, nullptr, crossed);
}

/** The shortest such line, with a normal only through facets on both sides of that plane. */
template <int D>
bool Crack<D>::find_shortest_line(const Meeting& at, const double* normal, KeyTable& crossed) const {
  struct Step {
    Cell cell;
    HalfFacet entry;  // in the cell before
    size_t before;
  };
  const uint32_t pair = mouths_[at.mouths[0]].pair;
  const Cell target = at.mouths.size() == 2 ? mouths_[at.mouths[1]].dart.cell : Cell{};
  Array<Step> steps{env_.memory};
  KeyTable seen(env_.memory);
  const auto visit = [&](Cell c, HalfFacet entry, size_t before) {
    const uint32_t known = seen.size();
    if (seen.insert(c.unit) == known) steps.push_back({c, entry, before});
  };
  const auto cross = [&](HalfFacet h) {
    crossed.insert(h.word);
    if (map_.opposite(h).valid()) crossed.insert(map_.opposite(h).word);
  };
  const auto cross_back = [&](size_t i) {
    for (; i != 0; i = steps[i].before) cross(steps[i].entry);
  };
  visit(mouths_[at.mouths[0]].dart.cell, {}, 0);
  for (size_t i = 0; i < steps.size(); ++i) {
    const Cell c = steps[i].cell;
    if (c == target) {
      cross_back(i);
      return true;
    }
    const Shape shape = map_.shape(c);
    for (uint32_t d = 0; d < shape.dart_count(); ++d) {
      if (map_.vertex(c, shape.dart_vertex(d)) != at.vertex) continue;
      const HalfFacet h = map_.half_facet(c, shape.dart_facet(d)), o = map_.opposite(h);
      if (is_in_crack(h)) continue;
      const auto height = [&](uint32_t dart) {
        return dot(to_vec<3>(normal), difference<D>(env_.point(c, shape.dart_vertex(dart)), env_.point(at.vertex)));
      };
      if (normal != nullptr && height(shape.beta0(d)) * height(shape.beta1(d)) > 0) continue;
      if (o.valid()) {
        if (is_space(map_.cell_of(o), pair)) visit(map_.cell_of(o), h, i);
      } else if (!target.valid()) {
        cross(h);
        cross_back(i);
        return true;
      }
    }
  }
  return false;
}

/** Whether a dart's ridge and cell are those of one of the mouths. */
template <int D>
bool Crack<D>::is_mouth(Dart d, const Array<uint32_t>& mouths) const {
  return dsw::any_of(mouths.begin(), mouths.end(), [&](uint32_t m) {
    const Dart at = mouths_[m].dart;
    return at == d || (D == 3 && at.cell == d.cell && across_ridge(map_, at) == d);
  });
}

/** The cells at a vertex. False: others have it, too, and would stay where it was. */
template <int D>
bool Crack<D>::find_cells_at(const Meeting& at, CellQueue& around) const {
  for (size_t i = 0; i < at.count; ++i) around.insert(map_.cell_of(side(at.corners[i])));
  for_each_cell_at_vertex(map_, at.vertex, around, [](Cell) {});
  return around.size() == map_.vertex_uses[at.vertex];
}

/** Calls visit(out, in) for the darts of some cells that start at a vertex, with those that end there. */
template <int D>
template <class Visit>
void Crack<D>::for_each_dart_at(uint32_t vertex, const CellQueue& around, Visit visit) const {
  for (size_t i = 0; i < around.size(); ++i) {
    const Shape shape = map_.shape(around[i]);
    for (uint32_t d = 0; d < shape.dart_count(); ++d) {
      if (map_.vertex(around[i], shape.dart_vertex(d)) != vertex) continue;
      const Dart out{around[i], d};
      visit(out, D == 3 ? Dart{around[i], shape.beta0(d)} : across_ridge(map_, out));
    }
  }
}

/** The cells at a vertex hang together round it through facets and edges, but not across the crack and the line that
 * carries it on; in the plane through sides and their own corners, but not across the crack and a mouth. */
template <int D>
DisjointSets Crack<D>::join_ends(const Meeting& at, const CellQueue& around, const KeyTable& crossed,
                                 KeyTable& ends) const {
  for_each_dart_at(at.vertex, around, [&](Dart out, Dart in) {
    ends.insert(start_key(out));
    ends.insert(end_key(in));
  });
  DisjointSets sets(ends.size(), env_.memory);
  for_each_dart_at(at.vertex, around, [&](Dart out, Dart in) {
    const HalfFacet h = half_facet(map_, out);
    const auto join = [&](Dart end) { sets.join(ends.find(start_key(out)), ends.find(end_key(end))); };
    if (D == 3 && crossed.find(h.word) == kNone) join(in);
    if (!is_mouth(out, at.mouths)) join(across_ridge(map_, out));
    if (!is_in_crack(h) && map_.opposite(h).valid()) join(cross(map_, out));
  });
  return sets;
}

/** Finds the unit normal of the crack at a vertex, from the corners in the set `first` to the others. False: the sum is
 * zero. */
template <int D>
template <class RootAt>
bool Crack<D>::find_normal(const Meeting& at, uint32_t first, RootAt root_at, double* out) const {
  Vec normal;
  for (size_t i = 0; i + 1 < at.count; ++i) {
    const Corner &a = at.corners[i], &b = at.corners[i + 1];
    if (a.pair != b.pair || root_at(a) == root_at(b)) continue;
    normal += facet_normal(env_, side(root_at(a) == first ? a : b));
  }
  normal = unit(normal);
  store<3>(normal, out);
  return !is_zero(normal);
}

/** Parts a vertex, if the crack leaves the cells at it in two sets. */
template <int D>
void Crack<D>::part_vertex(const Meeting& at) {
  CellQueue around(env_.memory);
  if (!find_cells_at(at, around)) return;
  KeyTable crossed(env_.memory), ends(env_.memory);
  if (D == 3 && !find_line(at, crossed)) return;
  DisjointSets sets = join_ends(at, around, crossed, ends);
  const auto root_at = [&](const Corner& c) { return sets.root(ends.find(key_at(side(c), at.vertex))); };
  const uint32_t first = root_at(at.corners[0]);
  uint32_t other = first;
  for (uint32_t i = 0; i < ends.size(); ++i) {
    const uint32_t root = sets.root(i);
    if (root == first || root == other) continue;
    if (other != first) return;
    other = root;
  }
  if (other == first) return;
  Parting parted{at.vertex, {}, static_cast<uint32_t>(cells_.size()), 0};
  if (!find_normal(at, first, root_at, parted.normal)) return;
  const auto parting = static_cast<uint32_t>(partings_.size());
  for (size_t i = 0; i < around.size(); ++i) cells_.push_back(around[i]);
  parted.end_cell = static_cast<uint32_t>(cells_.size());
  partings_.push_back(parted);
  for (uint32_t i = 0; i < ends.size(); ++i) {
    places_.insert(ends[i]);
    copies_.push_back(2 * parting + (sets.root(i) == first ? 0 : 1));
  }
}

template <int D>
void Crack<D>::part() {
  find_mouths();
  Array<Corner> corners{env_.memory};
  for (uint32_t i = 0; i < pairs_.size(); ++i) {
    const FacetDraft facet = draft_of(env_, pairs_[i].a);
    for (const uint32_t v : facet.loop) {
      corners.push_back({v, i, 0});
      corners.push_back({v, i, 1});
    }
  }
  dsw::sort(corners.begin(), corners.end());
  Array<MouthAt> mouths{env_.memory};
  for (uint32_t m = 0; m < mouths_.size(); ++m) {
    mouths.push_back({dart_vertex(map_, mouths_[m].dart), m});
    if (D == 3) mouths.push_back({dart_target(map_, mouths_[m].dart), m});
  }
  dsw::sort(mouths.begin(), mouths.end());
  Array<uint32_t> here{env_.memory};
  auto mouth = mouths.begin();
  for (size_t i = 0, end = 0; i < corners.size(); i = end) {
    const uint32_t v = corners[i].vertex;
    while (end < corners.size() && corners[end].vertex == v) ++end;
    here.clear();
    for (; mouth != mouths.end() && mouth->vertex == v; ++mouth) here.push_back(mouth->mouth);
    part_vertex({v, &corners[i], end - i, here});
  }
}

template class Crack<2>;
template class Crack<3>;

}  // namespace dsw
