// Real meshes: created, proved, and random casts compared with the oracle, which looks at the triangles near a
// segment only. DARTSWEEP_DATA names the folder; without it every case is skipped.
#include "mesh_file.h"
#include "support.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>

namespace dsw::oracle {
namespace {

class RealMeshTest : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(All, RealMeshTest,
                         testing::Values("cells/carotids_convex.vtk", "cells/carotids_voronoi.vtk",
                                         "cells/cylinder_hex.msh", "cells/eight_voronoi_nonconvex.vtk",
                                         "cells/liver_mixed.msh", "cells/liver_mixed.vtk",
                                         "cells/liver_mixed_warped.msh", "cells/rockerarm_hex.msh", "organs/liver.msh",
                                         "organs/liver_sofa.msh", "organs/ossicles.msh", "organs/tongue.msh",
                                         "vessels/abdominal_aneurysm_wall.msh", "vessels/aneurysm_fsi.msh",
                                         "vessels/brain_arteries.msh.gz", "vessels/brain_slivers.msh.gz",
                                         "vessels/carotids.msh", "vessels/carotids_slivers.msh",
                                         "vessels/vascular_phantom.msh.gz"),
                         [](const testing::TestParamInfo<const char*>& file) {
                           std::string name = file.param;
                           for (char& c : name) {
                             if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
                           }
                           return name;
                         });

/// Cells may only be refused where some face has no triangulation that suits both of its volumes; then the mesh is
/// tried without them, so that the rest is walked with holes in it.
EnvironmentPtr create_or_thin_out(Mesh& mesh) {
  size_t refused = 0;
  for (int round = 0; round < 10; ++round) {
    const DescArrays arrays(mesh, {});
    dsw_environment_desc desc = arrays.desc;
    desc.flags = DSW_ENVIRONMENT_LOCATE_TREE;
    dsw_build_report report;
    report.struct_size = sizeof report;
    dsw_environment* environment = nullptr;
    const dsw_status status = dsw_environment_create(nullptr, &desc, &environment, &report);
    if (status == DSW_STATUS_OK) {
      if (refused > 0) std::printf("%zu cells were refused and left out\n", refused);
      return EnvironmentPtr(environment);
    }
    EXPECT_EQ(status, DSW_STATUS_INVALID_CELL) << dsw_last_error_message();
    EXPECT_TRUE(may_be_refused(mesh)) << dsw_last_error_message();
    if (status != DSW_STATUS_INVALID_CELL || !may_be_refused(mesh)) return nullptr;
    for (uint32_t i = report.offender_count; i-- > 0;) {
      const auto cell = static_cast<std::ptrdiff_t>(report.offenders[i]);
      mesh.cells.erase(mesh.cells.begin() + cell);
      if (!mesh.regions.empty()) mesh.regions.erase(mesh.regions.begin() + cell);
    }
    refused += report.offender_count;
  }
  return nullptr;
}

TEST_P(RealMeshTest, CastsAndMovesAgreeWithTheOracle) {
  const char* folder = std::getenv("DARTSWEEP_DATA");
  if (folder == nullptr) GTEST_SKIP() << "DARTSWEEP_DATA is not set";
  const std::string path = std::string(folder) + "/" + GetParam();
  if (!std::ifstream(path)) GTEST_SKIP() << path << " is not there";
  if (!can_unpack(path)) GTEST_SKIP() << "no gzip for " << path;
  Place place;
  std::string reason;
  ASSERT_TRUE(read_mesh(path, place.mesh, reason)) << reason;
  place.environment = create_or_thin_out(place.mesh);
  ASSERT_NE(place.environment, nullptr);
  place.world = std::make_unique<World>(place.mesh, place.get());
  ASSERT_PLACE(place);
  World& world = *place.world;
  EXPECT_EQ(dsw_environment_check(place.get(), nullptr), DSW_STATUS_OK) << dsw_last_error_message();
  Big sum = 0;
  for (size_t c = 0; c < world.ids.size(); ++c) {
    const Big volume = world.volume6(static_cast<int>(c));
    ASSERT_GT(sgn(volume), 0) << "cell " << c;
    sum += volume;
  }
  EXPECT_EQ(sum, world.outer_volume6());

  Report report;
  report.begin(GetParam(), GetParam());
  Checker checker(world, place.get(), report);
  Rng rng(91);
  Motions motions(world, rng);
  const ScenePtr scene = make_scene(place.get());
  // A wall between the first two regions, and some faces at random.
  if (!place.mesh.regions.empty()) {
    size_t between = 0, marked = 0;
    for (Face& f : world.faces) {
      if (f.cell[1] < 0) continue;
      const int a = place.mesh.regions[static_cast<size_t>(f.cell[0])],
                b = place.mesh.regions[static_cast<size_t>(f.cell[1])];
      if (std::min(a, b) != 1 || std::max(a, b) != 2) continue;
      f.marked = true;
      ++between;
    }
    ASSERT_EQ(dsw_environment_mark_between(place.get(), 1, 2, DSW_MARK_IMPASSABLE, &marked), DSW_STATUS_OK);
    EXPECT_EQ(marked, between);
  }
  for (size_t f = rng.below(40u); f < world.faces.size(); f += 40) {
    world.faces[f].marked = true;
    const dsw_face_id id = face_id(world, static_cast<int>(f));
    ASSERT_EQ(dsw_environment_mark_faces(place.get(), &id, 1, DSW_MARK_IMPASSABLE), DSW_STATUS_OK);
  }
  const double margin = 1e-6 * world.size;
  const int rounds = world.triangles.size() > 200000 ? 250 : 600;
  for (int i = 0; i < rounds; ++i) {
    const Vec p = rng.chance(0.5) ? motions.start() : motions.site();
    dsw_volume_id found;
    dsw_location where;
    ASSERT_EQ(dsw_environment_locate(place.get(), p.data(), {0, 0}, &found, &where), DSW_STATUS_OK);
    if (where == DSW_LOCATION_OUTSIDE) continue;
    ASSERT_TRUE(world.contains(static_cast<int>(found.index), world.body(p.data()))) << hex(p) << " in " << found.index;
    Vec q = motions.target(p);
    if (rng.chance(0.8) && std::fabs(q[0]) < 1e10 && std::fabs(q[1]) < 1e10 && std::fabs(q[2]) < 1e10) {
      for (size_t k = 0; k < 3; ++k) q[k] = p[k] + 0.125 * (q[k] - p[k]);
    }
    world.restrict_to(world.near_segment(p.data(), q.data(), margin));
    checker.free_cast(p, q, static_cast<Checker::Way>(rng.below(4)), rng.chance(0.5) ? found : dsw_volume_id{0, 0},
                      rng.chance(0.5), rng.chance(0.1) ? 3 : 0, static_cast<int>(found.index));
    if (i % 3 == 0) {
      dsw_particle_id particle;
      ASSERT_EQ(dsw_particle_create(scene.get(), p.data(), found, &particle), DSW_STATUS_OK);
      checker.move(scene.get(), particle, q, 0, false);
      ASSERT_EQ(dsw_particle_destroy(scene.get(), particle), DSW_STATUS_OK);
    }
  }
  EXPECT_EQ(report.total.mismatches, 0u);
  EXPECT_EQ(report.total.lost, 0u);
  EXPECT_GT(report.total.casts, 100u);
}

}  // namespace
}  // namespace dsw::oracle
