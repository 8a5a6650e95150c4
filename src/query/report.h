#pragma once
// Results of casts and moves of particles as the structs that a host reads.

#include <cstring>

#include "contact/names.h"
#include "walk/cast.h"
#include "walk/move.h"
#include "walk/packet.h"

namespace dsw {

/** All zero. Copied in words, because GCC 12 clears it by a string instruction, which takes longer than a cast. */
inline void clear(dsw_flight* flight) noexcept {
  static const dsw_flight kZero{};
  std::memcpy(flight, &kZero, 64);
  std::memcpy(reinterpret_cast<unsigned char*>(flight) + 64, &kZero, sizeof *flight - 64);
}

/** Report of a free cast from `request`. Without detail: outcome, volume and volumes_visited only. */
template <int D>
void report_cast(const Environment<D>& env, const CastRequest& request, const CastResult& result, bool detail,
                 dsw_flight* flight) noexcept;

/** Reports of a packet of free casts. First as if all had reached their targets, then those that did not: their work
 * overlaps when it is not scattered. */
template <int D>
void report_packet(const Environment<D>& env, const Packet<D>& packet, bool detail,
                   dsw_flight* const* flights) noexcept;

/** Report of a free cast that could not start: outside, or in the impassable cell `start`. */
template <int D>
void report_no_start(const Environment<D>& env, const double* from, Cell start, dsw_flight* flight) noexcept;

/** Report of a particle's move. Without detail it has no normal and no ids of the hit. */
template <int D>
void report_move(const Environment<D>& env, const MoveResult<D>& result, bool detail, dsw_flight* flight) noexcept;

/** The crossing of a flight into `to` through simplex `simplex` of `from`. */
template <int D>
dsw_crossing report_crossing(const Environment<D>& env, Cell from, uint32_t simplex, Cell to, const double* start,
                             const double* target) noexcept;

/** Writes the crossings of one flight into the room that was counted for it. */
template <int D>
class CrossingWriter {
 public:
  /** Writes the cell where the flight starts, and from then on every cell that the cast enters. */
  void attach(const Environment<D>& env, CastRequest& request, dsw_crossing* first, dsw_crossing* end) noexcept {
    env_ = &env;
    from_ = request.from;
    to_ = request.to;
    next_ = first;
    end_ = end;
    *next_++ = {volume_id(env.map, request.start), {0, 0, 0}, 0};
    request.crossing = write;
    request.crossing_user = this;
  }

 private:
  static void write(void* user, Cell from_cell, uint32_t simplex, Cell to_cell) {
    CrossingWriter& w = *static_cast<CrossingWriter*>(user);
    DSW_ASSERT(w.next_ != w.end_);
    if (w.next_ != w.end_) *w.next_++ = report_crossing(*w.env_, from_cell, simplex, to_cell, w.from_, w.to_);
  }

  const Environment<D>* env_ = nullptr;
  const double *from_ = nullptr, *to_ = nullptr;
  dsw_crossing *next_ = nullptr, *end_ = nullptr;
};

}  // namespace dsw
