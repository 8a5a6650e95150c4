// A box about the point grows until it holds what is nearest.

#include "scene/body_places.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/dimensions.h"
#include "base/position.h"
#include "body/near_simplices.h"
#include "locate/distances.h"

namespace dsw {
namespace {

template <int D>
class PlaceSearch {
 public:
  PlaceSearch(const Partner<D>& partner, const double* point, BodyPlace<D>& place)
      : partner_(partner), body_(*partner.body), point_(point), place_(place) {}

  void run() {
    if (body_.boxes.empty()) {
      for_each_outer(body_, [&](const Simplex& part) { return look(part); });
      return;
    }
    const Box<D>& bounds = body_.boxes[0].bounds;
    double nearest = 0, farthest = 0, extent = 0;
    for (int k = 0; k < D; ++k) {
      const double below = bounds.lower[k] - point_[k], above = point_[k] - bounds.upper[k];
      nearest = std::max({nearest, below, above});
      farthest += std::max(std::fabs(below), std::fabs(above));
      extent = std::max(extent, bounds.upper[k] - bounds.lower[k]);
    }
    const double parts = static_cast<double>(body_.vertices.size());
    const auto wanted = [&] { return std::min(place_.distance + body_.radius, farthest); };
    for (double reach = nearest + extent / std::sqrt(parts);; reach *= 2) {
      const bool is_last = !(reach < wanted());
      visit(box_about<D>(point_, is_last ? wanted() : reach));
      if (is_last || place_.distance + body_.radius <= reach) return;
    }
  }

 private:
  void visit(const Box<D>& box) {
    for_each_outer_near(body_, box, [this](const Simplex& part) { return look(part); });
  }

  bool look(const Simplex& part) {
    const SimplexCorners<D> corners(body_, part);
    Vec at[3];
    for (uint32_t k = 0; k < corners.count; ++k)
      at[k] = relative<D>(body_.position(corners.vertices[k]), point_, place_.scale);
    const Vec way = corners.count == 1   ? at[0]
                    : corners.count == 2 ? nearest_on(at[0], at[1])
                                         : nearest_on(at[0], at[1], at[2]);
    const double distance = length_of_way(way) / place_.scale - body_.radius;
    const auto key = [](double d, uint32_t body, const Simplex& s) {
      return std::make_tuple(d, body, s.kind, s.index);
    };
    const uint32_t other = place_.body.body == nullptr ? kNone : place_.body.index;
    if (!(key(distance, partner_.index, part) < key(place_.distance, other, place_.part))) return true;
    place_.distance = distance;
    place_.way = way;
    place_.body = partner_;
    place_.part = part;
    return true;
  }

  const Partner<D>& partner_;
  const Body<D>& body_;
  const double* point_;
  BodyPlace<D>& place_;
};

}  // namespace

template <int D>
Box<D> box_about(const double* point, double distance) noexcept {
  if (!std::isfinite(distance)) return Box<D>::everything();
  Box<D> box;
  box.add(point);
  return widened(box, std::max(distance, 0.0) + 0x1p-45 * (largest_coordinate<D>(point) + std::max(distance, 0.0)));
}

template <int D>
void find_nearest_place(const Partner<D>& partner, const double* point, BodyPlace<D>& place) noexcept {
  PlaceSearch<D>(partner, point, place).run();
}

DSW_INSTANTIATE(box_about);
DSW_INSTANTIATE(find_nearest_place);

}  // namespace dsw
