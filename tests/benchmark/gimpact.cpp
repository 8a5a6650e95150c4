#include "gimpact.h"

#include "bullet_walls.h"

#include <BulletCollision/CollisionDispatch/btDefaultCollisionConfiguration.h>
#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>

#include <algorithm>

namespace dsw::bench {

namespace {

/** Three corners each. */
using Triangles = std::vector<btVector3>;

Triangles triangles_of(const Segments& segments, std::size_t casts) {
  Triangles triangles;
  for (std::size_t own = 0; own < segments.count(); own += casts) {
    for (std::size_t edge = own + 1; edge < own + casts; ++edge) {
      triangles.push_back(to_bullet(&segments.from[3 * own]));
      triangles.push_back(to_bullet(&segments.to[3 * own]));
      triangles.push_back(to_bullet(&segments.from[3 * edge]));
    }
  }
  return triangles;
}

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
  void refit() {
    shape->postUpdate();
    shape->updateBound();
  }
};

class Base : public Gimpact {
 public:
  Base(const char* name, const WallMesh& walls, std::size_t slots, std::size_t casts)
      : Gimpact(name), casts_(casts), walls_(walls, slots) {
    wall_.mesh = walls_.mesh();
    wall_.wrap();
  }

  void apply(const WallChange& change) override {
    walls_.apply(change);
    wall_.refit();
  }
  void prepare(const Segments& segments) override {
    triangles_ = triangles_of(segments, casts_);
    met_.resize(segments.batch / casts_ * (casts_ - 1));
  }
  Answer answer(std::size_t i) const override {
    const std::size_t edge = i % casts_;
    return edge > 0 && met_[i / casts_ * (casts_ - 1) + edge - 1] != 0 ? Answer{0, 0.0} : Answer{};
  }
  std::size_t hits() const override { return static_cast<std::size_t>(std::count(met_.begin(), met_.end(), 1)); }

 protected:
  /** The first corner of the casts from number `cast` on. */
  std::size_t corner_of(std::size_t cast) const { return cast / casts_ * (casts_ - 1) * 3; }

  std::size_t casts_;
  BulletWalls walls_;
  Item wall_;
  Triangles triangles_;
  std::vector<char> met_;
};

class EachTriangle final : public Base {
 public:
  EachTriangle(const WallMesh& walls, std::size_t slots, std::size_t casts)
      : Base("gimpact, triangle by triangle", walls, slots, casts) {}

  void run(std::size_t first, std::size_t) override {
    const btGImpactMeshShapePart* const part = wall_.shape->getMeshPart(0);
    const btVector3* corner = &triangles_[corner_of(first)];
    part->lockChildShapes();
    for (char& met : met_) {
      btPrimitiveTriangle own, other;
      own.m_margin = 0;
      std::copy_n(corner, 3, own.m_vertices);
      corner += 3;
      btAABB box(own.m_vertices[0], own.m_vertices[1], own.m_vertices[2]);
      found_.resize(0);
      met = 0;
      if (!part->getBoxSet()->boxQuery(box, found_)) continue;
      own.buildTriPlane();
      for (int i = 0; i < found_.size(); ++i) {
        part->getPrimitiveTriangle(found_[i], other);
        other.m_margin = 0;
        other.buildTriPlane();
        GIM_TRIANGLE_CONTACT contact;
        if (own.overlap_test_conservative(other) && own.find_triangle_collision_clip_method(other, contact)) met = 1;
      }
    }
    part->unlockChildShapes();
  }

 private:
  btAlignedObjectArray<int> found_;
};

/** Marks triangles instead of keeping contact points. */
class Marking final : public btManifoldResult {
 public:
  Marking(const btCollisionObjectWrapper* a, const btCollisionObjectWrapper* b, char* met)
      : btManifoldResult(a, b), met_(met) {}
  void setShapeIdentifiersA(int, int index) override { now_ = index; }
  void addContactPoint(const btVector3&, const btVector3&, btScalar) override { met_[now_] = 1; }

 private:
  char* met_;
  int now_ = 0;
};

class BodyMeshes final : public Base {
 public:
  BodyMeshes(const WallMesh& walls, std::size_t slots, std::size_t casts, std::size_t particles)
      : Base("gimpact, mesh by mesh", walls, slots, casts),
        triangles_each_(particles * (casts - 1)),
        dispatcher_(&configuration_) {
    btGImpactCollisionAlgorithm::registerAlgorithm(&dispatcher_);
    for (std::size_t i = 0; i < 3 * triangles_each_; ++i) indices_.push_back(static_cast<int>(i));
  }

  void prepare(const Segments& segments) override {
    Base::prepare(segments);
    now_.assign(triangles_.begin(), triangles_.begin() + static_cast<std::ptrdiff_t>(3 * met_.size()));
    bodies_.clear();
    for (std::size_t first = 0; first < now_.size(); first += 3 * triangles_each_) {
      bodies_.push_back(std::make_unique<Item>());
      bodies_.back()->mesh = std::make_unique<btTriangleIndexVertexArray>(
          static_cast<int>(triangles_each_), indices_.data(), static_cast<int>(3 * sizeof(int)),
          static_cast<int>(indices_.size()), now_[first].m_floats, static_cast<int>(sizeof(btVector3)));
      bodies_.back()->wrap();
    }
  }

  void run(std::size_t first, std::size_t) override {
    std::copy_n(&triangles_[corner_of(first)], now_.size(), now_.data());
    std::fill(met_.begin(), met_.end(), 0);
    const btDispatcherInfo info;
    const btCollisionObjectWrapper wall(nullptr, wall_.shape.get(), &wall_.object, wall_.object.getWorldTransform(), -1,
                                        -1);
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      Item& body = *bodies_[i];
      body.refit();
      const btCollisionObjectWrapper own(nullptr, body.shape.get(), &body.object, body.object.getWorldTransform(), -1,
                                         -1);
      Marking result(&own, &wall, &met_[i * triangles_each_]);
      btCollisionAlgorithm* const algorithm =
          dispatcher_.findAlgorithm(&own, &wall, nullptr, BT_CONTACT_POINT_ALGORITHMS);
      algorithm->processCollision(&own, &wall, info, &result);
      algorithm->~btCollisionAlgorithm();
      dispatcher_.freeCollisionAlgorithm(algorithm);
    }
  }

 private:
  std::size_t triangles_each_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  std::vector<int> indices_;
  Triangles now_;
  std::vector<std::unique_ptr<Item>> bodies_;
};

}  // namespace

std::unique_ptr<Gimpact> make_gimpact_triangles(const WallMesh& walls, std::size_t slots, std::size_t casts) {
  return std::make_unique<EachTriangle>(walls, slots, casts);
}

std::unique_ptr<Gimpact> make_gimpact_meshes(const WallMesh& walls, std::size_t slots, std::size_t casts,
                                             std::size_t particles) {
  return std::make_unique<BodyMeshes>(walls, slots, casts, particles);
}

}  // namespace dsw::bench
