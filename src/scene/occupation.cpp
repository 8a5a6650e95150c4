// Bodies are tested after the marks have been set, so that one cast or sweep tells whether any of them is in the way;
// only what really changed is remembered, and taken back where it must not be. Without bodies nothing is remembered.

#include "scene/occupation.h"

#include <cstdio>

#include "base/dimensions.h"
#include "base/error.h"
#include "scene/distances.h"
#include "scene/near_bodies.h"
#include "sweep/body_probe.h"

namespace dsw {
namespace {

template <int D>
bool set_mark(Environment<D>& env, Cell c, bool marked) noexcept {
  return set_cell_mark(env, c, marked);
}
template <int D>
bool set_mark(Environment<D>& env, HalfFacet h, bool marked) noexcept {
  return set_facet_mark(env, h, marked);
}
template <int D>
bool set_mark(Environment<D>& env, Dart d, bool marked) noexcept {
  return set_edge_mark(env, dart_vertex(env.map, d), dart_target(env.map, d), marked);
}

Obstacle obstacle_of(Cell) { return Obstacle::kCells; }
Obstacle obstacle_of(HalfFacet) { return Obstacle::kFacets; }
Obstacle obstacle_of(Dart) { return Obstacle::kMarkedEdges; }

template <int D>
Box<D> box_of(const Environment<D>& env, Cell c) noexcept {
  Box<D> box;
  for (uint32_t i = 0, count = env.map.vertices_of(c); i < count; ++i) box.add(env.point(c, i));
  return box;
}
template <int D>
Box<D> box_of(const Environment<D>& env, HalfFacet h) noexcept {
  Box<D> box;
  const Cell c = env.map.cell_of(h);
  for_each_facet_vertex<D>(env.map.shape(c), env.map.local_of(h, c), [&](uint32_t i) { box.add(env.point(c, i)); });
  return box;
}
template <int D>
Box<D> box_of(const Environment<D>& env, Dart d) noexcept {
  Box<D> box;
  box.add(env.point(dart_vertex(env.map, d)));
  box.add(env.point(dart_target(env.map, d)));
  return box;
}

/** Marks that are gone again unless they are kept. */
template <int D, class Item>
class Trial {
 public:
  Trial(Environment<D>& env, const Scene<D>& scene)
      : env_(env), version_(env.obstacle_version), changed_(scene.memory), places_(scene.memory, scene.keeps_boxes()) {}
  ~Trial() {
    for (const Item item : changed_) set_mark(env_, item, false);
    if (!changed_.empty()) env_.give_back_version(version_);
  }
  Trial(const Trial&) = delete;
  Trial& operator=(const Trial&) = delete;

  void mark(Item item) {
    changed_.push_back(item);  // first, because it may throw
    if (set_mark(env_, item, true)) {
      places_.add(box_of(env_, item));
    } else {
      changed_.pop_back();
    }
  }
  void keep() noexcept { changed_.clear(); }
  bool empty() const noexcept { return changed_.empty(); }
  BoxGroups<D>& places() noexcept { return places_; }

 private:
  Environment<D>& env_;
  const uint64_t version_;
  Array<Item> changed_;
  BoxGroups<D> places_;
};

/** Takes the marks of occupied cells back: an occupied cell was passable before. Returns how many there were. */
template <int D>
size_t leave_out_particles(Environment<D>& env, const Scene<D>& scene) noexcept {
  size_t left_out = 0;
  for (const dsw_particle_id id : scene.occupants) {
    left_out += set_cell_mark(env, scene.particles[id.index].cell, false) ? 1u : 0u;
  }
  return left_out;
}

/** Marks the items that for_each(visit) visits; scene.occupants has the particles among them. Returns how many were
 * left out. */
template <class Item, int D, class ForEach>
size_t try_marks(Environment<D>& env, Scene<D>& scene, bool skip_occupied, ForEach for_each) {
  Trial<D, Item> trial(env, scene);
  for_each([&](Item item) { trial.mark(item); });
  if (trial.empty()) return 0;
  BodyProbe<D> probe(env, obstacle_of(Item{}));
  const NearBodies<D> near(scene, trial.places());
  find_occupant_bodies(scene, near, probe);
  const bool occupied = !scene.occupants.empty() || !scene.occupant_bodies.empty();
  if (occupied && !skip_occupied) refuse(scene);
  size_t left_out = leave_out_particles(env, scene);
  for (const dsw_body_id id : scene.occupant_bodies) {
    const Body<D>& body = scene.bodies[id.index].body;
    left_out += probe.leave_out(env, body, near.places_of(id.index)) + leave_out_near(env, body);
  }
  trial.keep();
  count_looked_at(scene, probe.looked_at);
  return left_out;
}

/** Sets marks; find_particles() fills scene->occupants, which is empty. */
template <class Item, int D, class FindParticles, class ForEach>
size_t set_marks(Environment<D>& env, Scene<D>* scene, bool marked, bool skip_occupied, FindParticles find_particles,
                 ForEach for_each) {
  const auto set_all = [&] { for_each([&](Item item) { set_mark(env, item, marked); }); };
  if (!marked || scene == nullptr) {
    set_all();
    return 0;
  }
  size_t left_out = 0, looked_at = 0;
  try {
    looked_at = find_particles();
    if (scene->body_slots.alive_count() != 0) {
      left_out = try_marks<Item>(env, *scene, skip_occupied, for_each);
    } else {
      if (!scene->occupants.empty() && !skip_occupied) refuse(*scene);
      set_all();
      left_out = leave_out_particles(env, *scene);
    }
  } catch (const std::bad_alloc&) {
    clear_occupants(scene);
    throw;
  }
  count_looked_at(*scene, looked_at);
  return left_out;
}

template <class Item>
auto each_of(const Item* items, size_t count) {
  return [=](auto visit) {
    for (size_t i = 0; i < count; ++i) visit(items[i]);
  };
}

constexpr auto kNoParticles = [] { return size_t{0}; };

}  // namespace

template <int D>
void refuse(const Scene<D>& scene) {
  const size_t particles = scene.occupants.size(), bodies = scene.occupant_bodies.size();
  if (particles == 0) {
    const dsw_body_id first = scene.occupant_bodies[0];
    fail(DSW_STATUS_OCCUPIED, "%zu bodies are in the way; the first is {index %u, generation %u}", bodies, first.index,
         first.generation);
  }
  char others[48] = "";
  if (bodies != 0) std::snprintf(others, sizeof others, "; so are %zu bodies", bodies);
  const dsw_particle_id first = scene.occupants[0];
  fail(DSW_STATUS_OCCUPIED, "%zu particles are in the way; the first is {index %u, generation %u} in volume %u%s",
       particles, first.index, first.generation, scene.env.map.index(scene.particles[first.index].cell), others);
}

template <int D>
void find_occupant_bodies(Scene<D>& scene, const NearBodies<D>& near, BodyProbe<D>& probe) {
  for (const typename NearBodies<D>::Near& each : near) {
    const Body<D>& body = scene.bodies[each.slot].body;
    if (probe.is_free(body, each.places) && keeps_distances(scene, body, each.places)) continue;
    scene.occupant_bodies.push_back({each.slot, scene.body_slots.generation(each.slot)});
  }
}

template <int D>
void count_looked_at(Scene<D>& scene, uint64_t count) noexcept {
  if (scene.features.statistics) scene.statistics.looked_at += count;
}

template <int D>
void clear_occupants(Scene<D>* scene) noexcept {
  if (scene == nullptr) return;
  scene->occupants.clear();
  scene->occupant_bodies.clear();
}

template <int D>
size_t mark_cells(Environment<D>& env, Scene<D>* scene, const Cell* cells, size_t count, bool marked,
                  bool skip_occupied) {
  const auto find = [&] { return find_occupants(*scene, cells, count); };
  return set_marks<Cell>(env, scene, marked, skip_occupied, find, each_of(cells, count));
}

template <int D>
void mark_facets(Environment<D>& env, Scene<D>* scene, const HalfFacet* facets, size_t count, bool marked) {
  set_marks<HalfFacet>(env, scene, marked, false, kNoParticles, each_of(facets, count));
}

template <int D>
void mark_edges(Environment<D>& env, Scene<D>* scene, const Dart* edges, size_t count, bool marked) {
  if (marked) reserve_edge_marks(env, count);
  set_marks<Dart>(env, scene, marked, false, kNoParticles, each_of(edges, count));
}

/** Thin bodies never meet a marked vertex; thick ones may be too near. */
template <int D>
void mark_vertices(Environment<D>& env, Scene<D>* scene, const uint32_t* vertices, size_t count, bool marked) {
  if (marked && count != 0) reserve_vertex_marks(env);
  const uint64_t version = env.obstacle_version;
  Array<uint32_t> changed{env.memory};
  changed.reserve(scene != nullptr && marked ? count : 0);
  for (size_t i = 0; i < count; ++i) {
    if (set_vertex_mark(env, vertices[i], marked) && scene != nullptr && marked) changed.push_back(vertices[i]);
  }
  if (changed.empty()) return;
  Array<Box<D>> boxes{env.memory};
  const auto take_back = [&] {
    for (const uint32_t v : changed) set_vertex_mark(env, v, false);
    env.give_back_version(version);
  };
  try {
    for (const uint32_t v : changed) {
      boxes.emplace_back();
      boxes.back().add(env.point(v));
    }
    for_each_body(*scene, [&](uint32_t slot, const BodyRecord<D>& of) {
      if (keeps_distances(*scene, of.body, {boxes.data(), boxes.size()})) return;
      scene->occupant_bodies.push_back({slot, scene->body_slots.generation(slot)});
    });
    if (!scene->occupant_bodies.empty()) refuse(*scene);
  } catch (const std::bad_alloc&) {
    take_back();
    clear_occupants(scene);
    throw;
  } catch (...) {
    take_back();
    throw;
  }
}

template <int D>
size_t mark_region(Environment<D>& env, Scene<D>* scene, int32_t region, bool marked, bool skip_occupied,
                   size_t* left_out) {
  size_t count = 0;
  const auto find = [&] { return find_occupants_of_region(*scene, region); };
  const auto for_each = [&](auto visit) {
    for_each_cell_of_region(env, region, [&](Cell c) {
      visit(c);
      ++count;
    });
  };
  *left_out = set_marks<Cell>(env, scene, marked, skip_occupied, find, for_each);
  return count;
}

template <int D>
size_t mark_between(Environment<D>& env, Scene<D>* scene, int32_t a, int32_t b, bool marked) {
  size_t count = 0;
  const auto for_each = [&](auto visit) {
    for_each_facet_between(env, a, b, [&](HalfFacet h) {
      visit(h);
      ++count;
    });
  };
  set_marks<HalfFacet>(env, scene, marked, false, kNoParticles, for_each);
  return count;
}

DSW_INSTANTIATE(refuse);
DSW_INSTANTIATE(find_occupant_bodies);
DSW_INSTANTIATE(count_looked_at);
DSW_INSTANTIATE(clear_occupants);
DSW_INSTANTIATE(mark_cells);
DSW_INSTANTIATE(mark_facets);
DSW_INSTANTIATE(mark_vertices);
DSW_INSTANTIATE(mark_region);
DSW_INSTANTIATE(mark_between);

template void mark_edges(Environment<3>&, Scene<3>*, const Dart*, size_t, bool);

}  // namespace dsw
