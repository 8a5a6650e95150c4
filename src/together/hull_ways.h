#pragma once
// Two hulls of a few points that go straight and steadily: how long they keep a distance.

#include "predicates/hull_gap.h"
#include "together/trajectory.h"

namespace dsw {

/** The points of a pair at both ends of its way. */
template <int D>
struct HullWays {
  const double* start[2][4];
  const double* end[2][4];
  uint32_t corner[2][4];  // of the part, or of the wall: which point this is
  uint32_t count[2];
  uint32_t first = 0;  // which of the two is the pair's first
  Bend bends[2];       // of the two, beside these ways

  double bend() const noexcept { return bends[0].most + bends[1].most; }
  double bend(const Vec& direction) const noexcept { return bends[0].along(direction) + bends[1].along(direction); }
};

/** Up to which time, at most `most`, two hulls keep a distance while their points go straight and steadily: certified, so at
 * most the true time. What moves keeps a little more than what stands (thick_sweep.h). What begins nearer than that by rounding
 * does not come nearer than it was. So what has moved can leave, and go along with what it touches.
 * @param known a direction that may show the distance, from the second hull to the first; then the one that was found last. */
template <int D>
double time_kept(const HullWays<D>& ways, double wanted, double most, Vec* known) noexcept;

/** How fast a gap opens at its time, in terms of the whole way: the points that are nearest to each other, along its normal. */
template <int D>
double opening_of(const HullWays<D>& ways, const HullGap& gap) noexcept;

/** The hulls at a time of their ways. */
template <int D>
struct HullPlaces {
  double places[2][4][D];
  ConvexHull hulls[2];

  HullPlaces(const HullWays<D>& ways, double time) noexcept;
  HullPlaces(const HullPlaces&) = delete;
  HullPlaces& operator=(const HullPlaces&) = delete;
  HullGap gap(double enough, double least) const noexcept { return find_gap<D>(hulls[0], hulls[1], enough, least); }
};

/** A time of a way, and how far a pair is apart then. */
struct TimeOfGap {
  double time, distance;
  bool is_later;  // than the time that was given
};

/** About when a pair is nearest that comes too near at `time`. It is `time` itself if the pair comes nearer than half of the wanted
 * distance, or its normal turns much: a later time would say little of how to keep apart. */
template <int D>
TimeOfGap worst_time(const HullWays<D>& ways, double time, double wanted) noexcept;

}  // namespace dsw
