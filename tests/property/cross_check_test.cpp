// libccd's cross-check of the normals of swept edges and of bodies at every level, on made and on real meshes and at
// three scales: on how many contacts it has one, and how far the two normals are apart. Both figures are printed and
// have a bar.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <set>

#include "body_state.h"
#include "cross_checks.h"
#include "mesh_file.h"
#include "support.h"

namespace dsw::oracle {
namespace {

/// Whether the library has libccd: DSW_TEST_WITH_LIBCCD says so where another one takes the place of the one built with the tests.
bool with_libccd() {
  const char* const text = std::getenv("DSW_TEST_WITH_LIBCCD");
  return text == nullptr ? DSW_TEST_WITH_LIBCCD != 0 : *text == '1';
}

constexpr double kScales[] = {1e-3, 1, 1e6};
constexpr double kDegrees = 180 / 3.14159265358979323846;

/// Cells thinner than libccd's numbers reach (a layer of 1e-12): cross-checks are few, but they have to fit.
const std::set<std::string> kThin = {"hex_thin", "tet_slivers", "waist_slivers"};

struct AllFigures {
  CrossChecks vertex, edge, diagonal, face;  // by what touches; a diagonal is the wall's

  CrossChecks& of(const dsw_body_contact& contact) {
    if (contact.face.generation != 0) return face;
    if (contact.edge.generation == 0) return vertex;
    return contact.contact.kind == DSW_CONTACT_PLANE ? diagonal : edge;
  }
  CrossChecks sum() const {
    CrossChecks all = vertex;
    for (const CrossChecks* part : {&edge, &diagonal, &face}) all.add(*part);
    return all;
  }
  void add(const AllFigures& other) {
    vertex.add(other.vertex);
    edge.add(other.edge);
    diagonal.add(other.diagonal);
    face.add(other.face);
  }
  void judge(const std::string& name, bool thin = false) const {
    const CrossChecks all = sum();
    std::printf("%-28s %s\n", name.c_str(), all.text().c_str());
    if (diagonal.contacts != 0) std::printf("  of them on diagonals       %s\n", diagonal.text().c_str());
    if (face.contacts != 0) std::printf("  of them of faces           %s\n", face.text().c_str());
    EXPECT_GE(all.share(), thin ? 0 : CrossChecks::kLeastShare) << name;
    EXPECT_LE(all.quantile(0.99), CrossChecks::kMostDegrees) << name;
  }
};

/// For the benchmark, which joins the figures of all tests.
void record(const AllFigures& figures) {
  const CrossChecks all = figures.sum();
  testing::Test::RecordProperty("contacts", std::to_string(all.contacts));
  testing::Test::RecordProperty("cross_checks", std::to_string(all.degrees.size()));
  char degrees[32];
  std::snprintf(degrees, sizeof degrees, "%.6g", all.quantile(0.99));
  testing::Test::RecordProperty("deg_p99", degrees);
}

double dot(const double* a, const double* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Random sweeps, and moves of bodies, of a few cells' length in one environment, some of it marked.
class Bench {
 public:
  Bench(const Mesh& mesh, dsw_environment* environment, uint64_t seed)
      : mesh_(mesh), environment_(environment), rng_(seed) {}

  void mark(double volumes, double faces) {
    std::vector<dsw_volume_id> solid;
    std::vector<dsw_face_id> walls;
    for (uint32_t c = 0; c < mesh_.cells.size(); ++c) {
      if (rng_.chance(volumes)) solid.push_back({c, 1});
      if (rng_.chance(faces)) walls.push_back({c, 1, rng_.below(4)});
    }
    ASSERT_EQ(dsw_environment_mark_volumes(environment_, solid.data(), solid.size(), DSW_MARK_IMPASSABLE, 0, nullptr),
              DSW_STATUS_OK);
    ASSERT_EQ(dsw_environment_mark_faces(environment_, walls.data(), walls.size(), DSW_MARK_IMPASSABLE), DSW_STATUS_OK);
  }

  std::vector<dsw_body_contact> contacts(size_t count) {
    std::vector<Vec> from(count), to(count), fixed(count);
    for (size_t i = 0; i < count; ++i) {
      Vec size;
      from[i] = inside(size);
      fixed[i] = near(from[i], size);
      to[i] = near(from[i], size);
    }
    std::vector<dsw_sweep> sweeps(count);
    EXPECT_EQ(dsw_environment_sweep_edges(environment_, count, nullptr, from[0].data(), to[0].data(), fixed[0].data(),
                                          0, nullptr, sweeps.data()),
              DSW_STATUS_OK)
        << dsw_last_error_message();
    std::vector<dsw_body_contact> found;
    for (size_t i = 0; i < count; ++i) {
      if (sweeps[i].outcome == DSW_OUTCOME_CONTACT) found.push_back(to_contact(from[i], to[i], fixed[i], sweeps[i]));
    }
    return found;
  }

  dsw_cross_check ask(const dsw_body_contact& contact) const {
    dsw_cross_check check{};
    EXPECT_EQ(dsw_environment_cross_check(environment_, &contact, &check), DSW_STATUS_OK) << dsw_last_error_message();
    return check;
  }

  AllFigures run(size_t count) {
    AllFigures all;
    for (const dsw_body_contact& contact : contacts(count)) ask(contact, all);
    return all;
  }

  /// Bodies of a level, each moved a few times.
  AllFigures run_bodies(dsw_level level, size_t count) {
    AllFigures all;
    const ScenePtr scene = make_scene(environment_);
    for (size_t i = 0; i < count; ++i) {
      const BodyPlan plan = body_plan(level);
      dsw_body_id body;
      if (create_body(scene.get(), plan, level, 0, {}, &body) != DSW_STATUS_OK) continue;  // not free there
      BodyAnswer answer;
      for (int move = 0; move < 4; ++move) {
        std::vector<Vec> targets;
        Vec size;
        inside(size);
        for (size_t v = 0; v < plan.at.size(); ++v) {
          targets.push_back(near(move == 0 ? plan.at[v] : answer.after.at[v], size));
        }
        EXPECT_EQ(move_body(scene.get(), body, targets, nullptr, answer), "");
        for (const dsw_body_contact& contact : answer.contacts) ask(contact, all);
      }
      EXPECT_EQ(dsw_body_destroy(scene.get(), body), DSW_STATUS_OK);
    }
    return all;
  }

 private:
  void ask(const dsw_body_contact& contact, AllFigures& all) const {
    EXPECT_TRUE(all.of(contact).ask(environment_, contact)) << dsw_last_error_message();
  }
  /// A vertex, a chain of three, or a fan of two triangles.
  BodyPlan body_plan(dsw_level level) {
    BodyPlan plan;
    Vec size;
    plan.at.push_back(inside(size));
    for (double& x : size) x /= 4;
    const size_t count = level == DSW_LEVEL_POINTS ? 1 : level == DSW_LEVEL_FACES ? 4 : 3;
    while (plan.at.size() < count) plan.at.push_back(near(plan.at[0], size));
    if (level == DSW_LEVEL_FACES) {
      plan.faces = {{0, 1, 2}, {0, 2, 3}};
    } else if (count == 3) {
      plan.edges = {{0, 1}, {1, 2}};
    }
    return plan;
  }

  /// A random point of a random cell, and the size of that cell along the axes.
  Vec inside(Vec& size) {
    const Cell& cell = mesh_.cells[rng_.below(mesh_.cells.size())];
    std::vector<int> corners = cell.vertices;
    if (corners.empty()) {
      for (const Loop& loop : cell.faces) corners.insert(corners.end(), loop.begin(), loop.end());
    }
    Vec p{}, low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    double sum = 0;
    for (const int i : corners) {
      const double weight = rng_.unit();
      sum += weight;
      for (size_t k = 0; k < 3; ++k) {
        const double x = mesh_.points[static_cast<size_t>(i)][k];
        p[k] += weight * x;
        low[k] = std::min(low[k], x);
        high[k] = std::max(high[k], x);
      }
    }
    for (size_t k = 0; k < 3; ++k) {
      p[k] /= sum;
      size[k] = high[k] - low[k];
    }
    return p;
  }
  Vec near(const Vec& p, const Vec& size) {
    Vec q;
    for (size_t k = 0; k < 3; ++k) q[k] = p[k] + rng_.range(-2, 2) * size[k];
    return q;
  }

  const Mesh& mesh_;
  dsw_environment* environment_;
  Rng rng_;
};

void scale(Mesh& mesh, double by) {
  for (Vec& p : mesh.points) {
    for (double& x : p) x *= by;
  }
}

/// A round, bent tube of hexahedra, passable inside.
Mesh make_vessel() {
  Mesh mesh = hex_grid(axis(6, 1.0 / 3), axis(6, 1.0 / 3), axis(40, 0.25));
  for (Vec& p : mesh.points) {
    const double x = p[0] - 1, y = p[1] - 1, turn = -p[2] / 4;
    const double u = x * std::sqrt(1 - y * y / 3), v = y * std::sqrt(1 - x * x / 3);  // nearly a disk
    p = {(4 + u) * std::cos(turn), (4 + u) * std::sin(turn), v + p[2] / 2};
  }
  return mesh;
}

/// What run(bench, figures) finds in all made scenes, as large as this and with something impassable; judged.
template <class Run>
AllFigures judge_scenes(double size, int seeds, Run run) {
  AllFigures sum;
  for (const SceneKind& kind : scene_kinds()) {
    AllFigures all;
    for (uint64_t seed = 1; seed <= static_cast<uint64_t>(seeds); ++seed) {
      Rng rng(seed);
      Mesh mesh = kind.make(rng);
      scale(mesh, size);
      const EnvironmentPtr environment = create_environment(mesh);
      if (environment == nullptr) continue;  // a sliver that scaling turned over
      Bench bench(mesh, environment.get(), seed);
      bench.mark(0.1, 0.03);
      run(bench, all);
    }
    const bool thin = kThin.count(kind.name) != 0;
    all.judge(kind.name, thin);
    if (!thin) sum.add(all);
  }
  sum.judge("all but those with slivers");
  record(sum);
  return sum;
}

class CrossCheckTest : public testing::TestWithParam<double> {
 protected:
  void SetUp() override {
    if (!with_libccd()) GTEST_SKIP() << "built without libccd";
  }
};
INSTANTIATE_TEST_SUITE_P(Scale, CrossCheckTest, testing::ValuesIn(kScales),
                         [](const testing::TestParamInfo<double>& i) {
                           return i.param < 1 ? "Milli" : i.param > 1 ? "Mega" : "One";
                         });

TEST_P(CrossCheckTest, NormalsOfMadeScenes) {
  const AllFigures sum = judge_scenes(GetParam(), 6, [](Bench& bench, AllFigures& all) { all.add(bench.run(1500)); });
  EXPECT_GT(sum.vertex.contacts, 2000u);
  EXPECT_GT(sum.edge.contacts, 500u);
}

TEST_P(CrossCheckTest, NormalsOfBodies) {
  const AllFigures sum = judge_scenes(GetParam(), std::max(2, effort_of(4)), [](Bench& bench, AllFigures& all) {
    for (dsw_level level : {DSW_LEVEL_POINTS, DSW_LEVEL_EDGES, DSW_LEVEL_EDGES_SWEPT, DSW_LEVEL_FACES}) {
      all.add(bench.run_bodies(level, 60));
    }
  });
  EXPECT_GT(sum.vertex.contacts, 2000u);
  EXPECT_GT(sum.edge.contacts, 300u);
  EXPECT_GT(sum.face.contacts, 20u);
}

TEST_P(CrossCheckTest, NormalsInAVessel) {
  Mesh mesh = make_vessel();
  scale(mesh, GetParam());
  const EnvironmentPtr environment = create_environment(mesh);
  ASSERT_NE(environment, nullptr);
  AllFigures all = Bench(mesh, environment.get(), 3).run(10000);
  all.judge("vessel");
  record(all);
  EXPECT_GT(all.vertex.contacts, 500u);
}

/// Ours turned by a known angle: the cross-check has to say so. The bars would mean nothing if it did not.
TEST_P(CrossCheckTest, AWrongNormalIsNoticed) {
  Rng rng(11);
  Mesh mesh = kind_named("hex_warped").make(rng);
  scale(mesh, GetParam());
  const EnvironmentPtr environment = create_environment(mesh);
  ASSERT_NE(environment, nullptr);
  Bench bench(mesh, environment.get(), 7);
  bench.mark(0.1, 0.05);
  uint64_t asked = 0, noticed = 0, wrong = 0;
  for (const dsw_body_contact& contact : bench.contacts(6000)) {
    if (contact.contact.kind == DSW_CONTACT_PLANE && contact.edge_parameter > 0) continue;
    for (const double degrees : {0.02, 0.5, 10.0, 40.0}) {
      dsw_body_contact turned =
          contact;  // towards the edge, which leaves an edge's normal above both faces of the wedge
      const Vec along = {contact.fixed[0][0] - contact.position[0], contact.fixed[0][1] - contact.position[1],
                         contact.fixed[0][2] - contact.position[2]};
      const double part = dot(along.data(), contact.contact.normal);
      Vec aside;
      for (size_t k = 0; k < 3; ++k) aside[k] = along[k] - part * contact.contact.normal[k];
      const double length = std::sqrt(dot(aside.data(), aside.data())), a = degrees / kDegrees;
      for (size_t k = 0; k < 3; ++k) {
        turned.contact.normal[k] = std::cos(a) * contact.contact.normal[k] + std::sin(a) * aside[k] / length;
      }
      const dsw_cross_check check = bench.ask(turned);
      ++asked;
      if (check.kind == DSW_CROSS_CHECK_NONE) continue;
      if (std::fabs(check.angle_rad * kDegrees - degrees) < 1e-4) {
        ++noticed;
      } else {
        ++wrong;
      }
    }
  }
  std::printf("%llu normals turned, noticed %llu, another angle %llu\n", static_cast<unsigned long long>(asked),
              static_cast<unsigned long long>(noticed), static_cast<unsigned long long>(wrong));
  EXPECT_GT(asked, 300u);
  EXPECT_GT(noticed * 10, asked * 9);
  EXPECT_LT(wrong * 100, asked);
}

/// Whatever the numbers: an answer, and soon; where there is a cross-check, numbers in it.
TEST_P(CrossCheckTest, AnyNumbersHaveAnAnswer) {
  Rng rng(17);
  Mesh mesh = kind_named("polyhedra_warped").make(rng);
  scale(mesh, GetParam());
  const EnvironmentPtr environment = create_environment(mesh);
  ASSERT_NE(environment, nullptr);
  Bench bench(mesh, environment.get(), 7);
  bench.mark(0.2, 0.1);
  const double odd[] = {0, -0.0, 1, 1e-300, 5e-324, 1e300, -1.7e308, 1e6, -1e-3};
  uint64_t cross_checks = 0;
  for (dsw_body_contact c : bench.contacts(4000)) {
    for (int i = 0; i < 20; ++i) {
      double* const members[] = {c.position, c.fixed[0], c.fixed[1], c.point};
      double& x = members[rng.below(4u)][rng.below(3u)];
      x = rng.chance(0.5) ? odd[rng.below(9u)] : x * rng.range(0.5, 2);
      if (!std::isfinite(x)) x = 0;
      if (rng.chance(0.2)) {
        c.contact.kind = DSW_CONTACT_VERTEX;
        c.contact.obstacle = cell_of(vertices_of(environment.get(), cell_of(c.contact.wall))[0]);
      }
      const dsw_cross_check check = bench.ask(c);
      if (check.kind == DSW_CROSS_CHECK_NONE) continue;
      ++cross_checks;
      EXPECT_NEAR(dot(check.normal, check.normal), 1, 1e-9);
      EXPECT_TRUE(std::isfinite(check.depth) && check.depth >= 0 && check.pushed_in >= 0);
      EXPECT_TRUE(check.angle_rad >= 0 && check.angle_rad < 3.2);
    }
  }
  EXPECT_GT(cross_checks, 100u);
}

class CrossCheckMeshTest : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    if (!with_libccd()) GTEST_SKIP() << "built without libccd";
  }
};
INSTANTIATE_TEST_SUITE_P(All, CrossCheckMeshTest,
                         testing::Values("cells/carotids_convex.vtk", "cells/cylinder_hex.msh", "cells/liver_mixed.msh",
                                         "cells/rockerarm_hex.msh", "organs/liver.msh", "organs/ossicles.msh",
                                         "vessels/abdominal_aneurysm_wall.msh", "vessels/aneurysm_fsi.msh",
                                         "vessels/carotids.msh", "vessels/carotids_slivers.msh"),
                         [](const testing::TestParamInfo<const char*>& file) {
                           std::string name = file.param;
                           for (char& c : name) {
                             if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
                           }
                           return name;
                         });

TEST_P(CrossCheckMeshTest, NormalsOfRealMeshes) {
  const char* folder = std::getenv("DARTSWEEP_DATA");
  if (folder == nullptr) GTEST_SKIP() << "DARTSWEEP_DATA is not set";
  const std::string path = std::string(folder) + "/" + GetParam();
  if (!std::ifstream(path)) GTEST_SKIP() << path << " is not there";
  Mesh original;
  std::string reason;
  ASSERT_TRUE(read_mesh(path, original, reason)) << reason;
  AllFigures sum;
  for (const double by : kScales) {
    if (by != 1 && effort_of(4) < 2) continue;
    Mesh mesh = original;
    scale(mesh, by);
    const EnvironmentPtr environment = create_environment(mesh, {}, DSW_ENVIRONMENT_LOCATE_TREE);
    ASSERT_NE(environment, nullptr);
    Bench bench(mesh, environment.get(), 5);
    bench.mark(0.02, 0.02);
    AllFigures all = bench.run(6000);
    all.judge(std::string(GetParam()).substr(std::string(GetParam()).find('/') + 1) + (by < 1   ? " 1e-3"
                                                                                       : by > 1 ? " 1e6"
                                                                                                : ""));
    EXPECT_GT(all.vertex.contacts + all.edge.contacts, 300u);
    sum.add(all);
  }
  record(sum);
}

}  // namespace
}  // namespace dsw::oracle
