// Responses [JCD10] 4.2: on how many panels of figure 5, in space and in the plane, each gives its own, expected
// result.
#include "parts.h"

#include "scenes/figure5.h"

namespace dsw::bench {

void run_figure5(const Options&, Report& report) {
  const figure5_options options = figure5_default_options();
  int held = 0, expected = 0;
  for (const std::uint32_t dimension : {2u, 3u}) {
    for (int panel = 0; panel < FIGURE5_PANELS; ++panel) {
      figure5_answer answer;
      const bool done = figure5_run(dimension, static_cast<figure5_panel>(panel), &options, &answer) != 0;
      // Its own: no other panel expects the same.
      int fits = 0;
      for (int other = 0; other < FIGURE5_PANELS; ++other) {
        fits += figure5_is_expected(static_cast<figure5_panel>(other), &answer);
      }
      held += done && fits == 1 && figure5_is_expected(static_cast<figure5_panel>(panel), &answer) != 0 ? 1 : 0;
      ++expected;
    }
  }
  report.set("response.figure5_panels", held);
  report.set("response.figure5_panels_expected", expected);
}

}  // namespace dsw::bench
