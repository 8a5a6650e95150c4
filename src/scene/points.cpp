#include "scene/points.h"

#include <cmath>
#include <cstdio>

namespace dsw {
namespace {

bool is_finite(const double* point, int dimension) noexcept {
  for (int k = 0; k < dimension; ++k) {
    if (!std::isfinite(point[k])) return false;
  }
  return true;
}

/** One streaming pass without branches: x - x is 0 for a finite x and NaN for any other. */
bool all_finite(const double* values, size_t count) noexcept {
  constexpr size_t kLanes = 8;
  double sum[kLanes] = {};
  size_t i = 0;
  for (; i + kLanes <= count; i += kLanes) {
    for (size_t lane = 0; lane < kLanes; ++lane) sum[lane] += values[i + lane] - values[i + lane];
  }
  double total = 0;
  for (; i < count; ++i) total += values[i] - values[i];
  for (const double lane : sum) total += lane;
  return total == 0;
}

}  // namespace

ElementName::ElementName(ArgumentName argument, size_t index) noexcept {
  if (argument.indexed) {
    std::snprintf(text, sizeof text, "%s[%zu]", argument.name, index);
  } else {
    std::snprintf(text, sizeof text, "%s", argument.name);
  }
}

size_t find_non_finite(PointArray points, size_t count, int dimension) noexcept {
  const bool dense = points.step == static_cast<size_t>(dimension);
  if (count == 0 || (dense && all_finite(points.data, count * points.step))) return count;
  for (size_t i = 0; i < count; ++i) {
    if (!is_finite(points[i], dimension)) return i;
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

}  // namespace dsw
