// A box is looked for among all bodies at once, so that scattered boxes cost no more than what is near each.

#include "scene/near_bodies.h"

#include <algorithm>

#include "base/sort.h"

namespace dsw {
namespace {

/** Whether looking at all bodies takes less than looking for each of so many boxes. O(count). */
template <int D>
bool has_fewer_parts(const Scene<D>& scene, size_t count) {
  if (scene.bodies.size() >= count) return false;
  size_t parts = 0;
  for_each_body(scene, [&](uint32_t, const BodyRecord<D>& of) {
    const Body<D>& body = of.body;
    parts += body.vertices.size() + body.edges.size() + body.faces.size();
  });
  return parts < count;
}

}  // namespace

template <int D>
NearBodies<D>::NearBodies(const Scene<D>& scene, BoxGroups<D>& places) : boxes_(scene.memory), bodies_(scene.memory) {
  if (!scene.keeps_boxes()) {
    boxes_.assign(places.boxes().begin(), places.boxes().end());
    for_each_body(scene, [&](uint32_t slot, const BodyRecord<D>&) {
      bodies_.push_back({slot, {boxes_.data(), boxes_.size()}});
    });
    return;
  }
  if (has_fewer_parts(scene, places.boxes().size())) places.join();
  struct Pair {
    uint32_t slot, box;
    bool operator<(const Pair& o) const { return slot != o.slot ? slot < o.slot : box < o.box; }
  };
  Array<Pair> pairs{scene.memory};
  for (uint32_t i = 0; i < places.boxes().size(); ++i) {
    scene.body_boxes.visit(places.boxes()[i], [&](uint32_t slot) {
      pairs.push_back({slot, i});
      return true;
    });
  }
  dsw::sort(pairs.begin(), pairs.end());
  boxes_.reserve(pairs.size());
  for (const Pair& pair : pairs) {
    boxes_.push_back(places.boxes()[pair.box]);
    if (bodies_.empty() || bodies_.back().slot != pair.slot) bodies_.push_back({pair.slot, {&boxes_.back(), 0}});
    ++bodies_.back().places.count;
  }
}

template <int D>
const Places<D>& NearBodies<D>::places_of(uint32_t slot) const {
  const auto before = [](const Near& near, uint32_t wanted) { return near.slot < wanted; };
  return std::lower_bound(bodies_.begin(), bodies_.end(), slot, before)->places;
}

template class NearBodies<2>;
template class NearBodies<3>;

}  // namespace dsw
