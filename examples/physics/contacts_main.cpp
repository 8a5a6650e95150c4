// Stability in contact: contacts [--quick] [--out FOLDER]
//
// Writes contact_stability.csv, a row for each case.
// Prints a summary, a key and its value in each line: also how many rows each cause made unstable, and each row with few contacts.
// --quick: no random corners, every third value of an axis. Exit code 1: the library broke its promise, more than 2 % of the rows
// have less than 100 contacts, less than 1,000 have them (not with --quick), or an unstable row or one with few contacts has no
// cause; 2: an option or file can't be used.
#include <fstream>
#include <iostream>
#include <map>
#include <string>
#include <vector>

#include "contact_stability.h"
#include "options.h"
#include "table.h"

namespace {

using physics::ContactCase;
using physics::ContactRow;

constexpr std::size_t kContacts = 100, kLeastRows = 1000;
constexpr int kLeastSteps = 60, kMostSteps = 12000;  // some rows hardly touch while their walls sink

physics::Row row_of(const ContactRow& r) {
  const auto number = [](std::size_t count) { return static_cast<double>(count); };
  const ContactCase& c = r.asked;
  const physics::Outcome& o = r.outcome;
  physics::Row row;
  row.add("scene", physics::name_of(c.scene)).add("integrator", physics::name_of(c.integrator));
  row.add("stiffness", c.stiffness).add("dt", c.dt).add("mass_ratio", c.mass_ratio).add("friction", c.friction);
  row.add("aspect", c.aspect).add("stable", physics::is_stable(r) ? 1 : 0).add("cause", r.cause);
  row.add("energy_largest", r.energy_largest).add("largest_stretch", r.largest_stretch);
  row.add("largest_force", r.largest_force).add("steps", number(o.steps)).add("contacts", number(o.contacts));
  row.add("refused", number(o.refused)).add("nonfinite", number(o.nonfinite));
  row.add("not_free", number(o.not_free)).add("lost", number(o.lost));
  return row;
}

struct Summary {
  physics::Outcome all;
  std::size_t rows = 0, unstable = 0, unnamed = 0;
  std::map<std::string, std::size_t> causes;  // of unstable rows
  std::vector<ContactRow> few;                // rows with few contacts
};

void add(const ContactRow& row, Summary* summary) {
  const bool stable = physics::is_stable(row), touches = row.outcome.contacts >= kContacts;
  summary->all.add(row.outcome);
  summary->rows += touches ? 1 : 0;
  if (!touches) {
    summary->few.push_back(row);
  }
  summary->unstable += stable ? 0 : 1;
  summary->unnamed += !(stable && touches) && row.cause.empty() ? 1 : 0;
  if (!stable) {
    ++summary->causes[row.cause];
  }
}

void print(const Summary& s) {
  std::cout << "stability.rows " << s.rows << "\nstability.rows_with_few_contacts " << s.few.size()
            << "\nstability.contact_nonfinite " << s.all.nonfinite << "\nstability.contact_not_free " << s.all.not_free
            << "\nstability.contact_lost " << s.all.lost << "\nstability.unstable_rows " << s.unstable
            << "\nstability.rows_without_cause " << s.unnamed << "\nstability.contact_steps " << s.all.steps
            << "\nstability.contacts_met " << s.all.contacts << '\n';
  for (const auto& [cause, count] : s.causes) {
    std::cout << "stability.unstable_by " << count << ' ' << (cause.empty() ? "unknown" : cause) << '\n';
  }
  for (const ContactRow& row : s.few) {
    const ContactCase& c = row.asked;
    std::cout << "stability.few_contacts " << row.outcome.contacts << ' ' << physics::name_of(c.scene) << ", "
              << physics::name_of(c.integrator) << ", stiffness " << c.stiffness << ", time step " << c.dt
              << ", mass ratio " << c.mass_ratio << ", friction " << c.friction << ", aspect " << c.aspect
              << "; cause: " << (row.cause.empty() ? "unknown" : row.cause) << '\n';
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::optional<physics::MeasureArguments> options = physics::read_options(argc, argv, "contacts");
  if (!options) {
    return 2;
  }
  const auto& [quick, folder] = *options;
  try {
    Summary summary;
    physics::Table table;
    for (const ContactCase& each : quick ? physics::contact_cases(0, 3) : physics::contact_cases(12)) {
      const ContactRow row = physics::run_contacts_with_cause(each, kLeastSteps, kMostSteps, kContacts);
      table.push_back(row_of(row));
      add(row, &summary);
    }
    print(summary);
    std::ofstream csv(folder + "/contact_stability.csv");
    physics::write_csv(table, csv);
    csv.close();
    if (!csv) {
      std::cerr << "contacts: cannot write to '" << folder << "'\n";
      return 2;
    }
    const physics::Outcome& o = summary.all;
    // Physics that is stuck or floats away meets little.
    const bool touch = 50 * summary.few.size() <= summary.rows && (quick || summary.rows >= kLeastRows);
    return touch && o.nonfinite + o.not_free + o.lost + summary.unnamed == 0 ? 0 : 1;
  } catch (const std::exception& error) {
    std::cerr << "contacts: " << error.what() << '\n';
    return 1;
  }
}
