// A cell of which some points are held and others go on can turn over. Then all of its points go the same part of their ways,
// the smallest that one of them goes: the cell stays valid there, since it does on the whole way. Only rounding can spoil
// that. Then the part is halved.

#include "together/held_points.h"

#include <algorithm>

#include "base/position.h"
#include "base/search.h"
#include "base/sort.h"
#include "environment/validity.h"
#include "motion/place_on_way.h"

namespace dsw {

template <int D>
void HeldPoints<D>::start_round() noexcept {
  knows_new_ = true;
  for (Point& each : points_) each.is_new = false;
}

template <int D>
size_t HeldPoints<D>::find(uint32_t vertex) const noexcept {
  const auto at = std::lower_bound(order_.begin(), order_.end(), vertex,
                                   [&](uint32_t number, uint32_t v) { return points_[number].vertex < v; });
  return static_cast<size_t>(at - order_.begin());
}

/** The number of a vertex, which gets one if it has none. */
template <int D>
uint32_t HeldPoints<D>::add(uint32_t vertex) {
  const size_t at = find(vertex);
  if (is_at(at, vertex)) return order_[at];
  order_.insert(order_.begin() + static_cast<std::ptrdiff_t>(at), count());
  Point& made = points_.emplace_back(Point{vertex, false, 1, {}});
  std::copy_n(way_->next(vertex), D, made.target);
  return count() - 1;
}

/** Gives all vertices of these cells numbers. */
template <int D>
void HeldPoints<D>::add_all(const CellQueue& cells) {
  Array<uint32_t> vertices(env_.memory);
  for (size_t i = 0; i < cells.size(); ++i) {
    env_.map.for_each_vertex(cells[i], [&](uint32_t v) { vertices.push_back(v); });
  }
  dsw::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  const auto is_known = [&](uint32_t v) { return is_at(find(v), v); };
  vertices.erase(std::remove_if(vertices.begin(), vertices.end(), is_known), vertices.end());
  for (const uint32_t v : vertices) {
    order_.push_back(count());
    Point& made = points_.emplace_back(Point{v, false, 1, {}});
    std::copy_n(way_->next(v), D, made.target);
  }
  dsw::sort(order_.begin(), order_.end(),
            [&](uint32_t a, uint32_t b) { return points_[a].vertex < points_[b].vertex; });
}

template <int D>
bool HeldPoints<D>::moves(uint32_t vertex) const noexcept {
  const double* const from = way_->start(vertex);
  return !is_same_place<D>(from, way_->next(vertex));
}

template <int D>
bool HeldPoints<D>::has_new(const uint32_t* vertices, uint32_t vertex_count) const noexcept {
  return !knows_new_ || dsw::any_of(vertices, vertices + vertex_count, [&](uint32_t v) {
    const size_t at = find(v);
    return is_at(at, v) && points_[order_[at]].is_new;
  });
}

template <int D>
void HeldPoints<D>::set_part(Point& point, double part) {
  way_->keep_targets();
  any_held_ = true;
  point.part = part;
  point.is_new = true;
  place_on_way<D>(way_->start(point.vertex), point.target, part, way_->next(point.vertex));
}

template <int D>
void HeldPoints<D>::shorten(uint32_t number, double part) {
  set_part(points_[number], points_[number].part * std::max(part, 0.0));
}

/** Where nothing is held, all cells go the ways on which they stay valid. */
template <int D>
void HeldPoints<D>::keep_valid(const CellQueue& cells) {
  constexpr double kLeastPart = 0x1p-52;
  if (!any_held_) return;
  add_all(cells);
  for (bool is_done = false; !is_done;) {
    is_done = true;
    parts_.clear();
    for (const Point& each : points_) parts_.push_back(each.part);
    for (size_t i = 0; i < cells.size(); ++i) {
      double least = 1, most = 0;
      env_.map.for_each_vertex(cells[i], [&](uint32_t v) {
        const double part = points_[order_[find(v)]].part;
        least = std::min(least, part);
        most = std::max(most, part);
      });
      if (least == 1 || most == 0 || stays_valid(env_, cells[i], way_->nexts())) continue;
      if (least == most) least = least > kLeastPart ? least / 2 : 0;
      env_.map.for_each_vertex(cells[i], [&](uint32_t v) {
        double& part = parts_[order_[find(v)]];
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
  for (const uint32_t number : order_) {
    const Point& each = points_[number];
    if (each.part < 1 && !is_same_place<D>(each.target, way_->next(each.vertex))) {
      held.push_back({each.vertex, env_.map.vertex_generation(each.vertex)});
    }
  }
}

template class HeldPoints<2>;
template class HeldPoints<3>;

}  // namespace dsw
