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

  bool full() const noexcept { return count_ == kPacket; }
  uint32_t count() const noexcept { return count_; }

  /** Adds a cast, which the caller may refine before it runs. `start` contains `from`; both points outlive the run. */
  CastRequest& add(const Environment<D>& env, Cell start, const double* from, const double* to) noexcept {
    prefetch_vertices(env, start);
    CastRequest* const request = new (&requests_[count_++]) CastRequest;
    request->from = from;
    request->to = to;
    request->start = start;
    return *request;
  }
  void run(const Environment<D>& env, CastCounters* counters) noexcept {
    if (count_ != 0) cast_side_by_side(env, requests_, count_, results_, counters);
  }
  void clear() noexcept { count_ = 0; }

  const CastRequest& request(uint32_t i) const noexcept { return requests_[i]; }
  const CastResult& result(uint32_t i) const noexcept { return results_[i]; }
  /** Whether a cast came to its target, in the cell known to hold it: over a fold it can come to it in another. */
  bool reached(uint32_t i) const noexcept {
    const Cell end = requests_[i].end;
    return results_[i].end == CastEnd::kReached && (!end.valid() || results_[i].cell == end);
  }

 private:
  uint32_t count_ = 0;
  // In unions, which construct nothing.
  union {
    CastRequest requests_[kPacket];
  };
  union {
    CastResult results_[kPacket];
  };
};

}  // namespace dsw
