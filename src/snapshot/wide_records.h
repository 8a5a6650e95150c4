#pragma once
// Records of the plane as snapshots of format version 2 have them: in units of 8 words like those of space, of which
// triangles left two unused.

#include "map/map.h"

namespace dsw {

/** Words of a unit in them. */
constexpr uint32_t kWideUnitWords = 8;

/** Turns such words, which are not trusted and whose shapes are known, into the map's records; what they said,
 * check_integrity is to look at. Throws Error with CORRUPT, or std::bad_alloc. */
void narrow_records(Map<2>& map);

}  // namespace dsw
