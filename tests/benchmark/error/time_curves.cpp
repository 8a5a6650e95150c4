// The dichotomic search against the exact one, where the whole scene is searched: for each contact, and for each move
// whether it touches or not.
#include "curves.h"
#include "moves.h"

#include <algorithm>
#include <cmath>

namespace dsw::curves {

namespace {

constexpr std::uint32_t kDepths[] = {1, 2, 3, 5, 7, 10, 15, 20, 25, 30, 40, 52};
// The level of the paper, and the one whose moves pass nothing. The first point of each is the exact search's.
constexpr dsw_level kLevels[] = {DSW_LEVEL_EDGES_SWEPT, DSW_LEVEL_EDGES};
constexpr const char* kSuffix[] = {"", " (EDGES)"};
constexpr const char* kNames[] = {"EDGES_SWEPT", "EDGES"};
constexpr std::size_t kPerLevel = 1 + std::size(kDepths);

/** Moves of one end of an edge. Only those that touch, or as they come. */
std::vector<Move> moves_of_ends(Place& place, Rng& rng, std::size_t count, bool touching) {
  std::vector<Move> moves;
  while (moves.size() < count) {
    Move move = random_move(place, rng, 2, 1.0, touching ? 1.0 : 0.25, DSW_LEVEL_EDGES_SWEPT);
    // An event that the shift alone decides has no time of its own.
    const bool met = !move.truth.events.empty(), timed = met && move.truth.events[0].order == 0;
    if (timed || (!touching && !met)) moves.push_back(std::move(move));
  }
  return moves;
}

struct Answers {
  Errors time, place;
  std::size_t missed = 0, other = 0;  // other: the reported time is not the largest double before the exact one
};

Answers judge(const std::vector<Move>& moves, const Movers& movers) {
  Answers answers;
  for (std::size_t i = 0; i < moves.size(); ++i) {
    if (moves[i].truth.events.empty()) continue;
    const auto contacts = movers.contacts(i);
    if (contacts.empty()) {
      ++answers.missed;
      continue;
    }
    const dsw_body_contact& contact = contacts.front();
    const mpq_class time = time_of(moves[i].truth);
    answers.time.values.push_back(difference(contact.time, time));
    answers.place.values.push_back(distance_at(moves[i].body.at[0], moves[i].targets[0], time, contact.position));
    answers.other += contact.time != moves[i].truth.events[0].time ? 1 : 0;
  }
  return answers;
}

/** Which search is faster at which depth, for each level. */
std::string advise(const Curve& curve) {
  std::string advice;
  for (std::size_t level = 0; level < std::size(kLevels); ++level) {
    const Point* const exact = &curve.points[level * kPerLevel];
    const Point *const first = exact + 1, *const end = exact + kPerLevel;
    const Point *last = nullptr, *slowest = first;
    for (const Point* p = first; p != end && p->seconds < exact->seconds; ++p) last = p;
    for (const Point* p = first; p != end; ++p) slowest = p->seconds > slowest->seconds ? p : slowest;
    if (level != 0) advice += ' ';
    advice += text("At %s the exact search ", kNames[level]);
    if (last == nullptr) {
      advice += text("is faster than bisection at every depth: bisection takes %.2f times as long at depth %s",
                     first->seconds / exact->seconds, exact[1].setting.c_str());
    } else {
      advice += text("is slower than bisection up to depth %s, which is off by %.1g%s%s and takes %.2f times as long",
                     last->setting.c_str(), last->error, curve.error_unit.empty() ? "" : " ", curve.error_unit.c_str(),
                     last->seconds / exact->seconds);
    }
    advice += text(", %.2f times at depth %s.", slowest->seconds / exact->seconds, slowest->setting.c_str());
  }
  return advice;
}

void measure(const Options& options, bool touching, Curve& times, Curve* places) {
  Place place(Kind::kFaces, 12, options.seed);
  Rng rng(options.seed + 100);
  const auto moves = moves_of_ends(place, rng, options.count(300, 1500), touching);
  std::size_t touch = 0;
  for (const Move& move : moves) touch += move.truth.events.empty() ? 0 : 1;
  std::vector<std::unique_ptr<Movers>> movers;
  std::vector<Method> methods;
  const auto add = [&](const std::string& name, const std::string& setting, dsw_level level,
                       const dsw_move_options& move) {
    movers.push_back(std::make_unique<Movers>(place, moves, Setting{level, 0, 0, move}));
    Movers* mine = movers.back().get();
    methods.push_back(
        {name, setting, setting.empty() ? "" : "halvings", [mine] { mine->prepare(); }, [mine] { mine->run(); }});
  };
  for (std::size_t level = 0; level < std::size(kLevels); ++level) {
    add(std::string("dartsweep exact") + kSuffix[level], "", kLevels[level], move_options());
    for (const std::uint32_t depth : kDepths) {
      dsw_move_options move = move_options();
      move.search = DSW_SEARCH_BISECTION;
      move.bisection_depth = depth;
      add(std::string("dartsweep bisection") + kSuffix[level], std::to_string(depth), kLevels[level], move);
    }
  }
  const auto seconds = time_methods(methods, moves.size(), options.rounds());
  for (std::size_t i = 0; i < methods.size(); ++i) {
    const Answers answers = judge(moves, *movers[i]);
    std::string note = answers.missed == 0 ? "" : text("; missed %zu", answers.missed);
    if (i % kPerLevel == 0) note += text("; %zu times are not the largest double before the exact one", answers.other);
    if (!touching) note += text("; %zu of %zu moves touch", touch, moves.size());
    const Method& m = methods[i];
    times.points.push_back({m.name, m.setting, m.unit, seconds[i], answers.time.mean(), touch - answers.missed,
                            answers.time.spread() + note});
    if (places == nullptr) continue;
    places->points.push_back(
        {m.name, m.setting, m.unit, seconds[i], answers.place.mean(), touch - answers.missed, answers.place.spread()});
  }
}

/** Degrees between the normal of a contact and that of the exact search, which the curve contact_normal judges. */
double degrees_between(const double* a, const double* b) {
  double square = 0;
  for (int i = 0; i < 3; ++i) square += (a[i] - b[i]) * (a[i] - b[i]);
  return 2 * std::asin(std::min(1.0, std::sqrt(square) / 2)) * 180 / 3.14159265358979323846;
}

/** The normals of the dichotomic search: that of the triangle met last, and the paper's, at a vertex of the wall. */
void measure_normals(const Options& options, Curve& curve) {
  Place place(Kind::kVessel, 12, options.seed);
  Rng rng(options.seed + 100);
  const auto moves = moves_of_ends(place, rng, options.count(300, 1500), true);
  std::vector<std::unique_ptr<Movers>> movers;
  std::vector<Method> methods;
  const auto add = [&](const std::string& name, const std::string& setting, const dsw_move_options& move) {
    movers.push_back(std::make_unique<Movers>(place, moves, Setting{DSW_LEVEL_EDGES_SWEPT, 0, 0, move}));
    Movers* mine = movers.back().get();
    methods.push_back(
        {name, setting, setting.empty() ? "" : "halvings", [mine] { mine->prepare(); }, [mine] { mine->run(); }});
  };
  add("dartsweep exact", "", move_options());
  for (const dsw_search search : {DSW_SEARCH_BISECTION, DSW_SEARCH_BISECTION_VERTEX}) {
    for (const std::uint32_t depth : {1u, 5u, 10u, 20u, 40u}) {
      dsw_move_options move = move_options();
      move.search = search;
      move.bisection_depth = depth;
      const char* name = search == DSW_SEARCH_BISECTION ? "dartsweep bisection" : "dartsweep bisection, at a vertex";
      add(name, std::to_string(depth), move);
    }
  }
  const auto seconds = time_methods(methods, moves.size(), options.rounds());
  for (std::size_t i = 0; i < methods.size(); ++i) {
    Errors errors;
    for (std::size_t m = 0; m < moves.size(); ++m) {
      const auto exact = movers[0]->contacts(m), found = movers[i]->contacts(m);
      if (exact.empty() || found.empty()) continue;
      errors.values.push_back(degrees_between(exact.front().contact.normal, found.front().contact.normal));
    }
    const Method& m = methods[i];
    curve.points.push_back(
        {m.name, m.setting, m.unit, seconds[i], errors.mean(), errors.values.size(), errors.spread()});
  }
  const auto at = [&](std::size_t i) { return curve.points[i].error; };
  curve.advice =
      text("At depth 20 the normal of the triangle is off by %.2g degrees in the mean, that at a vertex by %.2g.",
           at(4), at(9));
}

}  // namespace

void time_curves(const Options& options) {
  Curve edge_time{"edge_time", "move of an edge's end that touches", "time of contact", "of the move", {}, ""};
  Curve edge_place{"edge_place", edge_time.item, "where the moving end is at the contact", "cells", {}, ""};
  Curve move_time{"move_time", "move of an edge's end", edge_time.error_name, edge_time.error_unit, {}, ""};
  measure(options, true, edge_time, &edge_place);
  measure(options, false, move_time, nullptr);
  Curve edge_normal{"edge_normal", edge_time.item, "normal at the contact", "degrees", {}, ""};
  measure_normals(options, edge_normal);
  edge_normal.write(options.out);
  for (Curve* curve : {&edge_time, &edge_place, &move_time}) {
    curve->advice = advise(*curve);
    curve->write(options.out);
  }
}

}  // namespace dsw::curves
