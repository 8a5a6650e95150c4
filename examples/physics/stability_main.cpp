// Runs the stability table and the extreme cases: stability [--quick] [--out FOLDER]
//
// Writes stability.csv, extremes.csv and stability.json (both tables and a summary). Exit code 1: the library broke its promise, or implicit
// Euler is unstable somewhere; 2: an option or file can't be used.
#include <getopt.h>

#include <algorithm>
#include <fstream>
#include <iostream>

#include "extremes.h"
#include "stability.h"
#include "table.h"

namespace {

using physics::Outcome;
using physics::Row;
using physics::Table;

constexpr physics::Integrator kIntegrators[] = {physics::Integrator::kSymplecticEuler,
                                                physics::Integrator::kImplicitEuler, physics::Integrator::kXpbd};

struct Summary {
  Outcome all;
  double stable_up_to[3] = {0, 0, 0};  // by integrator: stiffness at which all time steps are stable, and below
  bool all_go_on = true;

  void add(const Outcome& o) {
    all.steps += o.steps;
    all.contacts += o.contacts;
    all.nonfinite += o.nonfinite;
    all.refused += o.refused;
    all.not_free += o.not_free;
    all.lost += o.lost;
  }
};

void add_outcome(const Outcome& outcome, Row* row) {
  row->add("steps", static_cast<double>(outcome.steps)).add("contacts", static_cast<double>(outcome.contacts));
  row->add("nonfinite", static_cast<double>(outcome.nonfinite)).add("refused", static_cast<double>(outcome.refused));
  row->add("not_free", static_cast<double>(outcome.not_free)).add("lost", static_cast<double>(outcome.lost));
}

Table run_grid(bool quick, Summary* summary) {
  const std::vector<double> time_steps =
      quick ? std::vector<double>{1e-5, 1e-1} : std::vector<double>{1e-5, 1e-4, 1e-3, 1e-2, 1e-1};
  Table table;
  for (int n = 0; n < 3; ++n) {
    bool stable_so_far = true;
    for (const double stiffness : {1e-2, 1e-1, 1.0, 1e2, 1e4, 1e6, 1e8, 1e10, 1e12}) {
      for (const double dt : time_steps) {
        const physics::StabilityRow r = physics::run_stability(kIntegrators[n], stiffness, dt, quick ? 50 : 200);
        Row row;
        row.add("integrator", physics::name_of(r.integrator)).add("stiffness", stiffness).add("dt", dt);
        row.add("stable", physics::is_stable(r) ? 1 : 0).add("energy_drift", r.energy_drift);
        row.add("energy_largest", r.energy_largest).add("kinetic_largest", r.kinetic_largest);
        row.add("momentum_change", r.momentum_change);
        row.add("largest_stretch", r.largest_stretch).add("contact_stretch", r.contact_stretch);
        Summary both;
        both.add(r.free);
        both.add(r.contact);
        add_outcome(both.all, &row);
        table.push_back(row);
        summary->add(both.all);
        stable_so_far = stable_so_far && physics::is_stable(r);
      }
      summary->stable_up_to[n] = stable_so_far ? stiffness : summary->stable_up_to[n];
    }
    std::cerr << physics::name_of(kIntegrators[n]) << " done\n";
  }
  return table;
}

Table run_extremes(bool quick, Summary* summary) {
  Table table;
  for (const physics::Extreme& extreme : physics::run_extremes(quick ? 1000 : 1000000)) {
    Row row;
    row.add("case", extreme.name);
    add_outcome(extreme.outcome, &row);
    row.add("largest_coordinate", extreme.largest).add("goes_on", extreme.goes_on ? 1 : 0);
    table.push_back(row);
    Outcome outcome = extreme.outcome;
    outcome.refused = 0;  // here it is what is asked for
    summary->add(outcome);
    summary->all_go_on = summary->all_go_on && extreme.goes_on;
  }
  std::cerr << "extreme cases done\n";
  return table;
}

Row row_of(const Summary& summary) {
  Row row;
  add_outcome(summary.all, &row);
  row.add("extremes_go_on", summary.all_go_on ? 1 : 0);
  for (int n = 0; n < 3; ++n) {
    row.add(std::string(physics::name_of(kIntegrators[n])) + "_max_stable_k", summary.stable_up_to[n]);
  }
  return row;
}

bool write_files(const std::string& folder, const Table& grid, const Table& extremes, const Row& summary) {
  std::ofstream stability_csv(folder + "/stability.csv"), extremes_csv(folder + "/extremes.csv");
  std::ofstream json(folder + "/stability.json");
  physics::write_csv(grid, stability_csv);
  physics::write_csv(extremes, extremes_csv);
  json << "{\n  \"summary\": ";
  summary.write_json(json);
  json << ",\n  \"stability\": ";
  physics::write_json(grid, json);
  json << ",\n  \"extremes\": ";
  physics::write_json(extremes, json);
  json << "\n}\n";
  stability_csv.close();
  extremes_csv.close();
  json.close();
  return stability_csv && extremes_csv && json;
}

int usage() {
  std::cerr << "usage: stability [--quick] [--out FOLDER]\n";
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  static const option kOptions[] = {
      {"quick", no_argument, nullptr, 'q'}, {"out", required_argument, nullptr, 'o'}, {nullptr, 0, nullptr, 0}};
  bool quick = false;
  std::string folder = ".";
  for (int letter; (letter = getopt_long(argc, argv, "", kOptions, nullptr)) != -1;) {
    if (letter == 'q') {
      quick = true;
    } else if (letter == 'o') {
      folder = optarg;
    } else {
      return usage();
    }
  }
  if (optind != argc) {
    return usage();
  }
  try {
    Summary summary;
    const Table grid = run_grid(quick, &summary), extremes = run_extremes(quick, &summary);
    const Row row = row_of(summary);
    row.write_json(std::cout);
    std::cout << '\n';
    if (!write_files(folder, grid, extremes, row)) {
      std::cerr << "stability: cannot write to '" << folder << "'\n";
      return 2;
    }
    const Outcome& o = summary.all;
    return o.nonfinite + o.not_free + o.lost > 0 || !summary.all_go_on || summary.stable_up_to[1] < 1e12 ? 1 : 0;
  } catch (const std::exception& error) {
    std::cerr << "stability: " << error.what() << '\n';
    return 1;
  }
}
