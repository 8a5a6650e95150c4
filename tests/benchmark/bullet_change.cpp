#include "bullet_change.h"

#include "bullet_casts.h"

#include <BulletCollision/CollisionDispatch/btDefaultCollisionConfiguration.h>
#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>

namespace dsw::bench {

namespace {

/** Six corners a wall, by slot. */
class Corners {
 public:
  Corners(const WallMesh& walls, std::size_t slots) : walls_(walls), corners(6 * slots, btVector3(0, 0, 0)) {
    for (std::uint32_t id = 0; id < walls.walls.size(); ++id) {
      write(id, walls.walls[id]);
    }
  }

  void write(std::size_t slot, const scenes::Wall& wall) {
    for (std::uint32_t part = 0; part < wall.triangle_count(); ++part) {
      const auto triangle = wall.triangle(part);
      for (std::size_t k = 0; k < 3; ++k) {
        corners[6 * slot + 3 * part + k] = to_bullet(walls_.point(triangle[k]));
      }
    }
  }

  void erase(std::size_t slot) {
    for (std::size_t k = 1; k < 6; ++k) {
      corners[6 * slot + k] = corners[6 * slot];
    }
  }

  void apply(const WallChange& change) {
    for (const auto& item : change.removed) {
      erase(item.id);
    }
    for (const auto& item : change.added) {
      write(item.id, item.wall);
    }
  }

  /** All triangles, three corners each in a row. */
  std::unique_ptr<btTriangleIndexVertexArray> mesh() {
    indices.resize(corners.size());
    for (std::size_t i = 0; i < indices.size(); ++i) {
      indices[i] = static_cast<int>(i);
    }
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
    for (std::uint32_t id = 0; id < walls.walls.size(); ++id) {
      insert(id);
    }
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
    for (const auto& item : change.added) {
      insert(item.id);
    }
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
  Corners corners_;
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

  Corners corners_;
  std::unique_ptr<btTriangleIndexVertexArray> mesh_;
  std::unique_ptr<btBvhTriangleMeshShape> shape_;
};

/** Counts instead of keeping. */
class Counting final : public btManifoldResult {
 public:
  Counting(const btCollisionObjectWrapper* a, const btCollisionObjectWrapper* b) : btManifoldResult(a, b) {}
  void addContactPoint(const btVector3&, const btVector3&, btScalar) override { ++count; }
  std::size_t count = 0;
};

}  // namespace

std::unique_ptr<ChangingEngine> make_bullet_tree(const WallMesh& walls, std::size_t slots, bool box) {
  return std::make_unique<Tree>(walls, slots, box);
}

std::unique_ptr<ChangingEngine> make_bullet_rebuilt(const WallMesh& walls, std::size_t slots) {
  return std::make_unique<Rebuilt>(walls, slots);
}

struct Gimpact::Impl {
  struct Item {
    std::unique_ptr<btTriangleIndexVertexArray> mesh;
    std::unique_ptr<btGImpactMeshShape> shape;
    btCollisionObject object;

    void wrap() {
      shape = std::make_unique<btGImpactMeshShape>(mesh.get());
      shape->setMargin(0);
      shape->updateBound();
      object.setCollisionShape(shape.get());
      object.setWorldTransform(btTransform::getIdentity());
    }
  };

  Impl(const WallMesh& walls, std::size_t slots) : corners(walls, slots), dispatcher(&configuration) {
    btGImpactCollisionAlgorithm::registerAlgorithm(&dispatcher);
    wall.mesh = corners.mesh();
    wall.wrap();
  }

  Corners corners;
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher;
  Item wall;
  std::vector<btVector3> vertices;
  std::vector<int> indices;
  std::vector<std::unique_ptr<Item>> bodies;
  std::size_t body_vertices = 0;
};

Gimpact::Gimpact(const WallMesh& walls, std::size_t slots, std::size_t bodies, std::size_t body_vertices,
                 const std::vector<std::array<std::uint32_t, 3>>& faces, const std::vector<double>& positions)
    : impl_(std::make_unique<Impl>(walls, slots)) {
  impl_->body_vertices = body_vertices;
  for (std::size_t i = 0; i < positions.size(); i += 3) {
    impl_->vertices.push_back(to_bullet(&positions[i]));
  }
  for (const auto& face : faces) {
    for (const std::uint32_t corner : face) {
      impl_->indices.push_back(static_cast<int>(corner));
    }
  }
  for (std::size_t i = 0; i < bodies; ++i) {
    auto item = std::make_unique<Impl::Item>();
    item->mesh = std::make_unique<btTriangleIndexVertexArray>(
        static_cast<int>(faces.size()), impl_->indices.data(), static_cast<int>(3 * sizeof(int)),
        static_cast<int>(body_vertices), impl_->vertices[i * body_vertices].m_floats,
        static_cast<int>(sizeof(btVector3)));
    item->wrap();
    impl_->bodies.push_back(std::move(item));
  }
}

Gimpact::~Gimpact() = default;

void Gimpact::apply(const WallChange& change) {
  impl_->corners.apply(change);
  impl_->wall.shape->postUpdate();
  impl_->wall.shape->updateBound();
}

std::size_t Gimpact::step(const float* positions) {
  for (btVector3& vertex : impl_->vertices) {
    vertex.setValue(positions[0], positions[1], positions[2]);
    positions += 3;
  }
  const btDispatcherInfo info;
  const btCollisionObjectWrapper wall(nullptr, impl_->wall.shape.get(), &impl_->wall.object,
                                      impl_->wall.object.getWorldTransform(), -1, -1);
  std::size_t contacts = 0;
  for (const auto& body : impl_->bodies) {
    body->shape->postUpdate();
    body->shape->updateBound();
    const btCollisionObjectWrapper own(nullptr, body->shape.get(), &body->object, body->object.getWorldTransform(), -1,
                                       -1);
    Counting result(&own, &wall);
    btCollisionAlgorithm* const algorithm =
        impl_->dispatcher.findAlgorithm(&own, &wall, nullptr, BT_CONTACT_POINT_ALGORITHMS);
    algorithm->processCollision(&own, &wall, info, &result);
    contacts += result.count;
    algorithm->~btCollisionAlgorithm();
    impl_->dispatcher.freeCollisionAlgorithm(algorithm);
  }
  return contacts;
}

}  // namespace dsw::bench
