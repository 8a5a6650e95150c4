#pragma once
// The one place where results of the engine become the structs that a host reads: ids and dsw_flight.

#include <cstring>

#include "dartsweep/contact.h"
#include "environment/environment.h"
#include "map/dart.h"
#include "motion/cast.h"
#include "motion/move.h"
#include "motion/wave.h"

namespace dsw {

/** Cells do not change in this release, so every generation is the first. */
constexpr uint32_t kGeneration = 1;

template <int D>
dsw_volume_id volume_id(const Map<D>& map, Cell c) noexcept {
  return c.valid() ? dsw_volume_id{map.index(c), kGeneration} : dsw_volume_id{0, 0};
}

/** Names the half-facet as it is given; reports pass the canonical one. */
template <int D>
dsw_face_id face_id(const Map<D>& map, HalfFacet h) noexcept {
  const Cell c = map.cell_of(h);
  return {map.index(c), kGeneration, map.local_of(h, c)};
}

/** Canonical: that of the volume with the lowest index round the edge. */
dsw_edge_id edge_id(const Map<3>& map, Dart d) noexcept;

inline bool is_null(dsw_volume_id id) noexcept { return (id.index | id.generation) == 0; }

template <int D>
bool is_alive(const Map<D>& map, dsw_volume_id id) noexcept {
  return id.generation == kGeneration && id.index < map.cell_count;
}

/** Host tag of what stands behind an impassable facet; at the outer boundary that of `in_front`. */
template <int D>
uint32_t obstacle_tag(const Environment<D>& env, HalfFacet facet, Cell in_front) noexcept {
  const HalfFacet other = env.map.opposite(facet);
  return env.tag(other.valid() ? env.map.cell_of(other) : in_front);
}

/** What makes a facet impassable: its own mark or the outer boundary, or else the volume behind it. */
template <int D>
dsw_cell_kind obstacle_kind(const Environment<D>& env, HalfFacet facet) noexcept {
  return !env.map.opposite(facet).valid() || env.map.facet_marked(facet) ? DSW_CELL_FACE : DSW_CELL_VOLUME;
}

/** All zero. Copied in words, because GCC 12 makes a string instruction of clearing it, which takes longer than a cast in
 * one cell. */
inline void clear(dsw_flight* flight) noexcept {
  static const dsw_flight kZero{};
  std::memcpy(flight, &kZero, 56);
  std::memcpy(reinterpret_cast<unsigned char*>(flight) + 56, &kZero, sizeof *flight - 56);
}

/** Report of a free cast from `request`. Without detail: outcome, volume and cells_visited only. */
template <int D>
void report_cast(const Environment<D>& env, const CastRequest& request, const CastResult& result, bool detail,
                 dsw_flight* flight) noexcept;

/** Reports of a wave of free casts. First as if all had reached their targets, then those that did not: their work overlaps
 * when it is not scattered. */
template <int D>
void report_wave(const Environment<D>& env, const Wave<D>& wave, bool detail, dsw_flight* const* flights) noexcept;

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
