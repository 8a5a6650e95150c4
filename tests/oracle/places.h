// Where bodies and swept edges are put and sent, in either dimension: with a bias to everything that is exactly on
// something.
#pragma once

#include "mesh.h"
#include "rng.h"

namespace dsw::oracle {

class Places {
 public:
  /// `size` of what is there. In the plane the third coordinate is 0.
  Places(size_t dimension, double size, Rng& rng) : dimension_(dimension), size_(size), rng_(rng) {}
  virtual ~Places() = default;

  virtual Vec start() = 0;
  virtual Vec site() = 0;
  Vec target(const Vec& from);
  Vec near(const Vec& from, double share);
  /// On an axis through a point; `share` of the size away at the most.
  Vec along_axis(const Vec& from, double share);
  uint32_t any_axis() { return rng_.below(dimension_); }

  /// A place at something small that is impassable; `exactly`: how often it is a vertex.
  virtual Vec obstacle(double /*exactly*/) { return site(); }
  /// A place at something impassable to put a small triangle round, with two directions for it. True: exactly on it.
  virtual bool round_obstacle(Vec& site, std::array<Vec, 2>& span);
  /// On the rim of something impassable.
  virtual Vec anchor() { return site(); }

 protected:
  virtual Vec vertex() = 0;
  /// The ends of an edge or a diagonal of the mesh.
  virtual std::array<Vec, 2> ends() = 0;

  const size_t dimension_;
  const double size_;
  Rng& rng_;

 private:
  Vec any_target(const Vec& from);
};

Vec between(const Vec& a, const Vec& b, double by);
bool finite(const Vec& p);

}  // namespace dsw::oracle
