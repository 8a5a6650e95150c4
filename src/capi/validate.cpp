// The exact validation on a call that is made again: what it says of ways and contacts, held against all obstacles. See
// src/cross_check/README.md.

#include <algorithm>
#include <cstdio>

#include "base/search.h"
#include "capi/convert.h"
#include "capi/replay.h"
#include "capi/scene_handle.h"
#include "cross_check/validation.h"
#include "scene/deformation.h"
#include "scene/near_bodies.h"

namespace dsw::capi {
namespace {

constexpr uint32_t kNoRank = UINT32_MAX;

template <int D>
bool are_equal(const double* a, const double* b) noexcept {
  return std::equal(a, a + D, b);
}

/** What can be said of a subject: where it is counted, and what is told of a body or a particle, if it is wrong. */
struct Said {
  uint64_t dsw_validation::*count;
  const char *of_body, *of_particle;
};
constexpr Said kEdgeIsFree{&dsw_validation::crossing, "body %u: edge %u meets something impassable", ""};
constexpr Said kFaceIsFree{&dsw_validation::pierced, "body %u: face %u meets something impassable", ""};
constexpr Said kWayIsFree{&dsw_validation::missed,
                          "body %u: vertex %u, or an edge of it, has passed something impassable",
                          "particle %u has passed something impassable"};
constexpr Said kContactAt{&dsw_validation::wrong, "body %u: a contact of vertex %u is at another time",
                          "particle %u stopped, though there is nothing in its way"};

template <int D>
class CallValidator {
 public:
  explicit CallValidator(const Scene<D>& scene)
      : scene_(scene),
        before_(scene_.memory),
        orders_(scene_.memory),
        particles_(scene_.memory),
        bodies_(scene_.memory),
        subjects_(scene_.memory),
        validator_(scene_.env) {}

  /** Before the call: where what it moves is. */
  void remember(dsw_replay& replay, const NextCall& next) {
    const auto with = [&](const auto& row, const auto& use) {
      if (next.number == row.number) row.read(next.arguments, replay).apply(use);
    };
    with(row_of<dsw_particle_move>, [&](auto*, auto particle, auto* target, auto* options, auto*) {
      remember_particle(particle, target, *options);
    });
    with(row_of<dsw_scene_move_particles>,
         [&](auto*, auto* particles, size_t count, auto* targets, size_t, auto* options, auto*) {
           for (size_t i = 0; targets != nullptr && i < count; ++i) {
             remember_particle(particles[i], targets + D * i, *options);
           }
         });
    with(row_of<dsw_body_move>,
         [&](auto*, auto body, auto*, size_t, size_t, auto* options, auto*) { remember_body(body, *options); });
    with(row_of<dsw_body_move_rigid>,
         [&](auto*, auto body, auto*, auto* options, auto*) { remember_body(body, *options, true); });
    with(row_of<dsw_scene_move_bodies>,
         [&](auto*, auto* bodies, size_t count, auto*, size_t, size_t, auto* options, auto*) {
           for (size_t i = 0; i < count; ++i) remember_body(bodies[i], *options);
         });
  }

  /** After it. `was_done`: it did not fail. */
  dsw_validation validate(bool was_done) {
    look_at_places();
    for (const Mover& mover : particles_) {
      if (was_done) claim_flight(mover);
    }
    for (const Mover& mover : bodies_) {
      if (was_done) claim_move(mover);
    }
    validator_.run();
    // Claims about one subject follow each other.
    const Array<Claim>& claims = validator_.claims();
    for (size_t i = 0; i < claims.size();) {
      bool is_met = false, is_folded = false;
      double time = 2;
      const size_t first = i;
      const Subject& subject = subjects_[claims[i].subject];
      for (; i < claims.size() && claims[i].subject == claims[first].subject; ++i) {
        is_met = is_met || claims[i].is_met;
        time = std::min(time, claims[i].time);
      }
      // A particle's contact says only that something was met, and not where.
      const bool is_wrong = subject.said != &kContactAt ? is_met
                            : subject.part == kNone     ? !is_met
                                                        : !is_met || subject.time != time;
      for (size_t k = first; is_wrong && k < i; ++k) is_folded = is_folded || validator_.is_folded(k);
      if (is_folded) ++validation_.not_validated;
      if (!is_wrong || is_folded) continue;
      ++(validation_.*subject.said->count);
      note(subject.part == kNone ? subject.said->of_particle : subject.said->of_body, subject.owner, subject.part);
    }
    const dsw_validation& v = validation_;
    validation_.is_right = v.lost + v.crossing + v.pierced + v.missed + v.wrong == 0 ? 1 : 0;
    return validation_;
  }

 private:
  /** What a claim is about, and what was said of it. */
  struct Subject {
    const Said* said;
    uint32_t owner, part;  // slots: of the body, and in it; of a particle
    double time;           // of a contact
  };
  /** A body, or a particle, before it moves. */
  struct Mover {
    uint32_t slot;
    bool is_exact;    // contacts are searched for exactly
    bool has_passes;  // further ones: vertices that met something may have moved again
    size_t first;     // of its points in before_
    size_t order_first, order_count;
    bool is_rigid = false;  // it goes along arcs
  };

  void remember_particle(dsw_particle_id particle, const double* target, const dsw_cast_options& options) {
    if (target == nullptr || !scene_.slots.alive(particle.index, particle.generation)) return;  // the call will fail
    particles_.push_back({particle.index, options.max_volumes == 0, false, before_.size(), 0, 0});
    const auto& from = scene_.particles[particle.index].position;
    before_.insert(before_.end(), from, from + D);
    before_.insert(before_.end(), target, target + D);
  }

  void remember_body(dsw_body_id id, const dsw_move_options& options, bool is_rigid = false) {
    if (!scene_.body_slots.alive(id.index, id.generation)) return;  // the call will fail
    const Body<D>& body = scene_.bodies[id.index].body;
    const bool is_exact = raw_value(options.search) == DSW_SEARCH_EXACT && options.max_volumes == 0;
    bodies_.push_back(
        {id.index, is_exact, options.passes != 0, before_.size(), orders_.size(), body.vertices.size(), is_rigid});
    for (const BodyVertex<D>& v : body.vertices) before_.insert(before_.end(), v.position, v.position + D);
    const bool is_ordered = options.order != nullptr;
    for (uint32_t v = 0; v < body.vertices.size(); ++v) orders_.push_back(is_ordered ? kNoRank : v);
    for (uint32_t i = 0; is_ordered && i < options.order_count; ++i) {
      const uint32_t v = options.order[i];
      if (v < body.vertices.size()) orders_[orders_.size() - body.vertices.size() + v] = i;
    }
  }

  void note(const char* format, uint32_t one, uint32_t other) {
    if (validation_.text[0] == 0) std::snprintf(validation_.text, sizeof validation_.text, format, one, other);
  }

  uint32_t add_subject(const Said& said, uint32_t owner, uint32_t part, double time = 0) {
    subjects_.push_back({&said, owner, part, time});
    return static_cast<uint32_t>(subjects_.size() - 1);
  }

  void look_at_places() {
    const auto is_lost = [&](Cell c, const double* point) {
      ++validation_.places;
      const bool lost = !c.valid() || is_closed(scene_.env, c) || !exactly_contains(scene_.env, c, point);
      validation_.lost += lost ? 1 : 0;
      return lost;
    };
    for (uint32_t i = 0; i < scene_.particles.size(); ++i) {
      const ParticleState<D>& state = scene_.particles[i];
      if (!scene_.slots.alive(i, scene_.slots.generation(i))) continue;
      if (is_lost(state.cell, state.position)) note("particle %u is not where it is said to be", i, 0);
    }
    for_each_body(scene_, [&](uint32_t slot, const BodyRecord<D>& of) {
      const Body<D>& body = of.body;
      for (uint32_t v = 0; v < body.vertices.size(); ++v) {
        if (body.has_vertex(v) && is_lost(body.vertices[v].cell, body.position(v))) {
          note("body %u: vertex %u is not where it is said to be", slot, v);
        }
      }
      look_at_body(slot, body);
    });
  }

  void look_at_body(uint32_t slot, const Body<D>& body) {
    for (uint32_t e = 0; body.level >= SweepLevel::kEdges && e < body.edges.size(); ++e) {
      if (!body.has_edge(e) || body.is_untested(e)) continue;  // those that were left may meet something
      const BodyEdge& edge = body.edges[e];
      validator_.add(add_subject(kEdgeIsFree, slot, e), body.position(edge.ends[0]), body.position(edge.ends[1]));
      ++validation_.edges;
    }
    for (uint32_t f = 0; body.level == SweepLevel::kFaces && f < body.faces.size(); ++f) {
      if (!body.has_face(f)) continue;
      const BodyFace& face = body.faces[f];
      validator_.add(add_subject(kFaceIsFree, slot, f), body.position(face.corners[0]), body.position(face.corners[1]),
                     body.position(face.corners[2]));
      ++validation_.faces;
    }
  }

  void claim_flight(const Mover& mover) {
    const double *const from = &before_[mover.first], *const target = from + D;
    const auto& now = scene_.particles[mover.slot].position;
    validator_.add(add_subject(kWayIsFree, mover.slot, kNone), from, now);
    ++validation_.ways;
    if (are_equal<D>(now, target)) return;
    if (!mover.is_exact) {
      ++validation_.not_validated;
      return;
    }
    validator_.add(add_subject(kContactAt, mover.slot, kNone, -1), from, target);
    ++validation_.contacts;
  }

  void claim_way(const Mover& mover, const Body<D>& body, uint32_t vertex) {
    const auto at = [&](uint32_t v) { return &before_[mover.first + D * size_t{v}]; };
    const uint32_t* const ranks = &orders_[mover.order_first];
    const uint32_t subject = add_subject(kWayIsFree, mover.slot, vertex);
    validator_.add(subject, at(vertex), body.position(vertex));
    ++validation_.ways;
    // Edges whose sweeps are left out by the share of motion are only free where they end.
    if (body.level < SweepLevel::kEdgesSwept || body.skipping.by_similar_motion) return;
    for_each_edge(body, vertex, [&](uint32_t e) {
      const uint32_t q = body.edges[e].other(vertex);
      validator_.add(subject, at(vertex), body.position(vertex), ranks[q] < ranks[vertex] ? body.position(q) : at(q));
      return true;
    });
  }

  void claim_contact(const Mover& mover, const dsw_body_contact& contact) {
    const bool is_wall = contact.contact.obstacle.kind != DSW_CELL_NONE, is_of_face = contact.face.generation != 0,
               is_thin = scene_.bodies[mover.slot].body.radius == 0;
    if (!is_wall || is_of_face || !is_thin || !mover.is_exact) {
      ++validation_.not_validated;
      return;
    }
    const uint32_t subject = add_subject(kContactAt, mover.slot, contact.vertex.index, contact.time);
    validator_.add(subject, contact.from, contact.to);
    if (contact.edge.generation != 0) validator_.add(subject, contact.from, contact.to, contact.fixed[0]);
    ++validation_.contacts;
  }

  void claim_move(const Mover& mover) {
    const BodyRecord<D>& of = scene_.bodies[mover.slot];
    if (mover.is_rigid) {  // what is claimed here goes straight
      validation_.not_validated += of.record.contacts.size() + of.record.moved;
      return;
    }
    for (const dsw_body_contact& contact : of.record.contacts) claim_contact(mover, contact);
    for (uint32_t v = 0; v < mover.order_count; ++v) {
      if (!of.record.edits.empty() || (mover.has_passes && !of.record.contacts.empty())) {
        ++validation_.not_validated;
        continue;
      }
      if (!of.body.has_vertex(v) || are_equal<D>(of.body.position(v), &before_[mover.first + D * size_t{v}])) continue;
      const auto is_its = [v](const dsw_body_contact& contact) { return contact.vertex.index == v; };
      if (dsw::any_of(of.record.contacts.begin(), of.record.contacts.end(), is_its)) continue;
      claim_way(mover, of.body, v);
    }
  }

  const Scene<D>& scene_;
  Array<double> before_;    // points
  Array<uint32_t> orders_;  // ranks of vertices
  Array<Mover> particles_, bodies_;
  Array<Subject> subjects_;
  Validator<D> validator_;
  dsw_validation validation_{};
};

}  // namespace
}  // namespace dsw::capi

dsw_status dsw_replay_step_validated(dsw_replay* replay, dsw_replay_report* report, dsw_validation* validation) {
  namespace capi = dsw::capi;
  return capi::guard(__func__, [&] {
    dsw_replay& handle = capi::check_handle(replay);
    dsw::require(report, "report");
    dsw::require(validation, "validation");
    capi::check_size(validation, "validation");
    capi::visit(*handle.scene, [&](const auto& scene) {
      capi::CallValidator<capi::kDimension<decltype(scene)>> validator(scene);
      *report = capi::step(handle, [&](const capi::NextCall& next) { validator.remember(handle, next); });
      const bool was_done = report->function != nullptr && handle.watch.last.made && !handle.watch.last.failed;
      capi::write_struct(validation, validator.validate(was_done));
    });
  });
}
