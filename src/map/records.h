#pragma once
// Room for cells that come and go. Records and shape tables that are left are kept in lists by size and taken again, last left
// first; nothing else moves. A map is made ready for this when it is first changed: before, it holds none of these tables.

#include "map/map.h"

namespace dsw {

/** Sets up generations, uses of vertices and the tables between cells and records; cells that share shapes get their own. Throws
 * std::bad_alloc or TOO_LARGE with the map as it was. O(n) the first time, O(1) after. */
void make_ready(Map<3>& map);

/** Takes a record of so many units, all words zero; cell_of_unit says kNoCell there. Throws std::bad_alloc, or TOO_LARGE. */
uint32_t take_record(Map<3>& map, uint32_t units);
/** Takes a shape number with a copy of this table. Throws std::bad_alloc. */
uint32_t take_shape(Map<3>& map, const Array<uint16_t>& table);

/** Makes room for giving back a record and its shape, if it has one of its own: that then cannot fail. What has been taken has its
 * room. */
void reserve_return(Map<3>& map, Cell c);
/** Gives back the record of a cell with its shape. */
void give_back(Map<3>& map, Cell c) noexcept;

/** How much there is, free or not. */
struct Room {
  size_t units, shapes, shape_words;
  size_t record_lists, shape_lists;  // of free ones
};
Room room_of(const Map<3>& map) noexcept;

/** Undo takes: with all of them undone, the last one first, and then `shrink`, the map is as it was when `before` was noted. */
void untake_record(Map<3>& map, uint32_t unit, uint32_t units, const Room& before) noexcept;
void untake_shape(Map<3>& map, uint32_t number, const Room& before) noexcept;
void shrink(Map<3>& map, const Room& before) noexcept;

/** Number of 16-bit words of a table. */
uint32_t shape_length(const Map<3>& map, uint32_t number) noexcept;

}  // namespace dsw
