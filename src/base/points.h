#pragma once
// Arguments as a host gives them, arrays of points first, and the checks of what is in them. Messages name argument,
// position, value.

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "base/error.h"
#include "base/fp_rules.h"

namespace dsw {

/** Points at a fixed distance; `step` counts doubles. */
struct PointArray {
  const double* data = nullptr;
  size_t step = 0;
  const double* operator[](size_t i) const { return data + i * step; }
};

/** How messages name an argument: "target", or "targets[17]" when it is an array. */
struct ArgumentName {
  const char* name;
  bool indexed;
  ArgumentName(const char* text, bool is_array = false) : name(text), indexed(is_array) {}
};

/** Text of an argument's name. */
struct ElementName {
  char text[64];
  ElementName(ArgumentName argument, size_t index) noexcept;
};

/** A point as messages give it: "(1, 2, 3)". */
struct PointText {
  char text[80];
  PointText(const double* point, int dimension) noexcept;
};

/** Tells whether all D coordinates of a point are finite. */
template <int D>
bool is_finite(const double* point) noexcept {
  if constexpr (D == 3) {
    if (!std::isfinite(point[2])) return false;
  }
  return std::isfinite(point[0]) && std::isfinite(point[1]);
}

/** Index of the first point that is not finite, or `count`. */
size_t find_non_finite(PointArray points, size_t count, int dimension) noexcept;

/** Fails with NON_FINITE and names the coordinate. */
[[noreturn]] void fail_non_finite(PointArray points, size_t index, int dimension, ArgumentName argument);

/** Throws unless all points are finite. */
inline void check_finite(PointArray points, size_t count, int dimension, ArgumentName argument) {
  const size_t bad = find_non_finite(points, count, dimension);
  if (bad != count) fail_non_finite(points, bad, dimension, argument);
}

/** Refuses a null argument; `name` is the parameter's. */
inline void require(const void* argument, const char* name) {
  if (argument == nullptr) fail(DSW_STATUS_NULL_ARGUMENT, "%s is null", name);
}

/** Refuses flags that this version does not know. They are those of `name`, or of its `member`. */
inline void check_flags(uint32_t flags, uint32_t known, const char* name, const char* member = "") {
  if ((flags & ~known) == 0) return;
  fail(DSW_STATUS_UNSUPPORTED, "%s%s is 0x%x, this version knows 0x%x", name, member, flags, known);
}

/** An array of `count` entries; null is allowed when there are none. A count that no array can have is WRONG_SIZE. */
void require_array(const void* array, size_t count, size_t entry_bytes, const char* name);
template <class T>
void require_array(const T* array, size_t count, const char* name) {
  require_array(array, count, sizeof(T), name);
}

/** The host's stride in doubles. `points` may be null. */
size_t to_step(int dimension, const double* points, size_t count, size_t stride_bytes, const char* name);
/** An array of points with the host's stride, not yet checked to be finite. */
PointArray to_points(int dimension, const double* points, size_t count, size_t stride_bytes, const char* name);
/** Returns an array of points with the host's stride, and throws unless all coordinates are finite. */
PointArray to_finite_points(int dimension, const double* points, size_t count, size_t stride_bytes, const char* name);
/** One point, which is finite. */
PointArray to_finite_point(int dimension, const double* point, const char* name);

}  // namespace dsw
