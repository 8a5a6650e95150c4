#include "cutting/blade.h"

#include "base/dimensions.h"
#include "base/key_table.h"
#include "base/vec.h"

namespace dsw {
namespace {

/** The point of segment a b that is nearest to the origin. */
Vec nearest_on_segment(const Vec& a, const Vec& b) {
  const Vec along = b - a;
  const double size = dot(along, along), share = size > 0 ? -dot(a, along) / size : 0;
  return a + std::min(std::max(share, 0.0), 1.0) * along;
}

}  // namespace

template <int D>
Blade<D>::Blade(const Memory* memory, PointArray points, uint32_t point_count)
    : points_(points), point_count_(point_count), simplices_(memory) {}

template <int D>
void Blade<D>::add(const uint32_t (&corners)[D]) {
  Simplex simplex;
  std::copy_n(corners, D, simplex.corners);
  std::fill_n(simplex.neighbours, D, kNone);
  simplices_.push_back(simplex);
}

template <int D>
Blade<D> Blade<D>::of_grid(const Memory* memory, PointArray points, uint32_t rows, uint32_t columns) {
  Blade blade(memory, points, rows * columns);
  blade.simplices_.reserve(D == 3 ? size_t{2} * (rows - 1) * (columns - 1) : size_t{rows} - 1);
  for (uint32_t first = 0; first + columns < rows * columns; ++first) {
    if constexpr (D == 3) {
      if (first % columns + 1 == columns) continue;
      const uint32_t across = first + columns + 1;
      blade.add({first, first + 1, across});
      blade.add({first, across, across - 1});
    } else {
      blade.add({first, first + 1});
    }
  }
  blade.join(memory);
  return blade;
}

template <int D>
Blade<D> Blade<D>::of_simplices(const Memory* memory, PointArray points, uint32_t point_count, const uint32_t* corners,
                                uint32_t simplex_count) {
  Blade blade(memory, points, point_count);
  blade.simplices_.reserve(simplex_count);
  for (size_t s = 0; s < simplex_count; ++s) {
    uint32_t own[D];
    std::copy_n(corners + D * s, D, own);
    blade.add(own);
  }
  blade.join(memory);
  return blade;
}

template <int D>
Blade<D> Blade<D>::fan(const Memory* memory, PointArray points, uint32_t point_count) {
  static_assert(D == 3, "a loop of the plane spans nothing");
  Blade blade(memory, points, point_count);
  const uint32_t centre = point_count - 1;
  for (uint32_t i = 0; i < centre; ++i) blade.add({i, (i + 1) % centre, centre});
  blade.join(memory);
  return blade;
}

/** What tells where a side runs and in which direction, or what it would be if it ran back: its two points; in the
 * plane its point, at which the segment begins or ends. */
template <int D>
uint64_t Blade<D>::way(size_t side, bool back) const {
  const uint32_t* const ends = simplices_[side / D].corners;
  const auto k = static_cast<uint32_t>(side % D);
  if constexpr (D == 2) return uint64_t{ends[k]} << 32 | (k ^ static_cast<uint32_t>(back));
  const uint32_t from = ends[k], to = ends[(k + 1) % D];
  return back ? uint64_t{to} << 32 | from : uint64_t{from} << 32 | to;
}

/** Sides are neighbours that join the same points in opposite directions; if there are several, those named first. */
template <int D>
void Blade<D>::join(const Memory* memory) {
  KeyTable ways(memory);
  Array<uint32_t> waiting{memory};  // of each way, the first side without a neighbour, or kNone
  Array<uint32_t> next(D * simplices_.size(), kNone, waiting.get_allocator());  // such side that is named later
  for (size_t side = D * simplices_.size(); side-- != 0;) {
    const uint32_t here = ways.insert(way(side, false)), back = ways.insert(way(side, true));
    waiting.resize(ways.size(), kNone);
    const uint32_t other = waiting[back];
    if (other == kNone) {
      next[side] = waiting[here];
      waiting[here] = static_cast<uint32_t>(side);
    } else {
      waiting[back] = next[other];
      simplices_[side / D].neighbours[side % D] = other / D;
      simplices_[other / D].neighbours[other % D] = static_cast<uint32_t>(side / D);
    }
  }
}

template <int D>
uint32_t Blade<D>::find_rim() const {
  for (uint32_t s = 0; s < simplex_count(); ++s) {
    for (const uint32_t neighbour : simplices_[s].neighbours) {
      if (neighbour == kNone) return s;
    }
  }
  return kNone;
}

template <int D>
double distance_to_simplex(const double* from, const double* const* corners) {
  Vec at[D];
  double scale = 0;
  for (int k = 0; k < D; ++k) {
    at[k] = difference<D>(corners[k], from);
    scale = std::max(scale, largest(at[k]));
  }
  if (!(scale > 0) || !std::isfinite(scale)) return length(at[0]);
  for (Vec& v : at) v /= scale;  // no square over- or underflows
  Vec best = at[0];
  for (int k = 0; k < (D == 3 ? 3 : 1); ++k) {
    const Vec on_side = nearest_on_segment(at[k], at[(k + 1) % D]);
    if (dot(on_side, on_side) < dot(best, best)) best = on_side;
  }
  const Vec normal = D == 3 ? (at[1] - at[0]).cross(at[D - 1] - at[0]) : turned(at[1] - at[0]);
  bool inside = !is_zero(normal);
  for (int k = 0; k < D; ++k) {
    const Vec along = at[(k + 1) % D] - at[k];
    inside = inside && (D == 3 ? dot(at[k].cross(at[(k + 1) % D]), normal) >= 0 : dot(at[k], along) <= 0);
  }
  if (inside) {
    const Vec down = dot(at[0], normal) / dot(normal, normal) * normal;
    if (dot(down, down) < dot(best, best)) best = down;
  }
  return length(scale * best);
}

template Blade<2>::Blade(const Memory* memory, PointArray points, uint32_t point_count);
template Blade<3>::Blade(const Memory* memory, PointArray points, uint32_t point_count);
template Blade<2> Blade<2>::of_grid(const Memory* memory, PointArray points, uint32_t rows, uint32_t columns);
template Blade<3> Blade<3>::of_grid(const Memory* memory, PointArray points, uint32_t rows, uint32_t columns);
template Blade<2> Blade<2>::of_simplices(const Memory* memory, PointArray points, uint32_t point_count,
                                         const uint32_t* corners, uint32_t simplex_count);
template Blade<3> Blade<3>::of_simplices(const Memory* memory, PointArray points, uint32_t point_count,
                                         const uint32_t* corners, uint32_t simplex_count);
template uint32_t Blade<2>::find_rim() const;
template uint32_t Blade<3>::find_rim() const;
DSW_INSTANTIATE(distance_to_simplex);
template Blade<3> Blade<3>::fan(const Memory* memory, PointArray points, uint32_t point_count);

}  // namespace dsw
