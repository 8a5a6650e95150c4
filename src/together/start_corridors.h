#pragma once
// The cells that edges cross where they start, of bodies that keep no corridors: found once in a call, many edges at a time.

#include "corridor/corridor.h"
#include "together/trajectory.h"
#include "walk/packet.h"

namespace dsw {

/** Keeps its memory from call to call. Throws std::bad_alloc. */
template <int D>
class StartCorridors {
 public:
  explicit StartCorridors(const Environment<D>& env) : env_(env), corridor_(env.memory) {}

  /** Forgets what was found for another call. */
  void start(const Array<Trajectory<D>>& trajectories);
  /** Finds the corridors of edges of trajectory `number`, unless that was done in this call. */
  void look_at(const Trajectory<D>& of, uint32_t number, const Array<uint32_t>& edges);
  /** What is known of the corridor of an edge that was looked at. The next one takes its place. */
  Corridor<D>& find(const Trajectory<D>& of, uint32_t number, uint32_t edge);

  CastCounters* counters = nullptr;

 private:
  /** Facets of an edge. first > end: nobody has looked. */
  struct Range {
    uint32_t first = 1, end = 0;
    bool is_known = false;
  };
  void run();
  void note(Range& range, const uint32_t* facets, size_t count);

  const Environment<D>& env_;
  Corridor<D> corridor_;
  Array<size_t> first_ranges_{env_.memory};  // by trajectory
  Array<Range> ranges_{env_.memory};         // by edge
  Array<uint32_t> facets_{env_.memory};
  Packet<D> packet_;
  Array<CorridorWriter<D>> writers_{env_.memory};  // by place in the packet
  Array<size_t> cast_{env_.memory};                // edges there, as in ranges_
};

}  // namespace dsw
