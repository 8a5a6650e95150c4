#include "sweep/star.h"

#include <algorithm>

#include "predicates/inside_tetrahedron.h"

namespace dsw {
namespace {

/** The vertex before its edges before its faces. */
uint64_t feature(const StarContact& c) noexcept {
  if (c.edge != kNone) return 1 + uint64_t{c.edge};
  return c.face != kNone ? (uint64_t{1} << 33) + c.face : 0;
}

template <int D>
EdgeMotion motion_of_edge(const Body<D>& body, uint32_t v, const double* to, uint32_t e) {
  return {body.position(v), to, body.position(body.edges[e].other(v))};
}

/** Whether a point is seen to lie in a tetrahedron. */
bool is_seen_inside(const Environment<3>& env, Cell cell, const double* point) noexcept {
  const uint32_t* const w = env.map.record(cell);
  if (form_of(w[0]) != Form::kSimplex) return false;
  const double* corners[4];
  for (int i = 0; i < 4; ++i) corners[i] = env.point(w[i] & kVertexMask);
  return is_inside_tetrahedron(corners, point);
}
bool is_seen_inside(const Environment<2>&, Cell, const double*) noexcept { return false; }

template <int D>
FaceMotion motion_of_face(const Body<D>& body, uint32_t v, const double* to, uint32_t f) {
  const BodyFace& face = body.faces[f];
  return {body.position(v), to, body.position(face.after(v)), body.position(face.before(v))};
}

}  // namespace

template <int D>
StarSweep<D>::StarSweep(const Environment<D>& env) : env_(env), probe_(env), flood_(env) {}

template <int D>
bool StarSweep<D>::is_face_seen(const FaceMotion& m, Cell cell) const {
  return sees_all(env_, cell, m.to, counters) && sees_all(env_, cell, m.q, counters) &&
         sees_all(env_, cell, m.r, counters);
}

template <int D>
Settled StarSweep<D>::settle_by_what_is_kept(const Body<D>& body, const EdgeSweep& sweep, bool ask_balls,
                                             FirstRidge* ridge) {
  // What is known must not carry an edge past the work limit that it meets without.
  if (max_volumes != 0) return Settled::kNo;
  const Skipping& skipping = body.skipping;
  Settled settled = Settled::kNo;
  if (ask_balls && is_clear(env_, body, sweep)) {
    settled = Settled::kClear;
  } else if (body.keeps_sequences()) {
    scratch_.counters = counters;
    settled = ridge != nullptr ? follow_to_ridge(env_, body, sweep, true, scratch_, ridge)
                               : follow_sequence(env_, body, sweep, scratch_);
  }
  counts.skipped += settled != Settled::kNo && (skipping.by_clearance || skipping.sequences) ? 1 : 0;
  return settled;
}

/** Whether an edge is not known to be free in its new place; fills hit_edges_ with all, or some if one is enough. */
template <int D>
bool StarSweep<D>::find_hit_edges(const Body<D>& body, uint32_t v, const double* to, Cell cell, bool one_is_enough) {
  hit_edges_.clear();
  packet_.clear();  // of casts that ran out of memory
  const auto run = [&] {
    packet_.run(env_, counters);
    for (uint32_t i = 0; i < packet_.count(); ++i) {
      const CastEnd end = packet_.result(i).end;
      if (!packet_.reached(i)) hit_edges_.push_back(packet_edges_[i]);
      limited_ = limited_ || end == CastEnd::kWorkLimit;
    }
    packet_.clear();
  };
  for_each_edge(body, v, [&](uint32_t e) {
    const BodyVertex<D>& fixed = body.vertices[body.edges[e].other(v)];
    if (settles(body, {e, v, to, cell, fixed.position, fixed.cell, {}})) return true;
    packet_edges_[packet_.count()] = e;
    CastRequest& request = packet_.add(env_, cell, to, fixed.position);
    request.end = fixed.cell;
    request.max_volumes = max_volumes;
    if (packet_.full()) run();
    return !(one_is_enough && !hit_edges_.empty());
  });
  run();
  return !hit_edges_.empty();
}

/** Also notes whether it met the work limit. Most paths stay in a tetrahedron, which takes no cast to see. */
template <int D>
CastResult StarSweep<D>::cast_path(const Body<D>& body, uint32_t v, const double* to, bool stays) {
  const BodyVertex<D>& at = body.vertices[v];
  CastResult path;
  path.cell = at.cell;
  limited_ = false;
  if (stays || is_seen_inside(env_, at.cell, to)) return path;
  path = cast(env_, at.position, to, at.cell, max_volumes, counters);
  limited_ = path.end == CastEnd::kWorkLimit;
  return path;
}

template <int D>
StarTry StarSweep<D>::try_walls(const Body<D>& body, uint32_t v, const double* to, Cell* cell) {
  const BodyVertex<D>& at = body.vertices[v];
  StarTry tried;
  if (std::equal(to, to + D, at.position)) {
    *cell = at.cell;
    return tried;
  }
  const CastResult path = cast_path(body, v, to);
  *cell = path.cell;
  bool free = path.end == CastEnd::kReached;
  if (free && body.level == SweepLevel::kEdges) {
    free = !find_hit_edges(body, v, to, path.cell, true);
    if (!free) tried.edge = hit_edges_[0];
  } else if (free && body.level != SweepLevel::kPoints) {
    tried.edge = find_swept_edge(body, v, to, path);
    if (D == 3 && tried.edge == kNone && body.level == SweepLevel::kFaces) {
      tried.face = find_swept_face(body, v, to, path);
    }
    free = tried.edge == kNone && tried.face == kNone;
  }
  if (!free) tried.end = limited_ ? SweepEnd::kWorkLimit : SweepEnd::kContact;
  return tried;
}

/** An edge that is not free on its way, or kNone. */
template <int D>
uint32_t StarSweep<D>::find_swept_edge(const Body<D>& body, uint32_t v, const double* to, const CastResult& path) {
  const BodyVertex<D>& at = body.vertices[v];
  const PathFacets passed = path_facets(env_.map, at.cell, path);
  uint32_t met = kNone;
  for_each_edge(body, v, [&](uint32_t e) {
    const BodyVertex<D>& fixed = body.vertices[body.edges[e].other(v)];
    if (!settles(body, {e, v, to, path.cell, fixed.position, fixed.cell, passed}) &&
        !is_triangle_free({at.position, to, fixed.position}, at.cell)) {
      met = e;
    }
    return met == kNone;
  });
  return met;
}

/** A face that is not free on its way, or kNone. */
template <int D>
uint32_t StarSweep<D>::find_swept_face(const Body<D>& body, uint32_t v, const double* to, const CastResult& path) {
  const Cell from = body.vertices[v].cell;
  uint32_t met = kNone;
  for_each_face(body, v, [&](uint32_t f) {
    const BodyFace& face = body.faces[f];
    const FaceMotion m = motion_of_face(body, v, to, f);
    const Cell q = body.vertices[face.after(v)].cell, r = body.vertices[face.before(v)].cell;
    if (!stays_inside(m, from, path.cell, q, r) && !is_tetrahedron_free(m, from)) met = f;
    return met == kNone;
  });
  return met;
}

template <int D>
bool StarSweep<D>::find_obstacle(const Body<D>& body, uint32_t v, const double* to, const StarTry& tried,
                                 CastResult* hit, StarContact* inside) {
  const BodyVertex<D>& at = body.vertices[v];
  *inside = {{}, tried.edge, tried.face};
  const CastResult path = cast(env_, at.position, to, at.cell, 0, counters);
  if constexpr (D == 3) {
    if (tried.face != kNone) {
      inside->contact = flood(motion_of_face(body, v, to, tried.face), at.cell).contact;
      return false;
    }
  }
  *hit = path;
  if (tried.edge == kNone) return true;
  const EdgeMotion m = motion_of_edge(body, v, to, tried.edge);
  *hit = cast(env_, to, m.q, path.cell, 0, counters);
  if (hit->end == CastEnd::kHit) return true;
  inside->contact = flood(m, at.cell).contact;
  return false;
}

template <int D>
SweepEnd StarSweep<D>::find_first(const Body<D>& body, uint32_t v, const double* to, StarContact* first, Cell* cell,
                                  bool stays) {
  const BodyVertex<D>& at = body.vertices[v];
  if (std::equal(to, to + D, at.position)) {
    *cell = at.cell;
    return SweepEnd::kFree;
  }
  const CastResult path = cast_path(body, v, to, stays);
  *cell = path.cell;
  if (limited_) return SweepEnd::kWorkLimit;
  Earliest earliest{first};
  const bool reached = path.end != CastEnd::kHit;
  if (!reached) consider(at.position, to, {path_contact(env_, path), kNone, kNone}, earliest);
  if (body.level == SweepLevel::kEdges && reached) {
    find_hit_edges(body, v, to, path.cell, false);
    const PathFacets passed = body.keeps_sequences() ? path_facets(env_.map, at.cell, path) : PathFacets{};
    for (const uint32_t e : hit_edges_) {
      const BodyVertex<D>& fixed = body.vertices[body.edges[e].other(v)];
      const EdgeSweep sweep{e, v, to, path.cell, fixed.position, fixed.cell, passed};
      FirstRidge ridge;
      if (!stays_free(body, sweep, &ridge) && !consider_ridge(body, sweep, ridge, earliest)) {
        consider_edge(body, sweep, earliest);
      }
    }
  } else if (body.level != SweepLevel::kPoints) {
    const PathFacets passed = path_facets(env_.map, at.cell, path);
    for_each_edge(body, v, [&](uint32_t e) {
      const BodyVertex<D>& fixed = body.vertices[body.edges[e].other(v)];
      const EdgeSweep sweep{e, v, to, path.cell, fixed.position, fixed.cell, passed};
      FirstRidge ridge;
      const bool settled = reached
                               ? settle(body, sweep, true, &ridge) != Settled::kNo
                               : stays_before_wall(env_, at, to, path.cell, fixed) || stays_free(body, sweep, &ridge);
      if (settled || consider_ridge(body, sweep, ridge, earliest)) return true;
      consider_edge(body, sweep, earliest);
      return true;
    });
  }
  if (D == 3 && body.level == SweepLevel::kFaces) {
    for_each_face(body, v, [&](uint32_t f) {
      consider_face(body, v, to, f, earliest);
      return true;
    });
  }
  return limited_ ? SweepEnd::kWorkLimit : earliest.any ? SweepEnd::kContact : SweepEnd::kFree;
}

/** Whether an edge is known to meet nothing up to a wall that its moving end meets, or up to its new place, which is
 * not free. If not, `ridge` is what it meets first, if that is known. */
template <int D>
bool StarSweep<D>::stays_free(const Body<D>& body, const EdgeSweep& sweep, FirstRidge* ridge) {
  if (max_volumes != 0 || !body.keeps_sequences()) return false;
  scratch_.counters = counters;
  return follow_to_ridge(env_, body, sweep, false, scratch_, ridge) != Settled::kNo;
}

/** Whether the ridge that an edge meets first, if it is known, settles its sweep: it is the first contact, or comes
 * after the earliest contact that is known. */
template <int D>
bool StarSweep<D>::consider_ridge(const Body<D>& body, const EdgeSweep& sweep, const FirstRidge& ridge,
                                  Earliest& earliest) {
  if (!ridge.facet.valid()) return false;
  const double* const p = body.position(sweep.v);
  const int order =
      earliest.any ? compare_events<D>(p, sweep.to, earliest.contact->contact.event, ridge.event).sign : 1;
  if (order < 0) return true;
  SweepContact found;
  if (!meets_first(env_, body, sweep, ridge, &found)) return false;
  if (order == 0) {
    consider(p, sweep.to, {found, sweep.e, kNone}, earliest);
  } else {
    *earliest.contact = {found, sweep.e, kNone};
    earliest.any = true;
  }
  return true;
}

template <int D>
void StarSweep<D>::consider_edge(const Body<D>& body, const EdgeSweep& sweep, Earliest& earliest) {
  const Cell start = body.vertices[sweep.v].cell;
  const EdgeMotion m{body.position(sweep.v), sweep.to, sweep.q};
  if (is_boxed(bounds<D>(m.p, m.to, m.q), start)) return;
  scratch_.counters = counters;
  if (earliest.any && max_volumes == 0 &&
      is_free_before(env_, body, sweep, earliest.contact->contact.event, scratch_)) {
    return;
  }
  const double end = earliest.any ? time_after<D>(m.p, m.to, earliest.contact->contact.event) : 1;
  const SweepResult swept = flood_until(m, start, end);
  if (swept.end != SweepEnd::kContact) return;
  keep_touched_line(env_, body, sweep.e, sweep.v, swept.contact);
  consider(m.p, sweep.to, {swept.contact, sweep.e, kNone}, earliest);
}

template <int D>
void StarSweep<D>::consider_face(const Body<D>& body, uint32_t v, const double* to, uint32_t f, Earliest& earliest) {
  if constexpr (D == 3) {
    const FaceMotion m = motion_of_face(body, v, to, f);
    if (is_boxed(bounds<D>(m.p, m.to, m.q, m.r), body.vertices[v].cell)) return;
    const SweepResult swept = flood(m, body.vertices[v].cell);
    if (swept.end == SweepEnd::kContact) consider(m.p, to, {swept.contact, kNone, f}, earliest);
  }
}

/** Keeps the earlier one; of equal ones the vertex, then the lowest edge, then the lowest face. */
template <int D>
void StarSweep<D>::consider(const double* p, const double* to, StarContact found, Earliest& earliest) const {
  if (found.contact.event.kind == EventKind::kVertex) found.edge = found.face = kNone;
  const StarContact& first = *earliest.contact;
  const bool later =
      earliest.any &&
      (comes_before(env_.map, p, to, first.contact, found.contact) ||
       (!comes_before(env_.map, p, to, found.contact, first.contact) && feature(first) <= feature(found)));
  if (later) return;
  *earliest.contact = found;
  earliest.any = true;
}

template <int D>
void StarSweep<D>::find_all(const Body<D>& body, uint32_t v, const double* to, const StarContact& first,
                            Array<StarContact>& all) {
  all.clear();
  const CastResult path = cast(env_, body.position(v), to, body.vertices[v].cell, max_volumes, counters);
  if (path.end == CastEnd::kHit) all.push_back({path_contact(env_, path), kNone, kNone});
  if (body.level == SweepLevel::kPoints) return;
  if (body.level == SweepLevel::kEdges && path.end == CastEnd::kReached) {
    find_hit_edges(body, v, to, path.cell, false);
    for (const uint32_t e : hit_edges_) collect_edge(body, v, to, e, first, all);
  } else {
    for_each_edge(body, v, [&](uint32_t e) {
      collect_edge(body, v, to, e, first, all);
      return true;
    });
  }
  if (first.face != kNone) all.push_back(first);
  std::sort(all.begin(), all.end(), [&](const StarContact& a, const StarContact& b) {
    if (comes_before(env_.map, body.position(v), to, a.contact, b.contact)) return true;
    return !comes_before(env_.map, body.position(v), to, b.contact, a.contact) && feature(a) < feature(b);
  });
}

/** Appends what an edge meets. */
template <int D>
void StarSweep<D>::collect_edge(const Body<D>& body, uint32_t v, const double* to, uint32_t e, const StarContact& first,
                                Array<StarContact>& all) {
  flood(motion_of_edge(body, v, to, e), body.vertices[v].cell, true);
  for (const SweepContact& each : flood_.all()) {
    // The diagonal of a flat face is nothing to be met, but where the shift meets it first.
    const bool flat = kind_of(each) == ContactKind::kPlane && env_.map.convex(each.front) &&
                      !(e == first.edge && same_event(each, first.contact));
    if (each.event.kind != EventKind::kVertex && !flat) all.push_back({each, e, kNone});
  }
}

template class StarSweep<2>;
template class StarSweep<3>;

}  // namespace dsw
