// The options that programs of measurements share: NAME [--quick] [--out FOLDER]
#ifndef DARTSWEEP_PHYSICS_OPTIONS_H
#define DARTSWEEP_PHYSICS_OPTIONS_H

#include <getopt.h>

#include <iostream>
#include <optional>
#include <string>

namespace physics {

struct MeasureArguments {
  bool quick = false;
  std::string folder = ".";
};

// Nothing where an option can't be used; then it has said how the program is called.
inline std::optional<MeasureArguments> read_options(int argc, char** argv, const char* name) {
  static const option kOptions[] = {
      {"quick", no_argument, nullptr, 'q'}, {"out", required_argument, nullptr, 'o'}, {nullptr, 0, nullptr, 0}};
  MeasureArguments options;
  bool is_good = true;
  for (int letter; (letter = getopt_long(argc, argv, "", kOptions, nullptr)) != -1;) {
    if (letter == 'q') {
      options.quick = true;
    } else if (letter == 'o') {
      options.folder = optarg;
    } else {
      is_good = false;
    }
  }
  if (is_good && optind == argc) {
    return options;
  }
  std::cerr << "usage: " << name << " [--quick] [--out FOLDER]\n";
  return std::nullopt;
}

}  // namespace physics

#endif
