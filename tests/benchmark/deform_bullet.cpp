#include "deform_peers.h"

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

class MovingBullet : public MovingEngine {
 public:
  MovingBullet(std::string name, const WallMesh& walls, bool box)
      : MovingEngine(std::move(name)), walls_(walls), own_(walls), box_(box) {
    write();
  }

  void write() override {
    vertices_.resize(own_.vertices.size());
    low_ = high_ = to_bullet(walls_.point(own_.vertices.front()));
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
      vertices_[i] = to_bullet(walls_.point(own_.vertices[i]));
      low_.setMin(vertices_[i]);
      high_.setMax(vertices_[i]);
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
  struct Result {
    int triangle;
    float fraction;
  };

  const WallMesh& walls_;
  WallPoints own_;
  bool box_;
  btVector3 low_, high_;  // of all walls
  std::vector<btVector3> vertices_, from_, to_;
  std::vector<Result> results_;
};

class MovingBvh final : public MovingBullet {
 public:
  MovingBvh(const WallMesh& walls, bool refit, bool box)
      : MovingBullet(std::string("bullet, quantized BVH ") + (refit ? "refit" : "rebuilt") + (box ? ", box" : ", ray"),
                     walls, box),
        refit_(refit),
        mesh_(static_cast<int>(own_.triangles.size()), reinterpret_cast<int*>(own_.triangles.data()),
              static_cast<int>(3 * sizeof(int)), static_cast<int>(vertices_.size()), vertices_.front().m_floats,
              static_cast<int>(sizeof(btVector3))) {
    build();
  }

  void update() override {
    if (refit_) {
      shape_->getOptimizedBvh()->refit(&mesh_, low_, high_);  // without the shape's own box, which takes longer
    } else {
      build();
    }
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
  void build() { shape_ = std::make_unique<btBvhTriangleMeshShape>(&mesh_, true, low_, high_); }

  bool refit_;
  btTriangleIndexVertexArray mesh_;
  std::unique_ptr<btBvhTriangleMeshShape> shape_;
};

/** Leaves have a margin, and change only when their triangle leaves them: what Bullet does for moving objects. */
class MovingDbvt final : public MovingBullet {
 public:
  MovingDbvt(const WallMesh& walls, double margin)
      : MovingBullet("bullet, btDbvt, margin " + std::to_string(margin), walls, true),
        margin_(static_cast<btScalar>(margin)) {
    for (std::size_t i = 0; i < own_.triangles.size(); ++i) {
      btDbvtVolume volume = volume_of(i);
      volume.Expand(btVector3(margin_, margin_, margin_));
      leaves_.push_back(tree_.insert(volume, reinterpret_cast<void*>(i)));
    }
    tree_.optimizeTopDown();
  }

  void update() override {
    for (std::size_t i = 0; i < leaves_.size(); ++i) {
      btDbvtVolume volume = volume_of(i);
      tree_.update(leaves_[i], volume, margin_);
    }
  }

  void run(std::size_t first, std::size_t count) override {
    Visitor visitor(*this);
    for (std::size_t i = 0; i < count; ++i) {
      const btVector3 &from = from_[first + i], &to = to_[first + i];
      FirstHit hit(from, to);
      visitor.hit = &hit;
      btVector3 low = from, high = from;
      low.setMin(to);
      high.setMax(to);
      tree_.collideTVNoStackAlloc(tree_.m_root, btDbvtVolume::FromMM(low, high), stack_, visitor);
      results_[i] = {hit.triangle, hit.m_hitFraction};
    }
  }

 private:
  struct Visitor final : btDbvt::ICollide {
    explicit Visitor(const MovingDbvt& engine) : of(engine) {}
    void Process(const btDbvtNode* leaf) override {
      const auto index = reinterpret_cast<std::size_t>(leaf->data);
      btVector3 corners[3];
      of.get_corners(index, corners);
      hit->processTriangle(corners, 0, static_cast<int>(index));
    }
    const MovingDbvt& of;
    FirstHit* hit = nullptr;
  };

  void get_corners(std::size_t triangle, btVector3* corners) const {
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = vertices_[own_.triangles[triangle][k]];
    }
  }
  btDbvtVolume volume_of(std::size_t triangle) const {
    btVector3 corners[3];
    get_corners(triangle, corners);
    return btDbvtVolume::FromPoints(corners, 3);
  }

  btScalar margin_;
  btDbvt tree_;
  std::vector<btDbvtNode*> leaves_;
  btAlignedObjectArray<const btDbvtNode*> stack_;
};

}  // namespace

std::vector<std::unique_ptr<MovingEngine>> make_moving_bullets(const WallMesh& walls) {
  std::vector<std::unique_ptr<MovingEngine>> engines;
  for (const bool box : {false, true}) {
    for (const bool refit : {true, false}) {
      engines.push_back(std::make_unique<MovingBvh>(walls, refit, box));
    }
  }
  return engines;
}

std::vector<std::unique_ptr<MovingEngine>> make_moving_bullet_trees(const WallMesh& walls) {
  std::vector<std::unique_ptr<MovingEngine>> engines;
  for (const double margin : {0.05, 0.1}) {
    engines.push_back(std::make_unique<MovingDbvt>(walls, margin));
  }
  return engines;
}

}  // namespace dsw::bench
