// What settles an edge of the plane without a look at its triangle, against the plain flood and casts.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

#include "base/error.h"
#include "corridor/corridor.h"
#include "corridor/hop.h"
#include "environment/builder.h"
#include "environment/marking.h"
#include "locate/locate.h"
#include "plane_scenes.h"
#include "sweep/simplex_sweep.h"
#include "swept_cases.h"
#include "walk/cast.h"

namespace dsw::swept {
namespace {

using oracle::plane::Vec;
using oracle::plane::World;

/// Null where creation may refuse the world, and does.
std::unique_ptr<Environment<2>> environment_of(const World& world, bool may_be_refused) {
  std::vector<double> points;
  for (const Vec& p : world.points) points.insert(points.end(), p.begin(), p.end());
  std::vector<int64_t> offsets = {0}, connectivity;
  std::vector<uint8_t> types;
  for (const std::vector<int>& cell : world.cells) {
    types.push_back(cell.size() == 3   ? DSW_CELL_TYPE_TRIANGLE
                    : cell.size() == 4 ? DSW_CELL_TYPE_QUAD
                                       : DSW_CELL_TYPE_POLYGON);
    connectivity.insert(connectivity.end(), cell.begin(), cell.end());
    offsets.push_back(static_cast<int64_t>(connectivity.size()));
  }
  dsw_environment_desc input{};
  input.points = points.data();
  input.point_count = world.points.size();
  input.cell_types = types.data();
  input.volume_count = types.size();
  input.offsets = offsets.data();
  input.connectivity = connectivity.data();
  input.connectivity_count = connectivity.size();
  auto env = std::make_unique<Environment<2>>(nullptr);
  BuildReport report;
  try {
    build(*env, check_description<2>(input), report);
  } catch (const Error&) {
    EXPECT_TRUE(may_be_refused);
    return nullptr;
  }
  return env;
}

/// An edge p q, and where p goes: anywhere near, or to the other side of a vertex.
struct Draw {
  Vec p, to, q;

  Draw(const Environment<2>& env, Rng& rng) {
    static const double steps[] = {0.003, 0.02, 0.1, 0.3};
    const double step = steps[rng.below(4u)];
    Vec size;
    for (size_t k = 0; k < 2; ++k) size[k] = env.upper[k] - env.lower[k];
    const auto anywhere = [&](Vec& x) {
      for (size_t k = 0; k < 2; ++k) x[k] = rng.range(env.lower[k], env.upper[k]);
    };
    anywhere(p), anywhere(q);
    if (rng.chance(0.6)) {  // the vertex lies between p or p' and q
      const double* const v = env.point(rng.below(env.map.vertex_count));
      const double beyond = rng.range(0.1, 1);
      for (size_t k = 0; k < 2; ++k) p[k] = v[k] + beyond * (v[k] - q[k]) + rng.range(-step, step) * size[k] / 2;
    }
    for (size_t k = 0; k < 2; ++k) to[k] = p[k] + rng.range(-step, step) * size[k];
    if (rng.chance(0.2)) lay_on_lattice(rng, size);
  }

  bool is_finite() const {
    return std::isfinite(p[0] + p[1]) && std::isfinite(to[0] + to[1]) && std::isfinite(q[0] + q[1]);
  }

 private:
  /// Coarse, so that much is exactly on something.
  void lay_on_lattice(Rng& rng, const Vec& size) {
    const int fine = rng.between(3, 6);
    for (size_t k = 0; k < 2; ++k) {
      const double unit = std::ldexp(1, std::ilogb(size[k]) - fine);
      for (Vec* x : {&p, &to, &q}) (*x)[k] = unit * std::round((*x)[k] / unit);
    }
  }
};

/// Flies from *cell to the cell of `to`, and notes the sides on the way. Whether it gets there.
bool pass(const Environment<2>& env, const double* from, const double* to, Cell* cell, Corridor<2>& sequence) {
  CorridorWriter<2> writer(nullptr);
  CastRequest request;
  request.from = from;
  request.to = to;
  request.start = *cell;
  CastResult result;
  do {  // again where there was no room for all
    writer.attach(env, request);
    result = cast(env, request, nullptr);
    if (result.end == CastEnd::kReached) writer.finish(sequence);
  } while (!sequence.known());
  *cell = result.cell;
  return result.end == CastEnd::kReached;
}

/// A body of one edge, where it is free, and what its end sweeps.
class Edge {
 public:
  Edge(const Environment<2>& env, const Draw& x, SweepLevel level) : env_(env), x_(x), body_(nullptr) {
    body_.level = level;
    body_.skipping.corridors = body_.skipping.by_environment = true;
    start_ = locate(env, x.p.data(), Cell{}, nullptr).cell;
    fixed_ = locate(env, x.q.data(), Cell{}, nullptr).cell;
    if (!start_.valid() || !fixed_.valid() || env.map.marked(start_) || env.map.marked(fixed_)) return;
    reserve(body_, 2, 1, 0);
    add_vertex(body_, x.p.data(), start_);
    add_vertex(body_, x.q.data(), fixed_);
    add_edge(body_, 0, 1);
    keep_corridors(body_, 1);
    Cell end = start_;
    free_ = pass(env, x.p.data(), x.q.data(), &end, body_.corridors.own(0, env.obstacle_version));
    path_ = cast(env, x.p.data(), x.to.data(), start_);
    arrival_ = cast(env, x.to.data(), x.q.data(), path_.cell);
  }
  /// The edge is free at first, and so is the path of its end.
  bool is_legal() const { return free_ && path_.end == CastEnd::kReached; }
  bool is_free(SweepFlood<2>& flood) const {
    return arrival_.end == CastEnd::kReached &&
           (body_.level == SweepLevel::kEdges ||
            flood.sweep(EdgeMotion{x_.p.data(), x_.to.data(), x_.q.data()}, start_, 0).end == SweepEnd::kFree);
  }
  size_t facets() const { return body_.corridors[0].facets.size(); }
  Verdict ask(SimplexSweep<2>& star) {
    const PathFacets crossed = path_facets(env_.map, start_, path_);
    const PointWay way{x_.p.data(), x_.to.data(), start_, path_.cell, crossed};
    return star.ask(body_, {{Simplex::kEdge, 0}, 0, way, x_.q.data(), nullptr, fixed_, {}, true});
  }
  /// Whether its sequence is that of its new place.
  bool is_up_to_date() {
    Corridor<2> anew{Array<uint32_t>::allocator_type(nullptr)};
    Cell at = path_.cell;
    pass(env_, x_.to.data(), x_.q.data(), &at, anew);
    return anew.facets == body_.corridors[0].facets;
  }

 private:
  const Environment<2>& env_;
  const Draw& x_;
  Body<2> body_;
  Cell start_, fixed_;
  bool free_ = false;
  CastResult path_, arrival_;
};

/// Calls visit(environment, move) for random moves in worlds of all kinds.
template <class Visit>
void for_each_draw(int rounds, int draws, Visit visit) {
  static const Shares shares[] = {{0.1, 0.05, 0, 0}, {0, 0.1, 0, 0}, {0, 0, 0, 0.3}, {}, {0.05, 0.05, 0, 0.1}};
  uint64_t seed = 0;
  for (int round = 0; round < rounds; ++round) {
    for (const oracle::plane::Turn& turn : oracle::plane::turns("")) {
      Rng rng(++seed);
      const auto env = environment_of(oracle::plane::make_world(turn, rng), turn.may_be_refused());
      if (env == nullptr) continue;
      mark(*env, rng, shares[seed % 5]);
      for (int i = 0; i < draws; ++i) {
        const Draw x(*env, rng);
        SCOPED_TRACE(turn.name() + ", seed " + std::to_string(seed) + ", move " + std::to_string(i));
        if (x.is_finite()) visit(*env, x);
        if (testing::Test::HasFatalFailure()) return;
      }
    }
  }
}

TEST(SweptPlane, WhatIsSettledMeetsNothing) {
  for (const SweepLevel level : {SweepLevel::kEdges, SweepLevel::kEdgesSwept}) {
    int of[8] = {}, open = 0, hit = 0, long_ones = 0;
    std::unique_ptr<SimplexSweep<2>> star;
    std::unique_ptr<SweepFlood<2>> flood;
    const Environment<2>* last = nullptr;
    for_each_draw(5, effort_of(400), [&](const Environment<2>& env, const Draw& x) {
      if (last != &env || star == nullptr) {
        star = std::make_unique<SimplexSweep<2>>(env);
        flood = std::make_unique<SweepFlood<2>>(env);
        last = &env;
      }
      Edge edge(env, x, level);
      if (!edge.is_legal()) return;
      const size_t facets = edge.facets();
      const bool free = edge.is_free(*flood);
      const Verdict how = edge.ask(*star);
      ++of[static_cast<int>(how)];
      if (how == Verdict::kUnknown) {
        ++(free ? open : hit);
        return;
      }
      long_ones += facets > 3 ? 1 : 0;
      ASSERT_TRUE(free) << "settled by " << static_cast<int>(how);
      ASSERT_TRUE(how == Verdict::kSeen || edge.is_up_to_date()) << "settled by " << static_cast<int>(how);
    });
    const auto count = [&](Verdict how) { return of[static_cast<int>(how)]; };
    RecordProperty("settled", std::to_string(count(Verdict::kInside)) + " inside, " +
                                  std::to_string(count(Verdict::kSeen)) + " seen, " +
                                  std::to_string(count(Verdict::kHolds)) + " corridor, " +
                                  std::to_string(count(Verdict::kTurned)) + " turned; " + std::to_string(open) +
                                  " free and open, " + std::to_string(hit) + " hit");
    EXPECT_GT(count(Verdict::kInside), effort_of(500));
    EXPECT_GT(count(Verdict::kSeen), effort_of(50));
    EXPECT_GT(count(Verdict::kHolds), effort_of(5000));
    EXPECT_GT(count(Verdict::kTurned), effort_of(1000));
    EXPECT_GT(long_ones, effort_of(1000));
    EXPECT_GT(hit, effort_of(500));
  }
}

TEST(SweptPlane, ALineBetweenNeighboursPassesOneSide) {
  int passed = 0, of_neighbours = 0;
  for_each_draw(5, effort_of(300), [&](const Environment<2>& env, const Draw& x) {
    const Cell first = locate(env, x.p.data(), Cell{}, nullptr).cell,
               second = locate(env, x.q.data(), Cell{}, nullptr).cell;
    if (!first.valid() || !second.valid() || first == second || env.map.marked(first)) return;
    const CastResult path = cast(env, x.p.data(), x.q.data(), first);
    const bool one = path.end == CastEnd::kReached && path_facets(env.map, first, path).count == 1;
    of_neighbours += one ? 1 : 0;
    if (!passes_between(env, first, second, x.p.data(), x.q.data())) return;
    ++passed;
    ASSERT_TRUE(one && path.cell == second);
  });
  EXPECT_GT(passed, effort_of(1000));
  EXPECT_GT(of_neighbours, passed) << "not all cells are convex";
}

}  // namespace
}  // namespace dsw::swept
