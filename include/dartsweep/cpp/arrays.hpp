// Arrays as arguments and results. Arguments are spans: they point into the caller's memory and are
// made from vectors, arrays, or a pointer and a count. Results own their memory.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>

#include "dartsweep/cpp/error.hpp"
#include "dartsweep/environment.h"
#include "dartsweep/ids.h"

namespace dartsweep {

/** A point as a value. In the plane z is 0. */
struct Vec3 {
  double x, y, z;
};

#ifndef SWIG
/** How many doubles a type of points holds, and nothing else; 0 for other types. Specialise
 * columns_of for vectors of your own: std::vector<Vector3d> is then an array of points. */
template <class T>
struct columns_of : std::integral_constant<std::size_t, 0> {};
template <class T>
struct columns_of<const T> : columns_of<T> {};
template <std::size_t N>
struct columns_of<std::array<double, N>> : std::integral_constant<std::size_t, N> {};
template <>
struct columns_of<Vec3> : std::integral_constant<std::size_t, 3> {};

/** The type of the elements of a container with data() and size(). */
template <class Container>
using element_of = std::remove_pointer_t<decltype(std::declval<Container &>().data())>;
#endif

/** Elements in a row that a call reads (View<const T>) or writes (View<T>). Without elements the
 * array is left out. */
template <class T>
struct View {
  View() = default;
  View(T *first, std::size_t size) : data(first), count(size) {}
#ifndef SWIG
  template <class Container,
            class = std::enable_if_t<std::is_convertible_v<element_of<Container> (*)[], T (*)[]>>>
  View(Container &&from) : View(from.data(), from.size()) {}
  T *begin() const { return data; }
  T *end() const { return data + count; }
  T &operator[](std::size_t index) const { return data[index]; }
#endif

  T *data = nullptr;
  std::size_t count = 0;
};

/** Points that a call reads: an array of numbers, as many to a point as the environment has
 * dimensions, or of rows: `columns` numbers each, stride_bytes apart. */
struct Points {
  Points() = default;
  Points(const double *first, std::size_t size, std::size_t columns_ = 0, std::size_t stride = 0)
      : data(first), count(size), columns(columns_), stride_bytes(stride) {}
#ifndef SWIG
  template <class Container, class = std::enable_if_t<std::is_convertible_v<
                                 element_of<Container> (*)[], const double (*)[]>>>
  Points(const Container &numbers) : Points(numbers.data(), numbers.size()) {}
  template <class Container, std::size_t N = columns_of<element_of<Container>>::value,
            class = std::enable_if_t<N != 0>, class = void>
  Points(const Container &rows)
      : Points(reinterpret_cast<const double *>(rows.data()), rows.size(), N,
               sizeof(element_of<Container>)) {}
#endif

  const double *data = nullptr;
  std::size_t count = 0;
  std::size_t columns = 0;
  std::size_t stride_bytes = 0;
};

/** Points that a call writes, packed; as Points. */
struct PointsOut {
  PointsOut() = default;
  PointsOut(double *first, std::size_t size, std::size_t columns_ = 0)
      : data(first), count(size), columns(columns_) {}
#ifndef SWIG
  template <class Container, class = std::enable_if_t<
                                 std::is_convertible_v<element_of<Container> (*)[], double (*)[]>>>
  PointsOut(Container &numbers) : PointsOut(numbers.data(), numbers.size()) {}
  template <class Container, std::size_t N = columns_of<element_of<Container>>::value,
            class = std::enable_if_t<N != 0>, class = void>
  PointsOut(Container &rows) : PointsOut(reinterpret_cast<double *>(rows.data()), rows.size(), N) {
    static_assert(sizeof(element_of<Container>) == N * sizeof(double), "points are written packed");
  }
#endif

  double *data = nullptr;
  std::size_t count = 0;
  std::size_t columns = 0;
};

/** One point: as many coordinates as there are dimensions. In the plane a third one may be there,
 * which is 0. */
struct Point {
  Point() = default;
#ifndef SWIG
  template <std::size_t N>
  Point(const std::array<double, N> &coordinates) : Point(coordinates.data(), N) {
    static_assert(N == 2 || N == 3, "a point has 2 or 3 coordinates");
  }
  Point(const Vec3 &v) : Point(v.x, v.y, v.z) {}
#endif
  Point(double x, double y) : at{x, y, 0}, size(2) {}
  Point(double x, double y, double z) : at{x, y, z} {}
  Point(const double *coordinates, std::uint32_t count) : size(count) {
    for (std::uint32_t i = 0; i < count; ++i) at[i] = coordinates[i];
  }

#ifndef SWIG
  double operator[](std::size_t axis) const { return at[axis]; }
#endif

  double at[3] = {};
  std::uint32_t size = 3;
};

/** Integers of 4 or 8 bytes that are not negative. */
struct Indices {
  Indices() = default;
  Indices(const void *first, std::size_t size, std::uint32_t bytes_ = 8)
      : data(first), count(size), bytes(bytes_) {}
#ifndef SWIG
  template <class Container, class T = element_of<const Container>,
            class = std::enable_if_t<std::is_integral_v<T> && sizeof(T) >= 4>>
  Indices(const Container &from) : Indices(from.data(), from.size(), sizeof(T)) {}
#endif

  const void *data = nullptr;
  std::size_t count = 0;
  std::uint32_t bytes = 8;
};

/** Points that the library keeps reading after the call. `owner` keeps them alive for as long. */
struct Lent {
  Lent() = default;
  Lent(double *first, std::size_t size, std::size_t columns_, std::shared_ptr<void> keep)
      : data(first), count(size), columns(columns_), owner(std::move(keep)) {}
#ifndef SWIG
  /** A vector of numbers or of points. */
  template <class Container>
  explicit Lent(std::shared_ptr<Container> points) : owner(points) {
    const PointsOut given(*points);
    data = given.data;
    count = given.count;
    columns = given.columns;
  }
#endif

  double *data = nullptr;
  std::size_t count = 0;
  std::size_t columns = 0;
  std::shared_ptr<void> owner;
};

/** The elements that a call gives. They are moved, never copied. */
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
    if (index >= count_) throw OutOfRange("index beyond the array");
    return data_[index];
  }
  T *data() { return data_.get(); }
  /** Gives the memory away: the caller calls delete[]. */
  T *release() { return data_.release(); }
#ifndef SWIG
  const T *data() const { return data_.get(); }
  bool empty() const { return count_ == 0; }
  const T *begin() const { return data(); }
  const T *end() const { return data() + count_; }
  /** Not checked, unlike get(). */
  const T &operator[](std::size_t index) const { return data_[index]; }
#endif

 private:
  std::unique_ptr<T[]> data_;
  std::size_t count_ = 0;
};

// --- how the classes check their arguments

/** Arrays that belong together have one length. */
inline void same_count(const char *name, std::size_t count, std::size_t expected) {
  if (count == expected) return;
  throw WrongSize(std::string(name) + " has " + std::to_string(count) + " entries, not " +
                  std::to_string(expected));
}

/** An empty array may have an address: C would take the array for one that is there. */
template <class... Arrays>
void leave_out_empty(Arrays &...arrays) {
  ((arrays.data = arrays.count != 0 ? arrays.data : nullptr), ...);
}

/** Leaves an empty array out, and throws unless any other has the expected length. */
template <class Elements>
void optional_count(const char *name, Elements &array, std::size_t expected) {
  leave_out_empty(array);
  if (array.count != 0) same_count(name, array.count, expected);
}

/** Checks the arrays of a search for what is nearest to `count` points or segments. */
inline void check_nearest(std::size_t count, View<const dsw_volume_id> &hints,
                          std::size_t nearest_count, View<dsw_volume_id> &volumes,
                          View<std::int32_t> &locations) {
  optional_count("hints", hints, count);
  same_count("nearest", nearest_count, count);
  optional_count("volumes", volumes, count);
  optional_count("locations", locations, count);
}

[[noreturn]] inline void refuse_point(std::uint32_t dimension, const std::string &given) {
  throw WrongSize((dimension == 2 ? "a point of the plane has 2 coordinates"
                                  : "a point of space has 3 coordinates") +
                  given);
}

inline const double *in_dimension(std::uint32_t dimension, const Point &point) {
  if (point.size != dimension && !(dimension == 2 && point.at[2] == 0))
    refuse_point(dimension, dimension == 2 ? ", or a third that is 0" : ", not 2");
  return point.at;
}

/** Makes rows of points that were given as numbers. */
template <class Array>
void count_rows(std::uint32_t dimension, Array &array) {
  const bool counted = array.columns == dimension || array.count == 0;
  if (!counted && array.columns != 0)
    refuse_point(dimension, ", not " + std::to_string(array.columns));
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
  throw WrongSize("arrays of points have different strides");
}

/** How many cells of one type there are. */
inline std::size_t uniform_count(std::uint32_t type, const Indices &connectivity,
                                 const Indices &offsets) {
  if (offsets.count) return offsets.count - 1;
  switch (type) {
    case DSW_CELL_TYPE_TRIANGLE:
      return connectivity.count / 3;
    case DSW_CELL_TYPE_QUAD:
    case DSW_CELL_TYPE_TETRA:
      return connectivity.count / 4;
    case DSW_CELL_TYPE_PYRAMID:
      return connectivity.count / 5;
    case DSW_CELL_TYPE_WEDGE:
      return connectivity.count / 6;
    default:
      return connectivity.count / 8;
  }
}

}  // namespace dartsweep
