// Curves of error against run time: points, the table that each becomes, and times of methods that take turns.
#ifndef DARTSWEEP_TESTS_BENCHMARK_ERROR_CURVE_H
#define DARTSWEEP_TESTS_BENCHMARK_ERROR_CURVE_H

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace dsw::curves {

/** One setting of one method. */
struct Point {
  std::string method;
  std::string setting, unit;  // of the dial; empty: it has none
  double seconds = 0;         // per item
  double error = 0;
  std::size_t count = 0;  // what the error is taken over
  std::string note;
};

/** A curve and the sentence below it. */
struct Curve {
  std::string name;
  std::string item;                    // what the seconds are for
  std::string error_name, error_unit;  // the unit may be empty: a share
  std::vector<Point> points;
  std::string advice;

  /** Writes FOLDER/NAME.csv and FOLDER/NAME.txt; throws. */
  void write(const std::string& folder) const;
};

/** printf into a string. */
std::string text(const char* format, ...) __attribute__((format(printf, 1, 2)));

/** Errors of single answers, and what of them a point tells. */
struct Errors {
  std::vector<double> values;
  double mean() const;
  double most() const;
  /** "median 1e-7, largest 3e-6", for a note. */
  std::string spread() const;
};

struct Method {
  std::string name, setting, unit;
  std::function<void()> prepare;  // not timed; may be empty
  std::function<void()> run;      // all items
};

/** Seconds an item, processor time of this thread: medians over `rounds`, in which the methods take turns, after a
 * round that warms up. What the last run of a method left behind is still there. */
std::vector<double> time_methods(const std::vector<Method>& methods, std::size_t items, int rounds);

}  // namespace dsw::curves

#endif
