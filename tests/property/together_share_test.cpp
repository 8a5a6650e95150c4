// Wires that are pressed against walls, themselves and each other, without friction: how much of the motion they make that
// their contacts allow. A linear program with one row for each near pair of features tells how far all could go. Its rows
// are made again where it leads, until it gains nothing more. Thick wires keep their distances: a row counts what is left of these.
#include "linear_program.h"
#include "together_support.h"

#include <cmath>

namespace dsw::oracle {
namespace {

double dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vec minus(const Vec& a, const Vec& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vec cross(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double clamped(double x) { return std::min(1.0, std::max(0.0, x)); }

/// Points with weights that add up to the vector from the second side of a pair to the first, where these are nearest.
struct Nearest {
  double weights[4];
  Vec normal;  // of a pair that touches
};

Nearest nearest_edges(const Vec& p, const Vec& q, const Vec& a, const Vec& b) {
  const Vec d = minus(q, p), e = minus(b, a), w = minus(p, a);
  const double dd = dot(d, d), de = dot(d, e), ee = dot(e, e), dw = dot(d, w), ew = dot(e, w);
  const double whole = dd * ee - de * de;
  double s = whole > 1e-12 * dd * ee ? clamped((de * ew - ee * dw) / whole) : 0;
  const double t = clamped((ew + s * de) / ee);
  s = clamped((t * de - dw) / dd);
  return {{1 - s, s, t - 1, -t}, cross(d, e)};
}

Nearest nearest_face(const Vec& p, const Vec& a, const Vec& b, const Vec& c) {
  const Vec e = minus(b, a), f = minus(c, a), w = minus(p, a);
  const double ee = dot(e, e), ef = dot(e, f), ff = dot(f, f), we = dot(w, e), wf = dot(w, f),
               whole = ee * ff - ef * ef;
  double u = (we * ff - wf * ef) / whole, v = (wf * ee - we * ef) / whole;
  if (u < 0 || v < 0 || u + v > 1) {  // then a side is nearest, which has rows of its own
    u = std::max(0.0, u), v = std::max(0.0, v);
    const double sum = std::max(1.0, u + v);
    u /= sum, v /= sum;
  }
  return {{1, u + v - 1, -u, -v}, cross(e, f)};
}

class Wires {
 public:
  Wires(const Ground& ground, const std::vector<Walker>& walkers, double radius) : ground_(ground), radius_(radius) {
    for (const Walker& of : walkers) {
      const auto first = static_cast<uint32_t>(at_.size());
      at_.insert(at_.end(), of.state.at.begin(), of.state.at.end());
      ends_.insert(ends_.end(), of.end.begin(), of.end.end());
      for (const auto& edge : of.state.edges) edges_.push_back({first + edge[0], first + edge[1]});
    }
  }
  /// By how much the largest motion that the rows allow shortens the way to the targets, along the axes. No coordinate goes
  /// away from its target.
  double largest_motion() {
    double made = 0;
    for (int round = 0; round < 40; ++round) {
      const double gained = step();
      made += gained;
      if (gained < 1e-6) break;
    }
    return made;
  }

 private:
  // A little of each gap is left, so that the next rows know on which side of a wall a part is.
  static constexpr double kShare = 1 - 1e-4, kTouch = 1e-9;

  double step() {
    const size_t n = 3 * at_.size();
    std::vector<double> signs(n), lefts(n);
    reach_ = 0;
    for (size_t v = 0; v < at_.size(); ++v) {
      for (size_t k = 0; k < 3; ++k) {
        const double left = ends_[v][k] - at_[v][k];
        signs[3 * v + k] = left < 0 ? -1 : 1;
        lefts[3 * v + k] = std::fabs(left);
        reach_ = std::max(reach_, 2 * std::fabs(left));
      }
    }
    LinearProgram program(std::vector<double>(n, 1.0));
    for (size_t i = 0; i < n; ++i) {
      std::vector<double> row(n, 0.0);
      row[i] = 1;
      program.add_row(row, lefts[i]);
    }
    const auto add = [&](const Nearest& nearest, const Vec* points, const uint32_t* names, uint32_t moving,
                         double keep) {
      Vec gap = {0, 0, 0};
      for (size_t i = 0; i < 4; ++i) {
        for (size_t k = 0; k < 3; ++k) gap[k] += nearest.weights[i] * points[i][k];
      }
      const double distance = std::sqrt(dot(gap, gap)), left = distance - keep;
      if (left > 2 * reach_) return;
      Vec normal = gap;
      if (distance < 1e-7) {
        normal = nearest.normal;
        if (dot(normal, gap) < 0) normal = minus({0, 0, 0}, normal);
      }
      const double length = std::sqrt(dot(normal, normal));
      if (!(length > 0)) return;
      std::vector<double> row(n, 0.0);
      for (size_t i = 0; i < 4; ++i) {
        if ((moving >> i & 1u) == 0) continue;
        for (size_t k = 0; k < 3; ++k)
          row[3 * names[i] + k] -= nearest.weights[i] * normal[k] / length * signs[3 * names[i] + k];
      }
      program.add_row(row, left < kTouch ? 0 : kShare * left);
    };

    for (uint32_t v = 0; v < at_.size(); ++v) {
      for (const auto& wall : ground_.walls) {
        const Vec points[4] = {at_[v], ground_.points[wall[0]], ground_.points[wall[1]], ground_.points[wall[2]]};
        const uint32_t names[4] = {v, 0, 0, 0};
        add(nearest_face(points[0], points[1], points[2], points[3]), points, names, 1, radius_);
      }
    }
    const auto ridges = ground_.features(2);
    for (size_t e = 0; e < edges_.size(); ++e) {
      for (const auto& ridge : ridges) {
        const Vec points[4] = {at_[edges_[e][0]], at_[edges_[e][1]], ground_.points[ridge[0]],
                               ground_.points[ridge[1]]};
        const uint32_t names[4] = {edges_[e][0], edges_[e][1], 0, 0};
        add(nearest_edges(points[0], points[1], points[2], points[3]), points, names, 3, radius_);
      }
      for (size_t f = 0; f < e; ++f) {
        const uint32_t names[4] = {edges_[e][0], edges_[e][1], edges_[f][0], edges_[f][1]};
        if (std::set<uint32_t>(names, names + 4).size() < 4) continue;
        const Vec points[4] = {at_[names[0]], at_[names[1]], at_[names[2]], at_[names[3]]};
        add(nearest_edges(points[0], points[1], points[2], points[3]), points, names, 15, 2 * radius_);
      }
    }
    const std::vector<double> made = program.solve();
    double sum = 0;
    for (size_t i = 0; i < n; ++i) {
      at_[i / 3][i % 3] += signs[i] * made[i];
      sum += made[i];
    }
    return sum;
  }

  const Ground& ground_;
  const double radius_;
  std::vector<Vec> at_, ends_;
  std::vector<std::array<uint32_t, 2>> edges_;
  double reach_ = 0;
};

struct Pressed {
  double made = 0, largest = 0, least = 1;
  size_t steps = 0;
};

std::vector<Walker> make_wires(dsw_scene* scene, double radius, Rng& rng) {
  std::vector<Walker> walkers;
  for (int tries = 0; tries < 40 && walkers.size() < 2; ++tries) {
    BodyPlan plan;
    plan.at.push_back({rng.range(0.3, 1), rng.range(0.3, 2.7), rng.range(0.2, 0.8)});
    for (uint32_t i = 1; i < 8; ++i) {
      plan.at.push_back(plan.at.back());
      plan.at.back()[0] += 0.2;
      plan.at.back()[1] += rng.range(-0.1, 0.1);
      plan.at.back()[2] += rng.range(-0.1, 0.1);
      plan.edges.push_back({i - 1, i});
    }
    Walker walker{};
    walker.level = DSW_LEVEL_EDGES_SWEPT;
    if (create_body(scene, plan, walker.level, DSW_BODY_SELF_CONTACTS, {}, &walker.id, radius) != DSW_STATUS_OK)
      continue;
    EXPECT_EQ(read_body(scene, walker.id, walker.state), "");
    walkers.push_back(walker);
  }
  return walkers;
}

/// Presses wires for some steps. All want to go on where they are.
void press(const Ground& ground, double radius, Rng& rng, Pressed& all) {
  ScenePtr scene = make_scene(ground.environment.get(), DSW_FEATURE_BODY_CONTACTS);
  std::vector<Walker> walkers = make_wires(scene.get(), radius, rng);
  const Vec way = {rng.range(-0.05, 0.05), rng.range(-0.1, 0.1), rng.range(-0.15, -0.05)};
  for (int step = 0; step < 12; ++step) {
    for (Walker& each : walkers) {
      each.end = each.state.at;
      for (Vec& p : each.end) {
        for (size_t k = 0; k < 3; ++k) p[k] += way[k] + rng.range(-0.01, 0.01);
      }
    }
    const double could = Wires(ground, walkers, radius).largest_motion();
    const TogetherAnswer answer =
        move_together(scene.get(), walkers, DSW_TOGETHER_STOP_FEATURE, 0, DSW_TOGETHER_RESPONSE_SLIDE);
    double went = 0, whole = 0;
    for (size_t i = 0; i < walkers.size(); ++i) {
      for (size_t v = 0; v < walkers[i].end.size(); ++v) {
        for (size_t k = 0; k < 3; ++k) {
          whole += std::fabs(walkers[i].end[v][k] - walkers[i].state.at[v][k]);
          went += std::fabs(walkers[i].end[v][k] - walkers[i].state.at[v][k]) -
                  std::fabs(walkers[i].end[v][k] - answer.after[i].at[v][k]);
        }
      }
      walkers[i].state = answer.after[i];
    }
    EXPECT_LE(could, whole + 1e-6);
    if (step < 4 || could < 1e-3) continue;  // not yet pressed, or in a corner
    ++all.steps;
    all.made += went;
    all.largest += could;
    all.least = std::min(all.least, went / could);
  }
}

class TogetherShare : public testing::TestWithParam<double> {};

TEST_P(TogetherShare, PressedWiresMakeTheMotionThatTheirContactsAllow) {
  Rng rng(51);
  Pressed all;
  for (int round = 0; round < effort_of(10); ++round) {
    press(make_ground(3, 3, 0, 0.05, false, rng), GetParam(), rng, all);
  }
  std::printf("radius %g: %zu steps of pressed wires; share of the largest motion %.4f, least of a step %.4f\n",
              GetParam(), all.steps, all.made / all.largest, all.least);
  testing::Test::RecordProperty("steps", static_cast<int>(all.steps));
  testing::Test::RecordProperty("motion_made_share", std::to_string(all.made / all.largest));
  EXPECT_GT(all.steps, 0u);
  EXPECT_GE(all.made, 0.9 * all.largest);
}

INSTANTIATE_TEST_SUITE_P(Radii, TogetherShare, testing::Values(0.0, 0.01, 0.04), [](const auto& each) {
  return each.param == 0 ? std::string("thin") : "radius_" + std::to_string(std::lround(1000 * each.param));
});

}  // namespace
}  // namespace dsw::oracle
