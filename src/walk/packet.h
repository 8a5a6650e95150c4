#pragma once
// Many casts side by side: the way batches are cast. Filled, run, read, cleared, filled again.

#include <new>

#include "walk/cast.h"
#include "walk/prefetch.h"

namespace dsw {

template <int D>
class Packet {
 public:
  Packet() noexcept {}  // leaves its casts unwritten: a packet is made for single casts too

  bool full() const noexcept { return count_ + stayed_ == kPacket; }
  uint32_t count() const noexcept { return count_; }

  /** Adds a cast, which the caller may refine before it runs. `start` contains `from`; both points outlive the run. */
  CastRequest& add(const Environment<D>& env, Cell start, const double* from, const double* to) noexcept {
    prefetch_start(env, start);
    return put(count_++, start, from, to);
  }
  /** Adds a cast whose end is known, and which need not be told from others that come to it: one that does not leave a
   * convex cell is only counted. Without a branch on that, which nobody can predict. */
  void add_between(const Environment<D>& env, Cell start, const double* from, Cell end, const double* to,
                   uint32_t max_volumes) noexcept {
    prefetch_start(env, start);
    CastRequest& request = put(count_, start, from, to);
    request.end = end;
    request.max_volumes = max_volumes;
    const uint32_t stays = static_cast<uint32_t>(start == end) & static_cast<uint32_t>(env.map.convex(start));
    count_ += 1 - stays;
    stayed_ += stays;
  }
  /** Counts casts that are seen to come to their targets. */
  void add_seen(uint32_t casts) noexcept { stayed_ += casts; }
  /** How many casts may still be added or counted. */
  uint32_t room() const noexcept { return kPacket - count_ - stayed_; }
  void run(const Environment<D>& env, CastCounters* counters) noexcept {
    if (count_ != 0) cast_side_by_side(env, requests_, count_, results_, counters);
    if (counters != nullptr) counters->add({stayed_, stayed_});
    stayed_ = 0;
  }
  void clear() noexcept { count_ = stayed_ = 0; }

  const CastRequest& request(uint32_t i) const noexcept { return requests_[i]; }
  const CastResult& result(uint32_t i) const noexcept { return results_[i]; }
  /** Whether a cast came to its target, in the cell known to hold it: over a fold it can come to it in another. */
  bool reached(uint32_t i) const noexcept {
    const Cell end = requests_[i].end;
    return results_[i].end == CastEnd::kReached && (!end.valid() || results_[i].cell == end);
  }

 private:
  CastRequest& put(uint32_t i, Cell start, const double* from, const double* to) noexcept {
    CastRequest* const request = new (&requests_[i]) CastRequest;
    request->from = from;
    request->to = to;
    request->start = start;
    return *request;
  }

  uint32_t count_ = 0;
  uint32_t stayed_ = 0;  // casts that are not among them
  // In unions, which construct nothing.
  union {
    CastRequest requests_[kPacket];
  };
  union {
    CastResult results_[kPacket];
  };
};

}  // namespace dsw
