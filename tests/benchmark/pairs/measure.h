// Answers and times of several methods on the same queries, and what is wrong with the answers.
#ifndef DARTSWEEP_TESTS_BENCHMARK_PAIRS_MEASURE_H
#define DARTSWEEP_TESTS_BENCHMARK_PAIRS_MEASURE_H

#include "generated.h"
#include "methods.h"

namespace dsw::pairs {

struct MeasureOptions {
  int rounds = 9;
  /** A query whose least time is more is asked three times, nanoseconds. */
  double long_query_ns = 2e6;
  /** A method that has taken so long in the first round is not asked the other queries of the set, nanoseconds. The
   * first method is asked all. */
  double set_budget_ns = 0;
};

/** What a method did on a set: entries are those of the queries, as many as were answered. */
struct Measured {
  std::vector<Answer> answers;
  std::vector<double> ns;  // the least of all rounds, without the clock
};

/** Asks every query alone, in rounds in which methods take turns. An interrupt meets a query in one round only. */
std::vector<Measured> measure(const std::vector<Query>& queries, const std::vector<Method*>& methods,
                              const MeasureOptions& options);

/** Queries of one kind, or of both. */
struct Judged {
  std::size_t queries = 0;
  std::size_t missed = 0, invented = 0;  // against the truth of the set
  std::size_t touching = 0;              // exactly, and answered so
  std::size_t late = 0;                  // of these: later than the exact time
  std::size_t time_error = 0;            // of these: not the largest double that is not later
  double time_off_median = 0, time_off_max = 0;
  double ns_median = 0, ns_mean = 0, ns_p999 = 0, ns_max = 0;
};
/** @param kind of the queries that count; negative: all. */
Judged judge(const std::vector<Query>& queries, const std::vector<Truth>& truths, const Measured& measured, int kind);

}  // namespace dsw::pairs

#endif
