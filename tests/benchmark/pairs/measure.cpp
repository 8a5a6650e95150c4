#include "measure.h"

#include "../timing.h"

#include <cmath>

namespace dsw::pairs {

std::vector<Measured> measure(const std::vector<Query>& queries, const std::vector<Method*>& methods,
                              const MeasureOptions& options) {
  const std::unique_ptr<Method> nothing = make_nothing();
  std::vector<Method*> asked = {nothing.get()};
  asked.insert(asked.end(), methods.begin(), methods.end());
  std::vector<Measured> found(asked.size());
  for (int round = 0; round < options.rounds; ++round) {
    for (std::size_t m = 0; m < asked.size(); ++m) {
      Method& method = *asked[m];
      Measured& mine = found[m];
      const std::size_t count = round == 0 ? queries.size() : mine.answers.size();
      double total = 0;
      const bool has_budget = round == 0 && m > 1;  // neither the clock nor the first method has one
      for (std::size_t i = 0; i < count && !(has_budget && total > options.set_budget_ns); ++i) {
        if (round > 2 && mine.ns[i] > options.long_query_ns) continue;
        method.prepare(queries[i]);
        Answer answer{};
        const double ns = bench::time_ns([&] { answer = method.ask(); });
        total += ns;
        if (round == 0) {
          mine.answers.push_back(answer);
          mine.ns.push_back(ns);
        } else {
          mine.ns[i] = std::min(mine.ns[i], ns);
        }
      }
    }
  }
  const double clock = bench::median(found[0].ns);
  found.erase(found.begin());
  for (Measured& method : found) {
    for (double& ns : method.ns) ns = std::max(ns - clock, 0.0);
  }
  return found;
}

Judged judge(const std::vector<Query>& queries, const std::vector<Truth>& truths, const Measured& measured, int kind) {
  Judged judged;
  std::vector<double> ns, off;
  double sum = 0;
  for (std::size_t i = 0; i < measured.answers.size(); ++i) {
    if (kind >= 0 && queries[i].kind != kind) continue;
    const Answer& answer = measured.answers[i];
    const Truth& truth = truths[i];
    ++judged.queries;
    judged.missed += queries[i].set_truth && !answer.touches ? 1 : 0;
    judged.invented += !queries[i].set_truth && answer.touches ? 1 : 0;
    ns.push_back(measured.ns[i]);
    sum += measured.ns[i];
    if (!answer.touches || !truth.touches) continue;
    ++judged.touching;
    // No double lies between the exact time and the largest one that is not later.
    judged.late += answer.time > truth.time ? 1 : 0;
    judged.time_error += answer.time != truth.time ? 1 : 0;
    if (std::isfinite(answer.time)) off.push_back(std::fabs(answer.time - truth.time));
  }
  judged.time_off_median = bench::median(off);
  judged.time_off_max = off.empty() ? 0 : *std::max_element(off.begin(), off.end());
  judged.ns_median = bench::median(ns);
  judged.ns_mean = ns.empty() ? 0 : sum / static_cast<double>(ns.size());
  judged.ns_p999 = bench::quantile(ns, 0.999);
  judged.ns_max = ns.empty() ? 0 : *std::max_element(ns.begin(), ns.end());
  return judged;
}

}  // namespace dsw::pairs
