// The brute-force answer in space: see exact.h.
#pragma once

#include "exact.h"
#include "world.h"

namespace dsw::oracle {

class SweepWorld : public ExactSweeps {
 public:
  /// Marks must be set; `marked_edges` are pairs of vertices, `marked` are vertices. `world` must outlive this.
  SweepWorld(World& world, const std::vector<std::array<int, 2>>& marked_edges, const std::vector<int>& marked = {});
  int locate(const Vec& p) override { return world_.locate(world_.body(p.data())); }
  using ExactSweeps::blocked;
  bool blocked(const Vec& x, const Vec& y, const Vec& z) override;

 private:
  struct Normal {
    int triangle;
    Box box;
    Point n;
  };
  struct Edge {
    int a, b;
    Box box;
  };

  Big line_value(size_t x, size_t y, int a, int b);
  Point line_shift(size_t x, size_t y, int a, int b);
  int line_sign(size_t x, size_t y, int a, int b);
  Shifted line(size_t x, size_t y, int a, int b);
  Point normal(size_t x, size_t y, size_t z) const;
  Shifted plane(const Point& normal, size_t on, int vertex);
  int plane_sign(const Point& normal, size_t on, int vertex);
  int pierce(size_t x, size_t y, const Normal& t);
  bool any_pierced(size_t x, size_t y) override;
  int goes_through(const Edge& edge, size_t x, size_t y, size_t z, const Point& normal);
  void add_path_events(std::vector<SweepEvent>& events) override;
  void add_edge_events(size_t edge, std::vector<SweepEvent>& events) override;
  void add_face_events(size_t face, const std::array<size_t, 2>& ends, std::vector<SweepEvent>& events) override;

  World& world_;
  std::vector<Normal> normals_;
  std::vector<Edge> edges_;
};

}  // namespace dsw::oracle
