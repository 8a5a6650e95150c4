#include "near_peers.h"

#ifdef NEAR_WITH_FCL

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/distance.h>

namespace dsw::bench {

namespace {

using Model = fcl::BVHModel<fcl::OBBRSSd>;

fcl::Vector3d vector_of(const double* p) { return {p[0], p[1], p[2]}; }

class NearFcl final : public NearPeer {
 public:
  explicit NearFcl(const WallMesh& walls) {
    walls_.beginModel(static_cast<int>(walls.triangles.size()), static_cast<int>(3 * walls.triangles.size()));
    for (const auto& t : walls.triangles)
      walls_.addTriangle(vector_of(walls.point(t[0])), vector_of(walls.point(t[1])), vector_of(walls.point(t[2])));
    walls_.endModel();
  }
  std::string name() const override { return "fcl"; }
  double distance(const double* from, const double* to, double /*radius*/) override {
    Model segment;
    segment.beginModel(1, 3);
    segment.addTriangle(vector_of(from), vector_of(to), vector_of(to));
    segment.endModel();
    const fcl::Transform3d identity = fcl::Transform3d::Identity();
    const fcl::DistanceRequestd request(false);
    fcl::DistanceResultd result;
    fcl::distance(&walls_, identity, &segment, identity, request, result);
    return result.min_distance;
  }

 private:
  Model walls_;
};

}  // namespace

std::unique_ptr<NearPeer> make_near_fcl(const WallMesh& walls) { return std::make_unique<NearFcl>(walls); }

}  // namespace dsw::bench

#else

namespace dsw::bench {

std::unique_ptr<NearPeer> make_near_fcl(const WallMesh& /*walls*/) { return nullptr; }

}  // namespace dsw::bench

#endif
