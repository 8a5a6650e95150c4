// What it costs to ask how far a body could go, over making it at each pose and moving it.
#include <array>
#include <cmath>
#include <cstring>
#include <string>

#include "../timing.h"
#include "lattice.h"
#include "parts.h"
#include "response/rigid_move.h"

namespace dsw::rigid {

namespace {

/** The turn that leads from b to a: quaternions x, y, z, w of length 1. */
std::array<double, 4> quotient(const double* a, const double* b) {
  std::array<double, 4> q{};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    q[k] = (b[3] * a[k] - a[3] * b[k]) - (a[i] * b[j] - a[j] * b[i]);
  }
  q[3] = (a[3] * b[3] + a[0] * b[0]) + (a[1] * b[1] + a[2] * b[2]);
  return q;
}

using scenes::Random;

/** A motion of a body from a pose of its own. */
struct Query {
  double from[7], to[7];
};

Query draw_query(const Lattice& lattice, const Point& start, Random& random) {
  Query query{};
  const Point middle = lattice.draw_middle(random);
  for (double* const pose : {query.from, query.to}) {
    for (std::size_t k = 0; k < 3; ++k) {
      pose[k] = random.uniform(-0.1, 0.1);
      pose[4 + k] = middle[k] - start[k] + random.uniform(-0.4, 0.4);
    }
    pose[3] = 1;
  }
  return query;
}

}  // namespace

void run_free(const Options& options, Report& report) {
  Lattice lattice(options.seed);
  const std::pair<const char*, Figure> bodies[] = {
      {"rod", make_rope(1, 0.6)}, {"box", make_box({0.2, 0.15, 0.25})}, {"ball66", make_ball(2, 0.3)}};
  double worst = 0;
  for (const auto& [name, shape] : bodies) {
    Random random(options.seed);
    Point start{};
    dsw_body_id id{};
    Figure body;
    do {
      start = lattice.draw_middle(random);
      body = shape;
      for (Point& p : body.points) p = p + start;
    } while (!add_body(lattice.scene(), body, 0, id));
    const std::size_t count = 20 * options.bodies;
    std::vector<double> poses;
    std::vector<std::uint32_t> indices;
    for (std::size_t i = 0; i < count; ++i) {
      const Query query = draw_query(lattice, start, random);
      poses.insert(poses.end(), query.from, query.from + 7);
      poses.insert(poses.end(), query.to, query.to + 7);
      indices.push_back(static_cast<std::uint32_t>(2 * i));
      indices.push_back(static_cast<std::uint32_t>(2 * i + 1));
    }
    std::vector<dsw_free_fraction> found(count);
    const double asked = bench::cpu_time_ns([&] {
      check(dsw_body_find_free_fractions(lattice.scene(), id, start.data(), poses.data(), 2 * count, indices.data(),
                                         nullptr, count, found.data(), nullptr));
    });
    check(dsw_body_destroy(lattice.scene(), id));
    std::size_t starts = 0, whole = 0, differ = 0;
    double moved = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const double *const a = poses.data() + 14 * i, *const b = a + 7;
      const RigidMotion<3> to_start = RigidMove<3>(a, start.data(), a + 4).part(1);
      Figure posed = body;
      for (Point& p : posed.points) to_start.place(p.data(), p.data());
      double fraction = 0;
      bool is_free = false;
      moved += bench::cpu_time_ns([&] {
        is_free = add_body(lattice.scene(), posed, 0, id);
        if (!is_free) return;
        const RigidMotion<3> to_end = RigidMove<3>(b, start.data(), b + 4).part(1);
        const std::array<double, 4> turn = quotient(to_end.rotation, to_start.rotation);
        dsw_rigid_motion motion{};
        for (std::size_t k = 0; k < 4; ++k) motion.rotation[k] = turn[k];
        for (std::size_t k = 0; k < 3; ++k) {
          motion.centre[k] = start[k] + a[4 + k];
          motion.translation[k] = b[4 + k] - a[4 + k];
        }
        dsw_move_report made{};
        check(dsw_body_move_rigid(lattice.scene(), id, &motion, nullptr, &made));
        fraction = made.fraction;
        check(dsw_body_destroy(lattice.scene(), id));
      });
      starts += is_free ? 1 : 0;
      whole += fraction == 1 ? 1 : 0;
      differ += is_free != (found[i].starts_free != 0) || fraction != found[i].fraction ? 1 : 0;
    }
    const std::string key = std::string("rigid.free.") + name;
    report.set(key + ".us_per_path", 1e-3 * asked / static_cast<double>(count));
    report.set(key + ".over_moves", asked / moved);
    report.set(key + ".starts", static_cast<double>(starts));
    report.set(key + ".whole", static_cast<double>(whole));
    report.set(key + ".differ", static_cast<double>(differ));
    worst = std::max(worst, asked / moved);
  }
  report.set("rigid.free.over_moves", worst);
}

}  // namespace dsw::rigid
