// The distance kept from walls: sheets that are pressed on the wall of a vessel and slide along it.
#include "curves.h"
#include "moves.h"

#include <cmath>

namespace dsw::curves {

namespace {

constexpr std::uint32_t kSide = 6;               // vertices of a sheet along each side
constexpr double kSpacing = 0.35, kStep = 0.08;  // cells
constexpr int kApproach = 40, kPressing = 30;    // steps

struct Sheet {
  oracle::BodyPlan plan;
  Vec step;
};

Sheet random_sheet(Place& place, Rng& rng) {
  for (;;) {
    Sheet sheet;
    const Vec middle = place.point(rng), u = Place::direction(rng, kSpacing), w = Place::direction(rng, kSpacing);
    sheet.step = Place::direction(rng, kStep);
    bool inside = true;
    for (std::uint32_t i = 0; i < kSide * kSide; ++i) {
      const double a = i % kSide - 0.5 * (kSide - 1), b = i / kSide - 0.5 * (kSide - 1);
      const Vec bump = Place::direction(rng, 0.1 * kSpacing);
      Vec p;
      for (std::size_t k = 0; k < 3; ++k) p[k] = middle[k] + a * u[k] + b * w[k] + bump[k];
      inside = inside && place.holds(p, 1);
      sheet.plan.at.push_back(p);
      if (i % kSide > 0 && i >= kSide) {
        const std::uint32_t below = i - kSide;
        sheet.plan.faces.push_back({below - 1, below, i});
        sheet.plan.faces.push_back({below - 1, i, i - 1});
      }
    }
    if (!inside) continue;
    const oracle::BodyState state = oracle::state_of(sheet.plan);
    bool is_free = true;
    for (const auto& e : state.edges) is_free = is_free && !place.exact().blocked(state.at[e[0]], state.at[e[1]]);
    if (is_free) return sheet;
  }
}

/** Sheets under one distance kept, from their approach to the last step. */
class Slides {
 public:
  Slides(Place& place, const std::vector<Sheet>& sheets, double stand_off, std::uint32_t features = 0)
      : sheets_(sheets), scene_(place.scene(features)) {
    setting_.level = DSW_LEVEL_EDGES;
    setting_.options.stand_off = stand_off;
    setting_.options.vertex_response = DSW_RESPONSE_SLIDE;
    setting_.options.edge_response = DSW_RESPONSE_SLIDE;
  }
  void prepare() {
    for (const dsw_body_id body : bodies_) check(dsw_body_destroy(scene_.get(), body));
    bodies_.clear();
    for (const Sheet& sheet : sheets_) bodies_.push_back(create_body(scene_.get(), sheet.plan, setting_));
    go(kApproach);
  }
  void run() { go(kPressing); }
  const dsw_scene* scene() const { return scene_.get(); }
  const std::vector<dsw_body_id>& bodies() const { return bodies_; }
  dsw_scene* scene() { return scene_.get(); }

 private:
  void go(int steps) {
    for (int step = 0; step < steps; ++step) {
      for (std::size_t i = 0; i < bodies_.size(); ++i) {
        std::vector<Vec> at = positions_of(scene_.get(), bodies_[i], kSide * kSide);
        for (Vec& p : at) {
          for (std::size_t k = 0; k < 3; ++k) p[k] += sheets_[i].step[k];
        }
        check(dsw_body_move(scene_.get(), bodies_[i], at[0].data(), at.size(), 0, &setting_.options, nullptr));
      }
    }
  }

  const std::vector<Sheet>& sheets_;
  Setting setting_;
  oracle::ScenePtr scene_;
  std::vector<dsw_body_id> bodies_;
};

/** Exact height of a point above the plane of a wall, on the side of its front, rounded. */
double height(Place& place, const dsw_body_contact& contact, const Vec& p) {
  dsw_vertex_id ids[3];
  std::size_t count = 0;
  check(dsw_environment_copy_vertices(
      place.environment(),
      {DSW_CELL_FACE, contact.contact.wall.volume, contact.contact.wall.generation, contact.contact.wall.local}, ids, 3,
      &count));
  std::array<std::array<mpq_class, 3>, 3> corner;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec& at = place.world().mesh.points[ids[i].index];
    for (std::size_t k = 0; k < 3; ++k) corner[i][k] = mpq_class(at[k]);
  }
  mpq_class sum = 0, square = 0;
  double towards = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    const mpq_class n = (corner[1][i] - corner[0][i]) * (corner[2][j] - corner[0][j]) -
                        (corner[1][j] - corner[0][j]) * (corner[2][i] - corner[0][i]);
    sum += n * (mpq_class(p[k]) - corner[0][k]);
    square += n * n;
    towards += n.get_d() * contact.contact.normal[k];
  }
  return (towards < 0 ? -1 : 1) * sum.get_d() / std::sqrt(square.get_d());
}

struct Gaps {
  Errors gap;
  std::size_t behind = 0, blocked = 0;  // vertices behind the plane they touched, edges that meet a wall
};

/** Judges the vertices that touched a wall's plane last. */
Gaps judge(Place& place, const std::vector<Sheet>& sheets, const Slides& slides) {
  Gaps gaps;
  for (std::size_t i = 0; i < sheets.size(); ++i) {
    const std::vector<Vec> at = positions_of(slides.scene(), slides.bodies()[i], kSide * kSide);
    const dsw_body_contact* contacts = nullptr;
    std::size_t count = 0;
    check(dsw_body_get_contacts(slides.scene(), slides.bodies()[i], &contacts, &count));
    for (std::size_t c = 0; c < count; ++c) {
      const bool last = c + 1 == count || contacts[c + 1].vertex.index != contacts[c].vertex.index;
      if (!last || contacts[c].edge.generation != 0 || contacts[c].contact.kind != DSW_CONTACT_PLANE) continue;
      const double h = height(place, contacts[c], at[contacts[c].vertex.index]);
      gaps.behind += h < 0 ? 1 : 0;
      gaps.gap.values.push_back(std::fabs(h));
    }
    oracle::BodyState state = oracle::state_of(sheets[i].plan);
    for (const auto& e : state.edges) gaps.blocked += place.exact().blocked(at[e[0]], at[e[1]]) ? 1 : 0;
  }
  return gaps;
}

/** Share of the orientation tests that exact arithmetic decided. */
double fallbacks(Place& place, const std::vector<Sheet>& sheets, double stand_off, std::size_t* tests) {
  Slides slides(place, sheets, stand_off, DSW_FEATURE_STATISTICS);
  slides.prepare();
  check(dsw_scene_reset_statistics(slides.scene()));
  slides.run();
  dsw_statistics statistics{};
  statistics.struct_size = sizeof statistics;
  check(dsw_scene_get_statistics(slides.scene(), &statistics));
  *tests = statistics.orientation_tests;
  return static_cast<double>(statistics.exact_fallbacks) / static_cast<double>(std::max<std::uint64_t>(1, *tests));
}

}  // namespace

void slide_curves(const Options& options) {
  constexpr double kDistances[] = {-1, 1e-15, 1e-12, 1e-9, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2};
  Place place(Kind::kVessel, 16, options.seed);
  Rng rng(options.seed + 800);
  std::vector<Sheet> sheets;
  const std::size_t count = std::max<std::size_t>(2, options.count(60, 240) / 20);
  while (sheets.size() < count) sheets.push_back(random_sheet(place, rng));
  std::vector<std::unique_ptr<Slides>> slides;
  std::vector<Method> methods;
  for (const double distance : kDistances) {
    slides.push_back(std::make_unique<Slides>(place, sheets, distance));
    Slides* mine = slides.back().get();
    methods.push_back({distance < 0 ? "dartsweep exact" : "dartsweep stand-off",
                       distance < 0 ? "" : text("%g", distance), distance < 0 ? "" : "cells",
                       [mine] { mine->prepare(); }, [mine] { mine->run(); }});
  }
  const std::size_t moves = count * kPressing * kSide * kSide;
  const auto seconds = time_methods(methods, moves, options.rounds());
  Curve gap{"stand_off_gap", "move of a vertex of a pressed sheet", "gap to the wall", "cells", {}, ""};
  Curve share{"stand_off_fallbacks", gap.item, "share of tests that exact arithmetic decides", "", {}, ""};
  std::size_t inside = 0;
  for (std::size_t i = 0; i < methods.size(); ++i) {
    const Gaps gaps = judge(place, sheets, *slides[i]);
    const Method& m = methods[i];
    gap.points.push_back(
        {m.name, m.setting, m.unit, seconds[i], gaps.gap.mean(), gaps.gap.values.size(),
         gaps.gap.spread() + text("; %zu vertices behind their wall, %zu edges in one", gaps.behind, gaps.blocked)});
    inside += gaps.behind + gaps.blocked;
    std::size_t tests = 0;
    const double exact = fallbacks(place, sheets, kDistances[i], &tests);
    share.points.push_back({m.name, m.setting, m.unit, seconds[i], exact, tests, ""});
  }
  const Point &none = gap.points[0], &standard = gap.points[3];
  gap.advice = text(
      "Keep the default, 1e-9 of a cell: the gap is %.1g cells and a move takes %.2f times as long as without. "
      "At all settings together, also without a distance, %zu vertices and edges lie inside of a wall.",
      standard.error, standard.seconds / none.seconds, inside);
  share.advice = text(
      "Keep the default, 1e-9 of a cell: exact arithmetic decides %.2g %% of the tests, without a distance %.2g %%.",
      100 * share.points[3].error, 100 * share.points[0].error);
  gap.write(options.out);
  share.write(options.out);
}

}  // namespace dsw::curves
