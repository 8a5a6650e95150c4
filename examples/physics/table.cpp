#include "table.h"

#include <cmath>
#include <cstdio>

namespace physics {
namespace {

// A value of JSON as CSV has it: text without its quotes, unless it has a comma or quotes in it.
std::string csv_of(const std::string& json) {
  if (json.front() != '"') {
    return json == "null" ? "" : json;
  }
  std::string text;
  bool special = false;
  for (std::size_t i = 1; i + 1 < json.size(); ++i) {
    i += json[i] == '\\' ? 1 : 0;
    special = special || json[i] == ',' || json[i] == '"';
    text += json[i] == '"' ? std::string("\"\"") : std::string(1, json[i]);
  }
  return special ? '"' + text + '"' : text;
}

}  // namespace

Row& Row::add(const std::string& name, const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    escaped += c == '"' || c == '\\' ? std::string("\\") + c : std::string(1, c);
  }
  values_.emplace_back(name, '"' + escaped + '"');
  return *this;
}

Row& Row::add(const std::string& name, double number) {
  char text[32] = "null";
  if (std::isfinite(number)) {
    const bool is_count = number == std::floor(number) && std::abs(number) < 1e9;
    std::snprintf(text, sizeof text, is_count ? "%.0f" : "%.6g", number);
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
    out << before << (heading ? value.first : csv_of(value.second));
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
