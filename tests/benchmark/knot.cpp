// The thread of examples/knot is tied into a knot round a post: every step is checked exactly for being free.
#include "parts.h"

#include "knot_type.h"
#include "thread.h"

#include <cstdio>

namespace dsw::bench {

void run_knot(Report& report) {
  std::printf("  self.knot\n");
  knot::View last;
  const knot::Figures figures = knot::tie(2400, [&](const knot::View& view) { last = view; });
  report.set("self.knot_steps", static_cast<double>(figures.steps));
  report.set("self.knot_exactly_free_steps", static_cast<double>(figures.free_steps));
  report.set("self.knot_determinant", static_cast<double>(knot::determinant(last.at)));
  report.set("self.knot_inserted", static_cast<double>(figures.inserted));
  report.set("self.knot_inserted_at_post", static_cast<double>(figures.inserted_at_post));
  report.set("self.knot_removed", static_cast<double>(figures.removed));
  report.set("self.knot_us", 1e6 * figures.seconds / static_cast<double>(figures.steps));
}

}  // namespace dsw::bench
