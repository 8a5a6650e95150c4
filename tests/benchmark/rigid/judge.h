// What a rigid motion touches first, and whether a place is free, in rational arithmetic. Doubles only leave out what is clearly apart.
#ifndef DARTSWEEP_TESTS_BENCHMARK_RIGID_JUDGE_H
#define DARTSWEEP_TESTS_BENCHMARK_RIGID_JUDGE_H

#include <functional>

#include "figure.h"
#include "predicates/turning_pair.h"

namespace dsw::rigid {

/** Where a point is at a time, to the last places of a long double. */
std::array<long double, 3> place_at(const TurningWay& way, const Point& point, long double time);

struct Touching {
  Part body, standing;
};

struct Truth {
  bool touches = false;
  double time = 0;  // the largest double not later than the exact time
  std::vector<Touching> pairs;
  std::size_t asked = 0;  // pairs decided in rational arithmetic
};

/** The first touch of a body on its way with what stands. Where the body begins in touch with a wall, it touches when it first enters the
 * wall under the shift, as it may leave the wall or go along it.
 * @param wall_points that many points of `standing` are those of walls; the others are those of bodies. */
Truth first_touch_of(int dimension, const Figure& body, const TurningWay& way, const Figure& standing,
                     std::size_t wall_points);

/** How places are: whether parts go through each other. Ties between a body and walls are decided by the shift; those between
 * bodies are taken as free. */
bool is_free(int dimension, const Figure& body, const std::vector<Point>& places, const Figure& walls, bool is_shifted);

/** The distance of parts, to the last places of a long double. */
long double distance(const std::array<long double, 3>* a, std::size_t a_count, const std::array<long double, 3>* b,
                     std::size_t b_count);
/** On which side of the common plane of parts that can touch, and how far from it: the plane of a triangle, or of two edges; in the
 * plane the line of an edge. */
template <int D>
long double height(const std::array<std::array<long double, 3>, 3>& a, std::size_t a_count,
                   const std::array<std::array<long double, 3>, 3>& b, std::size_t b_count);
long double distance(const std::vector<Point>& places, const Part& part, const Figure& standing, const Part& other);

/** Places of a body at a time from 0 to 1. */
using PlacesAt = std::function<std::vector<std::array<long double, 3>>(long double time)>;

/** When parts of a body first come nearer than `keep` to what stands, or 2 if they never do before `until`. No point of the body
 * goes faster than `speed`. Ways shorter than 2^-36 are not cut further: what happens in between can stay unseen. */
long double first_nearer(int dimension, const Figure& body, const PlacesAt& places_at, long double speed,
                         const Figure& standing, long double keep, long double until);

}  // namespace dsw::rigid

#endif
