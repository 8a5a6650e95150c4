// Arrays on their way between a host and the library. Typemaps go by these types, not by the names of arguments.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "common/error.h"

namespace dartsweep {

// Elements that the host lends for a call, packed: View<const T> is read, View<T> is written. Null and 0 where an array is left out.
template <class T>
struct View {
  T *data = nullptr;
  std::size_t count = 0;
};

// Points that are read. A host gives numbers, as many to a point as the environment has dimensions, or, where `columns` is not 0, rows of
// so many, stride_bytes apart; see count_points.
struct Points {
  const double *data = nullptr;
  std::size_t count = 0;
  std::size_t columns = 0;
  std::size_t stride_bytes = 0;
};

// Points that are written, packed.
struct PointsOut {
  double *data = nullptr;
  std::size_t count = 0;
  std::size_t columns = 0;
};

// One point, with as many coordinates as there are dimensions. In the plane it may have a third that is 0, as points in structs have.
struct Point {
  Point() = default;
  Point(double x, double y) : at{x, y, 0}, size(2) {}
  Point(double x, double y, double z) : at{x, y, z} {}
  Point(const double *coordinates, std::uint32_t count) : size(count) {
    for (std::uint32_t i = 0; i < count; ++i) at[i] = coordinates[i];
  }

  double at[3] = {};
  std::uint32_t size = 3;
};

// Signed integers of 4 or 8 bytes, as mesh libraries have them.
struct Indices {
  const void *data = nullptr;
  std::size_t count = 0;
  std::uint32_t bytes = 8;
};

// An array of points that the library keeps after the call: `owner` holds it for as long.
struct Lent {
  double *data = nullptr;
  std::size_t count = 0;
  std::size_t columns = 0;
  std::shared_ptr<void> owner;
};

// Elements that a call gives to the host. Moved, never copied; not set to zero first, since all are written.
template <class T>
class Array {
 public:
  Array() = default;
  explicit Array(std::size_t count) : data_(count ? new T[count] : nullptr), count_(count) {}
  Array(const T *source, std::size_t count) : Array(count) {
    for (std::size_t i = 0; i < count; ++i) data_[i] = source[i];
  }
  std::size_t size() const { return count_; }
  T get(std::size_t index) const {
    if (index >= count_) throw Error(DSW_STATUS_OUT_OF_RANGE, "index beyond the array");
    return data_[index];
  }
  T *data() { return data_.get(); }
  T *release() { return data_.release(); }  // For hosts that take the memory over; delete[] it.

 private:
  std::unique_ptr<T[]> data_;
  std::size_t count_ = 0;
};

// Arrays that belong together must be of one length.
inline void same_count(const char *name, std::size_t count, std::size_t expected) {
  if (count == expected) return;
  throw Error(DSW_STATUS_WRONG_SIZE,
              std::string(name) + " has " + std::to_string(count) + " entries, not " + std::to_string(expected));
}

// An empty array may have an address, which C would take for one that is there: it is left out.
template <class... Arrays>
void leave_out_empty(Arrays &...arrays) {
  ((arrays.data = arrays.count != 0 ? arrays.data : nullptr), ...);
}

// Of one length with the others, or left out.
template <class Elements>
void optional_count(const char *name, Elements &array, std::size_t expected) {
  leave_out_empty(array);
  if (array.count != 0) same_count(name, array.count, expected);
}

[[noreturn]] inline void refuse_point(std::uint32_t dimension, const std::string &given) {
  throw Error(
      DSW_STATUS_WRONG_SIZE,
      (dimension == 2 ? "a point of the plane has 2 coordinates" : "a point of space has 3 coordinates") + given);
}

inline const double *in_dimension(std::uint32_t dimension, const Point &point) {
  if (point.size != dimension && !(dimension == 2 && point.at[2] == 0))
    refuse_point(dimension, dimension == 2 ? ", or a third that is 0" : ", not 2");
  return point.at;
}

// Makes rows of what a host gave as numbers.
template <class Array>
void count_rows(std::uint32_t dimension, Array &array) {
  const bool counted = array.columns == dimension || array.count == 0;
  if (!counted && array.columns != 0) refuse_point(dimension, ", not " + std::to_string(array.columns));
  if (!counted && array.count % dimension != 0)
    refuse_point(dimension, "; " + std::to_string(array.count) + " numbers are no points");
  if (!counted) array.count /= dimension;
  array.columns = dimension;
}
inline void count_rows(std::uint32_t dimension, Points &array) {
  if (array.stride_bytes == 0) array.stride_bytes = dimension * sizeof(double);
  count_rows<Points>(dimension, array);
}
template <class... Arrays>
void count_points(std::uint32_t dimension, Arrays &...arrays) {
  (count_rows(dimension, arrays), ...);
}

inline std::size_t common_stride(const Points &a, const Points &b) {
  if (a.stride_bytes == b.stride_bytes || b.count == 0) return a.stride_bytes;
  throw Error(DSW_STATUS_WRONG_SIZE, "arrays of points have different strides");
}

}  // namespace dartsweep
