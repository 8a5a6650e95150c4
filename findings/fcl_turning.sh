#!/bin/sh
# FCL 0.7 and a box that turns: the motion between two transforms, and conservative advancement against a mesh.
# One would guess that a motion made of two transforms turns round the origin of the shape, and that the solver that advances as far as
# nothing is near finds the wall that a box goes through.
# What happens: the constructor leaves the point round which the motion turns uninitialized, so the place half way is another one
# for other bytes in memory. With that point given, conservative advancement of a mesh and a box says that there is no collision, while
# the solver that looks at samples finds it.
# Who meets it: everybody who asks fcl::continuousCollide about shapes that turn (CCDM_LINEAR), for example a planner.
# Needs a C++ compiler and libfcl-dev.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cat > "$folder/turning.cpp" <<'CPP'
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/math/motion/interp_motion.h>
#include <fcl/narrowphase/continuous_collision.h>

#include <cstdio>
#include <cstring>
#include <new>

using Motion = fcl::InterpMotion<double>;

// Half way, with the motion in memory that is full of one number.
static fcl::Vector3d half_way(double filler, const fcl::Transform3d& from, const fcl::Transform3d& to) {
  alignas(64) static unsigned char memory[sizeof(Motion) + 64];
  for (std::size_t i = 0; i + sizeof filler <= sizeof memory; i += sizeof filler) std::memcpy(memory + i, &filler, sizeof filler);
  const Motion* motion = new (memory) Motion(from, to);
  motion->integrate(0.5);
  fcl::Transform3d at;
  motion->getCurrentTransform(at);
  return at.translation();
}

int main() {
  fcl::Transform3d from = fcl::Transform3d::Identity(), to = from;
  to.linear() = Eigen::AngleAxisd(1, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  to.translation() = Eigen::Vector3d(2, 0, 0);
  const fcl::Vector3d a = half_way(0, from, to), b = half_way(5, from, to);
  std::printf("half way: %g %g %g, or %g %g %g\n", a[0], a[1], a[2], b[0], b[1], b[2]);

  fcl::BVHModel<fcl::OBBRSSd> wall;
  wall.beginModel(1, 3);
  wall.addTriangle(fcl::Vector3d(1, -5, -5), fcl::Vector3d(1, 5, -5), fcl::Vector3d(1, 0, 5));
  wall.endModel();
  const fcl::Boxd box(0.2, 0.2, 0.2);
  const fcl::Vector3d origin = fcl::Vector3d::Zero();
  const Motion stands(fcl::Matrix3d::Identity(), origin, fcl::Matrix3d::Identity(), origin, origin);
  bool found[2];
  for (int sampled = 0; sampled < 2; ++sampled) {
    const Motion turns(from.linear(), from.translation(), to.linear(), to.translation(), origin);
    const fcl::ContinuousCollisionRequestd request(100, 1e-4, fcl::CCDM_LINEAR, fcl::GST_LIBCCD,
                                                   sampled ? fcl::CCDC_NAIVE : fcl::CCDC_CONSERVATIVE_ADVANCEMENT);
    fcl::ContinuousCollisionResultd result;
    fcl::continuousCollide(&wall, &stands, &box, &turns, request, result);
    found[sampled] = result.is_collide;
    std::printf("%s: %s, time %g\n", sampled ? "samples" : "conservative advancement", result.is_collide ? "collides" : "free", result.time_of_contact);
  }
  return (a - b).norm() > 1e-9 && !found[0] && found[1] ? 0 : 1;
}
CPP
c++ -std=c++17 -O1 -w -I/usr/include/eigen3 "$folder/turning.cpp" -o "$folder/turning" -lfcl -lccd
"$folder/turning" || { echo "FCL does otherwise now"; exit 1; }
