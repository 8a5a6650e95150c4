// Casts through a whole scene: floats of the peers against exact times, and what goes through closed walls.
#include "curves.h"
#include "place.h"

#include "../bullet.h"
#include "../embree.h"
#include "../exact.h"

#include <cmath>

namespace dsw::curves {

namespace {

/** Casts of known start through dsw_environment_cast_segments. */
class Ours final : public bench::Engine {
 public:
  explicit Ours(Place& place) : Engine("dartsweep exact"), place_(place) {
    dsw_cast_options_init(&options_, sizeof options_);
    options_.flags = DSW_CAST_START_KNOWN;
  }
  void prepare(const bench::Segments& segments) override {
    segments_ = segments;
    flights_.resize(segments.batch);
  }
  void run(std::size_t first, std::size_t count) override {
    check(dsw_environment_cast_segments(place_.environment(), count, &segments_.starts[first],
                                        &segments_.from[3 * first], &segments_.to[3 * first], 0, &options_,
                                        flights_.data()));
  }
  bench::Answer answer(std::size_t i) const override {
    const bool hit = flights_[i].outcome == DSW_OUTCOME_CONTACT;
    return {hit ? 0 : bench::kNone, flights_[i].time};
  }

 private:
  Place& place_;
  dsw_cast_options options_{};
  bench::Segments segments_;
  std::vector<dsw_flight> flights_;
};

struct Peer {
  std::unique_ptr<bench::Engine> engine;
  std::string name, setting;
};

std::vector<Peer> make_engines(Place& place) {
  std::vector<Peer> engines;
  engines.push_back({std::make_unique<Ours>(place), "dartsweep exact", ""});
  for (const bool packet : {false, true}) {
    for (const bool high : {false, true}) {
      for (const bool robust : {false, true}) {
        engines.push_back(
            {bench::make_embree({high, robust, false, packet, false}, place.walls()), "Embree",
             text("%s%s%s", high ? "high" : "medium", robust ? ", robust" : "", packet ? ", packets of 8" : "")});
      }
    }
  }
  const struct {
    bench::BulletKind kind;
    const char* setting;
  } kinds[] = {{bench::BulletKind::kQuantizedRay, "quantized tree, ray"},
               {bench::BulletKind::kPlainRay, "tree, ray"},
               {bench::BulletKind::kQuantizedBox, "quantized tree, box"},
               {bench::BulletKind::kTreeRay, "btDbvt, ray"},
               {bench::BulletKind::kTreeBox, "btDbvt, box"}};
  for (const auto& kind : kinds)
    engines.push_back({bench::make_bullet(kind.kind, place.walls()), "Bullet", kind.setting});
  return engines;
}

bench::Segments located(Place& place, const std::vector<std::array<Vec, 2>>& casts) {
  bench::Segments segments;
  for (const auto& [from, to] : casts) {
    segments.from.insert(segments.from.end(), from.begin(), from.end());
    segments.to.insert(segments.to.end(), to.begin(), to.end());
  }
  segments.starts.resize(casts.size());
  check(dsw_environment_locate_points(place.environment(), segments.from.data(), casts.size(), 0, nullptr,
                                      segments.starts.data(), nullptr));
  segments.batch = casts.size();
  return segments;
}

/** Far enough to go out of the lumen, in random directions. */
std::vector<std::array<Vec, 2>> random_casts(Place& place, Rng& rng, std::size_t count) {
  std::vector<std::array<Vec, 2>> casts;
  while (casts.size() < count) {
    const Vec p = place.point(rng), d = Place::direction(rng, 8);
    casts.push_back({p, {p[0] + d[0], p[1] + d[1], p[2] + d[2]}});
  }
  return casts;
}

/** Straight at a corner or the middle of a side of a wall near by, and as far behind it, where that is outside of the
 * lumen: no way there is free. */
std::vector<std::array<Vec, 2>> grazing_casts(Place& place, Rng& rng, std::size_t count) {
  std::vector<std::array<Vec, 2>> casts;
  const bench::WallMesh& walls = place.walls();
  while (casts.size() < count) {
    const Vec p = place.point_at_wall(rng, 2);
    const auto& wall = walls.triangles[rng.below(walls.triangles.size())];
    const double *a = walls.point(wall[0]), *b = walls.point(wall[1 + rng.below(2)]);
    const double share = rng.chance(0.5) ? 0 : 0.5;
    Vec x, to;
    double square = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      x[k] = a[k] + share * (b[k] - a[k]);
      to[k] = p[k] + 2 * (x[k] - p[k]);
      square += (x[k] - p[k]) * (x[k] - p[k]);
    }
    if (square > 9 || !place.holds(to) || place.is_open(to)) continue;
    casts.push_back({p, to});
  }
  return casts;
}

struct Judged {
  Errors time;
  std::size_t through = 0, invented = 0;  // of hits, of misses
};

Judged judge(const bench::Engine& engine, const std::vector<bench::Exact::First>& truth) {
  Judged judged;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const bench::Answer answer = engine.answer(i);
    const bool hit = answer.wall != bench::kNone;
    if (truth[i].walls.empty()) {
      judged.invented += hit ? 1 : 0;
      continue;
    }
    const double error = difference(hit ? answer.time : 1.0, truth[i].time);
    judged.through += hit ? 0 : 1;
    judged.time.values.push_back(error);
  }
  return judged;
}

struct Measured {
  std::vector<Peer> engines;
  std::vector<double> seconds;
  std::vector<Judged> judged;
};

Measured measure(const Options& options, Place& place, const std::vector<std::array<Vec, 2>>& casts) {
  const bench::Segments segments = located(place, casts);
  const bench::Exact exact(place.walls());
  std::vector<bench::Exact::First> truth;
  for (const auto& [from, to] : casts) truth.push_back(exact.first(from.data(), to.data()));
  Measured measured;
  measured.engines = make_engines(place);
  std::vector<Method> methods;
  for (const Peer& peer : measured.engines) {
    bench::Engine* engine = peer.engine.get();
    engine->prepare(segments);
    methods.push_back(
        {peer.name, peer.setting, "setting", {}, [engine, &segments] { engine->run(0, segments.batch); }});
  }
  measured.seconds = time_methods(methods, casts.size(), options.rounds());
  for (const Peer& peer : measured.engines) measured.judged.push_back(judge(*peer.engine, truth));
  return measured;
}

std::string best_of(const Curve& curve, const std::string& method) {
  const Point* best = nullptr;
  for (const Point& p : curve.points) {
    if (p.method == method &&
        (best == nullptr || p.error < best->error || (!(best->error < p.error) && p.seconds < best->seconds))) {
      best = &p;
    }
  }
  return best == nullptr ? ""
                         : text("%s (%s): %.2g at %.0f ns", method.c_str(), best->setting.c_str(), best->error,
                                1e9 * best->seconds);
}

}  // namespace

void cast_curves(const Options& options) {
  Place place(Kind::kVessel, 20, options.seed);
  Rng rng(options.seed + 500);
  const std::size_t count = options.count(2000, 10000);
  Curve times{"cast_time", "cast of 8 cells out of a vessel", "time of contact", "of the way", {}, ""};
  const Measured random = measure(options, place, random_casts(place, rng, count));
  for (std::size_t i = 0; i < random.engines.size(); ++i) {
    const Judged& judged = random.judged[i];
    times.points.push_back(
        {random.engines[i].name, random.engines[i].setting, i == 0 ? "" : "setting", random.seconds[i],
         judged.time.mean(), judged.time.values.size(),
         judged.time.spread() + text("; through walls %zu, invented %zu", judged.through, judged.invented)});
  }
  const Point& ours = times.points[0];
  times.advice = text(
      "Where contacts decide what happens, take the exact cast (%.2g at %.0f ns). Where a picture is all that is "
      "wanted, a tree of rays "
      "in floats does: %s; %s.",
      ours.error, 1e9 * ours.seconds, best_of(times, "Embree").c_str(), best_of(times, "Bullet").c_str());
  times.write(options.out);

  Curve grazing{"cast_through",
                "cast at a corner or the middle of a side of a wall",
                "share of casts through a closed wall",
                "",
                {},
                ""};
  const Measured aimed = measure(options, place, grazing_casts(place, rng, count));
  for (std::size_t i = 0; i < aimed.engines.size(); ++i) {
    const Judged& judged = aimed.judged[i];
    const auto hits = static_cast<double>(std::max<std::size_t>(1, judged.time.values.size()));
    grazing.points.push_back({aimed.engines[i].name, aimed.engines[i].setting, i == 0 ? "" : "setting",
                              aimed.seconds[i], static_cast<double>(judged.through) / hits, judged.time.values.size(),
                              text("%zu through a closed wall", judged.through)});
  }
  grazing.advice = text("Of exact casts %.2g pass, at %.0f ns. Of a peer take the setting by which least pass: %s; %s.",
                        grazing.points[0].error, 1e9 * grazing.points[0].seconds, best_of(grazing, "Embree").c_str(),
                        best_of(grazing, "Bullet").c_str());
  grazing.write(options.out);
}

}  // namespace dsw::curves
