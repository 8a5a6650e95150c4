#include "table.h"

#include <cmath>
#include <cstdio>

namespace physics {

Row& Row::add(const std::string& name, const std::string& text) {
  values_.emplace_back(name, '"' + text + '"');
  return *this;
}

Row& Row::add(const std::string& name, double number) {
  char text[32] = "null";
  if (std::isfinite(number)) {
    std::snprintf(text, sizeof text, "%.6g", number);
  }
  values_.emplace_back(name, text);
  return *this;
}

void Row::write_json(std::ostream& out) const {
  const char* before = "{";
  for (const auto& value : values_) {
    out << before << '"' << value.first << "\": " << value.second;
    before = ", ";
  }
  out << '}';
}

void Row::write_csv(std::ostream& out, bool heading) const {
  const char* before = "";
  for (const auto& value : values_) {
    const std::string& text = value.second;
    const bool quoted = text.front() == '"';
    out << before << (heading ? value.first : quoted ? text.substr(1, text.size() - 2) : text == "null" ? "" : text);
    before = ",";
  }
  out << '\n';
}

void write_csv(const Table& table, std::ostream& out) {
  if (!table.empty()) {
    table.front().write_csv(out, true);
  }
  for (const Row& row : table) {
    row.write_csv(out, false);
  }
}

void write_json(const Table& table, std::ostream& out) {
  const char* before = "[\n";
  for (const Row& row : table) {
    out << before << "    ";
    row.write_json(out);
    before = ",\n";
  }
  out << (table.empty() ? "[]" : "\n  ]");
}

}  // namespace physics
