// Capsules and boxes that turn among 10,000 triangles, beside FCL's continuous collision. FCL turns at a constant speed, and we go along a
// quaternion, so a share of the way is another time: each is judged on its own motion.
#include "parts.h"

#ifdef RIGID_WITH_FCL

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/math/motion/interp_motion.h>
#include <fcl/narrowphase/continuous_collision.h>

#include <cmath>
#include <memory>
#include <string>

#include "../timing.h"
#include "judge.h"
#include "lattice.h"

namespace dsw::rigid {

namespace {

using scenes::Random;
using Model = fcl::BVHModel<fcl::OBBRSSd>;

constexpr double kPi = 3.14159265358979323846;

struct Setting {
  const char* name;
  fcl::CCDSolverType solver;
  fcl::GJKSolverType gjk;
  std::size_t most;   // iterations
  std::size_t share;  // of the motions: one of so many, where a motion takes tens of milliseconds
};
constexpr Setting kSettings[] = {{"advancement_libccd", fcl::CCDC_CONSERVATIVE_ADVANCEMENT, fcl::GST_LIBCCD, 100, 10},
                                 {"advancement_indep", fcl::CCDC_CONSERVATIVE_ADVANCEMENT, fcl::GST_INDEP, 100, 10},
                                 {"samples_10", fcl::CCDC_NAIVE, fcl::GST_LIBCCD, 10, 1},
                                 {"samples_100", fcl::CCDC_NAIVE, fcl::GST_LIBCCD, 100, 1},
                                 {"samples_10000", fcl::CCDC_NAIVE, fcl::GST_LIBCCD, 10000, 10}};
constexpr std::size_t kSettingCount = std::size(kSettings);

/** A shape that starts at a pose and turns round its own middle, which goes along a line. */
struct Motion {
  std::array<double, 4> pose{};  // a quaternion, as that of the motion
  Point middle{}, axis{}, way{};
  double angle = 0;

  fcl::Transform3d at(double time) const {
    fcl::Transform3d transform = fcl::Transform3d::Identity();
    transform.linear() = (Eigen::AngleAxisd(time * angle, Eigen::Vector3d(axis[0], axis[1], axis[2])) *
                          Eigen::Quaterniond(pose[3], pose[0], pose[1], pose[2]))
                             .toRotationMatrix();
    for (int k = 0; k < 3; ++k) {
      transform.translation()[k] = middle[static_cast<std::size_t>(k)] + time * way[static_cast<std::size_t>(k)];
    }
    return transform;
  }
};

/** Round the origin of the shape's frame. FCL 0.7 leaves this point uninitialized in motions made of two transforms alone. */
fcl::InterpMotion<double> motion_between(const fcl::Transform3d& from, const fcl::Transform3d& to) {
  return {from.linear(), from.translation(), to.linear(), to.translation(), fcl::Vector3d::Zero()};
}

struct Shape {
  Figure figure;      // in its own frame
  double radius = 0;  // of the capsule
  std::shared_ptr<fcl::CollisionGeometryd> geometry;
};

Shape make_capsule(Random& random) {
  Shape shape;
  const double half = random.uniform(0.1, 0.35);
  shape.radius = random.uniform(0.03, 0.12);
  shape.figure.points = {{0, 0, -half}, {0, 0, half}};
  shape.figure.add_edge(0, 1);
  shape.geometry = std::make_shared<fcl::Capsuled>(shape.radius, 2 * half);
  return shape;
}

Shape make_cuboid(Random& random) {
  Shape shape;
  const Point half{random.uniform(0.05, 0.3), random.uniform(0.05, 0.3), random.uniform(0.05, 0.3)};
  shape.figure = make_box(half);
  shape.geometry = std::make_shared<fcl::Boxd>(2 * half[0], 2 * half[1], 2 * half[2]);
  return shape;
}

Motion draw_motion(const Lattice& lattice, Random& random) {
  Motion motion;
  const auto direction = [&] {
    while (true) {
      const Point p{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
      if (length(p) > 0.1 && length(p) < 1) return unit(p);
    }
  };
  const Point about = direction();
  const double half = random.uniform(0, kPi / 2);
  motion.pose = {std::sin(half) * about[0], std::sin(half) * about[1], std::sin(half) * about[2], std::cos(half)};
  motion.middle = lattice.draw_middle(random);
  motion.axis = direction();
  motion.angle = random.uniform(1, 90) * kPi / 180;
  motion.way = 2 * random.uniform() * direction();
  return motion;
}

/** Walls that a motion can come near. */
Figure near_walls(const Figure& walls, const Motion& motion) {
  Figure near;
  near.points = walls.points;
  for (const Part& face : walls.faces) {
    bool is_near = true;
    for (std::size_t k = 0; k < 3; ++k) {
      double low = 1e300, high = -1e300;
      for (const std::uint32_t corner : face.at) {
        low = std::min(low, walls.points[corner][k]);
        high = std::max(high, walls.points[corner][k]);
      }
      is_near = is_near && low < motion.middle[k] + 3 && high > motion.middle[k] - 3;
    }
    if (is_near) near.faces.push_back(face);
  }
  return near;
}

struct Tally {
  double ns = 0, ours_ns = 0;  // of the motions asked
  std::size_t asked = 0, touching = 0, missed = 0, late = 0, invented = 0;

  bool finds() const { return 100 * missed <= touching; }
  bool finds_in_time() const { return 100 * (missed + late) <= touching; }
};

void run(Lattice& lattice, const Model& mesh, const std::string& key, Shape (*make)(Random&), const Options& options,
         Report& report, double& vs_fcl) {
  Tally peers[kSettingCount];
  double ours_ns = 0;
  std::size_t motions = 0, touching = 0, ours_stopped = 0;
  Random random(options.seed);
  while (motions < options.fcl) {
    const Shape shape = make(random);
    const Motion motion = draw_motion(lattice, random);
    Figure body = shape.figure;
    for (Point& p : body.points) {
      const fcl::Vector3d at = motion.at(0) * fcl::Vector3d(p[0], p[1], p[2]);
      p = {at[0], at[1], at[2]};
    }
    dsw_body_id id{};
    if (!add_body(lattice.scene(), body, shape.radius, id)) continue;
    ++motions;
    dsw_rigid_motion rigid{};
    for (std::size_t k = 0; k < 3; ++k) {
      rigid.rotation[k] = std::sin(0.5 * motion.angle) * motion.axis[k];
      rigid.centre[k] = motion.middle[k];
      rigid.translation[k] = motion.way[k];
    }
    rigid.rotation[3] = std::cos(0.5 * motion.angle);
    dsw_move_report moved{};
    const double ns =
        bench::cpu_time_ns([&] { check(dsw_body_move_rigid(lattice.scene(), id, &rigid, nullptr, &moved)); });
    ours_ns += ns;
    ours_stopped += moved.fraction < 1 ? 1 : 0;
    check(dsw_body_destroy(lattice.scene(), id));

    const PlacesAt places = [&](long double time) {
      std::vector<std::array<long double, 3>> r;
      const fcl::Transform3d at = motion.at(static_cast<double>(time));
      for (const Point& p : shape.figure.points) {
        const fcl::Vector3d x = at * fcl::Vector3d(p[0], p[1], p[2]);
        r.push_back({x[0], x[1], x[2]});
      }
      return r;
    };
    double reach = 0;
    for (const Point& p : shape.figure.points) reach = std::max(reach, length(p));
    const double speed = 1.001 * (motion.angle * reach + length(motion.way));
    // Within 1e-9 nothing is said of an answer.
    const Figure near = near_walls(lattice.walls(), motion);
    const long double touch = first_nearer(3, shape.figure, places, speed, near, shape.radius + 1e-9L, 1);
    const long double inside =
        first_nearer(3, shape.figure, places, speed, near, std::max(shape.radius - 1e-9, 1e-9), 1);
    touching += inside <= 1 ? 1 : 0;
    for (std::size_t i = 0; i < kSettingCount; ++i) {
      if (motions % kSettings[i].share != 0) continue;
      ++peers[i].asked;
      peers[i].touching += inside <= 1 ? 1 : 0;
      peers[i].ours_ns += ns;
      fcl::ContinuousCollisionRequestd request(kSettings[i].most, 1e-4, fcl::CCDM_LINEAR, kSettings[i].gjk,
                                               kSettings[i].solver);
      fcl::ContinuousCollisionResultd result;
      peers[i].ns += bench::cpu_time_ns([&] {
        const fcl::InterpMotion<double> standing =
            motion_between(fcl::Transform3d::Identity(), fcl::Transform3d::Identity());
        const fcl::InterpMotion<double> turning = motion_between(motion.at(0), motion.at(1));
        fcl::continuousCollide(&mesh, &standing, shape.geometry.get(), &turning, request, result);
      });
      peers[i].missed += inside <= 1 && !result.is_collide ? 1 : 0;
      peers[i].late +=
          inside <= 1 && result.is_collide && result.time_of_contact > static_cast<double>(inside) + 1.1e-4;
      peers[i].invented += touch > 1 && result.is_collide ? 1 : 0;
    }
  }
  const auto count = static_cast<double>(motions);
  report.set("rigid.fcl.motions." + key, count);
  report.set("rigid.fcl.touching." + key, static_cast<double>(touching));
  report.set("rigid.fcl.ours_stopped." + key, static_cast<double>(ours_stopped));
  report.set("rigid.fcl.ours_us." + key, 1e-3 * ours_ns / count);
  double best = 0, best_in_time = 0;
  for (std::size_t i = 0; i < kSettingCount; ++i) {
    const Tally& peer = peers[i];
    const std::string name = "rigid.fcl." + std::string(kSettings[i].name);
    const double over_ours = peer.ns / peer.ours_ns;
    report.set(name + ".us." + key, 1e-3 * peer.ns / static_cast<double>(peer.asked));
    report.set(name + ".touching." + key, static_cast<double>(peer.touching));
    report.set(name + ".missed." + key, static_cast<double>(peer.missed));
    report.set(name + ".late." + key, static_cast<double>(peer.late));
    report.set(name + ".false." + key, static_cast<double>(peer.invented));
    if (peer.finds() && (best == 0 || over_ours < best)) best = over_ours;
    if (peer.finds_in_time() && (best_in_time == 0 || over_ours < best_in_time)) best_in_time = over_ours;
  }
  report.set("rigid.vs_fcl." + key, best);
  report.set("rigid.vs_fcl_in_time." + key, best_in_time);
  vs_fcl = vs_fcl == 0 ? best : std::min(vs_fcl, best);
}

}  // namespace

void run_fcl(const Options& options, Report& report) {
  Lattice lattice(options.seed);
  const Figure& walls = lattice.walls();
  const auto vector_of = [&](std::uint32_t i) {
    return fcl::Vector3d(walls.points[i][0], walls.points[i][1], walls.points[i][2]);
  };
  Model mesh;
  mesh.beginModel(static_cast<int>(walls.faces.size()), static_cast<int>(3 * walls.faces.size()));
  for (const Part& face : walls.faces)
    mesh.addTriangle(vector_of(face.at[0]), vector_of(face.at[1]), vector_of(face.at[2]));
  mesh.endModel();
  report.set("rigid.fcl.triangles", static_cast<double>(walls.faces.size()));
  double vs_fcl = 0;
  run(lattice, mesh, "capsule", make_capsule, options, report, vs_fcl);
  run(lattice, mesh, "box", make_cuboid, options, report, vs_fcl);
  report.set("rigid.vs_fcl", vs_fcl);
}

}  // namespace dsw::rigid

#else

#include <cstdio>

namespace dsw::rigid {

void run_fcl(const Options& /*options*/, Report& /*report*/) { std::printf("  FCL is missing: no rigid.vs_fcl\n"); }

}  // namespace dsw::rigid

#endif
