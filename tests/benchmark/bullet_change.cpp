#include "bullet_change.h"

#include "bullet_walls.h"

namespace dsw::bench {

namespace {

class Casting : public ChangingEngine {
 public:
  using ChangingEngine::ChangingEngine;

  void prepare(const Segments& segments) override { casts_.prepare(segments); }
  Answer answer(std::size_t i) const override {
    const auto& result = casts_.result(i);
    return result.triangle < 0 ? Answer{} : Answer{0, static_cast<double>(result.fraction)};
  }

 protected:
  BulletCasts casts_;
};

class Tree final : public Casting {
 public:
  Tree(const WallMesh& walls, std::size_t slots, bool box)
      : Casting(box ? "bullet, btDbvt, box" : "bullet, btDbvt, ray"),
        box_(box),
        corners_(walls, slots),
        leaves_(2 * slots, nullptr) {
    for (std::uint32_t id = 0; id < walls.walls.size(); ++id) insert(id);
    tree_.optimizeTopDown();
  }

  void apply(const WallChange& change) override {
    for (const auto& item : change.removed) {
      for (std::size_t part = 0; part < 2; ++part) {
        tree_.remove(leaves_[2 * item.id + part]);
        leaves_[2 * item.id + part] = nullptr;
      }
    }
    corners_.apply(change);
    for (const auto& item : change.added) insert(item.id);
  }

  void run(std::size_t first, std::size_t count) override {
    casts_.run(tree_, box_, first, count,
               [this](std::size_t triangle, btVector3*) { return &corners_.corners[3 * triangle]; });
  }

 private:
  void insert(std::size_t slot) {
    for (std::size_t part = 0; part < 2; ++part) {
      const std::size_t index = 2 * slot + part;
      leaves_[index] =
          tree_.insert(btDbvtVolume::FromPoints(&corners_.corners[3 * index], 3), reinterpret_cast<void*>(index));
    }
  }

  bool box_;
  BulletWalls corners_;
  btDbvt tree_;
  std::vector<btDbvtNode*> leaves_;
};

class Rebuilt final : public Casting {
 public:
  Rebuilt(const WallMesh& walls, std::size_t slots)
      : Casting("bullet, quantized BVH, ray, rebuilt"), corners_(walls, slots), mesh_(corners_.mesh()) {
    build();
  }

  void apply(const WallChange& change) override {
    corners_.apply(change);
    build();
  }

  void run(std::size_t first, std::size_t count) override { casts_.run(*shape_, false, first, count); }

 private:
  void build() { shape_ = std::make_unique<btBvhTriangleMeshShape>(mesh_.get(), true); }

  BulletWalls corners_;
  std::unique_ptr<btTriangleIndexVertexArray> mesh_;
  std::unique_ptr<btBvhTriangleMeshShape> shape_;
};

}  // namespace

std::unique_ptr<ChangingEngine> make_bullet_tree(const WallMesh& walls, std::size_t slots, bool box) {
  return std::make_unique<Tree>(walls, slots, box);
}

std::unique_ptr<ChangingEngine> make_bullet_rebuilt(const WallMesh& walls, std::size_t slots) {
  return std::make_unique<Rebuilt>(walls, slots);
}

}  // namespace dsw::bench
