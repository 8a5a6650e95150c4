// A segment between the nearest points of two simplices, and signs along it. Its ends are quotients of integers, which no
// doubles are, so all signs are those of the exact ends. Right for any finite doubles.
#pragma once

#include <cstdint>
#include <optional>

#include "predicates/integer.h"

namespace dsw {

/** Up to three points. */
struct SimplexPoints {
  const double* at[3];
  uint32_t count;
};

/** How the shift (README.md) moves an end of a sightline: not at all, as a point of a body, or as the foot of a body's
 * vertex moves on the simplex that the foot lies on. */
enum class EndShift : uint32_t { kStill, kWhole, kFoot };

/** The point of a simplex that is nearest to another simplex. It has to be unique, and inside of both. */
template <int D>
struct SightEnd {
  SimplexPoints of, to;
  EndShift shift;
  double near[3], error[3];  // the point in doubles, and how far the exact one is away at most, axis by axis

  SightEnd(const SimplexPoints& at, const SimplexPoints& nearest_to, EndShift how) noexcept;
};

template <int D>
class Sightline {
 public:
  Sightline(const SightEnd<D>& from, const SightEnd<D>& to) noexcept : from_(from), to_(to) {}

  // These functions ask about simplices of a cell's boundary (README.md). Those that are not noexcept throw
  // std::bad_alloc, as Integer does.

  /** +1 if the end certainly lies beyond a plane, -1 if on this side, 0 if doubles do not tell. Throws nothing. */
  int certain_end_side(const double* const* simplex) const noexcept;
  /** Whether the end lies beyond a plane, and not on it. */
  bool ends_beyond(const double* const* simplex);
  bool starts_beyond(const double* const* simplex);
  /** Whether the line passes inside of a simplex. The end lies beyond its plane, the start does not. */
  bool pierces(const double* const* simplex);
  /** Whether the end lies on a simplex, its border included. */
  bool ends_on(const double* const* simplex);
  /** Whether the line passes the plane of `a` before that of `b`. The end lies beyond both, the start beyond none. */
  bool passes_before(const double* const* a, const double* const* b);

 private:
  /** Both ends as integers. */
  struct Exact {
    struct End {
      Integer x[D], w;      // the point x/w
      Integer shift[D][D];  // shift[i]/w times e^(i+1) is added to it
      int orders = 0;       // of the shift: 0 or D
    };
    IntegerPool pool;
    int low;  // coordinates are multiples of 2^(low - 1075)
    End from, to;

    Exact(const SightEnd<D>& of_from, const SightEnd<D>& of_to);
    void set(const SightEnd<D>& of, End& end);
  };
  class Question;

  int exact_plane_side(bool is_end, const double* const* simplex);
  int ridge_side(const double* const* ridge);
  Exact& exact() {
    if (!exact_) exact_.emplace(from_, to_);
    return *exact_;
  }

  SightEnd<D> from_, to_;
  std::optional<Exact> exact_;  // once doubles have left a sign open
};

}  // namespace dsw
