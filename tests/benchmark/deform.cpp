// Every vertex of the lattice moves every step: what it takes until the casts of the step are answered. Ours deforms
// its environment with a particle at every vertex of every body; Embree and Bullet refit their trees or make them anew,
// a grid is filled again.
#include "parts.h"

#include "deform_case.h"
#include "deform_peers.h"
#include "timing.h"

#include <algorithm>
#include <cstdio>
#include <map>

namespace dsw::bench {

namespace {

/** Answers that ours gave before. */
class Recorded final : public Engine {
 public:
  explicit Recorded(const std::vector<Answer>& answers) : Engine("dartsweep"), answers_(answers) {}
  void prepare(const Segments&) override {}
  void run(std::size_t, std::size_t) override {}
  Answer answer(std::size_t i) const override { return answers_[i]; }

 private:
  const std::vector<Answer>& answers_;
};

struct Times {
  std::vector<double> update, queries, both;  // ns

  void add(double update_ns, double queries_ns, double both_ns) {
    update.push_back(update_ns);
    queries.push_back(queries_ns);
    both.push_back(both_ns);
  }
  void add(double update_ns, double queries_ns) { add(update_ns, queries_ns, update_ns + queries_ns); }
  /** Takes over the median step of others. */
  void add(const Times& steps) { add(median(steps.update), median(steps.queries), median(steps.both)); }
};

/** Repeats a step of ours. */
void repeat(DeformCase& scene, const DeformStep& step, MovingEngine& engine, Times& times) {
  scene.place_walls(step.wave);
  engine.write();
  engine.prepare(step.segments);
  const double update = cpu_time_ns([&] { engine.update(); });
  times.add(update, cpu_time_ns([&] { engine.run(0, step.segments.batch); }));
}

/** Lets engines repeat a few steps and keeps the fastest. */
std::unique_ptr<MovingEngine> keep_fastest(DeformCase& scene, const std::vector<DeformStep>& steps,
                                           std::vector<std::unique_ptr<MovingEngine>> engines) {
  std::size_t best = 0;
  double least = 0;
  for (std::size_t i = 0; i < engines.size(); ++i) {
    Times times;
    for (std::size_t k = 0; k < 4; ++k) repeat(scene, steps[k], *engines[i], times);
    const double ns = *std::min_element(times.both.begin(), times.both.end());
    std::printf("    %-44s %.0f us\n", engines[i]->name().c_str(), ns / 1e3);
    if (i == 0 || ns < least) {
      least = ns;
      best = i;
    }
  }
  return std::move(engines[best]);
}

struct Contest {
  std::string size;
  std::unique_ptr<DeformCase> scene;
  std::vector<DeformStep> steps;  // the last that the peers repeat
  std::map<std::string, std::unique_ptr<MovingEngine>> peers;
  std::map<std::string, Times> times;  // by engine: the median step of each round
  // How many vertices moved one at a time in each step of SWEPT, and the time of the update for each of them.
  std::vector<double> alone, ns_each;
};

/** Steps of ours, two more that warm the caches. @return the median. */
Times run_ours(Contest& contest, dsw_deform_method method, std::size_t steps) {
  contest.steps.resize(steps + 2);
  Times times;
  for (std::size_t i = 0; i < steps + 2; ++i) {
    const DeformCase::Times ns = contest.scene->advance(method, contest.steps[i]);
    if (i < 2) continue;
    times.add(ns.update, ns.queries);
    if (ns.alone == 0) continue;
    contest.alone.push_back(ns.alone);
    contest.ns_each.push_back(ns.update / ns.alone);
  }
  return times;
}

Contest make_contest(const std::string& size, std::size_t cells) {
  std::printf("  deform%s\n", size.c_str());
  Contest contest;
  contest.size = size;
  contest.scene = std::make_unique<DeformCase>(cells);
  run_ours(contest, DSW_DEFORM_SWEPT, 4);
  run_ours(contest, DSW_DEFORM_END_STATE, 4);
  contest.alone.clear();
  contest.ns_each.clear();
  const WallMesh& walls = contest.scene->walls();
  contest.peers["embree_refit"] = keep_fastest(*contest.scene, contest.steps, make_moving_embrees(walls));
  contest.peers["bullet_refit"] = keep_fastest(*contest.scene, contest.steps, make_moving_bullets(walls));
  contest.peers["bullet_tree"] = keep_fastest(*contest.scene, contest.steps, make_moving_bullet_trees(walls));
  contest.peers["grid"] = keep_fastest(*contest.scene, contest.steps, make_moving_grids(walls));
  return contest;
}

void run_round(Contest& contest, std::size_t steps) {
  contest.times["swept"].add(run_ours(contest, DSW_DEFORM_SWEPT, steps));
  contest.times["end_state"].add(run_ours(contest, DSW_DEFORM_END_STATE, steps));
  for (const auto& [name, peer] : contest.peers) {
    Times times;
    for (std::size_t i = 0; i < 3; ++i) repeat(*contest.scene, contest.steps[i], *peer, times);
    contest.times[name].add(times);
  }
}

/** Compares the answers of a step; adds which share of them names the same wall, or that there is none. */
void compare(Contest& contest, Agreement& agreement, std::map<std::string, std::vector<double>>& shares) {
  const DeformStep& step = contest.steps.back();
  contest.scene->place_walls(step.wave);
  Recorded ours(step.answers);
  std::vector<Engine*> engines = {&ours};
  for (const auto& [name, peer] : contest.peers) {
    peer->write();
    peer->update();
    peer->prepare(step.segments);
    engines.push_back(peer.get());
  }
  agreement.compare(step.segments, engines, contest.scene->walls(), 200);
  for (const auto& [name, peer] : contest.peers) {
    std::size_t same = 0;
    for (std::size_t i = 0; i < step.answers.size(); ++i) same += peer->answer(i).wall == step.answers[i].wall ? 1 : 0;
    shares[name].push_back(static_cast<double>(same) / static_cast<double>(step.answers.size()));
  }
}

}  // namespace

void run_deform(const Options& options, Report& report, Agreement& agreement) {
  const std::size_t rounds = options.quick ? 5 : 15, steps = options.quick ? 12 : 40;
  std::vector<Contest> contests;
  contests.push_back(make_contest(".n1e3", 1000));
  contests.push_back(make_contest(".n1e4", 10000));
  contests.push_back(make_contest(".n1e5", 100000));
  contests.push_back(make_contest(".n1e6", 1000000));
  std::map<std::string, std::vector<double>> shares;
  for (std::size_t round = 0; round < rounds; ++round) {
    for (Contest& contest : contests) {
      run_round(contest, steps);
      if (round % 3 == 0) compare(contest, agreement, shares);
    }
  }

  for (const Contest& contest : contests) {
    for (const auto& [name, times] : contest.times) {
      const std::string end = (name == "end_state" ? "" : "." + name) + contest.size;
      report.set("deform.ns_step" + end, median(times.both));
      report.set("deform.update_ns" + end, median(times.update));
      report.set("deform.queries_ns" + end, median(times.queries));
    }
    const std::vector<double>& ours = contest.times.at("end_state").both;
    for (const auto& [name, peer] : contest.peers) {
      report.set("deform.vs_" + name + contest.size, median_ratio(contest.times.at(name).both, ours));
    }
    report.set("deform.alone" + contest.size, median(contest.alone));
    report.set("deform.ns_each" + contest.size, median(contest.ns_each));
    report.set("deform.pushed" + contest.size, static_cast<double>(contest.scene->pushed()));
    report.set("deform.shortened" + contest.size, static_cast<double>(contest.scene->shortened()));
  }
  for (const char* name : {"end_state", "swept"}) {
    const std::string end = name == std::string("swept") ? ".swept" : "";
    report.set("deform.flatness" + end,
               median_ratio(contests.back().times.at(name).both, contests.front().times.at(name).both));
  }
  report.set("deform.flatness.swept_each", median(contests.back().ns_each) / median(contests.front().ns_each));
  for (const auto& [name, values] : shares) {
    report.set("deform.agree_share." + name, *std::min_element(values.begin(), values.end()));
  }
}

}  // namespace dsw::bench
