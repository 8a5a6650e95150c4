#include "bullet_change.h"

#include <BulletCollision/BroadphaseCollision/btDbvt.h>
#include <BulletCollision/CollisionDispatch/btDefaultCollisionConfiguration.h>
#include <BulletCollision/CollisionShapes/btBvhTriangleMeshShape.h>
#include <BulletCollision/CollisionShapes/btTriangleIndexVertexArray.h>
#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>
#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>

namespace dsw::bench {

namespace {

btVector3 to_bullet(const double* xyz) {
  return {static_cast<btScalar>(xyz[0]), static_cast<btScalar>(xyz[1]), static_cast<btScalar>(xyz[2])};
}

class FirstHit final : public btTriangleRaycastCallback {
 public:
  FirstHit(const btVector3& from, const btVector3& to) : btTriangleRaycastCallback(from, to, kF_KeepUnflippedNormal) {}
  btScalar reportHit(const btVector3&, btScalar fraction, int, int) override {
    met = true;
    return fraction;
  }
  bool met = false;
};

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

  void prepare(const Segments& segments) override {
    from_.clear();
    to_.clear();
    for (std::size_t i = 0; i < segments.count(); ++i) {
      from_.push_back(to_bullet(&segments.from[3 * i]));
      to_.push_back(to_bullet(&segments.to[3 * i]));
    }
    times_.resize(segments.batch);
  }
  Answer answer(std::size_t i) const override {
    return times_[i] < 0 ? Answer{} : Answer{0, static_cast<double>(times_[i])};
  }

 protected:
  void keep(std::size_t i, const FirstHit& hit) { times_[i] = hit.met ? hit.m_hitFraction : -1.0f; }
  std::vector<btVector3> from_, to_;
  std::vector<float> times_;
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
    Visitor visitor;
    visitor.corners = corners_.corners.data();
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
        btVector3 direction = to - from, inverse;
        const btScalar length = direction.length();
        if (length > 0) {
          direction /= length;
        }
        unsigned int signs[3];
        for (int k = 0; k < 3; ++k) {
          inverse[k] = direction[k] == 0 ? btScalar(BT_LARGE_FLOAT) : 1 / direction[k];
          signs[k] = inverse[k] < 0 ? 1u : 0u;
        }
        const btVector3 zero(0, 0, 0);
        tree_.rayTestInternal(tree_.m_root, from, to, inverse, signs, length, zero, zero, stack_, visitor);
      }
      keep(i, hit);
    }
  }

 private:
  struct Visitor final : btDbvt::ICollide {
    void Process(const btDbvtNode* leaf) override {
      const auto index = reinterpret_cast<std::size_t>(leaf->data);
      hit->processTriangle(corners + 3 * index, 0, static_cast<int>(index));
    }
    btVector3* corners = nullptr;
    FirstHit* hit = nullptr;
  };

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
  btAlignedObjectArray<const btDbvtNode*> stack_;
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

  void run(std::size_t first, std::size_t count) override {
    for (std::size_t i = 0; i < count; ++i) {
      FirstHit hit(from_[first + i], to_[first + i]);
      shape_->performRaycast(&hit, from_[first + i], to_[first + i]);
      keep(i, hit);
    }
  }

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
