// A scene's particles and bodies with the ids of both, and the counters. What lasts for one call (crossings, occupants,
// edits of a move) is left out.

#include "snapshot/scene_snapshot.h"

#include <algorithm>
#include <type_traits>

#include "base/dimensions.h"
#include "proximity/thick_sweep.h"
#include "scene/live_register.h"
#include "scene/meeting.h"
#include "scene/near_bodies.h"
#include "snapshot/scene_image.h"

namespace dsw {
namespace {

constexpr BlockKind kKind = {
    "DSWSCN\x1a\n",
    kSceneFormat,
    kOldestSceneFormat,
    SceneImage::kSections,
    {SceneImage::kSectionsBefore[0], SceneImage::kSectionsBefore[1], SceneImage::kSectionsBefore[2]}};
/** What is written in a format. */
constexpr BlockKind kind_of(uint32_t format) {
  BlockKind kind = kKind;
  kind.sections = kind.sections_of(format);
  kind.version = format;
  return kind;
}
constexpr uint32_t kStatistics = 1, kCrossings = 2, kDeforming = 4, kContacts = 8, kLive = 16, kAllFeatures = 31;

constexpr size_t kCounters = 9, kExtents = 3;

void get_counters(const SceneStatistics& s, uint64_t* out) {
  const uint64_t values[kCounters] = {s.cast.casts,
                                      s.cast.volumes_visited,
                                      s.cast.orientation_tests,
                                      s.cast.exact_fallbacks,
                                      s.cast.ties,
                                      s.forecast_hits,
                                      s.contacts,
                                      s.candidates,
                                      s.looked_at};
  std::copy_n(values, kCounters, out);
}

SceneStatistics to_statistics(const uint64_t* n) { return {{n[0], n[1], n[2], n[3], n[4]}, n[5], n[6], n[7], n[8]}; }

/** What two environments of which one is not the other's copy hardly share. */
template <int D>
void get_extents(const Map<D>& map, uint64_t* out) {
  out[0] = map.cell_count;
  out[1] = map.index_count();
  out[2] = map.vertex_count;
}

template <int D>
SceneImage image_of(const Scene<D>& scene, const SceneContent& content) {
  SceneImage image(scene.memory);
  image.numbers.resize(kCounters + kExtents);
  get_counters(scene.statistics, image.numbers.data());
  get_extents(scene.env.map, image.numbers.data() + kCounters);
  image.particle_places.reserve(D * scene.particles.size());
  image.particles.reserve(2 * scene.particles.size());
  for (const ParticleState<D>& each : scene.particles) {
    image.particle_places.insert(image.particle_places.end(), each.position, each.position + D);
    image.particles.push_back(to_index(scene.env.map, each.cell));
    image.particles.push_back(each.forecast);
  }
  image.particle_slots = scene.slots.words();
  image.free_particles = scene.slots.free_slots();
  image.body_slots = scene.body_slots.words();
  image.free_bodies = scene.body_slots.free_slots();
  for (const BodyRecord<D>& each : scene.bodies) append(scene, each, content, image);
  return image;
}

template <int D>
BlockHeader header_of(const Scene<D>& scene, SceneImage& image) {
  BlockHeader h;
  h.flags = (scene.features.statistics ? kStatistics : 0) | (scene.features.crossings ? kCrossings : 0) |
            (scene.features.deforming ? kDeforming : 0) | (scene.features.contacts ? kContacts : 0) |
            (scene.features.live ? kLive : 0);
  uint64_t* bytes = h.bytes;
  image.for_each([&](const auto& array) { *bytes++ = array.size() * sizeof(array[0]); });
  return h;
}

void restore(SlotPool& slots, Array<uint32_t>& words, Array<uint32_t>& free) {
  if (!slots.restore(std::move(words), std::move(free))) fail_corrupt("generations");
  slots.reserve(0);  // releasing must not fail
}

template <int D>
void load_particles(Scene<D>& scene, SceneImage& image) {
  restore(scene.slots, image.particle_slots, image.free_particles);
  const size_t count = scene.slots.slot_count();
  if (image.particle_places.size() != D * count || image.particles.size() != 2 * count) fail_corrupt("particles: size");
  scene.particles.resize(count);
  if (scene.features.live) scene.live.get()->particles.reserve(count);
  for (uint32_t slot = 0; slot < count; ++slot) {
    ParticleState<D>& state = scene.particles[slot];
    const uint32_t cell = image.particles[2 * size_t{slot}];
    std::copy_n(&image.particle_places[D * size_t{slot}], D, state.position);
    state.cell = to_cell(scene.env.map, cell);
    state.forecast = image.particles[2 * size_t{slot} + 1];
    const bool alive = scene.slots.alive(slot, scene.slots.generation(slot));
    if (alive ? !can_be_at(scene.env, state.cell, state.position) : cell != kNoIndex) {
      fail_corrupt("a particle is not where it is said to be, or that was in another environment");
    }
    if (alive && state.forecast != kNoFacet && state.forecast >= scene.env.map.facets_of(state.cell)) {
      fail_corrupt("the face that a particle aims at");
    }
    note_particle(scene, slot);
  }
}

/** Gives loaded bodies what those of the scene keep, and lets them meet each other if they are apart. */
template <int D>
void join_bodies(Scene<D>& scene) {
  if (scene.keeps_boxes()) scene.body_boxes.reserve(scene.bodies.size());
  for_each_body(scene, [&](uint32_t slot, BodyRecord<D>& of) {
    const size_t partners = scene.features.contacts ? of.record.contacts.size() : 0;
    if (of.record.partners.size() != partners) fail_corrupt("the number of partners");
    prepare_body(scene, of);
    scene.leaving += of.body.skipping.leaves_back_edges ? 1 : 0;
    note_body(scene, slot);
  });
  ThickSweep<D> thick(scene.env);
  for_each_body(scene, [&](uint32_t, const BodyRecord<D>& of) {
    if (of.is_penetrating()) return;
    Partners<D> partners(scene.memory);
    if (scene.features.contacts) find_partners(scene, of.body, reach_of(of.body), partners);
    const auto stop = [](uint32_t, uint32_t) { return false; };
    if (!is_body_apart(partners, of.body, of.body.level, stop)) fail_corrupt("bodies touch");
    if (!thick.keep_at_rest(&partners, of.body)) fail_corrupt("a body is too near to something");
  });
}

template <int D>
void load_bodies(Scene<D>& scene, SceneImage& image, uint32_t format) {
  restore(scene.body_slots, image.body_slots, image.free_bodies);
  BodyReader<D> reader(scene.env, image, format);
  const size_t count = scene.body_slots.slot_count();
  if (count > image.bodies.size()) fail_corrupt("bodies: size");
  scene.bodies.reserve(count);
  for (uint32_t slot = 0; slot < count; ++slot) {
    scene.bodies.emplace_back(scene.memory);
    if (scene.body_slots.alive(slot, scene.body_slots.generation(slot))) {
      reader.read(scene.bodies.back());
    } else {
      reader.skip();
    }
  }
  reader.finish();
  join_bodies(scene);
}

}  // namespace

SceneImage::SceneImage(const Memory* memory) {
  for_each([memory](auto& array) {
    using Elements = std::decay_t<decltype(array)>;
    array = Elements(typename Elements::allocator_type(memory));
  });
}

template <int D>
size_t snapshot_bytes(const Scene<D>& scene, uint32_t format) {
  SceneImage image = image_of(scene, {format, true});
  return block_bytes(kind_of(format), header_of(scene, image));
}

namespace {

template <int D>
void write(const Scene<D>& scene, SceneImage& image, uint32_t format, uint8_t* out) {
  BlockWriter writer(kind_of(format), header_of(scene, image), D, out);
  image.for_each([&](const auto& array) {  // those that an older format lacks are empty
    writer.write(array);
    writer.end_section();
  });
  writer.finish();
}

}  // namespace

template <int D>
void save(const Scene<D>& scene, uint8_t* out, uint32_t format) {
  SceneImage image = image_of(scene, {format, true});
  write(scene, image, format, out);
}

template <int D>
uint64_t state_checksum(const Scene<D>& scene, uint32_t format) {
  SceneImage image = image_of(scene, {format, false});
  std::fill(image.numbers.begin(), image.numbers.begin() + kCounters, uint64_t{0});
  for (size_t i = 1; i < image.particles.size(); i += 2) image.particles[i] = 0;
  Array<uint8_t> block(block_bytes(kind_of(format), header_of(scene, image)), 0, scene.memory);
  write(scene, image, format, block.data());
  return checksum(0, block.data(), block.size());
}

template <int D>
SceneFeatures saved_features(const uint8_t* block, size_t size) {
  const BlockReader reader(kKind, D, block, size);
  const uint32_t flags = reader.header().flags;
  if (flags > kAllFeatures) fail_corrupt("it has unknown flags");
  SceneFeatures features;
  features.statistics = (flags & kStatistics) != 0;
  features.crossings = (flags & kCrossings) != 0;
  features.deforming = (flags & kDeforming) != 0;
  features.contacts = (flags & kContacts) != 0;
  features.live = (flags & kLive) != 0;
  return features;
}

template <int D>
void load(Scene<D>& scene, const uint8_t* block, size_t size) {
  BlockReader reader(kKind, D, block, size);
  if (reader.header().counts[0] != 0 || reader.header().counts[1] != 0) fail_corrupt("its header");
  SceneImage image(scene.memory);
  image.for_each([&](auto& array) { reader.read(array); });
  uint64_t extents[kExtents];
  get_extents(scene.env.map, extents);
  if (image.numbers.size() != kCounters + kExtents) fail_corrupt("numbers: size");
  if (!std::equal(extents, extents + kExtents, image.numbers.data() + kCounters)) {
    fail_corrupt("it was in another environment");
  }
  scene.statistics = to_statistics(image.numbers.data());
  load_particles(scene, image);
  load_bodies(scene, image, reader.version());
}

DSW_INSTANTIATE(snapshot_bytes);
DSW_INSTANTIATE(save);
DSW_INSTANTIATE(state_checksum);
DSW_INSTANTIATE(saved_features);
DSW_INSTANTIATE(load);

}  // namespace dsw
