// All vertices first move as if nobody met anything, side by side; whoever does, and whoever relied on them, then moves one by one.
// What comes out is that of one vertex after the other: a sweep depends on others only through where their vertices are at its turn.

#include "response/body_move.h"

#include <algorithm>

#include "base/vec.h"
#include "contact/describe.h"
#include "contact/describe_pair.h"
#include "response/insertion.h"
#include "response/vertex_move.h"
#include "sweep/clearance.h"

namespace dsw {
namespace {

template <int D>
bool is_same_point(const double* a, const double* b) {
  return std::equal(a, a + D, b);
}

}  // namespace

template <int D>
BodyMove<D>::BodyMove(const Environment<D>& env) : env_(env), sweeps_(env), keeps_(env.memory) {}

template <int D>
void BodyMove<D>::move(Body<D>& body, PointArray targets, MoveOrder order, const MoveSettings& wanted,
                       MoveRecord& record) {
  MoveSettings settings = wanted;
  if (body.is_rigid() && settings.may_insert()) {
    settings.edge = MoveSettings::slides(settings.edge) ? Response::kSlide : Response::kStop;
  }
  record.clear();
  sweeps_.max_cells = settings.max_cells;
  start(body, order, targets);
  const bool edits = settings.may_edit();
  before_.assign(body.vertices.begin(), body.vertices.end());
  Body<D> whole(env_.memory);
  if (edits) whole = body;
  const auto go_back = [&] {
    if (edits) {
      std::swap(body, whole);
    } else {
      put_vertices(body, before_.data());
    }
  };
  try {
    const Skipping& skipping = body.skipping;
    const bool may_skip = (skipping.back_edges || skipping.by_similar_motion) && body.level == SweepLevel::kEdges;
    if (!run(body, targets, settings, record, may_skip)) {
      // An edge that was left out is not free where it ends: once more, and nothing is left out.
      if (edits) {
        Body<D> again = whole;
        std::swap(body, again);
      } else {
        go_back();
      }
      record.clear();
      start(body, order, targets);
      run(body, targets, settings, record, false);
    }
    if (settings.noise_share > 0) remove_noise(body, settings.noise_share, record);
  } catch (...) {
    go_back();
    throw;
  }
  record.moved = static_cast<uint32_t>(order_.size());
  record.sweeps = sweeps_.counts;
}

template <int D>
void BodyMove<D>::move_together(Body<D>& body, PlaceFn where, const void* user, MoveOrder order, MoveRecord& record) {
  record.clear();
  sweeps_.max_cells = 0;
  before_.assign(body.vertices.begin(), body.vertices.end());
  places_.resize(D * body.vertices.size());
  double fraction = 1;
  int halvings = 0;
  try {
    while (!try_together(body, where, user, fraction, order, record) && halvings < 52) {
      fraction /= 2;
      ++halvings;
    }
  } catch (...) {
    put_vertices(body, before_.data());
    throw;
  }
  const bool stays = std::equal(
      before_.begin(), before_.end(), body.vertices.begin(),
      [](const BodyVertex<D>& a, const BodyVertex<D>& b) { return is_same_point<D>(a.position, b.position); });
  record.fraction = halvings == 52 && stays ? 0 : fraction;
  record.moved = static_cast<uint32_t>(order_.size());
  record.stopped = record.fraction == 1 ? 0 : record.moved;
  record.sweeps = sweeps_.counts;
  for (dsw_contact& contact : record.contacts) {
    contact.distance_left = length(difference<D>(contact.to, body.position(contact.vertex.index)));
  }
}

/** Moves all vertices by a fraction of a motion, or none; the first contact of all tries is recorded. */
template <int D>
bool BodyMove<D>::try_together(Body<D>& body, PlaceFn where, const void* user, double fraction, MoveOrder order,
                               MoveRecord& record) {
  const PointArray targets{places_.data(), D};
  for (uint32_t v = 0; v < before_.size(); ++v) {
    double* const to = places_.data() + D * size_t{v};
    std::copy_n(before_[v].position, D, to);
    if (!body.has_vertex(v)) continue;
    where(user, v, before_[v].position, fraction, to);
    if (!is_finite<D>(to)) return false;  // a part of a motion can lead further than the whole
  }
  start(body, order, targets);
  sweep_all(body, targets, false);
  for (const uint32_t v : order_) {
    if (moving_[v].rank == kNone) continue;
    if (!moving_[v].doubtful && sweeps_.is_apart(body, v, targets[v])) {
      arrive(body, targets, v);
      continue;
    }
    // The first in doubt has met something: all before it have arrived.
    if (record.contacts.empty()) record_first(body, v, targets[v], record);
    put_vertices(body, before_.data());
    return false;
  }
  return true;
}

template <int D>
void BodyMove<D>::record_first(const Body<D>& body, uint32_t v, const double* to, MoveRecord& record) {
  StarContact first;
  PairContact<D> pair;
  Cell cell;
  const bool any = sweeps_.find_first(body, v, to, &first, &cell) == SweepEnd::kContact;
  const bool any_pair = sweeps_.partners != nullptr && find_first_pair(*sweeps_.partners, body, v, to, &pair);
  const dsw_contact contact = any ? describe(env_, body, v, to, first) : dsw_contact{};
  if (any_pair && !(any && contact.time <= pair.time)) {
    record.add(describe(env_, body, v, to, pair), partner_of(pair));
  } else if (any) {
    record.add(contact);
  }
}

template <int D>
void BodyMove<D>::start(const Body<D>& body, MoveOrder order, PointArray targets) {
  sweeps_.counts = {};
  packet_.clear();  // of casts left by a move that ran out of memory
  strays_.clear();
  if (body.keeps_sequences()) writers_.reserve(kPacket);  // casts point at them
  order_.clear();
  moving_.assign(body.vertices.size(), Moving{});
  if (body.keeps_sequences()) crossed_.assign(body.vertices.size(), PathFacets{});
  for (size_t v = 0; v < moving_.size(); ++v) moving_[v].from = moving_[v].arrival = body.vertices[v].cell;
  const size_t count = order.vertices != nullptr ? order.count : body.vertices.size();
  for (size_t i = 0; i < count; ++i) {
    const uint32_t v = order.vertices != nullptr ? order.vertices[i] : static_cast<uint32_t>(i);
    if (!body.has_vertex(v)) continue;
    // One that is told to stay is done: nothing moves.
    if (!is_same_point<D>(targets[v], body.position(v))) moving_[v].rank = static_cast<uint32_t>(order_.size());
    order_.push_back(v);
  }
}

/** False: the body was not free at an edge that was left out. */
template <int D>
bool BodyMove<D>::run(Body<D>& body, PointArray targets, const MoveSettings& settings, MoveRecord& record,
                      bool may_skip) {
  sweep_all(body, targets, may_skip);
  if (!finish(body, targets, settings, record, may_skip)) return false;
  // Where a vertex does not arrive, those before it may have left out the edge to it. Other edges that are left out are cast where their
  // ends arrive, or by the later of these, which moves alone.
  return !may_skip || std::all_of(strays_.begin(), strays_.end(), [&](uint32_t v) { return is_star_free(body, v); });
}

/** What is met if nobody else meets anything. */
template <int D>
void BodyMove<D>::sweep_all(Body<D>& body, PointArray targets, bool may_skip) {
  if (body.skipping.by_clearance && body.level != SweepLevel::kPoints) measure_clearances(body, targets);
  cast_paths(body, targets);
  if (body.level != SweepLevel::kPoints) sweep_edges(body, targets, may_skip);
  if constexpr (D == 3) {
    if (body.level == SweepLevel::kFaces) sweep_faces(body, targets);
  }
}

/** For vertices whose edges had to be cast; and how much room all have now. */
template <int D>
void BodyMove<D>::measure_clearances(Body<D>& body, PointArray targets) {
  double longest = 0;
  for (const uint32_t v : order_) {
    if (moving_[v].rank != kNone) longest = std::max(longest, distance_squared<D>(targets[v], body.position(v)));
  }
  const double way = std::sqrt(longest);
  rooms_.assign(body.vertices.size(), 0);
  for (uint32_t v = 0; v < body.vertices.size(); ++v) {
    if (!body.has_vertex(v)) continue;
    Clearance<D>& ball = body.clearances[v];
    if (ball.wanted > 0) refresh_clearance(env_, body, v, std::sqrt(ball.wanted) + way);
    ball.wanted = 0;
    rooms_[v] = room_squared(env_, ball, body.position(v), way);
  }
}

template <int D>
void BodyMove<D>::cast_paths(const Body<D>& body, PointArray targets) {
  const auto run = [&] {
    run_packet(body);
    for (uint32_t i = 0; i < packet_.count(); ++i) {
      const CastResult& path = packet_.result(i);
      Moving& moving = moving_[packet_vertices_[i]];
      moving.arrival = path.end == CastEnd::kReached ? path.cell : Cell{};
      if (body.keeps_sequences()) crossed_[packet_vertices_[i]] = path_facets(env_.map, packet_.request(i).start, path);
    }
    packet_.clear();
  };
  for (const uint32_t v : order_) {
    if (moving_[v].rank == kNone) continue;
    packet_vertices_[packet_.count()] = v;
    packet_.add(env_, body.vertices[v].cell, body.position(v), targets[v]).max_cells = sweeps_.max_cells;
    if (packet_.full()) run();
  }
  run();
}

template <int D>
void BodyMove<D>::sweep_faces(const Body<D>& body, PointArray targets) {
  find_sides(body);
  for (uint32_t f = 0; f < body.faces.size(); ++f) {
    if (!body.has_face(f) || shares_strip(body, f) || is_face_boxed(body, targets, f)) continue;
    for (const uint32_t v : body.faces[f].corners) {
      Moving& moving = moving_[v];
      if (moving.rank == kNone || moving.doubtful) continue;
      const uint32_t q = body.faces[f].after(v), r = body.faces[f].before(v);
      const Cell from = body.vertices[v].cell;
      const FaceMotion m{body.position(v), targets[v], place(body, targets, q, moving.rank),
                         place(body, targets, r, moving.rank)};
      if (sweeps_.stays_inside(m, from, moving.arrival, cell_at(q, moving.rank), cell_at(r, moving.rank))) continue;
      moving.doubtful = !sweeps_.is_tetrahedron_free(m, from);
    }
  }
}

/** Whether a face and what it sweeps lie in a box that is free. */
template <int D>
bool BodyMove<D>::is_face_boxed(const Body<D>& body, PointArray targets, uint32_t f) {
  const uint32_t(&corners)[3] = body.faces[f].corners;
  const bool stays = std::all_of(corners, corners + 3, [&](uint32_t v) { return moving_[v].rank == kNone; });
  if (stays || !BoxProbe<D>::suits(env_, moving_[corners[0]].from)) return false;
  Bounds<D> box(body.position(corners[0]));
  for (const uint32_t v : corners) include_way(body, targets, v, box);
  return sweeps_.is_boxed(box, moving_[corners[0]].from, moving_[corners[1]].from, moving_[corners[2]].from);
}

template <int D>
void BodyMove<D>::find_sides(const Body<D>& body) {
  sides_.assign(3 * body.faces.size(), kNone);
  for (uint32_t e = 0; e < body.edges.size(); ++e) {
    for (const uint32_t f : body.edges[e].faces) {
      if (f == kNone) continue;
      const BodyFace& face = body.faces[f];
      uint32_t opposite = 0;
      while (face.corners[opposite] == body.edges[e].ends[0] || face.corners[opposite] == body.edges[e].ends[1])
        ++opposite;
      sides_[3 * size_t{f} + opposite] = e;
    }
  }
}

/** Whether a face's edges keep to their sequences all through the move, and lie in one strip of cells. Then no edge of the environment
 * pierces the face, before, between or after, nor what its edges sweep: so no vertex is inside of the tetrahedra. */
template <int D>
bool BodyMove<D>::shares_strip(const Body<D>& body, uint32_t f) const {
  SequenceView views[3];
  for (uint32_t k = 0; k < 3; ++k) {
    const uint32_t e = sides_[3 * size_t{f} + k];
    const bool moves = moving_[body.edges[e].ends[0]].rank != kNone || moving_[body.edges[e].ends[1]].rank != kNone;
    if (moves ? !keeps_[e] : !sweeps_.keeps_sequence(body, e)) return false;
    const Array<uint32_t>& facets = body.sequences[e].facets;
    views[k] = {facets.data(), facets.size(), body.edges[e].ends[0] != body.faces[f].corners[(k + 1) % 3]};
  }
  return share_strip(env_.map, views[2], views[0], views[1]);
}

template <int D>
void BodyMove<D>::arrive(Body<D>& body, PointArray targets, uint32_t v) const {
  put_vertex(body, v, targets[v], moving_[v].arrival);
}

/** The vertices in their order: those without doubt arrive, the others move alone. Returns false if a vertex that has to move alone has
 * an edge that is not free: vertices before it have left that edge out. */
template <int D>
bool BodyMove<D>::finish(Body<D>& body, PointArray targets, const MoveSettings& settings, MoveRecord& record,
                         bool may_skip) {
  VertexMove<D> alone(env_, body, settings, sweeps_, record);
  for (const uint32_t v : order_) {
    if (moving_[v].rank == kNone) continue;
    if (!moving_[v].doubtful && sweeps_.is_apart(body, v, targets[v])) {
      arrive(body, targets, v);
      continue;
    }
    if (may_skip && !is_star_free(body, v)) return false;
    const size_t edits = record.edits.size();
    const bool reached = alone.move(v, targets[v]);
    record.stopped += reached ? 0 : 1;
    if (!reached || record.edits.size() != edits) disturb(body, v);
    for (size_t i = edits; i < record.edits.size(); ++i) disturb(body, record.edits[i].vertex.index);
  }
  return true;
}

/** The neighbours of a vertex that is not where they took it to be. */
template <int D>
void BodyMove<D>::disturb(const Body<D>& body, uint32_t v) {
  strays_.push_back(v);
  const auto doubt = [&](uint32_t u) {
    if (u < moving_.size()) moving_[u].doubtful = true;
  };
  doubt(v);
  for_each_edge(body, v, [&](uint32_t e) {
    doubt(body.edges[e].other(v));
    return true;
  });
}

/** Whether all edges of a vertex are free where they are. */
template <int D>
bool BodyMove<D>::is_star_free(const Body<D>& body, uint32_t v) {
  if (!body.has_vertex(v)) return true;
  const BodyVertex<D>& at = body.vertices[v];
  bool free = true;
  const auto run = [&] {
    packet_.run(env_, sweeps_.counters);
    for (uint32_t i = 0; i < packet_.count(); ++i) free = free && packet_.reached(i);
    packet_.clear();
  };
  for_each_edge(body, v, [&](uint32_t e) {
    const BodyVertex<D>& other = body.vertices[body.edges[e].other(v)];
    packet_.add(env_, at.cell, at.position, other.position).end = other.cell;
    if (packet_.full()) run();
    return true;
  });
  run();
  return free;
}

/** Merges inserted vertices that stand off the line between their two neighbours by less than noise. */
template <int D>
void BodyMove<D>::remove_noise(Body<D>& body, double share, MoveRecord& record) {
  const Array<uint32_t> candidates = body.inserted;
  for (const uint32_t v : candidates) {
    uint32_t edges[2] = {kNone, kNone}, count = 0;
    for_each_edge(body, v, [&](uint32_t e) {
      if (count < 2) edges[count] = e;
      return ++count < 3;
    });
    if (count != 2) continue;
    const double *a = body.position(body.edges[edges[0]].other(v)), *b = body.position(body.edges[edges[1]].other(v));
    const Vec line = difference<D>(b, a), off = difference<D>(body.position(v), a);
    const double size = length(line), beside = length(off.cross(unit(line)));
    if (!(beside <= share * size) || !(dot(off, line) > 0) || !(dot(off, line) < dot(line, line))) continue;
    dsw_body_edit edit;
    reserve_more(record.edits, 1);
    if (merge_vertex(sweeps_, body, edges[0], v, &edit)) record.edits.push_back(edit);
  }
}

template BodyMove<2>::BodyMove(const Environment<2>&);
template BodyMove<3>::BodyMove(const Environment<3>&);
template void BodyMove<2>::move(Body<2>&, PointArray, MoveOrder, const MoveSettings&, MoveRecord&);
template void BodyMove<3>::move(Body<3>&, PointArray, MoveOrder, const MoveSettings&, MoveRecord&);
template void BodyMove<2>::move_together(Body<2>&, PlaceFn, const void*, MoveOrder, MoveRecord&);
template void BodyMove<3>::move_together(Body<3>&, PlaceFn, const void*, MoveOrder, MoveRecord&);

}  // namespace dsw
