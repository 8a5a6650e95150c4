// dartsweep_oracle --casts N [--seed S] [--quick] [--only SCENE] [--print N] [--stuck] [--json FILE]
// Casts, locates and particle moves in many small environments, each compared with exact arithmetic.
#include "run.h"

#include <cstdio>
#include <cstdlib>
#include <cstring>

int main(int argc, char** argv) {
  dsw::oracle::RunOptions options;
  const char* json = nullptr;
  int print_most = 20;
  bool casts_given = false, show_stuck = false;
  for (int i = 1; i < argc; ++i) {
    const bool more = i + 1 < argc;
    if (std::strcmp(argv[i], "--casts") == 0 && more) {
      options.casts = std::strtoull(argv[++i], nullptr, 10);
      casts_given = true;
    } else if (std::strcmp(argv[i], "--seed") == 0 && more) {
      options.seed = std::strtoull(argv[++i], nullptr, 10);
    } else if (std::strcmp(argv[i], "--only") == 0 && more) {
      options.only = argv[++i];
    } else if (std::strcmp(argv[i], "--quick") == 0) {
      if (!casts_given) options.casts = 120000;
    } else if (std::strcmp(argv[i], "--print") == 0 && more) {
      print_most = std::atoi(argv[++i]);
    } else if (std::strcmp(argv[i], "--stuck") == 0) {
      show_stuck = true;
    } else if (std::strcmp(argv[i], "--json") == 0 && more) {
      json = argv[++i];
    } else {
      std::fprintf(stderr,
                   "usage: %s --casts N [--seed S] [--quick] [--only SCENE] [--print N] [--stuck] [--json FILE]\n",
                   argv[0]);
      return 2;
    }
  }
  dsw::oracle::Report report(print_most);
  report.show_stuck = show_stuck;
  dsw::oracle::run(options, report);
  const std::string text = dsw::oracle::to_json(report);
  std::fputs(text.c_str(), stdout);
  if (json != nullptr) {
    std::FILE* file = std::fopen(json, "w");
    if (file == nullptr || std::fputs(text.c_str(), file) < 0 || std::fclose(file) != 0) {
      std::fprintf(stderr, "cannot write %s\n", json);
      return 2;
    }
  }
  return report.total.mismatches == 0 && report.total.lost == 0 && report.total.casts > 0 ? 0 : 1;
}
