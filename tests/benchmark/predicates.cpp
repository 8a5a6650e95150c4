// The predicates against rationals, as the unit tests do it, on as many cases as the benchmark reports.
#include "oracle.h"
#include "report.h"

#include <CLI/CLI.hpp>

#include <cstdio>

int main(int argc, char** argv) {
  std::uint64_t cases = 100000;
  std::string json = "predicates.json";
  CLI::App app("Signs and times of the predicates against GMP.");
  app.add_option("--cases", cases, "Point sets for each predicate");
  app.add_option("--json", json, "File to write");
  CLI11_PARSE(app, argc, argv);

  const dsw::PredicateTally tally = dsw::run_predicate_oracle(cases, 2010);
  dsw::bench::Report report;
  report.set("predicates.cases", static_cast<double>(tally.cases));
  report.set("predicates.wrong_signs", static_cast<double>(tally.wrong));
  report.set("predicates.tie_share", static_cast<double>(tally.ties) / static_cast<double>(tally.cases));
  return report.write(json) && tally.wrong == 0 ? 0 : 1;
}
