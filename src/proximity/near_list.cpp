#include "proximity/near_list.h"

#include <algorithm>

namespace dsw {

template <int D>
void NearList<D>::clear() noexcept {
  obstacles_.clear();
  vertices_.clear();
  points_.clear();
  features_.clear();
  around_.clear();
}

template <int D>
void NearList<D>::finish(PointArray points) {
  for (const NearObstacle<D>& o : obstacles_) vertices_.insert(vertices_.end(), o.vertices, o.vertices + o.count);
  std::sort(vertices_.begin(), vertices_.end());
  vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
  for (const uint32_t v : vertices_) points_.insert(points_.end(), points[v], points[v] + D);
  // The obstacles at each vertex, one after the other.
  Array<uint32_t> ends(vertices_.size() + 1, 0, points_.get_allocator()), at(points_.get_allocator());
  for (NearObstacle<D>& o : obstacles_) {
    for (uint32_t i = 0; i < o.count; ++i) {
      o.vertices[i] = static_cast<uint32_t>(std::lower_bound(vertices_.begin(), vertices_.end(), o.vertices[i]) -
                                            vertices_.begin());
      ++ends[o.vertices[i] + 1];
    }
  }
  for (size_t v = 1; v < ends.size(); ++v) ends[v] += ends[v - 1];
  at.resize(ends.back());
  for (uint32_t o = 0; o < obstacles_.size(); ++o) {
    for (uint32_t i = 0; i < obstacles_[o].count; ++i) at[ends[obstacles_[o].vertices[i]]++] = o;
  }
  for (uint32_t v = 0; v < vertices_.size(); ++v) {
    add_features_at(v, at.data() + (v == 0 ? 0 : ends[v - 1]), at.data() + ends[v]);
  }
}

/** Adds one of the vertices that stand from `first` on, unless it does already. */
template <int D>
void NearList<D>::add_around(uint32_t first, uint32_t vertex) {
  if (std::find(around_.begin() + first, around_.end(), vertex) == around_.end()) around_.push_back(vertex);
}

/** A vertex, and the edges and triangles of which it is the lowest corner. */
template <int D>
void NearList<D>::add_features_at(uint32_t vertex, const uint32_t* obstacles, const uint32_t* end) {
  const auto begin_feature = [&] { return static_cast<uint32_t>(around_.size()); };
  const uint32_t neighbours = begin_feature();
  for (const uint32_t* o = obstacles; o != end; ++o) {
    for (uint32_t i = 0; i < obstacles_[*o].count; ++i) {
      const uint32_t other = obstacles_[*o].vertices[i];
      if (other != vertex) add_around(neighbours, other);
    }
  }
  const uint32_t neighbours_end = begin_feature();
  features_.push_back({{vertex, 0, 0}, 1, neighbours, neighbours_end, *obstacles});
  for (uint32_t n = neighbours; n < neighbours_end; ++n) {
    const uint32_t other = around_[n];
    if (other < vertex) continue;
    NearFeature edge{{vertex, other, 0}, 2, begin_feature(), 0, 0};
    bool is_first = true;
    for (const uint32_t* o = obstacles; o != end; ++o) {
      const NearObstacle<D>& obstacle = obstacles_[*o];
      if (!has_all(obstacle, edge)) continue;
      if (is_first) edge.obstacle = *o;
      is_first = false;
      for (uint32_t i = 0; i < obstacle.count; ++i) {
        const uint32_t third = obstacle.vertices[i];
        if (third != vertex && third != other) add_around(edge.around, third);
      }
    }
    edge.around_end = begin_feature();
    features_.push_back(edge);
    for (uint32_t k = edge.around; D == 3 && k < edge.around_end; ++k) {
      if (around_[k] < other) continue;
      NearFeature triangle{{vertex, other, around_[k]}, 3, 0, 0, 0};
      for (const uint32_t* o = obstacles; o != end && !has_all(obstacles_[triangle.obstacle = *o], triangle);) ++o;
      features_.push_back(triangle);
    }
  }
}

template class NearList<2>;
template class NearList<3>;

}  // namespace dsw
