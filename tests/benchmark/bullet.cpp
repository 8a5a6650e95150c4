#include "bullet.h"

#include "bullet_casts.h"

namespace dsw::bench {

namespace {

class Bullet : public Engine {
 public:
  Bullet(std::string name, const WallMesh& walls) : Engine(std::move(name)), walls_(walls) {
    // Only the points that walls have, in the order of the walls.
    std::vector<int> renumbered(walls.points->size() / 3, -1);
    for (const auto& triangle : walls.triangles) {
      for (const std::uint32_t vertex : triangle) {
        if (renumbered[vertex] < 0) {
          renumbered[vertex] = static_cast<int>(vertices_.size());
          vertices_.push_back(to_bullet(walls.point(vertex)));
        }
        indices_.push_back(renumbered[vertex]);
      }
    }
  }

  void prepare(const Segments& segments) override { casts_.prepare(segments); }
  Answer answer(std::size_t i) const override { return casts_.answer(i, walls_); }

 protected:
  const WallMesh& walls_;
  std::vector<btVector3> vertices_;
  std::vector<int> indices_;  // 3 a triangle
  BulletCasts casts_;
};

class BulletMesh final : public Bullet {
 public:
  BulletMesh(std::string name, const WallMesh& walls, bool quantized, bool box)
      : Bullet(std::move(name), walls), box_(box) {
    mesh_ = std::make_unique<btTriangleIndexVertexArray>(
        static_cast<int>(walls.triangles.size()), indices_.data(), static_cast<int>(3 * sizeof(int)),
        static_cast<int>(vertices_.size()), vertices_.front().m_floats, static_cast<int>(sizeof(btVector3)));
    shape_ = std::make_unique<btBvhTriangleMeshShape>(mesh_.get(), quantized);
  }

  void run(std::size_t first, std::size_t count) override { casts_.run(*shape_, box_, first, count); }

 private:
  bool box_;
  std::unique_ptr<btTriangleIndexVertexArray> mesh_;
  std::unique_ptr<btBvhTriangleMeshShape> shape_;
};

class BulletTree final : public Bullet {
 public:
  BulletTree(std::string name, const WallMesh& walls, bool box) : Bullet(std::move(name), walls), box_(box) {
    for (std::size_t i = 0; i < walls.triangles.size(); ++i) {
      btVector3 corners[3];
      for (std::size_t k = 0; k < 3; ++k) corners[k] = vertices_[static_cast<std::size_t>(indices_[3 * i + k])];
      triangles_.insert(triangles_.end(), corners, corners + 3);
      tree_.insert(btDbvtVolume::FromPoints(corners, 3), reinterpret_cast<void*>(i));
    }
    tree_.optimizeTopDown();
  }

  void run(std::size_t first, std::size_t count) override {
    casts_.run(tree_, box_, first, count,
               [this](std::size_t triangle, btVector3*) { return triangles_.data() + 3 * triangle; });
  }

 private:
  bool box_;
  btDbvt tree_;
  std::vector<btVector3> triangles_;
};

}  // namespace

std::unique_ptr<Engine> make_bullet(BulletKind kind, const WallMesh& walls) {
  switch (kind) {
    case BulletKind::kQuantizedRay:
      return std::make_unique<BulletMesh>("bullet, quantized BVH, ray", walls, true, false);
    case BulletKind::kPlainRay:
      return std::make_unique<BulletMesh>("bullet, float BVH, ray", walls, false, false);
    case BulletKind::kQuantizedBox:
      return std::make_unique<BulletMesh>("bullet, quantized BVH, box", walls, true, true);
    case BulletKind::kTreeRay:
      return std::make_unique<BulletTree>("bullet, btDbvt, ray", walls, false);
    default:
      return std::make_unique<BulletTree>("bullet, btDbvt, box", walls, true);
  }
}

std::vector<std::unique_ptr<Engine>> make_bullets(const WallMesh& walls, bool box) {
  const auto kinds =
      box ? std::vector<BulletKind>{BulletKind::kQuantizedBox, BulletKind::kTreeBox}
          : std::vector<BulletKind>{BulletKind::kQuantizedRay, BulletKind::kPlainRay, BulletKind::kTreeRay};
  std::vector<std::unique_ptr<Engine>> engines;
  for (const BulletKind kind : kinds) engines.push_back(make_bullet(kind, walls));
  return engines;
}

}  // namespace dsw::bench
