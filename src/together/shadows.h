#pragma once
// Points along a few directions, where they start and where they end: what one direction parts then it parts on the whole way, since all
// points go straight and steadily.

#include <cmath>
#include <cstdint>
#include <cstring>

#include "base/compiler.h"
#include "base/memory.h"
#include "body/box.h"

namespace dsw {

/** Points of which all make the same part of their ways; what all go may be left out of these. Throws std::bad_alloc.
 *
 * Lengths along directions are whole steps of a frame, from one step below the place to one above; what is apart is so by two steps. So
 * roundings of far less than a step, those of single precision and of places on the way as well, change no answer. */
template <int D>
class Shadows {
 public:
  /** By direction, whether a point stays beyond or below another one. */
  struct Sides {
    ShortEight beyond, below;

    /** Whether one direction parts two that have their points in common with it alone. */
    bool are_opposite(const Sides& other) const noexcept {
      return has_any((beyond & other.below) | (below & other.beyond));
    }
  };

  explicit Shadows(const Memory* memory) : shadows_(memory) {}

  /** @param all a box of all places.
   * @param largest the largest coordinate of what the places are made of. */
  void start(size_t count, const Box<D>& all, double largest) {
    shadows_.resize(count);
    double extent[D], size = 0;
    for (int i = 0; i < D; ++i) {
      centre_[i] = 0.5 * all.lower[i] + 0.5 * all.upper[i];
      extent[i] = 0.5 * all.upper[i] - 0.5 * all.lower[i];
      size = std::fmax(size, extent[i]);
    }
    const bool is_usual = size < 0x1p1000 && size > 0x1p-1000;
    scale_ = is_usual ? 1 / size : 0;
    for (int k = 0; k < kDirections; ++k) {
      double half = 0;
      for (int i = 0; i < D; ++i) half += std::fabs(kAlong[i][k]) * extent[i];
      // Nothing is apart where steps are not far longer than roundings.
      const bool is_known = is_usual && half > 0x1p-30 * largest;
      for (int i = 0; i < D; ++i) {
        along_[i][k] = is_known ? static_cast<float>(kAlong[i][k] * kMostSteps * (size / half)) : 0;
      }
    }
  }
  void set(size_t point, const double* start, const double* end) noexcept {
    set_range(start, shadows_[point].start);
    set_range(end, shadows_[point].end);
  }

  /** Whether the hulls of two sets of points are surely apart at all times. */
  bool part(const uint32_t* a, uint32_t a_count, const uint32_t* b, uint32_t b_count) const noexcept {
    ShortEight below = eight_of(-1), beyond = below;
    for (uint32_t i = 0; i < a_count; ++i) {
      const Shadow& one = shadows_[a[i]];
      for (uint32_t k = 0; k < b_count; ++k) {
        const Shadow& other = shadows_[b[k]];
        below = below & one.start.is_below(other.start) & one.end.is_below(other.end);
        beyond = beyond & other.start.is_below(one.start) & other.end.is_below(one.end);
      }
    }
    return has_any(below | beyond);
  }
  /** On which sides of another point a point surely stays. */
  Sides sides(uint32_t point, uint32_t of) const noexcept {
    const Shadow &there = shadows_[point], &here = shadows_[of];
    return {here.start.is_below(there.start) & here.end.is_below(there.end),
            there.start.is_below(here.start) & there.end.is_below(here.end)};
  }

 private:
  static constexpr int kDirections = 8;
  static constexpr double kMostSteps = 32000;
  // Spread over all directions, and along no axis and no diagonal, since there features of regular meshes lie in one plane. In the plane the
  // first two rows.
  static constexpr double kAlong[3][kDirections] = {{0.824, -0.975, 0.448, 0.009, -0.754, 0.533, -0.599, -0.218},
                                                    {0.280, 0.213, -0.893, 0.524, -0.654, -0.470, -0.005, -0.772},
                                                    {0.493, 0.066, -0.034, 0.852, 0.055, 0.703, 0.801, 0.597}};
  /** By direction, the steps that a place lies between. */
  struct Range {
    ShortEight low, high;

    ShortEight is_below(const Range& other) const noexcept { return high < other.low; }
  };
  struct Shadow {
    Range start, end;
  };

  static bool has_any(const ShortEight& mask) noexcept {
    uint64_t words[2];
    std::memcpy(words, &mask, sizeof words);
    return (words[0] | words[1]) != 0;
  }
  void set_range(const double* at, Range& range) const noexcept {
    // What is left out of all steps is finite: see find_drift. So all places lie in the box, and all sums are numbers below
    // 2^15. The loops are such as compilers make vectors of.
    float place[D], sums[kDirections];
    for (int i = 0; i < D; ++i) place[i] = scale_ != 0 ? static_cast<float>((at[i] - centre_[i]) * scale_) : 0;
    for (int k = 0; k < kDirections; ++k) {
      sums[k] = along_[0][k] * place[0];
      for (int i = 1; i < D; ++i) sums[k] += along_[i][k] * place[i];
    }
    int16_t low[kDirections], high[kDirections];
    for (int k = 0; k < kDirections; ++k) low[k] = static_cast<int16_t>(static_cast<int32_t>(sums[k]) - 1);
    for (int k = 0; k < kDirections; ++k) high[k] = static_cast<int16_t>(static_cast<int32_t>(sums[k]) + 1);
    std::memcpy(&range.low, low, sizeof low);
    std::memcpy(&range.high, high, sizeof high);
  }

  Array<Shadow> shadows_;
  double centre_[D] = {},
         scale_ = 0;  // which makes coordinates from the centre at most 1; 0 if no frame can hold all places
  float along_[D][kDirections] = {};  // steps of the frame along each direction
};

}  // namespace dsw
