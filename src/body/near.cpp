#include "body/near.h"

#include "base/dimensions.h"
#include "base/search.h"
#include "base/sort.h"

#include <algorithm>

namespace dsw {
namespace {

constexpr double kWaste = 4;  // times what was put into it: the largest volume of a group

/** Flat boxes count as if they had some thickness. */
template <int D>
double volume_of(const Box<D>& box) noexcept {
  double size[D], longest = 0;
  for (int k = 0; k < D; ++k) {
    size[k] = box.upper[k] - box.lower[k];
    longest = std::max(longest, size[k]);
  }
  double volume = 1;
  for (const double each : size) volume *= std::max(each, longest / 8);
  return volume;
}

}  // namespace

template <int D>
void BoxGroups<D>::add(const Box<D>& box) {
  const double volume = volume_of(box);
  if (!boxes_.empty()) {
    Box<D> joined = boxes_.back();
    joined.add(box);
    if (!apart_ || volume_of(joined) <= kWaste * (volume_ + volume)) {
      boxes_.back() = joined;
      volume_ += volume;
      return;
    }
  }
  boxes_.push_back(box);
  volume_ = volume;
}

template <int D>
void BoxGroups<D>::join() noexcept {
  while (boxes_.size() > 1) {
    boxes_.front().add(boxes_.back());
    boxes_.pop_back();
  }
}

template <int D>
bool Places<D>::overlap(const double* const* points, int corners) const noexcept {
  if (everywhere()) return true;
  Box<D> box;
  for (int i = 0; i < corners; ++i) box.add(points[i]);
  return dsw::any_of(boxes, boxes + count, [&](const Box<D>& place) { return place.overlaps(box); });
}

template <int D>
void find_overlapping(const BoxGrid<D>& grid, const Places<D>& places, Array<uint32_t>& found) {
  found.clear();
  for (size_t i = 0; i < places.count; ++i) {
    grid.visit(places.boxes[i], [&](uint32_t number) {
      found.push_back(number);
      return true;
    });
  }
  dsw::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
}

template class BoxGroups<2>;
template class BoxGroups<3>;
template struct Places<2>;
template struct Places<3>;
DSW_INSTANTIATE(find_overlapping);

}  // namespace dsw
