// A cell of which some points are held and others go on can turn over. Then all of its points go the same part of their ways,
// the smallest that one of them goes: the cell stays valid there, since it does on the whole way. Only rounding can spoil
// that. Then the part is halved.

#include "together/held_points.h"

#include <algorithm>

#include "base/search.h"
#include "environment/validity.h"
#include "motion/place_on_way.h"

namespace dsw {

template <int D>
void HeldPoints<D>::start_round(const CellQueue& cells) {
  knows_new_ = true;
  if (!points_.empty()) {
    for (Point& each : points_) each.is_new = false;
    return;
  }
  way_->keep_targets();
  include(cells);
}

template <int D>
void HeldPoints<D>::include(const CellQueue& cells) {
  Array<uint32_t> vertices(env_.memory);
  for (size_t i = 0; i < cells.size(); ++i) {
    env_.map.for_each_vertex(cells[i], [&](uint32_t v) { vertices.push_back(v); });
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  Array<Point> before(env_.memory);
  before.swap(points_);
  points_.reserve(vertices.size());
  size_t at = 0;  // of the points before, all of which are among the vertices
  for (const uint32_t v : vertices) {
    if (at < before.size() && before[at].vertex == v) {
      points_.push_back(before[at++]);
      continue;
    }
    Point& made = points_.emplace_back(Point{v, false, 1, {}});
    std::copy_n(way_->next(v), D, made.target);
  }
}

template <int D>
uint32_t HeldPoints<D>::number_of(uint32_t vertex) const noexcept {
  const auto at = std::lower_bound(points_.begin(), points_.end(), vertex,
                                   [](const Point& point, uint32_t v) { return point.vertex < v; });
  return static_cast<uint32_t>(at - points_.begin());
}

template <int D>
bool HeldPoints<D>::moves(const Point& point) const noexcept {
  const double* const from = way_->start(point.vertex);
  return !std::equal(from, from + D, way_->next(point.vertex));
}

template <int D>
bool HeldPoints<D>::has_new(const uint32_t* vertices, uint32_t vertex_count) const noexcept {
  return !knows_new_ ||
         dsw::any_of(vertices, vertices + vertex_count, [&](uint32_t v) { return points_[number_of(v)].is_new; });
}

template <int D>
void HeldPoints<D>::set_part(Point& point, double part) noexcept {
  point.part = part;
  point.is_new = true;
  place_on_way<D>(way_->start(point.vertex), point.target, part, way_->next(point.vertex));
}

template <int D>
void HeldPoints<D>::shorten(uint32_t number, double part) noexcept {
  set_part(points_[number], points_[number].part * std::max(part, 0.0));
}

template <int D>
void HeldPoints<D>::keep_valid(const CellQueue& cells) {
  constexpr double kLeastPart = 0x1p-52;
  for (bool is_done = false; !is_done;) {
    is_done = true;
    parts_.clear();
    for (const Point& each : points_) parts_.push_back(each.part);
    for (size_t i = 0; i < cells.size(); ++i) {
      double least = 1, most = 0;
      env_.map.for_each_vertex(cells[i], [&](uint32_t v) {
        const double part = points_[number_of(v)].part;
        least = std::min(least, part);
        most = std::max(most, part);
      });
      if (least == 1 || most == 0 || stays_valid(env_, cells[i], way_->nexts())) continue;
      if (least == most) least = least > kLeastPart ? least / 2 : 0;
      env_.map.for_each_vertex(cells[i], [&](uint32_t v) {
        double& part = parts_[number_of(v)];
        part = std::min(part, least);
      });
      is_done = false;
    }
    for (size_t k = 0; k < parts_.size(); ++k) {
      if (parts_[k] < points_[k].part) set_part(points_[k], parts_[k]);
    }
  }
}

template <int D>
void HeldPoints<D>::add_held(Array<dsw_vertex_id>& held) const {
  for (const Point& each : points_) {
    if (each.part < 1 && !std::equal(each.target, each.target + D, way_->next(each.vertex))) {
      held.push_back({each.vertex, env_.map.vertex_generation(each.vertex)});
    }
  }
}

template class HeldPoints<2>;
template class HeldPoints<3>;

}  // namespace dsw
