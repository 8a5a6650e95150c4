// Which lives there are: grounds of both dimensions, and what happens in them.
#include "life.h"

namespace dsw::portable {
namespace {

using Acts = std::vector<Act>;

const Acts kFlights = {{&Life::move_particle, 20},      {&Life::move_particles, 4},   {&Life::create_particles, 3},
                       {&Life::cast_from_particles, 2}, {&Life::destroy_particle, 1}, {&Life::mark, 1}};
const Acts kWalks = {{&Life::move_body, 40}, {&Life::destroy_body, 1}};
const Acts kCrowds = {{&Life::move_body, 10}, {&Life::move_bodies, 4}, {&Life::destroy_body, 1}};
const Acts kTurns = {{&Life::move_rigidly, 20}, {&Life::move_body, 2}, {&Life::destroy_body, 1}};
const Acts kThick = {
    {&Life::move_body, 20}, {&Life::move_bodies, 3}, {&Life::change_radius, 2}, {&Life::destroy_body, 1}};
const Acts kBends = {{&Life::bend, 6}, {&Life::move_body, 4}, {&Life::move_particles, 1}, {&Life::create_particles, 1}};
const Acts kThickBends = {{&Life::bend, 4}, {&Life::move_body, 4}, {&Life::change_radius, 1}};
const Acts kTogether = {{&Life::move_together, 10}, {&Life::move_body, 1}, {&Life::destroy_body, 1}};
const Acts kBendsTogether = {{&Life::bend_together, 6}, {&Life::move_together, 4}, {&Life::create_particles, 1}};
const Acts kMarks = {{&Life::mark, 8}, {&Life::move_body, 4}, {&Life::move_particles, 1}, {&Life::create_particles, 2}};
const Acts kCuts = {
    {&Life::cut, 3}, {&Life::open, 2}, {&Life::move_body, 6}, {&Life::move_particles, 2}, {&Life::create_particles, 1}};
const Acts kCarvings = {{&Life::carve, 3},          {&Life::tie, 2},
                        {&Life::detach, 3},         {&Life::move_body, 10},
                        {&Life::move_particles, 2}, {&Life::create_particles, 1}};
const Acts kCalls = {{&Life::call, 1}};
const Acts kEdits = {{&Life::call, 4}, {&Life::move_body, 2}, {&Life::create_particles, 1}, {&Life::move_particles, 1}};
const Acts kSplits = {{&Life::split_volume, 2},     {&Life::split_edge, 3},     {&Life::sew, 2}, {&Life::move_body, 3},
                      {&Life::create_particles, 1}, {&Life::move_particles, 1}, {&Life::call, 1}};
const Acts kBentCalls = {{&Life::call, 6}, {&Life::bend, 1}};

// Calls of the fuzzer, see Calls::make.
constexpr uint32_t kTopology = 7, kSurgery = 18, kParticles = 26, kBodyEdits = 38, kMoves = 46;

constexpr uint32_t kPairs = DSW_FEATURE_BODY_CONTACTS;
constexpr uint32_t kDeforms = DSW_FEATURE_DEFORMING;
constexpr uint32_t kCounts = DSW_FEATURE_STATISTICS | DSW_FEATURE_CROSSINGS;
constexpr uint32_t kLive = DSW_FEATURE_LIVE_CHANGES;
constexpr uint32_t kSelf = DSW_BODY_SELF_CONTACTS;
constexpr uint32_t kRigid = DSW_BODY_RIGID;

constexpr auto kWire = Shape::kWire, kRing = Shape::kRing, kCloth = Shape::kCloth, kSolid = Shape::kSolid;

}  // namespace

const std::vector<LifeKind>& life_kinds() {
  // Name, ground, unit, marked share, features, bodies (shape, count, level, flags, radius), acts, how many.
  static const std::vector<LifeKind> all = {
      {"space_particles_hex", {"hall", 3}, 1, 0.1, kCounts, {}, &kFlights, 10000},
      {"space_particles_tet", {"tet_random", 3}, 1, 0.1, kCounts, {}, &kFlights, 9000},
      {"space_particles_voronoi", {"voronoi", 3}, 1, 0.1, kCounts, {}, &kFlights, 3000},
      {"space_particles_huge", {"mixed_warped", 3}, 1e100, 0.1, kCounts, {}, &kFlights, 3000},
      {"space_particles_tiny", {"hex_warped", 3}, 0x1p-1000, 0.1, kCounts, {}, &kFlights, 1500},
      {"plane_particles_triangles", {"triangles", 2}, 1, 0.1, kCounts, {}, &kFlights, 22000},
      {"space_walk_tube", {"tube", 3}, 1, 0.02, 0, {kWire, 3, 3}, &kWalks, 1000},
      {"space_walk_lattice", {"hex", 3}, 1, 0.05, 0, {kWire, 3, 0}, &kWalks, 8000},
      {"space_walk_tet", {"tet_lattice", 3}, 1, 0.05, 0, {kCloth, 3, 0}, &kWalks, 300},
      {"space_walk_tiny", {"prisms_warped", 3}, 1e-100, 0.05, 0, {kRing, 3, 0}, &kWalks, 100},
      {"plane_walk_voronoi", {"voronoi", 2}, 1, 0.05, 0, {kWire, 3, 0}, &kWalks, 4000},
      {"space_rigid_polyhedra", {"polyhedra", 3}, 1, 0.02, 0, {kSolid, 3, 4, kRigid}, &kTurns, 1000},
      {"plane_rigid_wide", {"wide", 2}, 1, 0.02, 0, {kRing, 3, 3, kRigid}, &kTurns, 3000},
      {"space_thick_wire", {"tube", 3}, 1, 0.01, 0, {kWire, 2, 3, 0, 0.05}, &kThick, 250},
      {"space_thick_pairs", {"hall", 3}, 1, 0.01, kPairs, {kRing, 5, 4, 0, 0.04}, &kThick, 80},
      {"plane_thick_pairs", {"quads_flat", 2}, 1, 0.01, kPairs, {kRing, 4, 3, 0, 0.04}, &kThick, 150},
      {"space_pairs_cloth", {"hex", 3}, 1, 0, kPairs, {kCloth, 6, 4}, &kCrowds, 200},
      {"space_pairs_wires", {"tet_kuhn", 3}, 1, 0.02, kPairs, {kWire, 5, 3}, &kCrowds, 1000},
      {"plane_pairs_wires", {"quads", 2}, 1, 0.02, kPairs, {kWire, 5, 3}, &kCrowds, 2500},
      {"space_self_wire", {"hall", 3}, 1, 0, kPairs, {kWire, 2, 3, kSelf}, &kCrowds, 1500},
      {"space_self_cloth", {"pyramids", 3}, 1, 0, kPairs, {kCloth, 3, 4, kSelf}, &kCrowds, 60},
      {"plane_self_wire", {"polygons", 2}, 1, 0, kPairs, {kWire, 2, 3, kSelf}, &kCrowds, 2000},
      {"space_deform_hex", {"hex", 3}, 1, 0.05, kDeforms, {kWire, 3, 3}, &kBends, 300},
      {"space_deform_tet", {"tet_random", 3}, 1, 0.05, kDeforms | kLive, {kCloth, 2, 4}, &kBends, 150},
      {"space_deform_rigid", {"hex", 3}, 1, 0, kDeforms, {kSolid, 3, 4, kRigid}, &kBends, 150},
      {"space_deform_thick", {"hex", 3}, 1, 0.02, kDeforms, {kWire, 1, 3, 0, 0.03}, &kThickBends, 150},
      {"space_deform_remesh", {"tet_kuhn", 3}, 1, 0.2, kDeforms, {kRing, 2, 3}, &kBends, 500},
      {"plane_deform_quads", {"quads_flat", 2}, 1, 0.05, kDeforms, {kWire, 3, 3}, &kBends, 1000},
      {"space_marks_hex", {"hall", 3}, 1, 0.1, kLive, {kRing, 4, 4}, &kMarks, 700},
      {"plane_marks_joined", {"joined", 2}, 1, 0.1, kLive, {kRing, 4, 3}, &kMarks, 3000},
      {"space_cuts_hex", {"hall", 3}, 1, 0.05, 0, {kWire, 3, 3}, &kCuts, 400},
      {"space_cuts_tet", {"tet_random", 3}, 1, 0.05, kLive, {kCloth, 2, 4}, &kCuts, 200},
      {"space_carve_hex", {"hex", 3}, 1, 0.2, 0, {kWire, 2, 3}, &kCarvings, 800},
      {"space_carve_tet", {"tet_kuhn", 3}, 1, 0.2, kLive, {kSolid, 2, 4}, &kCarvings, 500},
      {"space_topology_mixed", {"mixed", 3}, 1, 0.05, 0, {kRing, 3, 3}, &kEdits, 800, kTopology, kSurgery},
      {"space_splits_hex", {"hex_sheared", 3}, 1, 0.02, 0, {kRing, 3, 3}, &kSplits, 800, kTopology, kSurgery},
      {"space_splits_tet", {"tet_lattice", 3}, 1, 0.02, kLive, {kCloth, 3, 4}, &kSplits, 800, kTopology, kSurgery},
      {"plane_splits_polygons", {"polygons", 2}, 1, 0.02, 0, {kRing, 3, 3}, &kSplits, 800, kTopology, kSurgery},
      {"plane_topology_delaunay",
       {"triangles_lattice", 2},
       1,
       0.05,
       0,
       {kRing, 3, 3},
       &kEdits,
       2000,
       kTopology,
       kSurgery},
      {"space_remesh_pyramids",
       {"pyramids", 3},
       1,
       0.05,
       kDeforms,
       {kRing, 2, 3},
       &kBentCalls,
       800,
       kSurgery,
       kParticles},
      {"space_edits_hex", {"hex_warped", 3}, 1, 0.05, kPairs, {kCloth, 3, 0}, &kEdits, 1500, kBodyEdits, kMoves},
      {"plane_edits_cut", {"cut", 2}, 1, 0.05, kPairs, {kRing, 3, 0}, &kEdits, 3000, kBodyEdits, kMoves},
      {"space_calls_hex", {"hex_warped_lattice", 3}, 1, 0.05, kDeforms | kPairs | kCounts, {}, &kCalls, 6000},
      {"space_calls_prisms", {"prisms", 3}, 1, 0.05, kDeforms | kLive, {}, &kCalls, 6000},
      {"space_calls_polyhedra", {"polyhedra_merged", 3}, 1, 0.05, kPairs | kLive, {}, &kCalls, 6000},
      {"space_calls_voronoi", {"voronoi", 3}, 1, 0.05, kDeforms | kPairs | kLive, {}, &kCalls, 4000},
      {"plane_calls_quads", {"quads_warped", 2}, 1, 0.05, kDeforms | kPairs | kCounts, {}, &kCalls, 6000},
      {"plane_calls_triangles", {"triangles_irrational", 2}, 1, 0.05, kPairs | kLive, {}, &kCalls, 6000},
      {"space_together_wires", {"tet_kuhn", 3}, 1, 0.02, kPairs, {kWire, 5, 0, kSelf}, &kTogether, 300},
      {"space_together_cloth", {"hall", 3}, 1, 0.02, kPairs, {kCloth, 4, 4}, &kTogether, 100},
      {"plane_together_wires", {"quads", 2}, 1, 0.02, kPairs, {kWire, 5, 0, kSelf, 0.02}, &kTogether, 1000},
      {"space_together_walls", {"hex", 3}, 1, 0.05, kDeforms | kPairs, {kWire, 3, 0, 0, 0.02}, &kBendsTogether, 150},
      {"plane_together_walls", {"quads_flat", 2}, 1, 0.05, kDeforms | kPairs, {kRing, 3, 3}, &kBendsTogether, 500},
  };
  return all;
}

}  // namespace dsw::portable
