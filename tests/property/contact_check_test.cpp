// libccd's second opinion on the normals of swept edges, on made and on real meshes and at three scales: on how many contacts it
// has one, and how far the two normals are apart. Both figures are printed and have a bar.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <set>

#include "mesh_file.h"
#include "support.h"

namespace dsw::oracle {
namespace {

constexpr double kLeastShare = 0.95;   // of all contacts that get an opinion
constexpr double kMostDegrees = 0.01;  // 99 of 100 angles are not above
constexpr double kScales[] = {1e-3, 1, 1e6};
constexpr double kDegrees = 180 / 3.14159265358979323846;

/// Cells thinner than libccd's numbers reach (a layer of 1e-12): opinions are few, but where there is one it has to fit.
const std::set<std::string> kThin = {"hex_thin", "tet_slivers", "waist_slivers"};

struct Figures {
  uint64_t contacts = 0, reasons[8] = {};
  std::vector<double> degrees;

  void add(const Figures& other) {
    contacts += other.contacts;
    for (size_t i = 0; i < 8; ++i) reasons[i] += other.reasons[i];
    degrees.insert(degrees.end(), other.degrees.begin(), other.degrees.end());
  }
  double share() const {
    return contacts == 0 ? 1 : static_cast<double>(degrees.size()) / static_cast<double>(contacts);
  }
  double quantile(double part) {
    if (degrees.empty()) return 0;
    std::sort(degrees.begin(), degrees.end());
    return degrees[static_cast<size_t>(part * static_cast<double>(degrees.size() - 1))];
  }
  void print(const std::string& name) {
    const auto none = [this](dsw_no_opinion why) { return static_cast<unsigned long long>(reasons[why]); };
    std::printf(
        "%-28s %6llu contacts, opinion on %8.4f %%, angle p50 %.1e p99 %.1e most %.1e degrees; none: parallel "
        "%llu, outside cone %llu, not converged %llu, not unique %llu\n",
        name.c_str(), static_cast<unsigned long long>(contacts), 100 * share(), quantile(0.5), quantile(0.99),
        quantile(1), none(DSW_NO_OPINION_PARALLEL), none(DSW_NO_OPINION_OUTSIDE_CONE),
        none(DSW_NO_OPINION_NOT_CONVERGED), none(DSW_NO_OPINION_NOT_UNIQUE));
  }
};

struct AllFigures {
  Figures vertex, edge, diagonal;

  void add(const AllFigures& other) {
    vertex.add(other.vertex);
    edge.add(other.edge);
    diagonal.add(other.diagonal);
  }
  void judge(const std::string& name, bool thin = false) {
    Figures sum = vertex;
    sum.add(edge);
    sum.add(diagonal);
    sum.print(name);
    if (diagonal.contacts != 0) diagonal.print("  of them on diagonals");
    EXPECT_GE(sum.share(), thin ? 0 : kLeastShare) << name;
    EXPECT_LE(sum.quantile(0.99), kMostDegrees) << name;
  }
};

double dot(const double* a, const double* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// The report of a sweep as that of a body would be.
dsw_contact to_contact(const Vec& from, const Vec& to, const Vec& fixed, const dsw_sweep& s) {
  dsw_contact c{};
  std::copy_n(from.data(), 3, c.from);
  std::copy_n(to.data(), 3, c.to);
  std::copy_n(fixed.data(), 3, c.fixed[0]);
  std::copy_n(s.position, 3, c.position);
  std::copy_n(s.point, 3, c.point);
  std::copy_n(s.normal, 3, c.normal);
  c.time = s.time;
  c.along = s.along;
  c.vertex = {0, 1};
  if (s.kind == DSW_CONTACT_EDGE || s.along > 0) c.edge = {0, 1};
  c.obstacle = s.kind == DSW_CONTACT_EDGE ? cell_of(s.edge) : cell_of(s.face);
  c.wall = s.face;
  c.front = s.front;
  c.kind = s.kind;
  c.cause = s.obstacle;
  c.tag = s.tag;
  return c;
}

/// Random sweeps of a few cells' length in one environment, some of it marked.
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

  std::vector<dsw_contact> contacts(size_t count) {
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
    std::vector<dsw_contact> found;
    for (size_t i = 0; i < count; ++i) {
      if (sweeps[i].outcome == DSW_OUTCOME_CONTACT) found.push_back(to_contact(from[i], to[i], fixed[i], sweeps[i]));
    }
    return found;
  }

  dsw_contact_opinion ask(const dsw_contact& contact) const {
    dsw_contact_opinion opinion{};
    EXPECT_EQ(dsw_contact_check(environment_, &contact, &opinion), DSW_STATUS_OK) << dsw_last_error_message();
    return opinion;
  }

  AllFigures run(size_t count) {
    AllFigures all;
    for (const dsw_contact& contact : contacts(count)) {
      const bool diagonal = contact.kind == DSW_CONTACT_PLANE && contact.along > 0;
      Figures& f = contact.kind == DSW_CONTACT_EDGE ? all.edge : diagonal ? all.diagonal : all.vertex;
      const dsw_contact_opinion opinion = ask(contact);
      ++f.contacts;
      if (opinion.opinion == DSW_OPINION_NONE) {
        ++f.reasons[opinion.reason & 7];
        continue;
      }
      EXPECT_EQ(opinion.opinion, contact.edge.generation != 0 ? DSW_OPINION_EDGE : DSW_OPINION_PLANE);
      EXPECT_NEAR(dot(opinion.normal, opinion.normal), 1, 1e-9);
      f.degrees.push_back(opinion.angle_rad * kDegrees);
    }
    return all;
  }

 private:
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

class ContactCheckTest : public testing::TestWithParam<double> {
 protected:
  void SetUp() override {
    if (DSW_TEST_WITH_LIBCCD == 0) GTEST_SKIP() << "built without libccd";
  }
};
INSTANTIATE_TEST_SUITE_P(Scale, ContactCheckTest, testing::ValuesIn(kScales),
                         [](const testing::TestParamInfo<double>& i) {
                           return i.param < 1 ? "Milli" : i.param > 1 ? "Mega" : "One";
                         });

TEST_P(ContactCheckTest, NormalsOfMadeScenes) {
  AllFigures sum;
  for (const SceneKind& kind : scene_kinds()) {
    AllFigures all;
    for (uint64_t seed = 1; seed <= 6; ++seed) {
      Rng rng(seed);
      Mesh mesh = kind.make(rng);
      scale(mesh, GetParam());
      const EnvironmentPtr environment = create_environment(mesh);
      if (environment == nullptr) continue;  // a sliver that scaling turned over
      Bench bench(mesh, environment.get(), seed);
      bench.mark(0.1, 0.03);
      all.add(bench.run(1500));
    }
    const bool thin = kThin.count(kind.name) != 0;
    all.judge(kind.name, thin);
    if (!thin) sum.add(all);
  }
  sum.judge("all but those with slivers");
  EXPECT_GT(sum.vertex.contacts, 2000u);
  EXPECT_GT(sum.edge.contacts, 500u);
}

TEST_P(ContactCheckTest, NormalsInAVessel) {
  Mesh mesh = make_vessel();
  scale(mesh, GetParam());
  const EnvironmentPtr environment = create_environment(mesh);
  ASSERT_NE(environment, nullptr);
  AllFigures all = Bench(mesh, environment.get(), 3).run(10000);
  all.judge("vessel");
  EXPECT_GT(all.vertex.contacts, 500u);
}

/// Ours turned by a known angle: the opinion has to say so. The bars would mean nothing if it did not.
TEST_P(ContactCheckTest, AWrongNormalIsNoticed) {
  Rng rng(11);
  Mesh mesh = kind_named("hex_warped").make(rng);
  scale(mesh, GetParam());
  const EnvironmentPtr environment = create_environment(mesh);
  ASSERT_NE(environment, nullptr);
  Bench bench(mesh, environment.get(), 7);
  bench.mark(0.1, 0.05);
  uint64_t asked = 0, noticed = 0, wrong = 0;
  for (const dsw_contact& contact : bench.contacts(6000)) {
    if (contact.kind == DSW_CONTACT_PLANE && contact.along > 0) continue;
    for (const double degrees : {0.02, 0.5, 10.0, 40.0}) {
      dsw_contact turned = contact;  // towards the edge, which leaves an edge's normal above both faces of the wedge
      const Vec along = {contact.fixed[0][0] - contact.position[0], contact.fixed[0][1] - contact.position[1],
                         contact.fixed[0][2] - contact.position[2]};
      const double part = dot(along.data(), contact.normal);
      Vec aside;
      for (size_t k = 0; k < 3; ++k) aside[k] = along[k] - part * contact.normal[k];
      const double length = std::sqrt(dot(aside.data(), aside.data())), a = degrees / kDegrees;
      for (size_t k = 0; k < 3; ++k) {
        turned.normal[k] = std::cos(a) * contact.normal[k] + std::sin(a) * aside[k] / length;
      }
      const dsw_contact_opinion opinion = bench.ask(turned);
      ++asked;
      if (opinion.opinion == DSW_OPINION_NONE) continue;
      if (std::fabs(opinion.angle_rad * kDegrees - degrees) < 1e-4) {
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

/// Whatever the numbers: an answer, and soon; where there is an opinion, numbers in it.
TEST_P(ContactCheckTest, AnyNumbersHaveAnAnswer) {
  Rng rng(17);
  Mesh mesh = kind_named("polyhedra_warped").make(rng);
  scale(mesh, GetParam());
  const EnvironmentPtr environment = create_environment(mesh);
  ASSERT_NE(environment, nullptr);
  Bench bench(mesh, environment.get(), 7);
  bench.mark(0.2, 0.1);
  const double odd[] = {0, -0.0, 1, 1e-300, 5e-324, 1e300, -1.7e308, 1e6, -1e-3};
  uint64_t opinions = 0;
  for (dsw_contact c : bench.contacts(4000)) {
    for (int i = 0; i < 20; ++i) {
      double* const members[] = {c.position, c.fixed[0], c.fixed[1], c.point};
      double& x = members[rng.below(4u)][rng.below(3u)];
      x = rng.chance(0.5) ? odd[rng.below(9u)] : x * rng.range(0.5, 2);
      if (!std::isfinite(x)) x = 0;
      if (rng.chance(0.2)) {
        c.kind = DSW_CONTACT_VERTEX;
        c.obstacle = cell_of(vertices_of(environment.get(), cell_of(c.wall))[0]);
      }
      const dsw_contact_opinion opinion = bench.ask(c);
      if (opinion.opinion == DSW_OPINION_NONE) continue;
      ++opinions;
      EXPECT_NEAR(dot(opinion.normal, opinion.normal), 1, 1e-9);
      EXPECT_TRUE(std::isfinite(opinion.depth) && opinion.depth >= 0 && opinion.pushed_in >= 0);
      EXPECT_TRUE(opinion.angle_rad >= 0 && opinion.angle_rad < 3.2);
    }
  }
  EXPECT_GT(opinions, 100u);
}

class ContactCheckMeshTest : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    if (DSW_TEST_WITH_LIBCCD == 0) GTEST_SKIP() << "built without libccd";
  }
};
INSTANTIATE_TEST_SUITE_P(All, ContactCheckMeshTest,
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

TEST_P(ContactCheckMeshTest, NormalsOfRealMeshes) {
  const char* folder = std::getenv("DARTSWEEP_DATA");
  if (folder == nullptr) GTEST_SKIP() << "DARTSWEEP_DATA is not set";
  const std::string path = std::string(folder) + "/" + GetParam();
  if (!std::ifstream(path)) GTEST_SKIP() << path << " is not there";
  Mesh original;
  std::string reason;
  ASSERT_TRUE(read_mesh(path, original, reason)) << reason;
  for (const double by : kScales) {
    Mesh mesh = original;
    scale(mesh, by);
    const EnvironmentPtr environment = create_environment(mesh, {}, DSW_ENVIRONMENT_LOCATE_GRID);
    ASSERT_NE(environment, nullptr);
    Bench bench(mesh, environment.get(), 5);
    bench.mark(0.02, 0.02);
    AllFigures all = bench.run(6000);
    all.judge(std::string(GetParam()).substr(std::string(GetParam()).find('/') + 1) + (by < 1   ? " 1e-3"
                                                                                       : by > 1 ? " 1e6"
                                                                                                : ""));
    EXPECT_GT(all.vertex.contacts + all.edge.contacts, 300u);
  }
}

}  // namespace
}  // namespace dsw::oracle
