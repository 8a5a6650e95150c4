// Ray casts in a Delaunay triangulation of the plane of which some triangles are obstacles, beside Box2D's and CGAL's.
#include "parts.h"

#include "plane_case.h"
#include "timing.h"

#include <box2d/box2d.h>

#include <algorithm>

namespace dsw::bench {

namespace {

using namespace plane;

constexpr std::size_t kRays = 1000;

/** The sides between obstacles and the rest, as Box2D wants them: it widens boxes by a tenth of a metre, so that an
 * edge is some metres here. */
class Box2dSides : public b2RayCastCallback {
 public:
  Box2dSides(const Triangles& triangles, const std::vector<char>& solid)
      : world_(b2Vec2(0, 0)), scale_(10 / edge_of(solid.size())) {
    const b2BodyDef description;
    b2Body* const ground = world_.CreateBody(&description);
    for (const auto& face : triangles.delaunay.finite_face_handles()) {
      if (!solid[face->info()]) continue;
      for (int k = 0; k < 3; ++k) {
        const auto other = face->neighbor(k);
        if (!triangles.delaunay.is_infinite(other) && solid[other->info()]) continue;
        b2EdgeShape side;
        side.SetTwoSided(to_vector(face->vertex((k + 1) % 3)->point()), to_vector(face->vertex((k + 2) % 3)->point()));
        ground->CreateFixture(&side, 0);
      }
    }
  }
  bool hits(const double* from, const double* to) {
    hit_ = false;
    world_.RayCast(this, to_vector(from[0], from[1]), to_vector(to[0], to[1]));
    return hit_;
  }

 private:
  b2Vec2 to_vector(double x, double y) const {
    return {static_cast<float>(scale_ * x), static_cast<float>(scale_ * y)};
  }
  b2Vec2 to_vector(const Kernel::Point_2& point) const { return to_vector(point.x(), point.y()); }
  float ReportFixture(b2Fixture*, const b2Vec2&, const b2Vec2&, float fraction) override {
    hit_ = true;
    return fraction;  // nothing beyond is looked at
  }

  b2World world_;
  double scale_;
  bool hit_ = false;
};

/** Whether CGAL's walk along a line meets an obstacle on the way. */
bool cgal_hits(const Triangles& triangles, const std::vector<char>& solid, const Delaunay::Face_handle& start,
               const double* from, const double* to) {
  const Kernel::Point_2 p(from[0], from[1]), q(to[0], to[1]);
  auto face = triangles.delaunay.line_walk(p, q, start);
  if (face.is_empty()) return false;
  const auto first = face;
  do {
    if (triangles.delaunay.is_infinite(face)) return false;
    if (solid[face->info()]) return true;
    const auto& t = *face;
    const auto side = [&](int a, int b) { return CGAL::orientation(t.vertex(a)->point(), t.vertex(b)->point(), q); };
    if (side(0, 1) != CGAL::RIGHT_TURN && side(1, 2) != CGAL::RIGHT_TURN && side(2, 0) != CGAL::RIGHT_TURN)
      return false;
  } while (++face != first);
  return false;
}

/** Segments that start in free triangles. */
struct Rays {
  std::vector<double> from, to;
  std::vector<dsw_volume_id> starts;
  std::vector<Delaunay::Face_handle> faces;

  Rays(const Triangles& triangles, const std::vector<char>& solid, double length, scenes::Random& random) {
    while (starts.size() < kRays) {
      const double x = random.uniform(0.1, 0.9), y = random.uniform(0.1, 0.9),
                   angle = random.uniform(0, 6.283185307179586);
      const auto face = triangles.delaunay.locate(Kernel::Point_2(x, y));
      if (triangles.delaunay.is_infinite(face) || solid[face->info()]) continue;
      const double target[2] = {x + length * std::cos(angle), y + length * std::sin(angle)};
      from.insert(from.end(), {x, y});
      to.insert(to.end(), {std::clamp(target[0], 0.05, 0.95), std::clamp(target[1], 0.05, 0.95)});
      dsw_volume_id id;
      check(dsw_environment_get_volume_id(triangles.environment, face->info(), &id));
      starts.push_back(id);
      faces.push_back(face);
    }
  }
};

void run_rays(const std::string& key, const Triangles& triangles, const std::vector<char>& solid, double length,
              bool quick, Report& report) {
  scenes::Random random(3);
  Box2dSides sides(triangles, solid);
  std::vector<double> ours, box2d, cgal;
  std::vector<dsw_flight> flights(kRays);
  std::vector<char> of_box2d(kRays), of_cgal(kRays);
  double box2d_differs = 0, cgal_differs = 0;
  for (int round = 0; round < (quick ? 10 : 50); ++round) {
    const Rays rays(triangles, solid, length, random);
    ours.push_back(time_ns([&] {
                     check(dsw_environment_cast_segments(triangles.environment, kRays, rays.starts.data(),
                                                         rays.from.data(), rays.to.data(), 0, nullptr, flights.data()));
                   }) /
                   kRays);
    box2d.push_back(time_ns([&] {
                      for (std::size_t i = 0; i < kRays; ++i)
                        of_box2d[i] = sides.hits(&rays.from[2 * i], &rays.to[2 * i]);
                    }) /
                    kRays);
    cgal.push_back(time_ns([&] {
                     for (std::size_t i = 0; i < kRays; ++i) {
                       of_cgal[i] = cgal_hits(triangles, solid, rays.faces[i], &rays.from[2 * i], &rays.to[2 * i]);
                     }
                   }) /
                   kRays);
    for (std::size_t i = 0; i < kRays; ++i) {
      const bool hit = flights[i].outcome == DSW_OUTCOME_CONTACT;
      box2d_differs += hit != static_cast<bool>(of_box2d[i]) ? 1 : 0;
      cgal_differs += hit != static_cast<bool>(of_cgal[i]) ? 1 : 0;
    }
  }
  report.set("plane.rays." + key + ".ns", median(ours));
  report.set("plane.rays." + key + ".box2d_ns", median(box2d));
  report.set("plane.rays." + key + ".cgal_ns", median(cgal));
  report.set("plane.rays." + key + ".vs_box2d", median_ratio(box2d, ours));
  report.set("plane.rays." + key + ".vs_cgal", median_ratio(cgal, ours));
  report.set("plane.rays." + key + ".box2d_hits_differ", box2d_differs);
  report.set("plane.rays." + key + ".cgal_hits_differ", cgal_differs);
}

}  // namespace

void run_plane_rays(const Options& options, Report& report) {
  for (const std::size_t count : {std::size_t{1000}, std::size_t{100000}}) {
    const Triangles triangles(count);
    dsw_environment_info info{};
    info.struct_size = sizeof info;
    check(dsw_environment_get_info(triangles.environment, &info));
    std::vector<char> solid(info.volume_count);
    for (std::uint32_t i = 0; i < info.volume_count; i += 20) {
      dsw_volume_id id;
      check(dsw_environment_get_volume_id(triangles.environment, i, &id));
      check(dsw_environment_mark_volumes(triangles.environment, &id, 1, DSW_MARK_IMPASSABLE, 0, nullptr));
      solid[i] = 1;
    }
    const std::string key = count == 1000 ? "1e3" : "1e5";
    run_rays(key + ".short", triangles, solid, 0.3 * edge_of(count), options.quick, report);
    run_rays(key + ".middle", triangles, solid, 3 * edge_of(count), options.quick, report);
    run_rays(key + ".long", triangles, solid, 30 * edge_of(count), options.quick, report);
  }
}

}  // namespace dsw::bench
