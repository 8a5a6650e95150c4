// Dials of bodies: sampling a catheter, elimination by motion, distance kept while sliding.
#include "curves.h"
#include "moves.h"

#include <cmath>

namespace dsw::curves {

namespace {

// Catheters: two straight halves, of which the middle moves.

constexpr double kLength = 12;  // of a catheter, cells
constexpr std::size_t kVertices[] = {5, 9, 17, 33, 65, 129, 199};

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
Vec on_bend(const Bend& b, const Vec& middle, std::size_t v, std::size_t count) {
  const std::size_t half = (count - 1) / 2;
  return v <= half ? between(b.first, middle, static_cast<double>(v) / static_cast<double>(half))
                   : between(middle, b.last, static_cast<double>(v - half) / static_cast<double>(half));
}

/** The catheters with so many vertices each, in one scene. */
class Catheters {
 public:
  Catheters(Place& place, const std::vector<Bend>& bends, std::size_t vertices, dsw_level level)
      : bends_(bends), vertices_(vertices), level_(level), options_(move_options()), scene_(place.scene()) {
    for (const Bend& b : bends) {
      for (std::size_t v = 0; v < vertices; ++v) {
        const Vec target = on_bend(b, b.to, v, vertices);
        targets_.insert(targets_.end(), target.begin(), target.end());
      }
    }
  }
  void prepare() {
    for (const dsw_body_id body : bodies_) check(dsw_body_destroy(scene_.get(), body));
    bodies_.clear();
    for (const Bend& b : bends_) {
      oracle::BodyPlan plan;
      for (std::uint32_t v = 0; v < vertices_; ++v) {
        plan.at.push_back(on_bend(b, b.middle, v, vertices_));
        if (v > 0) plan.edges.push_back({v - 1, v});
      }
      dsw_body_id body;
      check(create_body(scene_.get(), plan, level_, 0, {}, &body));
      bodies_.push_back(body);
    }
  }
  void run() {
    check(dsw_scene_move_bodies(scene_.get(), bodies_.data(), bodies_.size(), targets_.data(), targets_.size() / 3, 0,
                                &options_, nullptr));
  }
  std::size_t missed() const {
    std::size_t missed = 0;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const dsw_contact* contacts = nullptr;
      std::size_t count = 0;
      check(dsw_body_get_contacts(scene_.get(), bodies_[i], &contacts, &count));
      missed += bends_[i].touches && count == 0 ? 1 : 0;
    }
    return missed;
  }

 private:
  const std::vector<Bend>& bends_;
  std::size_t vertices_;
  dsw_level level_;
  dsw_move_options options_;
  oracle::ScenePtr scene_;
  std::vector<dsw_body_id> bodies_;
  std::vector<double> targets_;
};

void sampling(const Options& options, Kind kind, const std::string& name) {
  Place place(kind, 20, options.seed);
  Rng rng(options.seed + 600);
  const auto bends = random_bends(place, rng, options.count(200, 2000));
  const auto touching =
      static_cast<std::size_t>(std::count_if(bends.begin(), bends.end(), [](const Bend& b) { return b.touches; }));
  const struct {
    dsw_level level;
    const char* name;
  } levels[] = {{DSW_LEVEL_POINTS, "dartsweep POINTS"},
                {DSW_LEVEL_EDGES, "dartsweep EDGES"},
                {DSW_LEVEL_EDGES_SWEPT, "dartsweep EDGES_SWEPT"}};
  std::vector<std::unique_ptr<Catheters>> catheters;
  std::vector<Method> methods;
  for (const auto& level : levels) {
    for (const std::size_t vertices : kVertices) {
      catheters.push_back(std::make_unique<Catheters>(place, bends, vertices, level.level));
      Catheters* mine = catheters.back().get();
      methods.push_back(
          {level.name, std::to_string(vertices), "vertices", [mine] { mine->prepare(); }, [mine] { mine->run(); }});
    }
  }
  const auto seconds = time_methods(methods, bends.size(), options.rounds());
  Curve curve{name, "move of a catheter 12 cells long", "share of contacts missed", "", {}, ""};
  for (std::size_t i = 0; i < methods.size(); ++i) {
    const std::size_t missed = catheters[i]->missed();
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

void body_curves(const Options& options) {
  sampling(options, Kind::kVessel, "sampling_vessel");
  sampling(options, Kind::kFaces, "sampling_faces");
}

}  // namespace dsw::curves
