#include "curve.h"

#include "../timing.h"

#include <cstdarg>
#include <cstdio>
#include <fstream>
#include <stdexcept>

namespace dsw::curves {

namespace {

/** A field of a CSV line: in quotes where it needs them. */
std::string field(const std::string& value) {
  if (value.find_first_of(",\"\n") == std::string::npos) return value;
  std::string quoted = "\"";
  for (const char c : value) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

}  // namespace

std::string text(const char* format, ...) {
  char buffer[400];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(buffer, sizeof buffer, format, arguments);
  va_end(arguments);
  return buffer;
}

void Curve::write(const std::string& folder) const {
  std::ofstream table(folder + "/" + name + ".csv"), below(folder + "/" + name + ".txt");
  table << "curve,method,setting,setting_unit,seconds_per_item,item,error_name,error,error_unit,count,note\n";
  std::printf("%s: %s [%s], seconds per %s\n", name.c_str(), error_name.c_str(), error_unit.c_str(), item.c_str());
  for (const Point& p : points) {
    table << name << ',' << field(p.method) << ',' << field(p.setting) << ',' << field(p.unit) << ','
          << text("%.6g", p.seconds) << ',' << field(item) << ',' << field(error_name) << ',' << text("%.6g", p.error)
          << ',' << field(error_unit) << ',' << p.count << ',' << field(p.note) << '\n';
    std::printf("  %-34s %8s %-12s %10.3e s %10.3e of %zu  %s\n", p.method.c_str(), p.setting.c_str(), p.unit.c_str(),
                p.seconds, p.error, p.count, p.note.c_str());
  }
  below << advice << '\n';
  std::printf("  %s\n", advice.c_str());
  table.close();
  below.close();
  if (!table || !below) throw std::runtime_error("cannot write " + folder + "/" + name + ".csv");
}

double Errors::mean() const {
  double sum = 0;
  for (const double e : values) sum += e;
  return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

double Errors::most() const { return values.empty() ? 0 : *std::max_element(values.begin(), values.end()); }

std::string Errors::spread() const { return text("median %.2g, largest %.2g", bench::median(values), most()); }

std::vector<double> time_methods(const std::vector<Method>& methods, std::size_t items, int rounds) {
  std::vector<std::vector<double>> times(methods.size());
  for (int round = -1; round < rounds; ++round) {
    for (std::size_t i = 0; i < methods.size(); ++i) {
      if (methods[i].prepare) methods[i].prepare();
      const double ns = bench::cpu_time_ns(methods[i].run);
      if (round >= 0) times[i].push_back(1e-9 * ns / static_cast<double>(items));
    }
  }
  std::vector<double> seconds;
  for (auto& t : times) seconds.push_back(bench::median(std::move(t)));
  return seconds;
}

}  // namespace dsw::curves
