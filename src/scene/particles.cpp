// Creation and removal of particles, and what marking asks about them.

#include <algorithm>

#include "base/batch.h"
#include "base/dimensions.h"
#include "base/sort.h"
#include "environment/marking.h"
#include "locate/locate.h"
#include "query/locations.h"
#include "scene/live_register.h"
#include "scene/scene.h"

namespace dsw {
namespace {

/** Cells of new particles: on the spot for one, in borrowed memory for many. */
class CellScratch {
 public:
  CellScratch(const Memory* memory, size_t count) : many_(count > 1 ? count : 0, Cell{}, memory) {}
  Cell* data() { return many_.empty() ? &one_ : many_.data(); }

 private:
  Cell one_;
  Array<Cell> many_;
};

void set_offender(size_t* offender, size_t index) noexcept {
  if (offender != nullptr) *offender = index;
}

template <int D>
void check_arguments(const Scene<D>& scene, PointArray positions, size_t count, const dsw_volume_id* hints,
                     bool indexed, size_t* offender) {
  const size_t bad = find_non_finite(positions, count, D);
  if (bad != count) {
    set_offender(offender, bad);
    fail_non_finite(positions, bad, D, {indexed ? "positions" : "position", indexed});
  }
  for (size_t i = 0; hints != nullptr && i < count; ++i) {
    if (is_null(hints[i]) || is_alive(scene.env.map, hints[i])) continue;
    set_offender(offender, i);
    fail(DSW_STATUS_STALE_ID, "%s {index %u, generation %u} names no volume; there are %u",
         ElementName({indexed ? "hints" : "hint", indexed}, i).text, hints[i].index, hints[i].generation,
         scene.env.map.cell_count);
  }
}

template <int D>
void check_places(const Scene<D>& scene, PointArray positions, size_t count, const Cell* cells, bool indexed,
                  size_t* offender) {
  for (size_t i = 0; i < count; ++i) {
    if (cells[i].valid() && !is_closed(scene.env, cells[i])) continue;
    set_offender(offender, i);
    fail_not_free(scene.env, ElementName({indexed ? "positions" : "position", indexed}, i).text, positions[i],
                  cells[i]);
  }
}

/** Adds the particles in one cell to scene.occupants. */
template <int D>
void add_occupants(Scene<D>& scene, Cell cell) {
  scene.live.get()->particles.for_each(cell, [&](uint32_t slot) {
    scene.occupants.push_back({slot, scene.slots.generation(slot)});
  });
}

/** By slot, each once: a cell may have been named twice. Returns how many there are. */
template <int D>
size_t sort_occupants(Scene<D>& scene) {
  Array<dsw_particle_id>& all = scene.occupants;
  dsw::sort(all.begin(), all.end(), [](dsw_particle_id a, dsw_particle_id b) { return a.index < b.index; });
  const auto same = [](dsw_particle_id a, dsw_particle_id b) { return a.index == b.index; };
  all.erase(std::unique(all.begin(), all.end(), same), all.end());
  return all.size();
}

}  // namespace

template <int D>
void place_points(const Scene<D>& scene, PointArray positions, size_t count, const dsw_volume_id* hints, bool indexed,
                  Cell* cells, size_t* offender) {
  check_arguments(scene, positions, count, hints, indexed, offender);
  auto body = [&](size_t begin, size_t end) noexcept {
    Cell last;  // without hint a walk from the point before can be less work than to make a tree
    for (size_t i = begin; i < end; ++i) {
      const bool hinted = hints != nullptr && !is_null(hints[i]);
      const Cell hint = hinted                                      ? scene.env.map.cell(hints[i].index)
                        : scene.env.index.use() == TreeUse::kAtOnce ? Cell{}
                                                                    : last;
      cells[i] = locate(scene.env, positions[i], hint, nullptr).cell;
      if (cells[i].valid()) last = cells[i];
    }
  };
  share_out(scene.parallel, count, body);
  check_places(scene, positions, count, cells, indexed, offender);
}

template <int D>
void create_particles(Scene<D>& scene, PointArray positions, size_t count, const dsw_volume_id* hints, bool indexed,
                      dsw_particle_id* ids, size_t* offender) {
  CellScratch scratch(scene.memory, count);
  Cell* const cells = scratch.data();
  place_points(scene, positions, count, hints, indexed, cells, offender);
  scene.slots.reserve(count);
  reserve_more(scene.particles, count);
  if (scene.features.live) scene.live.get()->particles.reserve(scene.slots.slot_count() + count);
  for (size_t i = 0; i < count; ++i) {
    const SlotPool::Slot slot = scene.slots.acquire();
    if (slot.index == scene.particles.size()) scene.particles.emplace_back();
    ParticleState<D>& state = scene.particles[slot.index];
    std::copy(positions[i], positions[i] + D, state.position);
    state.cell = cells[i];
    state.forecast = kNoFacet;
    ids[i] = {slot.index, slot.generation};
    note_particle(scene, slot.index);
  }
}

template <int D>
void destroy_particle(Scene<D>& scene, uint32_t slot) noexcept {
  scene.slots.release(slot);
  scene.particles[slot].cell = Cell{};
  note_particle(scene, slot);
}

template <int D>
size_t find_occupants(Scene<D>& scene, const Cell* cells, size_t count) {
  scene.occupants.clear();
  if (count == 0 || scene.particles.empty()) return 0;
  if (scene.features.live) {
    for (size_t i = 0; i < count; ++i) add_occupants(scene, cells[i]);
    return sort_occupants(scene);
  }
  // Most particles are cleared by one bit each; the few left are looked up in a sorted list.
  constexpr uint32_t kBits = 4096;
  constexpr size_t kFew = 64;
  uint64_t seen[kBits / 64] = {};
  const auto bit_of = [](uint32_t unit) { return (unit * 0x9e3779b1u) >> 20; };
  uint32_t few[kFew];
  Array<uint32_t> many(count > kFew ? count : 0, 0u, scene.memory);
  uint32_t* const units = count > kFew ? many.data() : few;
  for (size_t i = 0; i < count; ++i) {
    units[i] = cells[i].unit;
    const uint32_t bit = bit_of(units[i]);
    seen[bit / 64] |= uint64_t{1} << (bit % 64);
  }
  dsw::sort(units, units + count);
  for (uint32_t slot = 0; slot < scene.particles.size(); ++slot) {
    const uint32_t unit = scene.particles[slot].cell.unit, bit = bit_of(unit);
    if (((seen[bit / 64] >> (bit % 64)) & 1u) == 0 || !std::binary_search(units, units + count, unit)) continue;
    scene.occupants.push_back({slot, scene.slots.generation(slot)});
  }
  return scene.particles.size();
}

template <int D>
size_t find_occupants_of_region(Scene<D>& scene, int32_t region) {
  scene.occupants.clear();
  if (scene.features.live) {
    for_each_cell_of_region(scene.env, region, [&](Cell c) { add_occupants(scene, c); });
    return sort_occupants(scene);
  }
  for (uint32_t slot = 0; slot < scene.particles.size(); ++slot) {
    const Cell c = scene.particles[slot].cell;
    if (c.valid() && scene.env.region(c) == region) scene.occupants.push_back({slot, scene.slots.generation(slot)});
  }
  return scene.particles.size();
}

DSW_INSTANTIATE(place_points);
DSW_INSTANTIATE(create_particles);
DSW_INSTANTIATE(destroy_particle);
DSW_INSTANTIATE(find_occupants);
DSW_INSTANTIATE(find_occupants_of_region);

}  // namespace dsw
