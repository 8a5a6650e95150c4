#include "scene/untested.h"

#include "base/dimensions.h"
#include "walk/packet.h"

namespace dsw {
namespace {

constexpr uint8_t kFoundFree = 2;  // an edge that leaves the list, unless the call fails

/** Calls visit(edge, free) for each edge that was left. */
template <int D, class Visit>
void test_untested(const Environment<D>& env, const Body<D>& body, Visit visit) noexcept {
  Packet<D> packet;
  uint32_t edges[kPacket];
  const auto run = [&] {
    packet.run(env, nullptr);
    for (uint32_t i = 0; i < packet.count(); ++i) visit(edges[i], packet.reached(i));
    packet.clear();
  };
  for (uint32_t e = 0; e < body.untested.size(); ++e) {
    if (body.untested[e] == 0 || !body.has_edge(e)) continue;
    const BodyVertex<D>&a = body.vertices[body.edges[e].ends[0]], &b = body.vertices[body.edges[e].ends[1]];
    edges[packet.count()] = e;
    packet.add(env, a.cell, a.position, b.position).end = b.cell;
    if (packet.full()) run();
  }
  run();
}

}  // namespace

template <int D>
void hide_blocked_edges(Scene<D>& scene, bool settles) noexcept {
  for (BodyRecord<D>& of : scene.bodies) {
    Body<D>& body = of.body;
    if (!body.skipping.leaves_back_edges || body.level != SweepLevel::kEdges) continue;
    bool is_free = true;
    test_untested(scene.env, body, [&](uint32_t e, bool free) {
      is_free = is_free && free;
      if (settles && free) body.untested[e] = kFoundFree;
    });
    if (is_free) continue;
    body.level = SweepLevel::kPoints;
    body.hides_edges = true;
  }
}

template <int D>
void show_edges(Scene<D>& scene, bool changed) noexcept {
  for (BodyRecord<D>& of : scene.bodies) {
    Body<D>& body = of.body;
    for (uint8_t& each : body.untested) {
      if (each == kFoundFree) each = changed ? 0 : 1;
    }
    if (!body.hides_edges) continue;
    body.level = SweepLevel::kEdges;
    body.hides_edges = false;
    for (uint32_t e = 0; changed && e < body.untested.size(); ++e) body.untested[e] = body.has_edge(e) ? 1 : 0;
  }
}

DSW_INSTANTIATE(hide_blocked_edges);
DSW_INSTANTIATE(show_edges);

}  // namespace dsw
