#include "base/points.h"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>

#include "base/compiler.h"
#include "base/point_ends.h"

namespace dsw {
namespace {

bool is_finite_point(const double* point, int dimension) noexcept {
  for (int k = 0; k < dimension; ++k) {
    if (!std::isfinite(point[k])) return false;
  }
  return true;
}

/** Whether all numbers of some arrays are finite. One pass without branches: x - x is 0 for a finite x, and NaN for any other. All bits of
 * 0 are zero, and those of NaN are not. */
template <size_t Arrays>
bool all_finite(const double* const (&arrays)[Arrays], size_t count) noexcept {
  PairMask seen[4] = {};
  size_t i = 0;
  for (; i + 4 <= count; i += 4) {
    for (size_t k = 0; k < 2 * Arrays; ++k) {
      DoublePair x;
      std::memcpy(&x, arrays[k / 2] + i + 2 * (k % 2), sizeof x);
      seen[k] |= bits_of(x - x);
    }
  }
  double rest = 0;
  for (; i < count; ++i) {
    for (const double* const values : arrays) rest += values[i] - values[i];
  }
  const PairMask all = (seen[0] | seen[1]) | (seen[2] | seen[3]);
  return rest == 0 && (all[0] | all[1]) == 0;
}

/** Refuses a count that no array can have: such a count is below zero elsewhere, or a product that did not fit. */
void check_entries(size_t count, size_t entry_bytes, const char* name) {
  constexpr size_t kAddresses = sizeof(size_t) == 8 ? size_t{PTRDIFF_MAX} >> 7 : size_t{PTRDIFF_MAX};  // 2^56 bytes
  constexpr size_t kSmall = 1 << 15;  // without the division
  if ((count | entry_bytes) >= kSmall && count > kAddresses / entry_bytes)
    fail(DSW_STATUS_WRONG_SIZE, "%s cannot have %zu entries", name, count);
}

}  // namespace

ElementName::ElementName(ArgumentName argument, size_t index) noexcept {
  if (argument.indexed) {
    std::snprintf(text, sizeof text, "%s[%zu]", argument.name, index);
  } else {
    std::snprintf(text, sizeof text, "%s", argument.name);
  }
}

PointText::PointText(const double* point, int dimension) noexcept {
  if (dimension == 2) {
    std::snprintf(text, sizeof text, "(%g, %g)", point[0], point[1]);
  } else {
    std::snprintf(text, sizeof text, "(%g, %g, %g)", point[0], point[1], point[2]);
  }
}

size_t find_non_finite(PointArray points, size_t count, int dimension) noexcept {
  const bool dense = points.step == static_cast<size_t>(dimension);
  if (count == 0 || (dense && all_finite({points.data}, count * points.step))) return count;
  for (size_t i = 0; i < count; ++i) {
    if (!is_finite_point(points[i], dimension)) return i;
  }
  return count;
}

void fail_non_finite(PointArray points, size_t index, int dimension, ArgumentName argument) {
  const double* const p = points[index];
  int k = 0;
  while (k + 1 < dimension && std::isfinite(p[k])) ++k;
  fail(DSW_STATUS_NON_FINITE, "%s[%d] is %s, must be finite", ElementName(argument, index).text, k,
       std::isnan(p[k]) ? "nan"
       : p[k] > 0       ? "inf"
                        : "-inf");
}

void require_array(const void* array, size_t count, size_t entry_bytes, const char* name) {
  if (count != 0) require(array, name);
  check_entries(count, entry_bytes, name);
}

size_t to_step(int dimension, const double* points, size_t count, size_t stride_bytes, const char* name) {
  const size_t point = static_cast<size_t>(dimension) * sizeof(double);
  if (stride_bytes == 0) stride_bytes = point;
  if (stride_bytes < point || stride_bytes % sizeof(double) != 0) {
    fail(DSW_STATUS_WRONG_SIZE, "stride_bytes is %zu, must be 0 or a multiple of %zu from %zu on", stride_bytes,
         sizeof(double), point);
  }
  if (points != nullptr) check_entries(count, stride_bytes, name);
  return stride_bytes / sizeof(double);
}

PointArray to_points(int dimension, const double* points, size_t count, size_t stride_bytes, const char* name) {
  if (count != 0) require(points, name);
  return {points, to_step(dimension, points, count, stride_bytes, name)};
}

PointArray to_finite_points(int dimension, const double* points, size_t count, size_t stride_bytes, const char* name) {
  const PointArray all = to_points(dimension, points, count, stride_bytes, name);
  check_finite(all, count, dimension, {name, true});
  return all;
}

PointEnds to_finite_ends(int dimension, const double* from, const double* to, size_t count, size_t stride_bytes) {
  const PointArray starts = to_points(dimension, from, count, stride_bytes, "from");
  if (count != 0) require(to, "to");
  const PointArray ends = {to, starts.step};
  const bool dense = starts.step == static_cast<size_t>(dimension);
  if (!dense || !all_finite({from, to}, count * starts.step)) {
    check_finite(starts, count, dimension, {"from", true});
    check_finite(ends, count, dimension, {"to", true});
  }
  return {starts, ends};
}

PointArray to_finite_point(int dimension, const double* point, const char* name) {
  const PointArray one = to_points(dimension, point, 1, 0, name);
  check_finite(one, 1, dimension, name);
  return one;
}

}  // namespace dsw
