#pragma once
// A body on its way in one move: who goes from where to where. When each vertex goes is the business of a schedule.

#include "base/points.h"
#include "body/body.h"
#include "corridor/corridor.h"
#include "walk/packet.h"

namespace dsw {

/** The cells of a vertex on its way: small, since edges ask in no order. */
struct VertexWay {
  Cell from, arrival;  // `arrival` contains the end, or the vertex that stays; invalid: something is on the path
};

template <int D>
struct MovingBody {
  Body<D>* body = nullptr;
  PointArray targets;         // where the vertices are told to go, one for each slot
  Array<VertexWay> ways;      // by slot
  Array<PathFacets> crossed;  // by the paths of the vertices; empty unless they are noted

  explicit MovingBody(const Memory* memory) : ways(memory), crossed(memory) {}
  /** All vertices are where they start. Throws std::bad_alloc.
   * @param notes_paths whether the facets that paths pass are noted. */
  void start(Body<D>& moved, PointArray to, bool notes_paths) {
    body = &moved;
    targets = to;
    const size_t count = body->vertices.size();
    ways.resize(count);
    for (uint32_t v = 0; v < count; ++v) stay(v);
    crossed.assign(notes_paths ? count : 0, PathFacets{});
  }
  PathFacets crossed_by(uint32_t v) const { return crossed.empty() ? PathFacets{} : crossed[v]; }
  /** The way of a vertex ends where it is. */
  void stay(uint32_t v) { ways[v].from = ways[v].arrival = body->vertices[v].cell; }
  /** A vertex is put where its way ends. */
  void arrive(uint32_t v, const double* end) const { put_vertex(*body, v, end, ways[v].arrival); }
};

/** Casts paths of vertices side by side: finds the cells where they arrive, and the facets that they pass.
 * @param packet scratch.
 * @param max_volumes work limit of each cast; 0: none.
 * @param for_each calls what it is given with a moving body, its number, a vertex and where that goes, for each path.
 * @param met called with the number of the body, the vertex and the path where something is on the path. */
template <int D, class ForEach, class Met>
void cast_paths(const Environment<D>& env, Packet<D>& packet, CastCounters* counters, uint32_t max_volumes,
                ForEach for_each, Met met) {
  struct Name {
    MovingBody<D>* of;
    uint32_t number, vertex;
  };
  Name names[kPacket];
  packet.clear();
  const auto run = [&] {
    packet.run(env, counters);
    for (uint32_t i = 0; i < packet.count(); ++i) {
      MovingBody<D>& of = *names[i].of;
      const uint32_t v = names[i].vertex;
      const CastResult& path = packet.result(i);
      const bool is_reached = path.end == CastEnd::kReached;
      of.ways[v].arrival = is_reached ? path.cell : Cell{};
      if (!of.crossed.empty()) of.crossed[v] = path_facets(env.map, packet.request(i).start, path);
      if (!is_reached) met(names[i].number, v, path);
    }
    packet.clear();
  };
  for_each([&](MovingBody<D>& of, uint32_t number, uint32_t v, const double* to) {
    names[packet.count()] = {&of, number, v};
    packet.add(env, of.body->vertices[v].cell, of.body->position(v), to).max_volumes = max_volumes;
    if (packet.full()) run();
  });
  run();
}

}  // namespace dsw
