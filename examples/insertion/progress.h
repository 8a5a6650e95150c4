// How far a long run is, on stderr: a bar on a terminal, else a line every tenth.
#ifndef DARTSWEEP_INSERTION_PROGRESS_H
#define DARTSWEEP_INSERTION_PROGRESS_H

#include <chrono>
#include <cstddef>
#include <ostream>

namespace insertion {

class Progress {
 public:
  // `bar`: redraw one line of `out`; else write a line every 10 %. `out` has to outlive this.
  Progress(std::ostream* out, bool bar, std::size_t steps, double dt);

  // After `done` steps; `contacts` of the last one.
  void show(std::size_t done, double reached_share, std::size_t contacts);

 private:
  using Clock = std::chrono::steady_clock;
  void write(std::size_t done, double reached_share, std::size_t contacts, double seconds);

  std::ostream* out_;
  bool bar_;
  std::size_t steps_, tenths_ = 0;
  double dt_;
  Clock::time_point start_, last_;
};

// Whether stderr is a terminal.
bool stderr_is_terminal();

}  // namespace insertion

#endif
