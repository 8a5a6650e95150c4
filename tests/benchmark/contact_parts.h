// The parts of the benchmark that only ask the library: what contacts cost, and how much of a motion they leave.
#ifndef DARTSWEEP_TESTS_BENCHMARK_CONTACT_PARTS_H
#define DARTSWEEP_TESTS_BENCHMARK_CONTACT_PARTS_H

#include "report.h"

#include <string>

namespace dsw::bench {

struct ContactOptions {
  bool quick = false;
  std::string mesh;          // file of examples/demo/read_mesh.py, or empty
  std::string vessel, line;  // files of read_mesh.py and of its centreline, or empty: of the vessel that beats
  std::string moves;         // folder that keeps the catheter's recorded moves, or empty
  std::string counted;       // what valgrind is to count: catheter or self; or empty
};

void run_contact(const ContactOptions& options, Report& report);
void run_response(Report& report);
void run_beating(const ContactOptions& options, Report& report);

}  // namespace dsw::bench

#endif
