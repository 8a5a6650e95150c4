#include "scene/meeting.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/dimensions.h"
#include "base/disjoint_sets.h"
#include "base/search.h"
#include "base/sort.h"
#include "scene/scene.h"

namespace dsw {
namespace {

constexpr double kRoom = 0x1p-20;  // beside a box, as a share of it

template <int D>
Box<D> with_room(const Box<D>& box) noexcept {
  Box<D> wide = box;
  for (int k = 0; k < D; ++k) {
    const double room = kRoom * (box.upper[k] - box.lower[k]);
    wide.lower[k] -= room;
    wide.upper[k] += room;
  }
  return wide;
}

template <int D>
Partner<D> name(const Scene<D>& scene, uint32_t slot) {
  return {&scene.bodies[slot].body, slot, scene.body_slots.generation(slot)};
}

template <int D>
uint32_t slot_of(const Scene<D>& scene, const BodyRecord<D>& record) {
  return static_cast<uint32_t>(&record - scene.bodies.data());
}

/** Finds partners among the bodies in slots for which counts(slot). */
template <int D, class Counts>
void find_partners(const Scene<D>& scene, const Body<D>& body, const Box<D>& reach, Counts counts,
                   Partners<D>& partners) {
  partners.clear();
  partners.reach = reach;
  scene.body_boxes.visit(widened(reach, body.radius), [&](uint32_t slot) {
    if (!counts(slot)) return true;
    const Body<D>& other = scene.bodies[slot].body;
    if (&other == &body ? !body.filter.self : !body.filter.sees(other.filter)) return true;
    partners.add(name(scene, slot));
    if (&other != &body) fresh_boxes(other);  // several threads may read it then
    return true;
  });
}

}  // namespace

template <int D>
void note_body(Scene<D>& scene, uint32_t slot) noexcept {
  const Body<D>& body = scene.bodies[slot].body;
  if (scene.keeps_boxes() && !scene.bodies[slot].is_penetrating())
    scene.body_boxes.put(slot, widened(body.boxes[0].bounds, body.radius));
}

template <int D>
void refresh_body(Scene<D>& scene, BodyRecord<D>& of) noexcept {
  if (!scene.keeps_boxes()) return;
  tighten_bounds(of.body);
  note_body(scene, slot_of(scene, of));
}

template <int D>
Box<D> reach_of(const Body<D>& body) noexcept {
  return with_room(body.boxes[0].bounds);
}

template <int D>
Box<D> reach_of(const Body<D>& body, PointArray targets, MoveOrder order, bool slides) noexcept {
  Box<D> box = body.boxes[0].bounds;
  const size_t count = order.vertices != nullptr ? order.count : body.vertices.size();
  for (size_t i = 0; i < count; ++i) {
    const uint32_t v = order.vertices != nullptr ? order.vertices[i] : static_cast<uint32_t>(i);
    if (!body.has_vertex(v)) continue;
    box.add(targets[v]);
    if (!slides) continue;
    // One that slides gets no farther from its target, but for stand-offs.
    double way = 0;
    for (int k = 0; k < D; ++k) way = std::max(way, std::fabs(targets[v][k] - body.position(v)[k]));
    double low[D], high[D];
    for (int k = 0; k < D; ++k) {
      low[k] = targets[v][k] - 2 * way;
      high[k] = targets[v][k] + 2 * way;
    }
    box.add(low);
    box.add(high);
  }
  return with_room(box);
}

template <int D>
void find_partners(const Scene<D>& scene, const Body<D>& body, const Box<D>& reach, Partners<D>& partners) {
  find_partners(
      scene, body, reach, [](uint32_t) { return true; }, partners);
}

template <int D>
void find_partners_at_rest(const Scene<D>& scene, const Body<D>& body, double limit, Partners<D>& partners) {
  find_partners(scene, body, widened(reach_of(body), limit), partners);
  const auto is_itself = [&](const Partner<D>& each) { return each.body == &body; };
  const bool is_listed = dsw::any_of(partners.all.begin(), partners.all.end(), is_itself);
  if (body.filter.self && !is_listed) partners.add({&body, kNone, 0});
}

template <int D>
void check_apart(Scene<D>& scene, const Body<D>& body, SweepLevel level) {
  if (!scene.features.contacts) return;
  Partners<D> partners(scene.memory);
  find_partners_at_rest(scene, body, 0, partners);
  is_body_apart(partners, body, level, [&](uint32_t a, uint32_t b) {
    scene.offending.push_back(a);
    scene.offending.push_back(b);
    return true;
  });
  if (scene.offending.empty()) return;
  fail(DSW_STATUS_OCCUPIED,
       "%zu vertices, edges or faces touch other parts of bodies; the first has vertices %u and %u",
       scene.offending.size() / 2, scene.offending[0], scene.offending[1]);
}

template <int D>
void find_islands(const Scene<D>& scene, BodyRecord<D>* const* moving, size_t count, PointArray targets,
                  const size_t* first_target, bool slides, Islands<D>& islands) {
  Array<Box<D>> reaches(scene.memory);
  for (size_t i = 0; scene.features.contacts && i < count; ++i) {
    const PointArray own{targets.data + first_target[i] * targets.step, targets.step};
    reaches.push_back(reach_of(moving[i]->body, own, {}, slides));
  }
  find_islands(scene, moving, count, reaches.data(), islands);
}

template <int D>
void find_islands(const Scene<D>& scene, BodyRecord<D>* const* moving, size_t count, const Box<D>* ways,
                  Islands<D>& islands) {
  DisjointSets sets(static_cast<uint32_t>(count), scene.memory);
  if (scene.features.contacts) {
    BoxGrid<D> reaches(scene.memory);
    reaches.reserve(count);
    Array<bool> moves(scene.bodies.size(), false, scene.memory);
    islands.partners.assign(count, Partners<D>(scene.memory));
    for (uint32_t i = 0; i < count; ++i) {
      islands.partners[i].reach = ways[i];
      reaches.put(i, widened(islands.partners[i].reach, moving[i]->body.radius));
      moves[slot_of(scene, *moving[i])] = true;
    }
    for (uint32_t i = 0; i < count; ++i) {
      Partners<D>& partners = islands.partners[i];
      const ContactFilter& filter = moving[i]->body.filter;
      find_partners(
          scene, moving[i]->body, partners.reach, [&](uint32_t slot) { return !moves[slot]; }, partners);
      reaches.visit(widened(partners.reach, moving[i]->body.radius), [&](uint32_t j) {
        if (i == j ? !filter.self : !filter.sees(moving[j]->body.filter)) return true;
        partners.add(name(scene, slot_of(scene, *moving[j])));
        sets.join(i, j);
        return true;
      });
    }
  }
  islands.bodies.resize(count);
  std::iota(islands.bodies.begin(), islands.bodies.end(), 0u);
  dsw::sort(islands.bodies.begin(), islands.bodies.end(), [&](uint32_t i, uint32_t j) {
    const uint32_t a = sets.root(i), b = sets.root(j);
    return a != b ? a < b : i < j;
  });
  for (uint32_t k = 0; k < count; ++k) {
    if (sets.root(islands.bodies[k]) == islands.bodies[k]) islands.first.push_back(k);
  }
  islands.first.push_back(static_cast<uint32_t>(count));
}

DSW_INSTANTIATE(note_body);
DSW_INSTANTIATE(refresh_body);
template Box<2> reach_of(const Body<2>& body, PointArray targets, MoveOrder order, bool slides) noexcept;
template Box<3> reach_of(const Body<3>& body, PointArray targets, MoveOrder order, bool slides) noexcept;
template Box<2> reach_of(const Body<2>& body) noexcept;
template Box<3> reach_of(const Body<3>& body) noexcept;
DSW_INSTANTIATE(find_partners);
DSW_INSTANTIATE(find_partners_at_rest);
DSW_INSTANTIATE(check_apart);
template void find_islands(const Scene<2>&, BodyRecord<2>* const*, size_t, PointArray, const size_t*, bool,
                           Islands<2>&);
template void find_islands(const Scene<3>&, BodyRecord<3>* const*, size_t, PointArray, const size_t*, bool,
                           Islands<3>&);
template void find_islands(const Scene<2>&, BodyRecord<2>* const*, size_t, const Box<2>*, Islands<2>&);
template void find_islands(const Scene<3>&, BodyRecord<3>* const*, size_t, const Box<3>*, Islands<3>&);

}  // namespace dsw
