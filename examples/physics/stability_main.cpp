// Runs the stability table and the extreme cases: stability [--quick] [--out FOLDER]
//
// Writes stability.csv, extremes.csv and stability.json (both tables and a summary), and two curves out of the table: energy_drift and
// largest_stretch (see curve.h). Prints a summary, a key and its value in each line. Exit code 1: the library broke its promise, or implicit
// Euler is unstable somewhere; 2: an option or file can't be used.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <utility>

#include "curve.h"
#include "extremes.h"
#include "options.h"
#include "stability.h"
#include "table.h"

namespace {

using physics::Outcome;
using physics::Row;
using physics::Table;

constexpr double kStiffnesses[] = {1e-2, 1e-1, 1, 1e2, 1e4, 1e6, 1e8, 1e10, 1e12};
constexpr double kCurveStep = 1e-3;  // time step of the curves
constexpr physics::Integrator kIntegrators[] = {physics::Integrator::kSymplecticEuler,
                                                physics::Integrator::kImplicitEuler, physics::Integrator::kXpbd};

struct Summary {
  Outcome all;
  std::size_t rows = 0,
              refused_rows[3] = {0, 0, 0};  // by integrator: rows in which physics handed over what is no number
  double stable_up_to[3] = {0, 0, 0};       // by integrator: stiffness at which all time steps are stable, and below
  bool all_touch = true;                    // something was met in every scene with walls
  bool all_go_on = true;
};

void add_outcome(const Outcome& outcome, Row* row) {
  row->add("steps", static_cast<double>(outcome.steps)).add("contacts", static_cast<double>(outcome.contacts));
  row->add("rubbing", static_cast<double>(outcome.rubbing)).add("refused", static_cast<double>(outcome.refused));
  row->add("nonfinite", static_cast<double>(outcome.nonfinite));
  row->add("not_free", static_cast<double>(outcome.not_free)).add("lost", static_cast<double>(outcome.lost));
}

Row row_of(const physics::StabilityRow& r) {
  Row row;
  row.add("integrator", physics::name_of(r.integrator)).add("stiffness", r.stiffness).add("dt", r.dt);
  row.add("stable", physics::is_stable(r) ? 1 : 0).add("energy_drift", r.energy_drift);
  row.add("energy_largest", r.energy_largest).add("kinetic_largest", r.kinetic_largest);
  row.add("momentum_change", r.momentum_change);
  row.add("largest_stretch", r.largest_stretch).add("pressed_stretch", r.pressed_stretch);
  row.add("contacts_posts", static_cast<double>(r.posts.contacts));
  row.add("contacts_pressed", static_cast<double>(r.pressed.contacts));
  row.add("contacts_surface", static_cast<double>(r.surface.contacts));
  row.add("contacts_walls", static_cast<double>(r.walls.contacts));
  add_outcome(r.all(), &row);
  return row;
}

std::vector<physics::StabilityRow> run_grid(bool quick, Summary* summary) {
  const std::vector<double> time_steps =
      quick ? std::vector<double>{1e-5, 1e-3, 1e-1} : std::vector<double>{1e-5, 1e-4, 1e-3, 1e-2, 1e-1};
  std::vector<physics::StabilityRow> grid;
  for (int n = 0; n < 3; ++n) {
    bool stable_so_far = true;
    for (const double stiffness : kStiffnesses) {
      for (const double dt : time_steps) {
        grid.push_back(physics::run_stability(kIntegrators[n], stiffness, dt, quick ? 40 : 200));
        const physics::StabilityRow& r = grid.back();
        summary->all.add(r.all());
        summary->rows += 1;
        summary->refused_rows[n] += r.all().refused > 0 ? 1 : 0;
        for (const Outcome* outcome : {&r.posts, &r.pressed, &r.surface, &r.walls}) {
          summary->all_touch = summary->all_touch && outcome->contacts > 0;
        }
        stable_so_far = stable_so_far && physics::is_stable(r);
      }
      summary->stable_up_to[n] = stable_so_far ? stiffness : summary->stable_up_to[n];
    }
    std::cerr << physics::name_of(kIntegrators[n]) << " done\n";
  }
  return grid;
}

Table run_extremes(bool quick, Summary* summary) {
  Table table;
  for (const physics::Extreme& extreme : physics::run_extremes(quick ? 1000 : 1000000)) {
    Row row;
    row.add("case", extreme.name);
    add_outcome(extreme.outcome, &row);
    row.add("largest_coordinate", extreme.largest).add("goes_on", extreme.goes_on ? 1 : 0);
    row.add("what_happened", physics::what_happened(extreme));
    table.push_back(row);
    Outcome outcome = extreme.outcome;
    outcome.refused = 0;  // here it is what is asked for
    summary->all.add(outcome);
    summary->all_go_on = summary->all_go_on && extreme.goes_on;
  }
  std::cerr << "extreme cases done\n";
  return table;
}

Row row_of(const Summary& summary) {
  Row row;
  add_outcome(summary.all, &row);
  row.add("free_rows", static_cast<double>(summary.rows));
  row.add("all_touch", summary.all_touch ? 1 : 0).add("extremes_go_on", summary.all_go_on ? 1 : 0);
  for (int n = 0; n < 3; ++n) {
    const std::string name = physics::name_of(kIntegrators[n]);
    row.add(name + "_max_stable_k", summary.stable_up_to[n]);
    row.add(name + "_refused_rows", static_cast<double>(summary.refused_rows[n]));
  }
  return row;
}

std::vector<std::pair<std::string, double>> figures_of(const Summary& summary) {
  const auto number = [](std::size_t count) { return static_cast<double>(count); };
  const Outcome& o = summary.all;
  return {{"stability.nonfinite", number(o.nonfinite)},
          {"stability.not_free", number(o.not_free)},
          {"stability.lost", number(o.lost)},
          {"stability.implicit_max_stable_k", summary.stable_up_to[1]},
          {"stability.xpbd_max_stable_k", summary.stable_up_to[2]},
          {"stability.symplectic_max_stable_k", summary.stable_up_to[0]},
          {"stability.refused", number(o.refused)},
          {"stability.free_rows", number(summary.rows)},
          {"stability.steps", number(o.steps)},
          {"stability.contacts", number(o.contacts)},
          {"stability.rubbing", number(o.rubbing)}};
}

// Energy drift or stretch of the free rod over stiffness.
physics::CurvePanel panel_of(const std::vector<physics::StabilityRow>& grid, bool energy) {
  physics::CurvePanel panel{"m/dt^2", "step", energy ? "energy drift" : "largest stretch", "share", {}};
  for (const physics::StabilityRow& r : grid) {
    if (r.dt != kCurveStep) {
      continue;
    }
    const double error = energy ? std::abs(r.energy_drift) : r.largest_stretch;
    const double seconds = r.free.seconds / static_cast<double>(r.free.steps);
    panel.points.push_back({physics::name_of(r.integrator), r.stiffness, seconds, error, r.free.steps,
                            physics::is_stable(r) ? "" : "explodes"});
  }
  return panel;
}

bool write_curves(const std::string& folder, const std::vector<physics::StabilityRow>& grid, const Summary& summary) {
  using physics::in_words;
  const physics::CurvePanel drift = panel_of(grid, true), stretch = panel_of(grid, false);
  const auto error_at = [](const physics::CurvePanel& panel, int integrator, double stiffness) {
    for (const physics::CurvePoint& point : panel.points) {
      if (point.method == physics::name_of(kIntegrators[integrator]) && point.setting == stiffness) {
        return point.error;
      }
    }
    return std::nan("");
  };
  const double limit = summary.stable_up_to[0];
  double most = 0;
  for (const physics::StabilityRow& r : grid) {
    most = r.integrator == kIntegrators[1] ? std::max(most, r.energy_largest) : most;
  }
  return physics::write_curve(folder, "energy_drift", {drift},
                              "Symplectic Euler up to a stiffness of " + in_words(limit) +
                                  " m/dt^2, where it keeps the energy to " + in_words(error_at(drift, 0, limit)) +
                                  "; implicit Euler beyond it, which loses " + in_words(error_at(drift, 1, 1e12)) +
                                  " of the energy of a tumbling rod at 1e12 and never has more than " + in_words(most) +
                                  " times what it began with; not XPBD where energy counts: " +
                                  "what its sweeps leave of a stretch holds " + in_words(error_at(drift, 2, 1e12)) +
                                  " times the energy put in at 1e12.") &&
         physics::write_curve(
             folder, "largest_stretch", {stretch},
             "Implicit Euler: lengths hold to " + in_words(error_at(stretch, 1, 1e4)) + " at 1e4 m/dt^2 and to " +
                 in_words(error_at(stretch, 1, 1e12)) + " at 1e12; XPBD stays at " +
                 in_words(error_at(stretch, 2, 1e12)) +
                 " however stiff its springs are, until it gets more sweeps; symplectic Euler has exploded beyond " +
                 in_words(limit) + ".");
}

bool write_files(const std::string& folder, const Table& grid, const Table& extremes, const Summary& summary) {
  std::ofstream stability_csv(folder + "/stability.csv"), extremes_csv(folder + "/extremes.csv");
  std::ofstream json(folder + "/stability.json");
  json.precision(15);
  physics::write_csv(grid, stability_csv);
  physics::write_csv(extremes, extremes_csv);
  json << "{\n";
  for (const auto& [key, value] : figures_of(summary)) {
    json << "  \"" << key << "\": " << value << ",\n";
  }
  json << "  \"summary\": ";
  row_of(summary).write_json(json);
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

}  // namespace

int main(int argc, char** argv) {
  const std::optional<physics::MeasureArguments> options = physics::read_options(argc, argv, "stability");
  if (!options) {
    return 2;
  }
  const auto& [quick, folder] = *options;
  try {
    Summary summary;
    const std::vector<physics::StabilityRow> grid = run_grid(quick, &summary);
    const Table extremes = run_extremes(quick, &summary);
    Table rows;
    for (const physics::StabilityRow& r : grid) {
      rows.push_back(row_of(r));
    }
    std::cout.precision(15);
    for (const auto& [key, value] : figures_of(summary)) {
      std::cout << key << ' ' << value << '\n';
    }
    if (!write_files(folder, rows, extremes, summary) || !write_curves(folder, grid, summary)) {
      std::cerr << "stability: cannot write to '" << folder << "'\n";
      return 2;
    }
    const Outcome& o = summary.all;
    const bool kept = o.nonfinite + o.not_free + o.lost == 0 && summary.all_touch && summary.all_go_on;
    return kept && summary.stable_up_to[1] >= 1e12 ? 0 : 1;
  } catch (const std::exception& error) {
    std::cerr << "stability: " << error.what() << '\n';
    return 1;
  }
}
