#include "deform_peers.h"

#include "bullet_casts.h"

namespace dsw::bench {

namespace {

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

  void prepare(const Segments& segments) override { casts_.prepare(segments); }
  Answer answer(std::size_t i) const override { return casts_.answer(i, walls_); }

 protected:
  const WallMesh& walls_;
  WallPoints own_;
  bool box_;
  btVector3 low_, high_;  // of all walls
  std::vector<btVector3> vertices_;
  BulletCasts casts_;
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

  void run(std::size_t first, std::size_t count) override { casts_.run(*shape_, box_, first, count); }

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
    casts_.run(tree_, box_, first, count,
               [this](std::size_t triangle, btVector3* corners) { return get_corners(triangle, corners); });
  }

 private:
  const btVector3* get_corners(std::size_t triangle, btVector3* corners) const {
    for (std::size_t k = 0; k < 3; ++k) corners[k] = vertices_[own_.triangles[triangle][k]];
    return corners;
  }
  btDbvtVolume volume_of(std::size_t triangle) const {
    btVector3 corners[3];
    get_corners(triangle, corners);
    return btDbvtVolume::FromPoints(corners, 3);
  }

  btScalar margin_;
  btDbvt tree_;
  std::vector<btDbvtNode*> leaves_;
};

}  // namespace

std::vector<std::unique_ptr<MovingEngine>> make_moving_bullets(const WallMesh& walls) {
  std::vector<std::unique_ptr<MovingEngine>> engines;
  for (const bool box : {false, true}) {
    for (const bool refit : {true, false}) engines.push_back(std::make_unique<MovingBvh>(walls, refit, box));
  }
  return engines;
}

std::vector<std::unique_ptr<MovingEngine>> make_moving_bullet_trees(const WallMesh& walls) {
  std::vector<std::unique_ptr<MovingEngine>> engines;
  for (const double margin : {0.05, 0.1}) engines.push_back(std::make_unique<MovingDbvt>(walls, margin));
  return engines;
}

}  // namespace dsw::bench
