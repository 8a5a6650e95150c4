// Segments for Bullet: in its format, handed to its shapes and trees in the ways it offers, and the first hits.
#ifndef DARTSWEEP_TESTS_BENCHMARK_BULLET_CASTS_H
#define DARTSWEEP_TESTS_BENCHMARK_BULLET_CASTS_H

#include "engine.h"

#include <BulletCollision/BroadphaseCollision/btDbvt.h>
#include <BulletCollision/CollisionShapes/btBvhTriangleMeshShape.h>
#include <BulletCollision/CollisionShapes/btTriangleIndexVertexArray.h>
#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>

namespace dsw::bench {

inline btVector3 to_bullet(const double* xyz) {
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

class BulletCasts {
 public:
  struct Result {
    int triangle;  // negative: nothing is met
    float fraction;
  };

  void prepare(const Segments& segments) {
    from_.clear();
    to_.clear();
    for (std::size_t i = 0; i < segments.count(); ++i) {
      from_.push_back(to_bullet(&segments.from[3 * i]));
      to_.push_back(to_bullet(&segments.to[3 * i]));
    }
    results_.resize(segments.batch);
  }

  /** @param box asks for the segment's box instead of walking the tree with the segment. */
  void run(const btBvhTriangleMeshShape& shape, bool box, std::size_t first, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const btVector3 &from = from_[first + i], &to = to_[first + i];
      FirstHit hit(from, to);
      if (box) {
        btVector3 low = from, high = from;
        low.setMin(to);
        high.setMax(to);
        shape.processAllTriangles(&hit, low, high);
      } else {
        // It changes nothing, and is not declared const.
        const_cast<btBvhTriangleMeshShape&>(shape).performRaycast(&hit, from, to);
      }
      results_[i] = {hit.triangle, hit.m_hitFraction};
    }
  }

  /** Runs casts with a tree whose leaves hold the numbers of triangles. `box` asks for the segment's box instead of
   * walking the tree with the segment.
   * @param corners (triangle, btVector3 room[3]) -> its three corners, there or elsewhere. */
  template <class Corners>
  void run(const btDbvt& tree, bool box, std::size_t first, std::size_t count, const Corners& corners) {
    Visitor<Corners> visitor(corners);
    for (std::size_t i = 0; i < count; ++i) {
      const btVector3 &from = from_[first + i], &to = to_[first + i];
      FirstHit hit(from, to);
      visitor.hit = &hit;
      if (box) {
        btVector3 low = from, high = from;
        low.setMin(to);
        high.setMax(to);
        tree.collideTVNoStackAlloc(tree.m_root, btDbvtVolume::FromMM(low, high), stack_, visitor);
      } else {
        btVector3 direction = to - from, inverse;
        const btScalar length = direction.length();
        if (length > 0) direction /= length;
        unsigned int signs[3];
        for (int k = 0; k < 3; ++k) {
          inverse[k] = direction[k] == 0 ? btScalar(BT_LARGE_FLOAT) : 1 / direction[k];
          signs[k] = inverse[k] < 0 ? 1u : 0u;
        }
        const btVector3 zero(0, 0, 0);
        tree.rayTestInternal(tree.m_root, from, to, inverse, signs, length, zero, zero, stack_, visitor);
      }
      results_[i] = {hit.triangle, hit.m_hitFraction};
    }
  }

  const Result& result(std::size_t i) const { return results_[i]; }
  Answer answer(std::size_t i, const WallMesh& walls) const {
    if (results_[i].triangle < 0) return {};
    return {walls.triangle_wall[static_cast<std::size_t>(results_[i].triangle)],
            static_cast<double>(results_[i].fraction)};
  }

 private:
  template <class Corners>
  struct Visitor final : btDbvt::ICollide {
    explicit Visitor(const Corners& corners_of) : corners(corners_of) {}
    void Process(const btDbvtNode* leaf) override {
      const auto index = reinterpret_cast<std::size_t>(leaf->data);
      btVector3 room[3];
      // Bullet's interface wants them writable; it only reads.
      hit->processTriangle(const_cast<btVector3*>(corners(index, room)), 0, static_cast<int>(index));
    }
    const Corners& corners;
    FirstHit* hit = nullptr;
  };

  std::vector<btVector3> from_, to_;
  std::vector<Result> results_;
  btAlignedObjectArray<const btDbvtNode*> stack_;
};

}  // namespace dsw::bench

#endif
