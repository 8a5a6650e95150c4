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

}  // namespace dsw
