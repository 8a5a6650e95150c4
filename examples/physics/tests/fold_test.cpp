#include "fold.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace physics {
namespace {

// How far an inserted vertex is from the straight line between its neighbours.
double off_line(SoftBody& body, std::size_t i) {
  const Positions& at = body.points.position;
  const Vector3 &a = at[body.inserted().ends(i)[0]], &b = at[body.inserted().ends(i)[1]], way = b - a;
  const double share = std::min(1.0, std::max(0.0, way.dot(at[i] - a) / way.squaredNorm()));
  return (a + share * way - at[i]).norm();
}

class FoldTest : public testing::TestWithParam<FoldBody> {};

TEST_P(FoldTest, FoldsUnfoldsAndIsWhatItWas) {
  FoldOptions options;
  options.body = GetParam();
  Fold fold(options);
  SoftBody& body = fold.body();
  const double radius = body.shape->radius();
  const std::size_t vertices = body.count();
  std::size_t inserted = 0, removed = 0, removed_folded = 0;
  FoldStep last;
  while (!fold.is_over()) {
    std::vector<double> off(body.points.size(), -1);
    for (std::size_t i = 0; i < off.size(); ++i) {
      off[i] = body.was_inserted(i) ? off_line(body, i) : -1;
    }
    last = fold.step();
    ASSERT_TRUE(last.validation.good()) << "step " << last.step;
    EXPECT_EQ(last.vertices, vertices + inserted + last.inserted - removed - last.removed);
    inserted += last.inserted;
    removed += last.removed;
    if (last.phase == "press" && 2 * last.step > options.press) {
      EXPECT_GT(last.vertices, vertices) << "the fold needs them, step " << last.step;
      EXPECT_GT(last.largest_pull, 0.1);
      removed_folded += last.removed;
    }
    // The weight of what a step removes turns the shape a little before the next one goes.
    EXPECT_LE(last.removed_pull, 1.1 * options.negligible);
    if (options.body !=
        FoldBody::kSurface) {  // there the neighbours need not be in line with one that is inside of a face
      for (std::size_t i = 0; i < off.size(); ++i) {
        EXPECT_TRUE(off[i] < 0 || body.was_inserted(i) || off[i] <= 2.2 * options.negligible * radius);
      }
    }
  }
  EXPECT_GE(inserted, 2u);
  EXPECT_EQ(removed, inserted);
  EXPECT_EQ(removed_folded, 0u);
  EXPECT_TRUE(fold.is_as_at_first());
  EXPECT_LT(last.bend, 1e-3);
}

TEST_P(FoldTest, WithoutTheCriterionVerticesStay) {
  FoldOptions options;
  options.body = GetParam();
  options.negligible = 0;
  Fold fold(options);
  std::size_t removed = 0;
  while (!fold.is_over()) {
    removed += fold.step().removed;
  }
  EXPECT_EQ(removed, 0u);
  EXPECT_FALSE(fold.is_as_at_first());
}

INSTANTIATE_TEST_SUITE_P(Bodies, FoldTest, testing::ValuesIn(kFoldBodies),
                         [](const testing::TestParamInfo<FoldBody>& body) { return std::string(name_of(body.param)); });

// [JCD10] 7.3.1: "if too much weight is used for newly added particles, the transformation computation could result
// in an abnormal compensation toward them and induces unwanted rotation".
TEST(FoldWeight, TooMuchOfItTurnsTheBody) {
  double turned[3] = {0, 0, 0}, unwanted[3] = {0, 0, 0};
  const double omegas[3] = {0, 1, 5};
  for (int k = 0; k < 3; ++k) {
    FoldOptions options;
    options.omega = omegas[k];
    options.aside = 1;
    options.press = 80;
    options.lift = options.rest = 0;
    Fold fold(options);
    while (!fold.is_over()) {
      const FoldStep step = fold.step();
      turned[k] += step.turned / options.press;
      unwanted[k] += step.unwanted / options.press;
    }
  }
  EXPECT_LT(unwanted[0], 1e-6);
  EXPECT_GT(unwanted[1], 0.1);
  EXPECT_GT(unwanted[2], unwanted[1]);
  EXPECT_GT(turned[1], turned[0] + 1);
  EXPECT_GT(turned[2], turned[1] + 1);
}

// Equation 2 is given the place of the contact: the vertex rests where the ridge meets the line at rest, whichever
// end is first.
TEST(FoldWeight, AnInsertedVertexRestsWhereTheRidgeIs) {
  for (const bool turned : {false, true}) {
    Fold scene((FoldOptions()));
    Positions line = {{3.7, 3, 2.02}, {4.7, 3, 2.02}};
    if (turned) {
      std::swap(line[0], line[1]);
    }
    SoftBodyOptions options;
    options.match = 0.1;
    SoftBody body(scene.body().scene(), line, 1, options);
    body.shape.emplace(body.points);
    body.load.gravity = Vector3(0, 0, -10);
    for (int step = 0; step < 20 && body.count() == 2; ++step) {
      body.step(0.01);
    }
    ASSERT_EQ(body.count(), 3u);
    const Vector3& rest = body.shape->rest(2);
    EXPECT_NEAR(rest.x(), 4, 0.01);
    EXPECT_EQ(rest.y(), 3);
    EXPECT_EQ(rest.z(), 2.02);
  }
}

}  // namespace
}  // namespace physics
