#include "proximity/near_list.h"

#include <algorithm>
#include <utility>

#include "base/sort.h"
#include "body/body.h"

namespace dsw {
namespace {

/** A vertex next to another one, and the third one of a triangle of both; in the plane, and of an edge, kNone. */
using Spoke = std::pair<uint32_t, uint32_t>;

/** Whether triangles at a vertex make one ring, or an open one. `spokes` sorted, each once. */
bool is_ring(const Spoke* spokes, const Spoke* end, bool may_be_open) noexcept {
  const auto at = [&](uint32_t vertex) { return std::lower_bound(spokes, end, Spoke(vertex, 0)); };
  const auto is_last = [&](const Spoke* s) { return s + 1 == end || s[1].first != s->first; };
  const Spoke* start = spokes;
  for (const Spoke* s = spokes; may_be_open && s != end; ++s) {
    if (is_last(s) && (s == spokes || s[-1].first != s->first)) start = s;
  }
  ptrdiff_t seen = 0;
  for (uint32_t now = start->first, before = kNone;;) {
    const Spoke* const s = at(now);
    const bool is_end = is_last(s);
    if (!is_end && !is_last(s + 1)) return false;
    seen += is_end ? 1 : 2;
    const uint32_t next = s->second != before || is_end ? s->second : s[1].second;
    if (next == kNone || (is_end && !may_be_open)) return false;
    if (next == start->first || (is_end && before != kNone)) return seen == end - spokes;
    before = std::exchange(now, next);
  }
}

}  // namespace

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
  known_.clear();
  known_at_.clear();
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
  Spoke few[32];
  Array<Spoke> many(around_.get_allocator());
  Spoke* others = few;
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
  // A triangle is listed from both sides or from one. If all of a ring are listed from both, each fan has all of them.
  const size_t listed = count;
  bool is_twice = listed % 2 == 0;
  for (size_t i = 0; is_twice && i < listed; i += 2) is_twice = others[i] == others[i + 1];
  count = static_cast<size_t>(std::unique(others, others + count) - others);
  is_twice = is_twice && 2 * count == listed;
  const WallFeature& any = obstacles_[at_[first_at_[vertex]]];
  const bool is_of_body = !any.facet.valid() && !any.cell.valid(), is_even = is_of_body || is_twice || count == listed;
  const bool is_plain =
      is_of_body || count == 0 || (is_even && (D == 2 ? count <= 2 : is_ring(others, others + count, is_twice)));
  for (size_t i = 0; i < count; ++i) {
    if (i == 0 || others[i].first != others[i - 1].first) around_.push_back(others[i].first);
  }
  features_.push_back({{vertex, kNone, kNone}, 1, first, static_cast<uint32_t>(around_.size()), !is_plain});
  for (size_t i = 0, end = 0; i < count; i = end) {
    const uint32_t other = others[i].first;
    for (end = i; end < count && others[end].first == other;) ++end;
    if (other < vertex) continue;
    const auto begin = static_cast<uint32_t>(around_.size());
    for (size_t k = i; k < end && others[k].second != kNone; ++k) around_.push_back(others[k].second);
    const bool has_fans = !is_even || (!is_of_body && end - i > 2);
    edges_.push_back({{vertex, other, kNone}, 2, begin, static_cast<uint32_t>(around_.size()), has_fans});
    for (size_t k = i; k < end && others[k].second != kNone; ++k) {
      if (others[k].second > other) triangles_.push_back({{vertex, other, others[k].second}, 3, begin, begin, false});
    }
  }
}

template class NearList<2>;
template class NearList<3>;

}  // namespace dsw
