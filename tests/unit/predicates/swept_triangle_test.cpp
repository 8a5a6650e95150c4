// What the swept triangle says of lines against exact integers.

#include "predicates/swept_triangle.h"
#include "predicates/cell_signs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/compiler.h"
#include "cases.h"
#include "oracle.h"

namespace dsw {
namespace {

using Big3 = std::array<mpz_class, 3>;

Big3 difference(const double* a, const double* b) {
  Big3 r;
  for (size_t k = 0; k < 3; ++k) r[k] = oracle::integer(a[k]) - oracle::integer(b[k]);
  return r;
}

/** orient3(x, q, a, b), without the shift. */
mpz_class volume(const double* x, const double* q, const double* a, const double* b) {
  const Big3 u = difference(q, x), v = difference(a, x), w = difference(b, x);
  return u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2]) + u[2] * (v[0] * w[1] - v[1] * w[0]);
}

/** (1-t) L(p) + t L(p'), times a positive number. */
mpz_class value_at(double t, const mpz_class& first, const mpz_class& last) {
  const mpz_class one = oracle::integer(1.0), time = oracle::integer(t);
  return (one - time) * first + time * last;
}

TEST(SweptTriangle, SaysLaterOnlyOfLinesThatAreMetLater) {
  Random random(61);
  PointSet<3> s;
  const int cases = static_cast<int>(case_count() / 2);
  int later = 0, inside_later = 0, close = 0, inside = 0;
  for (int i = 0; i < cases; ++i) {
    draw(random, 5, s);
    const double *const p = s.at[0], *const to = s.at[1], *const q = s.at[2], *const a = s.at[3], *const b = s.at[4];
    SweptTriangle triangle({p, to, q});
    const int side_a = triangle.side(a), side_b = triangle.side(b);
    if (side_a == side_b || side_a == 0 || side_b == 0) continue;
    const uint32_t sides = triangle.outside(a, b, side_b);
    ASSERT_EQ(sides & SweptTriangle::kLater, 0u) << "no end was set";
    ASSERT_EQ(triangle.leaves(a, b, side_b), sides != 0);
    const mpz_class first = volume(p, q, a, b), last = volume(to, q, a, b);
    if (sides == 0) ++inside;
    // About the exact time, if there is one, and anywhere.
    double end = 0.5 * (random.uniform() + 1);
    const bool near_time = sides == 0 && sgn(first) != sgn(last) && random.below(3) != 0;
    if (near_time) {
      end = event_time<3>(p, to, {{q, a, b}, EventKind::kEdge});
      for (int steps = random.below(4); steps > 0; --steps) end = std::nextafter(end, 0);
      if (random.below(3) == 0) end *= 1 - std::ldexp(1, -random.between(20, 52));
    }
    if (random.below(20) == 0) end = random.below(2);
    triangle.end_at(end);
    const uint32_t bits = triangle.outside(a, b, side_b);
    ASSERT_EQ(bits & SweptTriangle::kSides, sides) << "case " << i;
    // The line has not been met at the end if L has the sign there that it has before.
    const int sign = sgn(value_at(end, first, last));
    const bool is_later = end < 1 && (side_b > 0 ? sign < 0 : sign > 0);
    if ((bits & SweptTriangle::kLater) != 0) {
      ++later;
      close += near_time ? 1 : 0;
      ASSERT_TRUE(is_later) << "case " << i << " end " << end;
      if (sides == 0 && sgn(first) != sgn(last)) {
        const mpz_class numerator = first * oracle::integer(1.0), denominator = first - last;
        const mpz_class at_end = oracle::integer(end) * denominator;
        ASSERT_TRUE(sgn(denominator) > 0 ? at_end < numerator : at_end > numerator) << "case " << i;
      }
    }
    inside_later += (bits & SweptTriangle::kLater) != 0 && sides == 0 ? 1 : 0;
  }
  EXPECT_GT(inside, cases / 100);
  EXPECT_GT(later, cases / 50);
  EXPECT_GT(close, cases / 2000);
  EXPECT_GT(inside_later, cases / 500);
}

/** What the processor has, for tetrahedra and for pyramids. */
std::vector<FindCellSigns> kernels(int corners) {
  std::vector<FindCellSigns> all = {corners == 4 ? find_tetrahedron_signs : find_pyramid_signs};
#if DSW_X86_64
  if (DSW_CPU_HAS("avx2")) all.push_back(corners == 4 ? find_tetrahedron_signs_avx2 : find_pyramid_signs_avx2);
#endif
  return all;
}

int exact_line(const double* x, const double* y, const double* a, const double* b) {
  const double* const ridge[2] = {a, b};
  return exact::line_side<3>(x, y, ridge).sign;
}

/** @param count of corners of a cell: 4 of a tetrahedron, 5 of a pyramid. */
void compare_cell_signs(int count) {
  Random random(static_cast<std::uint64_t>(58 + count));
  PointSet<3> s;
  const int cases = static_cast<int>(case_count() / 2);
  int passing = 0, with_one_alone = 0, later = 0, inside = 0, flat = 0, diagonals = 0;
  for (int i = 0; i < cases; ++i) {
    draw(random, 3 + count, s);
    const double *const p = s.at[0], *const to = s.at[1], *const q = s.at[2], *const *const corners = s.at + 3;
    SweptTriangle triangle({p, to, q});
    if (random.below(3) != 0) triangle.end_at(0.5 * (random.uniform() + 1));
    for (const FindCellSigns find : kernels(count)) {
      CellSigns signs;
      const bool passes = find(triangle, corners, signs);
      int above = 0, below = 0;
      for (int k = 0; k < count; ++k) {
        ASSERT_EQ(signs.side[k], swept_side({p, to, q}, corners[k]).sign) << "case " << i;
        above += signs.side[k] > 0 ? 1 : 0;
        below += signs.side[k] < 0 ? 1 : 0;
      }
      ASSERT_EQ(passes, above != 0 && below != 0) << "case " << i;
      flat += above + below == 0 ? 1 : 0;
      if (!passes) continue;
      ++passing;
      with_one_alone += above == 1 || below == 1 ? 1 : 0;
      for (int a = 0; a < count; ++a) {
        for (int b = 0; b < count; ++b) {
          if (signs.side[a] == signs.side[b]) continue;
          const int side = signs.side[b];
          const uint32_t bits = signs.lines[a][b];
          if (count == 5 && a < 4 && b < 4 && (a + b) % 2 == 0) {
            ASSERT_EQ(bits, CellSigns::kNotAsked) << "case " << i;
            ++diagonals;
            continue;
          }
          ASSERT_EQ(bits, triangle.outside(corners[a], corners[b], side)) << "case " << i;
          const int exact_signs[3] = {exact_line(p, to, corners[a], corners[b]),
                                      exact_line(to, q, corners[a], corners[b]),
                                      -exact_line(p, q, corners[a], corners[b])};
          for (uint32_t k = 0; k < 3; ++k) ASSERT_EQ((bits >> k & 1u) != 0, exact_signs[k] != side) << "case " << i;
          later += (bits & SweptTriangle::kLater) != 0 ? 1 : 0;
          inside += bits == 0 ? 1 : 0;
        }
      }
    }
  }
  EXPECT_GT(passing, cases / 10);
  EXPECT_GT(with_one_alone, cases / 20);
  EXPECT_GT(later, cases / 50);
  EXPECT_GT(inside, cases / 50);
  EXPECT_GT(flat, 0);
  EXPECT_EQ(diagonals != 0, count == 5);
}

TEST(TetrahedronSigns, AreExactAndTheSameForEveryKernel) { compare_cell_signs(4); }
TEST(PyramidSigns, AreExactAndTheSameForEveryKernel) { compare_cell_signs(5); }

}  // namespace
}  // namespace dsw
