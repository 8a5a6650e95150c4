#pragma once
// A recording that is made again.

#include <optional>

#include "capi/recorded.h"

struct dsw_replay {
  static constexpr const char* kName = "replay";
  static constexpr uint64_t kMagic = 0x6473775f72706c31u;
  uint64_t magic = kMagic;
  dsw_context* context;
  dsw::RecordReader reader;
  dsw_environment* environment = nullptr;
  dsw_scene* scene = nullptr;
  dsw::capi::CallWatch watch;
  uint64_t calls = 0;  // made so far
  uint32_t version = 0, flags = 0;
  // A body has gone another way than in the version that recorded, on arcs or pushed by walls: nothing is compared.
  bool goes_otherwise = false;
  const char* note = "";
  std::optional<dsw_validation> validation;
  dsw::Array<uint64_t> words;             // the arguments of a call
  dsw::Array<dsw::Array<uint64_t>> kept;  // what they point at besides
  dsw::Array<double> points[2];           // lent to the environment in turn
  const double* next = nullptr;           // of these, what the deformation that is being made is given
  size_t needed_room = 0;                 // vertices for which these need memory, as far as is known

  dsw_replay(dsw_context* owner, const uint8_t* bytes, size_t size);
  ~dsw_replay();
  dsw_replay(const dsw_replay&) = delete;
  dsw_replay& operator=(const dsw_replay&) = delete;
};

namespace dsw::capi {

struct DestroyReplay {
  void operator()(dsw_replay* replay) const noexcept { destroy_object(memory_of(replay->context), replay); }
};
using ReplayOwner = std::unique_ptr<dsw_replay, DestroyReplay>;

/** A call that is about to be made again. */
struct NextCall {
  uint32_t number;  // of its row
  const char* function;
  WordReader arguments;
  bool is_finished;  // what came of it was recorded
  CallResult result;
  RecordReader after;
};
/** Reads the next call; false at the end. Throws CORRUPT. */
bool read_next(dsw_replay& replay, std::optional<NextCall>& next);
/** Makes it again. */
void make_again(dsw_replay& replay, const NextCall& next, dsw_replay_report* report);

/** Makes the next call again, if there is one, of which before(next) is told. */
template <class Before>
dsw_replay_report step(dsw_replay& replay, const Before& before) {
  dsw_replay_report report{};
  report.call = replay.calls;
  report.outcome = DSW_REPLAY_END;
  std::optional<NextCall> next;
  if (!read_next(replay, next)) return report;
  report.function = next->function;
  before(*next);
  make_again(replay, *next, &report);
  return report;
}

}  // namespace dsw::capi
