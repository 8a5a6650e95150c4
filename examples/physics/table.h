// Rows of named values, written as CSV or JSON.
#ifndef DARTSWEEP_PHYSICS_TABLE_H
#define DARTSWEEP_PHYSICS_TABLE_H

#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace physics {

class Row {
 public:
  // Names are plain words. Text may have commas and quotes in it.
  Row& add(const std::string& name, const std::string& text);
  Row& add(const std::string& name, const char* text) { return add(name, std::string(text)); }
  // Six digits, counts in full; what is no number becomes null in JSON, and nothing in CSV.
  Row& add(const std::string& name, double number);

  void write_json(std::ostream& out) const;
  void write_csv(std::ostream& out, bool heading) const;

 private:
  std::vector<std::pair<std::string, std::string>> values_;  // as JSON
};

using Table = std::vector<Row>;

// All rows must have the same names in the same order.
void write_csv(const Table& table, std::ostream& out);
void write_json(const Table& table, std::ostream& out);

}  // namespace physics

#endif
