// Edits one layer below the interface: records that are used again, taking back, and damage that the integrity check
// must see.
#include "topology/edit.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <type_traits>

#include "base/error.h"
#include "environment/test_mesh.h"
#include "map/integrity.h"
#include "topology/operations.h"

namespace {

using namespace dsw;
using namespace dsw::test;

template <int D>
std::unique_ptr<Environment<D>> boxes() {
  TestMesh<D> mesh;
  if constexpr (D == 3) {
    add_boxes(mesh, 4, 2, 2);
  } else {
    add_squares(mesh, 4, 4);
  }
  return mesh.build();
}

template <int D>
void carry_out(Edit<D>& edit) {
  edit.prepare();
  edit.apply();
  edit.finish();
}

/** A facet between two cells. */
template <int D>
HalfFacet inner_facet(const Map<D>& map) {
  HalfFacet found;
  for_each_cell(map, [&](Cell c) {
    for (uint32_t f = 0; f < map.facets_of(c); ++f) {
      if (map.opposite(map.half_facet(c, f)).valid()) found = map.half_facet(c, f);
    }
  });
  return found;
}

/** What is the same in space and in the plane. */
template <class Dimension>
class EditOfDimension : public testing::Test {};
struct DimensionName {
  template <class Dimension>
  static std::string GetName(int) {
    return std::to_string(Dimension::value) + "D";
  }
};
using Dimensions = testing::Types<std::integral_constant<int, 3>, std::integral_constant<int, 2>>;
TYPED_TEST_SUITE(EditOfDimension, Dimensions, DimensionName);

TYPED_TEST(EditOfDimension, UsesRecordsShapesAndIndicesAgain) {
  constexpr int D = TypeParam::value;
  const auto env = boxes<D>();
  size_t words = 0, tables = 0;
  uint32_t indices = 0;
  for (int round = 0; round < 50; ++round) {
    Cell merged;
    std::vector<uint32_t> loop;
    {
      Edit<D> edit(*env);
      const HalfFacet h = inner_facet(env->map);
      const FacetDraft shared = draft_of(*env, h);
      loop.assign(shared.loop.begin(), shared.loop.end());
      merge_cells(edit, h);
      carry_out(edit);
      merged = edit.cell(0);
    }
    ASSERT_EQ(check_integrity(env->map), nullptr);
    EXPECT_EQ(env->map.form(merged), Form::kGeneral);
    {
      Edit<D> edit(*env);
      split_cell(edit, merged, loop.data(), loop.size());
      carry_out(edit);
      EXPECT_EQ(env->map.form(edit.cell(0)), Form::kBox);
      EXPECT_EQ(env->map.form(edit.cell(1)), Form::kBox);
    }
    ASSERT_EQ(check_integrity(env->map), nullptr);
    if (round == 1) {
      words = env->map.words.size();
      tables = env->map.shape_tables.size();
      indices = env->map.index_count();
    }
  }
  EXPECT_EQ(env->map.words.size(), words);
  EXPECT_EQ(env->map.shape_tables.size(), tables);
  EXPECT_EQ(env->map.index_count(), indices);
  EXPECT_EQ(indices, 16u);
}

TYPED_TEST(EditOfDimension, TakenBackLeavesEveryWordAsItWas) {
  constexpr int D = TypeParam::value;
  const auto env = boxes<D>();
  Edit<D>(*env).prepare();  // the tables are there from now on
  const Array<uint32_t> words = env->map.words, cell_of_unit = env->map.cell_of_unit;
  const uint64_t version = env->obstacle_version;
  uint64_t in_between[2] = {};
  for (uint64_t& each : in_between) {
    Edit<D> edit(*env);
    merge_cells(edit, inner_facet(env->map));
    edit.prepare();
    edit.apply();
    each = env->obstacle_version;
    EXPECT_NE(each, version);
  }
  EXPECT_NE(in_between[0], in_between[1]);  // what was noted in between holds no more
  EXPECT_EQ(env->obstacle_version, version);
  EXPECT_EQ(env->map.words, words);
  EXPECT_EQ(env->map.cell_of_unit, cell_of_unit);
  EXPECT_EQ(check_integrity(env->map), nullptr);
}

TYPED_TEST(EditOfDimension, CountsPartsAndBoundaryOfAFaceThatOpens) {
  constexpr int D = TypeParam::value;
  const auto env = boxes<D>();
  const uint32_t facets = env->map.facet_count, boundary = env->map.boundary_facet_count;
  const HalfFacet h = inner_facet(env->map), o = env->map.opposite(h);
  {
    Edit<D> edit(*env);
    unsew(edit, h);
    carry_out(edit);
  }
  EXPECT_EQ(env->map.facet_count, facets + 1);
  EXPECT_EQ(env->map.boundary_facet_count, boundary + 2);
  EXPECT_FALSE(env->map.opposite(h).valid());
  {
    Edit<D> edit(*env);
    const FacetPair pair{h, o};
    sew(edit, &pair, 1);
    carry_out(edit);
  }
  EXPECT_EQ(env->map.facet_count, facets);
  EXPECT_EQ(env->map.opposite(h).word, o.word);
  EXPECT_EQ(check_integrity(env->map), nullptr);
}

TEST(Edit, FacesCutDifferentlyAreSewnByCuttingOneAnew) {
  // Two cubes whose common quad is cut along different diagonals.
  const auto env = boxes<3>();
  const HalfFacet h = inner_facet(env->map), o = env->map.opposite(h);
  {
    Edit<3> edit(*env);
    unsew(edit, h);
    carry_out(edit);
  }
  FacetPair pair{h, o};
  {
    Edit<3> edit(*env);
    CellDraft& draft = edit.draft(edit.replace(env->map.cell_of(o)));
    FacetDraft& facet = draft.facets[facet_from(draft, o)];
    const Vertices loop = facet.loop;
    const bool first = std::count(facet.triangles.begin(), facet.triangles.end(), loop[0]) == 2;
    const size_t base = first ? 1 : 0;
    facet.triangles.assign(
        {loop[base], loop[base + 1], loop[base + 2], loop[base], loop[base + 2], loop[(base + 3) % 4]});
    const uint32_t place = facet_from(draft, o);
    carry_out(edit);
    pair.b = edit.half_facet(0, place);
  }
  EXPECT_FALSE(cut_alike(draft_of(*env, pair.a), draft_of(*env, pair.b)));
  {
    Edit<3> edit(*env);
    sew(edit, &pair, 1);
    carry_out(edit);
    EXPECT_EQ(edit.cell_count(), 1u);
  }
  EXPECT_EQ(check_integrity(env->map), nullptr);
}

TYPED_TEST(EditOfDimension, DamageToAMapThatHasChangedIsSeen) {
  constexpr int D = TypeParam::value;
  const auto expect_broken = [](const std::function<void(Map<D>&)>& damage, const char* what) {
    const auto env = boxes<D>();
    Edit<D> edit(*env);
    merge_cells(edit, inner_facet(env->map));
    carry_out(edit);
    Edit<D>(*env).prepare();
    ASSERT_EQ(check_integrity(env->map), nullptr);
    damage(env->map);
    EXPECT_NE(check_integrity(env->map), nullptr) << what;
  };
  const auto free_record = [](Map<D>& m) { return m.free_records[2]; };
  expect_broken([&](Map<D>& m) { m.free_records[2] = kNoCell; }, "a free record in no list");
  expect_broken([&](Map<D>& m) { m.words[free_record(m) * kUnitWords<D> + 1] = free_record(m); }, "a list in a circle");
  expect_broken([&](Map<D>& m) { m.words[free_record(m) * kUnitWords<D> + 1] = 1u << 30; }, "a list that leads away");
  expect_broken([&](Map<D>& m) { ++m.words[free_record(m) * kUnitWords<D>]; }, "a free record of another size");
  expect_broken([&](Map<D>& m) { m.words[free_record(m) * kUnitWords<D> + 5] = 1; }, "words in a free record");
  expect_broken([&](Map<D>& m) { m.cell_of_unit[free_record(m)] = 0; }, "a cell in a free record");
  expect_broken([](Map<D>& m) { m.vertex_uses[0] += 1; }, "uses of a vertex");
  expect_broken([](Map<D>& m) { m.cell_slots.release(0); }, "a cell whose slot is free");
  expect_broken([](Map<D>& m) { m.shape_tables[0] = kFreeShape; }, "a shape in use that is free");
  if (D == 2) {
    const auto noted = [](Map<D>& m) -> uint32_t& {
      return *std::find_if(m.free_shapes.begin(), m.free_shapes.end(), [](uint32_t i) { return i != kNoCell; });
    };
    expect_broken([&](Map<D>& m) { noted(m) = kNoCell; }, "a shape that is not noted");
    expect_broken([&](Map<D>& m) { noted(m) = 7; }, "a shape noted that does not exist");
    expect_broken([&](Map<D>& m) { m.free_shapes[0] = 0; }, "a shape noted by another length");
  }
  expect_broken([](Map<D>& m) { m.unit_of_cell[0] = m.unit_of_cell[1]; }, "a cell without a record");
  expect_broken([](Map<D>& m) { m.vertex_slots.release(m.vertex(m.cell(0), 0)); }, "a vertex that is gone");
}

TYPED_TEST(EditOfDimension, VerticesGoWithTheirLastCell) {
  constexpr int D = TypeParam::value;
  const auto env = boxes<D>();
  Edit<D> edit(*env);
  const Cell corner = env->map.cell(0);
  remove_cells(edit, &corner, 1);
  carry_out(edit);
  EXPECT_EQ(env->map.vertex_slots.alive_count(), env->map.vertex_count - 1u);
  EXPECT_FALSE(env->map.is_vertex_alive(0, 1));
  EXPECT_EQ(env->map.cell_count, 15u);
  EXPECT_EQ(check_integrity(env->map), nullptr);
}

}  // namespace
