// What moves and what stands: points, edges and triangles.
#ifndef DARTSWEEP_TESTS_BENCHMARK_RIGID_FIGURE_H
#define DARTSWEEP_TESTS_BENCHMARK_RIGID_FIGURE_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace dsw::rigid {

/** In the plane the third coordinate is 0. */
using Point = std::array<double, 3>;

inline Point operator+(const Point& a, const Point& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Point operator-(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Point operator*(double s, const Point& a) { return {s * a[0], s * a[1], s * a[2]}; }
inline double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double length(const Point& a) { return std::sqrt(dot(a, a)); }
inline Point unit(const Point& a) { return (1 / length(a)) * a; }

/** Indices of a point, an edge or a triangle. */
struct Part {
  std::array<std::uint32_t, 3> at{};
  std::size_t count = 0;
};

/** Edges of triangles are among the edges, and their corners among the points. */
struct Figure {
  std::vector<Point> points;
  std::vector<Part> vertices, edges, faces;

  void add_vertex(std::uint32_t a) { add(vertices, {{a, 0, 0}, 1}); }
  void add_edge(std::uint32_t a, std::uint32_t b) {
    add_vertex(a);
    add_vertex(b);
    add(edges, {{std::min(a, b), std::max(a, b), 0}, 2});
  }
  void add_face(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    add_edge(a, b);
    add_edge(b, c);
    add_edge(c, a);
    faces.push_back({{a, b, c}, 3});
  }
  /** Adds all of another one. */
  void add(const Figure& other) {
    const auto first = static_cast<std::uint32_t>(points.size());
    points.insert(points.end(), other.points.begin(), other.points.end());
    for (const Part& each : other.vertices) add_vertex(first + each.at[0]);
    for (const Part& each : other.edges) add_edge(first + each.at[0], first + each.at[1]);
    for (const Part& each : other.faces) add_face(first + each.at[0], first + each.at[1], first + each.at[2]);
  }

 private:
  static void add(std::vector<Part>& parts, const Part& part) {
    const auto is_it = [&](const Part& each) { return each.at == part.at; };
    if (std::none_of(parts.begin(), parts.end(), is_it)) parts.push_back(part);
  }
};

}  // namespace dsw::rigid

#endif
