// A whole run, with all that it prints and leaves behind.
#include <fstream>
#include <iostream>
#include <optional>
#include <sstream>

#include "insertion.h"
#include "progress.h"
#include "record.h"

namespace insertion {

bool insert(const Options& options) {
  const Vessel vessel(options);
  Run run(options, &vessel);
  std::optional<Record> record;
  if (!options.out.empty()) {
    record.emplace(options, &vessel, &run);
  }
  Progress progress(&std::cerr, options.progress || stderr_is_terminal(), options.steps, options.dt);
  for (std::size_t i = 1; i <= options.steps; ++i) {
    const Step step = run.step();
    if (record) {
      record->add(step);
    }
    progress.show(i, step.reached / vessel.route().length(), step.contacts);
  }
  run.stop_recording();
  std::ostringstream text;
  print(summary_of(options, vessel, run), run, text);
  std::cout << text.str() << std::flush;
  if (record) {
    record->finish();
    std::ofstream file(options.out + "/summary.txt");
    file << text.str();
    file.close();
    if (!file) {
      throw BadInput("cannot write '" + options.out + "/summary.txt'");
    }
  }
  return run.good();
}

}  // namespace insertion
