// The nearest point of an intersection of half-spaces lies on the planes of at most D of them. There are few walls, so
// all sets of up to D planes are tried.

#include "response/touched_walls.h"

#include <limits>

namespace dsw {
namespace {

constexpr double kLeastStep = 1e-6;  // of what is left of the way: shorter steps are not worth a sweep

}  // namespace

template <int D>
void TouchedWalls<D>::add(const Vec& normal, const Vec& touching, double off) {
  // A wall that is touched again, or another part of the same flat wall, takes the place of the one before.
  int last = 0;
  while (last < count_ && walls_[last].normal != normal) ++last;
  if (last == count_) {
    last = std::min(count_, kMost - 1);
    count_ = last + 1;
  }
  for (int i = last; i > 0; --i) walls_[i] = walls_[i - 1];
  walls_[0] = {normal, touching, off};
}

/** Keeps the best of the steps that are before all walls. */
template <int D>
class TouchedWalls<D>::Search {
 public:
  Search(const HalfSpace* walls, int count, const Vec& wanted) : walls_(walls), count_(count), wanted_(wanted) {}

  void try_all() {
    consider(wanted_);
    for (int i = 0; i < count_; ++i) {
      const HalfSpace& a = walls_[i];
      consider(wanted_ + (a.least - dot(a.normal, wanted_)) * a.normal);
      for (int j = 0; j < i; ++j) {
        try_crease(a, walls_[j]);
        for (int k = 0; D == 3 && k < j; ++k) try_corner(a, walls_[j], walls_[k]);
      }
    }
  }
  bool any() const { return any_; }
  const Vec& best() const { return best_; }

 private:
  void try_crease(const HalfSpace& a, const HalfSpace& b) {
    const Vec across = a.normal.cross(b.normal);
    const double size = dot(across, across), both = dot(a.normal, b.normal);
    if (!(size > 0)) return;
    const Vec on_a = ((a.least - both * b.least) / size) * a.normal;
    const Vec on_b = ((b.least - both * a.least) / size) * b.normal;
    const Vec along = (dot(across, wanted_) / size) * across;
    consider(on_a + on_b + along);
  }
  void try_corner(const HalfSpace& a, const HalfSpace& b, const HalfSpace& c) {
    const Vec bc = b.normal.cross(c.normal), ca = c.normal.cross(a.normal), ab = a.normal.cross(b.normal);
    const double volume = dot(a.normal, bc);
    if (volume == 0) return;
    const Vec sum = a.least * bc + b.least * ca + c.least * ab;
    consider(sum / volume);
  }
  void consider(const Vec& step) {
    for (int i = 0; i < count_; ++i) {
      if (!(dot(walls_[i].normal, step) >= walls_[i].least - walls_[i].slack)) return;
    }
    const Vec missing = wanted_ - step;
    const double distance = length(missing);
    if (any_ ? !(distance < distance_) : !(distance < std::numeric_limits<double>::infinity())) return;
    any_ = true;
    best_ = step;
    distance_ = distance;
  }

  const HalfSpace* walls_;
  int count_;
  Vec wanted_, best_;
  double distance_ = 0;
  bool any_ = false;
};

template <int D>
bool TouchedWalls<D>::find_nearest(const Vec& at, const Vec& target, Vec* nearest) const {
  const Vec wanted = target - at;
  const double left = length(wanted), rounding = 4 * std::numeric_limits<double>::epsilon() * left;
  HalfSpace sides[kMost];
  double least_step = kLeastStep * left;
  for (int i = 0; i < count_; ++i) {
    const Wall& wall = walls_[i];
    const Vec from_wall = at - wall.touching;
    const double gap = dot(wall.normal, from_wall);
    // The gap is restored only where it has fallen below half. A wall that was left may be approached again.
    const double keep = gap < wall.off / 2 ? wall.off : i == 0 ? gap : std::min(gap, wall.off);
    sides[i] = {wall.normal, keep - gap, std::max(wall.off / 2, rounding)};
    least_step = std::max(least_step, 2 * wall.off);
  }
  Search search(sides, count_, wanted);
  search.try_all();
  if (!search.any()) return false;
  const double step = length(search.best());
  if (!(step > least_step) || !(dot(search.best(), wanted) > 0)) return false;
  *nearest = at + search.best();
  return true;
}

template class TouchedWalls<2>;
template class TouchedWalls<3>;

}  // namespace dsw
