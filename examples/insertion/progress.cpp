#include "progress.h"

#include <unistd.h>

#include <cstdio>
#include <string>

namespace insertion {
namespace {

constexpr std::size_t kWidth = 30;
constexpr double kRedraw = 0.1;  // seconds

}  // namespace

Progress::Progress(std::ostream* out, bool bar, std::size_t steps, double dt)
    : out_(out), bar_(bar), steps_(steps), dt_(dt), start_(Clock::now()), last_(start_) {}

void Progress::show(std::size_t done, double reached_share, std::size_t contacts) {
  const Clock::time_point now = Clock::now();
  const double seconds = std::chrono::duration<double>(now - start_).count();
  const std::size_t tenths = 10 * done / steps_;
  if (bar_ ? done == steps_ || std::chrono::duration<double>(now - last_).count() > kRedraw : tenths > tenths_) {
    write(done, reached_share, contacts, seconds);
    last_ = now;
  }
  tenths_ = tenths;
}

void Progress::write(std::size_t done, double reached_share, std::size_t contacts, double seconds) {
  char text[160];
  const double share = static_cast<double>(done) / static_cast<double>(steps_);
  std::snprintf(text, sizeof text,
                "%3.0f %%  step %zu of %zu  real-time factor %.2f  reached %.0f %%  contacts %zu  %.0f s left",
                100 * share, done, steps_, static_cast<double>(done) * dt_ / seconds, 100 * reached_share, contacts,
                seconds * (1 / share - 1));
  if (!bar_) {
    *out_ << text << std::endl;
    return;
  }
  const std::size_t filled = kWidth * done / steps_;
  // Erases what is left of a longer line before.
  *out_ << "\r[" << std::string(filled, '#') << std::string(kWidth - filled, '.') << "] " << text << "\x1b[K"
        << (done == steps_ ? "\n" : "") << std::flush;
}

bool stderr_is_terminal() { return isatty(STDERR_FILENO) != 0; }

}  // namespace insertion
