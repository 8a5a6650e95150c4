// Traces: what is drawn, how it is turned, and that an addition that runs out of memory adds nothing.

#include "snapshot/trace.h"

#include <gtest/gtest.h>

#include <new>
#include <tuple>
#include <vector>

#include "../../aligned_memory.h"
#include "environment/marking.h"
#include "environment/moving.h"
#include "locate/locate.h"
#include "map/dart.h"
#include "small_meshes.h"

namespace {

using namespace dsw;
using namespace dsw::testing_meshes;

/** Everything fits together; returns the volume enclosed by the triangles with a label. */
double checked_volume(const Trace& trace, uint32_t label) {
  EXPECT_EQ(trace.points.size() % 3, 0u);
  EXPECT_EQ(trace.vertices.size(), trace.vertex_labels.size());
  EXPECT_EQ(trace.segments.size(), 2 * trace.segment_labels.size());
  EXPECT_EQ(trace.triangles.size(), 3 * trace.triangle_labels.size());
  for (const auto* indices : {&trace.vertices, &trace.segments, &trace.triangles}) {
    for (const uint32_t i : *indices) EXPECT_LT(i, trace.point_count());
  }
  double volume = 0;
  for (size_t t = 0; t < trace.triangle_labels.size(); ++t) {
    if (trace.triangle_labels[t] != label) continue;
    const double* p[3];
    for (size_t k = 0; k < 3; ++k) p[k] = trace.points.data() + 3 * trace.triangles[3 * t + k];
    const double cross[3] = {p[1][1] * p[2][2] - p[1][2] * p[2][1], p[1][2] * p[2][0] - p[1][0] * p[2][2],
                             p[1][0] * p[2][1] - p[1][1] * p[2][0]};
    volume += (p[0][0] * cross[0] + p[0][1] * cross[1] + p[0][2] * cross[2]) / 6;
  }
  return volume;
}

TEST(Trace, CellsAreClosedAndTurnedOutwards) {
  for (const SmallMesh& mesh : small_meshes()) {
    Environment<3> env(nullptr);
    build_mesh(env, mesh);
    Trace trace(nullptr);
    double total = 0;
    for (uint32_t i = 0; i < env.map.cell_count; ++i) {
      const Cell c = env.map.cell(i);
      add_cells(trace, env, &c, 1, i);
      const double volume = checked_volume(trace, i);
      EXPECT_GT(volume, 0) << mesh.name << " cell " << i;
      total += volume;
    }
    add_impassable(trace, env, true, 1u << 20);
    EXPECT_NEAR(checked_volume(trace, 1u << 20), total, 1e-9) << "the outer boundary encloses all cells";
    clear(trace);
    EXPECT_EQ(checked_volume(trace, 0), 0);
    EXPECT_EQ(trace.point_count(), 0u);
    add_cells(trace, env, nullptr, 0, 3);
    EXPECT_EQ(trace.triangle_labels.size(), 0u);
  }
}

HalfFacet facet_between(const Map<3>& map, Cell a, Cell b) {
  for (uint32_t f = 0; f < map.facets_of(a); ++f) {
    const HalfFacet h = map.half_facet(a, f), o = map.opposite(h);
    if (o.valid() && map.cell_of(o) == b) return h;
  }
  return {};
}

TEST(Trace, ImpassableIsDrawnWhereSomethingPassableIsNear) {
  Environment<3> env(nullptr);
  build_mesh(env, pair_of(kHexahedron, kHexahedron));
  const Map<3>& map = env.map;
  const Cell left = map.cell(0), right = map.cell(1);
  Trace trace(nullptr);
  add_impassable(trace, env, false, 1);
  EXPECT_EQ(trace.triangle_labels.size(), 0u);
  EXPECT_EQ(trace.point_count(), 0u);

  // A marked facet between two passable cells: once, turned out of the lower cell; its points are shared.
  const HalfFacet between = facet_between(map, left, right);
  set_facet_mark(env, map.opposite(between), true);
  add_impassable(trace, env, false, 2);
  EXPECT_EQ(trace.triangle_labels.size(), 2u);
  EXPECT_EQ(trace.point_count(), 4u);
  EXPECT_NEAR(checked_volume(trace, 2), 1.0 / 3, 1e-15) << "the face x = 1 with its normal along +x";

  // A marked cell: from the passable side, with or without the facet's own mark.
  for (const bool marked : {true, false}) {
    set_facet_mark(env, between, marked);
    set_cell_mark(env, left, true);
    clear(trace);
    add_impassable(trace, env, false, 3);
    EXPECT_NEAR(checked_volume(trace, 3), -1.0 / 3, 1e-15) << "out of the right cell";
    EXPECT_EQ(trace.triangle_labels.size(), 2u);
    add_impassable(trace, env, true, 4);
    EXPECT_NEAR(checked_volume(trace, 4), 1, 1e-12) << "the right cell alone";
    set_cell_mark(env, left, false);
  }
  // A mark on the outer boundary is part of the outer boundary.
  clear(trace);
  for (uint32_t f = 0; f < map.facets_of(left); ++f) set_facet_mark(env, map.half_facet(left, f), true);
  add_impassable(trace, env, false, 5);
  EXPECT_EQ(trace.triangle_labels.size(), 2u);

  // Two impassable cells have nothing to show.
  clear(trace);
  set_cell_mark(env, left, true);
  set_cell_mark(env, right, true);
  add_impassable(trace, env, true, 6);
  EXPECT_EQ(trace.point_count(), 0u);
}

/** A cell that its points have turned over counts as impassable: its walls to nothing else are none of what can be met, and its
 * facets to passable cells are. */
TEST(Trace, AnInvalidCellIsImpassable) {
  Environment<3> env(nullptr);
  build_mesh(env, pair_of(kHexahedron, kHexahedron));
  let_points_move(env);
  const size_t count = 3 * size_t{env.map.vertex_count};
  std::vector<double> points(env.points, env.points + count);
  env.points = points.data();
  for (const bool is_turned : {false, true, false}) {
    for (size_t k = 0; k < count; k += 3) {
      if (points[k] != 0 && points[k] != 1) points[k] = is_turned ? 0.5 : 2;
    }
    env.note_move();
    env.checked.forget_all();
    ASSERT_EQ(admits(env, env.map.cell(1)), !is_turned);
    Trace trace(nullptr);
    add_impassable(trace, env, false, 1);
    EXPECT_EQ(trace.triangle_labels.size(), is_turned ? 2u : 0u);
    EXPECT_NEAR(checked_volume(trace, 1), is_turned ? 1.0 / 3 : 0, 1e-15) << "the face x = 1 with its normal along +x";
    add_impassable(trace, env, true, 2);
    EXPECT_NEAR(checked_volume(trace, 2), is_turned ? 1 : 2, 1e-12) << "the passable cells";
  }
}

TEST(Trace, MarkedEdgesAndVerticesOnce) {
  Environment<3> env(nullptr);
  build_mesh(env, lattice(2, kHexahedron));
  reserve_edge_marks(env, 3);
  reserve_vertex_marks(env);
  set_edge_mark(env, 13, 14, true);  // from the middle: four cells
  set_edge_mark(env, 0, 1, true);    // of cell 0 alone
  set_vertex_mark(env, 13, true);
  set_vertex_mark(env, 0, true);
  Trace trace(nullptr);
  add_impassable(trace, env, false, 9);
  EXPECT_EQ(trace.segment_labels, Array<uint32_t>(2, 9));
  EXPECT_EQ(trace.vertex_labels, Array<uint32_t>(2, 9));
  EXPECT_EQ(trace.point_count(), 4u);
  EXPECT_EQ(checked_volume(trace, 9), 0);
  const double* dot = trace.points.data() + 3 * trace.vertices[1];
  EXPECT_EQ(std::make_tuple(dot[0], dot[1], dot[2]), std::make_tuple(1.0, 1.0, 1.0));
  set_cell_mark(env, env.map.cell(0), true);
  clear(trace);
  add_impassable(trace, env, false, 9);
  EXPECT_EQ(trace.segment_labels.size(), 1u) << "the other marked edge borders nothing passable";
  EXPECT_EQ(trace.vertex_labels.size(), 1u);
}

TEST(Trace, AWalkIsDotsPiecesAndItsContact) {
  Environment<3> env(nullptr);
  build_mesh(env, pair_of(kHexahedron, kHexahedron));
  Trace trace(nullptr);
  const double from[3] = {0.5, 0.5, 0.25}, to[3] = {2.5, 0.5, 0.25}, near[3] = {1.5, 0.5, 0.25};
  SegmentOptions options;
  options.detail = false;  // a trace needs it all the same
  add_walk(trace, env, {0, 0}, from, to, options, 0.125, 4);
  checked_volume(trace, 4);
  EXPECT_EQ(trace.vertex_labels, Array<uint32_t>(3, 4));
  EXPECT_EQ(trace.segment_labels, Array<uint32_t>(3, 4));
  ASSERT_EQ(trace.point_count(), 5u);
  const double x[] = {0.5, 1, 2, 2, 1.875};
  for (size_t i = 0; i < 5; ++i) {
    EXPECT_DOUBLE_EQ(trace.points[3 * i], x[i]);
    EXPECT_EQ(trace.points[3 * i + 1], 0.5);
    EXPECT_EQ(trace.points[3 * i + 2], 0.25);
  }
  clear(trace);
  add_walk(trace, env, {0, 0}, from, near, options, 1, 4);
  EXPECT_EQ(trace.vertices.size(), 2u);
  EXPECT_EQ(trace.segment_labels.size(), 2u);
  EXPECT_EQ(trace.points[6], 1.5);

  clear(trace);
  const double outside[3] = {-1, 0, 0};
  add_walk(trace, env, {0, 0}, outside, to, options, 1, 4);
  set_cell_mark(env, env.map.cell(0), true);
  add_walk(trace, env, {0, 0}, from, to, options, 1, 4);
  EXPECT_EQ(trace.point_count(), 0u) << "a walk that cannot start";
}

TEST(Trace, ContactsOnly) {
  Trace trace(nullptr);
  dsw_flight flight{};
  for (const dsw_outcome outcome :
       {DSW_OUTCOME_NONE, DSW_OUTCOME_REACHED, DSW_OUTCOME_WORK_LIMIT, DSW_OUTCOME_OUTSIDE}) {
    flight.outcome = outcome;
    add_contact(trace, flight, 1, 1);
  }
  EXPECT_EQ(trace.point_count(), 0u);
  flight.outcome = DSW_OUTCOME_CONTACT;
  flight.position[2] = 5;
  flight.contact.normal[0] = -1;
  add_contact(trace, flight, 0.5, 77);
  EXPECT_EQ(trace.points, Array<double>({0, 0, 5, -0.5, 0, 5}));
  EXPECT_EQ(trace.vertices, Array<uint32_t>({0}));
  EXPECT_EQ(trace.segments, Array<uint32_t>({0, 1}));
  EXPECT_EQ(trace.vertex_labels, Array<uint32_t>({77}));
  EXPECT_EQ(trace.segment_labels, Array<uint32_t>({77}));
}

/** Refuses memory after a number of allocations. */
struct Short {
  size_t left = SIZE_MAX;
  Memory memory{this, allocate, release};
  static void* allocate(void* user, size_t size, size_t alignment) {
    Short& s = *static_cast<Short*>(user);
    if (s.left == 0) return nullptr;
    --s.left;
    return allocate_aligned(size, alignment);
  }
  static void release(void*, void* block, size_t, size_t alignment) { release_aligned(block, alignment); }
};

TEST(Trace, AnAdditionWithoutMemoryAddsNothing) {
  Short source;
  Environment<3> env(&source.memory);
  build_mesh(env, lattice(2, kHexahedron));
  reserve_edge_marks(env, 1);
  reserve_vertex_marks(env);
  set_edge_mark(env, 0, 1, true);
  set_vertex_mark(env, 5, true);
  const double from[3] = {0.5, 0.5, 0.5}, to[3] = {9, 1.25, 0.5};
  const auto add = [&](Trace& trace, int what) {
    const Cell cells[2] = {env.map.cell(0), env.map.cell(3)};
    if (what == 0) add_cells(trace, env, cells, 2, 1);
    if (what == 1) add_impassable(trace, env, true, 1);
    if (what == 2) add_walk(trace, env, {0, 0}, from, to, {}, 1, 1);
  };
  for (int what = 0; what < 3; ++what) {
    size_t refusals = 0;
    for (size_t left = 0;; ++left, ++refusals) {
      ASSERT_LT(left, 1000u);
      Trace trace(&source.memory);
      source.left = SIZE_MAX;
      add(trace, 2);
      const size_t points = trace.point_count(), dots = trace.vertex_labels.size(),
                   segments = trace.segment_labels.size();
      source.left = left;
      bool added = false;
      try {
        add(trace, what);
        added = true;
      } catch (const std::bad_alloc&) {
      }
      source.left = SIZE_MAX;
      checked_volume(trace, 1);
      if (added) break;
      EXPECT_EQ(trace.point_count(), points);
      EXPECT_EQ(trace.vertex_labels.size(), dots);
      EXPECT_EQ(trace.segment_labels.size(), segments);
      EXPECT_EQ(trace.triangle_labels.size(), 0u);
    }
    EXPECT_GT(refusals, 2u);
  }
}

}  // namespace
