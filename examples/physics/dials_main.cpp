// Measures the dials of physics: dials [--quick] [--out FOLDER]
//
// Writes a CSV file and a sentence of advice for each of the curves in dials.h. Exit code 2: an option or file can't be used; 1: anything else
// that went wrong.
#include "dials.h"

#include <exception>
#include <iostream>

#include "options.h"

int main(int argc, char** argv) {
  const std::optional<physics::MeasureArguments> options = physics::read_options(argc, argv, "dials");
  if (!options) {
    return 2;
  }
  const auto& [quick, folder] = *options;
  try {
    for (const auto measure : {physics::measure_integrators, physics::measure_solvers, physics::measure_shape_matching,
                               physics::measure_omega, physics::measure_time_step, physics::measure_contacts,
                               physics::measure_negligible, physics::measure_rod}) {
      if (!measure(folder, quick)) {
        std::cerr << "dials: cannot write to '" << folder << "'\n";
        return 2;
      }
    }
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "dials: " << error.what() << '\n';
    return 1;
  }
}
