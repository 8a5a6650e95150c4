#include "sweep/star.h"

#include <algorithm>

#include "body/simplices.h"

namespace dsw {
namespace {

uint32_t edge_of(const EdgeSweep& sweep) { return sweep.e; }
uint32_t edge_of(const FaceSweep&) { return kNone; }
uint32_t face_of(const EdgeSweep&) { return kNone; }
uint32_t face_of(const FaceSweep& sweep) { return sweep.f; }

/** The vertex before its edges before its faces. */
uint64_t feature(const StarContact& c) noexcept {
  if (c.edge != kNone) return 1 + uint64_t{c.edge};
  return c.face != kNone ? (uint64_t{1} << 33) + c.face : 0;
}

}  // namespace

template <int D>
typename StarSweep<D>::Way StarSweep<D>::go(const Body<D>& body, uint32_t v, const double* to) {
  const CastResult path = simplices.cast_path(body, v, to);
  const PathFacets crossed = body.keeps_corridors() ? path_facets(env_.map, body.vertices[v].cell, path) : PathFacets{};
  return {v, to, path, crossed, path.end == CastEnd::kReached};
}

template <int D>
EdgeSweep StarSweep<D>::edge_sweep(const Body<D>& body, const Way& way, uint32_t e) const {
  const BodyVertex<D>&at = body.vertices[way.v], &fixed = body.vertices[body.edges[e].other(way.v)];
  const bool first = body.edges[e].ends[0] == way.v;
  return {e,
          way.v,
          {at.position, at.cell, way.to, way.path.cell, fixed.position, fixed.cell, way.crossed, first, way.reached}};
}

template <int D>
FaceSweep StarSweep<D>::face_sweep(const Body<D>& body, const Way& way, uint32_t f) const {
  const BodyFace& face = body.faces[f];
  const BodyVertex<D>&q = body.vertices[face.after(way.v)], &r = body.vertices[face.before(way.v)];
  return {f, way.v, way.to, way.path.cell, q.position, r.position, q.cell, r.cell, way.reached};
}

/** Calls visit(sweep) for the edges and faces at the vertex until it returns false; whether it never did. */
template <int D>
template <class Visit>
bool StarSweep<D>::visit_sweeps(const Body<D>& body, const Way& way, Visit visit) const {
  return for_each_simplex_at(body, way.v, [&](const Simplex& each) {
    if (each.kind == Simplex::kEdge) return visit(edge_sweep(body, way, each.index));
    if (each.kind == Simplex::kFace) return visit(face_sweep(body, way, each.index));
    return true;
  });
}

template <int D>
StarTry StarSweep<D>::try_walls(const Body<D>& body, uint32_t v, const double* to, Cell* cell) {
  const BodyVertex<D>& at = body.vertices[v];
  StarTry tried;
  if (std::equal(to, to + D, at.position)) {
    *cell = at.cell;
    return tried;
  }
  const Way way = go(body, v, to);
  *cell = way.path.cell;
  const auto passes = [&](const auto& sweep) {
    if (simplices.passes(body, sweep)) return true;
    tried.edge = edge_of(sweep);
    tried.face = face_of(sweep);
    return false;
  };
  const bool free = way.reached && visit_sweeps(body, way, passes);
  if (!free) tried.end = simplices.is_limited() ? SweepEnd::kWorkLimit : SweepEnd::kContact;
  return tried;
}

template <int D>
bool StarSweep<D>::find_obstacle(const Body<D>& body, uint32_t v, const double* to, const StarTry& tried,
                                 CastResult* hit, StarContact* inside) {
  const BodyVertex<D>& at = body.vertices[v];
  const CastResult path = cast(env_, at.position, to, at.cell, 0, simplices.counters);
  const Way way{v, to, path, {}, path.end == CastEnd::kReached};
  if constexpr (D == 3) {
    if (tried.face != kNone) {
      *inside = {simplices.first_of(body, face_sweep(body, way, tried.face)), kNone, tried.face};
      return false;
    }
  }
  *hit = path;
  if (tried.edge == kNone) return true;
  const EdgeSweep sweep = edge_sweep(body, way, tried.edge);
  *hit = cast(env_, to, sweep.edge.q, path.cell, 0, simplices.counters);
  if (hit->end == CastEnd::kHit) return true;
  *inside = {simplices.first_of(body, sweep), tried.edge, kNone};
  return false;
}

template <int D>
SweepEnd StarSweep<D>::find_first(const Body<D>& body, uint32_t v, const double* to, StarContact* first, Cell* cell) {
  const BodyVertex<D>& at = body.vertices[v];
  if (std::equal(to, to + D, at.position)) {
    *cell = at.cell;
    return SweepEnd::kFree;
  }
  const Way way = go(body, v, to);
  *cell = way.path.cell;
  if (simplices.is_limited()) return SweepEnd::kWorkLimit;
  bool any = !way.reached;
  if (any) *first = {path_contact(env_, way.path), kNone, kNone};
  visit_sweeps(body, way, [&](const auto& sweep) {
    StarContact met{{}, edge_of(sweep), face_of(sweep)};
    const SweepEvent* const before = any ? &first->contact.event : nullptr;
    if (!simplices.find_first(body, sweep, before, &met.contact)) return true;
    if (met.contact.event.kind == EventKind::kVertex) met.edge = met.face = kNone;
    if (!any || comes_first(body, way, met, *first)) *first = met;
    return any = true;
  });
  return simplices.is_limited() ? SweepEnd::kWorkLimit : any ? SweepEnd::kContact : SweepEnd::kFree;
}

/** Whether a is met before b. Of what is met at the same time the vertex comes first, then the lowest edge, then the
 * lowest face. */
template <int D>
bool StarSweep<D>::comes_first(const Body<D>& body, const Way& way, const StarContact& a, const StarContact& b) const {
  const double* const p = body.position(way.v);
  if (comes_before(env_.map, p, way.to, a.contact, b.contact)) return true;
  return feature(a) < feature(b) && !comes_before(env_.map, p, way.to, b.contact, a.contact);
}

template <int D>
void StarSweep<D>::find_all(const Body<D>& body, uint32_t v, const double* to, const StarContact& first,
                            Array<StarContact>& all) {
  all.clear();
  const Way way = go(body, v, to);
  if (way.path.end == CastEnd::kHit) all.push_back({path_contact(env_, way.path), kNone, kNone});
  const auto collect = [&](const EdgeSweep& sweep) {
    for (const SweepContact& each : simplices.find_all(body, sweep)) {
      // The diagonal of a flat face is nothing to be met, but where the shift meets it first.
      const bool flat = kind_of(each) == ContactKind::kPlane && env_.map.convex(each.front) &&
                        !(sweep.e == first.edge && same_event(each, first.contact));
      if (each.event.kind != EventKind::kVertex && !flat) all.push_back({each, sweep.e, kNone});
    }
  };
  for_each_simplex_at(body, v, [&](const Simplex& each) {
    if (each.kind != Simplex::kEdge) return true;
    const EdgeSweep sweep = edge_sweep(body, way, each.index);
    // At EDGES an edge that is free in its new place meets nothing.
    const bool free = way.reached && !sweeps_edges(body.level) && simplices.passes(body, sweep);
    if (!free) collect(sweep);
    return true;
  });
  if (first.face != kNone) all.push_back(first);
  // No two are equivalent: of one edge or face there is one contact with each thing.
  const auto before = [&](const StarContact& a, const StarContact& b) { return comes_first(body, way, a, b); };
  std::sort(all.begin(), all.end(), before);
}

template class StarSweep<2>;
template class StarSweep<3>;

}  // namespace dsw
