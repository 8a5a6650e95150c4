// All vertices first move as if nobody met anything, side by side; whoever does, and whoever relied on them, then moves
// one by one. What comes out is that of one vertex after the other: a sweep depends on others only through where their
// vertices are at its turn.

#include "response/body_move.h"

#include <algorithm>
#include <new>

#include "base/search.h"
#include "base/vec.h"
#include "contact/describe.h"
#include "motion/halving.h"
#include "response/insertion.h"
#include "response/vertex_move.h"

namespace dsw {

template <int D>
void BodyMove<D>::move(Body<D>& body, PointArray targets, MoveOrder order, const MoveSettings& wanted,
                       MoveRecord& record) {
  MoveSettings settings = wanted;
  if (body.is_rigid() && settings.may_insert()) {
    settings.edge = MoveSettings::slides(settings.edge) ? Response::kSlide : Response::kStop;
  }
  record.clear();
  star_.simplices.max_volumes = settings.max_volumes;
  start(body, targets, order);
  keep_forecasts(body);
  before_.assign(body.vertices.begin(), body.vertices.end());
  Array<Body<D>> whole(env_.memory);  // one, or none
  if (settings.may_edit()) whole.push_back(body);
  untested_.assign(body.untested.begin(), body.untested.end());
  try {
    const Skipping& skipping = body.skipping;
    const bool may_skip =
        (skipping.back_edges || skipping.by_similar_motion) && covers_edges(body.level) && !sweeps_edges(body.level);
    leaves_ = may_skip && skipping.leaves_back_edges;
    tested_.assign(may_skip ? body.edges.size() : 0, 0);
    if (!run(settings, record, may_skip)) {
      // An edge that was left out is not free where it ends: once more, and nothing is left out.
      Array<Body<D>> again = whole;
      go_back(body, again);
      record.clear();
      start(body, targets, order);
      run(settings, record, false);
    }
    if (settings.noise_share > 0) remove_noise(body, settings.noise_share, record);
  } catch (...) {
    go_back(body, whole);
    restore_forecasts(body);
    throw;
  }
  record.moved = static_cast<uint32_t>(course_.order.size());
  record.sweeps = star_.simplices.counts;
}

template <int D>
void BodyMove<D>::begin_steps(Body<D>& body, MoveRecord& record) {
  record.clear();
  star_.simplices.max_volumes = 0;
  keep_forecasts(body);
  before_.assign(body.vertices.begin(), body.vertices.end());
  places_.resize(D * body.vertices.size());
}

template <int D>
bool BodyMove<D>::step(Body<D>& body, PlaceFn where, const void* user, double fraction, MoveOrder order,
                       MoveRecord* record) {
  const PointArray targets{places_.data(), D};
  here_.assign(body.vertices.begin(), body.vertices.end());
  for (uint32_t v = 0; v < before_.size(); ++v) {
    double* const to = places_.data() + D * size_t{v};
    std::copy_n(before_[v].position, D, to);
    if (!body.has_vertex(v)) continue;
    where(user, v, before_[v].position, fraction, to);
    if (!is_finite<D>(to)) return false;  // a part of a motion can lead further than the whole
  }
  start(body, targets, order);
  // Between its places the body keeps its shape. So distances are those of hulls, whatever vertices do in their turns.
  TooNear<D> near;
  if (!star_.thick.keeps_motion(star_.partners, body, targets, record == nullptr ? nullptr : &near)) {
    if (record != nullptr) {
      const uint32_t v = SimplexCorners<D>(body, near.part).vertices[0];
      record->add(describe(env_, body, v, targets[v], near), partner_of(star_.partners, near));
    }
    return false;
  }
  const bool is_far = body.radius > 0;  // from everything
  course_.all_clear = is_far;
  if (!is_far && known_ != nullptr) find_clear_parts(env_, *known_, course_, beyond_);
  sweep_all(false, false);
  look_ahead(false);
  for (const uint32_t v : course_.order) {
    if (!course_.moves(v)) continue;
    const bool is_apart = is_far || star_.is_apart(body, v, targets[v]);
    if (!course_.vertices[v].doubtful && is_apart) {
      course_.arrive(v);
      continue;
    }
    // The first in doubt has met something: all before it have arrived.
    if (record != nullptr) record_first(body, v, targets[v], *record);
    put_vertices(body, here_.data());
    star_.near = nullptr;
    return false;
  }
  star_.near = nullptr;
  return true;
}

template <int D>
void BodyMove<D>::end_steps(const Body<D>& body, double fraction, MoveRecord& record) {
  record.fraction = fraction;
  record.moved = static_cast<uint32_t>(course_.order.size());
  record.stopped = record.fraction == 1 ? 0 : record.moved;
  record.sweeps = star_.simplices.counts;
  for (dsw_body_contact& contact : record.contacts) {
    contact.distance_left = length(difference<D>(contact.to, body.position(contact.vertex.index)));
  }
}

template <int D>
void BodyMove<D>::undo_steps(Body<D>& body) noexcept {
  put_vertices(body, before_.data());
  restore_forecasts(body);
}

template <int D>
void BodyMove<D>::record_first(const Body<D>& body, uint32_t v, const double* to, MoveRecord& record) {
  SweepContact first;
  PairContact<D> pair;
  Cell cell;
  const bool any = star_.find_first(body, v, to, &first, &cell) == SweepEnd::kContact;
  const bool any_pair = star_.find_first_of_partners(body, v, to, &pair);
  const dsw_body_contact contact = any ? describe(env_, body, v, to, first) : dsw_body_contact{};
  if (any_pair && !(any && contact.time <= pair.time)) {
    record.add(describe(env_, body, v, to, pair), partner_of(pair));
  } else if (any) {
    record.add(contact);
  }
}

/** Makes a body what it was before the move: if edges may have changed, `whole`. */
template <int D>
void BodyMove<D>::go_back(Body<D>& body, Array<Body<D>>& whole) {
  if (!whole.empty()) return std::swap(body, whole[0]);
  put_vertices(body, before_.data());
  std::copy(untested_.begin(), untested_.end(), body.untested.begin());
}

template <int D>
void BodyMove<D>::start(Body<D>& body, PointArray targets, MoveOrder order) {
  star_.near = nullptr;
  star_.simplices.counts = {};
  strays_.clear();
  course_.start(body, targets, order);
  casts_.start();
}

/** False: the body was not free at an edge that was left out. */
template <int D>
bool BodyMove<D>::run(const MoveSettings& settings, MoveRecord& record, bool may_skip) {
  sweep_all(may_skip, true);
  if (!finish(settings, record, may_skip)) return false;
  // Every edge that was left out is free now: it was cast where its ends arrive, or its later end moved alone and the edge was cast
  // before. After an edit the edges of vertices that do not arrive are cast, too.
  const auto is_free = [&](uint32_t v) {
    find_asked(v, false);
    return casts_.are_free(v, asked_);
  };
  if (may_skip && !leaves() && !record.edits.empty() && !dsw::all_of(strays_.begin(), strays_.end(), is_free))
    return false;
  if (settings.passes != 0) go_on(settings, record);
  return true;
}

/** What is met if nobody else meets anything. */
template <int D>
void BodyMove<D>::sweep_all(bool may_skip, bool may_guess) {
  casts_.cast_paths();
  if (covers_edges(course_.motion.body->level)) edges_.sweep(may_skip, may_guess);
  if constexpr (D == 3) {
    if (covers_faces(course_.motion.body->level)) faces_.sweep();
  }
}

template <int D>
bool BodyMove<D>::arrives(uint32_t v) {
  const double* const to = course_.motion.targets[v];
  return !course_.vertices[v].doubtful && star_.is_apart(*course_.motion.body, v, to) &&
         star_.keeps_distance(*course_.motion.body, v, to);
}

/** The vertices in their order: those without doubt arrive, the others move alone. Returns false if a vertex that has
 * to move alone has an edge that is not free: vertices before it have left that edge out. */
template <int D>
bool BodyMove<D>::finish(const MoveSettings& settings, MoveRecord& record, bool may_skip) {
  VertexMove<D> alone(env_, *course_.motion.body, settings, star_, record);
  look_ahead(settings.may_slide());
  const bool notes = settings.passes != 0;
  if (notes) turns_.start(*course_.motion.body);
  double before[D];
  for (const uint32_t v : course_.order) {
    if (!course_.moves(v)) continue;
    if (notes) std::copy_n(course_.motion.body->position(v), D, before);
    if (arrives(v)) {
      course_.arrive(v);
      if (notes) turns_.note(*course_.motion.body, v, before, false);
      continue;
    }
    if (may_skip) find_asked(v, record.edits.empty());
    if (leaves()) test_untested(v, false);
    if (may_skip && !leaves() && !casts_.are_free(v, asked_)) return false;
    const size_t edits = record.edits.size(), exits = record.exits.size();
    const uint32_t limited = record.limited;
    // If nobody doubts it, and no edge was left out, only another body or this one can stop it.
    const bool past_walls = !course_.vertices[v].doubtful && !may_skip && settings.max_volumes == 0;
    const bool reached =
        alone.move(v, course_.motion.targets[v], past_walls ? &course_.motion.ways[v].arrival : nullptr);
    record.stopped += reached ? 0 : 1;
    if (notes) {
      const bool may_go_on = !reached && record.limited == limited && record.exits.size() == exits;
      turns_.note(*course_.motion.body, v, before, may_go_on, record.edits.data() + edits, record.edits.size() - edits);
    }
    if (!reached || record.edits.size() != edits) disturb(v);
    for (size_t i = edits; i < record.edits.size(); ++i) disturb(record.edits[i].vertex.index);
    if (leaves()) {
      keep_untested();
    } else if (may_skip && record.edits.empty()) {
      for_each_edge(*course_.motion.body, v, [&](uint32_t e) {
        tested_[e] = 1;
        return true;
      });
    }
  }
  star_.near = nullptr;
  return true;
}

/** Before a vertex moves alone: finds which of its edges have to be cast to know whether they are free where they are.
 * @param may_know the move has changed no edge. Then an edge needs no cast in two cases: its other end has not moved, and the edge was
 * free before the move; or its other end has moved, and the edge was tested at that turn. */
template <int D>
void BodyMove<D>::find_asked(uint32_t v, bool may_know) {
  const Body<D>& body = *course_.motion.body;
  asked_.clear();
  if (!body.has_vertex(v)) return;
  const bool tests_turns = !body.skipping.by_similar_motion;
  for_each_edge(body, v, [&](uint32_t e) {
    if (may_know) {
      const auto& other = course_.vertices[body.edges[e].other(v)];
      const bool has_moved = other.rank < course_.vertices[v].rank,
                 is_back = other.inwards && body.edges[e].faces[1] != kNone;
      const bool is_tested = tested_[e] != 0 || (tests_turns && !other.doubtful && !is_back);
      if (has_moved ? is_tested : untested_.empty() || untested_[e] == 0) return true;
    }
    asked_.push_back(e);
    return true;
  });
}

/** Before a vertex moves alone: which of its edges are free where they are. Those that are not meet nothing. What was found
 * out of edges whose other ends have their turns later counts again when this one is over.
 * @param is_pass of further passes: all have had their turns. */
template <int D>
void BodyMove<D>::test_untested(uint32_t v, bool is_pass) {
  const Body<D>& body = *course_.motion.body;
  left_.clear();
  for_each_edge(body, v, [&](uint32_t e) {
    const uint32_t w = body.edges[e].other(v);
    if (is_pass || w >= course_.vertices.size()) return true;
    const uint32_t rank = course_.vertices[w].rank;
    if (rank >= course_.vertices[v].rank && rank != kNone) left_.push_back({e, body.untested[e]});
    return true;
  });
  casts_.test_star(v, asked_);
}

/** After a vertex has moved alone: notes which of its edges to later vertices are free, and lets these have what was known before. */
template <int D>
void BodyMove<D>::keep_untested() {
  Body<D>& body = *course_.motion.body;
  for (const Left& each : left_) {
    if (!body.has_edge(each.edge)) continue;
    if (each.edge < tested_.size()) tested_[each.edge] = body.untested[each.edge] == 0 ? 1 : 0;
    body.untested[each.edge] = each.untested;
  }
}

/** Finds what of a body that meets itself can come near what, where many of its vertices move. */
template <int D>
void BodyMove<D>::look_ahead([[maybe_unused]] bool slides) {
  star_.near = nullptr;
  if constexpr (D == 3) {
    constexpr size_t kLeastEdges = 16, kOneIn = 4;
    const Body<D>& body = *course_.motion.body;
    if (star_.partners == nullptr || !body.filter.self || !covers_edges(body.level)) return;
    if (body.edges.size() < kLeastEdges || course_.order.size() * kOneIn < body.vertices.size()) return;
    if (!body.boxes[0].loners.empty()) return;
    try {
      near_.start(body, slides,
                  [&](uint32_t v) { return course_.moves(v) ? course_.motion.targets[v] : body.position(v); });
      if (near_.active()) star_.near = &near_;
    } catch (const std::bad_alloc&) {  // without the list boxes are asked
    }
  }
}

/** Further passes over the vertices that have stopped, of a body that is exactly free. Ends when nobody may go on. */
template <int D>
void BodyMove<D>::go_on(const MoveSettings& settings, MoveRecord& record) {
  const Body<D>& body = *course_.motion.body;
  const bool meets_bodies = star_.partners != nullptr;
  VertexMove<D> alone(env_, *course_.motion.body, settings, star_, record);
  const size_t contacts = record.contacts.size();
  for (uint32_t pass = 0; pass < settings.passes && turns_.start_pass(body, meets_bodies); ++pass) {
    for (const uint32_t v : turns_.waiting()) {
      if (!turns_.may_go_on(body, v, meets_bodies)) {
        turns_.leave(v);
        continue;
      }
      double before[D];
      std::copy_n(body.position(v), D, before);
      const uint32_t limited = record.limited;
      const size_t edits = record.edits.size(), exits = record.exits.size();
      if (leaves()) {
        find_asked(v, false);
        test_untested(v, true);
      }
      const bool reached = alone.move(v, course_.motion.targets[v]);
      record.stopped -= reached ? 1 : 0;
      const bool may_go_on = !reached && record.limited == limited && record.exits.size() == exits;
      turns_.note(body, v, before, may_go_on, record.edits.data() + edits, record.edits.size() - edits);
    }
  }
  if (record.contacts.size() != contacts) drop_repeated(record);
}

/** The neighbours of a vertex that is not where they took it to be. */
template <int D>
void BodyMove<D>::disturb(uint32_t v) {
  strays_.push_back(v);
  const auto doubt = [&](uint32_t u) {
    if (u < course_.vertices.size()) course_.vertices[u].doubtful = true;
  };
  doubt(v);
  for_each_edge(*course_.motion.body, v, [&](uint32_t e) {
    doubt(course_.motion.body->edges[e].other(v));
    return true;
  });
}

/** Merges inserted vertices that stand off the line between their two neighbours by less than noise. What leaves through
 * an exit is removed after the move, so it is not merged, and nothing is merged into it. */
template <int D>
void BodyMove<D>::remove_noise(Body<D>& body, double share, MoveRecord& record) {
  const Array<uint32_t> candidates = body.inserted;
  const auto leaves = [&](uint32_t v) {
    return dsw::any_of(record.exits.begin(), record.exits.end(),
                       [v](const dsw_exit& exit) { return exit.vertex.index == v; });
  };
  for (const uint32_t v : candidates) {
    uint32_t edges[2] = {kNone, kNone}, count = 0;
    for_each_edge(body, v, [&](uint32_t e) {
      if (count < 2) edges[count] = e;
      return ++count < 3;
    });
    if (count != 2 || body.is_untested(edges[0]) || body.is_untested(edges[1])) continue;
    if (leaves(v) || leaves(body.edges[edges[0]].other(v))) continue;
    const double *a = body.position(body.edges[edges[0]].other(v)), *b = body.position(body.edges[edges[1]].other(v));
    const Vec line = difference<D>(b, a), off = difference<D>(body.position(v), a);
    const double size = length(line), beside = length(off.cross(unit(line)));
    if (!(beside <= share * size) || !(dot(off, line) > 0) || !(dot(off, line) < dot(line, line))) continue;
    dsw_body_edit edit;
    reserve_more(record.edits, 1);
    if (merge_vertex(star_, body, edges[0], v, &edit)) record.edits.push_back(edit);
  }
}

template class BodyMove<2>;
template class BodyMove<3>;

}  // namespace dsw
