// The predicates a second time, over GMP, with the shift followed symbolically: every coordinate is an integer times
// 2^-1074, every shifted one a polynomial in e. Slow, and right by looking at it.
#pragma once

#include "../../gmp_numbers.h"

#include <cstdint>

#include "predicates/exact.h"

namespace dsw {

struct PredicateTally {
  std::uint64_t cases = 0;  // signs and times compared
  std::uint64_t wrong = 0;  // of these, with another sign, another tie flag or another time
  std::uint64_t ties = 0;   // cases whose unshifted value is exactly 0
};

// Compares plane_side, line_side, compare_times, orient (filtered and exact) and crossing_time, in the plane and in
// space, with the oracle on `cases` point sets each, so on about 10 * cases in all.
PredicateTally run_predicate_oracle(std::uint64_t cases, std::uint64_t seed);

// The parts of it, for one predicate and one dimension.
template <int D>
PredicateTally run_plane_side(std::uint64_t cases, std::uint64_t seed);
template <int D>
PredicateTally run_line_side(std::uint64_t cases, std::uint64_t seed);
template <int D>
PredicateTally run_compare_times(std::uint64_t cases, std::uint64_t seed);
template <int D>
PredicateTally run_orient(std::uint64_t cases, std::uint64_t seed);
template <int D>
PredicateTally run_crossing_time(std::uint64_t cases, std::uint64_t seed);

namespace oracle {

// x * 2^1074.
mpz_class integer(double x);

template <int D>
ShiftedSign plane_side(const double* const* simplex, const double* q);
template <int D>
ShiftedSign line_side(const double* p, const double* q, const double* const* ridge);
// False if a denominator is 0: then there is nothing to compare.
template <int D>
bool compare_times(const double* p, const double* q, const double* const* a, const double* const* b,
                   ShiftedSign& result);

// n, with a common factor.
template <int D>
void normal(const double* const* simplex, mpz_class* n);
// Numerator and denominator of the time.
template <int D>
void time(const double* p, const double* q, const double* const* simplex, mpz_class& numerator, mpz_class& denominator);
// Whether t is the largest double <= numerator / denominator, clamped to [0,1]; denominator > 0.
bool is_time_below(double t, const mpz_class& numerator, const mpz_class& denominator);

}  // namespace oracle
}  // namespace dsw
