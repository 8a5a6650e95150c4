#include "proximity/near_list.h"

#include <algorithm>
#include <utility>

#include "base/sort.h"
#include "body/body.h"

namespace dsw {

template <int D>
void NearList<D>::clear() noexcept {
  obstacles_.clear();
  vertices_.clear();
  first_at_.clear();
  at_.clear();
  points_.clear();
  features_.clear();
  edges_.clear();
  triangles_.clear();
  around_.clear();
  spheres_.clear();
}

template <int D>
Sphere<D> NearList<D>::sphere_round(const uint32_t* vertices, uint32_t count) const noexcept {
  const double* corners[3];
  for (uint32_t i = 0; i < count; ++i) corners[i] = point(vertices[i]);
  return {corners, count};
}

template <int D>
void NearList<D>::finish(PointArray points, bool has_features) {
  if (empty()) return;
  number_vertices(points);
  if (!has_features) {
    for (const WallFeature& o : obstacles_) spheres_.push_back(sphere_round(o.vertices, o.count));
    return;
  }
  for (uint32_t v = 0; v < vertex_count(); ++v) add_features_at(v);
  for (Array<NearFeature>* more : {&edges_, &triangles_}) {
    features_.insert(features_.end(), more->begin(), more->end());
    more->clear();
  }
  for (const NearFeature& f : features_) spheres_.push_back(sphere_round(f.corners, f.count));
}

template <int D>
void NearList<D>::number_vertices(PointArray points) {
  for (const WallFeature& o : obstacles_) vertices_.insert(vertices_.end(), o.vertices, o.vertices + o.count);
  dsw::sort(vertices_.begin(), vertices_.end());
  vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
  for (const uint32_t v : vertices_) points_.insert(points_.end(), points[v], points[v] + D);
  // Obstacles are counted at each vertex, and then put in their places from behind.
  first_at_.assign(vertices_.size() + 1, 0);
  for (WallFeature& o : obstacles_) {
    for (uint32_t i = 0; i < o.count; ++i) {
      const auto at = std::lower_bound(vertices_.begin(), vertices_.end(), o.vertices[i]);
      o.vertices[i] = static_cast<uint32_t>(at - vertices_.begin());
      ++first_at_[o.vertices[i]];
    }
  }
  for (size_t v = 1; v < first_at_.size(); ++v) first_at_[v] += first_at_[v - 1];
  at_.resize(first_at_.back());
  for (auto o = static_cast<uint32_t>(obstacles_.size()); o-- > 0;) {
    for (uint32_t i = 0; i < obstacles_[o].count; ++i) at_[--first_at_[obstacles_[o].vertices[i]]] = o;
  }
}

/** A vertex, and the edges and triangles of which it is the lowest corner. */
template <int D>
void NearList<D>::add_features_at(uint32_t vertex) {
  // Each obstacle at the vertex gives its other vertices, each with the third one, if there is one.
  const auto first = static_cast<uint32_t>(around_.size());
  std::pair<uint32_t, uint32_t> few[32];
  Array<std::pair<uint32_t, uint32_t>> many(around_.get_allocator());
  std::pair<uint32_t, uint32_t>* others = few;
  size_t count = 0;
  const size_t most = size_t{2} * (first_at_[vertex + 1] - first_at_[vertex]);
  if (most > std::size(few)) {
    many.resize(most);
    others = many.data();
  }
  for (uint32_t i = first_at_[vertex]; i < first_at_[vertex + 1]; ++i) {
    const WallFeature& o = obstacles_[at_[i]];
    for (uint32_t k = 0; k < o.count; ++k) {
      if (o.vertices[k] == vertex) continue;
      uint32_t third = kNone;
      for (uint32_t l = 0; l < o.count; ++l) {
        if (o.vertices[l] != vertex && l != k) third = o.vertices[l];
      }
      others[count++] = {o.vertices[k], third};
    }
  }
  dsw::sort(others, others + count);
  count = static_cast<size_t>(std::unique(others, others + count) - others);
  for (size_t i = 0; i < count; ++i) {
    if (i == 0 || others[i].first != others[i - 1].first) around_.push_back(others[i].first);
  }
  features_.push_back({{vertex, kNone, kNone}, 1, first, static_cast<uint32_t>(around_.size())});
  for (size_t i = 0, end = 0; i < count; i = end) {
    const uint32_t other = others[i].first;
    for (end = i; end < count && others[end].first == other;) ++end;
    if (other < vertex) continue;
    const auto begin = static_cast<uint32_t>(around_.size());
    for (size_t k = i; k < end && others[k].second != kNone; ++k) around_.push_back(others[k].second);
    edges_.push_back({{vertex, other, kNone}, 2, begin, static_cast<uint32_t>(around_.size())});
    for (size_t k = i; k < end && others[k].second != kNone; ++k) {
      if (others[k].second > other) triangles_.push_back({{vertex, other, others[k].second}, 3, begin, begin});
    }
  }
}

template class NearList<2>;
template class NearList<3>;

}  // namespace dsw
