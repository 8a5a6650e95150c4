#include "curve.h"

#include <time.h>

#include <cmath>
#include <cstdio>
#include <fstream>

#include "table.h"

namespace physics {

bool write_curve(const std::string& folder, const std::string& name, const std::vector<CurvePanel>& panels,
                 const std::string& advice) {
  Table table;
  for (const CurvePanel& panel : panels) {
    for (const CurvePoint& point : panel.points) {
      if (!std::isfinite(point.error)) {
        continue;
      }
      Row row;
      row.add("curve", name).add("method", point.method);
      row.add("setting", point.setting).add("setting_unit", panel.setting_unit);
      row.add("seconds_per_item", point.seconds_per_item).add("item", panel.item);
      row.add("error_name", panel.error_name).add("error", point.error).add("error_unit", panel.error_unit);
      row.add("count", static_cast<double>(point.count)).add("note", point.note);
      table.push_back(row);
    }
  }
  std::ofstream csv(folder + "/" + name + ".csv"), text(folder + "/" + name + ".txt");
  write_csv(table, csv);
  text << advice << '\n';
  csv.close();
  text.close();
  return csv && text;
}

double processor_seconds() {
  timespec now = {};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double mean_distance(const Positions& a, const Positions& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    sum += (a[i] - b[i]).norm();
  }
  return sum / static_cast<double>(a.size());
}

std::string in_words(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g", number);
  if (number >= 100 && number < 1e4) {
    std::snprintf(text, sizeof text, "%.0f", number);  // and no exponent
  }
  return text;
}

const CurvePoint* cheapest_within(const CurvePanel& panel, const std::string& method, double error) {
  const CurvePoint* best = nullptr;
  for (const CurvePoint& point : panel.points) {
    if (point.method == method && point.error <= error &&
        (best == nullptr || point.seconds_per_item < best->seconds_per_item)) {
      best = &point;
    }
  }
  return best;
}

}  // namespace physics
