// What each level misses of what a face sweeps, against the length of its edges.
#include "curves.h"
#include "moves.h"

namespace dsw::curves {

namespace {

constexpr double kLengths[] = {0.1, 0.25, 0.5, 1, 2, 4};
constexpr dsw_level kLevels[] = {DSW_LEVEL_POINTS, DSW_LEVEL_EDGES, DSW_LEVEL_EDGES_SWEPT, DSW_LEVEL_FACES};
constexpr const char* kNames[] = {"dartsweep POINTS", "dartsweep EDGES", "dartsweep EDGES_SWEPT", "dartsweep FACES"};

void measure(const Options& options, Kind kind, Curve& curve) {
  Place place(kind, 16, options.seed);
  for (const double length : kLengths) {
    Rng rng(options.seed + 200);
    std::vector<Move> moves;
    std::size_t touching = 0;
    const std::size_t wanted = options.count(200, 800), most = 20 * wanted;
    while (touching < wanted && moves.size() < most) {
      // Short edges rarely touch anything: every other one starts within its step of a wall.
      const double step = 0.5 * length;
      const Vec start = moves.size() % 2 == 0 ? place.point(rng) : place.point_at_wall(rng, step);
      auto move = move_from(place, rng, start, 3, length, step, DSW_LEVEL_FACES);
      if (!move) continue;
      touching += move->truth.events.empty() ? 0 : 1;
      moves.push_back(std::move(*move));
    }
    std::vector<std::unique_ptr<Movers>> movers;
    std::vector<Method> methods;
    for (std::size_t i = 0; i < 4; ++i) {
      movers.push_back(std::make_unique<Movers>(place, moves, Setting{kLevels[i], 0, 0, move_options()}));
      Movers* mine = movers.back().get();
      methods.push_back(
          {kNames[i], text("%g", length), "cells long", [mine] { mine->prepare(); }, [mine] { mine->run(); }});
    }
    const auto seconds = time_methods(methods, moves.size(), options.rounds());
    for (std::size_t i = 0; i < 4; ++i) {
      std::size_t missed = 0, invented = 0;
      for (std::size_t m = 0; m < moves.size(); ++m) {
        const bool found = !movers[i]->contacts(m).empty(), there = !moves[m].truth.events.empty();
        missed += there && !found ? 1 : 0;
        invented += found && !there ? 1 : 0;
      }
      const Method& m = methods[i];
      curve.points.push_back({m.name, m.setting, m.unit, seconds[i],
                              static_cast<double>(missed) / static_cast<double>(std::max<std::size_t>(1, touching)),
                              touching,
                              text("%zu missed, %zu invented, of %zu moves", missed, invented, moves.size())});
    }
  }
}

/** The cheapest level that misses less than 1 %, by length. */
std::string advise(const Curve& curve) {
  std::string advice = "The cheapest level that misses less than 1 % of the contacts:";
  for (std::size_t i = 0; i + 3 < curve.points.size(); i += 4) {
    const Point* all = &curve.points[i + 3];
    const Point* level = &curve.points[i];
    while (level != all && level->error >= 0.01) ++level;
    advice += text("%s at %s cells %s", i == 0 ? "" : ";", level->setting.c_str(), level->method.c_str());
    if (level != all) {
      advice += text(" (misses %.2g %%; what misses nothing costs %.1f times as much)", 100 * level->error,
                     all->seconds / level->seconds);
    }
  }
  return advice + ".";
}

}  // namespace

void level_curves(const Options& options) {
  const struct {
    Kind kind;
    const char* name;
  } scenes[] = {{Kind::kVessel, "missed_vessel"}, {Kind::kFaces, "missed_faces"}, {Kind::kSpikes, "missed_spikes"}};
  for (const auto& scene : scenes) {
    Curve curve{scene.name,
                "move of a face's corner by half an edge, every other one near a wall",
                "share of contacts missed",
                "",
                {},
                ""};
    measure(options, scene.kind, curve);
    curve.advice = advise(curve);
    curve.write(options.out);
  }
}

}  // namespace dsw::curves
