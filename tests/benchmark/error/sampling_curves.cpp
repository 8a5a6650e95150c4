// With how many vertices a catheter is sampled, and what each level sees then.
#include "curves.h"
#include "moves.h"

#include <cmath>

namespace dsw::curves {

namespace {

// A catheter is two straight halves, of which the middle moves.
constexpr double kLength = 12;  // cells
constexpr std::uint32_t kVertices[] = {5, 9, 17, 33, 65, 129, 199};

struct Bend {
  Vec first, middle, last, to;
  bool touches = false;
};

/** The truth is that of the two triangles which the halves sweep. */
std::vector<Bend> random_bends(Place& place, Rng& rng, std::size_t count) {
  std::vector<Bend> bends;
  const auto beside = [&](const Vec& p, double length) {
    const Vec d = Place::direction(rng, length);
    return Vec{p[0] + d[0], p[1] + d[1], p[2] + d[2]};
  };
  while (bends.size() < count) {
    Bend b;
    b.middle = place.point(rng);
    b.first = beside(b.middle, 0.5 * kLength);
    b.last = beside(b.middle, 0.5 * kLength);
    b.to = beside(b.middle, rng.range(0, 1));
    if (!place.holds(b.first) || !place.holds(b.last) || !place.holds(b.to)) continue;
    if (!place.is_free({b.first, b.middle, b.last})) continue;
    for (const Vec* end : {&b.first, &b.last}) {
      const auto truth = place.exact().move({b.middle, b.to, {*end}, {}}, DSW_LEVEL_EDGES_SWEPT);
      b.touches = b.touches || !truth.events.empty();
    }
    bends.push_back(b);
  }
  return bends;
}

Vec between(const Vec& a, const Vec& b, double share) {
  if (share >= 1) return b;
  return {a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]), a[2] + share * (b[2] - a[2])};
}

/** Vertex `v` of `count` on the way from first over middle to last. */
Vec on_bend(const Bend& b, const Vec& middle, std::uint32_t v, std::uint32_t count) {
  const std::uint32_t half = (count - 1) / 2;
  return v <= half ? between(b.first, middle, v / static_cast<double>(half))
                   : between(middle, b.last, (v - half) / static_cast<double>(half));
}

Trip trip_of(const Bend& b, std::uint32_t vertices) {
  Trip trip;
  for (std::uint32_t v = 0; v < vertices; ++v) {
    trip.body.at.push_back(on_bend(b, b.middle, v, vertices));
    trip.targets.push_back(on_bend(b, b.to, v, vertices));
    if (v > 0) trip.body.edges.push_back({v - 1, v});
  }
  return trip;
}

void sampling(const Options& options, Kind kind, const std::string& name) {
  Place place(kind, 20, options.seed);
  Rng rng(options.seed + 600);
  const auto bends = random_bends(place, rng, options.count(200, 600));
  const auto touching =
      static_cast<std::size_t>(std::count_if(bends.begin(), bends.end(), [](const Bend& b) { return b.touches; }));
  const struct {
    dsw_level level;
    const char* name;
  } levels[] = {{DSW_LEVEL_POINTS, "dartsweep POINTS"},
                {DSW_LEVEL_EDGES, "dartsweep EDGES"},
                {DSW_LEVEL_EDGES_SWEPT, "dartsweep EDGES_SWEPT"}};
  std::vector<std::vector<Trip>> trips;
  for (const std::uint32_t vertices : kVertices) {
    trips.emplace_back();
    for (const Bend& b : bends) trips.back().push_back(trip_of(b, vertices));
  }
  std::vector<std::unique_ptr<Movers>> catheters;
  std::vector<Method> methods;
  for (const auto& level : levels) {
    for (std::size_t i = 0; i < trips.size(); ++i) {
      const std::uint32_t vertices = kVertices[i];
      catheters.push_back(std::make_unique<Movers>(place, trips[i], Setting{level.level, 0, 0, move_options()}));
      Movers* mine = catheters.back().get();
      methods.push_back(
          {level.name, std::to_string(vertices), "vertices", [mine] { mine->prepare(); }, [mine] { mine->run(); }});
    }
  }
  const auto seconds = time_methods(methods, bends.size(), options.rounds());
  Curve curve{name, "move of a catheter 12 cells long", "share of contacts missed", "", {}, ""};
  for (std::size_t i = 0; i < methods.size(); ++i) {
    std::size_t missed = 0;
    for (std::size_t k = 0; k < bends.size(); ++k) {
      missed += bends[k].touches && catheters[i]->contacts(k).empty() ? 1 : 0;
    }
    curve.points.push_back({methods[i].name, methods[i].setting, methods[i].unit, seconds[i],
                            static_cast<double>(missed) / static_cast<double>(std::max<std::size_t>(1, touching)),
                            touching, text("%zu missed, of %zu moves", missed, bends.size())});
  }
  const std::size_t each = std::size(kVertices);
  const Point &points = curve.points[each - 1], &edges = curve.points[each], &swept = curve.points[2 * each];
  curve.advice = text(
      "Sample as finely as the shape needs, not to find contacts: %s vertices at POINTS still miss %.2g %% in %.0f us, "
      "5 at EDGES "
      "miss %.2g %% in %.0f us, and 5 at EDGES_SWEPT %.2g %% in %.0f us.",
      points.setting.c_str(), 100 * points.error, 1e6 * points.seconds, 100 * edges.error, 1e6 * edges.seconds,
      100 * swept.error, 1e6 * swept.seconds);
  curve.write(options.out);
}

}  // namespace

void sampling_curves(const Options& options) {
  sampling(options, Kind::kVessel, "sampling_vessel");
  sampling(options, Kind::kFaces, "sampling_faces");
}

}  // namespace dsw::curves
