#include "sweep/star.h"

#include <algorithm>

#include "motion/sequence.h"
#include "motion/standard_facets.h"
#include "sweep/clearance.h"

namespace dsw {
namespace {

CastResult fly(const Environment<3>& env, const double* from, const double* to, Cell start,
               CastCounters* counters) noexcept {
  CastRequest request;
  request.from = from;
  request.to = to;
  request.start = start;
  return cast(env, request, counters);
}

StarContact path_contact(const Environment<3>& env, const CastResult& path) noexcept {
  StarContact found;
  found.contact.front = path.cell;
  found.contact.facet = path.facet;
  found.contact.simplex = path.simplex;
  found.contact.faces_start = true;
  boundary_points(env, path.cell, path.simplex, found.contact.event.points);
  return found;
}

/** The vertex before its edges before its faces. */
uint64_t feature(const StarContact& c) noexcept {
  if (c.edge != kNone) return 1 + uint64_t{c.edge};
  return c.face != kNone ? (uint64_t{1} << 33) + c.face : 0;
}

}  // namespace

StarSweep::StarSweep(const Environment<3>& env) : env_(env), flood_(env), hit_edges_(Allocator<uint32_t>(env.memory)) {}

bool StarSweep::settles(const Body& body, const EdgeSweep& sweep) {
  ++counts.swept;
  const BodyVertex& from = body.vertices[sweep.v];
  if (stays_inside(env_, from.cell, sweep.arrival, sweep.fixed)) {
    counts.skipped += body.skipping.by_environment ? 1 : 0;
    if (body.skipping.by_environment || body.level != SweepLevel::kEdges) return true;
  }
  const bool known = (body.skipping.by_clearance && is_clear(body, sweep)) ||
                     (body.skipping.sequences && follows_sequence(body, sweep));
  counts.skipped += known ? 1 : 0;
  return known;
}

/** Whether the triangle lies in a ball that is free. */
bool StarSweep::is_clear(const Body& body, const EdgeSweep& sweep) const {
  const double* const p = body.position(sweep.v);
  return covers(env_, body.clearances[sweep.v], p, sweep.to, sweep.q) ||
         covers(env_, body.clearances[body.edges[sweep.e].other(sweep.v)], p, sweep.to, sweep.q);
}

/** Whether the edge keeps to the cells that it was last known to cross. If it did so before and after, and its end stays in its cell,
 * the whole triangle lies in these cells. */
bool StarSweep::follows_sequence(const Body& body, const EdgeSweep& sweep) const {
  const Array<uint32_t>& facets = body.sequences[sweep.e];
  const BodyVertex& from = body.vertices[sweep.v];
  const bool first = body.edges[sweep.e].ends[0] == sweep.v;
  const auto keeps = [&](const double* p, Cell cell) {
    return first ? follows(env_, p, sweep.q, cell, sweep.fixed, facets.data(), facets.size())
                 : follows(env_, sweep.q, p, sweep.fixed, cell, facets.data(), facets.size());
  };
  if (!keeps(sweep.to, sweep.arrival)) return false;
  return body.level == SweepLevel::kEdges || (from.cell == sweep.arrival && keeps(from.position, from.cell));
}

/** Whether an edge is not free in its new place; fills hit_edges_ with all, or with some if one is enough. */
bool StarSweep::find_hit_edges(const Body& body, uint32_t v, const double* to, Cell cell, bool one_is_enough) {
  hit_edges_.clear();
  const auto run = [&] {
    wave_.run(env_, counters);
    for (uint32_t i = 0; i < wave_.count(); ++i) {
      if (wave_.result(i).end == CastEnd::kHit) hit_edges_.push_back(wave_edges_[i]);
    }
    wave_.clear();
  };
  for_each_edge(body, v, [&](uint32_t e) {
    const BodyVertex& fixed = body.vertices[body.edges[e].other(v)];
    if (settles(body, {e, v, to, cell, fixed.position, fixed.cell})) return true;
    wave_edges_[wave_.count()] = e;
    wave_.add(env_, cell, to, fixed.position);
    if (wave_.full()) run();
    return !(one_is_enough && !hit_edges_.empty());
  });
  run();
  return !hit_edges_.empty();
}

bool StarSweep::is_free(const Body& body, uint32_t v, const double* to, Cell* cell) {
  const BodyVertex& at = body.vertices[v];
  if (std::equal(to, to + 3, at.position)) {
    *cell = at.cell;
    return true;
  }
  const CastResult path = fly(env_, at.position, to, at.cell, counters);
  *cell = path.cell;
  if (path.end == CastEnd::kHit || body.level == SweepLevel::kPoints) return path.end == CastEnd::kReached;
  if (body.level == SweepLevel::kEdges) return !find_hit_edges(body, v, to, path.cell, true);
  bool free = true;
  for_each_edge(body, v, [&](uint32_t e) {
    const BodyVertex& fixed = body.vertices[body.edges[e].other(v)];
    if (settles(body, {e, v, to, path.cell, fixed.position, fixed.cell})) return true;
    free = flood_.sweep(EdgeMotion{at.position, to, fixed.position}, at.cell, 0).end == SweepEnd::kFree;
    return free;
  });
  if (!free || body.level != SweepLevel::kFaces) return free;
  for_each_face(body, v, [&](uint32_t f) {
    const BodyFace& face = body.faces[f];
    const BodyVertex &q = body.vertices[face.after(v)], &r = body.vertices[face.before(v)];
    if (stays_inside(env_, at.cell, path.cell, q.cell) && q.cell == r.cell) return true;
    const FaceMotion m{at.position, to, q.position, r.position};
    free = flood_.sweep(m, at.cell, 0).end == SweepEnd::kFree;
    return free;
  });
  return free;
}

bool StarSweep::find_first(const Body& body, uint32_t v, const double* to, StarContact* first, Cell* cell) {
  const BodyVertex& at = body.vertices[v];
  if (std::equal(to, to + 3, at.position)) {
    *cell = at.cell;
    return false;
  }
  const CastResult path = fly(env_, at.position, to, at.cell, counters);
  *cell = path.cell;
  bool any = false;
  if (path.end == CastEnd::kHit) consider(at.position, to, path_contact(env_, path), first, &any);
  if (body.level == SweepLevel::kPoints) return any;

  const auto sweep_edge = [&](uint32_t e) {
    const EdgeMotion m{at.position, to, body.position(body.edges[e].other(v))};
    const SweepResult swept = flood_.sweep(m, at.cell, 0);
    if (swept.end == SweepEnd::kContact) consider(m.p, to, {swept.contact, e, kNone}, first, &any);
    return true;
  };
  if (body.level == SweepLevel::kEdges && !any) {
    if (find_hit_edges(body, v, to, path.cell, false)) std::for_each(hit_edges_.begin(), hit_edges_.end(), sweep_edge);
    return any;
  }
  const bool reached = !any;
  for_each_edge(body, v, [&](uint32_t e) {
    const BodyVertex& fixed = body.vertices[body.edges[e].other(v)];
    const bool settled = reached && settles(body, {e, v, to, path.cell, fixed.position, fixed.cell});
    return settled ? true : sweep_edge(e);
  });
  if (body.level != SweepLevel::kFaces) return any;
  for_each_face(body, v, [&](uint32_t f) {
    const BodyFace& face = body.faces[f];
    const FaceMotion m{at.position, to, body.position(face.after(v)), body.position(face.before(v))};
    const SweepResult swept = flood_.sweep(m, at.cell, 0);
    if (swept.end == SweepEnd::kContact) consider(m.p, to, {swept.contact, kNone, f}, first, &any);
    return true;
  });
  return any;
}

void StarSweep::find_all(const Body& body, uint32_t v, const double* to, Array<StarContact>& all) {
  const BodyVertex& at = body.vertices[v];
  all.clear();
  const CastResult path = fly(env_, at.position, to, at.cell, counters);
  if (path.end == CastEnd::kHit) all.push_back(path_contact(env_, path));
  if (body.level == SweepLevel::kPoints) return;
  for_each_edge(body, v, [&](uint32_t e) {
    flood_.sweep(EdgeMotion{at.position, to, body.position(body.edges[e].other(v))}, at.cell, 0, true);
    for (const SweepContact& each : flood_.all()) {
      if (each.event.kind != EventKind::kVertex) all.push_back({each, e, kNone});
    }
    return true;
  });
  StarContact first;
  Cell cell;
  if (body.level == SweepLevel::kFaces && find_first(body, v, to, &first, &cell) && first.face != kNone) {
    all.push_back(first);
  }
  std::sort(all.begin(), all.end(), [&](const StarContact& a, const StarContact& b) {
    if (comes_before(env_.map, at.position, to, a.contact, b.contact)) return true;
    return !comes_before(env_.map, at.position, to, b.contact, a.contact) && feature(a) < feature(b);
  });
}

/** Keeps the earlier one; of equal ones the vertex, then the lowest edge, then the lowest face. */
void StarSweep::consider(const double* p, const double* to, const StarContact& found, StarContact* first,
                         bool* any) const {
  StarContact next = found;
  if (next.contact.event.kind == EventKind::kVertex) next.edge = next.face = kNone;
  const bool later =
      *any && (comes_before(env_.map, p, to, first->contact, next.contact) ||
               (!comes_before(env_.map, p, to, next.contact, first->contact) && feature(*first) <= feature(next)));
  if (later) return;
  *first = next;
  *any = true;
}

}  // namespace dsw
