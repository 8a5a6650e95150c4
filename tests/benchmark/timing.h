// Clocks and medians. Engines are timed in turns, round by round, so that a disturbance of the machine meets all of
// them; ratios are taken within a round and then their median.
#ifndef DARTSWEEP_TESTS_BENCHMARK_TIMING_H
#define DARTSWEEP_TESTS_BENCHMARK_TIMING_H

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <ctime>
#include <vector>

namespace dsw::bench {

/** Nanoseconds that a call takes. */
template <typename Work>
double time_ns(Work&& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count();
}

/** Nanoseconds of its processor that a call takes in this thread: for work that lasts longer than a scheduler's slice,
 * which other jobs would stretch while short work slips through between them. */
template <typename Work>
double cpu_time_ns(Work&& work) {
  const auto now = [] {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return 1e9 * static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec);
  };
  const double start = now();
  work();
  return now() - start;
}

inline double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

/** The least value that a share of all values do not exceed. */
inline double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  const auto count = static_cast<double>(values.size());
  const auto rank = static_cast<std::size_t>(std::ceil(share * count));
  return values[std::min(std::max<std::size_t>(rank, 1), values.size()) - 1];
}

/** Median of a[i] / b[i]. */
inline double median_ratio(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < a.size() && i < b.size(); ++i) ratios.push_back(a[i] / b[i]);
  return median(ratios);
}

}  // namespace dsw::bench

#endif
