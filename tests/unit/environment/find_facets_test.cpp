// Facets and edges by their vertices: those of a mixed mesh, and no other, under any order of them.

#include "environment/find_facets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "environment/test_mesh.h"

namespace {

using namespace dsw;
using namespace dsw::test;

using Vertices = std::vector<uint32_t>;

/** All facets by their sorted vertices, canonical. */
std::map<Vertices, HalfFacet> facets_of(const Environment<3>& env) {
  std::map<Vertices, HalfFacet> all;
  for (uint32_t i = 0; i < env.map.cell_count; ++i) {
    const Cell c = env.map.cell(i);
    const Shape shape = env.map.shape(c);
    for (uint32_t f = 0; f < shape.facet_count(); ++f) {
      Vertices v;
      for (uint32_t d = shape.facet_first(f); d < shape.facet_first(f + 1); ++d)
        v.push_back(env.map.vertex(c, shape.dart_vertex(d)));
      std::sort(v.begin(), v.end());
      all[v] = canonical(env.map, env.map.half_facet(c, f));
    }
  }
  return all;
}

TEST(FindFacets, FindsEachInAnyOrderAndNothingElse) {
  const auto env = mixed_mesh().build();
  const auto all = facets_of(*env);
  ASSERT_EQ(all.size(), env->map.facet_count);
  Random random(3);
  Vertices indices;
  std::vector<size_t> offsets{0};
  std::vector<HalfFacet> expected;
  const auto ask = [&](Vertices v, HalfFacet answer) {
    for (size_t i = v.size(); i > 1; --i)
      std::swap(v[i - 1], v[static_cast<size_t>(random.below(static_cast<int>(i)))]);
    indices.insert(indices.end(), v.begin(), v.end());
    offsets.push_back(indices.size());
    expected.push_back(answer);
  };
  for (int twice = 0; twice < 2; ++twice) {
    for (const auto& [v, h] : all) {
      ask(v, h);
      Vertices part(v.begin(), v.end() - 1), more = v, wrong = v, twin = v;
      more.push_back((v.back() + 1) % env->map.vertex_count);
      wrong.back() = env->map.vertex_count;
      twin.back() = twin.front();
      ask(part, {});
      ask(more, {});
      ask(wrong, {});
      ask(twin, {});
    }
  }
  ask({}, {});
  ask({0xffffffffu, 0xffffffffu, 0xffffffffu}, {});
  std::vector<HalfFacet> out(expected.size());
  size_t missing = 0;
  find_facets(*env, expected.size(), offsets.data(), indices.data(), out.data(), &missing);
  for (size_t i = 0; i < out.size(); ++i) EXPECT_EQ(out[i], expected[i]) << "query " << i;
  EXPECT_EQ(missing, expected.size() - 2 * all.size());
}

TEST(FindFacets, NothingAskedNothingMissing) {
  const auto env = mixed_mesh().build();
  const size_t offset = 0;
  size_t missing = 7;
  find_facets(*env, 0, &offset, nullptr, nullptr, &missing);
  EXPECT_EQ(missing, 0u);
  missing = 7;
  find_edges(*env, 0, nullptr, nullptr, &missing);
  EXPECT_EQ(missing, 0u);
}

TEST(FindEdges, FindsEveryPairThatIsAnEdge) {
  const auto env = mixed_mesh().build();
  std::set<std::pair<uint32_t, uint32_t>> edges;
  for (uint32_t i = 0; i < env->map.cell_count; ++i) {
    const Cell c = env->map.cell(i);
    for (uint32_t d = 0; d < env->map.shape(c).dart_count(); ++d) {
      edges.insert({dart_vertex(env->map, {c, d}), dart_target(env->map, {c, d})});
    }
  }
  const uint32_t n = env->map.vertex_count;
  Vertices indices;
  for (uint32_t a = 0; a <= n; ++a) {
    for (uint32_t b = 0; b <= n; ++b) indices.insert(indices.end(), {a, b});
  }
  std::vector<Dart> out(indices.size() / 2);
  size_t missing = 0, absent = 0;
  find_edges(*env, out.size(), indices.data(), out.data(), &missing);
  for (size_t i = 0; i < out.size(); ++i) {
    const uint32_t a = indices[2 * i], b = indices[2 * i + 1];
    const bool is_edge = edges.count({a, b}) != 0 || edges.count({b, a}) != 0;
    ASSERT_EQ(out[i].cell.valid(), is_edge) << a << " - " << b;
    absent += is_edge ? 0u : 1u;
    if (!is_edge) continue;
    const uint32_t from = dart_vertex(env->map, out[i]), to = dart_target(env->map, out[i]);
    EXPECT_TRUE((from == a && to == b) || (from == b && to == a));
    for_each_volume_round_edge(env->map, out[i], [&](Dart e) {
      EXPECT_LE(env->map.index(out[i].cell), env->map.index(e.cell));
      return true;
    });
  }
  EXPECT_EQ(missing, absent);
}

}  // namespace
