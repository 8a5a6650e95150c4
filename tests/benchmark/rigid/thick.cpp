// Bodies with a radius: whether they keep it from everything, on the whole way.
#include "response/rigid_move.h"

#include <cstdio>
#include <memory>

#include "judge.h"
#include "parts.h"
#include "room.h"

namespace dsw::rigid {

namespace {

struct Tally {
  std::size_t moves = 0, stopped = 0, violations = 0, at_end = 0;
};

/** No point of the body goes faster on a way: 2 sin h / n from the axis, with n at least (1 + cos h) / 2, and the centre's speed. */
long double speed_of(const Figure& body, const TurningWay& way) {
  const double* const q = way.turn[1];
  double radius = 0;
  for (const Point& p : body.points) {
    radius = std::max(radius, length(p - Point{way.centre[0], way.centre[1], way.centre[2]}));
  }
  const Point centre_way{way.place[1][0] - way.place[0][0], way.place[1][1] - way.place[0][1],
                         way.place[1][2] - way.place[0][2]};
  return 1.001L * (4 * length({q[0], q[1], q[2]}) / (1 + q[3]) * radius + length(centre_way));
}

template <int D>
void judge(Room& room, Random& random, std::size_t number, Tally& tally) {
  const Case c = draw_case(room, random);
  const bool is_thin = !c.others.empty() && random.index(2) == 0, sees_itself = random.index(4) == 0;
  const double radius = is_thin ? 0 : 0.005 * std::exp(random.uniform() * std::log(20)),
               of_others = is_thin || random.index(2) == 0 ? 0.02 : 0;
  dsw_body_id body{};
  if (!room.add(c.body, radius, body, sees_itself ? std::uint32_t{DSW_BODY_SELF_CONTACTS} : 0u)) return;
  Figure others;
  for (const Figure& other : c.others) {
    dsw_body_id id{};
    if (room.add(other, of_others, id)) others.add(other);
  }
  dsw_rigid_motion motion = c.motion;
  const TurningWay way = RigidMove<D>(motion.rotation, motion.centre, motion.translation).way();
  dsw_move_report report{};
  check(dsw_body_move_rigid(room.scene(), body, &motion, nullptr, &report));
  ++tally.moves;
  tally.stopped += report.fraction < 1 ? 1 : 0;
  const PlacesAt on_way = [&](long double time) {
    std::vector<std::array<long double, 3>> places;
    for (const Point& p : c.body.points) places.push_back(place_at(way, p, time));
    return places;
  };
  const std::vector<Point> end = room.places(body);
  const PlacesAt at_end = [&](long double) {
    std::vector<std::array<long double, 3>> places;
    for (const Point& p : end) places.push_back({p[0], p[1], p[2]});
    return places;
  };
  const auto breaks = [&](const PlacesAt& places, long double speed, const Figure& standing, double keep) {
    return first_nearer(D, c.body, places, speed, standing, keep * (1 - 0x1p-34L), report.fraction);
  };
  const long double speed = speed_of(c.body, way);
  const auto worst = [&](const PlacesAt& places, long double fast) {
    return std::min(breaks(places, fast, room.walls(), radius), breaks(places, fast, others, radius + of_others));
  };
  const long double first = worst(on_way, speed), last = worst(at_end, 0);
  tally.violations += first <= 1 || last <= 1 ? 1 : 0;
  tally.at_end += last <= 1 ? 1 : 0;
  if (first <= 1 || last <= 1) {
    std::printf("  thick case %zu: too near from %.17Lg on, fraction %.17g%s, radius %.17g, %.4g degrees\n", number,
                first, report.fraction, last <= 1 ? ", and at the end" : "", radius, c.degrees);
  }
  check(dsw_body_destroy(room.scene(), body));
}

}  // namespace

bool run_thick(const Options& options, Report& report) {
  Tally tally;
  for (std::size_t i = 0; tally.moves < options.thick && i < 100 * options.thick; ++i) {
    Random random(options.seed * 2000003 + i);
    const int dimension = i % 3 == 0 ? 2 : 3;
    Room room(dimension, 0.06, random);
    if (dimension == 2) {
      judge<2>(room, random, i, tally);
    } else {
      judge<3>(room, random, i, tally);
    }
  }
  report.set("rigid.thick_moves", static_cast<double>(tally.moves));
  report.set("rigid.thick_stopped", static_cast<double>(tally.stopped));
  report.set("rigid.thick_violations", static_cast<double>(tally.violations));
  report.set("rigid.thick_violations_at_end", static_cast<double>(tally.at_end));
  return tally.violations == 0;
}

}  // namespace dsw::rigid
