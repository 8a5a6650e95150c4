#include "sweep/star.h"

#include <algorithm>

#include "motion/standard_facets.h"

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

}  // namespace

StarSweep::StarSweep(const Environment<3>& env)
    : env_(env), flood_(env), hit_edges_(Allocator<uint32_t>(env.memory)) {}

bool StarSweep::skips(const Body& body, Cell from, Cell to, Cell fixed) {
  ++counts.swept;
  const bool inside = stays_inside(env_, from, to, fixed);
  if (!inside || (body.level == SweepLevel::kEdges && !body.skipping.by_environment)) return false;
  counts.skipped += body.skipping.by_environment ? 1 : 0;
  return true;
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
    if (skips(body, body.vertices[v].cell, cell, fixed.cell)) return true;
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
    if (skips(body, at.cell, path.cell, fixed.cell)) return true;
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
    const Cell fixed = body.vertices[body.edges[e].other(v)].cell;
    return reached && skips(body, at.cell, path.cell, fixed) ? true : sweep_edge(e);
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

/** Keeps the earlier one; of equal ones the vertex, then the lowest edge, then the lowest face. */
void StarSweep::consider(const double* p, const double* to, const StarContact& found, StarContact* first,
                         bool* any) const {
  StarContact next = found;
  if (next.contact.event.kind == EventKind::kVertex) next.edge = next.face = kNone;
  const auto feature = [](const StarContact& c) {
    return c.edge == kNone && c.face == kNone ? 0 : c.edge != kNone ? 1 + uint64_t{c.edge} : (uint64_t{1} << 33) + c.face;
  };
  const bool later =
      *any && (comes_before(env_.map, p, to, first->contact, next.contact) ||
               (!comes_before(env_.map, p, to, next.contact, first->contact) && feature(*first) <= feature(next)));
  if (later) return;
  *first = next;
  *any = true;
}

}  // namespace dsw
