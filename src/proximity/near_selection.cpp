#include "proximity/near_selection.h"

#include <algorithm>

#include "base/search.h"
#include "proximity/rough.h"

namespace dsw {
namespace {

/** Points of a part of a simplex. */
struct Points {
  const double* at[3];
  uint32_t count;
};

template <int D>
Points points_at(const Part<D>& part, uint32_t place) noexcept {
  const double* const* const at = part.points;
  if (place < kFirstSide) return {{at[place]}, 1};
  if (place == kWholeFace) return {{at[0], at[1], at[2]}, 3};
  return {{at[place - kFirstSide], at[(place - kFirstSide + 1) % part.corners.count]}, 2};
}

/** Whether a pair cannot become a row. The distances of points, edges and triangles change by no more than their corners
 * move, and so do those of a point's foot from the ends of an edge or the sides of a triangle that stand still. */
template <int D>
bool stays_far(const Points& part, const Points& feature, const SelectionLimits& limits) noexcept {
  const Vec w = difference<D>(part.at[0], feature.at[0]);
  const auto edge = [](const Points& of, int end) { return difference<D>(of.at[end], of.at[0]); };
  const double room = limits.room, way = limits.way;
  switch (part.count * 4 + feature.count) {
    case 5:
      return rough::is_far_from_point(w, room);
    case 6:
      return rough::is_far_from_edge(edge(feature, 1), w, room, way);
    case 7:
      return rough::Triangle(edge(feature, 1), edge(feature, 2)).is_far(w, room, way);
    case 9:
      return rough::is_far_from_edge(edge(part, 1), -w, room, room);
    case 10:
      return rough::are_far_edges(edge(part, 1), edge(feature, 1), w, room);
    default:
      return rough::Triangle(edge(part, 1), edge(part, 2)).is_far(-w, room, room);
  }
}

}  // namespace

template <int D>
SelectionLimits NearSelection<D>::select_all(const NearList<D>& list, const Part<D>& part,
                                             const SelectionLimits& wanted, double most) {
  const Array<Sphere<D>>& spheres = list.spheres();
  numbers_.clear();
  const Sphere<D> round(part.points, part.corners.count);
  const bool is_face = part.corners.count == 3;
  const double* const from = is_face ? round.centre : part.points[0];
  const Capsule<D> capsule(from, is_face ? from : part.points[part.corners.count - 1]);
  const double more = is_face ? round.radius : 0;
  const auto is_beyond = [&](double reach) {
    return [&, reach](const Sphere<D>& sphere) { return capsule.is_beyond(sphere, reach + more); };
  };
  const SelectionLimits limits{std::min(wanted.room, most), wanted.way};
  const auto is_out = is_beyond(limits.room);
  for (uint32_t i = 0; i < spheres.size(); ++i) {
    if (!is_out(spheres[i])) numbers_.push_back(i);
  }
  is_alone_ = numbers_.empty() && dsw::all_of(spheres.begin(), spheres.end(), is_beyond(most));
  return is_alone_ ? SelectionLimits{most, most} : limits;
}

template <int D>
SelectionLimits NearSelection<D>::select_features(const NearList<D>& list, const Part<D>& part, uint32_t places,
                                                  const SelectionLimits& wanted, double most) {
  const SelectionLimits limits = select_all(list, part, wanted, most);
  const size_t count = numbers_.size();
  for (uint32_t place = 0; place < kPlacesInSimplex; ++place) {
    first_[place] = static_cast<uint32_t>(numbers_.size() - count);
    if ((places >> place & 1) == 0) continue;
    const Points points = points_at(part, place);
    const Sphere<D> round(points.at, points.count);
    for (size_t i = 0; i < count; ++i) {
      const uint32_t number = numbers_[i];
      const NearFeature& f = list.features()[number];
      if (points.count + f.count > D + 1) break;
      if (are_apart(round, list.spheres()[number], limits.room)) continue;
      Points feature{{}, f.count};
      for (uint32_t k = 0; k < f.count; ++k) feature.at[k] = list.point(f.corners[k]);
      if (!stays_far<D>(points, feature, limits)) numbers_.push_back(number);
    }
  }
  first_[kPlacesInSimplex] = static_cast<uint32_t>(numbers_.size() - count);
  numbers_.erase(numbers_.begin(), numbers_.begin() + static_cast<ptrdiff_t>(count));
  return limits;
}

template class NearSelection<2>;
template class NearSelection<3>;

}  // namespace dsw
