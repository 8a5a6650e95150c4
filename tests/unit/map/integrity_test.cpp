// check_integrity: names what is broken, and never follows what it has not checked (run under sanitizers: any bytes).

#include "map/integrity.h"

#include <gtest/gtest.h>

#include <functional>

#include "environment/test_mesh.h"

namespace {

using namespace dsw;
using namespace dsw::test;

Mesh3 boxes() {
  Mesh3 mesh;
  add_boxes(mesh, 2, 2, 1);
  return mesh;
}

/** What is found after `damage`. */
const char* broken_by(const Mesh3& mesh, const std::function<void(Map<3>&)>& damage) {
  const auto env = mesh.build();
  EXPECT_EQ(check_integrity(env->map), nullptr);
  damage(env->map);
  return check_integrity(env->map);
}

TEST(Integrity, EveryInvariantIsMissed) {
  const auto expect_broken = [](const Mesh3& mesh, const std::function<void(Map<3>&)>& damage, const char* what) {
    EXPECT_NE(broken_by(mesh, damage), nullptr) << what;
  };
  const auto inner = [](const Map<3>& map) {
    for (uint32_t f = 0;; ++f) {
      if (map.opposite(map.half_facet(map.cell(0), f)).valid()) return map.half_facet(map.cell(0), f);
    }
  };
  for (const Mesh3& mesh : {boxes(), mixed_mesh()}) {
    expect_broken(
        mesh, [&](Map<3>& m) { m.words[inner(m).word] = kNoFacet; }, "one-sided link");
    expect_broken(
        mesh, [&](Map<3>& m) { m.words[inner(m).word] |= kMarkBit; }, "one-sided mark");
    expect_broken(
        mesh, [&](Map<3>& m) { m.words[inner(m).word] ^= 1; }, "link to another facet");
    expect_broken(
        mesh, [&](Map<3>& m) { m.words[inner(m).word] = inner(m).word; }, "link to itself");
    expect_broken(
        mesh, [&](Map<3>& m) { m.words[inner(m).word] = static_cast<uint32_t>(m.words.size()); }, "link beyond");
    expect_broken(
        mesh,
        [&](Map<3>& m) {
          const HalfFacet h = inner(m), o = m.opposite(h);
          m.words[h.word] = m.words[o.word] = kNoFacet;
        },
        "counts");
    expect_broken(
        mesh, [](Map<3>& m) { ++m.facet_count; }, "facets");
    expect_broken(
        mesh, [](Map<3>& m) { --m.boundary_facet_count; }, "boundary facets");
    expect_broken(
        mesh, [](Map<3>& m) { ++m.cell_count; }, "one cell more");
    expect_broken(
        mesh, [](Map<3>& m) { --m.cell_count; }, "one cell less");
    expect_broken(
        mesh, [](Map<3>& m) { m.cell_count = 0; }, "no cells");
    expect_broken(
        mesh, [](Map<3>& m) { m.vertex_count = 5; }, "vertices that do not exist");
    expect_broken(
        mesh, [](Map<3>& m) { m.words.pop_back(); }, "a record cut off");
    expect_broken(
        mesh, [](Map<3>& m) { m.words.resize(m.words.size() + kUnitWords<3>, 0); }, "words behind");
    expect_broken(
        mesh, [](Map<3>& m) { m.words.clear(); }, "no words");
    expect_broken(
        mesh, [](Map<3>& m) { m.words[0] = 7u << kFormShift; }, "no form");
    expect_broken(
        mesh, [](Map<3>& m) { m.words[0] = static_cast<uint32_t>(Form::kGeneral) << kFormShift | 1000; }, "no shape");
    expect_broken(
        mesh, [](Map<3>& m) { m.words[0] = static_cast<uint32_t>(Form::kContinuation) << kFormShift | 5; },
        "continues nothing");
    expect_broken(
        mesh, [](Map<3>& m) { m.shape_offsets.push_back(0); }, "a shape too many");
    expect_broken(
        mesh, [](Map<3>& m) { m.shape_tables.push_back(0); }, "words behind the shapes");
  }
  const Mesh3 mixed = mixed_mesh();
  expect_broken(
      mixed, [](Map<3>& m) { m.shape_tables.clear(); }, "a shape without table");
  expect_broken(
      mixed, [](Map<3>& m) { std::swap(m.unit_of_cell[0], m.unit_of_cell[1]); }, "cells swapped");
  expect_broken(
      mixed, [](Map<3>& m) { m.unit_of_cell[0] = 0xffffffffu; }, "a cell beyond");
  expect_broken(
      mixed, [](Map<3>& m) { m.cell_of_unit.clear(); }, "no way back");
  expect_broken(
      mixed, [](Map<3>& m) { m.cell_of_unit[1] = 3; }, "a cell inside of a record");
  expect_broken(
      boxes(), [](Map<3>& m) { m.units_per_cell = 0; }, "no size");
  expect_broken(
      boxes(), [](Map<3>& m) { m.words[0] ^= 2; }, "cut unlike the neighbour");
  expect_broken(
      boxes(), [](Map<3>& m) { std::swap(m.words[kUnitWords<3>], m.words[kUnitWords<3> + 1]); }, "vertices swapped");
  expect_broken(
      boxes(), [](Map<3>& m) { m.words[kUnitWords<3>] = m.words[kUnitWords<3> + 1]; }, "a vertex twice");
}

TEST(Integrity, MarksAreNoDamage) {
  for (const Mesh3& mesh : {boxes(), mixed_mesh()}) {
    EXPECT_EQ(broken_by(mesh, [](Map<3>& m) { m.words[0] |= kMarkBit; }), nullptr);
    EXPECT_EQ(broken_by(mesh,
                        [](Map<3>& m) {
                          for (uint32_t i = 0; i < m.cell_count; ++i) {
                            for (uint32_t f = 0; f < m.facets_of(m.cell(i)); ++f)
                              m.words[m.half_facet(m.cell(i), f).word] |= kMarkBit;
                          }
                        }),
              nullptr);
  }
}

/** Every bit of every table: each is refused, but for marks and "convex", which the map does not judge. */
TEST(Integrity, NoBitOfAMapIsFree) {
  for (const Mesh3& mesh : {boxes(), mixed_mesh()}) {
    const auto env = mesh.build();
    Map<3>& map = env->map;
    std::vector<bool> allowed(32 * map.words.size(), false);
    for (uint32_t i = 0; i < map.cell_count; ++i) {
      const size_t word0 = size_t{map.cell(i).unit} * kUnitWords<3>;
      allowed[32 * word0 + 31] = true;
      if (map.form(map.cell(i)) != Form::kSimplex) allowed[32 * word0 + 27] = true;
      for (uint32_t f = 0; f < map.facets_of(map.cell(i)); ++f) {
        const HalfFacet h = map.half_facet(map.cell(i), f);
        if (!map.opposite(h).valid()) allowed[32 * size_t{h.word} + 31] = true;
      }
    }
    for (size_t bit = 0; bit < allowed.size(); ++bit) {
      map.words[bit / 32] ^= 1u << (bit % 32);
      const bool refused = check_integrity(map) != nullptr;
      map.words[bit / 32] ^= 1u << (bit % 32);
      // A vertex of one cell alone, or a cut of a boundary facet, may turn into another that is sound as topology.
      if (allowed[bit]) {
        EXPECT_FALSE(refused) << "word " << bit / 32 << " bit " << bit % 32;
      }
    }
    for (size_t bit = 0; bit < 16 * map.shape_tables.size(); ++bit) {
      map.shape_tables[bit / 16] = static_cast<uint16_t>(map.shape_tables[bit / 16] ^ (1u << (bit % 16)));
      const bool refused = check_integrity(map) != nullptr;
      map.shape_tables[bit / 16] = static_cast<uint16_t>(map.shape_tables[bit / 16] ^ (1u << (bit % 16)));
      EXPECT_TRUE(refused) << "table word " << bit / 16;
    }
    EXPECT_EQ(check_integrity(map), nullptr);
  }
}

TEST(Integrity, AnyBytesAreSafe) {
  Random random(5);
  int accepted = 0;
  for (int round = 0; round < at_least(20000); ++round) {
    const auto env = (round % 2 == 0 ? boxes() : mixed_mesh()).build();
    Map<3>& map = env->map;
    for (int changes = 1 + random.below(3); changes > 0; --changes) {
      const auto word = [&] {
        const uint32_t interesting[] = {0,
                                        1,
                                        kNoFacet,
                                        kMarkBit,
                                        0xffffffffu,
                                        map.vertex_count,
                                        map.cell_count,
                                        static_cast<uint32_t>(random.below(256)),
                                        static_cast<uint32_t>(random.below(1 << 30)),
                                        static_cast<uint32_t>(random.below(8)) << kFormShift};
        return interesting[random.below(10)];
      };
      const auto damage = [&](auto& array) {
        if (array.empty()) return;
        using Value = typename std::decay_t<decltype(array)>::value_type;
        array[static_cast<size_t>(random.below(static_cast<int>(array.size())))] = static_cast<Value>(word());
      };
      switch (random.below(8)) {
        case 0:
          damage(map.shape_tables);
          break;
        case 1:
          damage(map.shape_offsets);
          break;
        case 2:
          damage(map.unit_of_cell);
          break;
        case 3:
          damage(map.cell_of_unit);
          break;
        case 4:
          map.cell_count = word();
          break;
        case 5:
          map.units_per_cell = word();
          break;
        default:
          damage(map.words);
          break;
      }
    }
    if (check_integrity(map) == nullptr) ++accepted;
  }
  EXPECT_LT(accepted, 10000);
}

TEST(Integrity, PlanarMaps) {
  Mesh2 mesh;
  for (int i = 0; i < 6; ++i) mesh.point({i % 3 * 1.0, i / 3 * 1.0});
  mesh.cell(kQuad, {0, 1, 4, 3});
  mesh.cell(kTriangle, {1, 2, 5});
  mesh.cell(kPolygon, {1, 5, 4});
  const auto env = mesh.build();
  EXPECT_EQ(check_integrity(env->map), nullptr);
  const HalfFacet h = env->map.half_facet(env->map.cell(0), 1);
  ASSERT_TRUE(env->map.opposite(h).valid());
  env->map.words[h.word] = kNoFacet;
  EXPECT_NE(check_integrity(env->map), nullptr);
}

}  // namespace
