// The new cells lie where the old ones were, so each point of those is in exactly one of these, under the shift; where
// the outer boundary moves, or volumes are removed, it can be in none. Bodies are looked at after the change has been
// applied.

#include "scene/edits.h"

#include "base/dimensions.h"
#include "base/search.h"
#include "base/sort.h"
#include "map/cell_queue.h"
#include "scene/live_register.h"
#include "scene/near_bodies.h"
#include "scene/occupation.h"
#include "sweep/body_probe.h"
#include "walk/cast.h"

namespace dsw {
namespace {

/** Particles and bodies of one scene in the course of an edit that is prepared. */
template <int D>
class Followers {
 public:
  Followers(Edit<D>& edit, Scene<D>& scene)
      : edit_(edit),
        env_(edit.environment()),
        scene_(scene),
        places_(scene.memory, scene.keeps_boxes()),
        near_(scene, find_places()),
        vertices_(scene.memory) {}

  /** Finds new cells; those without any that is passable go to the scene's occupants. */
  void find_cells() {
    Array<Cell> marked{scene_.memory};
    edit_.for_each_marked([&](Cell c) { marked.push_back(c); });
    looked_at_ += find_occupants(scene_, marked.data(), marked.size());
    find_cells_of_particles();
    Array<uint32_t> scratch{scene_.memory};
    for (const typename NearBodies<D>::Near& each : near_) {
      const Body<D>& body = scene_.bodies[each.slot].body;
      bool all = true;
      const auto look = [&](uint32_t v) {
        if (!has_to_move(body.vertices[v].cell)) return true;
        const Cell c = find(body.position(v), body.vertices[v].cell);
        vertices_.push_back({each.slot, v, body.vertices[v].cell, c, kNoFacet});
        all = all && is_passable(c);
        return true;
      };
      visit_near(body, &BodyBoxes<D>::vertices, body.vertices.size(), each.places, scratch, looked_at_, look);
      if (!all) scene_.occupant_bodies.push_back({each.slot, scene_.body_slots.generation(each.slot)});
    }
  }

  /** After the edit was applied: bodies that are not free go to the scene's occupants, vertices in new cells. */
  void find_blocked_bodies() {
    BodyProbe<D> probe(env_, Obstacle::kCells);
    find_occupant_bodies(scene_, near_, probe);
    looked_at_ += probe.looked_at;
  }

  /** Makes room for what is noted, or if it may have to be taken back keeps copies of the corridors that are going to
   * be forgotten. */
  void prepare(bool may_go_back) {
    keeps_corridors_ = may_go_back;
    if (may_go_back) {
      for_each_gone_corridor([&](uint32_t slot, uint32_t e, const Corridor<D>& corridor) {
        corridors_.push_back({slot, e, corridor});
      });
    } else if (scene_.features.live) {
      scene_.live.get()->gone.reserve(edit_);
    }
  }

  void take_locations() noexcept {
    for (const Location& each : vertices_) scene_.bodies[each.body].body.vertices[each.place].cell = each.after;
    for (const Location& each : particles_) {
      scene_.particles[each.place].cell = each.after;
      scene_.particles[each.place].forecast = kNoFacet;
      note_particle(scene_, each.place);
    }
  }
  void leave_locations() noexcept {
    for (const Location& each : vertices_) scene_.bodies[each.body].body.vertices[each.place].cell = each.before;
    for (const Location& each : particles_) {
      scene_.particles[each.place].cell = each.before;
      scene_.particles[each.place].forecast = each.forecast;
      note_particle(scene_, each.place);
    }
    for (KeptCorridor& kept : corridors_) scene_.bodies[kept.body].body.corridors.swap_own(kept.edge, kept.corridor);
  }

  /** Corridors of what goes; to be done while it can still be asked. */
  void forget_corridors() noexcept {
    if (scene_.features.live && !keeps_corridors_) return note_gone_facets();
    for_each_gone_corridor([](uint32_t, uint32_t, Corridor<D>& corridor) { corridor.forget(); });
  }
  void finish() noexcept { count_looked_at(scene_, looked_at_); }

 private:
  /** Where a particle, or a vertex of a body, is before and after the edit. */
  struct Location {
    uint32_t body, place;
    Cell before, after;
    uint32_t forecast;  // before
  };
  struct KeptCorridor {
    uint32_t body, edge;
    Corridor<D> corridor;
  };

  void find_cells_of_particles() {
    uint64_t count = 0;
    const auto look = [&](uint32_t slot) {
      ++count;
      const ParticleState<D>& particle = scene_.particles[slot];
      if (has_to_move(particle.cell)) particles_.push_back({0, slot, particle.cell, {}, particle.forecast});
    };
    if (scene_.features.live) {
      for (const Cell c : edit_.removed()) scene_.live.get()->particles.for_each(c, look);
      dsw::sort(particles_.begin(), particles_.end(),
                [](const Location& a, const Location& b) { return a.place < b.place; });
    } else {
      for (uint32_t slot = 0, slots = static_cast<uint32_t>(scene_.particles.size()); slot < slots; ++slot) look(slot);
    }
    looked_at_ += count;
    for (Location& each : particles_) {
      each.after = find(scene_.particles[each.place].position, each.before);
      if (!is_passable(each.after)) scene_.occupants.push_back({each.place, scene_.slots.generation(each.place)});
    }
  }
  void note_gone_facets() noexcept {
    GoneFacets<D>& gone = scene_.live.get()->gone;
    if (gone.is_full()) {
      for (BodyRecord<D>& each : scene_.bodies) follow_changes(scene_, each);
      gone.clear();
    }
    gone.note(edit_);
  }
  /** Calls visit(slot, edge, corridor) for those that name facets that go, or lead elsewhere now. */
  template <class Visit>
  void for_each_gone_corridor(Visit visit) {
    const auto is_gone = [&](uint32_t word) {
      return word != kNoFacet && (edit_.is_removed(env_.map.cell_of({word})) || edit_.is_relinked({word}));
    };
    for (uint32_t slot = 0; slot < scene_.bodies.size(); ++slot) {
      Corridors<D>& corridors = scene_.bodies[slot].body.corridors;
      for (uint32_t e = 0; e < corridors.size(); ++e) {
        const Array<uint32_t>& facets = corridors[e].facets;
        if (dsw::any_of(facets.begin(), facets.end(), is_gone)) visit(slot, e, corridors[e]);
      }
    }
  }
  bool has_to_move(Cell c) const { return c.valid() && edit_.is_removed(c); }
  bool is_passable(Cell c) const { return c.valid() && !env_.map.marked(c); }
  /** The new cell of a point that was in `old`; none if no way leads there that meets no wall. Nearly always it is one
   * of those that come of `old`; else what the point was in, or a wall, has moved over it. */
  Cell find(const double* point, Cell old) {
    Cell found;
    edit_.for_each_heir(old, [&](size_t i) {
      if (contains(env_, edit_.cell(i), point)) found = edit_.cell(i);
      return !found.valid();
    });
    if (found.valid() || came_to_nothing_.contains(old)) return found;
    CellQueue around(scene_.memory);
    const auto add_heirs = [&](Cell c) {
      edit_.for_each_heir(c, [&](size_t i) {
        around.insert(edit_.cell(i));
        return true;
      });
    };
    CellQueue gone(scene_.memory);
    gone.insert(old);
    for (size_t i = 0; i < gone.size() && around.size() == 0; ++i) {
      add_heirs(gone[i]);
      for_each_beyond(gone[i], [&](Cell c) {  // where it came to nothing
        if (edit_.is_removed(c)) gone.insert(c);
      });
    }
    for (size_t i = 0; i < gone.size() && around.size() == 0; ++i) came_to_nothing_.insert(gone[i]);
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
  /** All that changes. */
  BoxGroups<D>& find_places() {
    if (scene_.body_slots.alive_count() == 0) return places_;
    const auto add = [&](Cell c) {
      Box<D> box;
      env_.map.for_each_vertex(c, [&](uint32_t vertex) { box.add(env_.point(vertex)); });
      places_.add(box);
    };
    for (const Cell c : edit_.removed()) add(c);
    for (size_t i = 0; i < edit_.cell_count(); ++i) add(edit_.cell(i));
    edit_.for_each_marked(add);
    for (size_t i = 0; i < edit_.link_count(); ++i) {
      Box<D> box;
      const HalfFacet h = edit_.link(i);
      const Cell c = env_.map.cell_of(h);
      for_each_facet_vertex<D>(env_.map.shape(c), env_.map.local_of(h, c),
                               [&](uint32_t local) { box.add(env_.point(c, local)); });
      places_.add(box);
    }
    return places_;
  }

  Edit<D>& edit_;
  const Environment<D>& env_;
  Scene<D>& scene_;
  BoxGroups<D> places_;
  NearBodies<D> near_;
  Array<Location> particles_{scene_.memory}, vertices_;
  Array<KeptCorridor> corridors_{scene_.memory};
  bool keeps_corridors_ = false;
  CellQueue new_cells_{scene_.memory};        // once they are asked for
  CellQueue came_to_nothing_{scene_.memory};  // cells that go, from which no way leads to one that comes
  uint64_t looked_at_ = 0;
};

template <int D>
bool follow(Edit<D>& edit, Scene<D>& scene, const Meanwhile* meanwhile) {
  Followers<D> followers(edit, scene);
  const auto is_occupied = [&] { return !scene.occupants.empty() || !scene.occupant_bodies.empty(); };
  followers.find_cells();
  if (is_occupied()) refuse(scene);
  followers.prepare(meanwhile != nullptr);
  edit.apply();
  followers.take_locations();
  const auto take_back = [&] {
    followers.leave_locations();
    edit.revert();
  };
  bool stays = true;
  try {
    if (scene.body_slots.alive_count() != 0) followers.find_blocked_bodies();
    if (is_occupied()) refuse(scene);
    followers.forget_corridors();
    if (meanwhile != nullptr) stays = meanwhile->run(meanwhile->user);
  } catch (...) {
    take_back();
    throw;
  }
  if (stays) {
    followers.finish();
    edit.finish();
  } else {
    take_back();
  }
  return stays;
}

}  // namespace

template <int D>
void carry_out(Edit<D>& edit, Scene<D>* scene) {
  clear_occupants(scene);
  edit.prepare();
  carry_out_prepared(edit, scene);
}

template <int D>
void carry_out_prepared(Edit<D>& edit, Scene<D>* scene) {
  if (scene != nullptr) {
    carry_out_prepared(edit, *scene, nullptr);
    return;
  }
  edit.apply();
  edit.finish();
}

template <int D>
bool carry_out_prepared(Edit<D>& edit, Scene<D>& scene, const Meanwhile* meanwhile) {
  clear_occupants(&scene);
  try {
    return follow(edit, scene, meanwhile);
  } catch (const std::bad_alloc&) {
    clear_occupants(&scene);
    throw;
  }
}

DSW_INSTANTIATE(carry_out);
template void carry_out_prepared(Edit<2>& edit, Scene<2>* scene);
template void carry_out_prepared(Edit<3>& edit, Scene<3>* scene);
template bool carry_out_prepared(Edit<2>& edit, Scene<2>& scene, const Meanwhile* meanwhile);
template bool carry_out_prepared(Edit<3>& edit, Scene<3>& scene, const Meanwhile* meanwhile);

}  // namespace dsw
