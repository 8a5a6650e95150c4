#include "sweep/star.h"

#include <algorithm>

#include "base/sort.h"
#include "body/simplices.h"

namespace dsw {
namespace {

/** Whether a simplex at a moving vertex sweeps something: the vertex has its path, and an edge that is not free where it
 * is meets nothing until it has been freed. */
template <int D>
bool is_swept(const Body<D>& body, const Simplex& each) {
  return each.kind == Simplex::kFace || (each.kind == Simplex::kEdge && !body.is_untested(each.index));
}

}  // namespace

/** The vertex on its way. */
template <int D>
MovingPart StarSweep<D>::go(const Body<D>& body, uint32_t v, const double* to, CastResult* path) {
  const BodyVertex<D>& at = body.vertices[v];
  *path = simplices.cast_path(body, v, to);
  MovingPart vertex{};
  vertex.part = {Simplex::kVertex, v};
  vertex.vertex = v;
  vertex.way = {at.position, to, at.cell, path->cell, {}};
  if (body.keeps_corridors()) vertex.way.crossed = path_facets(env_.map, at.cell, *path);
  vertex.reached = path->end == CastEnd::kReached;
  return vertex;
}

/** An edge or a face at the vertex. */
template <int D>
MovingPart StarSweep<D>::sweep_of(const Body<D>& body, const MovingPart& vertex, const Simplex& part) const {
  MovingPart sweep = vertex;
  sweep.part = part;
  const uint32_t v = vertex.vertex;
  const bool is_edge = part.kind == Simplex::kEdge;
  const BodyVertex<D>& q = body.vertices[is_edge ? body.edges[part.index].other(v) : body.faces[part.index].after(v)];
  sweep.q = q.position;
  sweep.q_cell = q.cell;
  if (is_edge) {
    sweep.p_first = body.edges[part.index].ends[0] == v;
  } else {
    const BodyVertex<D>& r = body.vertices[body.faces[part.index].before(v)];
    sweep.r = r.position;
    sweep.r_cell = r.cell;
  }
  return sweep;
}

template <int D>
WayEnd StarSweep<D>::try_walls(const Body<D>& body, uint32_t v, const double* to, Cell* cell, Simplex* part) {
  const BodyVertex<D>& at = body.vertices[v];
  *part = {Simplex::kVertex, v};
  if (std::equal(to, to + D, at.position)) {
    *cell = at.cell;
    return WayEnd::kFree;
  }
  CastResult path;
  const MovingPart vertex = go(body, v, to, &path);
  *cell = path.cell;
  const auto passes = [&](const Simplex& each) {
    if (!is_swept(body, each) || simplices.passes(body, sweep_of(body, vertex, each))) return true;
    *part = each;
    return false;
  };
  if (vertex.reached && for_each_simplex_at(body, v, passes)) return WayEnd::kFree;
  return simplices.is_limited() ? WayEnd::kWorkLimit : WayEnd::kContact;
}

template <int D>
bool StarSweep<D>::find_obstacle(const Body<D>& body, uint32_t v, const double* to, const Simplex& part,
                                 CastResult* hit, SweepContact* inside) {
  const BodyVertex<D>& at = body.vertices[v];
  *hit = cast(env_, at.position, to, at.cell, 0, simplices.counters);
  if (part.kind == Simplex::kVertex) return true;
  MovingPart vertex{};
  vertex.vertex = v;
  vertex.way = {at.position, to, at.cell, hit->cell, {}};
  vertex.reached = hit->end == CastEnd::kReached;
  const MovingPart sweep = sweep_of(body, vertex, part);
  if (part.kind == Simplex::kEdge) {
    *hit = cast(env_, to, sweep.q, hit->cell, 0, simplices.counters);
    if (hit->end == CastEnd::kHit) return true;
  }
  *inside = simplices.first_of(sweep);
  inside->part = part;
  return false;
}

template <int D>
SweepEnd StarSweep<D>::find_first(const Body<D>& body, uint32_t v, const double* to, SweepContact* first, Cell* cell) {
  const BodyVertex<D>& at = body.vertices[v];
  if (std::equal(to, to + D, at.position)) {
    *cell = at.cell;
    return SweepEnd::kFree;
  }
  CastResult path;
  const MovingPart vertex = go(body, v, to, &path);
  *cell = path.cell;
  if (simplices.is_limited()) return SweepEnd::kWorkLimit;
  bool any = !vertex.reached;
  if (any) *first = path_contact(env_, path);
  first->part = vertex.part;
  for_each_simplex_at(body, v, [&](const Simplex& each) {
    if (!is_swept(body, each)) return true;
    SweepContact met;
    const SweepEvent* const before = any ? &first->event : nullptr;
    if (!simplices.find_first(body, sweep_of(body, vertex, each), before, &met)) return true;
    met.part = met.event.kind == EventKind::kVertex ? vertex.part : each;
    if (!any || comes_first(vertex.way, met, *first)) *first = met;
    return any = true;
  });
  return simplices.is_limited() ? SweepEnd::kWorkLimit : any ? SweepEnd::kContact : SweepEnd::kFree;
}

/** Whether a is met before b. Of what is met at the same time the vertex comes first, then the lowest edge, then the
 * lowest face. */
template <int D>
bool StarSweep<D>::comes_first(const PointWay& way, const SweepContact& a, const SweepContact& b) const {
  if (comes_before(env_.map, way.start, way.end, a, b)) return true;
  const bool is_lower = a.part.kind != b.part.kind ? a.part.kind < b.part.kind : a.part.index < b.part.index;
  return is_lower && !comes_before(env_.map, way.start, way.end, b, a);
}

template <int D>
void StarSweep<D>::find_all(const Body<D>& body, uint32_t v, const double* to, const SweepContact& first,
                            Array<SweepContact>& all) {
  all.clear();
  CastResult path;
  const MovingPart vertex = go(body, v, to, &path);
  if (path.end == CastEnd::kHit) {
    all.push_back(path_contact(env_, path));
    all.back().part = vertex.part;
  }
  const auto collect = [&](const MovingPart& sweep) {
    for (const SweepContact& each : simplices.find_all(sweep)) {
      // The diagonal of a flat face is nothing to be met, but where the shift meets it first.
      const bool flat = kind_of(each) == ContactKind::kPlane && env_.map.convex(each.front) &&
                        !(sweep.part == first.part && same_event(each, first));
      if (each.event.kind != EventKind::kVertex && !flat) {
        all.push_back(each);
        all.back().part = sweep.part;
      }
    }
  };
  for_each_simplex_at(body, v, [&](const Simplex& each) {
    if (each.kind != Simplex::kEdge || !is_swept(body, each)) return true;
    const MovingPart sweep = sweep_of(body, vertex, each);
    // At EDGES an edge that is free in its new place meets nothing.
    const bool free = vertex.reached && !sweeps_edges(body.level) && simplices.passes(body, sweep);
    if (!free) collect(sweep);
    return true;
  });
  if (first.part.kind == Simplex::kFace) all.push_back(first);
  // No two are equivalent: of one edge or face there is one contact with each thing.
  const auto before = [&](const SweepContact& a, const SweepContact& b) { return comes_first(vertex.way, a, b); };
  dsw::sort(all.begin(), all.end(), before);
}

template class StarSweep<2>;
template class StarSweep<3>;

}  // namespace dsw
