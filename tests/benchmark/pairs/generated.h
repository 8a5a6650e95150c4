// Generated queries with exact answers: the cases of the predicates' own tests.
#ifndef DARTSWEEP_TESTS_BENCHMARK_PAIRS_GENERATED_H
#define DARTSWEEP_TESTS_BENCHMARK_PAIRS_GENERATED_H

#include "queries.h"

namespace dsw::pairs {

/** What the exact test says of a query. */
struct Truth {
  bool touches;
  double time;  // the largest double not later than the first touch; 0 without a touch
};
Truth exact_truth(const Query& query);

/**
 * `count` queries in four sets: random ones, structured ones (lattices, touches that are made and near misses),
 * degenerate ones (in one plane or line, without extent, with multiple zeros; all scales of doubles), and
 * ones in the plane of all these kinds, which are a fifth. They have no answers.
 */
std::vector<QuerySet> generate_sets(std::size_t count, std::uint64_t seed);

}  // namespace dsw::pairs

#endif
