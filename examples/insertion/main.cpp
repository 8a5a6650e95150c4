// The main job: dartsweep_insertion pushes a catheter through a vascular network ([JCD10] figure 8).
//
// Every step is verified. Exit code 1: the catheter was not free at some step, or lost; 2: what was given can't be used.
#include <iostream>

#include "insertion.h"

namespace {

constexpr int kFailed = 1, kBadInput = 2;

}  // namespace

int main(int argc, char** argv) {
  insertion::Options options;
  const int code = insertion::read_options(argc, argv, &options);
  if (code >= 0) {
    return code;
  }
  try {
    return insertion::insert(options) ? 0 : kFailed;
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
