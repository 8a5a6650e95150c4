// Pairs whose points lie in one plane at the start, or nearly so, against moving_pair_truth.h: around the limits up to which doubles
// are exact there.

#include "predicates/moving_pair.h"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>

#include "moving_pair_cases.h"
#include "moving_pair_truth.h"

namespace dsw {
namespace {

using Whole = mpz_class;
template <int D>
using Rows = std::array<std::array<Whole, D>, D>;

/** A multiple of a whole number that is nearest to another one, as a factor. */
Whole nearest_factor(const Whole& to, const Whole& of) {
  const Whole twice = 2 * to + of;
  Whole factor;
  mpz_fdiv_q(factor.get_mpz_t(), twice.get_mpz_t(), Whole(2 * of).get_mpz_t());
  return factor;
}

/** Factors whose products with two numbers, which are not both 0, add up to their greatest common divisor. */
Whole divide_out(const Whole& a, const Whole& b, Whole* of_a, Whole* of_b) {
  Whole divisor;
  mpz_gcdext(divisor.get_mpz_t(), of_a->get_mpz_t(), of_b->get_mpz_t(), a.get_mpz_t(), b.get_mpz_t());
  return divisor;
}

Whole some_whole(Random& random, int bits) {
  return random.between((1 << bits) - (1 << (bits - 4)), (1 << bits) - 1) * (random.below(2) == 0 ? 1 : -1);
}

/** Rows of about so many bits with this determinant, or a multiple of it. Seen from the side, point 0 lies between the others, or its edge
 * between the ends of the other one. */
Rows<3> some_rows(Random& random, int bits, int determinant, PairKind kind, Rows<3>) {
  Rows<3> rows;
  Whole normal[3];
  do {
    for (size_t i = 0; i < 2; ++i) {
      for (Whole& x : rows[i]) x = some_whole(random, bits);
    }
    for (size_t k = 0; k < 3; ++k) {
      const size_t x = (k + 1) % 3, y = (k + 2) % 3;
      normal[k] = rows[0][x] * rows[1][y] - rows[0][y] * rows[1][x];
    }
  } while (normal[2] == 0);
  Whole x, y, z, of_both;
  divide_out(divide_out(normal[0], normal[1], &x, &y), normal[2], &of_both, &z);
  const Whole last[3] = {determinant * of_both * x, determinant * of_both * y, determinant * z};
  // Moved by multiples of the others near half of their sum or difference.
  const int side = kind == PairKind::kEdgeEdge ? 1 : -1;
  const Whole to_x = side * rows[0][0] - rows[1][0] - 2 * last[0], to_y = side * rows[0][1] - rows[1][1] - 2 * last[1];
  const Whole first = nearest_factor(to_x * rows[1][1] - to_y * rows[1][0], 2 * normal[2]),
              second = nearest_factor(rows[0][0] * to_y - rows[0][1] * to_x, 2 * normal[2]);
  for (size_t k = 0; k < 3; ++k) rows[2][k] = last[k] + first * rows[0][k] + second * rows[1][k];
  return rows;
}
Rows<2> some_rows(Random& random, int bits, int determinant, PairKind, Rows<2>) {
  Rows<2> rows;
  for (Whole& x : rows[0]) x = some_whole(random, bits);
  Whole x, y;
  divide_out(-rows[0][1], rows[0][0], &x, &y);
  const Whole factor = nearest_factor(-rows[0][0] - 2 * determinant * x, 2 * rows[0][0]);
  rows[1] = {determinant * x + factor * rows[0][0], determinant * y + factor * rows[0][1]};
  return rows;
}

enum class Limit { kBits, kExtent, kOffset, kDigit, kCount };

/** The exponent of an axis of which the extent is at a limit of the filter, or anywhere. */
int some_exponent(Random& random, int bits) {
  constexpr int kLimits[] = {-320, 340};
  const int kind = random.below(8);
  return kind == 0 ? random.between(-900, 900) : kind < 4 ? 0 : kLimits[kind % 2] - bits + random.between(-1, 1);
}

/** Moves a coordinate, or gives it a digit far below those of the rows. */
void add_digit(Random& random, double& x) {
  if (x == 0) {
    x = std::ldexp(1.0, random.between(-1074, -20));
  } else if (random.below(2) == 0) {
    x = std::nextafter(x, random.uniform() < 0 ? -HUGE_VAL : HUGE_VAL);
  } else {
    x += std::ldexp(x, -random.between(14, 40));
  }
}

template <int D>
MovingCase<D> some_case(Random& random, PairKind kind, Limit limit) {
  const int bits = random.between(14, 20);
  const Rows<D> rows = some_rows(random, bits, random.between(-1, 1), kind, Rows<D>{});
  MovingCase<D> c{kind, {}, {}};
  const int flat = limit == Limit::kExtent ? random.below(8) : D;  // an axis without extent, or none
  for (size_t k = 0; k < D; ++k) {
    double offset = random.below(2) == 0 ? 0 : random.between(-9, 9);
    if (limit == Limit::kOffset) offset += std::ldexp(random.below(2) == 0 ? 1 : -1, bits + random.between(30, 38));
    const int exponent = limit == Limit::kExtent ? some_exponent(random, bits) : 0;
    for (size_t i = 0; i <= D; ++i) {
      const double row = i == 0 || flat == static_cast<int>(k) ? 0 : rows[i - 1][k].get_d();
      c.start[i][k] = std::ldexp(offset + row, exponent);
      c.end[i][k] = std::ldexp(static_cast<double>(random.between(-9, 9)), exponent);
    }
  }
  if (limit == Limit::kDigit)
    add_digit(random, c.start[static_cast<size_t>(random.below(D + 1))][static_cast<size_t>(random.below(D))]);
  if (random.below(2) == 0) c.end = c.start;
  return c;
}

template <int D>
void expect_true_times(PairKind kind) {
  Random random{static_cast<std::uint64_t>(D) * 8 + static_cast<std::uint64_t>(kind)};
  const std::uint64_t cases = case_count() / 10;
  std::uint64_t touching = 0;
  for (std::uint64_t i = 0; i < cases; ++i) {
    const MovingCase<D> c =
        some_case<D>(random, kind, static_cast<Limit>(i % static_cast<std::uint64_t>(Limit::kCount)));
    const FirstTouch found = first_touch(c.pair()), truth = true_first_touch(c.pair());
    ASSERT_EQ(found.touches, truth.touches) << c.text();
    ASSERT_EQ(found.time, truth.time) << c.text();
    touching += truth.touches && truth.time == 0 ? 1 : 0;
  }
  EXPECT_GE(touching, cases / 16);
  EXPECT_LE(touching, cases - cases / 4);
}

TEST(FlatStartTest, APointAndATriangle) { expect_true_times<3>(PairKind::kVertexFace); }
TEST(FlatStartTest, Edges) { expect_true_times<3>(PairKind::kEdgeEdge); }
TEST(FlatStartTest, APointAndAnEdge) { expect_true_times<2>(PairKind::kVertexEdge); }

}  // namespace
}  // namespace dsw
