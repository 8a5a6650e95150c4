#include "bullet.h"

#include <BulletCollision/BroadphaseCollision/btDbvt.h>
#include <BulletCollision/CollisionShapes/btBvhTriangleMeshShape.h>
#include <BulletCollision/CollisionShapes/btTriangleIndexVertexArray.h>
#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>

namespace dsw::bench {

namespace {

btVector3 to_bullet(const double* xyz) {
  return {static_cast<btScalar>(xyz[0]), static_cast<btScalar>(xyz[1]), static_cast<btScalar>(xyz[2])};
}

/** Bullet's own segment/triangle test; keeps the first hit. */
class FirstHit final : public btTriangleRaycastCallback {
 public:
  FirstHit(const btVector3& from, const btVector3& to) : btTriangleRaycastCallback(from, to, kF_KeepUnflippedNormal) {}

  btScalar reportHit(const btVector3&, btScalar fraction, int, int index) override {
    triangle = index;
    return fraction;
  }

  int triangle = -1;
};

struct Result {
  int triangle;
  float fraction;
};

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

  void prepare(const Segments& segments) override {
    from_.clear();
    to_.clear();
    for (std::size_t i = 0; i < segments.count(); ++i) {
      from_.push_back(to_bullet(&segments.from[3 * i]));
      to_.push_back(to_bullet(&segments.to[3 * i]));
    }
    results_.resize(segments.batch);
  }

  Answer answer(std::size_t i) const override {
    const Result& result = results_[i];
    if (result.triangle < 0) {
      return {};
    }
    return {walls_.triangle_wall[static_cast<std::size_t>(result.triangle)], static_cast<double>(result.fraction)};
  }

 protected:
  const WallMesh& walls_;
  std::vector<btVector3> vertices_, from_, to_;
  std::vector<int> indices_;  // 3 a triangle
  std::vector<Result> results_;
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

  void run(std::size_t first, std::size_t count) override {
    for (std::size_t i = 0; i < count; ++i) {
      const btVector3 &from = from_[first + i], &to = to_[first + i];
      FirstHit hit(from, to);
      if (box_) {
        btVector3 low = from, high = from;
        low.setMin(to);
        high.setMax(to);
        shape_->processAllTriangles(&hit, low, high);
      } else {
        shape_->performRaycast(&hit, from, to);
      }
      results_[i] = {hit.triangle, hit.m_hitFraction};
    }
  }

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
      for (std::size_t k = 0; k < 3; ++k) {
        corners[k] = vertices_[static_cast<std::size_t>(indices_[3 * i + k])];
      }
      triangles_.insert(triangles_.end(), corners, corners + 3);
      tree_.insert(btDbvtVolume::FromPoints(corners, 3), reinterpret_cast<void*>(i));
    }
    tree_.optimizeTopDown();
  }

  void run(std::size_t first, std::size_t count) override {
    Visitor visitor;
    visitor.triangles = triangles_.data();
    for (std::size_t i = 0; i < count; ++i) {
      const btVector3 &from = from_[first + i], &to = to_[first + i];
      FirstHit hit(from, to);
      visitor.hit = &hit;
      if (box_) {
        btVector3 low = from, high = from;
        low.setMin(to);
        high.setMax(to);
        tree_.collideTVNoStackAlloc(tree_.m_root, btDbvtVolume::FromMM(low, high), stack_, visitor);
      } else {
        btVector3 direction = to - from;
        const btScalar length = direction.length();
        if (length > 0) {
          direction /= length;
        }
        btVector3 inverse;
        unsigned int signs[3];
        for (int k = 0; k < 3; ++k) {
          inverse[k] = direction[k] == 0 ? btScalar(BT_LARGE_FLOAT) : 1 / direction[k];
          signs[k] = inverse[k] < 0 ? 1u : 0u;
        }
        const btVector3 zero(0, 0, 0);
        tree_.rayTestInternal(tree_.m_root, from, to, inverse, signs, length, zero, zero, stack_, visitor);
      }
      results_[i] = {hit.triangle, hit.m_hitFraction};
    }
  }

 private:
  struct Visitor final : btDbvt::ICollide {
    void Process(const btDbvtNode* leaf) override {
      const auto index = reinterpret_cast<std::size_t>(leaf->data);
      hit->processTriangle(triangles + 3 * index, 0, static_cast<int>(index));
    }
    btVector3* triangles = nullptr;
    FirstHit* hit = nullptr;
  };

  bool box_;
  btDbvt tree_;
  std::vector<btVector3> triangles_;
  btAlignedObjectArray<const btDbvtNode*> stack_;
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
  for (const BulletKind kind : kinds) {
    engines.push_back(make_bullet(kind, walls));
  }
  return engines;
}

}  // namespace dsw::bench
