// Measures the dials of physics: dials [--quick] [--out FOLDER]
//
// Writes a CSV file and a sentence of advice for each of the curves in dials.h. Exit code 2: an option or file can't be used; 1: anything else
// that went wrong.
#include "dials.h"

#include <getopt.h>

#include <exception>
#include <iostream>

namespace {

int usage() {
  std::cerr << "usage: dials [--quick] [--out FOLDER]\n";
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  static const option kOptions[] = {
      {"quick", no_argument, nullptr, 'q'}, {"out", required_argument, nullptr, 'o'}, {nullptr, 0, nullptr, 0}};
  bool quick = false;
  std::string folder = ".";
  for (int letter; (letter = getopt_long(argc, argv, "", kOptions, nullptr)) != -1;) {
    if (letter == 'q') {
      quick = true;
    } else if (letter == 'o') {
      folder = optarg;
    } else {
      return usage();
    }
  }
  if (optind != argc) {
    return usage();
  }
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
