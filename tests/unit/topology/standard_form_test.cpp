// Standard forms are known again however their facets and vertices are numbered, and nothing else is taken for one.
#include "topology/standard_form.h"

#include "../../effort.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

namespace {

using namespace dsw;

using Loops = std::vector<std::vector<uint16_t>>;

Loops loops_of(const Shape& shape) {
  Loops loops(shape.facet_count());
  for (uint32_t d = 0; d < shape.dart_count(); ++d) {
    loops[shape.dart_facet(d)].push_back(static_cast<uint16_t>(shape.dart_vertex(d)));
  }
  return loops;
}

Array<uint16_t> table_of(const Loops& loops, uint32_t vertices, const std::vector<uint16_t>& base) {
  std::vector<uint16_t> all, first{0};
  for (const auto& loop : loops) {
    all.insert(all.end(), loop.begin(), loop.end());
    first.push_back(static_cast<uint16_t>(all.size()));
  }
  Array<uint16_t> table;
  const FacetLoops faces{all.data(), first.data(), static_cast<uint32_t>(loops.size()), vertices};
  EXPECT_EQ(append_polyhedron(faces, base.data(), table), ShapeDefect::kNone);
  return table;
}

TEST(StandardForm, IsFoundWhateverTheNumbering) {
  std::mt19937 random(static_cast<uint32_t>(seed_of(1)));
  for (const Form form : {Form::kSimplex, Form::kPyramid, Form::kPrism, Form::kBox}) {
    for (int round = 0; round < at_least(200); ++round) {
      const Shape standard = standard_shape(form, 0);
      Loops loops = loops_of(standard);
      std::vector<uint16_t> name(standard.vertex_count()), base;
      std::iota(name.begin(), name.end(), uint16_t{0});
      std::shuffle(name.begin(), name.end(), random);
      std::shuffle(loops.begin(), loops.end(), random);
      for (auto& loop : loops) {
        for (uint16_t& v : loop) v = name[v];
        std::rotate(loop.begin(), loop.begin() + static_cast<long>(random() % loop.size()), loop.end());
        base.push_back(static_cast<uint16_t>(random() % loop.size()));
      }
      const Array<uint16_t> table = table_of(loops, standard.vertex_count(), base);
      const Shape shape(table.data());
      const StandardMatch match = match_standard_form(shape);
      ASSERT_EQ(match.form, form);
      // Facet by facet the same loops and the same cuts.
      const Shape found = standard_shape(form, match.cuts);
      for (uint32_t f = 0; f < found.facet_count(); ++f) {
        std::vector<uint16_t> wanted = loops[match.facet[f]], given;
        for (uint32_t d = found.facet_first(f); d < found.facet_first(f + 1); ++d) {
          given.push_back(match.vertex[found.dart_vertex(d)]);
        }
        const auto start = std::find(wanted.begin(), wanted.end(), given[0]);
        ASSERT_NE(start, wanted.end());
        std::rotate(wanted.begin(), start, wanted.end());
        EXPECT_EQ(wanted, given);
        if (given.size() != 4) continue;
        // The corner that is in one triangle alone is the same.
        const auto ends = [](const uint16_t* t) {
          std::vector<uint16_t> all(t, t + 6), twice;
          std::sort(all.begin(), all.end());
          for (size_t k = 0; k + 1 < 6; ++k) {
            if (all[k] == all[k + 1]) twice.push_back(all[k]);
          }
          return twice;
        };
        std::vector<uint16_t> cut = ends(found.simplices() + 3 * found.simplex_first(f));
        for (uint16_t& v : cut) v = match.vertex[v];
        std::sort(cut.begin(), cut.end());
        EXPECT_EQ(cut, ends(shape.simplices() + 3 * shape.simplex_first(match.facet[f])));
      }
    }
  }
}

TEST(StandardForm, ATetrahedronWithAVertexOnAnEdgeIsNoPyramid) {
  // One quad and four triangles, as a pyramid has, but two of the quad's sides are those of one triangle.
  const Loops loops{{0, 1, 2, 3}, {0, 2, 1}, {0, 4, 2}, {2, 4, 3}, {3, 4, 0}};
  const Array<uint16_t> table = table_of(loops, 5, std::vector<uint16_t>(5, 0));
  EXPECT_EQ(match_standard_form(Shape(table.data())).form, Form::kGeneral);
}

}  // namespace
