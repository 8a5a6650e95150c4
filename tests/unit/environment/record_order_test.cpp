// Records are laid out anew only when the order of cells is incoherent in space, and no index, link or cast shows it.

#include "environment/record_order.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numeric>

#include "environment/test_mesh.h"
#include "map/integrity.h"
#include "motion/cast.h"

namespace {

using namespace dsw;
using namespace dsw::test;

/** Kuhn's six tetrahedra in every box of a lattice of n * n * n. */
Mesh3 tetrahedra(int n) {
  Mesh3 boxes, mesh;
  add_boxes(boxes, n, n, n);
  mesh.points = boxes.points;
  for (size_t b = 0; b < boxes.types.size(); ++b) {
    const int64_t* c = &boxes.connectivity[8 * b];
    const size_t steps[6][2] = {{1, 2}, {2, 3}, {3, 7}, {7, 4}, {4, 5}, {5, 1}};
    for (const auto& s : steps) mesh.cell(kTetra, {c[0], c[s[0]], c[s[1]], c[6]});
  }
  return mesh;
}

/** The same cells in random order; cell i is cell from[i] of the mesh given. */
template <int D>
TestMesh<D> shuffled(const TestMesh<D>& mesh, std::vector<size_t>& from) {
  from.resize(mesh.types.size());
  std::iota(from.begin(), from.end(), size_t{0});
  Random random(17);
  for (size_t i = from.size(); i-- > 1;)
    std::swap(from[i], from[static_cast<size_t>(random.below(static_cast<int>(i)))]);
  TestMesh<D> out;
  out.points = mesh.points;
  for (const size_t cell : from) {
    out.cell(mesh.types[cell],
             {mesh.connectivity.begin() + mesh.offsets[cell], mesh.connectivity.begin() + mesh.offsets[cell + 1]});
  }
  return out;
}

template <int D>
bool is_ordered(const Environment<D>& env) {
  const auto& units = env.map.unit_of_cell;
  return !std::is_sorted(units.begin(), units.end());
}

/** The environment as it would be with its records in the order of cells: for tetrahedra only. */
void lay_out_by_index(Environment<3>& env) {
  Map<3>& map = env.map;
  const Array<uint32_t> words = map.words;
  for (uint32_t i = 0; i < map.cell_count; ++i) {
    const uint32_t* from = words.data() + size_t{map.unit_of_cell[i]} * kUnitWords;
    uint32_t* to = map.words.data() + size_t{i} * kUnitWords;
    std::copy(from, from + kUnitWords, to);
    for (uint32_t k = 4; k < kUnitWords; ++k) {
      const uint32_t link = from[k] & ~kMarkBit;
      if (link == kNoFacet) continue;
      to[k] = (from[k] & kMarkBit) | (map.cell_of_unit[link / kUnitWords] * kUnitWords + link % kUnitWords);
    }
  }
  map.unit_of_cell.clear();
  map.cell_of_unit.clear();
  map.units_per_cell = 1;
}

TEST(RecordOrder, CoherentOrdersAreKept) {
  Mesh3 boxes, thin, few;
  add_boxes(boxes, 20, 20, 20);
  add_boxes(thin, 5000, 1, 1);
  EXPECT_EQ(boxes.build()->map.units_per_cell, 2u);
  EXPECT_EQ(thin.build()->map.units_per_cell, 2u);
  EXPECT_EQ(tetrahedra(10).build()->map.units_per_cell, 1u);
  std::vector<size_t> from;
  EXPECT_EQ(shuffled(tetrahedra(4), from).build()->map.units_per_cell, 1u) << "too few to matter";
}

TEST(RecordOrder, IndicesAndCastsDoNotShowIt) {
  std::vector<size_t> from;
  const int n = 10;
  const Mesh3 mesh = shuffled(tetrahedra(n), from);
  const auto env = mesh.build(), plain = mesh.build();
  ASSERT_TRUE(is_ordered(*env));
  lay_out_by_index(*plain);
  const Map<3>&a = env->map, &b = plain->map;
  ASSERT_EQ(check_integrity(a), nullptr);
  ASSERT_EQ(check_integrity(b), nullptr);
  EXPECT_LE(a.memory_bytes(), 40u * a.cell_count + 64);
  double jumps_a = 0, jumps_b = 0;
  for (uint32_t i = 0; i < a.cell_count; ++i) {
    const Cell ca = a.cell(i), cb = b.cell(i);
    ASSERT_EQ(a.index(ca), i);
    for (uint32_t k = 0; k < 4; ++k) {
      ASSERT_EQ(a.vertex(ca, k), static_cast<uint32_t>(mesh.connectivity[4 * i + k]));
      const HalfFacet oa = a.opposite(a.half_facet(ca, k)), ob = b.opposite(b.half_facet(cb, k));
      ASSERT_EQ(oa.valid(), ob.valid());
      if (!oa.valid()) continue;
      ASSERT_EQ(a.index(a.cell_of(oa)), b.index(b.cell_of(ob)));
      jumps_a += std::abs(static_cast<double>(a.cell_of(oa).unit) - ca.unit);
      jumps_b += std::abs(static_cast<double>(b.cell_of(ob).unit) - cb.unit);
    }
  }
  EXPECT_LT(4 * jumps_a, jumps_b) << "neighbours are nearer to each other";

  Random random(23);
  for (int round = 0; round < 2000; ++round) {
    const uint32_t start = static_cast<uint32_t>(random.below(static_cast<int>(a.cell_count)));
    double p[3], q[3];
    centre(*env, a.cell(start), p);
    // Every third target is a lattice point or beyond, where ties are.
    for (double& x : q) x = round % 3 == 0 ? random.below(n + 3) - 1 : n * random.unit();
    CastRequest request_a{p, q, a.cell(start)}, request_b{p, q, b.cell(start)};
    CastCounters counters_a, counters_b;
    const CastResult ra = cast(*env, request_a, &counters_a), rb = cast(*plain, request_b, &counters_b);
    ASSERT_EQ(ra.end, rb.end);
    ASSERT_EQ(a.index(ra.cell), b.index(rb.cell));
    ASSERT_EQ(ra.previous.valid(), rb.previous.valid());
    if (ra.previous.valid()) {
      ASSERT_EQ(a.index(ra.previous), b.index(rb.previous));
    }
    ASSERT_EQ(ra.cells_visited, rb.cells_visited);
    ASSERT_EQ(ra.first_facet, rb.first_facet);
    ASSERT_EQ(counters_a.orientation_tests, counters_b.orientation_tests);
    ASSERT_EQ(counters_a.exact_fallbacks, counters_b.exact_fallbacks);
    if (ra.end != CastEnd::kHit) continue;
    ASSERT_EQ(ra.simplex, rb.simplex);
    ASSERT_EQ(a.local_of(ra.facet, ra.cell), b.local_of(rb.facet, rb.cell));
    const double ta = crossing_time(*env, ra.cell, ra.simplex, p, q),
                 tb = crossing_time(*plain, rb.cell, rb.simplex, p, q);
    ASSERT_EQ(std::memcmp(&ta, &tb, sizeof ta), 0);
  }
}

TEST(RecordOrder, EveryCellType) {
  Mesh3 mesh;
  for (int copy = 0; copy < 900; ++copy) {
    const Mesh3 part = mixed_mesh();
    const int64_t first = static_cast<int64_t>(mesh.points.size() / 3);
    for (size_t i = 0; i < part.points.size(); ++i) {
      const int step[3] = {copy % 10, copy / 10 % 10, copy / 100};
      mesh.points.push_back(part.points[i] + 4 * step[i % 3]);
    }
    for (size_t i = 0; i < part.types.size(); ++i) {
      std::vector<int64_t> stream(part.connectivity.begin() + part.offsets[i],
                                  part.connectivity.begin() + part.offsets[i + 1]);
      if (part.types[i] != kPolyhedron) {
        for (int64_t& v : stream) v += first;
      } else {
        for (size_t at = 1; at < stream.size();) {
          for (int64_t left = stream[at++]; left > 0; --left) stream[at++] += first;
        }
      }
      mesh.cell(part.types[i], stream);
    }
  }
  EXPECT_FALSE(is_ordered(*mesh.build())) << "groups of five are coherent";
  std::vector<size_t> from;
  const Mesh3 mixed = shuffled(mesh, from);
  BuildReport report;
  const auto env = mixed.build(&report), reference = mesh.build();
  ASSERT_TRUE(is_ordered(*env));
  ASSERT_EQ(check_integrity(env->map), nullptr);
  EXPECT_EQ(env->map.facet_count, reference->map.facet_count);
  for (uint32_t i = 0; i < env->map.cell_count; ++i) {
    const Cell c = env->map.cell(i), r = reference->map.cell(static_cast<uint32_t>(from[i]));
    ASSERT_EQ(env->map.form(c), reference->map.form(r));
    for (uint32_t k = 0; k < env->map.vertices_of(c); ++k)
      ASSERT_EQ(env->map.vertex(c, k), reference->map.vertex(r, k));
  }
}

TEST(RecordOrder, InThePlane) {
  Mesh2 mesh;
  const int n = 70;
  for (int y = 0; y <= n; ++y) {
    for (int x = 0; x <= n; ++x) mesh.point({x * 0.7, y * 0.1});
  }
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      const int64_t a = x + (n + 1) * y;
      mesh.cell(x % 2 == 0 ? kQuad : kPolygon, {a, a + 1, a + n + 2, a + n + 1});
    }
  }
  EXPECT_FALSE(is_ordered(*mesh.build()));
  std::vector<size_t> from;
  const Mesh2 mixed = shuffled(mesh, from);
  const auto env = mixed.build();
  ASSERT_TRUE(is_ordered(*env));
  EXPECT_EQ(check_integrity(env->map), nullptr);
  for (uint32_t i = 0; i < env->map.cell_count; ++i) {
    for (uint32_t k = 0; k < 4; ++k) {
      ASSERT_EQ(env->map.vertex(env->map.cell(i), k), static_cast<uint32_t>(mixed.connectivity[4 * i + k]));
    }
  }
}

TEST(RecordOrder, AnyCoordinatesAndIndices) {
  std::vector<size_t> from;
  const Mesh3 mesh = shuffled(tetrahedra(9), from);
  for (const double scale : {1e-320, 1e-300, 1e300, 1e307, 1.7e307}) {
    Mesh3 scaled = mesh;
    for (double& x : scaled.points) x = (x - 4.5) * 2 * scale;
    Environment<3> env(nullptr);
    env.points = scaled.points.data();
    env.map.vertex_count = static_cast<uint32_t>(scaled.points.size() / 3);
    const uint32_t cells = static_cast<uint32_t>(scaled.types.size());
    Random random(29);
    for (const bool damaged : {false, true}) {
      const auto sample = [&](uint32_t i) {
        CellSample s{scaled.connectivity[4 * i], scaled.connectivity[4 * i + 1], scaled.connectivity[4 * i + 3]};
        if (damaged && i % 5 == 0) s.first = i % 2 == 0 ? INT64_MIN : env.map.vertex_count;
        if (damaged && i % 7 == 0) s.last = INT64_MAX;
        if (damaged && i % 11 == 0) s.second = -1;
        return s;
      };
      Array<uint32_t> order, again;
      // 18 * 1e307 and more is no extent of a double: such a box has no places, and the order stays.
      ASSERT_EQ(choose_record_order(env, cells, sample, order), scale < 1e307) << scale;
      if (scale >= 1e307) continue;
      ASSERT_TRUE(choose_record_order(env, cells, sample, again));
      EXPECT_EQ(order, again);
      std::sort(again.begin(), again.end());
      for (uint32_t i = 0; i < cells; ++i) ASSERT_EQ(again[i], i);
    }
  }
}

TEST(RecordOrder, DefectsAreNamedByIndex) {
  std::vector<size_t> from;
  Mesh3 mesh = shuffled(tetrahedra(9), from);
  mesh.connectivity[4 * 1234 + 1] = -7;
  mesh.connectivity[4 * 3456 + 3] = 1000000;
  BuildReport report;
  EXPECT_ANY_THROW(mesh.build(&report));
  ASSERT_EQ(report.offenders.count, 2u);
  EXPECT_EQ(report.offenders.index[0], 1234u);
  EXPECT_EQ(report.offenders.index[1], 3456u);
}

}  // namespace
