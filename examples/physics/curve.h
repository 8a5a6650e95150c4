// Error against run time: the dials of the physics as curves, in the format that the report reads.
#ifndef DARTSWEEP_PHYSICS_CURVE_H
#define DARTSWEEP_PHYSICS_CURVE_H

#include <string>
#include <vector>

#include "rod/positions.h"

namespace physics {

// One setting of a dial. Where physics exploded the error is no number; such points are not written.
struct CurvePoint {
  std::string method;  // begins with "exact" where nothing is approximated
  double setting;
  double seconds_per_item, error;
  std::size_t count;  // items behind the error
  std::string note = "";
};

// Points with the same kind of error.
struct CurvePanel {
  std::string setting_unit, item, error_name, error_unit;
  std::vector<CurvePoint> points;
};

// Writes `name`.csv, and `name`.txt with the sentence that says which setting to pick. False where a file can't be written.
bool write_curve(const std::string& folder, const std::string& name, const std::vector<CurvePanel>& panels,
                 const std::string& advice);

// Time of this processor that the program has taken so far: not that of others on the same machine.
double processor_seconds();

// The mean distance of points from others of the same number.
double mean_distance(const Positions& a, const Positions& b);

// A number in a sentence: two digits or a little more.
std::string in_words(double number);

// Finds the cheapest point of a method whose error is at most `error`; null if there is none. The points stand in the
// order of their cost.
const CurvePoint* cheapest_within(const CurvePanel& panel, const std::string& method, double error);

}  // namespace physics

#endif
