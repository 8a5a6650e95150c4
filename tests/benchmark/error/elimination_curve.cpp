// Edges that are not looked at [JCD10] 6: ropes that drift and wobble among free-standing faces.
#include "curves.h"
#include "moves.h"

namespace dsw::curves {

namespace {

constexpr std::uint32_t kVertices = 17;
constexpr double kEdge = 0.5, kDrift = 0.05, kWobble = 0.05;  // cells; the last two a step
// So that what edges and vertices remember is there when the clock starts; half way they turn round.
constexpr int kBefore = 6, kSteps = 12;

struct Rope {
  oracle::BodyPlan plan;
  std::vector<std::vector<Vec>> steps;  // what each vertex is to move by
};

Rope random_rope(Place& place, Rng& rng, bool at_wall) {
  for (;;) {
    Rope rope;
    const Vec along = Place::direction(rng, kEdge), drift = Place::direction(rng, kDrift);
    const Vec start = at_wall ? place.point_at_wall(rng, kBefore * kDrift) : place.point(rng);
    bool inside = true;
    for (std::uint32_t v = 0; v < kVertices; ++v) {
      const Vec aside = Place::direction(rng, 0.2 * kEdge);
      Vec at;
      for (std::size_t k = 0; k < 3; ++k) at[k] = start[k] + v * along[k] + aside[k];
      inside = inside && place.holds(at, 2);
      rope.plan.at.push_back(at);
      if (v > 0) rope.plan.edges.push_back({v - 1, v});
    }
    if (!inside || !place.is_free(rope.plan.at)) continue;
    for (int step = 0; step < kBefore + kSteps; ++step) {
      const double sense = step < kBefore + kSteps / 2 ? 1 : -1;
      rope.steps.emplace_back();
      for (std::uint32_t v = 0; v < kVertices; ++v) {
        Vec by = Place::direction(rng, kWobble * rng.unit());
        for (std::size_t k = 0; k < 3; ++k) by[k] += sense * drift[k];
        rope.steps.back().push_back(by);
      }
    }
    return rope;
  }
}

struct Judged {
  std::size_t contacts = 0, missed = 0, not_free = 0;
};

/** All ropes in one scene. */
class Ropes {
 public:
  Ropes(Place& place, const std::vector<Rope>& ropes, const Setting& setting)
      : place_(place), ropes_(ropes), setting_(setting), scene_(place.scene()) {}

  void prepare() {
    for (const dsw_body_id body : bodies_) check(dsw_body_destroy(scene_.get(), body));
    bodies_.clear();
    for (const Rope& rope : ropes_) bodies_.push_back(create_body(scene_.get(), rope.plan, setting_));
    for (int step = 0; step < kBefore; ++step) {
      for (std::size_t i = 0; i < bodies_.size(); ++i) move(i, step);
    }
  }
  void run() {
    for (int step = kBefore; step < kBefore + kSteps; ++step) {
      for (std::size_t i = 0; i < bodies_.size(); ++i) move(i, step);
    }
  }
  /** All once more, and each step of the run against the truth. */
  Judged judge() {
    prepare();
    Judged judged;
    for (int step = kBefore; step < kBefore + kSteps; ++step) {
      for (std::size_t i = 0; i < bodies_.size(); ++i) {
        const std::vector<Vec> before = positions_of(scene_.get(), bodies_[i], kVertices);
        const std::vector<Vec> targets = move(i, step);
        judge_step(i, before, targets, judged);
      }
    }
    return judged;
  }

 private:
  std::vector<Vec> move(std::size_t i, int step) {
    std::vector<Vec> at = positions_of(scene_.get(), bodies_[i], kVertices);
    const auto& by = ropes_[i].steps[static_cast<std::size_t>(step)];
    for (std::size_t v = 0; v < at.size(); ++v) {
      for (std::size_t k = 0; k < 3; ++k) at[v][k] += by[v][k];
    }
    check(dsw_body_move(scene_.get(), bodies_[i], at[0].data(), at.size(), 0, &setting_.options, nullptr));
    return at;
  }

  /** Vertex after vertex, each from where the others are by then: whether something is met, and is a contact. */
  void judge_step(std::size_t i, std::vector<Vec> now, const std::vector<Vec>& targets, Judged& judged) {
    const dsw_body_contact* contacts = nullptr;
    std::size_t count = 0;
    check(dsw_body_get_contacts(scene_.get(), bodies_[i], &contacts, &count));
    std::vector<char> told(kVertices, 0);
    for (std::size_t c = 0; c < count; ++c) told[contacts[c].vertex.index] = 1;
    const std::vector<Vec> reached = positions_of(scene_.get(), bodies_[i], kVertices);
    for (std::uint32_t v = 0; v < kVertices; ++v) {
      oracle::VertexMove flight = {now[v], targets[v], {}, {}};
      if (v > 0) flight.fixed.push_back(now[v - 1]);
      if (v + 1 < kVertices) flight.fixed.push_back(now[v + 1]);
      const bool there = !place_.exact().move(flight, DSW_LEVEL_EDGES).events.empty();
      judged.contacts += there ? 1 : 0;
      judged.missed += there && told[v] == 0 ? 1 : 0;
      now[v] = reached[v];
    }
    judged.not_free += place_.is_free(reached) ? 0 : 1;
  }

  Place& place_;
  const std::vector<Rope>& ropes_;
  Setting setting_;
  oracle::ScenePtr scene_;
  std::vector<dsw_body_id> bodies_;
};

std::string advise(const Curve& curve) {
  const Point &exact = curve.points[0], *fastest = &exact, *similar = nullptr;
  for (const Point& p : curve.points) {
    if (!(p.error > 0) && p.setting.empty() && p.seconds < fastest->seconds) fastest = &p;
    if (p.method == "dartsweep by similar motion and environment" && p.setting == "0.1") similar = &p;
  }
  return text(
      "Take what loses nothing: of it %s is the fastest here, in %.2f of the time without. Elimination by similar "
      "motion (with that by environment, share 0.1) takes %.2f of that time and misses %.2g %% of the contacts; where "
      "edges end is free all the same.",
      fastest == &exact ? "none" : fastest->method.c_str() + 10, fastest->seconds / exact.seconds,
      similar->seconds / exact.seconds, 100 * similar->error);
}

}  // namespace

void elimination_curve(const Options& options) {
  Place place(Kind::kFaces, 20, options.seed);
  Rng rng(options.seed + 700);
  std::vector<Rope> list;
  const std::size_t count = options.count(40, 120);
  while (list.size() < count) list.push_back(random_rope(place, rng, list.size() % 2 == 1));
  std::vector<std::unique_ptr<Ropes>> ropes;
  std::vector<Method> methods;
  const auto add = [&](const char* name, std::uint32_t flags, double share) {
    ropes.push_back(std::make_unique<Ropes>(place, list, Setting{DSW_LEVEL_EDGES, flags, share, move_options()}));
    Ropes* mine = ropes.back().get();
    methods.push_back({name, share > 0 ? text("%g", share) : "", share > 0 ? "of the edge's length" : "",
                       [mine] { mine->prepare(); }, [mine] { mine->run(); }});
  };
  add("dartsweep exact", 0, 0);
  add("dartsweep by environment", DSW_BODY_SKIP_BY_ENVIRONMENT, 0);
  add("dartsweep by clearance", DSW_BODY_SKIP_BY_CLEARANCE, 0);
  add("dartsweep by sequences", DSW_BODY_SEQUENCES, 0);
  for (const double share : {0.01, 0.03, 0.05, 0.1, 0.2, 0.5, 1.0}) {
    add("dartsweep by similar motion", DSW_BODY_SKIP_SIMILAR_MOTION, share);
  }
  for (const double share : {0.01, 0.03, 0.05, 0.1, 0.2, 0.5, 1.0}) {
    add("dartsweep by similar motion and environment", DSW_BODY_SKIP_SIMILAR_MOTION | DSW_BODY_SKIP_BY_ENVIRONMENT,
        share);
  }
  const auto seconds = time_methods(methods, count * kSteps, options.rounds());
  Curve curve{"elimination", "move of a rope of 16 edges", "share of contacts missed", "", {}, ""};
  for (std::size_t i = 0; i < methods.size(); ++i) {
    const Judged judged = ropes[i]->judge();
    const Method& m = methods[i];
    curve.points.push_back(
        {m.name, m.setting, m.unit, seconds[i],
         static_cast<double>(judged.missed) / static_cast<double>(std::max<std::size_t>(1, judged.contacts)),
         judged.contacts, text("%zu missed, %zu ropes not free after a step", judged.missed, judged.not_free)});
  }
  curve.advice = advise(curve);
  curve.write(options.out);
}

}  // namespace dsw::curves
