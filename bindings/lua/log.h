// The library's log for Lua. Lines come on threads that must not enter a Lua state, so they are kept until they are read.
#pragma once

#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "common/host.h"

namespace dartsweep_lua {

struct Line {
  int level;
  std::string text;
};

class Log {
 public:
  // The oldest line that has not been read.
  std::optional<Line> read() {
    const std::lock_guard<std::mutex> hold(lines_->mutex);
    if (lines_->queue.empty()) return std::nullopt;
    Line line = std::move(lines_->queue.front());
    lines_->queue.pop_front();
    return line;
  }

#ifndef SWIG
  // Writes here; may outlive this object.
  std::unique_ptr<dartsweep::LogSink> sink() const { return std::make_unique<Sink>(lines_); }

 private:
  struct Lines {
    std::mutex mutex;
    std::deque<Line> queue;
  };
  class Sink : public dartsweep::LogSink {
   public:
    explicit Sink(std::shared_ptr<Lines> lines) : lines_(std::move(lines)) {}
    void write(int level, const char *text) override {
      const std::lock_guard<std::mutex> hold(lines_->mutex);
      lines_->queue.push_back({level, text});
    }

   private:
    std::shared_ptr<Lines> lines_;
  };

  std::shared_ptr<Lines> lines_ = std::make_shared<Lines>();
#endif
};

}  // namespace dartsweep_lua
