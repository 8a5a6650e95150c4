// Moves of thin bodies against rational arithmetic.
#include "response/rigid_move.h"

#include <cmath>
#include <cstdio>
#include <cstring>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>

#include "../timing.h"
#include "judge.h"
#include "parts.h"
#include "room.h"

namespace dsw::rigid {

namespace {

using Long = std::array<long double, 3>;

const char* name_of(Plant plant) {
  static constexpr const char* kNames[] = {"random", "hidden", "missed", "grazed"};
  return kNames[static_cast<int>(plant)];
}

const char* name_of(Near near) {
  static constexpr const char* kNames[] = {"vertex outside", "edge outside", "edge inside"};
  return kNames[static_cast<int>(near)];
}

/** A body in its room, ready to move. */
struct Scene {
  std::unique_ptr<Room> room;
  Case c;
  dsw_body_id body{};
  Figure others;

  /** Draws until the body has room. */
  Scene(int dimension, Random& random) {
    for (int tries = 0; tries < 1000; ++tries) {
      if (tries % 8 == 0) room = std::make_unique<Room>(dimension, 0.06, random);
      c = draw_case(*room, random);
      if (!room->add(c.body, 0, body)) continue;
      others = {};
      for (const Figure& other : c.others) {
        dsw_body_id id{};
        if (room->add(other, 0, id)) {
          others.add(other);
        } else if (c.plant != Plant::kNone) {
          others = {};
          break;
        }
      }
      if (c.plant == Plant::kNone || c.others.empty() || !others.points.empty()) return;
      check(dsw_body_destroy(room->scene(), body));
    }
    throw std::runtime_error("a room without room");
  }
};

struct Tally {
  std::size_t moves = 0, touching = 0, stopped = 0, asked = 0;
  std::size_t passed = 0, not_free_after = 0, false_stops = 0, end_not_free = 0, time_error = 0, silent = 0;
  std::size_t wide = 0, wide_at_end = 0, avoidable = 0, passed_deep = 0, free_asked = 0, free_differs = 0;
  std::size_t faults = 0, printed = 0;
  double deepest = 0, gap_at_end = 0, least_gap = 0;
  std::vector<double> gaps;
  std::array<std::size_t, 4> planted{}, planted_touching{}, passed_by_plant{}, false_by_plant{}, late_by_plant{};
};

/** The place of the body at a fraction, as the library rounds it. */
template <int D>
std::vector<Point> rounded(const RigidMove<D>& move, const std::vector<Point>& points, double fraction) {
  const RigidMotion<D> part = move.part(fraction);
  std::vector<Point> places(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) part.place(points[i].data(), places[i].data());
  return places;
}

double unit_of(const std::vector<Point>& places) {
  double largest = 0;
  for (const Point& p : places) {
    for (const double x : p) largest = std::max(largest, std::fabs(x));
  }
  return std::nextafter(largest, 2 * largest) - largest;
}

void print_figure(const char* name, const Figure& figure) {
  std::printf("  %s:", name);
  for (const Part& v : figure.vertices) {
    const Point& p = figure.points[v.at[0]];
    std::printf(" %u (%.17g, %.17g, %.17g)", v.at[0], p[0], p[1], p[2]);
  }
  for (const Part& f : figure.faces) std::printf(" [%u %u %u]", f.at[0], f.at[1], f.at[2]);
  for (const Part& e : figure.edges) std::printf(" [%u %u]", e.at[0], e.at[1]);
  std::printf("\n");
}

void print_case(const Scene& scene, const Truth& truth, const Figure& standing, const dsw_move_report& report,
                const std::vector<Point>& places) {
  const Case& c = scene.c;
  const dsw_rigid_motion& m = c.motion;
  std::printf("  %s, depth %.3g, %.17g degrees\n", name_of(c.plant), c.depth, c.degrees);
  print_figure("body", c.body);
  for (const Figure& other : c.others) print_figure("other", other);
  std::printf("  rotation %.17g %.17g %.17g %.17g centre %.17g %.17g %.17g translation %.17g %.17g %.17g\n",
              m.rotation[0], m.rotation[1], m.rotation[2], m.rotation[3], m.centre[0], m.centre[1], m.centre[2],
              m.translation[0], m.translation[1], m.translation[2]);
  std::printf("  truth: %s at %.17g; fraction %.17g, %u contacts\n", truth.touches ? "touches" : "free", truth.time,
              report.fraction, report.contact_count);
  for (const Touching& each : truth.pairs) {
    std::printf("  touches: %zu of body", each.body.count);
    for (std::size_t i = 0; i < each.body.count; ++i) std::printf(" %u", each.body.at[i]);
    std::printf(" and");
    for (std::size_t i = 0; i < each.standing.count; ++i) {
      const Point& p = standing.points[each.standing.at[i]];
      std::printf(" (%.17g, %.17g, %.17g)", p[0], p[1], p[2]);
    }
    std::printf(", now %.3Lg apart\n", distance(places, each.body, standing, each.standing));
  }
}

/** The least gap of what touches first, in units in the last place at the end, among free places that the motion has at doubles up to
 * the touch: as all vertices are rounded from one fraction, no stop comes nearer. Infinity: none of these is free. */
template <int D>
double least_gap(const Case& c, const Truth& truth, const Figure& standing,
                 const std::function<bool(const std::vector<Point>&)>& is_free_at) {
  constexpr int kPlaces = 256;
  const RigidMove<D> move(c.motion.rotation, c.motion.centre, c.motion.translation);
  double least = HUGE_VAL, fraction = truth.time;
  for (int i = 0; i < kPlaces && fraction > 0; ++i, fraction = std::nextafter(fraction, 0)) {
    const std::vector<Point> places = rounded<D>(move, c.body.points, fraction);
    long double gap = 1e300L;
    for (const Touching& each : truth.pairs) {
      gap = std::min(gap, distance(places, each.body, standing, each.standing));
    }
    const double units = static_cast<double>(gap) / unit_of(places);
    if (units < least && is_free_at(places)) least = units;
  }
  return least;
}

/** How far the two are from passing each other beside the border of one of them, when they touch. */
template <int D>
long double beside(const std::array<Long, 3>& a, std::size_t a_count, const std::array<Long, 3>& b,
                   std::size_t b_count) {
  if (a_count > b_count) return beside<D>(b, b_count, a, a_count);
  long double least = 1e300L;
  const std::size_t sides = b_count == 3 ? 3 : 2, corners = b_count == 3 ? 2 : 1;
  for (std::size_t i = 0; i < sides; ++i) {
    const Long side[2] = {b[i], b[(i + 1) % b_count]};
    least = std::min(least, distance(a.data(), a_count, side, corners));
    if (a_count == 2) least = std::min(least, distance(&a[i], 1, b.data(), 2));
  }
  return least;
}

/** How deep what it touches first goes into it on the way that was made after the touch: by how much it is on the other side of
 * the plane of the two while it is nearest there, or by how little it would pass beside. */
template <int D>
double depth_of(const Case& c, const TurningWay& way, const Truth& truth, const Figure& standing, double until) {
  double deepest = 0;
  for (const Touching& each : truth.pairs) {
    std::array<Long, 3> other{};
    for (std::size_t i = 0; i < each.standing.count; ++i) {
      for (std::size_t k = 0; k < 3; ++k) other[i][k] = standing.points[each.standing.at[i]][k];
    }
    struct State {
      long double side, distance, beside;
    };
    const auto at = [&](long double time) {
      std::array<Long, 3> mine{};
      for (std::size_t i = 0; i < each.body.count; ++i) {
        mine[i] = place_at(way, c.body.points[each.body.at[i]], time);
      }
      return State{height<D>(mine, each.body.count, other, each.standing.count),
                   distance(mine.data(), each.body.count, other.data(), each.standing.count),
                   beside<D>(mine, each.body.count, other, each.standing.count)};
    };
    const auto at_touch = static_cast<double>(at(truth.time).beside);
    const long double before = at(std::max(0.0L, truth.time - 1e-7L)).side, way_made = until - truth.time;
    for (int i = 1; i <= 128; ++i) {
      const State now = at(truth.time + (i <= 64 ? way_made * i / 64.0L : std::ldexp(way_made, 64 - i)));
      const bool is_there = now.distance <= std::fabs(now.side) * (1 + 1e-6L);
      if (!is_there || !(now.side * before < 0)) continue;
      deepest = std::max(deepest, std::min(at_touch, static_cast<double>(std::fabs(now.side))));
    }
  }
  return deepest;
}

/** How far it could go, asked before it goes. */
dsw_free_fraction ask_free(const Scene& scene, const dsw_rigid_motion& motion) {
  double poses[14] = {0, 0, 0, 1};
  std::copy_n(motion.rotation, 4, poses + 7);
  std::copy_n(motion.translation, 3, poses + 11);
  const std::uint32_t indices[2] = {0, 1};
  dsw_free_fraction asked{};
  check(dsw_body_find_free_fractions(scene.room->scene(), scene.body, motion.centre, poses, 2, indices, nullptr, 1,
                                     &asked, nullptr));
  return asked;
}

/** Whether the motion between poses has the bits of the motion that is given: its quaternion is normalised once more. */
template <int D>
bool is_same_between_poses(const RigidMove<D>& move, const dsw_rigid_motion& motion) {
  const TurningWay a = move.way(), b = RigidMove<D>(move.part(1).rotation, motion.centre, motion.translation).way();
  return std::memcmp(&a, &b, sizeof a) == 0;
}

template <int D>
void judge(Scene& scene, bool is_printed, std::size_t number, Tally& tally) {
  const Case& c = scene.c;
  dsw_rigid_motion motion = c.motion;
  const RigidMove<D> move(motion.rotation, motion.centre, motion.translation);
  const TurningWay way = move.way();
  Figure standing = scene.room->walls();
  standing.add(scene.others);
  const Truth truth = first_touch_of(D, c.body, way, standing, scene.room->walls().points.size());

  const dsw_free_fraction asked = ask_free(scene, motion);
  dsw_move_report report{};
  report.fraction = -1;
  check(dsw_body_move_rigid(scene.room->scene(), scene.body, &motion, nullptr, &report));
  std::vector<Point> places = scene.room->places(scene.body);
  const dsw_body_contact* contacts = nullptr;
  std::size_t contact_count = 0;
  check(dsw_body_get_contacts(scene.room->scene(), scene.body, &contacts, &contact_count));
  const auto free_at = [&](const std::vector<Point>& at) {
    return is_free(D, c.body, at, scene.room->walls(), true) && is_free(D, c.body, at, scene.others, false);
  };

  if (is_same_between_poses<D>(move, motion)) {
    ++tally.free_asked;
    tally.free_differs += asked.piece_fraction != (report.fraction == 1 ? 0 : report.fraction) ||
                          asked.fraction != report.fraction || asked.starts_free != 1;
  }
  const auto plant = static_cast<std::size_t>(c.plant);
  ++tally.moves;
  ++tally.planted[plant];
  tally.asked += truth.asked;
  tally.touching += truth.touches ? 1 : 0;
  tally.planted_touching[plant] += truth.touches ? 1 : 0;
  tally.stopped += report.fraction < 1 ? 1 : 0;
  const bool passed = truth.touches && report.fraction > truth.time;
  const bool not_free = !free_at(places);
  const bool stops = !truth.touches && report.fraction < 1;
  const bool false_stop = stops && free_at(rounded<D>(move, c.body.points, 1));
  const bool silent = report.fraction < 1 && contact_count == 0;
  bool wrong_time = false;
  for (std::size_t i = 0; i < contact_count && truth.touches && !passed; ++i)
    wrong_time |= contacts[i].time != truth.time;
  tally.passed += passed ? 1 : 0;
  tally.passed_by_plant[plant] += passed ? 1 : 0;
  tally.not_free_after += not_free ? 1 : 0;
  tally.false_stops += false_stop ? 1 : 0;
  tally.false_by_plant[plant] += false_stop ? 1 : 0;
  tally.end_not_free += stops && !false_stop ? 1 : 0;
  tally.time_error += wrong_time ? 1 : 0;
  tally.late_by_plant[plant] += wrong_time ? 1 : 0;
  tally.silent += silent ? 1 : 0;
  double gap = 0;
  if (truth.touches && report.fraction < 1 && !passed) {
    long double least = 1e300L;
    for (const Touching& each : truth.pairs) {
      least = std::min(least, distance(places, each.body, standing, each.standing));
    }
    // A place is a sum of where the vertex was and of its way: it is rounded as these are.
    gap = static_cast<double>(least) / std::max(unit_of(places), unit_of(c.body.points));
    tally.gaps.push_back(gap);
    tally.wide += gap > 16 ? 1 : 0;
    const double at_end = static_cast<double>(least) / unit_of(places);
    tally.gap_at_end = std::max(tally.gap_at_end, at_end);
    if (at_end > 16) {
      const double reached = least_gap<D>(c, truth, standing, free_at);
      ++tally.wide_at_end;
      tally.avoidable += reached <= 16 ? 1 : 0;
      tally.least_gap = std::max(tally.least_gap, reached);
      if (is_printed) std::printf("  %.17g units at the end, at least %.17g at any fraction\n", at_end, reached);
    }
  }
  const auto say = [&](const char* fault, double value) {
    if (++tally.faults > tally.printed) return;
    std::printf("  case %zu (%s, %s, %.4g degrees, depth %.3g): %s %.17g; exactly %.17g, fraction %.17g\n", number,
                name_of(c.plant), c.plant == Plant::kNone ? "anywhere" : name_of(c.near), c.degrees, c.depth, fault,
                value, truth.touches ? truth.time : 2, report.fraction);
  };
  if (passed) {
    const double depth = depth_of<D>(c, way, truth, standing, report.fraction) / unit_of(places);
    tally.deepest = std::max(tally.deepest, depth);
    tally.passed_deep += depth > 1 ? 1 : 0;
    say("passed, units deep:", depth);
  }
  if (not_free) say("not free after it:", report.fraction);
  if (false_stop) say("false stop:", report.fraction);
  if (wrong_time) say("wrong time:", contacts[0].time);
  if (gap > 16) say("units left at its stop:", gap);
  if (is_printed) print_case(scene, truth, standing, report, places);
}

}  // namespace

bool run_moves(const Options& options, Report& report) {
  Tally tally;
  tally.printed = options.print;
  for (std::size_t i = 0; i < options.moves; ++i) {
    if (options.only != SIZE_MAX && i != options.only) continue;
    Random random(options.seed * 1000003 + i);
    const int dimension = i % 3 == 0 ? 2 : 3;
    Scene scene(dimension, random);
    if (dimension == 2) {
      judge<2>(scene, options.only == i, i, tally);
    } else {
      judge<3>(scene, options.only == i, i, tally);
    }
  }
  const auto set = [&](const std::string& name, std::size_t n) { report.set("rigid." + name, static_cast<double>(n)); };
  set("moves", tally.moves);
  set("moves_touching", tally.touching);
  set("moves_stopped", tally.stopped);
  set("pairs_decided_exactly", tally.asked);
  for (std::size_t plant = 0; plant < 4; ++plant) {
    const std::string name = name_of(static_cast<Plant>(plant));
    set("moves." + name, tally.planted[plant]);
    set("moves_touching." + name, tally.planted_touching[plant]);
    set("passed." + name, tally.passed_by_plant[plant]);
    set("false_stops." + name, tally.false_by_plant[plant]);
    set("time_error." + name, tally.late_by_plant[plant]);
  }
  set("passed", tally.passed);
  set("passed_by_a_unit", tally.passed_deep);
  report.set("rigid.passed_units", tally.deepest);
  set("not_free_after", tally.not_free_after);
  set("false_stops", tally.false_stops);
  set("stops_at_rounded_end", tally.end_not_free);
  set("stops_without_contact", tally.silent);
  set("time_error", tally.time_error);
  set("free_asked", tally.free_asked);
  set("free_differs", tally.free_differs);
  report.set("rigid.gap_at_stop", bench::quantile(tally.gaps, 1));
  report.set("rigid.gap_at_stop_median", bench::median(tally.gaps));
  report.set("rigid.gap_at_stop_p99", bench::quantile(tally.gaps, 0.99));
  set("gap_at_stop_wide", tally.wide);
  report.set("rigid.gap_at_stop.end_units", tally.gap_at_end);
  report.set("rigid.gap_at_stop.end_units_least", tally.least_gap);
  set("gap_at_stop.end_units_wide", tally.wide_at_end);
  set("gap_at_stop.end_units_avoidable", tally.avoidable);
  return tally.passed + tally.not_free_after + tally.false_stops + tally.time_error + tally.wide + tally.free_differs ==
         0;
}

}  // namespace dsw::rigid
