// Walls that come and go as Bullet's triangles.
#ifndef DARTSWEEP_TESTS_BENCHMARK_BULLET_WALLS_H
#define DARTSWEEP_TESTS_BENCHMARK_BULLET_WALLS_H

#include "bullet_casts.h"
#include "embree_change.h"

namespace dsw::bench {

/** Six corners a wall, by slot. */
class BulletWalls {
 public:
  BulletWalls(const WallMesh& walls, std::size_t slots) : walls_(walls), corners(6 * slots, btVector3(0, 0, 0)) {
    for (std::uint32_t id = 0; id < walls.walls.size(); ++id) write(id, walls.walls[id]);
  }

  void write(std::size_t slot, const scenes::Wall& wall) {
    for (std::uint32_t part = 0; part < wall.triangle_count(); ++part) {
      const auto triangle = wall.triangle(part);
      for (std::size_t k = 0; k < 3; ++k) corners[6 * slot + 3 * part + k] = to_bullet(walls_.point(triangle[k]));
    }
  }

  void erase(std::size_t slot) {
    for (std::size_t k = 1; k < 6; ++k) corners[6 * slot + k] = corners[6 * slot];
  }

  void apply(const WallChange& change) {
    for (const auto& item : change.removed) erase(item.id);
    for (const auto& item : change.added) write(item.id, item.wall);
  }

  /** All triangles, three corners each in a row. */
  std::unique_ptr<btTriangleIndexVertexArray> mesh() {
    indices.resize(corners.size());
    for (std::size_t i = 0; i < indices.size(); ++i) indices[i] = static_cast<int>(i);
    return std::make_unique<btTriangleIndexVertexArray>(
        static_cast<int>(indices.size() / 3), indices.data(), static_cast<int>(3 * sizeof(int)),
        static_cast<int>(corners.size()), corners.front().m_floats, static_cast<int>(sizeof(btVector3)));
  }

 private:
  const WallMesh& walls_;

 public:
  std::vector<btVector3> corners;
  std::vector<int> indices;
};

}  // namespace dsw::bench

#endif
