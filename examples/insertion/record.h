// What a run leaves behind for tables, viewers and the page: steps.csv, insertion.json and .vtu files of the last state.
#ifndef DARTSWEEP_INSERTION_RECORD_H
#define DARTSWEEP_INSERTION_RECORD_H

#include <fstream>
#include <nlohmann/json.hpp>

#include "insertion.h"

namespace insertion {

using Json = nlohmann::ordered_json;

// All figures under their keys, in the order in which they are to be shown.
Json summary_of(const Options& options, const Vessel& vessel, const Run& run);
// Figures as `key value` lines, the contact table, and in one sentence what was verified.
void print(const Json& summary, const Run& run, std::ostream& out);

class Record {
 public:
  // Writes into options.out. Throws BadInput where a file cannot be written.
  Record(const Options& options, const Vessel* vessel, const Run* run);

  // After every step of the run.
  void add(const Step& step);
  // After the last one.
  void finish();

 private:
  void add_frame();
  void add_to_series();
  void write_vtu() const;

  const Options options_;
  const Vessel* vessel_;
  const Run* run_;
  std::ofstream csv_;
  Json frames_ = Json::array(), series_ = Json::object();
  std::size_t steps_ = 0;
  std::vector<Step> window_;  // steps since the last frame
};

}  // namespace insertion

#endif
