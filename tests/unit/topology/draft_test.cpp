// Drafts: vertices that share their last bits, and vertices put on edges by dart as by their ends.
#include "topology/draft.h"

#include <gtest/gtest.h>

#include "environment/test_mesh.h"

namespace dsw::test {
namespace {

TEST(Draft, NumbersAreThoseOfFirstUse) {
  Array<uint32_t> listed, expected;
  Numbering number(listed);
  Random random(2);
  for (int i = 0; i < at_least(2000); ++i) {
    const uint32_t vertex = static_cast<uint32_t>(64 * random.below(40) + random.below(3));
    const auto at = static_cast<uint32_t>(std::find(expected.begin(), expected.end(), vertex) - expected.begin());
    if (at == expected.size()) expected.push_back(vertex);
    ASSERT_EQ(number(vertex), at);
  }
  EXPECT_EQ(listed, expected);
}

TEST(Draft, AVertexOnTheEdgeOfADart) {
  Mesh3 mesh;
  add_boxes(mesh, 1, 1, 1);
  const auto env = mesh.build();
  const Cell c = env->map.cell(0);
  const Shape shape = env->map.shape(c);
  for (uint32_t d = 0; d < shape.dart_count(); ++d) {
    const uint32_t a = env->map.vertex(c, shape.dart_vertex(d)),
                   b = env->map.vertex(c, shape.dart_vertex(shape.beta1(d)));
    CellDraft by_dart = draft_of(*env, c), by_ends = draft_of(*env, c);
    insert_vertex(by_dart, shape, d, a, b, 77);
    insert_vertex(by_ends, a, b, 77);
    uint32_t found = 0;
    for (size_t f = 0; f < by_ends.facets.size(); ++f) {
      EXPECT_EQ(by_dart.facets[f].loop, by_ends.facets[f].loop);
      EXPECT_EQ(by_dart.facets[f].triangles, by_ends.facets[f].triangles);
      found += by_ends.facets[f].has(77) ? 1 : 0;
    }
    EXPECT_EQ(found, 2u);
  }
}

}  // namespace
}  // namespace dsw::test
