// Bisection against the exact time of contact, where the whole scene is searched.
#include "curves.h"
#include "moves.h"

#include <cmath>

namespace dsw::curves {

namespace {

constexpr std::uint32_t kDepths[] = {1, 2, 3, 5, 7, 10, 15, 20, 25, 30, 40, 50};

std::vector<Move> moves_that_touch(Place& place, Rng& rng, std::size_t count, int vertices, dsw_level level) {
  std::vector<Move> moves;
  while (moves.size() < count) {
    Move move = random_move(place, rng, vertices, 1.0, 1.0, level);
    // An event that the shift alone decides has no time of its own.
    if (!move.truth.events.empty() && move.truth.events[0].order == 0) moves.push_back(std::move(move));
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
    const auto contacts = movers.contacts(i);
    if (contacts.empty()) {
      ++answers.missed;
      continue;
    }
    const dsw_contact& contact = contacts.front();
    const mpq_class time = time_of(moves[i].truth);
    answers.time.values.push_back(difference(contact.time, time));
    answers.place.values.push_back(distance_at(moves[i].body.at[0], moves[i].targets[0], time, contact.position));
    answers.other += contact.time != moves[i].truth.events[0].time ? 1 : 0;
  }
  return answers;
}

/** The point at which errors fall below what a double can tell. */
std::string advise(const Curve& curve, const Point& exact) {
  const Point* enough = nullptr;
  for (const Point& p : curve.points) {
    if (p.method == "dartsweep bisection" && enough == nullptr && p.error < 1e-6) enough = &p;
  }
  if (enough == nullptr) return "Take the exact time.";
  return text(
      "Take the exact time (DSW_SEARCH_EXACT): bisection starts from it and only adds to it. Where a host wants a time "
      "that "
      "has itself been seen to be free, depth %s is off by %.1g %s and costs %.2f times as much.",
      enough->setting.c_str(), enough->error, curve.error_unit.c_str(), enough->seconds / exact.seconds);
}

void bisect(const Options& options, int vertices, dsw_level level, Curve& times, Curve* places) {
  Place place(Kind::kFaces, 12, options.seed);
  Rng rng(options.seed + 100);
  const auto moves = moves_that_touch(place, rng, options.count(300, 3000), vertices, level);
  std::vector<std::unique_ptr<Movers>> movers;
  std::vector<Method> methods;
  const auto add = [&](const std::string& name, const std::string& setting, const dsw_move_options& move) {
    movers.push_back(std::make_unique<Movers>(place, moves, Setting{level, 0, 0, move}));
    Movers* mine = movers.back().get();
    methods.push_back(
        {name, setting, setting.empty() ? "" : "halvings", [mine] { mine->prepare(); }, [mine] { mine->run(); }});
  };
  add("dartsweep exact", "", move_options());
  for (const std::uint32_t depth : kDepths) {
    dsw_move_options move = move_options();
    move.search = DSW_SEARCH_BISECTION;
    move.bisection_depth = depth;
    add("dartsweep bisection", std::to_string(depth), move);
  }
  const auto seconds = time_methods(methods, moves.size(), options.rounds());
  for (std::size_t i = 0; i < methods.size(); ++i) {
    const Answers answers = judge(moves, *movers[i]);
    std::string note = answers.missed == 0 ? "" : text("; missed %zu", answers.missed);
    if (i == 0) note += text("; %zu times are not the largest double before the exact one", answers.other);
    const Method& m = methods[i];
    times.points.push_back({m.name, m.setting, m.unit, seconds[i], answers.time.mean(), moves.size() - answers.missed,
                            answers.time.spread() + note});
    if (places == nullptr) continue;
    places->points.push_back({m.name, m.setting, m.unit, seconds[i], answers.place.mean(),
                              moves.size() - answers.missed, answers.place.spread()});
  }
}

}  // namespace

void time_curves(const Options& options) {
  Curve edge_time{"edge_time", "move of an edge's end that touches", "time of contact", "of the move", {}, ""};
  Curve edge_place{"edge_place", edge_time.item, "where the moving end is at the contact", "cells", {}, ""};
  bisect(options, 2, DSW_LEVEL_EDGES_SWEPT, edge_time, &edge_place);
  edge_time.advice = advise(edge_time, edge_time.points[0]);
  edge_place.advice = advise(edge_place, edge_place.points[0]);
  edge_time.write(options.out);
  edge_place.write(options.out);
}

}  // namespace dsw::curves
