// What a vertex costs in a rigid move, over dsw_body_move of an equal body to the places where the rigid motion leads.
#include "response/rigid_move.h"

#include <cmath>
#include <string>

#include "../timing.h"
#include "lattice.h"
#include "parts.h"

namespace dsw::rigid {

namespace {

using scenes::Random;

struct Body {
  const char* name;
  Figure shape;
};

struct Times {
  std::vector<double> rigid, chords;  // us a vertex
};

Point drawn_direction(Random& random) {
  while (true) {
    const Point p{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    if (length(p) > 0.1 && length(p) < 1) return unit(p);
  }
}

/** The least of three times of a move, each with a body of its own. */
template <class Move>
double least_time(Lattice& lattice, const Figure& body, Move move) {
  double least = 0;
  for (int round = 0; round < 3; ++round) {
    dsw_body_id id{};
    if (!add_body(lattice.scene(), body, 0, id)) return 0;
    const double ns = bench::cpu_time_ns([&] { move(id); });
    least = round == 0 ? ns : std::min(least, ns);
    check(dsw_body_destroy(lattice.scene(), id));
  }
  return 1e-3 * least / static_cast<double>(body.points.size());
}

void time_moves(Lattice& lattice, Random& random, const Figure& shape, Times& free, Times& contact) {
  Figure body = shape;
  const Point middle = lattice.draw_middle(random), shift{random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2), 0};
  for (Point& p : body.points) p = p + middle + shift;
  dsw_rigid_motion motion{};
  const Point axis = drawn_direction(random);
  const double half = random.uniform(0.5, 15) * 3.14159265358979323846 / 180;
  for (std::size_t k = 0; k < 3; ++k) {
    motion.rotation[k] = std::sin(half) * axis[k];
    motion.centre[k] = middle[k] + random.uniform(-0.5, 0.5);
    motion.translation[k] = random.uniform(-0.3, 0.3);
  }
  motion.rotation[3] = std::cos(half);
  const RigidMotion<3> whole = RigidMove<3>(motion.rotation, motion.centre, motion.translation).part(1);
  std::vector<Point> targets(body.points.size());
  for (std::size_t i = 0; i < targets.size(); ++i) whole.place(body.points[i].data(), targets[i].data());
  dsw_move_report report{};
  const double rigid = least_time(lattice, body, [&](dsw_body_id id) {
    check(dsw_body_move_rigid(lattice.scene(), id, &motion, nullptr, &report));
  });
  const double fraction = report.fraction;
  const double chords = least_time(lattice, body, [&](dsw_body_id id) {
    check(dsw_body_move(lattice.scene(), id, targets[0].data(), targets.size(), 0, nullptr, &report));
  });
  if (rigid == 0 || chords == 0) return;  // no room
  const bool is_free = fraction == 1 && report.contact_count == 0;
  if (!is_free && (fraction == 1 || report.contact_count == 0)) return;  // chords and arcs differ
  Times& times = is_free ? free : contact;
  times.rigid.push_back(rigid);
  times.chords.push_back(chords);
}

}  // namespace

void run_cost(const Options& options, Report& report) {
  Lattice lattice(options.seed);
  const Body bodies[] = {{"rod", make_rope(1, 0.6)},
                         {"rope", make_rope(40, 0.8)},
                         {"box", make_box({0.2, 0.15, 0.25})},
                         {"ball18", make_ball(1, 0.3)},
                         {"ball66", make_ball(2, 0.3)}};
  double worst[2] = {};
  for (const Body& body : bodies) {
    Times free, contact;
    Random random(options.seed);
    for (std::size_t i = 0; i < 20 * options.bodies; ++i) {
      if (std::min(free.rigid.size(), contact.rigid.size()) >= options.bodies) break;
      time_moves(lattice, random, body.shape, free, contact);
    }
    for (const Times* times : {&free, &contact}) {
      const std::string what = std::string(times == &free ? "free." : "contact.") + body.name;
      const double ratio = bench::median_ratio(times->rigid, times->chords);
      report.set("rigid.us_per_vertex." + what, bench::median(times->rigid));
      report.set("rigid.us_per_vertex_over_move." + what, ratio);
      double& most = worst[times == &free ? 0 : 1];
      most = std::max(most, ratio);
    }
  }
  report.set("rigid.us_per_vertex_over_move.free", worst[0]);
  report.set("rigid.us_per_vertex_over_move.contact", worst[1]);
}

}  // namespace dsw::rigid
