#include <gtest/gtest.h>

#include <sstream>

#include "progress.h"
#include "record.h"

namespace insertion {
namespace {

Options quick() {
  Options options;
  options.spacing = 2;
  options.steps = 300;
  options.vertices = 12;
  return options;
}

TEST(Run, IsExactlyFreeAfterEveryStepAndTravels) {
  const Options options = quick();
  const Vessel vessel(options);
  insertion::Run run(options, &vessel);
  std::size_t contacts = 0;
  for (std::size_t i = 0; i < options.steps; ++i) {
    const Step step = run.step();
    ASSERT_TRUE(step.free) << "step " << i;
    EXPECT_GT(step.volumes_visited, 0u);
    contacts += step.contacts;
  }
  EXPECT_TRUE(run.good());
  EXPECT_EQ(run.table().total(), contacts);
  EXPECT_GT(contacts, 0u);
  EXPECT_GT(run.totals().whole_edges, 0u) << "all links came in";
  EXPECT_EQ(run.totals().whole_detection.size(), run.totals().whole_steps);
  EXPECT_GT(run.totals().reached, 0.5 * vessel.route().length());
  EXPECT_LT(static_cast<double>(run.totals().most_cells) / vessel.info().volume_count, 0.1);
}

// Everything is scaled with the lumen: the same vessel a thousand times smaller gives the same motion.
TEST(Run, TheCatheterFitsTheLumen) {
  const Options options = quick();
  const physics::CatheterOptions usual = fit_catheter(options, 2, 100), small = fit_catheter(options, 2e-3, 0.1);
  EXPECT_DOUBLE_EQ(small.link, 1e-3 * usual.link);
  EXPECT_DOUBLE_EQ(small.speed, 1e-3 * usual.speed);
  EXPECT_DOUBLE_EQ(small.mass * small.link, usual.mass * usual.link);
  // Accelerations: force over mass.
  EXPECT_NEAR(small.steering, 1e-3 * usual.steering, 1e-12 * usual.steering);
  EXPECT_NEAR(small.stretching, 1e-3 * usual.stretching, 1e-12 * usual.stretching);
  EXPECT_NEAR(small.bending / (small.link * small.link), 1e-3 * usual.bending / (usual.link * usual.link),
              1e-9 * usual.bending);
}

TEST(Vessel, RoutesLeadToDifferentEnds) {
  Options options = quick();
  const Vessel farthest(options);
  ASSERT_GE(farthest.flow().end_count, 2u);
  options.route = 1;
  const Vessel next(options);
  EXPECT_LT(next.route().length(), farthest.route().length());
  EXPECT_GT((next.route().at(1e9) - farthest.route().at(1e9)).norm(), 2 * farthest.radius());
  options.route = farthest.flow().end_count;
  EXPECT_THROW(Vessel{options}, BadInput);
}

TEST(Vessel, ItsWallIsClosedAndLooksOutwards) {
  const Vessel vessel(quick());
  const Wall wall = wall_of(vessel);
  double volume = 0;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (std::size_t i = 0; i < wall.triangles.size(); i += 3) {
    const auto corner = [&](std::size_t k) {
      return Eigen::Map<const physics::Vector3>(&wall.positions[3 * std::size_t{wall.triangles[i + k]}]);
    };
    volume += corner(0).dot(corner(1).cross(corner(2))) / 6;
    for (std::size_t k = 0; k < 3; ++k) {
      ++edges[{wall.triangles[i + k], wall.triangles[i + (k + 1) % 3]}];
    }
  }
  EXPECT_GT(volume, 0);
  for (const auto& [edge, count] : edges) {
    const auto back = edges.find({edge.second, edge.first});
    ASSERT_TRUE(back != edges.end() && back->second == count);
  }
}

TEST(Progress, WithoutATerminalItIsALineEveryTenth) {
  std::ostringstream out;
  Progress progress(&out, false, 40, 1e-3);
  for (std::size_t i = 1; i <= 40; ++i) {
    progress.show(i, 0.5, 3);
  }
  const std::string text = out.str();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 10);
  EXPECT_NE(text.find(" 10 %  step 4 of 40"), std::string::npos) << text;
  EXPECT_EQ(text.find('\r'), std::string::npos);
}

TEST(Progress, ABarEndsWithALine) {
  std::ostringstream out;
  Progress progress(&out, true, 3, 1e-3);
  for (std::size_t i = 1; i <= 3; ++i) {
    progress.show(i, 1, 0);
  }
  EXPECT_EQ(out.str().front(), '\r');
  EXPECT_EQ(out.str().back(), '\n');
}

}  // namespace
}  // namespace insertion
