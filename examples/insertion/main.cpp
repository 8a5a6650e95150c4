// The main job: dartsweep_insertion pushes a catheter through a vascular network ([JCD10] figure 8).
//
// Every step is verified. Exit code 1: the catheter was not free at some step, or lost; 2: what was given can't be used.
#include <fstream>
#include <iostream>
#include <sstream>

#include "progress.h"
#include "record.h"

namespace {

constexpr int kFailed = 1, kBadInput = 2;

int insert(const insertion::Options& options) {
  const insertion::Vessel vessel(options);
  insertion::Run run(options, &vessel);
  std::optional<insertion::Record> record;
  if (!options.out.empty()) {
    record.emplace(options, &vessel, &run);
  }
  insertion::Progress progress(&std::cerr, options.progress || insertion::stderr_is_terminal(), options.steps,
                               options.dt);
  for (std::size_t i = 1; i <= options.steps; ++i) {
    const insertion::Step step = run.step();
    if (record) {
      record->add(step);
    }
    progress.show(i, step.reached / vessel.route().length(), step.contacts);
  }
  run.stop_recording();
  std::ostringstream text;
  insertion::print(insertion::summary_of(options, vessel, run), run, text);
  std::cout << text.str() << std::flush;
  if (record) {
    record->finish();
    std::ofstream file(options.out + "/summary.txt");
    file << text.str();
    file.close();
    if (!file) {
      throw insertion::BadInput("cannot write '" + options.out + "/summary.txt'");
    }
  }
  return run.good() ? 0 : kFailed;
}

}  // namespace

int main(int argc, char** argv) {
  insertion::Options options;
  const int code = insertion::read_options(argc, argv, &options);
  if (code >= 0) {
    return code;
  }
  try {
    return insert(options);
  } catch (const insertion::BadInput& error) {
    std::cerr << (*error.what() == 0 ? "" : "insertion: ") << error.what() << (*error.what() == 0 ? "" : "\n");
    return kBadInput;
  } catch (const std::invalid_argument& error) {  // of the route
    std::cerr << "insertion: " << error.what() << '\n';
    return kBadInput;
  } catch (const std::exception& error) {
    std::cerr << "insertion: " << error.what() << '\n';
    return kFailed;
  }
}
