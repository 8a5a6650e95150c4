// Operations of the plane one layer below the interface: what polygons become, and what is refused.
#include <gtest/gtest.h>

#include "base/error.h"
#include "environment/marking.h"
#include "environment/test_mesh.h"
#include "map/integrity.h"
#include "topology/operations.h"

namespace {

using namespace dsw;
using namespace dsw::test;

/** A lattice of squares; vertex x + (nx + 1) y is at (x, y). */
std::unique_ptr<Environment<2>> squares(int nx, int ny) {
  Mesh2 mesh;
  add_squares(mesh, nx, ny);
  return mesh.build();
}

/** The corners of a polygon, beginning with the lowest. */
std::vector<uint32_t> corners(const Map<2>& map, Cell c) {
  std::vector<uint32_t> out;
  for (uint32_t k = 0; k < map.vertices_of(c); ++k) out.push_back(map.vertex(c, k));
  std::rotate(out.begin(), std::min_element(out.begin(), out.end()), out.end());
  return out;
}

Dart side(const Map<2>& map, uint32_t cell, uint32_t from, uint32_t to) {
  const Cell c = map.cell(cell);
  uint32_t d = 0;
  while (dart_vertex(map, {c, d}) != from || dart_target(map, {c, d}) != to) ++d;
  return {c, d};
}

/** Writes an edit with `write` and carries it out; what came of it in the order of its drafts. */
template <class Write>
std::vector<Cell> change(Environment<2>& env, Write write) {
  Edit<2> edit(env);
  write(edit);
  edit.prepare();
  edit.apply();
  edit.finish();
  EXPECT_EQ(check_integrity(env.map), nullptr);
  std::vector<Cell> cells;
  for (size_t i = 0; i < edit.cell_count(); ++i) cells.push_back(edit.cell(i));
  return cells;
}

template <class Write>
dsw_status status_of(Environment<2>& env, Write write) {
  const Array<uint32_t> words = env.map.words;
  try {
    Edit<2> edit(env);
    write(edit);
    edit.prepare();
    return DSW_STATUS_OK;
  } catch (const Error& error) {
    EXPECT_TRUE(env.map.words == words);
    return error.status();
  }
}

TEST(PlaneEdit, ASideGetsAVertexInBothOfItsPolygons) {
  const auto env = squares(2, 1);
  const Map<2>& map = env->map;
  set_facet_mark(*env, half_facet(map, side(map, 0, 1, 4)), true);
  uint32_t middle = 0;
  const auto cells = change(*env, [&](Edit<2>& edit) { middle = split_edge(edit, side(map, 1, 4, 1), 0.25); });
  EXPECT_EQ(middle, 6u);
  EXPECT_EQ(env->point(middle)[0], 1.0);
  EXPECT_EQ(env->point(middle)[1], 0.75);
  EXPECT_EQ(corners(map, cells[0]), (std::vector<uint32_t>{1, 2, 5, 4, 6}));  // draft 0 is that of the side's polygon
  EXPECT_EQ(corners(map, cells[1]), (std::vector<uint32_t>{0, 1, 6, 4, 3}));
  EXPECT_EQ(map.facet_count, 8u);
  EXPECT_EQ(env->marked_facets, 2u);
  for (const auto& [from, to] : {std::pair<uint32_t, uint32_t>{4, 6}, {6, 1}}) {
    const HalfFacet h = half_facet(map, side(map, 1, from, to));
    EXPECT_TRUE(map.facet_marked(h));
    EXPECT_EQ(map.cell_of(map.opposite(h)), map.cell(0));
  }
  EXPECT_TRUE(map.convex(cells[0]));
}

TEST(PlaneEdit, TwoSidesBecomeOneWhereAVertexGoes) {
  const auto env = squares(2, 1);
  const Map<2>& map = env->map;
  change(*env, [&](Edit<2>& edit) { split_edge(edit, side(map, 0, 1, 4), 0.5); });
  change(*env, [&](Edit<2>& edit) {
    const MergedEdge ends = merge_edges(edit, side(map, 1, 6, 1), 6);
    EXPECT_EQ(ends.a, 4u);
    EXPECT_EQ(ends.b, 1u);
  });
  EXPECT_EQ(corners(map, map.cell(0)), (std::vector<uint32_t>{0, 1, 4, 3}));
  EXPECT_EQ(corners(map, map.cell(1)), (std::vector<uint32_t>{1, 2, 5, 4}));
  EXPECT_EQ(map.form(map.cell(0)), Form::kBox);
  EXPECT_FALSE(map.is_vertex_alive(6, 1));
  EXPECT_EQ(map.facet_count, 7u);
}

TEST(PlaneEdit, AVertexOfOnePolygonGoesWithItsCorner) {
  const auto env = squares(1, 1);
  const Map<2>& map = env->map;
  const auto cells = change(*env, [&](Edit<2>& edit) { merge_edges(edit, side(map, 0, 0, 1), 0); });
  EXPECT_EQ(corners(map, cells[0]), (std::vector<uint32_t>{1, 3, 2}));
  EXPECT_EQ(map.form(cells[0]), Form::kSimplex);
  EXPECT_EQ(map.boundary_facet_count, 3u);
  // A triangle that lost a corner would leave nothing.
  EXPECT_EQ(status_of(*env, [&](Edit<2>& edit) { merge_edges(edit, side(map, 0, 1, 3), 1); }), DSW_STATUS_BAD_TOPOLOGY);
}

TEST(PlaneEdit, VerticesAndSidesThatCannotMergeAreRefused) {
  const auto env = squares(2, 2);
  const Map<2>& map = env->map;
  const auto merge = [&](Dart d, uint32_t vertex) {
    return status_of(*env, [&](Edit<2>& edit) { merge_edges(edit, d, vertex); });
  };
  EXPECT_EQ(merge(side(map, 0, 0, 1), 4), DSW_STATUS_BAD_TOPOLOGY);  // no end of it
  EXPECT_EQ(merge(side(map, 0, 0, 1), 1), DSW_STATUS_BAD_TOPOLOGY);  // three sides, on the outer boundary
  EXPECT_EQ(merge(side(map, 0, 1, 4), 1), DSW_STATUS_BAD_TOPOLOGY);
  EXPECT_EQ(merge(side(map, 0, 1, 4), 4), DSW_STATUS_BAD_TOPOLOGY);  // four
  set_facet_mark(*env, half_facet(map, side(map, 0, 0, 1)), true);
  EXPECT_EQ(merge(side(map, 0, 0, 1), 0), DSW_STATUS_BAD_TOPOLOGY);  // one is marked, the other is not
  set_facet_mark(*env, half_facet(map, side(map, 0, 3, 0)), true);
  EXPECT_EQ(merge(side(map, 0, 0, 1), 0), DSW_STATUS_OK);
  EXPECT_EQ(status_of(*env,
                      [&](Edit<2>& edit) {
                        const uint32_t joined[2] = {0, 1};
                        split_cell(edit, map.cell(0), joined, 2);
                      }),
            DSW_STATUS_BAD_TOPOLOGY);
  for (const size_t count : {size_t{1}, size_t{3}}) {
    EXPECT_EQ(status_of(*env,
                        [&](Edit<2>& edit) {
                          const uint32_t loop[3] = {0, 4, 1};
                          split_cell(edit, map.cell(0), loop, count);
                        }),
              DSW_STATUS_BAD_TOPOLOGY);
  }
}

TEST(PlaneEdit, APolygonIsSplitLeftAndRightOfItsNewSide) {
  const auto env = squares(1, 1);
  const Map<2>& map = env->map;
  Edit<2> edit(*env);
  const uint32_t ends[2] = {0, 3};
  const SplitCell split = split_cell(edit, map.cell(0), ends, 2);
  edit.prepare();
  edit.apply();
  edit.finish();
  EXPECT_EQ(corners(map, edit.cell(split.left)), (std::vector<uint32_t>{0, 3, 2}));
  EXPECT_EQ(corners(map, edit.cell(split.right)), (std::vector<uint32_t>{0, 1, 3}));
  EXPECT_EQ(map.index(edit.cell(split.left)), 0u);
  const HalfFacet left = edit.half_facet(split.left, split.left_facet);
  EXPECT_EQ(map.opposite(left), edit.half_facet(split.right, split.right_facet));
  EXPECT_EQ(left, half_facet(map, side(map, 0, 0, 3)));
  EXPECT_EQ(check_integrity(map), nullptr);
}

TEST(PlaneEdit, PolygonsThatShareAChainLoseAllOfIt) {
  const auto env = squares(2, 1);
  const Map<2>& map = env->map;
  change(*env, [&](Edit<2>& edit) { split_edge(edit, side(map, 0, 1, 4), 0.5); });
  const auto cells = change(*env, [&](Edit<2>& edit) { merge_cells(edit, half_facet(map, side(map, 0, 1, 6))); });
  EXPECT_EQ(corners(map, cells[0]), (std::vector<uint32_t>{0, 1, 2, 5, 4, 3}));
  EXPECT_FALSE(map.is_vertex_alive(6, 1));
  EXPECT_EQ(map.cell_count, 1u);
}

TEST(PlaneEdit, PolygonsThatWouldCloseARingAreRefused) {
  // Two angles round a square hole, 4 .. 7, that touch each other in two places.
  Mesh2 mesh;
  for (const double low : {-10., 1.}) {
    const double high = 3 - low;
    for (const auto& p : {std::pair<double, double>{low, low}, {high, low}, {high, high}, {low, high}}) {
      mesh.point({p.first, p.second});
    }
  }
  for (int64_t k = 0; k < 4; ++k) mesh.cell(kQuad, {k, (k + 1) % 4, 4 + (k + 1) % 4, 4 + k});
  const auto env = mesh.build();
  const Map<2>& map = env->map;
  const auto merge = [&](uint32_t cell, uint32_t from, uint32_t to) {
    return [&map, cell, from, to](Edit<2>& edit) { merge_cells(edit, half_facet(map, side(map, cell, from, to))); };
  };
  change(*env, merge(0, 1, 5));
  change(*env, merge(2, 3, 7));
  EXPECT_EQ(map.cell_count, 2u);
  EXPECT_EQ(status_of(*env, merge(0, 4, 0)), DSW_STATUS_BAD_CELL);
}

TEST(PlaneEdit, PolygonsThatAreNoStarsAreRefused) {
  // An angle whose long arm holds most of its corners: their mean does not see the end of the short one.
  const auto env = squares(3, 2);
  const Map<2>& map = env->map;
  const auto merge = [&map](uint32_t from, uint32_t to) {
    return [&map, from, to](Edit<2>& edit) { merge_cells(edit, half_facet(map, side(map, 0, from, to))); };
  };
  change(*env, merge(1, 5));
  change(*env, merge(2, 6));
  EXPECT_EQ(status_of(*env, merge(5, 4)), DSW_STATUS_INVALID_CELL);
}

TEST(PlaneEdit, ACollapsedSideTakesItsTrianglesAlong) {
  // Four triangles round a centre, 4; one of their outer sides is marked.
  Mesh2 mesh;
  for (const auto& p : {std::pair<double, double>{0, 0}, {4, 0}, {4, 4}, {0, 4}, {2, 1}})
    mesh.point({p.first, p.second});
  for (int64_t k = 0; k < 4; ++k) mesh.cell(kTriangle, {k, (k + 1) % 4, 4});
  const auto env = mesh.build();
  const Map<2>& map = env->map;
  set_facet_mark(*env, half_facet(map, side(map, 0, 4, 0)), true);
  // The outer boundary would change.
  EXPECT_EQ(status_of(*env, [&](Edit<2>& edit) { collapse_edge(edit, side(map, 0, 4, 0), 0); }),
            DSW_STATUS_BAD_TOPOLOGY);
  const auto cells = change(*env, [&](Edit<2>& edit) { collapse_edge(edit, side(map, 0, 1, 4), 4); });
  ASSERT_EQ(cells.size(), 2u);
  EXPECT_EQ(corners(map, cells[0]), (std::vector<uint32_t>{0, 1, 3}));
  EXPECT_EQ(corners(map, cells[1]), (std::vector<uint32_t>{1, 2, 3}));
  EXPECT_FALSE(map.is_vertex_alive(4, 1));
  EXPECT_EQ(map.facet_count, 5u);
  const uint32_t below = map.index(cells[0]);
  EXPECT_TRUE(
      map.facet_marked(half_facet(map, side(map, below, 0, 1))));  // what triangle 0 had between its two other sides
  EXPECT_FALSE(map.facet_marked(half_facet(map, side(map, below, 1, 3))));
}

TEST(PlaneEdit, PolygonsAreAddedJoinedAndSewn) {
  const auto env = squares(1, 1);
  const Map<2>& map = env->map;
  Edit<2> edit(*env);
  const double points[2][2] = {{2, 0}, {2, 1}};
  const uint32_t all[4] = {1, 3, edit.add_vertex(points[0]), edit.add_vertex(points[1])};
  const int64_t connectivity[] = {0, 2, 3, 0, 3, 1}, offsets[] = {0, 3, 6};
  const HalfFacet sew_to = half_facet(map, side(map, 0, 1, 3));
  NewCells input{};
  input.vertices = all;
  input.vertex_count = 4;
  input.uniform_cell_type = kPolygon;
  input.cell_count = 2;
  input.index_bytes = 8;
  input.offsets = offsets;
  input.connectivity = connectivity;
  input.connectivity_count = 6;
  input.sew_to = &sew_to;
  input.sew_count = 1;
  add_cells(edit, input);
  edit.prepare();
  edit.apply();
  edit.finish();
  EXPECT_EQ(check_integrity(map), nullptr);
  EXPECT_EQ(map.cell_count, 3u);
  EXPECT_EQ(map.form(edit.cell(0)), Form::kSimplex);
  EXPECT_EQ(map.cell_of(map.opposite(sew_to)), edit.cell(1));
  EXPECT_EQ(map.boundary_facet_count, 6u);
  EXPECT_EQ(env->upper[0], 2.0);
}

}  // namespace
