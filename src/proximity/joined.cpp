#include "proximity/joined.h"

namespace dsw {

template <int D>
void Joined<D>::shorten(uint32_t vertex, double length) {
  if (!(length < ways_[vertex])) return;
  reached_.push_back(vertex);
  ways_[vertex] = length;
}

template <int D>
void Joined<D>::find(const Body<D>& body, const WayAlong* from, uint32_t count) {
  for (const uint32_t v : reached_) ways_[v] = Box<D>::kInfinity;
  reached_.clear();
  ways_.resize(body.vertices.size(), Box<D>::kInfinity);
  const double most = kJoinedRadii * body.radius;
  for (uint32_t i = 0; i < count; ++i) {
    if (from[i].length <= most) shorten(from[i].vertex, from[i].length);
  }
  if (body.lengths.empty()) return;
  for (size_t i = 0; i < reached_.size(); ++i) {
    const uint32_t v = reached_[i];
    for_each_edge(body, v, [&](uint32_t e) {
      const double way = ways_[v] + body.lengths[e];
      if (way <= most) shorten(body.edges[e].other(v), way);
      return true;
    });
  }
}

template class Joined<2>;
template class Joined<3>;

}  // namespace dsw
