#pragma once
// Obstacles near a simplex of a body, and their faces, edges and vertices, each once.

#include "base/points.h"
#include "corridor/candidates.h"
#include "environment/environment.h"
#include "proximity/sphere.h"

namespace dsw {

/** A triangle, an edge or a vertex of obstacles. Vertices are numbered as in the list. */
struct NearFeature {
  uint32_t corners[3];  // the first `count`, ascending
  uint32_t count;
  uint32_t around, around_end;  // see NearList::around
  bool has_fans;                // walls may part the cells at it into fans that have different obstacles (PassableFan)
  bool is_counted = false;      // has_fans is not a guess
};

/** The obstacles at a feature, and what is known of the cells there. Found when a row names its wall for the first time, and
 * right for as long as the list. */
struct ObstaclesAtFeature {
  uint32_t begin = 0, count = 0;  // among NearList::obstacles_at; 0: not found yet, as each feature has an obstacle
  bool is_one_wall = false;       // all are sides of one wall
  Cell from, to;                  // one fan has both (PassableFan); invalid: nothing is known
};

/** Whether an obstacle has all corners of a feature. */
inline bool has_all(const WallFeature& obstacle, const NearFeature& f) noexcept {
  uint32_t shared = 0;
  for (uint32_t i = 0; i < obstacle.count; ++i) {
    for (uint32_t k = 0; k < f.count; ++k) shared += obstacle.vertices[i] == f.corners[k];
  }
  return shared == f.count;
}

template <int D>
class NearList {
 public:
  explicit NearList(const Memory* memory)
      : obstacles_(memory),
        vertices_(memory),
        first_at_(memory),
        at_(memory),
        points_(memory),
        features_(memory),
        edges_(memory),
        triangles_(memory),
        around_(memory),
        spheres_(memory),
        known_(memory),
        known_at_(memory) {}

  bool empty() const noexcept { return obstacles_.empty(); }
  void clear() noexcept;
  void add(const WallFeature& obstacle) { obstacles_.push_back(obstacle); }
  /** Once all are added. `points` of their vertices are copied. Throws std::bad_alloc.
   * @param has_features false: the list has obstacles and their points alone. */
  void finish(PointArray points, bool has_features = true);

  /** Vertices, then edges, then triangles. */
  const Array<NearFeature>& features() const noexcept { return features_; }
  /** Notes what was found of a feature, for as long as the list is right. */
  void set_fans(uint32_t feature, bool has_fans) const noexcept {
    features_[feature].has_fans = has_fans;
    features_[feature].is_counted = true;
  }
  const Array<WallFeature>& obstacles() const noexcept { return obstacles_; }
  /** Round each feature; round each obstacle if the list has no features. */
  const Array<Sphere<D>>& spheres() const noexcept { return spheres_; }
  uint32_t vertex_count() const noexcept { return static_cast<uint32_t>(vertices_.size()); }
  /** What the environment, or the body, calls a vertex of the list. Ascending. */
  uint32_t name(uint32_t vertex) const noexcept { return vertices_[vertex]; }
  const double* point(uint32_t vertex) const noexcept { return points_.data() + size_t{vertex} * D; }
  /** The other vertices of obstacles that have all corners of a feature. */
  const uint32_t* around(const NearFeature& f) const noexcept { return around_.data() + f.around; }
  const uint32_t* around_end(const NearFeature& f) const noexcept { return around_.data() + f.around_end; }
  /** Calls visit(number) for the obstacles that have all corners of a feature. There is at least one. */
  template <class Visit>
  void for_each_obstacle(const NearFeature& f, Visit visit) const {
    for (uint32_t i = first_at_[f.corners[0]]; i < first_at_[f.corners[0] + 1]; ++i) {
      if (has_all(obstacles_[at_[i]], f)) visit(at_[i]);
    }
  }
  /** A note of the obstacles at a feature. It may be changed as long as the list is right, and is valid until the list is
   * cleared. Throws std::bad_alloc. */
  ObstaclesAtFeature& known_of(uint32_t feature) const {
    if (known_.size() != features_.size()) known_.resize(features_.size());
    return known_[feature];
  }
  /** Numbers of the obstacles that the notes have. */
  Array<uint32_t>& obstacles_at() const noexcept { return known_at_; }
  uint64_t memory_bytes() const {
    return array_bytes(obstacles_) + array_bytes(vertices_) + array_bytes(first_at_) + array_bytes(at_) +
           array_bytes(points_) + array_bytes(features_) + array_bytes(edges_) + array_bytes(triangles_) +
           array_bytes(around_) + array_bytes(spheres_) + array_bytes(known_) + array_bytes(known_at_);
  }

 private:
  void number_vertices(PointArray points);
  void add_features_at(uint32_t vertex);
  Sphere<D> sphere_round(const uint32_t* vertices, uint32_t count) const noexcept;

  Array<WallFeature> obstacles_;
  Array<uint32_t> vertices_;
  Array<uint32_t> first_at_, at_;  // the obstacles at each vertex: at_[first_at_[v] .. first_at_[v + 1] - 1]
  Array<double> points_;
  mutable Array<NearFeature> features_;   // see set_fans
  Array<NearFeature> edges_, triangles_;  // until the list is finished
  Array<uint32_t> around_;
  Array<Sphere<D>> spheres_;
  mutable Array<ObstaclesAtFeature> known_;  // of each feature, or empty
  mutable Array<uint32_t> known_at_;
};

}  // namespace dsw
