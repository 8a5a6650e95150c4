// The figures of a run: one flat JSON object, also printed as they come.
#ifndef DARTSWEEP_TESTS_BENCHMARK_REPORT_H
#define DARTSWEEP_TESTS_BENCHMARK_REPORT_H

#include <nlohmann/json.hpp>

#include <cstdio>
#include <fstream>
#include <string>

namespace dsw::bench {

class Report {
 public:
  void set(const std::string& name, double value) {
    std::printf("  %-46s %.6g\n", name.c_str(), value);
    std::fflush(stdout);
    figures_[name] = value;
  }

  void add(const std::string& name, double value) { figures_[name] = figures_.value(name, 0.0) + value; }

  bool write(const std::string& path) const {
    std::ofstream file(path);
    file << figures_.dump(1) << '\n';
    return static_cast<bool>(file);
  }

 private:
  nlohmann::ordered_json figures_ = nlohmann::ordered_json::object();
};

}  // namespace dsw::bench

#endif
