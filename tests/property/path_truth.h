// What the segments of a path in the plane cross, in exact integers.
#pragma once

#include "plane_truth.h"

#include <algorithm>

namespace dsw::oracle {

inline int first_sign(const Big& a, const Big& b, const Big& c) { return a != 0 ? sgn(a) : b != 0 ? sgn(b) : sgn(c); }

/// Segments of a path, shifted by (e, e^2), among the vertices of a world.
class PathTruth {
 public:
  PathTruth(const plane::World& world, const std::vector<plane::Vec>& path) {
    for (const plane::Vec& p : world.points) see(p);
    for (const plane::Vec& p : path) see(p);
    for (const plane::Vec& p : world.points) vertices_.push_back(to(p));
    for (const plane::Vec& p : path) path_.push_back(to(p));
  }
  /// Whether segment k crosses the side from vertex a to b.
  bool crosses(size_t k, int a, int b) const {
    const Place2 &p = path_[k], &q = path_[k + 1];
    if (p.x == q.x && p.y == q.y) return false;
    return left(k, a) != left(k, b) && right_of(at(a), at(b), p) != right_of(at(a), at(b), q);
  }
  /// 1: the vertex is behind segment k, on its left.
  int left(size_t k, int vertex) const {
    const Place2 &p = path_[k], &q = path_[k + 1];
    return first_sign(height(k, vertex), q.y - p.y, p.x - q.x);
  }
  /// The largest double not above the share of the way from a to b at which segment k, not shifted, crosses it.
  double share(size_t k, int a, int b) const {
    const Big from = height(k, a), all = from - height(k, b);
    return from <= 0 || all <= 0 ? 0 : from >= all ? 1 : floor_to_double(from, all);
  }
  /// How often closed lines turn round a point; each of `ends` is that of a segment in the path.
  int turns(const plane::Vec& point, const std::vector<uint32_t>& ends) const {
    const Place2 c = to(point);
    int sum = 0;
    for (size_t i = 0; i < ends.size(); i += 2) {
      const Place2 &p = path_[ends[i]], &q = path_[ends[i + 1]];
      const bool p_above = p.y >= c.y, q_above = q.y >= c.y;  // the shift lifts what is as high
      if (p_above == q_above) continue;
      const Big ux = q.x - p.x, uy = q.y - p.y;
      const Big beside = ux * (c.y - p.y) - uy * (c.x - p.x);  // of the point on the left
      const int side = first_sign(beside, uy, -ux);
      if (q_above && side > 0) ++sum;
      if (p_above && side < 0) --sum;
    }
    return sum;
  }

 private:
  struct Place2 {
    Big x, y;
  };

  Place2 to(const plane::Vec& p) const { return {to_big(p[0], -lowest_), to_big(p[1], -lowest_)}; }
  void see(const plane::Vec& p) { lowest_ = std::min({lowest_, lowest_exponent(p[0]), lowest_exponent(p[1])}); }
  const Place2& at(int vertex) const { return vertices_[static_cast<size_t>(vertex)]; }
  Big height(size_t k, int vertex) const {
    const Place2 &p = path_[k], &q = path_[k + 1], &v = at(vertex);
    return (q.x - p.x) * (v.y - p.y) - (q.y - p.y) * (v.x - p.x);
  }
  static int right_of(const Place2& a, const Place2& b, const Place2& x) {
    const Big dx = b.x - a.x, dy = b.y - a.y;
    return first_sign(dy * (x.x - a.x) - dx * (x.y - a.y), dy, -dx);
  }

  int lowest_ = 0;
  std::vector<Place2> vertices_, path_;
};

}  // namespace dsw::oracle
