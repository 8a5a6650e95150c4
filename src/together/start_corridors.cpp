#include "together/start_corridors.h"

namespace dsw {

template <int D>
void StartCorridors<D>::start(const Array<Trajectory<D>>& trajectories) {
  first_ranges_.clear();
  facets_.clear();
  packet_.clear();  // what a call left that ran out of memory
  cast_.clear();
  corridor_.facets.reserve(1);  // Corridor::forget() needs it
  size_t count = 0;
  for (const Trajectory<D>& of : trajectories) {
    const Body<D>& body = *of.motion.body;
    first_ranges_.push_back(count);
    if (covers_edges(body.level) && !body.keeps_corridors()) count += body.edges.size();
  }
  ranges_.assign(count, Range{});
}

template <int D>
Corridor<D>& StartCorridors<D>::find(const Trajectory<D>& of, uint32_t number, uint32_t edge) {
  const Range& range = ranges_[first_ranges_[number] + edge];
  if (range.is_known) {
    corridor_.replace(env_, 0, corridor_.facets.size(), facets_.data() + range.first, range.end - range.first);
    corridor_.portal.version = env_.obstacle_version;
  } else {
    corridor_.forget();
  }
  corridor_.kept_in = of.motion.body->call;  // nothing goes back to what it was before
  return corridor_;
}

/** An edge in one convex cell passes nothing. The others are cast side by side. */
template <int D>
void StartCorridors<D>::look_at(const Trajectory<D>& of, uint32_t number, const Array<uint32_t>& edges) {
  const Body<D>& body = *of.motion.body;
  if (edges.empty()) return;
  while (writers_.size() < kPacket) writers_.emplace_back(env_.memory);
  for (const uint32_t e : edges) {
    Range& range = ranges_[first_ranges_[number] + e];
    if (range.first <= range.end) continue;
    const uint32_t(&ends)[2] = body.edges[e].ends;
    const Cell from = body.vertices[ends[0]].cell, to = body.vertices[ends[1]].cell;
    range = {0, 0, from == to};
    if (from == to || !env_.map.convex(from) || !env_.map.convex(to)) continue;
    CastRequest& request = packet_.add(env_, from, of.start(ends[0]), of.start(ends[1]));
    request.end = to;
    writers_[cast_.size()].attach(env_, request);
    cast_.push_back(first_ranges_[number] + e);
    if (packet_.full()) run();
  }
  run();
}

template <int D>
void StartCorridors<D>::run() {
  packet_.run(env_, counters);
  for (uint32_t i = 0; i < cast_.size(); ++i) {
    if (packet_.reached(i) && writers_[i].had_room())
      note(ranges_[cast_[i]], writers_[i].passed().data(), writers_[i].passed().size());
  }
  packet_.clear();
  cast_.clear();
}

template <int D>
void StartCorridors<D>::note(Range& range, const uint32_t* facets, size_t count) {
  range.first = static_cast<uint32_t>(facets_.size());
  facets_.insert(facets_.end(), facets, facets + count);
  range.end = static_cast<uint32_t>(facets_.size());
  range.is_known = true;
}

template class StartCorridors<2>;
template class StartCorridors<3>;

}  // namespace dsw
