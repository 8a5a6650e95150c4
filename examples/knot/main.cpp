// Ties a thread into a knot round a post, looks after every step whether it is free, and draws it.
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "knot_type.h"
#include "picture.h"

int main(int argc, char** argv) {
  using namespace knot;
  const char* const directory = argc > 1 ? argv[1] : ".";
  const long steps = argc > 2 ? std::atol(argv[2]) : 2400;
  if (argc > 3 || steps < 24) {
    std::fprintf(stderr, "usage: %s [DIRECTORY [STEPS]], of which 24 at least\n", argv[0]);
    return 2;
  }
  try {
    std::vector<View> moments;
    View first, last;
    const std::size_t shown[] = {3, 8, 10, 13, 17, 20};  // twentieths of the steps
    const Figures figures = tie(static_cast<std::size_t>(steps), [&](const View& view) {
      if (view.step == 0) first = view;
      for (const std::size_t each : shown) {
        if (view.step == each * static_cast<std::size_t>(steps) / 20) moments.push_back(view);
      }
      last = view;
    });
    draw(moments, directory);
    const long before = determinant(first.at), after = determinant(last.at);
    const double turns = turns_round_axis(last.at);
    std::printf("%zu steps, after %zu of them exactly free: %zu edges cast, %zu pairs of edges compared\n",
                figures.steps, figures.free_steps, figures.edges_cast, figures.pairs_checked);
    std::printf("contacts: %zu with the post, %zu with itself\n", figures.at_post, figures.at_itself);
    std::printf(
        "vertices: %zu inserted by responses, %zu of them at the post, %zu removed where the thread is straight\n",
        figures.inserted, figures.inserted_at_post, figures.removed);
    std::printf("vertices: %zu put on long edges, %zu merged at obstacles, %zu at most\n", figures.split,
                figures.merged, figures.most_vertices);
    std::printf("knot: determinant %ld, before %ld; %.2f turns round the post; ends %.1f apart; stretched by %.1f %%\n",
                after, before, turns, last.at.back()[0] - last.at.front()[0], 100 * figures.stretch);
    std::printf("%.0f us for a move\n", 1e6 * figures.seconds / static_cast<double>(figures.steps));
    const bool right = figures.free_steps == figures.steps && before == 1 && after == 3 && turns > 1.25 &&
                       figures.inserted_at_post > 0 && figures.removed > 0 && figures.at_itself > 0 &&
                       figures.longest_stretch < 0.1;
    if (!right) std::fprintf(stderr, "that is not as it should be\n");
    return right ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
