#include <algorithm>
#include <cmath>

#include "curve.h"
#include "dials.h"
#include "fold.h"

namespace physics {
namespace {

constexpr int kPressed = 100;  // steps
constexpr int kFineCells = 40;

// A body lies on the ridge by one end, so that it tips over while it folds.
FoldOptions options_of(FoldBody body, double omega, int cells) {
  FoldOptions options;
  options.body = body;
  options.omega = omega;
  options.cells = cells;
  options.aside = 1;
  options.press = kPressed;
  options.lift = options.rest = 0;
  return options;
}

std::vector<FoldStep> run(const FoldOptions& options, double* seconds) {
  Fold fold(options);
  std::vector<FoldStep> steps;
  const double start = processor_seconds();
  while (!fold.is_over()) {
    steps.push_back(fold.step());
  }
  *seconds = (processor_seconds() - start) / kPressed;
  return steps;
}

}  // namespace

bool measure_omega(const std::string& folder, bool quick) {
  CurvePanel turned{"omega", "step", "rotation, against that of a body of 40 cells", "degrees", {}};
  CurvePanel added{"omega", "step", "rotation that inserted vertices add to equation 1", "degrees", {}};
  const std::vector<double> omegas =
      quick ? std::vector<double>{0, 0.3, 1, 3, 10} : std::vector<double>{0, 0.1, 0.2, 0.5, 0.7, 1, 1.4, 2, 3, 5, 10};
  std::string advice;
  for (const FoldBody body : {FoldBody::kBar, FoldBody::kSheet}) {
    double seconds = 0;
    const std::vector<FoldStep> fine = run(options_of(body, 0, kFineCells), &seconds);
    const std::size_t first = turned.points.size();
    for (const double omega : omegas) {
      const std::vector<FoldStep> steps = run(options_of(body, omega, FoldOptions().cells), &seconds);
      double off = 0, more = 0;
      std::size_t most = 0;
      for (std::size_t k = 0; k < steps.size(); ++k) {
        off += std::abs(steps[k].turned - fine[k].turned) / kPressed;
        more += steps[k].unwanted / kPressed;
        most = std::max(most, steps[k].vertices);
      }
      const std::string note = std::to_string(most) + " vertices at most";
      turned.points.push_back({name_of(body), omega, seconds, off, kPressed, note});
      // With omega 0 they are not in the sums; what is measured there is rounding.
      added.points.push_back({name_of(body), omega, seconds, omega == 0 ? 0 : more, kPressed, note});
    }
    const auto begin = turned.points.begin() + static_cast<std::ptrdiff_t>(first);
    const CurvePoint& best = *std::min_element(
        begin, turned.points.end(), [](const CurvePoint& a, const CurvePoint& b) { return a.error < b.error; });
    const CurvePoint& worst = turned.points.back();
    advice += (advice.empty() ? "" : " ") + std::string("Take omega ") + in_words(best.setting) + " for the " +
              name_of(body) + ": its rotation then is " + in_words(best.error) +
              " degrees from that of a body of 40 cells, in the mean; with omega 0 it is " + in_words(begin->error) +
              ", with omega " + in_words(worst.setting) + " " + in_words(worst.error) + ".";
  }
  return write_curve(folder, "omega", {turned, added}, advice);
}

}  // namespace physics
