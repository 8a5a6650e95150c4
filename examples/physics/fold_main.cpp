// A soft body folds over a ridge and unfolds [JCD10] 7.3: fold [--body BODY] [--omega NUMBER] [--negligible NUMBER]
// [--out FOLDER]
//
// BODY is bar, sheet, surface or plane; without it all of them run. Writes fold_BODY.csv, a row for each step, and
// fold_BODY.svg. Prints a summary, a key and its value in each line. Every step is verified by other calls than those
// that moved the body. Exit code 1: a step was not free, nothing was inserted, or the body is not what it was at
// first; 2: an option or a file can't be used.
#include <getopt.h>

#include <cmath>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <iostream>

#include "fold_picture.h"
#include "table.h"

namespace {

using physics::Fold;
using physics::FoldOptions;
using physics::FoldStep;

// How far an original vertex may be at the end from where it was at rest, over the radius of the shape.
constexpr double kTolerance = 1e-3;

int usage() {
  std::cerr << "usage: fold [--body bar|sheet|surface|plane] [--omega NUMBER] [--negligible NUMBER] [--out FOLDER]\n";
  return 2;
}

bool read_number(const char* text, double* number) {
  char* end = nullptr;
  *number = std::strtod(text, &end);
  return end != text && *end == '\0' && std::isfinite(*number) && *number >= 0;
}

physics::Row row_of(const FoldStep& step) {
  physics::Row row;
  row.add("step", step.step).add("phase", step.phase).add("vertices", static_cast<double>(step.vertices));
  row.add("edges", static_cast<double>(step.edges)).add("inserted", static_cast<double>(step.inserted));
  row.add("removed", static_cast<double>(step.removed)).add("contacts", static_cast<double>(step.contacts));
  row.add("largest_pull", step.largest_pull).add("removed_pull", step.removed_pull).add("bend", step.bend);
  row.add("turned", step.turned).add("unwanted", step.unwanted);
  row.add("not_free", static_cast<double>(step.validation.not_free))
      .add("lost", static_cast<double>(step.validation.lost));
  return row;
}

// Returns the exit code.
int run(const FoldOptions& options, const std::string& folder) {
  const std::string name = physics::name_of(options.body);
  Fold fold(options);
  physics::Table table;
  std::vector<FoldStep> steps;
  std::vector<physics::FoldView> views = {view_of(fold, "at first")};
  std::size_t inserted = 0, removed = 0, most = 0, free = 0;
  while (!fold.is_over()) {
    const FoldStep step = fold.step();
    table.push_back(row_of(step));
    steps.push_back(step);
    inserted += step.inserted;
    removed += step.removed;
    most = std::max(most, step.vertices);
    free += step.validation.good() ? 1 : 0;
    if (step.step + 1 == options.press) {
      views.push_back(view_of(fold, "folded"));
    } else if (step.step + 1 == options.press + options.lift) {
      views.push_back(view_of(fold, "lifted off"));
    }
  }
  views.push_back(view_of(fold, "unfolded"));
  std::ofstream csv(folder + "/fold_" + name + ".csv"), svg(folder + "/fold_" + name + ".svg");
  write_csv(table, csv);
  draw_fold(views, steps, options, svg);
  csv.close();
  svg.close();
  if (!csv || !svg) {
    std::cerr << "fold: cannot write to '" << folder << "'\n";
    return 2;
  }
  const bool same = fold.is_as_at_first();
  const double bend = steps.back().bend;
  std::cout << "fold." << name << ".steps " << steps.size() << "\nfold." << name << ".exactly_free_steps " << free
            << "\nfold." << name << ".inserted " << inserted << "\nfold." << name << ".removed " << removed << "\nfold."
            << name << ".vertices_most " << most << "\nfold." << name << ".vertices_at_end " << steps.back().vertices
            << "\nfold." << name << ".as_at_first " << same << "\nfold." << name << ".bend_at_end " << bend << "\n";
  return free == steps.size() && inserted > 0 && same && bend <= kTolerance ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  static const option kOptions[] = {{"body", required_argument, nullptr, 'b'},
                                    {"omega", required_argument, nullptr, 'w'},
                                    {"negligible", required_argument, nullptr, 'n'},
                                    {"out", required_argument, nullptr, 'o'},
                                    {nullptr, 0, nullptr, 0}};
  FoldOptions options;
  std::string body, folder = ".";
  for (int letter; (letter = getopt_long(argc, argv, "", kOptions, nullptr)) != -1;) {
    if (letter == 'b') {
      body = optarg;
    } else if (letter == 'o') {
      folder = optarg;
    } else if ((letter != 'w' && letter != 'n') ||
               !read_number(optarg, letter == 'w' ? &options.omega : &options.negligible)) {
      return usage();
    }
  }
  int code = optind == argc ? -1 : 2;
  try {
    for (const physics::FoldBody each : physics::kFoldBodies) {
      if (code != 2 && (body.empty() || body == name_of(each))) {
        options.body = each;
        code = std::max(code, run(options, folder));
      }
    }
  } catch (const std::exception& error) {
    std::cerr << "fold: " << error.what() << '\n';
    return 1;
  }
  return code == -1 || (code == 2 && optind != argc) ? usage() : code;
}
