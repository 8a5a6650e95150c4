#include "snapshot/trace.h"

#include <algorithm>

#include "base/dimensions.h"
#include "base/error.h"
#include "base/position.h"
#include "base/slot_pool.h"
#include "environment/marking.h"
#include "map/dart.h"

namespace dsw {
namespace {

/** Adds to a trace and takes everything back unless kept. */
class Addition {
 public:
  Addition(Trace& trace, uint32_t label)
      : trace_(trace),
        label_(label),
        points_(trace.points.size()),
        vertices_(trace.vertex_labels.size()),
        segments_(trace.segment_labels.size()),
        triangles_(trace.triangle_labels.size()) {}
  ~Addition() {
    if (!kept_) cut_to(points_, vertices_, segments_, triangles_);
  }
  Addition(const Addition&) = delete;
  Addition& operator=(const Addition&) = delete;

  /** Adds a point; a point of the plane gets 0 as its third coordinate. */
  template <int D>
  uint32_t point(const double* p) {
    const size_t index = trace_.point_count();
    if (index >= UINT32_MAX) fail(DSW_STATUS_TOO_LARGE, "a trace holds at most 2^32 - 1 points");
    reserve_more(trace_.points, 3);
    trace_.points.insert(trace_.points.end(), p, p + D);
    trace_.points.insert(trace_.points.end(), 3 - D, 0.0);
    return static_cast<uint32_t>(index);
  }
  void dot(uint32_t a) { primitive(trace_.vertices, trace_.vertex_labels, {a}); }
  void segment(uint32_t a, uint32_t b) { primitive(trace_.segments, trace_.segment_labels, {a, b}); }
  void triangle(uint32_t a, uint32_t b, uint32_t c) { primitive(trace_.triangles, trace_.triangle_labels, {a, b, c}); }
  void keep() noexcept { kept_ = true; }

 private:
  void primitive(Array<uint32_t>& indices, Array<uint32_t>& labels, std::initializer_list<uint32_t> points) {
    reserve_more(indices, points.size());
    labels.push_back(label_);
    indices.insert(indices.end(), points.begin(), points.end());
  }
  void cut_to(size_t points, size_t vertices, size_t segments, size_t triangles) noexcept {
    trace_.points.resize(points);
    trace_.vertices.resize(vertices);
    trace_.vertex_labels.resize(vertices);
    trace_.segments.resize(2 * segments);
    trace_.segment_labels.resize(segments);
    trace_.triangles.resize(3 * triangles);
    trace_.triangle_labels.resize(triangles);
  }

  Trace& trace_;
  uint32_t label_;
  size_t points_, vertices_, segments_, triangles_;
  bool kept_ = false;
};

/** Points of one addition, each added once. */
template <int D>
class SharedPoints {
 public:
  SharedPoints(Addition& addition, const Environment<D>& env)
      : addition_(addition), env_(env), index_(env.map.vertex_count, kNone, env.memory) {}
  uint32_t operator[](uint32_t vertex) {
    if (index_[vertex] == kNone) index_[vertex] = addition_.point<D>(env_.point(vertex));
    return index_[vertex];
  }

 private:
  static constexpr uint32_t kNone = UINT32_MAX;
  Addition& addition_;
  const Environment<D>& env_;
  Array<uint32_t> index_;
};

/** Adds simplices `begin` .. `end` - 1 of a cell: triangles, or the segments that sides are; `point` gives the trace's
 * point of a local vertex. */
template <int D, class Point>
void add_simplices(Addition& addition, const Shape& shape, uint32_t begin, uint32_t end, const Point& point) {
  for (uint32_t s = begin; s < end; ++s) {
    const uint16_t* local = shape.simplices() + static_cast<uint32_t>(D) * s;
    const uint32_t a = point(local[0]), b = point(local[1]);
    if constexpr (D == 3) {
      addition.triangle(a, b, point(local[2]));
    } else {
      addition.segment(a, b);
    }
  }
}

/** A marked facet between two passable cells is added from its canonical side only. */
template <int D>
bool is_shown(const Environment<D>& env, HalfFacet h, bool with_boundary) {
  if (!is_impassable(env, h)) return false;
  const HalfFacet o = env.map.opposite(h);
  if (!o.valid()) return with_boundary;
  return is_closed(env, env.map.cell_of(o)) || canonical(env.map, h) == h;
}

void add_contact(Addition& addition, const dsw_flight& flight, double normal_length) {
  if (flight.outcome != DSW_OUTCOME_CONTACT) return;
  double end[3];
  for (int k = 0; k < 3; ++k) end[k] = flight.position[k] + normal_length * flight.contact.normal[k];
  const uint32_t a = addition.point<3>(flight.position);
  addition.dot(a);
  addition.segment(a, addition.point<3>(end));
}

}  // namespace

void clear(Trace& trace) noexcept {
  trace.points.clear();
  trace.vertices.clear();
  trace.vertex_labels.clear();
  trace.segments.clear();
  trace.segment_labels.clear();
  trace.triangles.clear();
  trace.triangle_labels.clear();
}

template <int D>
void add_cells(Trace& trace, const Environment<D>& env, const Cell* cells, size_t count, uint32_t label) {
  Addition addition(trace, label);
  Array<uint32_t> points{trace.memory()};
  for (size_t i = 0; i < count; ++i) {
    const Shape shape = env.map.shape(cells[i]);
    points.clear();
    for (uint32_t k = 0; k < shape.vertex_count(); ++k) points.push_back(addition.point<D>(env.point(cells[i], k)));
    add_simplices<D>(addition, shape, 0, shape.simplex_count(), [&](uint32_t local) { return points[local]; });
  }
  addition.keep();
}

template <int D>
void add_impassable(Trace& trace, const Environment<D>& env, bool with_boundary, uint32_t label) {
  const Map<D>& map = env.map;
  Addition addition(trace, label);
  SharedPoints<D> points(addition, env);
  Array<uint64_t> edges{env.memory};
  edges.reserve(env.edge_marks.size());
  env.edge_marks.copy_sorted(edges);
  Array<uint8_t> edge_shown(edges.size(), 0, env.memory);
  Array<uint8_t> vertex_shown(env.marked_vertices == 0 ? 0 : map.vertex_count, 0, env.memory);
  for_each_cell(map, [&](Cell c) {
    if (is_closed(env, c)) return;
    const Shape shape = map.shape(c);
    for (uint32_t f = 0; f < shape.facet_count(); ++f) {
      if (!is_shown(env, map.half_facet(c, f), with_boundary)) continue;
      add_simplices<D>(addition, shape, shape.simplex_first(f), shape.simplex_first(f + 1),
                       [&](uint32_t local) { return points[map.vertex(c, local)]; });
    }
    for (uint32_t d = 0; !edges.empty() && d < shape.dart_count(); ++d) {
      const uint64_t a = dart_vertex(map, {c, d}), b = dart_target(map, {c, d});
      const uint64_t key = std::min(a, b) << 32 | std::max(a, b);
      const auto at = std::lower_bound(edges.begin(), edges.end(), key);
      if (at != edges.end() && *at == key) edge_shown[static_cast<size_t>(at - edges.begin())] = 1;
    }
    for (uint32_t k = 0; !vertex_shown.empty() && k < shape.vertex_count(); ++k) {
      const uint32_t v = map.vertex(c, k);
      if (vertex_marked(env, v)) vertex_shown[v] = 1;
    }
  });
  for (size_t e = 0; e < edges.size(); ++e) {
    if (edge_shown[e] == 0) continue;
    const uint32_t a = points[static_cast<uint32_t>(edges[e] >> 32)];
    addition.segment(a, points[static_cast<uint32_t>(edges[e])]);
  }
  for (uint32_t v = 0; v < vertex_shown.size(); ++v) {
    if (vertex_shown[v] != 0) addition.dot(points[v]);
  }
  addition.keep();
}

template <int D>
void add_walk(Trace& trace, const Environment<D>& env, dsw_volume_id start, const double* from, const double* to,
              const SegmentOptions& options, double normal_length, uint32_t label) {
  SegmentOptions detailed = options;
  detailed.detail = true;  // a walk without times and places could not be drawn
  dsw_flight flight{};
  size_t count = 0;
  cast_path(env, start, from, to, detailed, nullptr, 0, &count, &flight);
  if (count == 0) return;
  Array<dsw_crossing> crossings(count, dsw_crossing{}, trace.memory());
  cast_path(env, start, from, to, detailed, crossings.data(), count, &count, &flight);

  Addition addition(trace, label);
  uint32_t last = 0;
  for (size_t i = 0; i < count; ++i) {
    double p[D];
    point_at<D>(from, to, crossings[i].time, p);
    const uint32_t next = addition.point<D>(p);
    addition.dot(next);
    if (i != 0) addition.segment(last, next);
    last = next;
  }
  addition.segment(last, addition.point<3>(flight.position));
  add_contact(addition, flight, normal_length);
  addition.keep();
}

void add_contact(Trace& trace, const dsw_flight& flight, double normal_length, uint32_t label) {
  Addition addition(trace, label);
  add_contact(addition, flight, normal_length);
  addition.keep();
}

DSW_INSTANTIATE(add_cells);
DSW_INSTANTIATE(add_impassable);
DSW_INSTANTIATE(add_walk);

}  // namespace dsw
