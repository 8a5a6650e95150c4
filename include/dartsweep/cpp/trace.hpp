// A trace: geometry for viewers.
#pragma once

#include "dartsweep/cpp/environment.hpp"

namespace dartsweep {

class Trace {
 public:
  Trace() {
    dsw_trace *made = nullptr;
    check(dsw_trace_create(nullptr, &made));
    handle_ = {made, dsw_trace_destroy};
  }

  void clear() {
    const Writing hold(mutex_);
    check(dsw_trace_clear(handle_.get()));
  }
  void add_volumes(const Environment &environment, View<const dsw_volume_id> volumes,
                   std::uint32_t label = 0) {
    const EnvironmentReading source(*environment.state());
    const Writing hold(mutex_);
    check(dsw_trace_add_volumes(handle_.get(), source.handle, volumes.data, volumes.count, label));
  }
  void add_impassable(const Environment &environment, bool with_boundary, std::uint32_t label = 0) {
    const EnvironmentReading source(*environment.state());
    const Writing hold(mutex_);
    check(dsw_trace_add_impassable(handle_.get(), source.handle, with_boundary, label));
  }
  void add_walk(const Environment &environment, const Point &from, const Point &to,
                double normal_length, std::uint32_t label = 0, dsw_volume_id start = {},
                const dsw_cast_options *options = nullptr) {
    const EnvironmentReading source(*environment.state());
    const Writing hold(mutex_);
    check(dsw_trace_add_walk(
        handle_.get(), source.handle, start, in_dimension(environment.dimension(), from),
        in_dimension(environment.dimension(), to), options, normal_length, label));
  }
  void add_contact(const dsw_flight &flight, double normal_length, std::uint32_t label = 0) {
    const Writing hold(mutex_);
    check(dsw_trace_add_contact(handle_.get(), &flight, normal_length, label));
  }

  // Copies. A point has 3 doubles, in the plane, too. A vertex, a segment and a triangle have 1, 2
  // and 3 indices.
  Array<double> get_points() const {
    return copy<double>(&dsw_trace_data::points, &dsw_trace_data::point_count, 3);
  }
  Array<std::uint32_t> get_vertices() const {
    return copy<std::uint32_t>(&dsw_trace_data::vertices, &dsw_trace_data::vertex_count, 1);
  }
  Array<std::uint32_t> get_vertex_labels() const {
    return copy<std::uint32_t>(&dsw_trace_data::vertex_labels, &dsw_trace_data::vertex_count, 1);
  }
  Array<std::uint32_t> get_segments() const {
    return copy<std::uint32_t>(&dsw_trace_data::segments, &dsw_trace_data::segment_count, 2);
  }
  Array<std::uint32_t> get_segment_labels() const {
    return copy<std::uint32_t>(&dsw_trace_data::segment_labels, &dsw_trace_data::segment_count, 1);
  }
  Array<std::uint32_t> get_triangles() const {
    return copy<std::uint32_t>(&dsw_trace_data::triangles, &dsw_trace_data::triangle_count, 3);
  }
  Array<std::uint32_t> get_triangle_labels() const {
    return copy<std::uint32_t>(&dsw_trace_data::triangle_labels, &dsw_trace_data::triangle_count,
                               1);
  }

 private:
  template <class T>
  Array<T> copy(const T *dsw_trace_data::*array, std::size_t dsw_trace_data::*count,
                std::size_t width) const {
    const Reading hold(mutex_);
    dsw_trace_data data = {};
    data.struct_size = sizeof data;
    check(dsw_trace_get_data(handle_.get(), &data));
    return Array<T>(data.*array, width * data.*count);
  }

  std::unique_ptr<dsw_trace, dsw_status (*)(dsw_trace *)> handle_{nullptr, dsw_trace_destroy};
  mutable Mutex mutex_;
};

}  // namespace dartsweep
