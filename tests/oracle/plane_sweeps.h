// The brute-force answer of swept edges in the plane: see exact.h. The shift's third part is never looked at.
#pragma once

#include "exact.h"
#include "plane_truth.h"

namespace dsw::oracle {

class PlaneSweeps : public ExactSweeps {
 public:
  /// Marks must be set; `marked` are vertices. `world` must outlive this.
  explicit PlaneSweeps(const plane::World& world, const std::vector<int>& marked = {});
  int locate(const Vec& p) override { return plane::locate(world_, {p[0], p[1]}); }
  /// Vertices of what is impassable.
  const std::vector<int>& obstacles() const { return obstacles_; }

 private:
  struct Side {
    int side;
    Box box;
  };

  Big area(const Point& x, const Point& y, const Point& z) const;
  Shifted right_of(int a, int b, size_t x);
  int right_of_sign(int a, int b, size_t x);
  Shifted left_of(size_t x, size_t y, int a);
  int left_of_sign(size_t x, size_t y, int a);
  int pierce(size_t x, size_t y, const Side& s);
  bool any_pierced(size_t x, size_t y) override;
  void add_path_events(std::vector<SweepEvent>& events) override;
  void add_edge_events(size_t edge, std::vector<SweepEvent>& events) override;

  const plane::World& world_;
  std::vector<Side> sides_;
  std::vector<int> obstacles_;
};

/// With the third coordinate 0, and back.
inline Vec raised(const plane::Vec& p) { return {p[0], p[1], 0}; }
inline plane::Vec flat(const Vec& p) { return {p[0], p[1]}; }

}  // namespace dsw::oracle
