// The new cells lie where the old ones were, so each point of those is in exactly one of these, under the shift; where the outer
// boundary moves, or volumes are removed, it can be in none. Bodies are looked at after the change has been applied.

#include "scene/edits.h"

#include "map/cell_queue.h"
#include "motion/cast.h"
#include "scene/occupation.h"
#include "sweep/body_probe.h"

namespace dsw {
namespace {

/** Particles and bodies of one scene in the course of an edit that is prepared. */
class Followers {
 public:
  Followers(Edit& edit, Scene<3>& scene)
      : edit_(edit),
        env_(edit.environment()),
        scene_(scene),
        particles_(Allocator<Seat>(scene.memory)),
        vertices_(Allocator<Seat>(scene.memory)),
        new_cells_(scene.memory) {}

  /** Finds new cells; those without any that is passable go to the scene's occupants. */
  void find_cells() {
    Array<Cell> marked{Allocator<Cell>(scene_.memory)};
    edit_.for_each_marked([&](Cell c) { marked.push_back(c); });
    find_occupants(scene_, marked.data(), marked.size());
    for (uint32_t slot = 0; slot < scene_.particles.size(); ++slot) {
      const ParticleState<3>& particle = scene_.particles[slot];
      if (!has_to_move(particle.cell)) continue;
      const Cell c = find(particle.position, particle.cell);
      particles_.push_back({0, slot, particle.cell, c});
      if (!is_passable(c)) scene_.occupants.push_back({slot, scene_.slots.generation(slot)});
    }
    for_each_body([&](uint32_t slot, Body& body) {
      bool all = true;
      for (uint32_t v = 0; v < body.vertices.size(); ++v) {
        if (!has_to_move(body.vertices[v].cell)) continue;
        const Cell c = find(body.position(v), body.vertices[v].cell);
        vertices_.push_back({slot, v, body.vertices[v].cell, c});
        all = all && is_passable(c);
      }
      if (!all) scene_.occupant_bodies.push_back({slot, scene_.body_slots.generation(slot)});
    });
  }

  /** After the edit was applied: bodies that are not free go to the scene's occupants. Their vertices are in their new cells. */
  void find_blocked_bodies() {
    BodyProbe probe(env_, changed_box(), Obstacle::kCells);
    for_each_body([&](uint32_t slot, Body& body) {
      if (!probe.is_free(body)) scene_.occupant_bodies.push_back({slot, scene_.body_slots.generation(slot)});
    });
  }

  void move_vertices(bool back) noexcept {
    for (const Seat& seat : vertices_) {
      scene_.bodies[seat.body].body.vertices[seat.place].cell = back ? seat.before : seat.after;
    }
  }

  void finish() noexcept {
    for (const Seat& seat : particles_) {
      scene_.particles[seat.place].cell = seat.after;
      scene_.particles[seat.place].forecast = kNoFacet;
    }
    for_each_body([&](uint32_t, Body& body) {
      for (EdgeSequence& sequence : body.sequences) {
        const auto gone = [&](uint32_t facet) { return is_gone(facet); };
        if (std::none_of(sequence.facets.begin(), sequence.facets.end(), gone)) continue;
        sequence.forget();
      }
    });
  }

 private:
  /** Of a particle, or of a vertex of a body. */
  struct Seat {
    uint32_t body, place;
    Cell before, after;
  };

  template <class Visit>
  void for_each_body(Visit visit) {
    for (uint32_t slot = 0; slot < scene_.bodies.size(); ++slot) {
      if (scene_.body_slots.alive(slot, scene_.body_slots.generation(slot))) visit(slot, scene_.bodies[slot].body);
    }
  }
  bool has_to_move(Cell c) const { return c.valid() && edit_.is_removed(c); }
  bool is_passable(Cell c) const { return c.valid() && !env_.map.marked(c); }
  /** The new cell of a point that was in `old`; none if no way leads there that meets no wall. Nearly always it is one of those that come
   * of `old`; else what the point was in, or a wall, has moved over it. */
  Cell find(const double* point, Cell old) {
    Cell found;
    edit_.for_each_heir(old, [&](size_t i) {
      if (contains(env_, edit_.cell(i), point)) found = edit_.cell(i);
      return !found.valid();
    });
    if (found.valid()) return found;
    CellQueue around(scene_.memory);
    const auto add_heirs = [&](Cell c) {
      edit_.for_each_heir(c, [&](size_t i) {
        around.insert(edit_.cell(i));
        return true;
      });
    };
    add_heirs(old);
    if (around.size() == 0) for_each_beyond(old, add_heirs);  // it came to nothing
    for (size_t i = 0; i < around.size(); ++i) {
      if (contains(env_, around[i], point)) return around[i];
      for_each_beyond(around[i], [&](Cell c) {
        if (is_new(c)) around.insert(c);
      });
    }
    return {};
  }
  /** Calls visit(cell) for the neighbours of a cell beyond facets that can be passed. */
  template <class Visit>
  void for_each_beyond(Cell c, Visit visit) const {
    for (uint32_t f = 0, facets = env_.map.facets_of(c); f < facets; ++f) {
      const HalfFacet h = env_.map.half_facet(c, f);
      if (!is_impassable(env_.map, h)) visit(env_.map.cell_of(env_.map.opposite(h)));
    }
  }
  bool is_new(Cell c) {
    for (size_t i = new_cells_.size(); i < edit_.cell_count(); ++i) new_cells_.insert(edit_.cell(i));
    return new_cells_.contains(c);
  }
  /** Whether a half-facet in a sequence goes, or leads elsewhere now. */
  bool is_gone(uint32_t word) const {
    if (word == kNoFacet) return false;
    return edit_.is_removed(env_.map.cell_of({word})) || edit_.is_relinked({word});
  }
  Box changed_box() const {
    Box box;
    const auto add = [&](Cell c) {
      for (uint32_t k = 0, n = env_.map.vertices_of(c); k < n; ++k) box.add(env_.point(c, k));
    };
    for (const Cell c : edit_.removed()) add(c);
    for (size_t i = 0; i < edit_.cell_count(); ++i) add(edit_.cell(i));
    edit_.for_each_marked(add);
    for (size_t i = 0; i < edit_.link_count(); ++i) {
      const FacetDraft facet = draft_of(env_, edit_.link(i));
      for (const uint32_t v : facet.loop) box.add(env_.point(v));
    }
    return box;
  }

  Edit& edit_;
  const Environment<3>& env_;
  Scene<3>& scene_;
  Array<Seat> particles_, vertices_;
  CellQueue new_cells_;  // once they are asked for
};

void follow(Edit& edit, Scene<3>& scene, void (*also)(void* user), void* user) {
  Followers followers(edit, scene);
  const auto is_occupied = [&] { return !scene.occupants.empty() || !scene.occupant_bodies.empty(); };
  followers.find_cells();
  if (is_occupied()) refuse(scene);
  edit.apply();
  followers.move_vertices(false);
  try {
    if (scene.body_slots.alive_count() != 0) followers.find_blocked_bodies();
    if (is_occupied()) refuse(scene);
    if (also != nullptr) also(user);
  } catch (...) {
    followers.move_vertices(true);
    edit.revert();
    throw;
  }
  followers.finish();
  edit.finish();
}

void try_to_follow(Edit& edit, Scene<3>& scene, void (*also)(void* user), void* user) {
  clear_occupants(&scene);
  try {
    follow(edit, scene, also, user);
  } catch (const std::bad_alloc&) {
    clear_occupants(&scene);
    throw;
  }
}

}  // namespace

void carry_out(Edit& edit, Scene<3>* scene) {
  clear_occupants(scene);
  edit.prepare();
  carry_out_prepared(edit, scene);
}

void carry_out_prepared(Edit& edit, Scene<3>* scene) {
  if (scene != nullptr) return try_to_follow(edit, *scene, nullptr, nullptr);
  edit.apply();
  edit.finish();
}

void carry_out_prepared(Edit& edit, Scene<3>& scene, void (*also)(void* user), void* user) {
  try_to_follow(edit, scene, also, user);
}

}  // namespace dsw
